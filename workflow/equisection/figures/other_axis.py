"""Axis at the top of a panel: the speed over k*, or k* over the speed."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from numpy.typing import NDArray

from equisection.study.axes import K_STAR, SPEED, AsGiven, Axis

Floats = NDArray[np.float64]

#: Part of the axis that two ticks are apart at least, and ticks that are enough.
_APART, _ENOUGH = 0.13, 5
#: Least part of its largest value that the axis below is taken to begin at.
_BEGIN = 0.02


def as_given(table: pd.DataFrame) -> AsGiven | None:
    """Return the beam of a table with k* and speed of each run; None where one is unknown."""
    if not {K_STAR.name, SPEED.name} <= set(table.columns):
        return None
    both = table[[K_STAR.name, SPEED.name]].astype(float).dropna()
    if both.empty:
        return None
    return AsGiven(float(both[K_STAR.name].iloc[0]), float(both[SPEED.name].iloc[0]))


def add_other_axis(axes: Axes, along: Axis, given: AsGiven | None) -> None:
    """Draw what the runs have at the values of the axis below; limits must be final.

    Parameters
    ----------
    axes
        The panel.
    along
        The axis below, k* or speed; above any other nothing is drawn.
    given
        The beam as given; None draws nothing.
    """
    if given is None or along not in {K_STAR, SPEED}:
        return
    other = SPEED if along is K_STAR else K_STAR
    to_speed, to_k_star = given.speed_at, given.k_star_at
    there, back = (to_speed, to_k_star) if along is K_STAR else (to_k_star, to_speed)
    low, high = axes.get_xlim()
    low = max(low, _BEGIN * high)
    values = _spread(np.sort(there(np.array([low, high]))), back, high - axes.get_xlim()[0])
    top = axes.secondary_xaxis("top")
    top.set_xticks([float(back(value)) for value in values], [f"{value:g}" for value in values])
    top.set_xlabel(other.label, labelpad=2.5)
    top.tick_params(length=2.5, pad=1.5)


def _spread(ends: Floats, back: Callable[[float], float], width: float) -> list[float]:
    """Return round numbers between two ends, the roundest first to be chosen.

    They are apart enough on the axis below, to which ``back`` leads.
    """
    largest = 10.0 ** math.floor(math.log10(ends[1]))
    chosen: list[float] = []
    for step in (largest / 10**decade / part for decade in range(3) for part in (1, 2, 5)):
        numbers = step * np.arange(math.ceil(ends[0] / step), math.floor(ends[1] / step) + 1)
        for number in (float(n) for n in numbers if n > 0.0):
            if all(abs(back(number) - back(other)) > _APART * width for other in chosen):
                chosen.append(number)
        if len(chosen) >= _ENOUGH:
            break
    return sorted(chosen)
