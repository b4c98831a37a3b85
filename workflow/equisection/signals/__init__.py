"""Verdict on a history: settled, limit cycle or growing, with its means and frequencies."""
