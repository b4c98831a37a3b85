"""Histories of a moving section from a flow solver, to identify the lags from and judge them by.

Moments in these files are about the mid-chord where it was at first, fixed in space. With the
mid-chord displaced by w upwards the drag D has the arm w about that point and turns the nose up
(flow along +x, lift along +y), so about the moving mid-chord

    c_m = c_m,fixed - c_d w/c.

A release that has settled must then obey k* theta = c_m and k_w* w/c = c_l in the mean.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.errors import ResultFileError

Floats = NDArray[np.float64]

VARIABLES = ("cl", "cd", "cm_fixed_centre")
MOTION_VARIABLES = ("twist", "deflection")
RELEASE_ATTRIBUTES = ("k_star", "i_star", "mass_ratio", "stiffness_ratio")


@dataclass(frozen=True)
class ReferenceHistory:
    """Motion and loads of a section at uniform times, each of shape (n,).

    Parameters
    ----------
    time
        s = tV/c.
    twist, deflection
        theta (rad) and w/c; zero where the section was held rigid.
    lift_coefficient, moment_coefficient
        c_l, and c_m about the moving mid-chord.
    incidence_rad
        Rigid incidence theta_0 (rad).
    k_star, i_star, mass_ratio, stiffness_ratio
        k*, I*, m*/I*, k_w*/k*; NaN where the section was held rigid.
    source
        Where the history comes from.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift_coefficient: Floats
    moment_coefficient: Floats
    incidence_rad: float
    k_star: float
    i_star: float
    mass_ratio: float
    stiffness_ratio: float
    source: str

    @property
    def time_step(self) -> float:
        """Interval of the samples in convective times."""
        return float(self.time[1] - self.time[0])


def unexplained_damping(history: ReferenceHistory, start: float) -> float:
    """Negative damping d that the recorded motion shows and the recorded moment does not.

    Least squares of I* theta'' + k* theta - c_m = d theta' (plus a constant) after ``start``
    (c/V). It is 0 for a flow solver whose coupling conserves energy; d > 0 adds d/(2 I*) to the
    growth rate of the twist.
    """
    rate = np.gradient(history.twist, history.time_step)
    acceleration = np.gradient(rate, history.time_step)
    imbalance = (
        history.i_star * acceleration + history.k_star * history.twist - history.moment_coefficient
    )
    late = history.time > start
    late[-2:] = False  # one-sided differences
    return float(np.polyfit(rate[late], imbalance[late], 1)[0])


def read_reference_history(path: Path) -> ReferenceHistory:
    """Read a history; one without ``twist`` is of a section held rigid.

    Raises
    ------
    ResultFileError
        The file is missing or lacks a variable or attribute, or its times are not uniform.
    """
    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            data = opened.load()
    except (OSError, ValueError) as error:
        raise ResultFileError(
            f"{path}: cannot be read ({error}); a NetCDF-4 file is wanted"
        ) from None
    moves = "twist" in data
    wanted = VARIABLES + (MOTION_VARIABLES if moves else ())
    missing = [name for name in wanted if name not in data]
    missing += [
        name
        for name in ("incidence_deg", *(RELEASE_ATTRIBUTES if moves else ()))
        if name not in data.attrs
    ]
    if missing:
        raise ResultFileError(
            f"{path}: lacks {', '.join(missing)}; add them or identify from another history"
        )
    time = data["time"].to_numpy().astype(np.float64)
    intervals = np.diff(time)
    if time.size < 3 or np.ptp(intervals) > 1e-3 * abs(intervals[0]):
        raise ResultFileError(f"{path}: times are not uniform; resample the history")

    def values(name: str) -> Floats:
        return data[name].to_numpy().astype(np.float64)

    def attribute(name: str) -> float:
        return float(data.attrs[name]) if moves else float("nan")

    twist, deflection = (
        values(name) if moves else np.zeros_like(time) for name in MOTION_VARIABLES
    )
    return ReferenceHistory(
        time,
        twist,
        deflection,
        values("cl"),
        values("cm_fixed_centre") - values("cd") * deflection,
        float(np.radians(data.attrs["incidence_deg"])),
        k_star=attribute("k_star"),
        i_star=attribute("i_star"),
        mass_ratio=attribute("mass_ratio"),
        stiffness_ratio=attribute("stiffness_ratio"),
        source=str(data.attrs.get("title", path.name)),
    )
