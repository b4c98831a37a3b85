"""Section polars: steady c_l, c_d and c_m of a section against its incidence.

A polar is a list of measured or computed points. Between them the coefficients follow the
monotone cubic of Fritsch and Carlson (SIAM J. Numer. Anal. 17, 1980; "PCHIP"), which has a
continuous slope and adds no peak that the data do not have. A spline without that property
would invent a lift maximum just where stall flutter is decided.

A time loop asks for coefficients millions of times, so the cubic is read once into a table of
uniform step h = 1e-4 rad and the loop reads the table by index. Linear reading errs by at most
|c''| h^2/8, some 4e-8 on the polar of a plate with points one degree apart. Table nodes are
integer multiples of h: alpha = 0 is a node, and an odd polar is zero there to the last bit.
Slopes come from the cubic itself.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.conventions import SYMMETRY_TOLERANCE
from equisection.errors import ArgumentError, IncidenceOutOfRangeError
from equisection.io.formats import read_rows
from equisection.io.polar_rows import MID_CHORD

Floats = NDArray[np.float64]

TABLE_STEP = 1e-4
"""Step h of the reading table (rad), 0.0057 deg."""

TRANSFER_STEP = 1e-3
"""Step of the moment about another point (rad)."""

NIL = 1e-3
"""A coefficient this small where it is to vanish, relative to the largest of its polar, is zero."""


def is_nil(value: float, coefficients: Floats) -> bool:
    """Tell whether a value is zero up to a solver's residue, relative to the largest of a polar."""
    return bool(abs(value) <= NIL * np.max(np.abs(coefficients)))


@dataclass(frozen=True)
class _Curve:
    """One coefficient against incidence: the monotone cubic and its uniform table."""

    incidence: Floats
    values: Floats

    @cached_property
    def cubic(self) -> scipy.interpolate.PchipInterpolator:
        return scipy.interpolate.PchipInterpolator(self.incidence, self.values)

    @cached_property
    def _first_node(self) -> int:
        return math.floor(float(self.incidence[0]) / TABLE_STEP)

    @cached_property
    def _nodes(self) -> Floats:
        last_node = math.ceil(float(self.incidence[-1]) / TABLE_STEP) + 1
        table: Floats = self.cubic(TABLE_STEP * np.arange(self._first_node, last_node + 1))
        return table

    @cached_property
    def _rises(self) -> Floats:
        return np.diff(self._nodes)

    def read(self, alpha: ArrayLike) -> Floats:
        """Coefficient at ``alpha`` (rad, any shape); NaN outside the data and for NaN."""
        angles = np.asarray(alpha, dtype=np.float64)
        with np.errstate(invalid="ignore", over="ignore"):  # a lane that failed has no cell
            position = angles / TABLE_STEP - self._first_node
            cell = position.astype(np.intp)
            value = self._nodes.take(cell, mode="clip")
            value = value + (position - cell) * self._rises.take(cell, mode="clip")
        inside = (angles >= self.incidence[0]) & (angles <= self.incidence[-1])
        return np.where(inside, value, np.nan)

    def slope(self, alpha: float) -> float:
        """Slope of the cubic (1/rad) at ``alpha`` (rad), which must be inside the data."""
        return float(self.cubic(alpha, 1))


