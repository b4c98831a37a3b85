"""Loads of a thin plate in small harmonic motion: Theodorsen, NACA Report 496 (1935).

Inviscid, incompressible, attached flow in free air, linear in the motion. With q = (w/c, theta),
the pitch axis x_a chords behind mid-chord, and moments about that axis,

    (c_l, c_m) = A_2 q'' + A_1 q' + C(k) r (theta - w' + (1/4 - x_a) theta'),    ' = d/ds,

where k = omega c/(2 V), r = 2 pi (1, 1/4 + x_a), and the bracket is the incidence at three quarters
of the chord. A_2 and A_1 hold the loads without circulation: the apparent mass, and its terms with
the speed of the stream. Theodorsen's b is c/2 here, his a is 2 x_a, and his h is -w.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.indicial import (
    theodorsen,
    theodorsen_of_growing,
    theodorsen_slope,
)

Floats = NDArray[np.float64]

#: Chords from mid-chord to the quarter chord, where the lift of steady flow acts.
_QUARTER = 0.25


@dataclass(frozen=True)
class ThinAirfoil:
    """Loads of a thin plate that heaves and pitches about an axis.

    Attributes
    ----------
    axis : float
        x_a, chords from mid-chord back to the pitch axis, about which moments are.
    """

    axis: float = 0.0

    @property
    def lift_slope(self) -> float:
        """dc_l/dtheta of steady flow (1/rad), 2 pi."""
        return 2.0 * math.pi

    @property
    def moment_slope(self) -> float:
        """dc_m/dtheta of steady flow about the pitch axis (1/rad), pi/2 for mid-chord."""
        return self.lift_slope * (_QUARTER + self.axis)

    @cached_property
    def _apparent_mass(self) -> Floats:
        x = self.axis
        return -0.5 * math.pi * np.array([[1.0, x], [x, 1.0 / 32.0 + x * x]])

    @property
    def apparent_mass(self) -> Floats:
        """Mass and inertia of the air that moves with the plate, -A_2 (-), shape (2, 2)."""
        return -self._apparent_mass

    @cached_property
    def _apparent_rate(self) -> Floats:
        return 0.5 * math.pi * np.array([[0.0, 1.0], [0.0, -(_QUARTER - self.axis)]])

    @cached_property
    def _circulatory(self) -> tuple[Floats, Floats]:
        """Loads by q and by q' with C = 1."""
        loads = np.array([self.lift_slope, self.moment_slope])
        by_place = np.outer(loads, [0.0, 1.0])
        return by_place, np.outer(loads, [-1.0, _QUARTER - self.axis])

    def influence(self, omega: float) -> NDArray[np.complex128]:
        """Return Q with (c_l, c_m) = Q (w/c, theta) in harmonic motion, shape (2, 2).

        Parameters
        ----------
        omega
            Angular frequency omega c/V >= 0 (-); k is half of it. At 0 the flow is steady.
        """
        lag = complex(theodorsen(0.5 * omega)) if omega > 0.0 else 1.0
        by_place, by_rate = self._circulatory
        return np.asarray(
            -(omega**2) * self._apparent_mass
            + 1j * omega * self._apparent_rate
            + lag * (by_place + 1j * omega * by_rate),
            dtype=np.complex128,
        )

    def influence_of_growing(self, rate: complex) -> NDArray[np.complex128]:
        """Return Q of a motion exp(p s) that grows or decays, shape (2, 2).

        At p = i omega it is :meth:`influence`.

        Parameters
        ----------
        rate
            p (V/c), not 0; Re p is the growth rate, Im p is omega c/V.
        """
        lag = theodorsen_of_growing(0.5 * rate)
        by_place, by_rate = self._circulatory
        return np.asarray(
            rate**2 * self._apparent_mass
            + rate * self._apparent_rate
            + lag * (by_place + rate * by_rate),
            dtype=np.complex128,
        )

    def influence_slope(self, rate: complex) -> NDArray[np.complex128]:
        """Return dQ/dp of :meth:`influence_of_growing`, shape (2, 2)."""
        lag, slope = theodorsen_of_growing(0.5 * rate), theodorsen_slope(0.5 * rate)
        by_place, by_rate = self._circulatory
        return np.asarray(
            2.0 * rate * self._apparent_mass
            + self._apparent_rate
            + 0.5 * slope * (by_place + rate * by_rate)
            + lag * by_rate,
            dtype=np.complex128,
        )
