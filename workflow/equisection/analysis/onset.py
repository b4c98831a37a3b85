"""Onset of the instability in a sweep, and the points to run next to know it better.

A section is unstable below an onset over k* and stable above it: k* is a stiffness over a dynamic
pressure. Over speed it is the other way round. On the way from the stable side the *first* onset
that is met counts, so the bracket over k* is

    unstable = the highest k* that is unstable,
    stable   = the lowest stable k* above it.

Every k* above the bracket is then stable (or failed). A sequence that is not monotone, say
unstable, stable, unstable, stable, gives the bracket of its upper change; stable k* further
down are islands and do not count.

A failed run is neither, nor is an undecided one: they are left out. Inside the bracket they are
named, since only repeating the one, or a longer run of the other, can narrow that bracket.

A side of the bracket whose growth does not have the sign of that side within its error is named
too. And the growth rates of the runs next to their change of sign give the onset with an interval
(:mod:`equisection.analysis.growth_onset`).

With further axes (the incidence) there is a bracket for each of their values.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple, dataclass

import numpy as np
import pandas as pd

from equisection.analysis.growth_onset import HAS, onset_by_growth
from equisection.results.unsteady_result import STABLE, UNKNOWN, Regime
from equisection.study.axes import (
    K_STAR,
    AsGiven,
    Axis,
    Point,
    axes_among,
    onset_axis,
    onset_axis_among,
)
from equisection.study.plan import STRIDE

_SIGNIFICANT_DIGITS = 4


@dataclass(frozen=True)
class OnsetBracket:
    """Bracket of the onset of instability along an axis.

    Attributes
    ----------
    stable : float
        Value nearest to the onset on its stable side; NaN if no run there is stable.
    unstable : float
        Unstable value nearest to the stable side; NaN if no run is unstable.
    failed : tuple of float
        Values of failed runs inside the bracket (or beyond its known side if it is open).
    undecided : tuple of float
        Those of undecided runs there.
    islands : tuple of float
        Stable values beyond ``unstable``: the sequence is not monotone.
    """

    stable: float
    unstable: float
    failed: tuple[float, ...] = ()
    islands: tuple[float, ...] = ()
    undecided: tuple[float, ...] = ()

    @property
    def closed(self) -> bool:
        """Tell whether both sides are known."""
        return not (math.isnan(self.stable) or math.isnan(self.unstable))

    @property
    def relative_width(self) -> float:
        """abs(stable - unstable)/unstable; NaN if open."""
        return abs(self.stable - self.unstable) / self.unstable

    @property
    def unknown(self) -> tuple[float, ...]:
        """Values inside that were run and say nothing."""
        return tuple(sorted({*self.failed, *self.undecided}))


def is_unstable(regime: str, twist_amplitude_deg: float, threshold_deg: float) -> bool | None:
    """Tell whether a run is unstable; None for a failed or undecided run, which is neither.

    Parameters
    ----------
    regime : str
        One of :class:`equisection.results.unsteady_result.Regime`.
    twist_amplitude_deg : float
        Twist amplitude (deg), which decides for a limit cycle.
    threshold_deg : float
        Limit cycles above this amplitude (deg) are unstable; those below are a residue of
        the flow's own unsteadiness. NaN amplitudes count as above.
    """
    if regime in UNKNOWN:
        return None
    if regime == Regime.LIMIT_CYCLE:
        return not twist_amplitude_deg <= threshold_deg
    if regime in STABLE or regime == Regime.GROWING:
        return regime not in STABLE
    allowed = ", ".join(f"'{one}'" for one in Regime)
    raise ValueError(f"regime {regime!r} is not known; allowed are {allowed}")


def onset_bracket(
    values: Sequence[float],
    regimes: Sequence[str],
    twist_amplitude_deg: Sequence[float] | None = None,
    threshold_deg: float = 0.5,
    axis: Axis = K_STAR,
) -> OnsetBracket:
    """Bracket the onset of one model.

    Parameters
    ----------
    values : sequence of float, shape (n,)
        Values of the runs on the axis, in any order. Of one that was run twice the unstable run
        counts.
    regimes : sequence of str, shape (n,)
        Their regimes, see `is_unstable`.
    twist_amplitude_deg : sequence of float, shape (n,), optional
        Their twist amplitudes (deg); without them every limit cycle is unstable.
    threshold_deg : float
        Amplitude (deg) above which a limit cycle is unstable.
    axis : Axis
        Axis, with the side of the onset on which a beam is stable.
    """
    amplitudes = [math.nan] * len(values) if twist_amplitude_deg is None else twist_amplitude_deg
    states = [
        (float(value), is_unstable(regime, amplitude, threshold_deg))
        for value, regime, amplitude in zip(values, regimes, amplitudes, strict=True)
    ]
    towards = axis.stability
    unstable = {value for value, state in states if state is True}
    stable = {value for value, state in states if state is False} - unstable
    last = max(unstable, key=towards, default=math.nan)
    above = stable if not unstable else {v for v in stable if towards(v) > towards(last)}
    first = min(above, key=towards, default=math.nan)
    low = -math.inf if math.isnan(last) else towards(last)
    high = math.inf if math.isnan(first) else towards(first)
    inside = {
        name: {
            float(value) for value, regime in zip(values, regimes, strict=True) if regime == name
        }
        - unstable
        - stable
        for name in UNKNOWN
    }
    failed, undecided = (
        tuple(sorted(value for value in inside[name] if low < towards(value) < high))
        for name in (Regime.FAILED, Regime.UNDECIDED)
    )
    return OnsetBracket(first, last, failed, tuple(sorted(stable - above)), undecided)


def refinement_points(bracket: OnsetBracket, tolerance: float, count: int = 1) -> list[float]:
    """Give the values to run next: ``count`` values that divide the bracket evenly.

    Parameters
    ----------
    bracket : OnsetBracket
    tolerance : float
        Relative width abs(stable - unstable)/unstable that is narrow enough (-).
    count : int
        Number of runs at a time.

    Returns
    -------
    list of float
        Rising values of four significant digits, so that they name cases; those that failed
        before, or were undecided, are left out. Empty when the bracket is open or narrow enough.
    """
    if not bracket.closed or bracket.relative_width <= tolerance:
        return []
    low, high = sorted((bracket.unstable, bracket.stable))
    middle = 0.5 * (low + high)
    # Each run that says nothing may be in the way of one division; the next finer goes around it.
    for parts in range(count + 1, count + 2 + len(bracket.unknown)):
        step = (high - low) / parts
        points = {_rounded(low + i * step) for i in range(1, parts)}
        points -= set(bracket.unknown)
        inside = [value for value in points if low < value < high]
        if inside:
            return sorted(sorted(inside, key=lambda value: abs(value - middle))[:count])
    return []


def points_beyond(
    bracket: OnsetBracket,
    values: Sequence[float],
    given: tuple[float, float],
    reach: float,
    count: int = 1,
    *,
    axis: Axis = K_STAR,
    highest: float = math.inf,
) -> list[float]:
    """Give the values to run next beyond the ends of a sweep without an onset inside.

    Parameters
    ----------
    bracket : OnsetBracket
        An open one; of one that is closed, or of a sweep in which all failed, nothing is given.
    values : sequence of float
        Values run so far.
    given : tuple of float
        Lowest and highest value of the sweep as it was given.
    reach : float
        Factor on these that bounds the search (-).
    count : int
        Number of runs at a time.
    axis : Axis
        Axis, with the side of the onset on which a beam is stable.
    highest : float
        Value above which nothing may be run.

    Returns
    -------
    list of float
        Rising values of four significant digits; empty at the end of the search.
    """
    if math.isnan(bracket.stable) == math.isnan(bracket.unstable):
        return []
    towards = "stable" if math.isnan(bracket.stable) else "unstable"
    upwards = (towards == "stable") == (axis.stable == "above")
    stride = STRIDE if upwards else 1.0 / STRIDE
    last = max(values) if upwards else min(values)
    bound = min(given[1] * reach, highest) if upwards else given[0] / reach
    found = []
    for _ in range(count):
        last = _rounded(last * stride)
        # four digits of a value, and strides of 1.26 for a third of a factor of two, differ so far
        if (last > bound * 1.002) if upwards else (last < bound / 1.002):
            break
        found.append(last)
    return sorted(found)


def _rounded(value: float) -> float:
    """Round to the digits that a case's name carries."""
    return float(f"{value:.{_SIGNIFICANT_DIGITS}g}")


