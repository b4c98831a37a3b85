"""The study of a configuration: its cases, and the contents of each."""
