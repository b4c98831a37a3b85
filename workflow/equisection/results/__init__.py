"""Data sets as NetCDF files: written whole or not at all, validated on reading."""
