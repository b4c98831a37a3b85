"""Meshes for OpenFOAM."""
