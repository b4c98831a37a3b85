"""Prescribed motion: harmonics that set in gently, with phases that keep them apart.

    x(s) = r(s) sum A_i cos(omega_i s + phi_i),    s = tV/c,

where r rises from 0 to 1 over the ramp with no jump in speed or acceleration,
r = u^3 (10 - 15 u + 6 u^2). The phases phi_i = -pi i (i - 1)/n of Schroeder (IEEE Transactions on
Information Theory 16, 1970) keep the peak of n harmonics low.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def schroeder_phases(number: int) -> Floats:
    """Return the phases (rad) of a number of harmonics."""
    place = np.arange(1, number + 1)
    return np.asarray(-math.pi * place * (place - 1) / number, dtype=np.float64)


@dataclass(frozen=True)
class ForcedSignal:
    """Sum of harmonics.

    Attributes
    ----------
    frequencies
        omega c/V, shape (n,).
    amplitudes
        In rad, or chords, shape (n,).
    phases
        In rad, shape (n,).
    ramp
        Time (c/V) in which they set in.
    """

    frequencies: Floats
    amplitudes: Floats
    phases: Floats
    ramp: float

    def _rise(self, s: Floats) -> tuple[Floats, Floats]:
        """Return u, the part of the ramp that is over, and r there."""
        u = np.clip(s / self.ramp, 0.0, 1.0)
        return u, u**3 * (10.0 - 15.0 * u + 6.0 * u**2)

    def at(self, time: ArrayLike) -> Floats:
        """Return the motion at convective times, shape of ``time``."""
        s = np.asarray(time, dtype=np.float64)
        _, rise = self._rise(s)
        angle = np.multiply.outer(s, self.frequencies) + self.phases
        return np.asarray(rise * (np.cos(angle) @ self.amplitudes), dtype=np.float64)

    def moving(self, time: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return the motion with its first and second derivative (per c/V), shape of ``time``."""
        s = np.asarray(time, dtype=np.float64)
        u, rise = self._rise(s)
        first = 30.0 * u**2 * (1.0 - u) ** 2 / self.ramp
        second = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / self.ramp**2
        turning = np.exp(1j * (np.multiply.outer(s, self.frequencies) + self.phases))
        x, v, a = (
            np.real(turning @ (self.amplitudes * (1j * self.frequencies) ** order))
            for order in range(3)
        )
        return (
            np.asarray(rise * x),
            np.asarray(rise * v + first * x),
            np.asarray(rise * a + 2.0 * first * v + second * x),
        )

    @property
    def response(self) -> NDArray[np.complex128]:
        """X_i of x = Re sum X_i exp(i omega_i s), when it has set in, shape (n,)."""
        return np.asarray(self.amplitudes * np.exp(1j * self.phases), dtype=np.complex128)
