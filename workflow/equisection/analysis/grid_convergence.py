"""Observed order of convergence and grid convergence index from three grids.

The procedure of Celik, Ghia, Roache & Freitas (2008), J. Fluids Eng. 130, 078001, with index 1 for
the finest grid: e_21 = f_2 - f_1, e_32 = f_3 - f_2, r_21 = h_2/h_1, r_32 = h_3/h_2. Its Eqs. 5,

    p = |ln|e_32/e_21| + ln((r_21^p - s)/(r_32^p - s))| / ln r_21,    s = sign(e_32/e_21),

are solved here without the outer absolute value, as

    r_21^p (r_32^p - s)/(r_21^p - s) = |e_32/e_21|,

which is exact for f = f_0 + C h^p where s = 1. The left side grows with p, so that there is one
solution or none. Without one the changes of the value fall more slowly than at any positive order,
and the order is reported as undefined.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import scipy

#: Factor of safety of the index for three grids (Celik et al. 2008, Eq. 7).
SAFETY = 1.25
#: Orders looked for. A larger one tells of differences that round-off or chance decides.
SMALLEST_ORDER, LARGEST_ORDER = 1e-3, 20.0
#: Changes below this part of the largest value are none.
_NO_CHANGE = 1e-12


class Convergence(StrEnum):
    """Kind of convergence of a value with the grid."""

    MONOTONIC = "monotonic"
    OSCILLATORY = "oscillatory"  # the changes have opposite signs
    UNDEFINED = "order undefined"  # no change, or changes that do not become smaller


@dataclass(frozen=True)
class GridConvergence:
    """A value on three grids.

    Attributes
    ----------
    convergence
        Kind of convergence.
    order
        Observed order p (-); NaN where it is undefined.
    extrapolated
        Value at h = 0 (unit of the value), by Eq. 6: the limit of a monotonic convergence. For an
        oscillatory one it is computed in the same way, and is on the far side of the finest value.
    index
        Grid convergence index of the finest grid, as a part of its value (-).
    index_second_order
        Index with the formal order 2 in place of p, the larger one if p is beyond 2 (-). NaN where
        the last change is not smaller than the one before, so that nothing converges.
    """

    convergence: Convergence
    order: float
    extrapolated: float
    index: float
    index_second_order: float


def grid_convergence(
    values: tuple[float, float, float], sizes: tuple[float, float, float]
) -> GridConvergence:
    """Return observed order, extrapolated value and grid convergence index.

    Parameters
    ----------
    values
        A value on the coarse, medium and fine grid; NaN where there is none.
    sizes
        Representative cell sizes h of these grids, in any unit.

    Raises
    ------
    ValueError
        The sizes do not become smaller.
    """
    coarse, medium, fine = values
    if not sizes[0] > sizes[1] > sizes[2] > 0:
        raise ValueError(f"cell sizes {sizes}: allowed are positive ones, coarsest first")
    r_21, r_32 = sizes[1] / sizes[2], sizes[0] / sizes[1]
    e_21, e_32 = medium - fine, coarse - medium
    largest = max(map(abs, values))
    is_no_smaller = abs(e_21) >= abs(e_32) and abs(e_21) > _NO_CHANGE * largest
    second = math.nan if is_no_smaller else _index(e_21, fine, r_21, 2.0)
    if not min(abs(e_21), abs(e_32)) > _NO_CHANGE * largest:
        return GridConvergence(Convergence.UNDEFINED, math.nan, math.nan, math.nan, second)
    sign = math.copysign(1.0, e_32 / e_21)
    kind = Convergence.MONOTONIC if sign > 0 else Convergence.OSCILLATORY
    order = _order(abs(e_32 / e_21), r_21, r_32, sign)
    if math.isnan(order):
        kind = Convergence.OSCILLATORY if sign < 0 else Convergence.UNDEFINED
        return GridConvergence(kind, math.nan, math.nan, math.nan, second)
    extrapolated = float(fine - e_21 / (r_21**order - 1))
    return GridConvergence(kind, order, extrapolated, _index(e_21, fine, r_21, order), second)


def cell_size(cells: int, dimensions: int) -> float:
    """Return h = N^(-1/D), in units of the D-th root of the domain's size (Eqs. 1 and 2)."""
    return float(cells ** (-1.0 / dimensions))


def _order(ratio: float, r_21: float, r_32: float, sign: float) -> float:
    def excess(order: float) -> float:
        refined = r_21**order
        return float(refined * (r_32**order - sign) / (refined - sign)) - ratio

    if excess(SMALLEST_ORDER) >= 0 or excess(LARGEST_ORDER) <= 0:
        return math.nan
    return float(scipy.optimize.brentq(excess, SMALLEST_ORDER, LARGEST_ORDER, xtol=1e-12))


def _index(change: float, fine: float, r_21: float, order: float) -> float:
    """Return 1.25 |e_21/f_1| / (r_21^p - 1) (Eq. 7); NaN for a value of 0, which has no part."""
    return SAFETY * abs(change / fine) / (r_21**order - 1) if fine else math.nan
