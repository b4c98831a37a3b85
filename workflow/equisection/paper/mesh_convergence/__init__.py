"""Onset, growth, means and loads of the paper's plate over the cell size, from kept results."""
