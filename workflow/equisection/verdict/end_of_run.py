"""Decide at the end of a run by the trend of its last periods."""

from __future__ import annotations

import math

import numpy as np

from equisection.verdict.observation import GROWN, RUNS_AWAY, UNDIMINISHED, Observation
from equisection.verdict.verdict import Regime
from equisection.verdict.wording import change, degrees

_AT_THE_END = "decided by the trend at the end of the run: "
# A trend has stalled when the last half of the window keeps less than this part of its rate.
_STALLED = 0.3
# With fewer extrema the swing from the release to the first is needed to compare with.
_FEWEST_EXTREMA = 3


def decide_by_trend(seen: Observation) -> tuple[Regime, str]:
    """Decide at the end of a run that showed nothing beyond doubt.

    A clear growth rate makes the run growing or settled. Without one it is a limit cycle, whatever
    its spread.
    """
    if not seen.ringing or seen.amplitude.size < 3:
        return _by_swings(seen)
    amplitude = f"twist amplitude {degrees(float(seen.amplitude[-1]))}"
    direction = _direction(seen)
    if direction > 0:
        slowing = seen.halves[1].growth_rate < UNDIMINISHED * seen.halves[0].growth_rate
        rate = ", at a falling rate" if slowing else ""
        return "growing", f"{_AT_THE_END}{amplitude} grows, {change(seen)}{rate}"
    if direction < 0:
        return "settled", f"{_AT_THE_END}{amplitude} dies out, {change(seen)}"
    if float(seen.amplitude[-1]) < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", f"{_AT_THE_END}{amplitude} is that of a section at rest"
    return "limit-cycle", (
        f"{_AT_THE_END}{amplitude} has no clear trend ({change(seen)}), and its spread is "
        f"{100.0 * seen.spread:.2g} %"
    )


def _direction(seen: Observation) -> int:
    """Sign of a clear trend; 0 if there is none.

    A modulated amplitude rises and falls, but it comes back to where it was before, so a trend
    has to reach beyond that. Growth at a rate that does not fall counts in any case: what grows
    out of the ringing of the release may be smaller than that was.
    """
    steadiness = seen.criteria.steadiness
    rate, last = seen.trend.growth_rate, float(seen.amplitude[-1])
    if seen.creeps:
        return int(np.sign(rate))
    early, late = seen.halves
    lately = math.copysign(late.growth_rate, rate * late.growth_rate) + 2.0 * late.standard_error
    if lately < _STALLED * abs(rate):
        return 0
    if not seen.trend.clear(steadiness):
        return int(_leaves_all_behind(seen))
    if rate > 0.0:
        undiminished = early.clear(0.0) and late.growth_rate >= early.growth_rate > 0.0
        return int(undiminished or last > (1.0 + steadiness) * seen.long_before.max(initial=0.0))
    return -int(last < (1.0 - steadiness) * seen.long_before.min(initial=math.inf))


def _leaves_all_behind(seen: Observation) -> bool:
    """Tell whether an amplitude has grown beyond all before, though at no steady rate."""
    middle = seen.amplitude.size // 2
    before = max(seen.amplitude[: middle + 1].max(), seen.long_before.max(initial=0.0))
    return bool(seen.amplitude[-1] > GROWN * before)


def _by_swings(seen: Observation) -> tuple[Regime, str]:
    """Decide from the few swings of a record with hardly a cycle in it."""
    if seen.half_range < math.radians(seen.criteria.settled_amplitude_deg):
        return "settled", f"{_AT_THE_END}the twist stayed within {degrees(seen.half_range)}"
    departure = _departure(seen)
    if departure:
        return "growing", f"{_AT_THE_END}{departure}"
    swing = 0.5 * np.abs(np.diff(seen.cycles.value))
    if not seen.ringing or swing.size < 2:
        return "settled", f"{_AT_THE_END}the twist moves without oscillating"
    first, last = float(swing[0]), float(swing[-1])
    words = (
        f"{_AT_THE_END}too few periods to judge by, half swings from {degrees(first)} to "
        f"{degrees(last)}"
    )
    if last > GROWN * first:
        return "growing", words
    return ("settled" if first > GROWN * last else "limit-cycle"), words


def _departure(seen: Observation) -> str:
    """Reason why a twist with hardly a swing has not come to rest, or ''."""
    swings = seen.half_swings
    is_long = seen.time[-1] - seen.time[0] >= seen.criteria.minimal_time
    if seen.faster_by > (GROWN if is_long else RUNS_AWAY):
        return f"the twist leaves ever faster, by {degrees(2.0 * float(swings[-1]))} so far"
    if seen.cycles.time.size < _FEWEST_EXTREMA and swings.size > 1:
        first, largest = float(swings[0]), float(swings[1:].max())
        if largest > GROWN * first:
            return f"half swings of {degrees(first)} and then {degrees(largest)}"
    return ""