@dataclass(frozen=True, eq=False)
class Polar:
    """Steady coefficients of a section; moment about mid-chord, nose up.

    Parameters
    ----------
    incidence
        alpha (rad), ascending, shape (n,), n >= 4.
    drag, lift, moment
        c_d, c_l, c_m (Eq. 21), shape (n,).
    label
        Name for messages and legends.
    reynolds_number
        Reynolds number that the file says (-); NaN where it is not known.
    """

    incidence: Floats
    drag: Floats
    lift: Floats
    moment: Floats
    label: str
    reynolds_number: float = math.nan
    _drag: _Curve = field(init=False, repr=False)
    _lift: _Curve = field(init=False, repr=False)
    _moment: _Curve = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for name in ("incidence", "drag", "lift", "moment"):
            try:
                values = np.array(getattr(self, name), dtype=np.float64)
            except (TypeError, ValueError):
                raise ArgumentError(f"polar {self.label!r}: {name} is no list of numbers") from None
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        self._check()
        for name in ("drag", "lift", "moment"):
            curve = _Curve(self.incidence, getattr(self, name))
            object.__setattr__(self, f"_{name}", curve)

    def _check(self) -> None:
        count = self.incidence.size
        if self.incidence.ndim != 1 or count < 4:
            raise ArgumentError(
                f"polar {self.label!r} has {count} angles of incidence; a list of 4 or more "
                "is needed"
            )
        for name in ("drag", "lift", "moment"):
            values = getattr(self, name)
            if values.shape != (count,) or not np.all(np.isfinite(values)):
                raise ArgumentError(
                    f"polar {self.label!r}: {name} has shape {values.shape} or is not finite; "
                    f"{count} finite numbers are wanted, one for each incidence"
                )
        if not np.all(np.diff(self.incidence) > 0):  # also catches NaN
            raise ArgumentError(f"polar {self.label!r}: the angles of incidence do not ascend")

    @classmethod
    def read(
        cls,
        path: Path | str,
        *,
        symmetric: bool | None = None,
        moment_axis: float | None = None,
        columns: Mapping[str, str] | None = None,
    ) -> Polar:
        """Polar of the file at ``path``, with the file's name (without suffix) as its label.

        Formats are those of :mod:`equisection.io.formats`. The coefficients of a finite beam are
        read the same way (C_L, C_M, C_D in the place of c_l, c_m, c_d).

        Parameters
        ----------
        path
            The file.
        symmetric
            True: it holds the half polar alpha >= 0 of a symmetric section, which is mirrored.
            False: it is taken as it is. None: the file decides. With a negative angle it is taken
            as it is, from 0 deg on without lift and moment there it is mirrored, and any other is
            refused.
        moment_axis
            x/c from the leading edge of the point that the file's moments are about. None: what
            the format says (0.25 for XFOIL and other programs), else mid-chord, 0.5; but moments
            that look as if they were about another point are refused. From there the moment is
            transferred to mid-chord,

                c_m = c_m,axis - (x/c - 1/2) (c_l cos alpha + c_d sin alpha).
        columns
            Names of the columns of a CSV file by quantity (``incidence_deg``, ``cl``, ``cm``,
            ``cd``), for those that are not the usual ones, as in ``{"cl": "CA", "cd": "CW"}``.

        Raises
        ------
        PolarFileError
            The file cannot be used, or it is open or contradictory which point its moments are
            about.
        """
        path = Path(path)
        points = read_rows(path, symmetric, columns)
        axis = points.axis_of(path, moment_axis)
        incidence_deg, lift, moment, drag = np.array([row.values for row in points.rows]).T
        incidence = np.radians(incidence_deg)
        if axis != MID_CHORD:
            normal_force = lift * np.cos(incidence) + drag * np.sin(incidence)
            moment = moment - (axis - MID_CHORD) * normal_force
        polar = cls(incidence, drag, lift, moment, path.stem, points.reynolds_number)
        return polar.mirrored() if points.half else polar

    @classmethod
    def of_settings(cls, settings: Mapping[str, Any]) -> Polar:
        """Polar of the settings of a case (:meth:`as_settings`)."""
        return cls(
            np.radians(settings["incidence_deg"]),
            settings["cd"],
            settings["cl"],
            settings["cm"],
            settings["label"],
        )

    def as_settings(self) -> dict[str, Any]:
        """Return all that decides a case of the polar, in builtin types."""
        return {
            "label": self.label,
            "incidence_deg": np.degrees(self.incidence).tolist(),
            "cd": self.drag.tolist(),
            "cl": self.lift.tolist(),
            "cm": self.moment.tolist(),
        }

    @classmethod
    def flat_plate(cls, limit_rad: float) -> Polar:
        """Thin-plate theory for -limit_rad <= alpha <= limit_rad: c_l = 2 pi alpha, c_d = 0.

        The lift acts at a quarter of the chord, so about mid-chord c_m = c_l/4 (Glauert, *The
        Elements of Aerofoil and Airscrew Theory*, chapter VII). Attached, inviscid, free air.
        """
        alpha = np.linspace(-limit_rad, limit_rad, 5)
        alpha[2] = 0.0
        return cls(alpha, np.zeros(5), 2 * np.pi * alpha, 0.5 * np.pi * alpha, "thin flat plate")

    def mirrored(self) -> Polar:
        """Whole polar of a symmetric section of which this one is the half alpha >= 0.

        c_l and c_m are continued as odd functions and c_d as an even one. Round-off in c_l and
        c_m at zero incidence becomes exact zero.
        """
        if self.incidence[0] != 0.0:
            raise ValueError(
                f"polar {self.label!r} starts at {math.degrees(self.incidence[0]):g} deg; only "
                "one that starts at zero incidence can be mirrored"
            )
        at_zero = max(abs(self.lift[0]), abs(self.moment[0]))
        if at_zero > SYMMETRY_TOLERANCE:
            raise ArgumentError(
                f"polar {self.label!r} has c_l = {self.lift[0]:g} and c_m = {self.moment[0]:g} "
                "at zero incidence; those of a symmetric section vanish there"
            )

        lift, moment = self.lift.copy(), self.moment.copy()
        lift[0] = moment[0] = 0.0
        return Polar(
            self.incidence, self.drag, lift, moment, self.label, self.reynolds_number
        )._both_halves()

    @cached_property
    def continued(self) -> Polar:
        """The polar, continued to alpha < 0 by symmetry where it starts at 0 without loads there.

        c_l and c_m are continued as odd functions about their values at zero incidence, which are
        zero up to a solver's residue. So the cubics have the slope of a symmetric section there.
        Beyond the second given point they do not change.
        """
        coefficients = (self.lift, self.moment)
        if self.incidence[0] != 0.0 or not all(is_nil(c[0], c) for c in coefficients):
            return self
        return self._both_halves()

    def _both_halves(self) -> Polar:
        """Return the polar with its reflection at zero incidence, where it starts."""

        def reflected(values: Floats) -> Floats:
            return np.concatenate([2.0 * values[0] - values[:0:-1], values])

        drag = np.concatenate([self.drag[:0:-1], self.drag])
        lift, moment = reflected(self.lift), reflected(self.moment)
        return Polar(
            reflected(self.incidence), drag, lift, moment, self.label, self.reynolds_number
        )

    @property
    def incidence_range(self) -> tuple[float, float]:
        """Least and greatest incidence (rad) of the data."""
        return float(self.incidence[0]), float(self.incidence[-1])

    def covers(self, alpha: ArrayLike) -> bool:
        """Tell whether every incidence in ``alpha`` (rad) is inside the data; False for NaN."""
        angles = np.asarray(alpha, dtype=np.float64)
        least, greatest = self.incidence_range
        return bool(np.all((angles >= least) & (angles <= greatest)))

    def require(self, alpha: ArrayLike) -> None:
        """Raise IncidenceOutOfRangeError unless the polar covers ``alpha`` (rad)."""
        if self.covers(alpha):
            return
        least, greatest = np.degrees(self.incidence_range)
        angles = np.degrees(np.atleast_1d(np.asarray(alpha, dtype=np.float64)))
        outside = angles[~((angles >= least) & (angles <= greatest))]
        worst = outside[np.argmax(np.abs(outside - 0.5 * (least + greatest)))]
        raise IncidenceOutOfRangeError(
            f"incidence {worst:.4g} deg is outside polar {self.label!r}, which covers "
            f"{least:.4g} to {greatest:.4g} deg; extend the polar or lower the load"
        )

    def lift_coefficient(self, alpha: ArrayLike) -> Floats:
        """c_l at ``alpha`` (rad, any shape); NaN outside the data, so that one lane can fail."""
        return self._lift.read(alpha)

    def moment_coefficient(self, alpha: ArrayLike) -> Floats:
        """c_m about mid-chord, nose up, at ``alpha`` (rad, any shape); NaN outside the data."""
        return self._moment.read(alpha)

    def drag_coefficient(self, alpha: ArrayLike) -> Floats:
        """c_d at ``alpha`` (rad, any shape); NaN outside the data."""
        return self._drag.read(alpha)

    def normal_rise(self, alpha: ArrayLike) -> Floats:
        """c_l (cos alpha - 1) + c_d sin alpha at ``alpha`` (rad, any shape); NaN outside the data.

        The force normal to the chord is c_l and this.
        """
        angles = np.asarray(alpha, dtype=np.float64)
        lift, drag = self._lift.read(angles), self._drag.read(angles)
        with np.errstate(invalid="ignore"):  # a lane that failed may be at infinity
            return np.asarray(lift * (np.cos(angles) - 1.0) + drag * np.sin(angles))

    def moment_cubic_about(self, axis: float) -> scipy.interpolate.PPoly:
        """Moment about another point as a piecewise cubic: c_m + x (c_l cos alpha + c_d sin alpha).

        The formula holds between the points of the polar, too: its value and its slope are met
        every thousandth of a radian, and the cubic between errs by less than 1e-11.

        Parameters
        ----------
        axis
            x, chords from mid-chord back to the point. At 0 it is :attr:`moment_cubic` itself.
        """
        if axis == 0.0:
            return self.moment_cubic
        parts = np.ceil(np.diff(self.incidence) / TRANSFER_STEP).astype(int)
        alpha = np.concatenate(
            [
                np.linspace(start, stop, count, endpoint=False)
                for start, stop, count in zip(
                    self.incidence[:-1], self.incidence[1:], parts, strict=True
                )
            ]
            + [self.incidence[-1:]]
        )
        cos, sin = np.cos(alpha), np.sin(alpha)
        (lift, drag, moment), (by_lift, by_drag, by_moment) = (
            [curve.cubic(alpha, order) for curve in (self._lift, self._drag, self._moment)]
            for order in (0, 1)
        )
        return scipy.interpolate.CubicHermiteSpline(
            alpha,
            moment + axis * (lift * cos + drag * sin),
            by_moment + axis * ((by_lift + drag) * cos + (by_drag - lift) * sin),
        )

    @property
    def lift_cubic(self) -> scipy.interpolate.PchipInterpolator:
        """c_l as the piecewise cubic itself, for roots and quotients; no limit of range."""
        return self._lift.cubic

    @property
    def moment_cubic(self) -> scipy.interpolate.PchipInterpolator:
        """c_m as the piecewise cubic itself, for roots and quotients; no limit of range."""
        return self._moment.cubic

    def lift_slope(self, alpha: float = 0.0) -> float:
        """dc_l/dalpha (1/rad) at ``alpha`` (rad)."""
        self.require(alpha)
        return self._lift.slope(alpha)

    def moment_slope(self, alpha: float = 0.0) -> float:
        """dc_m/dalpha (1/rad) at ``alpha`` (rad), about mid-chord, nose up."""
        self.require(alpha)
        return self._moment.slope(alpha)


def require_polar(polar: object) -> None:
    """Refuse what is no polar, such as flutter derivatives, which have no static loads.

    Raises
    ------
    ArgumentError
        It is something else.
    """
    if not isinstance(polar, Polar):
        raise ArgumentError(
            f"polar is a {type(polar).__name__}; wanted a Polar, as Polar.read(file) gives it"
        )
