"""Data sets as NetCDF files: written whole or not at all, validated on reading."""

from equisection.results.netcdf import is_whole, read_attributes, read_dataset, write_dataset
from equisection.results.steady import SteadyResult
from equisection.results.unsteady import Regime, UnsteadyResult

__all__ = [
    "Regime",
    "SteadyResult",
    "UnsteadyResult",
    "is_whole",
    "read_attributes",
    "read_dataset",
    "write_dataset",
]
