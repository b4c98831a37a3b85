"""Trailing vortices between slip walls: the images of a rectangular channel, summed.

Cross-section of the channel, plate on the line y = 0, position zeta = z + i y. A slip wall
mirrors a vortex with its sense of rotation reversed. Floor and ceiling at y = -H/2, H/2 repeat a
vortex of the plane y = 0 at y = n H with the sign (-1)^n; a pair of side walls a distance W apart
mirrors it at each wall, which together repeats vortex and mirror image with the period 2 W.
The velocity of a vortex of strength gamma and of its repetitions is

    u_y + i u_z = gamma/(2 pi) K(zeta),   K(zeta) = sum_m sum_n (-1)^n / (zeta - 2 m W - i n H).

Either sum has a closed form (partial fractions of cot and 1/sin, Abramowitz and Stegun 4.3.91
and, at imaginary argument, 4.3.93), and the other one then converges exponentially:

    columns   sum_n (-1)^n / (x - i n H)  =  (pi/H) / sinh(pi x/H),
    rows      sum_m 1 / (x - 2 m W)       =  (pi/2W) cot(pi x/2W).

Columns are summed when the channel is wider than high, rows otherwise: twelve at most for 1e-16.
(The double sum is the Jacobi function (k/W) cs(k zeta/W), with the periods 2 k = 2 W and
2 k' = H in the scale k/W.) Without walls K = 1/zeta, without side walls the column at zeta,
without floor and ceiling the row at zeta.

Only the trailing vortices are imaged. The images of the bound vortex in floor and ceiling belong
to the section: they are inside a section polar that was computed in the same channel. Those in
the side walls lie on the line of the bound vortex and induce nothing there.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Complexes = NDArray[np.complex128]

_NEGLIGIBLE_EXPONENT = 38.0
"""exp(-38) = 3e-17: what is beyond does not change a double."""


def lattice_kernel(zeta: ArrayLike, width: float | None, height: float | None) -> Complexes:
    """Kernel K (1/m) of a vortex and its repetitions; 1/zeta without walls.

    Parameters
    ----------
    zeta
        Position z + i y (m) relative to the vortex, any shape.
    width
        W (m), distance of the side walls; the vortices repeat with the period 2 W. None: no
        second side wall.
    height
        H (m), distance of floor and ceiling. None: neither.
    """
    position = np.asarray(zeta, dtype=np.complex128)
    if width is None:
        return 1.0 / position if height is None else _column(position, height)
    if height is None:
        return _row(position, width)
    if width >= height:
        return _sum_of_columns(position, width, height)
    return _sum_of_rows(position, width, height)


def _column(zeta: Complexes, height: float) -> Complexes:
    argument = np.pi * zeta / height
    side = np.where(argument.real < 0, -1.0, 1.0)
    decay: Complexes = np.exp(-side * argument)  # 1/sinh from its decaying side: no overflow
    return 2 * np.pi / height * side * decay / (1.0 - decay**2)


def _row(zeta: Complexes, width: float) -> Complexes:
    tangent: Complexes = np.tan(0.5 * np.pi * zeta / width)
    return 0.5 * np.pi / width / tangent


def _sum_of_columns(zeta: Complexes, width: float, height: float) -> Complexes:
    nearest = zeta - 2 * width * np.round(zeta.real / (2 * width))
    count = 1 + math.ceil(_NEGLIGIBLE_EXPONENT * height / (2 * np.pi * width))
    total = _column(nearest, height)
    for m in range(1, count + 1):
        total = total + _column(nearest - 2 * m * width, height)
        total = total + _column(nearest + 2 * m * width, height)
    return total


def _sum_of_rows(zeta: Complexes, width: float, height: float) -> Complexes:
    count = 1 + math.ceil(_NEGLIGIBLE_EXPONENT * width / (np.pi * height))
    total = _row(zeta, width)
    for n in range(1, count + 1):
        pair = _row(zeta - 1j * n * height, width) + _row(zeta + 1j * n * height, width)
        total = total + (-1) ** n * pair
    return total
