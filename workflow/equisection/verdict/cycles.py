"""Cycles of an oscillation with a drifting mean: extrema, amplitude and mean of each, period.

A history x(s) is taken apart at its extrema e_i (tops and bottoms in turn). Around extremum i

    A_i = |e_{i-2} - 4 e_{i-1} + 6 e_i - 4 e_{i+1} + e_{i+2}| / 16

is half the peak-to-peak value. The stencil is the fourth difference: it takes out a mean that
drifts like any cubic, an exponential envelope passes through it unbent (to second order in
the growth per period), and a slow oscillation beneath at 1/7 of the frequency leaks only
0.25 % of its amplitude, where the plain half-swing |e_i - e_{i-1}|/2 leaks 20 %.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.verdict.tops import find_tops

Array = NDArray[np.float64]

# A peak must stand out by this many standard deviations of the noise: neighbouring samples of
# white noise differ by more less than once in 1e6.
_PROMINENCE_IN_NOISE = 8.0
# Differences of this order leave white noise and next to nothing of a wave with 12 or more
# samples a period; their standard deviation is sqrt(binomial(12, 6)) that of the noise.
_DIFFERENCE_ORDER = 6
_DIFFERENCE_GAIN = 924.0**0.5
_MEDIAN_TO_DEVIATION = 1.4826
# Swings below this fraction of those on both sides belong to a harmonic, not to a cycle.
_SECONDARY_SWING = 0.25
_EQUAL_SWINGS = 1.05
# Half width, in periods, of the parabola fitted to a noisy extremum: a cosine is misjudged by
# 7e-5. An extremum whose noise is below this fraction of its swing gets the parabola through
# three samples, which follows the sharp tops of a relaxation oscillation.
_PARABOLA_HALF_WIDTH = 0.06
_CLEAN = 5e-4


@dataclass(frozen=True)
class Cycles:
    """Extrema of a history, and the amplitudes of the cycles around them.

    Attributes
    ----------
    time, value : ndarray, shape (n,)
        Extrema, tops and bottoms in turn: time (c/V) and value (unit of the history).
    amplitude : ndarray, shape (n - 4,) or (0,)
        Half peak-to-peak A_i around extrema 2 ... n - 3.
    noise : float
        Standard deviation of the noise of the history.
    """

    time: Array
    value: Array
    amplitude: Array
    noise: float

    @property
    def amplitude_time(self) -> Array:
        """Times of the amplitudes (c/V)."""
        return self.time[2 : 2 + self.amplitude.size]

    def period(self, half_cycles: int) -> float:
        """Mean period (c/V) over the last ``half_cycles`` (at least two) half cycles.

        Counted from top to top and bottom to bottom, so that unequal halves of a wave do not
        matter.
        """
        spans = self.time[2:] - self.time[:-2]
        return float(np.mean(spans[-max(half_cycles - 1, 1) :])) if spans.size else float("nan")


def noise_level(signal: Array) -> float:
    """Estimate the standard deviation of the white noise on a smooth signal.

    From the median of the sixth differences: robust, and blind to the oscillation itself.
    """
    if signal.size <= _DIFFERENCE_ORDER:
        return 0.0
    difference = np.abs(np.diff(signal, _DIFFERENCE_ORDER))
    return float(_MEDIAN_TO_DEVIATION * np.median(difference) / _DIFFERENCE_GAIN)


def find_cycles(time: Array, signal: Array) -> Cycles:
    """Find the cycles of a history.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Convective time s (c/V), increasing.
    signal : ndarray, shape (n,)
        Any history.
    """
    noise = noise_level(signal)
    rounding = 1e-12 * (1e-3 + float(np.max(np.abs(signal), initial=0.0)))
    prominence = max(_PROMINENCE_IN_NOISE * noise, rounding)
    tops, bottoms = find_tops(signal, prominence), find_tops(-signal, prominence)
    index = _in_turn(signal, np.concatenate((tops, bottoms)), tops.size)
    index = _without_secondary(signal, index)
    at, value = _refined(time, signal, index, noise)
    return Cycles(at, value, _amplitudes(value), noise)


def _in_turn(signal: Array, found: NDArray[np.int64], tops: int) -> NDArray[np.int64]:
    """Sort tops and bottoms; of tops (or bottoms) in a row keep the most extreme."""
    kind = np.where(np.arange(found.size) < tops, 1.0, -1.0)
    order = np.argsort(found)
    kept: list[int] = []
    last = 0.0
    for i, sign in zip(found[order].tolist(), kind[order].tolist(), strict=True):
        if sign != last:
            kept.append(i)
            last = sign
        elif sign * signal[i] > sign * signal[kept[-1]]:
            kept[-1] = i
    return np.asarray(kept, dtype=np.int64)


def _without_secondary(signal: Array, index: NDArray[np.int64]) -> NDArray[np.int64]:
    """Drop pairs of extrema that a harmonic makes within a cycle.

    A swing counts as secondary when it is small beside a swing before it *and* one after it:
    the swings of a decaying or growing oscillation never are.
    """
    while index.size > 3:
        if index.size > 5 and _ends_secondary(signal[index[-4:]]):
            index = index[:-1]
        if index.size > 5 and _ends_secondary(signal[index[3::-1]]):
            index = index[1:]
        swing = np.abs(np.diff(signal[index]))
        before = np.zeros_like(swing)
        after = np.zeros_like(swing)
        before[1:] = swing[:-1]
        before[2:] = np.maximum(before[2:], swing[:-2])
        after[:-1] = swing[1:]
        after[:-2] = np.maximum(after[:-2], swing[2:])
        beside = np.minimum(before, after)
        ratio = swing / np.where(beside > 0.0, beside, np.inf)
        candidates = np.flatnonzero((ratio < _SECONDARY_SWING) & (beside > 0.0))
        if candidates.size == 0:
            break
        # Of two equal tops always the first one, or their times would jump about.
        near = swing[candidates] <= _EQUAL_SWINGS * swing[candidates].min()
        smallest = int(candidates[near][-1])
        index = np.delete(index, (smallest, smallest + 1))
    return index


def _ends_secondary(value: Array) -> bool:
    """Tell whether the last of four extrema ends a small swing of a harmonic."""
    swing = np.abs(np.diff(value))
    return bool(swing[-1] < _SECONDARY_SWING * swing[:-1].max())


def _refined(
    time: Array, signal: Array, index: NDArray[np.int64], noise: float
) -> tuple[Array, Array]:
    """Extrema between the samples: of the least-squares parabola through those around each.

    All parabolas are solved at once: row i of every array below belongs to extremum i.
    """
    at = time[index]
    value = signal[index]
    if index.size < 2:
        return at, value
    half_period = _smaller_neighbour(np.diff(at))
    noisy = noise > _CLEAN * _smaller_neighbour(np.abs(np.diff(value)))
    width = np.where(noisy, 2.0 * _PARABOLA_HALF_WIDTH * half_period, 0.0)
    first = np.minimum(np.searchsorted(time, at - width), index - 1)
    last = np.maximum(np.searchsorted(time, at + width, side="right"), index + 2)
    columns = first[:, None] + np.arange(int(np.max(last - first)))
    weight = (columns < last[:, None]).astype(float)
    columns = np.minimum(columns, time.size - 1)
    scale = np.maximum(at - time[first], time[last - 1] - at)
    u = (time[columns] - at[:, None]) / scale[:, None]
    basis = np.stack((np.ones_like(u), u, u * u), axis=-1)
    weighted = basis * weight[:, :, None]
    normal = np.swapaxes(weighted, 1, 2) @ basis
    right = np.swapaxes(weighted, 1, 2) @ (signal[columns] - value[:, None])[:, :, None]
    a, b, c = np.moveaxis(np.linalg.solve(normal, right)[:, :, 0], 1, 0)
    top = np.divide(-b, 2.0 * c, out=np.zeros_like(b), where=c != 0.0)
    top = np.where(np.abs(top) <= 1.0, top, 0.0)
    return at + scale * top, value + a + top * (b + c * top)


def _smaller_neighbour(between: Array) -> Array:
    """At each extremum the smaller of the two quantities before and after it."""
    smaller: Array = np.minimum(np.append(between, between[-1]), np.insert(between, 0, between[0]))
    return smaller


def _amplitudes(value: Array) -> Array:
    """Half peak-to-peak around each extremum that has two neighbours on both sides."""
    if value.size < 5:
        return np.empty(0)
    fourth = value[:-4] - 4.0 * value[1:-3] + 6.0 * value[2:-2] - 4.0 * value[3:-1] + value[4:]
    amplitude: Array = np.abs(fourth) / 16.0
    return amplitude


def peak_to_peak(time: Array, signal: Array, start: float, end: float) -> float:
    """Largest minus smallest value between two times a whole period apart, less the drift.

    The drift is the straight line through the two ends, which are at the same phase.
    """
    inside = slice(int(np.searchsorted(time, start)), int(np.searchsorted(time, end, "right")))
    first, last = np.interp((start, end), time, signal)
    drift = (last - first) * (time[inside] - start) / (end - start)
    return float(np.ptp(np.append(signal[inside] - drift, first)))
