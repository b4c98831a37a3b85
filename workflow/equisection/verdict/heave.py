"""Growth of a heave beneath the twist, which the cycles of the twist do not show.

A section whose lift falls with the incidence gallops: its heave grows at its own frequency, mostly
3 to 8 times slower than the pitch, while the twist looks at rest. The slow heave is the deflection
averaged over a period of the twist, which removes the part that follows the twist. A heave as fast
as the twist, or faster, is seen in the deflection itself: it counts where one swing after the other
is larger than the one before.
"""

from __future__ import annotations

import numpy as np
import scipy

from equisection.verdict.cycles import Array, find_cycles
from equisection.verdict.observation import GROWN, Observation

# Swings that must have grown one from the other: half cycles, so that the first may be the release.
# Of a heave with no more than two so far the second must be this many times the first.
_SWINGS, _OF_TWO = 3, 1.5
# As many of the deflection itself, in which slow and fast motions are mixed.
_FAST_SWINGS = 4
# A heave of less than this many times what the mean must be known to is none; one that may yet grow
# is waited for from less on, and from the last on if many swings have grown one from the other.
_NOTICED, _WAITED_FOR, _SUSPECTED = 5.0, 2.0, 0.1


def growing_heave(seen: Observation) -> str:
    """Reason why the heave is growing at the end of a run, or ''."""
    swings = heave_swings(seen)
    slow, fast = _rising(swings), _rising(_fast_swings(seen))
    of_two = slow.size == swings.size == 2 and slow[-1] > _OF_TWO * slow[0]
    for late, grows in (
        (slow, of_two or _has_grown(slow, _SWINGS)),
        (fast, _has_grown(fast, _FAST_SWINGS)),
    ):
        if grows and _is_above(seen, _NOTICED, late[-1]):
            return (
                f"the heave grows, by half swings of {late[0]:.3g} c to {late[-1]:.3g} c, beneath "
                "a twist that does not"
            )
    return ""


def unseen_decay(seen: Observation) -> str:
    """Reason why the heave may still turn out to grow, or ''."""
    swings = heave_swings(seen)
    slow, fast = _rising(swings), _rising(_fast_swings(seen))
    is_unseen = slow.size > 1 or slow.size == swings.size == 1
    for late, waits in (
        (slow, is_unseen and _is_above(seen, _WAITED_FOR, slow[-1])),
        *((late, _suspicious(seen, late)) for late in (slow, fast)),
    ):
        if waits:
            return f"the heave, with a half swing of {late[-1]:.3g} c, has not been seen to decay"
    moved = _moved(seen)
    if not swings.size and _is_above(seen, _NOTICED, 0.5 * moved):
        return f"the heave has moved by {moved:.3g} c in that time and not swung yet"
    return ""


def _has_grown(late: Array, fewest: int) -> bool:
    return late.size >= fewest and bool(late[-1] > GROWN * late[0])


def _suspicious(seen: Observation, late: Array) -> bool:
    return _has_grown(late, _FAST_SWINGS) and _is_above(seen, _SUSPECTED, late[-1])


def _is_above(seen: Observation, times: float, half_swing: float) -> bool:
    return half_swing >= times * seen.criteria.mean_tolerance_chords


def _rising(swings: Array) -> Array:
    """Return the swings at the end of which each is larger than the one before."""
    falls = np.flatnonzero(np.diff(swings) <= 0.0)
    return swings[falls[-1] + 1 :] if falls.size else swings


def _fast_swings(seen: Observation) -> Array:
    """Return the half swings (chords) of the deflection as it is."""
    swings: Array = 0.5 * np.abs(np.diff(find_cycles(seen.time, seen.deflection).value))
    return swings


def heave_swings(seen: Observation) -> Array:
    """Return the half swings (chords) of the slow heave from one extremum to the next."""
    slow = _slow(seen)
    if not slow[0].size:
        return np.empty(0)
    swings: Array = 0.5 * np.abs(np.diff(find_cycles(*slow).value))
    return swings


def _moved(seen: Observation) -> float:
    """Return between what values (chords) the slow heave was in the window of the verdict."""
    middle, slow = _slow(seen)
    late = slow[middle >= seen.window[0]]
    return float(np.ptp(late)) if late.size else 0.0


def _slow(seen: Observation) -> tuple[Array, Array]:
    """Return times and deflection (chords) averaged over a period; none of a short record."""
    period = seen.period
    if not 0.0 < 3.0 * period < float(seen.time[-1] - seen.time[0]):
        return np.empty(0), np.empty(0)
    return _averaged(seen.time, seen.deflection, period)


def _averaged(time: Array, signal: Array, width: float) -> tuple[Array, Array]:
    """Return times and averages of a history over ``width`` (c/V) around them."""
    integral = scipy.integrate.cumulative_trapezoid(signal, time, initial=0.0)
    inside = (time >= time[0] + width / 2) & (time <= time[-1] - width / 2)
    middle = time[inside]
    until, since = (np.interp(middle + half, time, integral) for half in (width / 2, -width / 2))
    averages: Array = (until - since) / width
    return middle, averages
