"""The solver protocol, and the adapters that fulfil it."""
