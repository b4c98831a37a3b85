"""Loads on a section and on a finite beam, for the embedded solver."""