def bracket_of(summary: pd.DataFrame) -> OnsetBracket:
    """Bracket the onset of the one model of a summary, at one value on each further axis."""
    axis = onset_axis_among(summary.columns)
    return onset_bracket(
        summary[axis.name].tolist(),
        summary["regime"].tolist(),
        summary["twist_amplitude_deg"].tolist(),
        axis=axis,
    )


def next_points(
    summary: pd.DataFrame,
    tolerance: float,
    count: int,
    *,
    given: tuple[float, float] = (math.nan, math.nan),
    reach: float = 1.0,
    highest: float = math.inf,
) -> list[Point]:
    """Return the points to run next of the one model of a summary.

    They are inside each bracket, or beyond the ends of a sweep without one.

    Parameters
    ----------
    summary
        ``comparison/summary.csv``.
    tolerance, count
        As of :func:`refinement_points`.
    given, reach, highest
        As of :func:`points_beyond`.
    """
    axis = onset_axis_among(summary.columns)
    points = []
    for _, fixed, runs in sweeps(summary):
        bracket, values = bracket_of(runs), runs[axis.name].tolist()
        points += [
            Point.at({**fixed, axis: value})
            for value in refinement_points(bracket, tolerance, count)
            or points_beyond(bracket, values, given, reach, count, axis=axis, highest=highest)
        ]
    return points


