"""Judge a history of twist and deflection: settled, limit cycle, growing, or not yet known.

The same judgement serves while a run goes on, when it may answer ``undecided``, and at the
run's end, when it has to decide. In this order:

growing
    The amplitude is beyond the bound and larger than it has been. Never from a trend alone
    while the run goes on: what grows may yet saturate below the bound.
settled
    The amplitude is below what counts as an oscillation and does not grow, or it has fallen
    far and goes on falling at an undiminished rate, so that the rest is known.
limit cycle
    The amplitude has been steady over the last periods and does not creep on steadily.
at the end of the run
    The trend of the last periods decides, and the reason says so.

A run also goes on until the means are known: the heave of a released section is 3 to 8 times
slower than its pitch, and its last swings lie beneath the twist's.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from equisection.errors import ResultFileError
from equisection.signals.cycles import Array
from equisection.signals.means import Means, means
from equisection.signals.observation import Observation, observe
from equisection.signals.verdict import Criteria, Regime, Verdict

_FEWEST_SAMPLES = 8
# An oscillation has grown when it is this many times what it was at its smallest.
_GROWN = 1.1
# A rate goes on undiminished when it keeps this part of what it was one window before.
_UNDIMINISHED = 0.8
# Creep slower than this part of the steadiness, per window, is no creep.
_NEGLIGIBLE_CREEP = 0.1


def assess(
    time: ArrayLike,
    twist: ArrayLike,
    deflection: ArrayLike,
    criteria: Criteria | None = None,
    *,
    final: bool = False,
    natural_frequency: float = math.nan,
) -> Verdict:
    """Judge a history.

    Parameters
    ----------
    time : array_like, shape (n,)
        Convective time s = t V/c, increasing; 12 or more samples a period of the twist.
    twist : array_like, shape (n,)
        Twist (rad).
    deflection : array_like, shape (n,)
        Deflection (chords).
    criteria : Criteria, optional
    final : bool
        The run has ended: decide, from the trend if need be.
    natural_frequency : float
        f c/V of the pitch, for a twist that does not oscillate.

    Raises
    ------
    ResultFileError
        A value is not finite, time does not increase, or there are too few samples to judge
        at the end of a run.
    """
    criteria = Criteria() if criteria is None else criteria
    s, theta, w = _checked(time, twist, deflection)
    if s.size < _FEWEST_SAMPLES:
        if final:
            raise ResultFileError(
                f"a history of {s.size} samples cannot be judged: {_FEWEST_SAMPLES} or more are "
                "needed; let the run go on or write more often"
            )
        return Verdict("undecided", f"only {s.size} samples so far", end_time=_last(s))
    seen = observe(s, theta, w, criteria, natural_frequency)
    regime, reason = _while_running(seen)
    if regime == "undecided" and final:
        regime, reason = _by_trend(seen)
    if regime == "undecided":
        return _verdict(seen, regime, reason)
    average = means(seen)
    if not average.known and regime != "growing":
        if not final:
            reason = f"looks {regime} ({reason}), but its mean still drifts"
            regime = "undecided"
        else:
            reason += "; the mean still drifted, so it is no better than the window's average"
    return _with_means(_verdict(seen, regime, reason), average)


def _checked(
    time: ArrayLike, twist: ArrayLike, deflection: ArrayLike
) -> tuple[Array, Array, Array]:
    """Arrays of equal length, finite, with increasing time."""
    histories = {
        "time": np.asarray(time, dtype=float),
        "twist": np.asarray(twist, dtype=float),
        "deflection": np.asarray(deflection, dtype=float),
    }
    s, theta, w = histories.values()
    if s.ndim != 1 or theta.shape != s.shape or w.shape != s.shape:
        raise ValueError(
            f"time, twist and deflection have shapes {s.shape}, {theta.shape}, {w.shape}: "
            "three histories of equal length are needed"
        )
    for name, values in histories.items():
        if not np.all(np.isfinite(values)):
            i = int(np.argmin(np.isfinite(values)))
            raise ResultFileError(
                f"{name} is {values[i]} at sample {i} (s = {s[i]:g} c/V): a history must be "
                "finite; look at the run's log for what went wrong before that time"
            )
    backward = np.flatnonzero(np.diff(s) <= 0.0)
    if backward.size:
        i = int(backward[0]) + 1
        raise ResultFileError(
            f"time does not increase at sample {i}: {s[i]:g} after {s[i - 1]:g} c/V; "
            "a resumed run must drop what it repeats"
        )
    return s, theta, w


def _last(time: Array) -> float:
    return float(time[-1]) if time.size else math.nan


def _while_running(seen: Observation) -> tuple[Regime, str]:
    """Judge what is beyond doubt already."""
    criteria = seen.criteria
    reason = _beyond_bound(seen)
    if reason:
        return "growing", reason
    elapsed = float(seen.time[-1] - seen.time[0])
    if elapsed < criteria.minimal_time:
        return "undecided", f"{elapsed:.3g} c/V of the {criteria.minimal_time:g} needed so far"
    if not seen.ringing:
        if seen.half_range < math.radians(criteria.settled_amplitude_deg):
            return "settled", (
                f"the twist stayed within {_degrees(seen.half_range)} of its mean and does not "
                "oscillate"
            )
        return "undecided", "the twist does not oscillate but still moves"
    if not seen.enough:
        return "undecided", (
            f"{seen.used / 2:g} of the {criteria.periods} periods needed so far, after the "
            f"first {criteria.discard_time:g} c/V"
        )
    reason = _at_rest(seen) or _decaying(seen)
    if reason:
        return "settled", reason
    reason = _steady(seen)
    if reason:
        return "limit-cycle", reason
    return "undecided", (
        f"twist amplitude {_degrees(_last(seen.amplitude))}, changing by "
        f"{100.0 * seen.trend.change:+.2g} % over {criteria.periods} periods"
    )


def _beyond_bound(seen: Observation) -> str:
    """Reason why the motion is growing beyond the bound, or ''."""
    bound = math.radians(seen.criteria.growing_amplitude_deg)
    amplitude = seen.cycles.amplitude
    if amplitude.size >= 2:
        last, smallest = float(amplitude[-1]), float(amplitude.min())
        if last > bound and last > _GROWN * smallest:
            return (
                f"twist amplitude {_degrees(last)}, grown from {_degrees(smallest)}, is beyond "
                f"the bound of {_degrees(bound)}"
            )
    if seen.cycles.time.size < 2:
        # No oscillation: static divergence, a departure that gets faster.
        middle = float(seen.twist[seen.twist.size // 2])
        first_part = abs(middle - float(seen.twist[0]))
        last_part = abs(float(seen.twist[-1]) - middle)
        if last_part > 2.0 * bound and last_part > first_part:
            return f"the twist runs away without oscillating, to {_degrees(float(seen.twist[-1]))}"
    return ""


def _at_rest(seen: Observation) -> str:
    """Reason why the amplitude counts as none, or ''."""
    limit = math.radians(seen.criteria.settled_amplitude_deg)
    largest = float(seen.amplitude.max())
    grows = seen.trend.growth_rate > 0.0 and seen.trend.clear(seen.criteria.steadiness)
    if largest > limit or grows:
        return ""
    return f"twist amplitude {_degrees(largest)} is below {_degrees(limit)} and does not grow"


def _decaying(seen: Observation) -> str:
    """Reason why the amplitude will go on falling to nothing, or ''."""
    criteria = seen.criteria
    last, largest = float(seen.amplitude[-1]), float(seen.cycles.amplitude.max())
    early, late = seen.halves
    if last * criteria.decay_factor > largest or not (
        seen.trend.growth_rate < 0.0
        and seen.trend.clear(criteria.steadiness)
        and late.growth_rate < _UNDIMINISHED * early.growth_rate < 0.0
    ):
        return ""
    return (
        f"twist amplitude {_degrees(last)} has fallen {largest / last:.3g} times and goes on "
        f"falling at an undiminished {-100.0 * seen.trend.change:.2g} % over "
        f"{criteria.periods} periods"
    )


def _steady(seen: Observation) -> str:
    """Reason why the motion is a limit cycle, or ''."""
    criteria = seen.criteria
    if seen.spread > criteria.steadiness:
        return ""
    before, now = seen.last_two_windows
    creeps = (
        before.clear(_NEGLIGIBLE_CREEP * criteria.steadiness)
        and now.clear(_NEGLIGIBLE_CREEP * criteria.steadiness)
        and now.growth_rate / before.growth_rate > _UNDIMINISHED
    )
    if creeps:
        return ""
    return (
        f"twist amplitude {_degrees(float(seen.amplitude.mean()))} steady to "
        f"{100.0 * seen.spread:.2g} % over the last {criteria.periods} periods"
    )


def _by_trend(seen: Observation) -> tuple[Regime, str]:
    """Decide at the end of a run that showed nothing beyond doubt."""
    criteria = seen.criteria
    if not seen.ringing or seen.amplitude.size < 3:
        return _by_swings(seen)
    periods = f"{seen.used / 2:g} periods"
    trend, (_, late) = seen.trend, seen.halves
    last = float(seen.amplitude[-1])
    change = f"{100.0 * trend.change:+.2g} % over the last {periods}"
    ended = "decided by the trend at the end of the run: "
    if trend.clear(criteria.steadiness) and late.clear(0.25 * criteria.steadiness):
        if trend.growth_rate > 0.0 and late.growth_rate > 0.0:
            return "growing", f"{ended}twist amplitude {_degrees(last)}, {change}"
        if trend.growth_rate < 0.0 and late.growth_rate < 0.0:
            return "settled", f"{ended}twist amplitude {_degrees(last)} dies out, {change}"
    if float(seen.amplitude.max()) < math.radians(criteria.settled_amplitude_deg):
        return "settled", f"{ended}twist amplitude {_degrees(last)} is that of a section at rest"
    return "limit-cycle", (
        f"{ended}twist amplitude {_degrees(last)} has no clear trend ({change}), though it is "
        f"steady only to {100.0 * seen.spread:.2g} %"
    )


def _by_swings(seen: Observation) -> tuple[Regime, str]:
    """Decide from the few swings of a record with hardly a cycle in it."""
    ended = "decided at the end of a run too short to judge: "
    if seen.half_range < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", f"{ended}the twist stayed within {_degrees(seen.half_range)}"
    swing = 0.5 * np.abs(np.diff(seen.cycles.value))
    if not seen.ringing or swing.size < 2:
        return "settled", f"{ended}the twist moves without oscillating"
    first, last = float(swing[0]), float(swing[-1])
    words = f"{ended}half swings from {_degrees(first)} to {_degrees(last)}"
    if last > _GROWN * first:
        return "growing", words
    return ("settled" if first > _GROWN * last else "limit-cycle"), words


def _verdict(seen: Observation, regime: Regime, reason: str) -> Verdict:
    """Put the window's numbers beside the decision."""
    start, end = seen.window
    verdict = Verdict(
        regime,
        reason,
        start_time=start,
        end_time=end,
        twist_amplitude=seen.half_range,
        deflection_amplitude=seen.deflection_amplitude,
        frequency=seen.natural_frequency,
    )
    if not seen.ringing or not seen.used:
        return verdict
    amplitude = seen.amplitude.mean() if regime == "limit-cycle" else seen.amplitude[-1]
    return replace(
        verdict,
        periods_used=seen.used / 2,
        twist_amplitude=float(amplitude),
        frequency=1.0 / seen.period,
        growth_rate=seen.trend.growth_rate,
    )


def _with_means(verdict: Verdict, average: Means) -> Verdict:
    return replace(verdict, mean_twist=average.twist, mean_deflection=average.deflection)


def _degrees(angle: float) -> str:
    """Angle (rad) as text in degrees."""
    return f"{math.degrees(angle):.3g} deg"
