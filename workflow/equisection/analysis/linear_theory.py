"""What classical linear theory says of the equivalent section: divergence and flutter.

The theory is that of a thin plate in attached, inviscid flow in free air (Theodorsen). It knows
neither the incidence at which the section stands nor separation, so what it does not see of the
instability is what these two make of it. k* is the axis of every comparison (Eq. 17 in the paper's
form); a section of the other reduction has its own stiffness at that k*.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.errors import IncidenceOutOfRangeError, ResultFileError
from equisection.motion.linear_flutter import (
    FlutterIterationError,
    TypicalSection,
    divergence_scale,
    flutter,
    growth_and_frequency,
)
from equisection.results.polar_dataset import polar_at
from equisection.study.plan import model

#: Columns of ``comparison/linear_theory.csv``, in order.
COLUMNS = ("reduction", "motion", "k_star", "growth_rate", "frequency_strouhal")
#: Columns that the theory adds to ``comparison/onset.csv``.
ONSET_COLUMNS = ("linear_flutter", "linear_divergence", "divergence_by_polar")
#: The motions in vacuum, in the order of :func:`growth_and_frequency`.
_MOTIONS = ("heave", "pitch")


@dataclass(frozen=True)
class Section:
    """The section of one reduction.

    Attributes
    ----------
    section
        Its properties at the k* of the beam as given.
    k_star
        That k*, by which every stiffness goes.
    """

    section: TypicalSection
    k_star: float


def section_of(equivalent: xr.Dataset, reduction: str) -> Section:
    """Return the section of a reduction from ``structure/equivalent.nc``."""
    chosen = equivalent.sel(reduction=reduction)
    own = TypicalSection(
        mass=float(chosen["m_star"]),
        inertia=float(chosen["i_star"]),
        flexural_stiffness=float(chosen["k_w_star"]),
        torsional_stiffness=float(chosen["k_star"]),
    )
    return Section(own, float(equivalent["k_star"].sel(reduction="paper")))


def linear_theory(equivalent: xr.Dataset, k_star: Sequence[float]) -> pd.DataFrame:
    """Return ``comparison/linear_theory.csv``: growth and frequency of both motions over k*.

    Parameters
    ----------
    equivalent
        ``structure/equivalent.nc``.
    k_star
        Values of k* (-), in any order.
    """
    rows = []
    ascending = sorted(k_star)
    for reduction in (str(name) for name in equivalent["reduction"].values):
        chosen = section_of(equivalent, reduction)
        p = _growth_and_frequency(chosen.section, np.array(ascending) / chosen.k_star)
        for column, motion in enumerate(_MOTIONS):
            for value, root in zip(ascending, p[:, column], strict=True):
                rows.append((reduction, motion, value, root.real, root.imag / (2 * math.pi)))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _growth_and_frequency(
    section: TypicalSection, scales: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Return p of both motions at each s, shape (n, 2); NaN where the p-k iteration finds none.

    That may be so just above divergence, where a motion ceases to oscillate.
    """
    try:
        return growth_and_frequency(section, scales)
    except FlutterIterationError as error:
        if scales.size > 1:
            return np.concatenate([_growth_and_frequency(section, one) for one in scales[:, None]])
        logging.warning("no growth rate by linear theory: %s", error)
        return np.full((1, 2), complex(math.nan, math.nan))


def moment_slope(polar_2d: xr.Dataset, resolution: str, incidence_deg: float) -> float:
    """Return dc_m/dtheta (1/rad) of ``steady/polar_2d.nc`` at an incidence (deg).

    NaN where too few incidences have a result, or none beyond this one.
    """
    try:
        return polar_at(polar_2d, resolution).continued.moment_slope(math.radians(incidence_deg))
    except (ResultFileError, IncidenceOutOfRangeError):
        return math.nan


def linear_onset(equivalent: xr.Dataset, slope: float) -> dict[str, dict[str, float]]:
    """Return the k* of flutter and divergence of each reduction, by :data:`ONSET_COLUMNS`.

    Parameters
    ----------
    equivalent
        ``structure/equivalent.nc``.
    slope
        dc_m/dtheta of the section's polar (1/rad), of the divergence beside the thin plate's.

    Returns
    -------
    dict
        NaN for flutter where no k* has a neutral oscillation; 0 where nothing diverges.
    """
    found = {}
    for reduction in (str(name) for name in equivalent["reduction"].values):
        chosen = section_of(equivalent, reduction)
        neutral = flutter(chosen.section)
        values = (
            math.nan if neutral is None else chosen.k_star * neutral.scale,
            chosen.k_star * divergence_scale(chosen.section),
            chosen.k_star * divergence_scale(chosen.section, slope),
        )
        found[reduction] = dict(zip(ONSET_COLUMNS, values, strict=True))
    return found


def with_linear_theory(
    onset: pd.DataFrame, linear: dict[str, dict[str, float]], default_reduction: str
) -> pd.DataFrame:
    """Return ``comparison/onset.csv`` with what linear theory says of the uncorrected sections.

    A corrected section has other masses in another flow, and the beam more modes than two: theirs
    are empty.
    """
    columns = {}
    for name in ONSET_COLUMNS:
        models = [model(str(row), default_reduction) for row in onset["model"]]
        columns[name] = [
            linear[one.reduction][name] if one.dimension == "2d" and not one.corrected else math.nan
            for one in models
        ]
    return onset.assign(**columns)