def onset_table(summary: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/onset.csv``: the bracket of each model of a summary that has runs.

    Its columns are the model, the values on the further axes of the study, the sides of the bracket
    (``k_star_stable``, ``k_star_unstable``), ``failed_inside``, ``stable_below``,
    ``undecided_inside``, ``in_doubt`` and the onset by the growth rates with its interval
    (``k_star_growth``, ``k_star_growth_low``, ``k_star_growth_high``) from ``growth_runs`` runs.
    """
    axes = axes_among(summary.columns)
    axis = onset_axis(axes)
    rows = []
    for model, fixed, runs in sweeps(summary):
        bracket = bracket_of(runs)
        by_growth = onset_by_growth(runs, axis)
        rows.append(
            {
                "model": model,
                **{further.name: value for further, value in fixed.items()},
                f"{axis.name}_stable": bracket.stable,
                f"{axis.name}_unstable": bracket.unstable,
                "failed_inside": _in_words(bracket.failed),
                "stable_below": _in_words(bracket.islands),
                "undecided_inside": _in_words(bracket.undecided),
                "in_doubt": _in_words(sides_in_doubt(bracket, runs, axis)),
                **dict(zip(_by_growth(axis), astuple(by_growth), strict=True)),
            }
        )
    further = (one.name for one in axes if one is not axis)
    sides = (f"{axis.name}_stable", f"{axis.name}_unstable")
    words = ("failed_inside", "stable_below", "undecided_inside", "in_doubt")
    return pd.DataFrame(rows, columns=["model", *further, *sides, *words, *_by_growth(axis)])


def _in_words(values: Iterable[float]) -> str:
    return " ".join(f"{value:g}" for value in values)


def _by_growth(axis: Axis) -> tuple[str, ...]:
    """Names of the columns of an onset by growth rates."""
    return (*(f"{axis.name}_growth{end}" for end in ("", "_low", "_high")), "growth_runs")


def sides_in_doubt(bracket: OnsetBracket, runs: pd.DataFrame, axis: Axis) -> list[float]:
    """Return the sides of a bracket that the growth of their runs does not bear out.

    The interval of the growth rate holds zero, or is on the other side of it, or is not known. A
    run without an oscillation has no growth rate, and leaves no such doubt.
    """
    found: list[float] = []
    if not set(runs.columns) >= HAS:
        return found
    for value, is_stable in ((bracket.unstable, False), (bracket.stable, True)):
        for _, run in runs[axis.same(runs[axis.name], value)].iterrows():
            low, high = float(run["growth_low"]), float(run["growth_high"])
            bears_out = high < 0.0 if is_stable else low > 0.0
            if np.isfinite(run["growth_rate"]) and not bears_out and value not in found:
                found.append(value)
    return sorted(found)


def sweeps(summary: pd.DataFrame) -> Iterator[tuple[str, dict[Axis, float], pd.DataFrame]]:
    """Give model, values on the further axes, and runs of each sweep along the onset's axis."""
    axes = axes_among(summary.columns)
    further = [axis for axis in axes if axis is not onset_axis(axes)]
    by = ["model", *(axis.name for axis in further)]
    for key, runs in summary.groupby(by, sort=False):
        model, *values = key
        yield str(model), dict(zip(further, map(float, values), strict=True)), runs


def with_speeds(onset: pd.DataFrame, given: AsGiven) -> pd.DataFrame:
    """Return the brackets over k* with their speeds, or those over speed with their k*.

    The polar is taken to be the same at that speed, whose Reynolds number is another.

    Parameters
    ----------
    onset
        :func:`onset_table`.
    given
        The beam as given.
    """
    added = {}
    for side in ("stable", "unstable"):
        if f"k_star_{side}" in onset:
            added[f"speed_{side}"] = given.speed_at(onset[f"k_star_{side}"])
        else:
            added[f"k_star_{side}"] = given.k_star_at(onset[f"speed_{side}"])
    return onset.assign(k_star_given=given.k_star, **added)
