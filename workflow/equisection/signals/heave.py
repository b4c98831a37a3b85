"""Whether a slow heave grows beneath the twist, which the cycles of the twist don't show.

A section whose lift falls with the incidence gallops: its heave grows at its own frequency, some
3 to 8 times slower than the pitch, while the twist looks at rest. The heave is the deflection
averaged over a period of the twist, which leaves nothing of what follows the twist.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import cumulative_trapezoid

from equisection.signals.cycles import Array, find_cycles
from equisection.signals.observation import GROWN, Observation

# Swings that must have grown one from the other: half cycles, so that the first may be the release.
_SWINGS = 3
# A heave of less than this many times what the mean must be known to is none.
_NOTICED = 5.0


def growing_heave(seen: Observation) -> str:
    """Reason why the heave is growing at the end of a run, or ''."""
    late = _noticed(seen)[-_SWINGS:]
    if late.size < _SWINGS or np.any(np.diff(late) <= 0.0) or late[-1] < GROWN * late[0]:
        return ""
    return (
        f"the heave grows, by half swings of {late[0]:.3g} c to {late[-1]:.3g} c, beneath a twist "
        "that does not"
    )


def unseen_decay(seen: Observation) -> str:
    """Reason why the heave may yet turn out to grow, or ''."""
    swings = _noticed(seen)
    if swings.size == 0 or (swings.size > 1 and swings[-1] < swings[-2]):
        return ""
    return f"the heave, with a half swing of {swings[-1]:.3g} c, has not been seen to decay"


def _noticed(seen: Observation) -> Array:
    """Return the half swings (chords) of a heave that counts; none of one at rest."""
    swings = heave_swings(seen)
    is_at_rest = swings.size and swings[-1] < _NOTICED * seen.criteria.mean_tolerance_chords
    return swings[:0] if is_at_rest else swings


def heave_swings(seen: Observation) -> Array:
    """Return the half swings (chords) of the heave from one extremum to the next."""
    period = seen.period
    if not 0.0 < 3.0 * period < float(seen.time[-1] - seen.time[0]):
        return np.empty(0)
    middle, slow = _averaged(seen.time, seen.deflection, period)
    swings: Array = 0.5 * np.abs(np.diff(find_cycles(middle, slow).value))
    return swings


def _averaged(time: Array, signal: Array, width: float) -> tuple[Array, Array]:
    """Return times and averages of a history over ``width`` (c/V) around them."""
    integral = cumulative_trapezoid(signal, time, initial=0.0)
    inside = (time >= time[0] + width / 2) & (time <= time[-1] - width / 2)
    middle = time[inside]
    until, since = (np.interp(middle + half, time, integral) for half in (width / 2, -width / 2))
    averages: Array = (until - since) / width
    return middle, averages
