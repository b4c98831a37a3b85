"""Fluctuation of the loads of a rigid section about their means, and frequency of its vortices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Root mean square of the lift below which no vortices are told from a drift.
_SMALLEST = 1e-3
#: Fewest periods in a record, four as well as a frequency of them is known, and least share of the
#: variance of the lift near its frequency.
_PERIODS, _SHARE = 3.9, 0.5


@dataclass(frozen=True)
class Fluctuation:
    """Root mean squares of the loads about their means, and the frequency of the lift.

    Attributes
    ----------
    drag, lift, moment
        Root mean squares of c_d, c_l and c_m about their means.
    frequency
        Strouhal number f c/V of the lift; None where it has no period.
    """

    drag: float
    lift: float
    moment: float
    frequency: float | None

    @classmethod
    def of(cls, time: Floats, drag: Floats, lift: Floats, moment: Floats) -> Fluctuation:
        """Return the fluctuation of a record.

        Parameters
        ----------
        time
            Times (c/V), evenly spaced, shape (n,).
        drag, lift, moment
            c_d, c_l and c_m, shape (n,).
        """
        return cls(
            float(drag.std()), float(lift.std()), float(moment.std()), _frequency(time, lift)
        )

    def variables(self) -> dict[str, tuple[tuple[()], float, dict[str, Any]]]:
        """Return the variables of a data set."""
        found: dict[str, tuple[tuple[()], float, dict[str, Any]]] = {
            f"{name}_rms": ((), value, {"units": "1", "long_name": f"rms of the {what}"})
            for name, value, what in (
                ("cd", self.drag, "drag coefficient about its mean"),
                ("cl", self.lift, "lift coefficient about its mean"),
                ("cm", self.moment, "moment coefficient about its mean"),
            )
        }
        if self.frequency is not None:
            words = "Strouhal number f c/V of the lift"
            found["strouhal"] = ((), self.frequency, {"units": "1", "long_name": words})
        return found


def _frequency(time: Floats, lift: Floats) -> float | None:
    """Return the frequency of the lift (V/c): that of the wave about a line that fits it best.

    It is near the maximum of the Hann-windowed periodogram, whose samples are brought to 1/4 of
    their distance 1/T by zeros behind the record. The maximum itself is a percent off where the
    record has few periods.
    """
    if lift.std() < _SMALLEST:
        return None
    step, length = float(time[1] - time[0]), float(time[-1] - time[0])
    frequencies, power = scipy.signal.periodogram(
        lift,
        1.0 / step,
        window="hann",
        nfft=4 * scipy.fft.next_fast_len(lift.size),
        detrend="linear",
    )
    found = float(frequencies[np.argmax(power)])
    near = power[np.abs(frequencies - found) <= 2.0 / length].sum()
    if found * length < _PERIODS or near < _SHARE * power.sum():
        return None

    line = (np.ones_like(time), time - time.mean())

    def left(frequency: float) -> float:
        angle = 2.0 * np.pi * frequency * time
        columns = np.stack([*line, np.cos(angle), np.sin(angle)], axis=-1)
        fitted = columns @ np.linalg.lstsq(columns, lift, rcond=None)[0]
        return float(np.sum((lift - fitted) ** 2))

    around = (found - 0.5 / length, found + 0.5 / length)
    return float(scipy.optimize.minimize_scalar(left, bounds=around, method="bounded").x)
