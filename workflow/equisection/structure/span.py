"""Integrals and derivatives along the span of shapes known at stations.

A cubic spline through the stations is integrated and differentiated exactly. One derivative of
a three-dimensional mode is safe (its error falls with the mesh); a second one is noise.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def integrate(span: Floats, values: Floats) -> Floats:
    """Integral over z/L from 0 to 1 of values given along the last axis (-, station)."""
    return np.asarray(
        scipy.interpolate.CubicSpline(span, values, axis=-1).integrate(span[0], span[-1])
    )


def gram(span: Floats, first: Floats, second: Floats) -> Floats:
    """Matrix (i, j) of the integrals of first_i second_j over z/L, as in Eqs. 6 and 12."""
    return integrate(span, first[:, None, :] * second[None, :, :])


def derivative(span: Floats, values: Floats) -> Floats:
    """Differentiate with respect to z/L at the stations, along the last axis."""
    return np.asarray(scipy.interpolate.CubicSpline(span, values, axis=-1)(span, 1))


def normalise(shape: Floats) -> Floats:
    """Scale shapes (n, m) to a largest absolute value of 1, positive at the tip.

    Where the tip is held, the first of the largest values along the span is made positive.
    """
    size = np.abs(shape)
    largest = size.max(axis=1, keepdims=True)
    first_largest = np.argmax(size > (1.0 - 1e-6) * largest, axis=1)
    rows = np.arange(len(shape))
    deciding = np.where(
        size[:, -1] > 1e-6 * largest[:, 0], shape[:, -1], shape[rows, first_largest]
    )
    sign = np.where(deciding < 0.0, -1.0, 1.0)[:, None]
    return np.asarray(shape / largest * sign, dtype=np.float64)
