"""Flutter derivatives H1* to A4* of a section, over the reduced velocity V/(f B).

The convention is Scanlan's with (1/2) rho V^2 B and heave and lift down
(:mod:`equisection.io.derivative_table`). With h = -w and L = -lift, the loads in the conventions of
this project, (c_l, c_m) = Q (w/c, theta), are at K = omega c/V = 2 pi f c/V

    Q = K^2 [[ H4 + i H1,  -(H3 + i H2)],
             [-(A4 + i A1),   A3 + i A2 ]],

about the axis of the table. About another one, d = (axis of the table - that one) chords ahead of
it, w of the table is w - d theta and its c_m becomes c_m - d c_l, so that Q becomes T^T Q T with
T = [[1, -d], [0, 1]].

Between the rows Q is interpolated (:mod:`equisection.aerodynamics.load_table`): it is bounded over
all K while the derivatives grow with 1/K^2, so that Q converges fastest.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.load_table import LoadTable
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.errors import ArgumentError
from equisection.files import write_text
from equisection.io.derivative_table import (
    DERIVATIVES,
    DerivativeRows,
    derivative_text,
    read_derivative_rows,
)

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

_MID_CHORD = 0.5
#: What is wrong with a reduced velocity by the ratio that it gives slow motion in the place of 1.
_CONFUSED = {
    math.tau: "2 pi times too large",
    1.0 / math.tau: "2 pi times too small, V/(omega B) for V/(f B)",
    2.0: "twice too large, with half the chord for B",
    0.5: "half of what it should be, with K for k",
}
#: Part of a factor that the ratio of two derivatives may differ from it, and rows that tell it.
_NEAR, _SLOW_ROWS = 0.25, 3


@dataclass(frozen=True)
class Derivatives(LoadTable):
    """Flutter derivatives of a section.

    Attributes
    ----------
    reduced_velocity : ndarray, shape (n,)
        V/(f B), ascending, with f in Hz and B the chord.
    values : ndarray, shape (n, 8)
        H1*, H2*, H3*, H4*, A1*, A2*, A3*, A4*.
    spread : ndarray, shape (n, 8), optional
        Their standard deviations; None where they are not known.
    axis : float
        Point whose heave h is and that moments are about (x/c from the leading edge).
    incidence_deg : float
        Mean incidence (deg); NaN where it is not known.
    label : str
        Where they come from.
    """

    called = "derivatives"

    def __post_init__(self) -> None:
        super().__post_init__()
        rows = len(self.reduced_velocity)
        if np.shape(self.values) != (rows, len(DERIVATIVES)):
            raise ArgumentError(
                f"values has the shape {np.shape(self.values)}; wanted ({rows}, 8), H1 to A4 at "
                "each reduced velocity"
            )

    @classmethod
    def read(cls, path: str | Path) -> Derivatives:
        """Read a CSV file whose comments give its convention.

        The form of the file is that of :mod:`equisection.io.derivative_table`.

        Raises
        ------
        DerivativesFileError
            The file cannot be used, or is in another convention.
        """
        rows = read_derivative_rows(Path(path))
        return cls(
            np.array(rows.reduced_velocity),
            np.array(rows.values),
            np.array(rows.spread) if rows.spread else None,
            rows.axis,
            rows.incidence_deg,
            rows.source or Path(path).name,
        )

    @classmethod
    def theodorsen(cls, reduced_velocity: ArrayLike, axis: float = _MID_CHORD) -> Derivatives:
        """Return the derivatives of a thin plate in attached flow, in closed form.

        Those of Theodorsen's loads (NACA Report 496, 1935).

        Parameters
        ----------
        reduced_velocity
            V/(f B), ascending, shape (n,).
        axis
            Point whose heave it is and that moments are about (x/c from the leading edge).
        """
        velocity = np.asarray(reduced_velocity, dtype=np.float64)
        plate = ThinAirfoil(axis - _MID_CHORD)
        loads = np.array([plate.influence(math.tau / one) for one in velocity])
        return cls.of_loads(velocity, loads, axis=axis, label="Theodorsen, thin plate")

    @classmethod
    def of_loads(
        cls,
        reduced_velocity: Floats,
        loads: Complexes,
        *,
        axis: float = _MID_CHORD,
        spread: Floats | None = None,
        incidence_deg: float = math.nan,
        label: str = "",
    ) -> Derivatives:
        """Return the derivatives of loads Q with (c_l, c_m) = Q (w/c, theta) in harmonic motion.

        Parameters
        ----------
        reduced_velocity
            V/(f B), shape (n,), ascending.
        loads
            Q about the axis, shape (n, 2, 2).
        axis, spread, incidence_deg, label
            As of the class.
        """
        by_k = loads / (math.tau / reduced_velocity[:, None, None]) ** 2
        (lift_w, lift_twist), (moment_w, moment_twist) = np.moveaxis(by_k, 0, -1)
        columns = (
            *(lift_w.imag, -lift_twist.imag, -lift_twist.real, lift_w.real),
            *(-moment_w.imag, moment_twist.imag, moment_twist.real, -moment_w.real),
        )
        values = np.stack(columns, axis=1)
        return cls(reduced_velocity, values, spread, axis, incidence_deg, label)

    def write(self, path: str | Path, comments: Sequence[str] = ()) -> None:
        """Write a CSV file that :meth:`read` reads, whole or not at all.

        Parameters
        ----------
        path
            The file.
        comments
            Further lines for its top.
        """
        rows = DerivativeRows(
            tuple(self.reduced_velocity.tolist()),
            tuple(map(tuple, self.values.tolist())),
            () if self.spread is None else tuple(map(tuple, self.spread.tolist())),
            self.axis,
            self.incidence_deg,
            self.label,
        )
        write_text(Path(path), derivative_text(rows, comments))

    @cached_property
    def loads(self) -> Complexes:
        """Q at each row about the axis of the table, shape (n, 2, 2)."""
        h1, h2, h3, h4, a1, a2, a3, a4 = self.values.T
        rows = np.array([[h4 + 1j * h1, -(h3 + 1j * h2)], [-(a4 + 1j * a1), a3 + 1j * a2]])
        square = (math.tau / self.reduced_velocity) ** 2
        return np.asarray(np.moveaxis(square * rows, -1, 0), dtype=np.complex128)

    def influence(self, omega: ArrayLike, elastic_axis: float | None = None) -> Complexes:
        """Return Q with (c_l, c_m) = Q (w/c, theta), shape (..., 2, 2).

        Parameters
        ----------
        omega
            K = omega c/V, shape (...), within :attr:`frequencies`.
        elastic_axis
            Point that heave and moment are those of (x/c); None for the axis of the table.

        Raises
        ------
        ArgumentError
            A frequency is outside of the rows.
        """
        ahead = 0.0 if elastic_axis is None else self.axis - elastic_axis
        turned = np.array([[1.0, -ahead], [0.0, 1.0]])
        return np.asarray(turned.T @ self.between_rows(omega) @ turned, dtype=np.complex128)

    @property
    def quantities(self) -> int:
        """Number of quantities that have a spread: the eight derivatives."""
        return len(DERIVATIVES)

    def shifted(self, number: int, times: float) -> Derivatives:
        """Table in which one derivative is moved by some of its standard deviations.

        Parameters
        ----------
        number
            Its number, 0 for H1 to 7 for A4.
        times
            How many.
        """
        values = self.values.copy()
        if self.spread is not None:
            values[:, number] += times * self.spread[:, number]
        return replace(self, values=values)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Signs that the convention of the table is another one than it says.

        In slow motion the incidence theta - w' alone makes the loads, so that H1 = K H3 and
        A1 = K A3 whatever the section (Matsumoto, J. Wind Eng. Ind. Aerodyn. 60, 1996). Where the
        slowest rows have both ratios at a factor of two forms that are confused, or both negative,
        it is named. Bluff sections need not keep to either.
        """
        slow = slice(-_SLOW_ROWS, None)
        k = math.tau / self.reduced_velocity[slow]
        of = dict(zip(DERIVATIVES, self.values[slow].T, strict=True))
        with np.errstate(divide="ignore", invalid="ignore"):
            ratios = [
                float(np.median(of[rate] / (k * of[place])))
                for rate, place in (("H1", "H3"), ("A1", "A3"))
            ]
        said = (
            f"H1/(K H3) is {ratios[0]:.3g} and A1/(K A3) {ratios[1]:.3g}, where slow motion has 1"
        )
        if not all(map(math.isfinite, ratios)):
            return ()
        if max(ratios) < 0.0:
            return (f"{self.label}: {said}: is the positive direction of heave that of lift?",)
        for factor, wrong in _CONFUSED.items():
            if all(abs(ratio / factor - 1.0) < _NEAR for ratio in ratios):
                return (f"{self.label}: {said}: is the reduced velocity {wrong}?",)
        return ()
