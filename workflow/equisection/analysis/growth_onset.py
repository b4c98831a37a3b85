"""Onset from the growth rates of the runs on both sides of it, with an interval.

A straight line through the rates sigma over x = ln(k*), or the logarithm of the speed, weighted by
their standard errors, is zero at x_0 = -a/b. The ends of the interval are the x at which the line,
within its error, can still be zero: the roots of

    (a + b x)^2 = w (V_aa + 2 V_ab x + V_bb x^2),

with the variances V of the line (Fieller, J. R. Stat. Soc. B 16, 1954). w is the square of the
normal deviate z of a two-sided 95 %. Where the rates scatter about the line by more than their
errors tell, which a curve does too, it is t^2 chi^2/(n - 2) with Student's t. The interval ends at
the latest at the runs on both sides whose own growth has its sign beyond doubt. It holds the errors
of the rates and of the line, not that of the flow solver.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import scipy
from numpy.typing import NDArray

from equisection.results.unsteady_result import Regime
from equisection.study.axes import Axis

Floats = NDArray[np.float64]

#: Runs on each side of the change of sign that the line is drawn through, the nearest ones.
A_SIDE = 2
#: Two-sided confidence of the interval (-).
CONFIDENCE = 0.95
#: Columns of a summary that has growth rates with their errors.
HAS = frozenset({"growth_rate", "growth_standard_error", "growth_low", "growth_high"})


@dataclass(frozen=True)
class GrowthOnset:
    """Onset where the growth rate is zero; NaN where the rates do not tell.

    Attributes
    ----------
    value
        Value on the axis.
    low, high
        Ends of its interval, NaN where it has no end.
    runs
        Number of runs that it is drawn from.
    """

    value: float = math.nan
    low: float = math.nan
    high: float = math.nan
    runs: int = 0

    def within(self, sides: Floats) -> GrowthOnset:
        """Return it with an interval that ends at the latest at sides of it, of shape (0 to 2,)."""
        below, above = sides[sides <= self.value], sides[sides >= self.value]
        return replace(
            self,
            low=float(np.nanmax([self.low, *below])) if below.size else self.low,
            high=float(np.nanmin([self.high, *above])) if above.size else self.high,
        )


def onset_by_growth(runs: pd.DataFrame, axis: Axis) -> GrowthOnset:
    """Return the onset of the runs of one sweep.

    Parameters
    ----------
    runs
        Lines of ``comparison/summary.csv`` of one model along the axis; one from before it had
        standard errors tells no onset. Those that have failed, and
        those without a growth rate or its standard error, are left out; undecided ones count, whose
        rates say most.
    axis
        The axis, with the side of the onset on which a beam is stable.
    """
    if not set(runs.columns) >= HAS:
        return GrowthOnset()
    table = runs[runs["regime"] != Regime.FAILED].sort_values(
        axis.name, key=axis.stability, ascending=False
    )
    names = (axis.name, "growth_rate", "growth_standard_error", "growth_low", "growth_high")
    numbers = table[list(names)].to_numpy(dtype=float).T
    value, rate, error, low, high = numbers[:, np.isfinite(numbers).all(axis=0) & (numbers[2] > 0)]
    unstable = np.flatnonzero(rate > 0.0)
    if not unstable.size or unstable[0] == 0:
        return GrowthOnset()
    first = int(unstable[0])
    near = slice(max(first - A_SIDE, 0), first + A_SIDE)
    found = zero_of_line(value[near], rate[near], error[near])
    # the nearest runs of which the sign is clear
    surely_unstable = value[first:][low[first:] > 0.0][:1]
    surely_stable = value[:first][high[:first] < 0.0][-1:]
    sides = np.concatenate((surely_unstable, surely_stable))
    within = sides if sides.size == 2 else value[near]
    if not within.min() <= found.value <= within.max():  # a curve
        two = slice(first - 1, first + 1)
        found = zero_of_line(value[two], rate[two], error[two])
    return found.within(sides)


def zero_of_line(value: Floats, rate: Floats, error: Floats) -> GrowthOnset:
    """Return where the weighted line through growth rates is zero.

    Parameters
    ----------
    value
        k* or speed, above 0, shape (n,), two or more.
    rate, error
        Growth rates and their standard errors (V/c), shape (n,).
    """
    middle = float(np.mean(np.log(value)))
    x = np.log(value) - middle
    basis = np.stack((np.ones_like(x), x), axis=1) / error[:, None]
    matrix = basis.T @ basis
    a, b = np.linalg.solve(matrix, basis.T @ (rate / error))
    left = (rate - a - b * x) / error
    free = value.size - 2
    share = 0.5 + 0.5 * CONFIDENCE
    width = float(scipy.special.ndtri(share)) ** 2
    if free:
        width = max(width, float(scipy.special.stdtrit(free, share) ** 2 * (left @ left) / free))
    variance = width * np.linalg.inv(matrix)
    with np.errstate(over="ignore", divide="ignore"):  # of a level line the zero is far away
        zero = float(np.exp(middle - a / b))
        square = b**2 - variance[1, 1]
        if square <= 0.0:  # the line may be level
            return GrowthOnset(zero, runs=value.size)
        half = a * b - variance[0, 1]
        root = math.sqrt(max(half**2 - square * (a**2 - variance[0, 0]), 0.0))
        low, high = np.exp(middle + np.sort((np.array([-root, root]) - half) / square))
    low, high = (float(end) if 0.0 < end < math.inf else math.nan for end in (low, high))
    return GrowthOnset(zero, low, high, value.size)
