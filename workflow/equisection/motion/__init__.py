"""Equations of motion of section and beam under unsteady loads, integrated in time."""
