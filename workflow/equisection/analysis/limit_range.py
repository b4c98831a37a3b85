"""Range of a value's limit at vanishing cell size, from three grids on which it is known so well.

Richardson's extrapolation with order p from the two finest of three grids is

    f_0 = f_1 - (f_2 - f_1)/(r_21^p - 1),    r_21 = h_2/h_1

(Celik et al. 2008, J. Fluids Eng. 130, 078001, Eq. 6). With the order observed it is the limit of
:mod:`.grid_convergence`. An observed order far from that of the schemes says that the grids are not
in the asymptotic range. Then the limit may be anywhere between what the orders of the schemes give,
first where something is resolved by one cell and second elsewhere, and what the observed one does.
Values that iterations leave within an error widen the range.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

from equisection.analysis.grid_convergence import Convergence, grid_convergence

#: Orders of the schemes between which the limit may be.
ORDERS = (1.0, 2.0)


@dataclass(frozen=True)
class LimitRange:
    """A limit at h = 0 and its range, with the range of the observed order.

    Attributes
    ----------
    value
        Limit with the order observed for the values as they are; NaN where it is undefined.
    low, high
        Least and greatest limit over the orders and errors.
    order_low, order_high
        Least and greatest observed order (-) over the errors; NaN where none is defined.
    """

    value: float
    low: float
    high: float
    order_low: float
    order_high: float


def limit_range(
    values: tuple[float, float, float],
    sizes: tuple[float, float, float],
    errors: tuple[float, float, float] = (0.0, 0.0, 0.0),
    orders: tuple[float, ...] = ORDERS,
) -> LimitRange:
    """Return the limit of a value and its range.

    Parameters
    ----------
    values
        The value on the coarse, medium and fine grid (any unit).
    sizes
        Representative cell sizes h of these grids (any unit), descending.
    errors
        Half range within which each value is known (unit of the value).
    orders
        Orders (-) that the limit is taken with in addition to the observed one.

    Raises
    ------
    ValueError
        The sizes do not become smaller.
    """
    found, observed = [], []
    ratio = sizes[1] / sizes[2]
    for signs in itertools.product((-1, 0, 1), repeat=3):
        shifted = tuple(v + s * e for v, s, e in zip(values, signs, errors, strict=True))
        this = grid_convergence((shifted[0], shifted[1], shifted[2]), sizes)
        if this.convergence is Convergence.MONOTONIC:
            observed.append(this.order)
            found.append(this.extrapolated)
        found += [shifted[2] - (shifted[1] - shifted[2]) / (ratio**p - 1) for p in orders]
    central = grid_convergence(values, sizes)
    return LimitRange(
        central.extrapolated,
        min(found),
        max(found),
        min(observed, default=math.nan),
        max(observed, default=math.nan),
    )
