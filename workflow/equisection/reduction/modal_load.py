"""The load on a beam as a mode feels it: its spanwise distribution weighted by the shape.

Eq. 20 corrects the section by the mean load of the rigid beam, the integral of c_l(z) over z/L.
What drives a mode of shape f is the integral of c_l(z) f(z), and a section that stands for a beam
under a uniform load (:mod:`equisection.reduction.section`) carries

    C_f = integral of c(z) f(z) dz / integral of f(z) dz .

A uniform load is the same in both. One that falls towards the tip, where a cantilever's modes are
largest, is less by C_f than by its mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from equisection.errors import ReductionError

Floats = NDArray[np.float64]

#: How far from the tip (z/L) the last of the strips may end.
_TOLERANCE = 1e-6


def strip_widths(middles: Floats) -> Floats:
    """Return the widths of strips that follow each other from the root to the tip.

    Parameters
    ----------
    middles
        z/L of their middles, ascending, shape (n,).

    Raises
    ------
    ReductionError
        No strips from 0 to 1 have these middles.
    """
    signs = (-1.0) ** np.arange(middles.size)
    edges = 2.0 * signs * np.cumsum(signs * middles)  # e_(i+1) = 2 m_i - e_i from e_0 = 0
    widths = np.diff(edges, prepend=0.0)
    if not middles.size or abs(edges[-1] - 1.0) > _TOLERANCE or (widths <= 0.0).any():
        raise ReductionError(
            f"the load is given at {middles.size} stations along the span that are not the middles "
            "of strips from the root to the tip"
        )
    return np.asarray(widths)


def modal_load(middles: Floats, load: Floats, span: Floats, shape: Floats) -> float:
    """Return the load that a mode feels, C_f.

    Parameters
    ----------
    middles, load
        z/L of the middles of strips from root to tip, and the load on each, shape (n,).
    span, shape
        z/L of the stations of the mode, and its shape there, shape (m,).

    Raises
    ------
    ReductionError
        The stations of the load are no middles of strips.
    """
    weights = strip_widths(middles) * CubicSpline(span, shape)(middles)
    return float((weights * load).sum() / weights.sum())
