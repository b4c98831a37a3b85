"""Decide at the end of a run by the growth of its last periods, or say that it does not tell.

A release rings in more motions than one, so its first periods may decay where the motion grows in
the end. A run is judged from four periods after the release on. The growth that is fitted to twist
and deflection together decides by its interval, the trend of the twist's amplitude where there is
no such fit.
"""

from __future__ import annotations

import math

import numpy as np

from equisection.verdict.cycles import Array, find_cycles
from equisection.verdict.growth import DECISIVE_PERIODS, Growth
from equisection.verdict.observation import DEPARTS, GROWN, RUNS_AWAY, UNDIMINISHED, Observation
from equisection.verdict.verdict import Regime
from equisection.verdict.wording import change, degrees

_AT_THE_END = "decided by the trend at the end of the run: "
# A trend has stalled when the last half of the window keeps less than this part of its rate.
_STALLED = 0.3
# Turns of an amplitude that has been through a whole beat, and through two.
_WHOLE_BEAT, _TWO_BEATS = 3, 5
# Windows before that of a growth in each of which a beating motion was as large.
_WINDOWS_BEFORE = 3
# With fewer extrema the swing from the release to the first is needed to compare with.
_FEWEST_EXTREMA = 3


def decide_at_end(seen: Observation, growth: Growth) -> tuple[Regime, str]:
    """Decide at the end of a run that showed nothing beyond doubt.

    A growth whose interval has one sign makes the run growing or decaying, and a decaying one that
    has fallen far enough settled. Without one it is a limit cycle if its amplitude is steady, or
    has come back to what it was for twice as long as it is judged or after a whole beat, or
    stalls. What is none of these is undecided, as is a growth in a beat that was as large before.

    Parameters
    ----------
    seen
        The history.
    growth
        Growth of twist and deflection together. One that beats decides nothing but that the motion
        has outgrown its beats.
    """
    samples = seen.time.size  # the first may be a sample after the release
    elapsed = float(seen.time[-1] - seen.time[0]) * samples / (samples - 1)
    if elapsed < seen.criteria.minimal_time:
        return _too_short(seen, elapsed)
    if not seen.ringing or seen.amplitude.size < 3:
        return _by_swings(seen)
    if not growth.decides and seen.used < 2 * DECISIVE_PERIODS:
        return "undecided", (
            f"too short to be judged: {seen.used / 2:g} of the {DECISIVE_PERIODS} periods needed "
            f"after the first {seen.criteria.discard_time:g} c/V; raise the duration"
        )
    if growth.beats and not _has_outgrown(seen, growth):
        return _in_a_beat(seen, growth)
    is_growth = growth.decides and growth.sign > 0
    if is_growth and growth.may_beat and _was_as_large(seen, growth):
        return "undecided", (
            f"{_between(seen)} beats, and was as large in each of {_WINDOWS_BEFORE} windows before "
            f"that of its {growth.words}: a longer run would tell"
        )
    return _by_growth(seen, growth)


def _too_short(seen: Observation, elapsed: float) -> tuple[Regime, str]:
    """Decide from a record of a time (c/V) in which only what runs away is told."""
    if seen.faster_by > RUNS_AWAY:
        return "growing", f"{_AT_THE_END}{_leaves(seen)}"
    if seen.swings_rise:
        return "growing", f"{_AT_THE_END}{_rising(seen)}"
    return "undecided", (
        f"too short to be judged: {elapsed:.3g} c/V of the {seen.criteria.minimal_time:g} "
        "needed; raise the duration"
    )


def _by_growth(seen: Observation, growth: Growth) -> tuple[Regime, str]:
    """Decide by the sign of a growth, or by an amplitude that has none."""
    last = float(seen.amplitude[-1])
    amplitude = f"twist amplitude {degrees(last)}"
    by = f"{growth.words}, {change(seen)}" if growth.decides else change(seen)
    stalls = _stalls(seen)
    direction = growth.sign if growth.decides and not stalls else _direction(seen)
    if direction > 0:
        slowing = seen.halves[1].growth_rate < UNDIMINISHED * seen.halves[0].growth_rate
        rate = ", at a falling rate" if slowing else ""
        return "growing", f"{_AT_THE_END}{amplitude} grows, {by}{rate}"
    if last < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", f"{_AT_THE_END}{amplitude} is that of a section at rest"
    if direction < 0:
        if seen.fallen:
            return "settled", f"{_AT_THE_END}{amplitude} dies out, {by}"
        return "decaying", f"{_AT_THE_END}{amplitude} decays, {by}"
    words = f"{amplitude} has no clear trend ({by}), and its spread is {100.0 * seen.spread:.2g} %"
    if seen.spread <= seen.criteria.steadiness or stalls or _comes_back(seen, growth):
        return "limit-cycle", f"{_AT_THE_END}{words}"
    return "undecided", f"{words}: a longer run would tell"


