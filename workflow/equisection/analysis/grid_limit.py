"""Limit of a value at vanishing cell size, with an interval, from the meshes that there are.

From three meshes with monotonic convergence of an observed order p from 0.5 to that of the scheme,
2, the limit is extrapolated with p, and the interval is the grid convergence index with the factor
of safety 1.25 (Celik, Ghia, Roache & Freitas 2008, J. Fluids Eng. 130, 078001). An order beyond the
scheme's is no better convergence: errors of opposite signs fall at different rates, or chance
decides. Up to 4 the limit is extrapolated with the order 2 then, and the factor is 3, as Roache has
it for an order that is not to be trusted (Verification and Validation in Computational Science and
Engineering, 1998; J. Fluids Eng. 133, 115501, 2011). Two meshes, which show no order, have the same
two numbers. Without convergence the limit is the finest value, give or take three times the largest
difference (Eca & Hoekstra 2014, J. Comput. Phys. 262). One mesh has no limit.

A difference within the values' own errors tells no order. Of more than three meshes one that
differs from the finest by no more is passed over, as long as three are left; what the limit and the
order that are found miss it by is added to the interval.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from equisection.analysis.grid_convergence import SAFETY, Convergence, grid_convergence

#: Order of the scheme: what is observed beyond it is chance.
FORMAL_ORDER = 2.0
#: Observed orders that are extrapolated with. Beyond them chance or round-off decides.
LEAST_ORDER, MOST_ORDER = 0.5, 4.0
#: Largest observed order that still counts as that of the scheme.
LARGEST_TRUSTED = 2.1
#: Factor of safety of two meshes, of three with an order beyond the scheme's, and of three without
#: convergence.
SAFETY_OF_TWO = SAFETY_WITHOUT_ORDER = 3.0


@dataclass(frozen=True)
class GridLimit:
    """Limit of a value at h = 0.

    Attributes
    ----------
    value, low, high
        Limit and its interval (unit of the value); NaN of one mesh.
    meshes
        Number of meshes that it rests on.
    order
        Observed order p (-); NaN where there is none.
    basis
        Origin of the interval in words.
    """

    value: float = math.nan
    low: float = math.nan
    high: float = math.nan
    meshes: int = 0
    order: float = math.nan
    basis: str = "no mesh"

    @property
    def half_width(self) -> float:
        """Half of the interval (unit of the value)."""
        return 0.5 * (self.high - self.low)


def grid_limit(
    values: Sequence[float], sizes: Sequence[float], errors: Sequence[float] | None = None
) -> GridLimit:
    """Return the limit of a value on one mesh or more.

    Parameters
    ----------
    values
        The value on each mesh, coarsest first, shape (n,). Of more than three the finest count, of
        those that differ from the finest of all by more than their errors.
    sizes
        Cell sizes h, in any unit, falling, shape (n,).
    errors
        Half-widths of the values' own intervals, apart from the mesh, shape (n,); none by default.
        They are taken to be independent of each other.
    """
    count = len(values)
    own = [0.0] * count if errors is None else list(errors)
    if not count:
        return GridLimit()
    if count == 1:
        return GridLimit(value=values[0], meshes=1, basis="one mesh, no interval")
    if count == 2:
        words = f"two meshes: order {FORMAL_ORDER:g} assumed, factor of safety {SAFETY_OF_TWO:g}"
        limit, half = _extrapolated(values, sizes, own, order=FORMAL_ORDER, safety=SAFETY_OF_TWO)
        return GridLimit(limit, limit - half, limit + half, 2, math.nan, words)
    used, passed = _three_that_tell(values, own)
    three = (values[used[0]], values[used[1]], values[-1])
    found = grid_convergence(three, (sizes[used[0]], sizes[used[1]], sizes[-1]))
    words = f"three of {count} meshes" if passed else "three meshes"
    if found.convergence is Convergence.MONOTONIC and is_credible(found.order):
        order, pair = min(found.order, FORMAL_ORDER), used[1:]
        safety = SAFETY if found.order <= LARGEST_TRUSTED else SAFETY_OF_TWO
        of_pair = ([column[one] for one in pair] for column in (values, sizes, own))
        limit, half = _extrapolated(*of_pair, order=order, safety=safety)
        slope = (values[-1] - limit) / sizes[-1] ** order
        misses = [values[one] - limit - slope * sizes[one] ** order for one in passed]
        half = math.hypot(half, max(map(abs, misses), default=0.0))
        words += (
            f": order {found.order:.1f} observed, {order:.1f} used, factor of safety {safety:g}"
        )
        return GridLimit(limit, limit - half, limit + half, 3, found.order, words)
    half = math.hypot(SAFETY_WITHOUT_ORDER * (max(three) - min(three)), own[-1])
    kind = str(found.convergence)
    if found.convergence is Convergence.MONOTONIC:
        kind = f"order {found.order:.1f}, which is chance"
    words += f", {kind}: three times their largest difference"
    return GridLimit(three[-1], three[-1] - half, three[-1] + half, 3, math.nan, words)


def _three_that_tell(
    values: Sequence[float], errors: Sequence[float]
) -> tuple[tuple[int, int, int], list[int]]:
    """Return the places of the three meshes that an order is read from, and of those between."""
    last = len(values) - 1
    differ = [
        one
        for one in range(last)
        if abs(values[one] - values[last]) > math.hypot(errors[one], errors[last])
    ]
    if len(differ) < 2:
        return (last - 2, last - 1, last), []
    coarse, medium = differ[-2:]
    return (coarse, medium, last), [
        one for one in range(coarse, last) if one not in {coarse, medium}
    ]


def is_credible(order: float) -> bool:
    """Tell whether an observed order can be that of the scheme, and not chance."""
    return LEAST_ORDER <= order <= MOST_ORDER


def _extrapolated(
    values: Sequence[float],
    sizes: Sequence[float],
    errors: Sequence[float],
    *,
    order: float,
    safety: float,
) -> tuple[float, float]:
    """Return the limit of two values of an order, and the half-width of its interval."""
    part = 1.0 / ((sizes[0] / sizes[1]) ** order - 1.0)
    change = part * (values[1] - values[0])
    own = math.hypot((1.0 + part) * errors[1], part * errors[0])
    return values[1] + change, math.hypot(safety * change, own)
