"""Histories of a run as the figures show them: over t*, angles in degrees."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.conventions import reduced_time_factor
from equisection.results.netcdf import read_dataset

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class History:
    """Motion and lift of one run.

    Attributes
    ----------
    time : (n,) array
        t* = s sqrt(k*/I*).
    tip_twist_deg : (n,) array
        Twist of the tip (deg); in 2D the section's over its recovery factor.
    twist_deg : (n,) array
        Twist of the section in 2D, of the tip in 3D (deg).
    lift : (n,) array
        c_l in 2D, C_L in 3D.
    description, resolution : str
        Solver in words, and resolution.
    """

    time: Floats
    tip_twist_deg: Floats
    twist_deg: Floats
    lift: Floats
    description: str
    resolution: str


def history_from_dataset(run: xr.Dataset, i_star: float) -> History:
    """Return the history of a run; I* is that of the uncorrected section."""
    return History(
        time=run["time"].values * reduced_time_factor(float(run.attrs["k_star"]), i_star),
        tip_twist_deg=np.degrees(run["tip_twist"].values),
        twist_deg=np.degrees(run["twist"].values),
        lift=run["cl"].values,
        description=str(run.attrs["solver_description"]),
        resolution=str(run.attrs["resolution"]),
    )


def read_history(path: Path, i_star: float) -> History:
    """Read the history of a run from its result file."""
    return history_from_dataset(read_dataset(path), i_star)


@dataclass(frozen=True)
class Extent:
    """Least and largest twist (deg) and deflection (chords) of the tip in the verdict's window.

    The deflection of a section's tip about its mean is recovered as an oscillation's
    (:func:`equisection.reduction.reduce.oscillation_factor`).
    """

    twist_deg: tuple[float, float]
    deflection_chords: tuple[float, float]


def extent_from_dataset(run: xr.Dataset, oscillation_factor: float = 1.0) -> Extent:
    """Return the range of the motion over the window of the verdict.

    Parameters
    ----------
    run
        Result of a run.
    oscillation_factor
        Factor of the deflection about its mean (-), 1 of a beam.
    """
    start = float(run.attrs["window_start"])
    window = run["time"].values >= (0.0 if math.isnan(start) else start)
    twist = np.degrees(run["tip_twist"].values[window])
    deflection = run["tip_deflection"].values[window] / float(run.attrs["chord"])
    mean = float(run.attrs.get("mean_deflection_chords", math.nan))
    if math.isfinite(mean):
        deflection = mean + oscillation_factor * (deflection - mean)
    return Extent(
        (float(twist.min()), float(twist.max())),
        (float(deflection.min()), float(deflection.max())),
    )


def read_extent(path: Path, oscillation_factor: float = 1.0) -> Extent:
    """Read the range of the motion (:func:`extent_from_dataset`) from a result file."""
    return extent_from_dataset(read_dataset(path), oscillation_factor)