def _has_outgrown(seen: Observation, growth: Growth) -> bool:
    """Tell whether a motion that grows has become larger than in any beat before."""
    before = seen.since_transient[: -seen.amplitude.size // 2]
    return growth.rate > 0.0 and bool(
        seen.amplitude[-1] > GROWN * before.max(initial=seen.amplitude[0])
    )


def _in_a_beat(seen: Observation, growth: Growth) -> tuple[Regime, str]:
    """Decide from a record in which the motion beats: by whole beats, or not at all.

    A beat has been whole when the amplitude has turned three times, at a top, a bottom and a top
    or the other way round. The last of them must have grown beyond none of its kind: beats of a
    slow growth rise little from one to the next.
    """
    words = f"{_between(seen)} beats ({growth.drift_in_words})"
    turns = _turns(seen)
    if turns.size >= _WHOLE_BEAT and turns[-1] <= GROWN * turns[-3::-2].min():
        return "limit-cycle", f"{_AT_THE_END}{words}, and comes back after a whole beat"
    return "undecided", f"{words}: whole beats would tell what lasts of it; raise the duration"


def _was_as_large(seen: Observation, growth: Growth) -> bool:
    """Tell whether a motion that beats was as large before the window of its growth.

    It was so in each of several windows, over two beats or more, in which such a growth would show.
    """
    length = growth.end - growth.start
    if math.exp(growth.rate * _WINDOWS_BEFORE * length) < GROWN or _turns(seen).size < _TWO_BEATS:
        return False
    at, amplitude = seen.time_since_transient, seen.since_transient
    windows = np.floor((growth.end - at) / length)
    largest = [amplitude[windows == one].max(initial=0.0) for one in range(1 + _WINDOWS_BEFORE)]
    return bool(min(largest[1:]) >= largest[0])


def _turns(seen: Observation) -> Array:
    """Return the amplitudes (rad) at which the twist's amplitude turns."""
    return find_cycles(seen.time_since_transient, seen.since_transient).value


def _between(seen: Observation) -> str:
    """Return the range of the twist's amplitude in words."""
    amplitude = seen.since_transient
    ends = f"{degrees(float(amplitude.min()))} to {degrees(float(amplitude.max()))}"
    return f"the twist's amplitude of {ends}"


def _comes_back(seen: Observation, growth: Growth) -> bool:
    """Tell whether an amplitude that is modulated goes on like that, in its second window or more.

    The waves of a fit leave such a modulation, or it would be a growth whose sign is not told.
    """
    return not growth.decides and seen.before.size >= seen.amplitude.size


def _stalls(seen: Observation) -> bool:
    """Tell whether an amplitude changes clearly, and in the last half of the window no more."""
    return not seen.creeps and seen.trend.clear(0.0) and _slackens(seen)


def _slackens(seen: Observation) -> bool:
    """Tell whether the last half of the window surely keeps little of the rate of all of it."""
    rate, late = seen.trend.growth_rate, seen.halves[1]
    lately = math.copysign(late.growth_rate, rate * late.growth_rate) + 2.0 * late.standard_error
    return lately < _STALLED * abs(rate)


def _direction(seen: Observation) -> int:
    """Sign of a clear trend of the amplitude; 0 if there is none.

    A modulated amplitude rises and falls, but it comes back to where it was before, so a trend
    has to reach beyond that. Growth at a rate that does not fall counts in any case: what grows
    out of the ringing of the release may be smaller than that was.
    """
    steadiness = seen.criteria.steadiness
    rate, last = seen.trend.growth_rate, float(seen.amplitude[-1])
    if seen.creeps:
        return int(np.sign(rate))
    if _slackens(seen):
        return 0
    if not seen.trend.clear(steadiness):
        return int(_leaves_all_behind(seen))
    if rate > 0.0:
        early, late = seen.halves
        undiminished = early.clear(0.0) and late.growth_rate >= early.growth_rate > 0.0
        return int(undiminished or last > (1.0 + steadiness) * seen.long_before.max(initial=0.0))
    return -int(last < (1.0 - steadiness) * seen.long_before.min(initial=math.inf))


def _leaves_all_behind(seen: Observation) -> bool:
    """Tell whether an amplitude has grown beyond all before, though at no steady rate."""
    middle = seen.amplitude.size // 2
    before = max(seen.amplitude[: middle + 1].max(), seen.long_before.max(initial=0.0))
    return bool(seen.amplitude[-1] > GROWN * before)


def _by_swings(seen: Observation) -> tuple[Regime, str]:
    """Decide from a record with hardly a cycle in it, or that has ceased to oscillate."""
    if seen.half_range < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", f"{_AT_THE_END}the twist stayed within {degrees(seen.half_range)}"
    departure = _departure(seen)
    if departure:
        return "growing", f"{_AT_THE_END}{departure}"
    if _creeps_to_rest(seen):
        return "decaying", f"{_AT_THE_END}the twist comes to rest ever more slowly"
    moves = f"the twist still moves, within {degrees(seen.half_range)}"
    return "undecided", f"too few periods to be judged, and {moves}; raise the duration"


def _creeps_to_rest(seen: Observation) -> bool:
    """Tell whether a twist goes one way, ever more slowly, for longer than a period of its own."""
    length = float(seen.time[-1] - seen.time[0])
    is_long = not seen.natural_frequency * length < 1.0  # where it is known
    return is_long and 0.0 < seen.faster_by < 1.0 / GROWN


def _departure(seen: Observation) -> str:
    """Reason why a twist with hardly a swing has not come to rest, or ''."""
    swings = seen.half_swings
    if seen.faster_by > GROWN:
        return _leaves(seen)
    if seen.swings_rise:
        return _rising(seen)
    if seen.cycles.time.size < _FEWEST_EXTREMA and swings.size > 1:
        first, largest = float(swings[0]), float(swings[1:].max())
        if largest > DEPARTS * first:
            return f"half swings of {degrees(first)} and then {degrees(largest)}"
    return ""


def _rising(seen: Observation) -> str:
    """Return the last half swings of a twist that swings ever further."""
    swings = ", ".join(degrees(float(one)) for one in seen.half_swings[-3:])
    return f"ever larger half swings, the last of {swings}"


def _leaves(seen: Observation) -> str:
    """Return how far a twist has left that has not turned."""
    far = degrees(2.0 * float(seen.half_swings[-1]))
    return f"the twist leaves ever faster, by {far} so far"
