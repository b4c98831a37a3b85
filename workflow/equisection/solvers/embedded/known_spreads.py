"""Known spread of the default lags, by the choice of releases, and of their polar, by the mesh.

``known_spreads.csv`` beside this module has the half-ranges, as parts of the values, with their
sources. Between two incidences of a row they go linearly, beyond the last they stay. All are of one
polar and the lags that were identified on it: of others nothing is known.
"""

from __future__ import annotations

import csv
from functools import lru_cache
from pathlib import Path

import numpy as np

from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.solvers.known_spread import KnownSpread

FILE = Path(__file__).with_name("known_spreads.csv")


@lru_cache(maxsize=1)
def _rows() -> tuple[dict[str, str], ...]:
    with FILE.open(encoding="utf-8", newline="") as file:
        return tuple(csv.DictReader(file))


def known_spread(
    parameter: str, incidence_deg: float, polar: str, lags: SeparationLags
) -> KnownSpread | None:
    """Return the half-range of a parameter at theta_0 (deg); None where nobody knows it.

    Parameters
    ----------
    parameter
        ``tau_1``, ``tau_2``, ``tau_3``, ``lift`` or ``moment``.
    incidence_deg
        theta_0 (deg), of either sign.
    polar
        Label of the polar.
    lags
        Lags in use.
    """
    rows = [row for row in _rows() if (row["polar"], row["parameter"]) == (polar, parameter)]
    if not rows or (parameter.startswith("tau") and lags != IDENTIFIED_LAGS):
        return None
    at = [float(row["incidence_deg"]) for row in rows]
    half_range = np.interp(abs(incidence_deg), at, [float(row["half_range"]) for row in rows])
    sources = "; ".join(row["source"] for row in rows)
    return KnownSpread(float(half_range), sources)
