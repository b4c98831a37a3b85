"""Zigzag of loads from one sample to the next: what a time step leaves that has not converged."""

from __future__ import annotations

import math

import numpy as np

from equisection.verdict.cycles import Array

#: Loads whose zigzag is a larger part of their variation are not converged in their time step (-).
LARGEST_ZIGZAG = 0.02
#: Time (c/V) after the release that is left out: the loads jump there.
AFTER_RELEASE = 5.0
#: Shortest record in which a zigzag is looked for (samples).
_FEWEST_SAMPLES = 20
# Fourth differences over 16 leave a zigzag +a, -a, +a, ... as it is, and of a wave of n samples a
# period the part sin(pi/n)^4: 0.1 % with 17 samples.
_FOURTH_DIFFERENCE = np.array([1.0, -4.0, 6.0, -4.0, 1.0]) / 16.0


def zigzag_of(time: Array, *loads: Array, steps_per_sample: int = 1) -> float:
    """Return the largest zigzag among some loads, over the standard deviation of each (-).

    A coupled flow whose iterations end too soon hands over loads that are too large in one time
    step and too small in the next.

    Parameters
    ----------
    time
        s (c/V), evenly spaced, shape (n,).
    loads
        Coefficients, shape (n,) each.
    steps_per_sample
        Time steps of the flow from one sample to the next.

    Returns
    -------
    float
        NaN where it cannot be seen: a record that is too short or does not vary, and an even number
        of steps from sample to sample, which passes over each second step.
    """
    if steps_per_sample % 2 == 0:
        return math.nan
    begun = time > time[0] + AFTER_RELEASE if time.size else np.zeros(0, dtype=bool)
    if np.count_nonzero(begun) < _FEWEST_SAMPLES:
        return math.nan
    found = [_of_one(load[begun]) for load in loads]
    return float(np.max(found))


def _of_one(load: Array) -> float:
    spread = float(load.std())
    if not spread > 1e-12 * float(np.abs(load).max()):
        return math.nan
    left = np.convolve(load, _FOURTH_DIFFERENCE, "valid")
    return float(np.sqrt(np.mean(left**2))) / spread
