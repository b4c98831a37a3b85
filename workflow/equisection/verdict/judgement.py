"""Judge a history of twist and deflection: settled, decaying, limit cycle, growing, or undecided.

The same judgement serves while a run goes on, and at the run's end. In this order:

undecided
    Nothing has moved: a body at rest in a flow that does not push it says nothing.

growing
    The amplitude is beyond the bound and larger than it has been, or the twist is gone before it
    has cycles, further than a release swings. Never from a trend alone
    while the run goes on: what grows may yet saturate below the bound.
settled
    The amplitude is below what counts as an oscillation and does not grow, or it has fallen
    far and goes on falling at an undiminished rate, so that the rest is known.
decaying
    The amplitude has fallen over two windows with no sign of a limit cycle beneath, but not that
    far yet.
limit cycle
    The amplitude has been steady over the last periods and does not creep on steadily.
at the end of the run
    The growth of the last periods decides, as the reason then states
    (equisection.verdict.end_of_run). A run that is too short, or whose growth has no sign within
    its error, is undecided.

No run is settled or decaying by a fall whose rate drifts as that of a beat
(equisection.verdict.beats): it goes on, and at its end whole beats decide or nothing.

No run is settled, decaying or in a limit cycle before its slow heave has been seen to decay
(equisection.verdict.heave). It also goes on until the means are known: the heave of a released
section is 3 to 8 times slower than its pitch, and its last swings lie beneath the twist's.

A change of a verdict here, or of its time, needs a new ``rules`` of equisection.cases.EndCriteria.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from equisection.errors import ResultFileError
from equisection.verdict.cycles import Array
from equisection.verdict.end_of_run import decide_at_end
from equisection.verdict.growth import NO_GROWTH, Growth
from equisection.verdict.heave import growing_heave, unseen_decay
from equisection.verdict.history import checked
from equisection.verdict.means import Means, means, window_means
from equisection.verdict.observation import (
    DEPARTS,
    GROWN,
    RUNS_AWAY,
    UNDIMINISHED,
    Observation,
    observe,
)
from equisection.verdict.verdict import Criteria, Regime, Verdict
from equisection.verdict.wording import change, degrees

_FEWEST_SAMPLES = 8
_UNMOVED = (
    "nothing has moved, so nothing is known: give the body a start (unsteady.start), or an "
    "incidence"
)
# The spread is counted net of noise, so noise may hide a change of the amplitude: more than
# this many times the steadiness must not be possible within the error of the trend.
_HIDDEN_CHANGE = 3.0
# An amplitude A that falls to a limit cycle A_0 slows as it comes near: with the rate
# sigma ~ 1 - (A/A_0)^n it has d ln|sigma|/d ln A = n r^n/(r^n - 1) > n for r = A/A_0 > 1, and n
# is 1 or more (2 for the cubic law). Below half of 1 there is no limit cycle beneath.
_NO_SLOWING = 0.5
# Fall of ln A between two windows from which the slowing can be told.
_FALL_TO_TELL = 0.1
# What may not be called so while the heave grows.
_BOUNDED = frozenset({"settled", "decaying", "limit-cycle"})


def assess(
    time: ArrayLike,
    twist: ArrayLike,
    deflection: ArrayLike,
    criteria: Criteria | None = None,
    *,
    final: bool = False,
    natural_frequency: float = math.nan,
    growth: Growth = NO_GROWTH,
) -> Verdict:
    """Judge a history.

    Parameters
    ----------
    time : array_like, shape (n,)
        Convective time s = t V/c, increasing; six or more samples a period of the twist.
    twist : array_like, shape (n,)
        Twist (rad).
    deflection : array_like, shape (n,)
        Deflection (chords).
    criteria : Criteria, optional
    final : bool
        The run has ended: decide, from the growth if need be.
    natural_frequency : float
        f c/V of the pitch, for a twist that does not oscillate.
    growth : Growth
        Growth of twist and deflection together (:func:`equisection.verdict.growth.growth_of`),
        for the end of a run; without it the trend of the twist's amplitude decides. One that beats
        lets no amplitude pass for a decay.

    Raises
    ------
    ResultFileError
        A value is not finite, time does not increase, or there are too few samples to judge
        at the end of a run.
    """
    criteria = Criteria() if criteria is None else criteria
    s, theta, w = checked(time, twist, deflection)
    if s.size < _FEWEST_SAMPLES:
        if final:
            raise ResultFileError(
                f"a history of {s.size} samples cannot be judged: {_FEWEST_SAMPLES} or more are "
                "needed; let the run go on or write more often"
            )
        return Verdict("undecided", f"only {s.size} samples so far", end_time=_last(s))
    seen = observe(s, theta, w, criteria, natural_frequency)
    if not seen.has_moved:
        return _verdict(seen, "undecided", _UNMOVED, growth)
    regime, reason = _while_running(seen, growth)
    if regime == "undecided" and final:
        regime, reason = decide_at_end(seen, growth)
    by_heave = False
    is_long = float(s[-1] - s[0]) >= criteria.minimal_time
    if final and (regime in _BOUNDED or (regime == "undecided" and is_long)):
        if heave := growing_heave(seen):
            regime, reason, by_heave = "growing", heave, True
    elif regime in _BOUNDED and (heave := unseen_decay(seen)):
        regime, reason = "undecided", f"looks {regime} ({reason}), but {heave}"
    if regime in {"growing", "undecided"}:
        found = replace(_verdict(seen, regime, reason, growth), heave_grows=by_heave)
        return _with_means(found, window_means(seen))
    average = means(seen)
    heave = unseen_decay(seen) if final else ""
    if heave:
        reason += f"; {heave}, which a longer run would tell"
    if not average.known:
        if not final:
            reason = f"looks {regime} ({reason}), but its mean still drifts"
            regime = "undecided"
        else:
            reason += "; the mean still drifted, so it is no better than the window's average"
    known = average.known and not heave
    return _with_means(_verdict(seen, regime, reason, growth), replace(average, known=known))


def heave_grows(
    time: ArrayLike, twist: ArrayLike, deflection: ArrayLike, natural_frequency: float
) -> bool:
    """Tell whether the heave (chords) of a history grows, whatever its twist (rad) does.

    Raises
    ------
    ResultFileError
        A value is not finite or time does not increase.
    """
    s, theta, w = checked(time, twist, deflection)
    return bool(growing_heave(observe(s, theta, w, Criteria(), natural_frequency)))


def swings_grow(time: ArrayLike, twist: ArrayLike, bound: float) -> bool:
    """Tell whether each of the last three half swings is larger than the one before.

    The last has to be beyond a bound (rad). A stable release swings from rest to about twice its
    equilibrium, and less far from then on.

    Raises
    ------
    ResultFileError
        A value is not finite or time does not increase.
    """
    s, theta, _ = checked(time, twist, np.zeros_like(time))
    criteria = Criteria(growing_amplitude_deg=math.degrees(bound))
    return observe(s, theta, np.zeros_like(s), criteria, math.nan).swings_rise


def _last(time: Array) -> float:
    return float(time[-1]) if time.size else math.nan


def _while_running(seen: Observation, growth: Growth) -> tuple[Regime, str]:
    """Judge what is beyond doubt already."""
    criteria = seen.criteria
    reason = _beyond_bound(seen)
    if reason:
        return "growing", reason
    elapsed = float(seen.time[-1] - seen.time[0])
    if elapsed < criteria.minimal_time:
        return "undecided", f"{elapsed:.3g} c/V of the {criteria.minimal_time:g} needed so far"
    if not seen.ringing:
        return _without_oscillation(seen)
    if not seen.enough:
        return "undecided", (
            f"{seen.used / 2:g} of the {criteria.periods} periods needed so far, after the "
            f"first {criteria.discard_time:g} c/V"
        )
    return _by_amplitude(seen, growth)


def _by_amplitude(seen: Observation, growth: Growth) -> tuple[Regime, str]:
    """Judge what the amplitude of the last periods tells; a fall in a beat tells nothing."""
    tests: tuple[tuple[Regime, Callable[[Observation], str]], ...] = (
        ("settled", _at_rest),
        ("settled", _decaying),
        ("decaying", _dying_out),
        ("limit-cycle", _steady),
    )
    for regime, test in tests:
        reason = test(seen)
        if reason and test in _FALLS and not growth.stays:
            return "undecided", f"looks decaying ({reason}), but {growth.drift_in_words}"
        if reason:
            return ("settled" if regime == "decaying" and seen.little_is_left else regime), reason
    return "undecided", f"twist amplitude {degrees(_last(seen.amplitude))}, {change(seen)}"


def _without_oscillation(seen: Observation) -> tuple[Regime, str]:
    """Judge a twist without an extremum in the last period and a half."""
    if seen.natural_frequency * float(seen.time[-1] - seen.time[0]) < 1.0:
        return "undecided", "less than a natural period so far"
    if seen.half_range < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", (
            f"the twist stayed within {degrees(seen.half_range)} of its mean and does not oscillate"
        )
    return "undecided", "the twist does not oscillate but still moves"


def _beyond_bound(seen: Observation) -> str:
    """Reason why the motion is growing beyond the bound, or ''."""
    bound = math.radians(seen.criteria.growing_amplitude_deg)
    amplitude = seen.cycles.amplitude
    if amplitude.size < 2:
        return _runs_away(seen, bound)
    last, smallest = float(amplitude[-1]), float(amplitude.min())
    if last > bound and last > GROWN * smallest:
        return (
            f"twist amplitude {degrees(last)}, grown from {degrees(smallest)}, is beyond "
            f"the bound of {degrees(bound)}"
        )
    return ""


def _runs_away(seen: Observation, bound: float) -> str:
    """Reason why a motion too short to have cycles has left for good, or ''.

    A stable release swings from rest to about twice its equilibrium and back, and nowhere further.
    """
    swings = seen.half_swings
    if seen.faster_by > RUNS_AWAY and swings[-1] > bound:
        return (
            f"the twist runs away without oscillating, from {degrees(float(seen.twist[0]))} to "
            f"{degrees(float(seen.twist[-1]))}"
        )
    if swings.size > 1 and swings[-1] > max(bound, DEPARTS * float(swings[:-1].max())):
        return (
            f"a half swing of {degrees(float(swings[-1]))} follows one of "
            f"{degrees(float(swings[:-1].max()))} and is beyond the bound of {degrees(bound)}"
        )
    return ""


def _at_rest(seen: Observation) -> str:
    """Reason why the amplitude counts as none, or ''."""
    limit = math.radians(seen.criteria.settled_amplitude_deg)
    largest = float(seen.amplitude.max())
    grows = seen.trend.growth_rate > 0.0 and seen.trend.clear(seen.criteria.steadiness)
    if largest > limit or grows:
        return ""
    return f"twist amplitude {degrees(largest)} is below {degrees(limit)} and does not grow"


def _decaying(seen: Observation) -> str:
    """Reason why the amplitude will go on falling to nothing, or ''."""
    criteria = seen.criteria
    last, largest = float(seen.amplitude[-1]), float(seen.cycles.amplitude.max())
    early, late = seen.halves
    if not seen.fallen or not (
        seen.trend.growth_rate < 0.0
        and seen.trend.clear(criteria.steadiness)
        and late.growth_rate < UNDIMINISHED * early.growth_rate < 0.0
    ):
        return ""
    return (
        f"twist amplitude {degrees(last)} has fallen {largest / last:.3g} times and goes on "
        f"falling at an undiminished rate, {change(seen)}"
    )


def _dying_out(seen: Observation) -> str:
    """Reason why no limit cycle lies beneath a falling amplitude, or ''."""
    if seen.before.size < seen.amplitude.size or not seen.creeps or seen.trend.growth_rate > 0.0:
        return ""
    early, late = -seen.trend_before.growth_rate, -seen.trend.growth_rate
    fall = 0.5 * (early + late) * seen.window_distance
    slowest = late - seen.trend.standard_error
    if fall < _FALL_TO_TELL or math.log(early / slowest) > _NO_SLOWING * fall:
        return ""
    return (
        f"twist amplitude {degrees(float(seen.amplitude[-1]))} dies out at a rate that does not "
        f"slow with it, {change(seen)}"
    )


def _steady(seen: Observation) -> str:
    """Reason why the motion is a limit cycle, or ''."""
    criteria = seen.criteria
    possible = (abs(seen.trend.growth_rate) + seen.trend.standard_error) * seen.trend.span
    if seen.spread > criteria.steadiness or possible > _HIDDEN_CHANGE * criteria.steadiness:
        return ""
    twice_as_long = seen.before.size >= seen.amplitude.size
    if seen.spread > seen.negligible_change and (seen.creeps or not twice_as_long):
        return ""
    return (
        f"twist amplitude {degrees(float(seen.amplitude.mean()))} steady to "
        f"{100.0 * seen.spread:.2g} % over the last {criteria.periods} periods"
    )


# Tests by which a run ends while its twist still swings, which a beat passes in its falling half.
_FALLS = (_decaying, _dying_out)


def _verdict(seen: Observation, regime: Regime, reason: str, growth: Growth) -> Verdict:
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
        turns=int(seen.cycles.time.size),
    )
    if not seen.ringing or not seen.used:
        return verdict
    amplitude = seen.amplitude.mean() if regime == "limit-cycle" else seen.amplitude[-1]
    return replace(
        verdict,
        periods_used=seen.used / 2,
        twist_amplitude=float(amplitude),
        frequency=1.0 / seen.period,
        growth=_of_amplitude(seen) if math.isnan(growth.rate) else growth,
    )


def _of_amplitude(seen: Observation) -> Growth:
    """Growth of the twist's amplitude, where there is none of twist and deflection together."""
    return Growth(
        rate=seen.trend.growth_rate,
        standard_error=seen.trend.standard_error,
        frequency=1.0 / seen.period,
        start=seen.window[0],
        end=seen.window[1],
        periods=seen.used // 2,
        by_amplitude=True,
    )


def _with_means(verdict: Verdict, average: Means) -> Verdict:
    return replace(
        verdict,
        mean_twist=average.twist,
        mean_deflection=average.deflection,
        mean_known=average.known,
    )
