"""Means of twist and deflection, and the test that they are known.

Averages over single periods that agree with each other are averaged. If they still wander,
because the slow heave has not come to rest, constant and damped waves are fitted to the tail
of the record, twice, over tails of different length: the mean is known when both agree.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from equisection.verdict.cycles import Array
from equisection.verdict.observation import Observation
from equisection.verdict.superposition import bin_averages, mean_of, superposition

# Tail that is fitted, in periods of the twist: one period of a heave 12 times slower.
_TAIL_PERIODS = 12.0
_SHORT_TAIL = 2.0 / 3.0
_FEWEST_TAIL_PERIODS = 3.0


@dataclass(frozen=True)
class Means:
    """Means of a motion.

    Attributes
    ----------
    twist : float
        Mean twist (rad).
    deflection : float
        Mean deflection (chords).
    known : bool
        True if both are within tolerance.
    """

    twist: float
    deflection: float
    known: bool


def window_means(seen: Observation) -> Means:
    """Averages over the window, of a motion whose mean is still on its way."""
    twist, deflection = (
        mean_of(seen.time, history, *seen.window) for history in (seen.twist, seen.deflection)
    )
    return Means(twist, deflection, known=False)


def means(seen: Observation) -> Means:
    """Means over the window, or those that a motion still ringing will come to."""
    end = seen.window[1]
    channels = np.stack((seen.twist, seen.deflection))
    plain = window_means(seen)
    level = float(np.mean(seen.amplitude[-2:])) if seen.ringing and seen.used else 0.0
    criteria = seen.criteria
    tolerance = np.array(
        (
            max(np.radians(criteria.mean_tolerance_deg), criteria.steadiness * level),
            criteria.mean_tolerance_chords,
        )
    )
    count = int((end - float(seen.time[0])) / seen.period)
    if count >= criteria.periods:
        upto = int(np.searchsorted(seen.time, end, side="right"))
        _, single = bin_averages(
            seen.time[:upto], channels[:, :upto], seen.period, criteria.periods
        )
        if np.all(np.ptp(single, axis=1) <= tolerance):
            return replace(plain, known=True)
    return _from_waves(seen, channels, plain, tolerance)


def _from_waves(
    seen: Observation,
    channels: Array,
    plain: Means,
    tolerance: Array,
) -> Means:
    """Constants under the waves, if two fits agree; else the plain means, not known."""
    end = float(seen.time[-1])
    discarded = min(seen.criteria.discard_time, 0.5 * (end - float(seen.time[0])))
    start = max(float(seen.time[0]) + discarded, end - _TAIL_PERIODS * seen.period)
    if (end - start) * _SHORT_TAIL < _FEWEST_TAIL_PERIODS * seen.period:
        return plain
    whole = superposition(seen.time, channels, start, seen.period)
    tail = channels[:, int(np.searchsorted(seen.time, start)) :]
    inside = (whole.constant >= tail.min(axis=1) - tolerance) & (
        whole.constant <= tail.max(axis=1) + tolerance
    )
    close = whole.residual <= tolerance
    if not bool(np.all(inside & close)):
        return plain
    short = superposition(seen.time, channels, end - _SHORT_TAIL * (end - start), seen.period)
    agree = np.abs(whole.constant - short.constant) <= tolerance
    if bool(np.all(agree)):
        return Means(float(whole.constant[0]), float(whole.constant[1]), known=True)
    return plain
