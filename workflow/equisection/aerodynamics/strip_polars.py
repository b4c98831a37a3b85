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

    def __post_init__(self) -> None:
        wanted = (self.incidence.size, self.stations.size)
        if wanted[0] < 4 or self.lift.shape != wanted or self.moment.shape != wanted:
            raise ArgumentError(
                f"polars along the span {self.label!r}: lift {self.lift.shape} and moment "
                f"{self.moment.shape}; wanted are (incidences, stations), at least 4 incidences"
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
        return StripPolars(both, self.stations, lift, moment, self.label)

    @cached_property
    def _cubics(self) -> scipy.interpolate.PchipInterpolator:
        return scipy.interpolate.PchipInterpolator(
            self.incidence, np.stack([self.lift, self.moment], axis=1)
        )

    @cached_property
    def _table(self) -> Floats:
        """Loads at even steps from the first incidence, shape (K, 2, S)."""
        count = int(np.ceil((self.incidence[-1] - self.incidence[0]) / _STEP)) + 1
        return np.asarray(self._cubics(self.incidence[0] + _STEP * np.arange(count + 1)))

    def loads(self, alpha: ArrayLike) -> tuple[Floats, Floats]:
        """Return c_l and c_m of the strips at ``alpha`` (rad), shape (..., S); NaN outside."""
        angles = np.asarray(alpha, dtype=np.float64)
        with np.errstate(invalid="ignore", over="ignore"):  # a beam that left the polars
            inside = (angles >= self.incidence[0]) & (angles <= self.incidence[-1])
            position = np.where(inside, (angles - self.incidence[0]) / _STEP, 0.0)
        cell = position.astype(np.intp)
        part = position - cell
        table, strips = self._table, self.stations.size
        columns = 2 * strips * cell + np.arange(strips)
        flat = table.reshape(-1)
        found = []
        for place in (columns, columns + strips):
            low, high = flat.take(place), flat.take(place + 2 * strips)
            found.append(np.where(inside, low + part * (high - low), np.nan))
        return found[0], found[1]

    def slopes(self, alpha: ArrayLike) -> tuple[Floats, Floats]:
        """Return the slopes of c_l and c_m (1/rad) at one incidence a strip, shape (S,)."""
        at = np.asarray(alpha, dtype=np.float64)
        found = self._cubics(at, 1)  # every strip's slopes at every strip's incidence
        own = np.arange(self.stations.size)
        return found[own, 0, own], found[own, 1, own]
