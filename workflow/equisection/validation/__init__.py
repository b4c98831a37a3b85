"""Published and independent numbers, computed again by this package: `docs/validation.md`."""
