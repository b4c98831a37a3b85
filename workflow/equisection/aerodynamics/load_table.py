"""Loads Q of harmonic motion over the reduced velocity V/(f c), as a table has them.

Between the rows Q is interpolated over log K, K = omega c/V = 2 pi f c/V, by monotone cubics
(Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980), which do not overshoot where measurements
scatter. Outside of the rows there is nothing.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.errors import ArgumentError
from equisection.io.derivative_table import FEWEST_ROWS

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True)
class LoadTable(ABC):
    """Loads over the reduced velocity: derivatives of a section, or forces on modes of a beam.

    Attributes
    ----------
    reduced_velocity : ndarray, shape (n,)
        V/(f c), ascending.
    values : ndarray, shape (n, ...)
        Values of each row.
    spread : ndarray, shape (n, ...), optional
        Their standard deviations; None where they are not known.
    axis : float
        Axis that heave and moments are about (x/c from the leading edge).
    incidence_deg : float
        Mean incidence (deg); NaN where it is not known.
    label : str
        Where they come from.
    """

    #: What the values are called in a message.
    called: ClassVar[str] = "loads"

    reduced_velocity: Floats
    values: NDArray[Any]
    spread: Floats | None = None
    axis: float = 0.5
    incidence_deg: float = math.nan
    label: str = ""

    def __post_init__(self) -> None:
        velocity = np.asarray(self.reduced_velocity, dtype=np.float64)
        if velocity.ndim != 1 or velocity.size < FEWEST_ROWS or not (np.diff(velocity) > 0.0).all():
            raise ArgumentError(
                f"reduced_velocity has the shape {velocity.shape}; wanted {FEWEST_ROWS} or more "
                "ascending numbers"
            )
        if velocity[0] <= 0.0:
            raise ArgumentError(f"reduced_velocity begins with {velocity[0]:g}; wanted above 0")

    @property
    def frequencies(self) -> tuple[float, float]:
        """Lowest and highest K = omega c/V of the rows."""
        return math.tau / float(self.reduced_velocity[-1]), math.tau / float(
            self.reduced_velocity[0]
        )

    @property
    @abstractmethod
    def loads(self) -> Complexes:
        """Q at each row about the axis of the table, shape (n, m, m)."""

    @property
    @abstractmethod
    def quantities(self) -> int:
        """Number of quantities that have a spread."""

    @abstractmethod
    def shifted(self, number: int, times: float) -> Self:
        """Table in which one quantity is moved by some of its standard deviations.

        Parameters
        ----------
        number
            Its number, below :attr:`quantities`.
        times
            How many.
        """

    @cached_property
    def _over_log_k(self) -> tuple[scipy.interpolate.PchipInterpolator, ...]:
        log_k = np.log(math.tau / self.reduced_velocity[::-1])
        rows = self.loads[::-1]
        return tuple(scipy.interpolate.PchipInterpolator(log_k, p) for p in (rows.real, rows.imag))

    def between_rows(self, omega: ArrayLike) -> Complexes:
        """Return Q about the axis of the table at K = omega c/V, shape (..., m, m).

        Raises
        ------
        ArgumentError
            A frequency is outside of :attr:`frequencies`.
        """
        low, high = self.frequencies
        k = np.asarray(omega, dtype=np.float64)
        if k.size and not (low * (1 - 1e-9) <= k.min() and k.max() <= high * (1 + 1e-9)):
            raise ArgumentError(
                f"omega c/V is {k.min():.4g} to {k.max():.4g}; the {self.called} cover {low:.4g} "
                f"to {high:.4g}"
            )
        log_k = np.log(np.clip(k, low, high))
        real, imaginary = self._over_log_k
        return np.asarray(real(log_k) + 1j * imaginary(log_k), dtype=np.complex128)

    def thinned(self) -> tuple[Self, ...]:
        """Two tables of about half the rows each, both with the first and the last.

        They tell how far the answer depends on the interpolation; none of a table of fewer than
        seven rows.
        """
        last = len(self.reduced_velocity) - 1
        if last < 2 * FEWEST_ROWS - 2:
            return ()
        places = (sorted({*range(start, last, 2), 0, last}) for start in (0, 1))
        return tuple(
            replace(
                self,
                reduced_velocity=self.reduced_velocity[chosen],
                values=self.values[chosen],
                spread=None if self.spread is None else self.spread[chosen],
            )
            for chosen in places
        )
