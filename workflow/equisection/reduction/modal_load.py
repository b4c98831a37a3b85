"""The load on a beam as a mode feels it: its spanwise distribution weighted by the shape.

Eq. 20 corrects the section by the mean load of the rigid beam, the integral of c_l(z) over z/L.
A mode of shape f is driven by the integral of c_l(z) f(z). A section that is equivalent to a beam
under a uniform load (:mod:`equisection.reduction.reduce`) carries

    C_f = integral of c(z) f(z) dz / integral of f(z) dz .

A uniform load is the same in both. One that falls towards the tip, where a cantilever's modes are
largest, is less by C_f than by its mean.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def modal_load(stations: Floats, load: Floats, span: Floats, shape: Floats) -> Floats:
    """Return the load that a mode feels, C_f, shape (...).

    Each load counts from half way to the station before to half way to the next, the first from
    the root and the last to the tip: second order in their distance.

    Parameters
    ----------
    stations, load
        z/L where the load is known, ascending, shape (n,), and the load there, shape (..., n).
    span, shape
        z/L of the stations of the mode, and its shape there, shape (m,).
    """
    between = (stations[1:] + stations[:-1]) / 2
    weights = np.diff(between, prepend=0.0, append=1.0) * scipy.interpolate.CubicSpline(
        span, shape
    )(stations)
    felt: Floats = load @ weights / weights.sum()
    return felt
