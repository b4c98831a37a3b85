"""Figures, one module each, named by what they show."""
