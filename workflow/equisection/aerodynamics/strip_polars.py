"""Steady loads along the span of a rigid beam: c_l and c_m of each station against the incidence.

Between the incidences the loads of a station follow the monotone cubic of
:mod:`equisection.aerodynamics.polar`, read from a table of even steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.polar import is_nil
from equisection.aerodynamics.span_strips import SpanStrips
from equisection.errors import ArgumentError

Floats = NDArray[np.float64]

#: Step of the reading table (rad), 0.029 deg.
_STEP = 5e-4


@dataclass(frozen=True, eq=False)
class StripPolars:
    """Steady loads of the strips of a rigid beam; moment about mid-chord, nose up.

    Parameters
    ----------
    incidence
        alpha (rad), ascending, shape (n,), n >= 4.
    stations
        z/L of the strips, ascending, shape (S,). A strip reaches half way to the next one.
    lift, moment
        c_l and c_m, shape (n, S).
    label
        Name for messages.
    drag
        C_D of the whole beam, shape (n,), that every strip is taken to have; None for none.

    Raises
    ------
    ArgumentError
        The shapes do not fit, or there are fewer than four incidences.
    """

    incidence: Floats
    stations: Floats
    lift: Floats
    moment: Floats
    label: str
    drag: Floats | None = None

    def __post_init__(self) -> None:
        wanted = (self.incidence.size, self.stations.size)
        if wanted[0] < 4 or self.lift.shape != wanted or self.moment.shape != wanted:
            raise ArgumentError(
                f"polars along the span {self.label!r}: lift {self.lift.shape} and moment "
                f"{self.moment.shape}; wanted are (incidences, stations), at least 4 incidences"
            )
        if self.drag is not None and self.drag.shape != wanted[:1]:
            raise ArgumentError(
                f"polars along the span {self.label!r}: drag {self.drag.shape}; wanted is one of "
                f"the beam at each of {wanted[0]} incidences"
            )

    @property
    def strips(self) -> SpanStrips:
        """Strips around the stations."""
        between = (self.stations[1:] + self.stations[:-1]) / 2.0
        return SpanStrips(np.concatenate([[0.0], between, [1.0]]), self.stations)

    @property
    def incidence_range(self) -> tuple[float, float]:
        """Least and greatest incidence (rad) of the data."""
        return float(self.incidence[0]), float(self.incidence[-1])

    @cached_property
    def continued(self) -> StripPolars:
        """The polars, continued to alpha < 0 as odd functions where they start at 0 without loads.

        Loads at zero incidence are a solver's residue, and become zero.
        """
        loads = (self.lift, self.moment)
        if self.incidence[0] != 0.0 or not all(is_nil(np.abs(c[0]).max(), c) for c in loads):
            return self
        lift, moment = (np.concatenate([-c[:0:-1], 0.0 * c[:1], c[1:]]) for c in loads)
        both = np.concatenate([-self.incidence[:0:-1], self.incidence])
        even = None if self.drag is None else np.concatenate([self.drag[:0:-1], self.drag])
        return StripPolars(both, self.stations, lift, moment, self.label, even)

    @cached_property
    def _cubics(self) -> scipy.interpolate.PchipInterpolator:
        return scipy.interpolate.PchipInterpolator(
            self.incidence, np.stack([self.lift, self.moment], axis=1)
        )

    @cached_property
    def _table(self) -> Floats:
        """Loads at even steps from the first incidence, shape (K, 2, S)."""
        return np.asarray(self._cubics(self._steps))

    @cached_property
    def _slope_table(self) -> Floats:
        """Slopes of the loads (1/rad) at the same incidences, shape (K, 2, S)."""
        return np.asarray(self._cubics(self._steps, 1))

    @property
    def _steps(self) -> Floats:
        count = int(np.ceil((self.incidence[-1] - self.incidence[0]) / _STEP)) + 1
        return np.asarray(self.incidence[0] + _STEP * np.arange(count + 1))

    def loads(self, alpha: ArrayLike) -> tuple[Floats, Floats]:
        """Return c_l and c_m of the strips at ``alpha`` (rad), shape (..., S); NaN outside."""
        return self._read(self._table, alpha)

    def slopes(self, alpha: ArrayLike) -> tuple[Floats, Floats]:
        """Return the slopes of c_l and c_m (1/rad) at ``alpha`` (rad), shape (..., S)."""
        return self._read(self._slope_table, alpha)

    def _read(self, table: Floats, alpha: ArrayLike) -> tuple[Floats, Floats]:
        """Return both of a table at incidences of the strips (rad), shape (..., S); NaN outside."""
        angles = np.asarray(alpha, dtype=np.float64)
        with np.errstate(invalid="ignore", over="ignore"):  # a beam that left the polars
            inside = (angles >= self.incidence[0]) & (angles <= self.incidence[-1])
            position = np.where(inside, (angles - self.incidence[0]) / _STEP, 0.0)
        cell = position.astype(np.intp)
        part = position - cell
        strips = self.stations.size
        columns = 2 * strips * cell + np.arange(strips)
        flat = table.reshape(-1)
        found = []
        for place in (columns, columns + strips):
            low, high = flat.take(place), flat.take(place + 2 * strips)
            found.append(np.where(inside, low + part * (high - low), np.nan))
        return found[0], found[1]

    def normal_rise(self, alpha: ArrayLike) -> Floats:
        """Return by how much c_n exceeds c_l at ``alpha`` (rad), shape (..., S); NaN outside.

        The force normal to the chord is c_n = c_l cos alpha + c_d sin alpha, as of a section
        (:meth:`equisection.aerodynamics.polar.Polar.normal_rise`), with the drag of the beam.
        """
        angles = np.asarray(alpha, dtype=np.float64)
        lift, _ = self.loads(angles)
        with np.errstate(invalid="ignore"):  # a beam that left the polars
            return np.asarray(lift * (np.cos(angles) - 1.0) + self._drag(angles) * np.sin(angles))

    def _drag(self, alpha: Floats) -> Floats:
        if self.drag is None:
            return np.zeros_like(alpha)
        return np.asarray(np.interp(alpha, self.incidence, self.drag))
