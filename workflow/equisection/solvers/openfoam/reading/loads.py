"""Loads on the section over time or iterations, and the tests that they are known."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.dictionaries import LOADS
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.reading.histories import read_history

Floats = NDArray[np.float64]

#: Coefficients beyond this are those of a flow that has blown up.
BEYOND_REASON = 1e3
#: A coefficient counts as this large at least where a relative change of it is judged.
FLOOR = 0.02
#: Samples of an impulsive start.
_IMPULSIVE = 20
#: Part of a period that may lack of the last one, since a frequency is known no better.
_SHORT_OF_WHOLE = 0.02


@dataclass(frozen=True)
class Loads:
    """Coefficients over time (c/V) or iterations, about mid-chord at rest, shape (n,)."""

    time: Floats
    drag: Floats
    lift: Floats
    moment: Floats

    def until(self, end: float) -> Loads:
        """Return the part up to a time."""
        return self.first(int(np.searchsorted(self.time, end * (1 + 1e-9), side="right")))

    def since(self, start: float) -> Loads:
        """Return the part after a time."""
        late = self.time > start
        return Loads(self.time[late], self.drag[late], self.lift[late], self.moment[late])

    def first(self, samples: int) -> Loads:
        """Return the first samples."""
        part = slice(samples)
        return Loads(self.time[part], self.drag[part], self.lift[part], self.moment[part])

    def last(self, samples: int) -> Loads:
        """Return the last samples."""
        part = slice(-samples, None)
        return Loads(self.time[part], self.drag[part], self.lift[part], self.moment[part])

    def means(self) -> tuple[float, float, float]:
        """Return the means of drag, lift and moment."""
        return float(self.drag.mean()), float(self.lift.mean()), float(self.moment.mean())

    def spread(self, floor: float = FLOOR) -> float:
        """Return the largest half range of a coefficient relative to its mean.

        A mean counts as ``floor`` at least.
        """
        return max(
            float(np.ptp(values)) / 2 / max(abs(float(values.mean())), floor)
            for values in (self.drag, self.lift, self.moment)
        )

    def in_whole_periods(self, period: float | None) -> Loads:
        """Return the last part that is a whole number of periods (c/V) long; all without one.

        A mean over a part of a period has a part of the fluctuation in it.
        """
        if period is None:
            return self
        return self.last(self._whole(self.time.size, period))

    def halves(self, period: float | None = None) -> Halves:
        """Return the first and the last part of a length.

        It is half the length, or the most whole periods (c/V) that fit into half of it.
        """
        half = self.time.size // 2
        if period is None:
            return Halves(self.first(half), self.last(self.time.size - half), self)
        samples = self._whole(half, period)
        return Halves(self.first(samples), self.last(samples), self)

    def _whole(self, samples: int, period: float) -> int:
        """Return the samples of the most whole periods (c/V) in a number of samples.

        A period that lacks less than :data:`_SHORT_OF_WHOLE` of itself counts as whole.
        """
        periods = math.floor(samples * self._step / period + _SHORT_OF_WHOLE)
        return min(round(periods * period / self._step), samples)

    @property
    def _step(self) -> float:
        return float(self.time[1] - self.time[0])


@dataclass(frozen=True)
class Halves:
    """First and last part of a record of loads, of one length, and the whole record."""

    first: Loads
    last: Loads
    whole: Loads

    def drift(self, floor: float = FLOOR) -> float:
        """Return the largest difference of the means of both relative to that of the whole.

        A mean counts as ``floor`` at least.
        """
        return max(
            abs(later - earlier) / max(abs(mean), floor)
            for earlier, later, mean in zip(
                self.first.means(), self.last.means(), self.whole.means(), strict=True
            )
        )

    def growth(self, floor: float = FLOOR) -> float:
        """Return the growth of the lift's fluctuation from the first to the last.

        A root mean square below a thousandth of ``floor`` in the last has none.
        """
        before, after = float(self.first.lift.std()), float(self.last.lift.std())
        if after < 1e-3 * floor:
            return 0.0
        return after / before - 1.0 if before > 0 else np.inf


def has_loads(folder: Path) -> bool:
    """Tell whether a case has written loads; their file is opened after the first step."""
    return any((folder / "postProcessing" / LOADS).glob("*/coefficient*.dat"))


def read_loads(folder: Path) -> Loads:
    """Return the loads of a case so far.

    Raises
    ------
    SolverError
        There are none, or their file has an unknown layout.
    """
    place = folder / "postProcessing" / LOADS
    columns = read_history(place, "coefficient.dat", ["Cd", "Cl", "CmPitch"])
    return Loads(columns["Time"], columns["Cd"], columns["Cl"], columns["CmPitch"])


def first_known(
    loads: Loads, is_known: Callable[[Loads], bool], shortest: float, interval: float
) -> Loads | None:
    """Return the first part that is known, of those that end at a multiple of an interval.

    A run is followed from outside and ends a little later. The part that is used ends here, so that
    it does not depend on the time at which the end was noticed. None if no part is known.
    """
    ends = np.arange(shortest, loads.time[-1] * (1 + 1e-9), interval) if loads.time.size else ()
    return next(filter(is_known, (loads.until(float(end)) for end in ends)), None)


def reasonable(loads: Loads) -> int:
    """Return the number of samples before the loads are not finite or beyond reason.

    The first steps after an impulsive start have a peak of pressure and are not judged.
    """
    values = np.stack([loads.drag, loads.lift, loads.moment])
    bound = np.where(np.arange(loads.time.size) < _IMPULSIVE, np.inf, BEYOND_REASON)
    wrong = np.flatnonzero(~(np.abs(values) < bound).all(axis=0))
    return int(wrong[0]) if wrong.size else loads.time.size


def require_reasonable(loads: Loads, folder: Path) -> None:
    """Refuse loads of a flow that has blown up.

    Raises
    ------
    BlowUpError
        They are not finite or beyond reason.
    """
    samples = reasonable(loads)
    if samples < loads.time.size:
        raise BlowUpError(
            f"the loads are beyond reason from time {loads.time[samples]:g} on; see {folder}"
        )
