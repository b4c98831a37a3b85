"""Comparison of the models: summary, onset, and the numbers that the paper states."""
