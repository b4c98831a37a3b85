"""Histories as they come in: checked once, so that nothing after has to."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from equisection.errors import ResultFileError
from equisection.verdict.cycles import Array


def checked(time: ArrayLike, twist: ArrayLike, deflection: ArrayLike) -> tuple[Array, Array, Array]:
    """Return the histories as arrays of equal length, finite, with increasing time.

    Parameters
    ----------
    time : array_like, shape (n,)
        Convective time s (c/V).
    twist : array_like, shape (n,)
        Twist (rad).
    deflection : array_like, shape (n,)
        Deflection (chords).

    Raises
    ------
    ResultFileError
        A value is not finite or time does not increase.
    ValueError
        The histories differ in length.
    """
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
