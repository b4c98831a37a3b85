"""Tops of a history that stand out.

``scipy.signal.find_peaks`` finds the same. Its import alone takes as long as many a job of the
workflow, and all that judges a history needs this.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def find_tops(signal: Array, prominence: float) -> NDArray[np.int64]:
    """Find the tops of a history whose prominence is at least a given one.

    A top is higher than its neighbours, or the middle of a flat stretch that is. Its prominence is
    its height over the higher one of two lowest points: those on its left and on its right, each as
    far as the history is not above the top.

    Parameters
    ----------
    signal : ndarray, shape (n,)
        Any finite history.
    prominence : float
        Least prominence (unit of the history).

    Returns
    -------
    ndarray, shape (tops,)
        Places of the tops, ascending.
    """
    if signal.size < 3:
        return np.empty(0, dtype=np.int64)
    first = np.flatnonzero(np.concatenate(([True], signal[1:] != signal[:-1])))  # of each stretch
    last = np.append(first[1:], signal.size) - 1
    value = signal[first]
    inner = value[1:-1]
    top = 1 + np.flatnonzero((inner > value[:-2]) & (inner > value[2:]))
    if top.size == 0:
        return top
    # lowest points before the first top, between each two, and after the last
    valleys = np.minimum.reduceat(value, np.concatenate(([0], top)))
    height = value[top]
    base = np.maximum(
        _lowest_before(height, valleys[:-1]), _lowest_before(height[::-1], valleys[:0:-1])[::-1]
    )
    found = top[height - base >= prominence]
    return np.asarray((first[found] + last[found]) // 2, dtype=np.int64)


def _lowest_before(height: Array, valleys: Array) -> Array:
    """Return the lowest valley before each top, back to the last top that is higher."""
    lowest = np.empty_like(height)
    passed: list[tuple[float, float]] = []  # tops that are higher than all after them, with valleys
    for i, (this, valley) in enumerate(zip(height.tolist(), valleys.tolist(), strict=True)):
        lowest[i] = valley
        while passed and passed[-1][0] <= this:
            lowest[i] = min(lowest[i], passed.pop()[1])
        passed.append((this, float(lowest[i])))
    return lowest
