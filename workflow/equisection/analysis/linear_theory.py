"""Divergence and flutter of the equivalent section by classical linear theory.

The theory is that of a thin plate in attached, inviscid flow in free air (Theodorsen). It knows
neither the mean incidence of the section nor separation, so an instability that it does not see
comes from these two. k* is the axis of every comparison (Eq. 17 in the paper's form); a section of
the other reduction has its own stiffness at that k*.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.beam.section import Section
from equisection.errors import IncidenceOutOfRangeError, ResultFileError
from equisection.motion.exact_roots import exact_growth_and_frequency
from equisection.motion.linear_flutter import (
    FlutterIterationError,
    divergence_scale,
    flutter,
    growth_and_frequency,
)
from equisection.results.polar_dataset import polar_at
from equisection.results.section_dataset import nominal_k_star, section_in_flow
from equisection.study.axes import AsGiven
from equisection.study.plan import Model, model

#: Columns of ``comparison/linear_theory.csv``, in order.
COLUMNS = (
    "reduction",
    "motion",
    "k_star",
    "growth_rate",
    "frequency_strouhal",
    "speed",
    "growth_rate_exact",
    "frequency_strouhal_exact",
)
#: Columns that the theory adds to ``comparison/onset.csv``.
ONSET_COLUMNS = ("linear_flutter", "linear_divergence", "divergence_by_polar")
#: Name of the beam among the reductions.
_BEAM = "beam"
#: Place of the moments of a polar, x/c.
_MID_CHORD = 0.5
#: The motions in vacuum, in the order of :func:`growth_and_frequency`.
_MOTIONS = ("heave", "pitch")


def linear_theory(
    equivalent: xr.Dataset, k_star: Sequence[float], speed: float = math.nan
) -> pd.DataFrame:
    """Return ``comparison/linear_theory.csv``: growth and frequency of both motions over k*.

    Those of the p-k method, which are exact at flutter, and the exact ones of the p-plane; NaN for
    what has ceased to turn.

    Parameters
    ----------
    equivalent
        ``structure/equivalent.nc``.
    k_star
        Values of k* (-), in any order.
    speed
        V (m/s) at which the beam as given has its k*; with it come the speeds of the others.
    """
    rows, given = [], nominal_k_star(equivalent)
    ascending = sorted(k_star)
    for reduction in (str(name) for name in equivalent["reduction"].values):
        section = section_in_flow(equivalent, reduction)
        scales = np.array(ascending) / given
        p = _growth_and_frequency(section, scales)
        exact = exact_growth_and_frequency(section, scales)
        for column, motion in enumerate(_MOTIONS):
            for value, root, is_so in zip(ascending, p[:, column], exact[:, column], strict=True):
                there = AsGiven(given, speed).speed_at(value)
                numbers = (root.real, root.imag / math.tau, there)
                rows.append((reduction, motion, value, *numbers, is_so.real, is_so.imag / math.tau))
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _growth_and_frequency(section: Section, scales: NDArray[np.float64]) -> NDArray[np.complex128]:
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


def moment_slope(
    polar_2d: xr.Dataset, resolution: str, incidence_deg: float, elastic_axis: float = 0.5
) -> float:
    """Return dc_m/dtheta (1/rad) of ``steady/polar_2d.nc`` at an incidence (deg).

    That about the elastic axis (x/c from the leading edge).

    NaN where too few incidences have a result, or none beyond this one.
    """
    try:
        polar = polar_at(polar_2d, resolution).continued
        polar.require(alpha := math.radians(incidence_deg))
        return float(polar.moment_cubic_about(elastic_axis - _MID_CHORD)(alpha, 1))
    except (ResultFileError, IncidenceOutOfRangeError):
        return math.nan


def linear_onset(equivalent: xr.Dataset, slope: float) -> dict[str, dict[str, float]]:
    """Return the k* of flutter and divergence of each reduction, by :data:`ONSET_COLUMNS`.

    Parameters
    ----------
    equivalent
        ``structure/equivalent.nc``.
    slope
        dc_m/dtheta about the elastic axis of the section's polar (1/rad), for a divergence in
        addition to that of the thin plate.

    Returns
    -------
    dict
        By reduction, and under ``beam`` for the beam, of which the flutter alone is known. NaN for
        flutter where no k* has a neutral oscillation; 0 where nothing diverges.
    """
    found, nominal = {}, nominal_k_star(equivalent)
    for reduction in (str(name) for name in equivalent["reduction"].values):
        section = section_in_flow(equivalent, reduction)
        neutral = flutter(section)
        values = (
            math.nan if neutral is None else nominal * neutral.scale,
            nominal * divergence_scale(section),
            nominal * divergence_scale(section, slope),
        )
        found[reduction] = dict(zip(ONSET_COLUMNS, values, strict=True))
    of_beam = equivalent.get("beam_flutter_k_star")
    beam = (math.nan if of_beam is None else float(of_beam), math.nan, math.nan)
    found[_BEAM] = dict(zip(ONSET_COLUMNS, beam, strict=True))
    return found


def with_linear_theory(
    onset: pd.DataFrame, linear: dict[str, dict[str, float]], default_reduction: str
) -> pd.DataFrame:
    """Return ``comparison/onset.csv`` with the linear theory of sections and beam.

    A corrected section has other masses in another flow: its columns are empty. Of the beam there
    is the flutter, with all of its modes.
    """
    columns = {}
    for name in ONSET_COLUMNS:
        models = [model(str(row), default_reduction) for row in onset["model"]]
        columns[name] = [math.nan if one.corrected else linear[_row(one)][name] for one in models]
    return onset.assign(**columns)


def _row(one: Model) -> str:
    return one.reduction if one.dimension == "2d" else _BEAM
