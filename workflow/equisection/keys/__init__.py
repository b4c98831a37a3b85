"""Keys of a configuration: their values, their words, their checks."""
