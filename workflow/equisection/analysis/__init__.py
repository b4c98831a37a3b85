"""Quantities that are made of the results: summary, onset, linear theory, grid study."""
