"""Readers of OpenFOAM's output."""
