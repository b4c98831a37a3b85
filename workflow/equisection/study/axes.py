"""Axes of a study, and the names of its cases.

A study varies a few quantities, its axes; a point of it is a value on each. A case is named by its
point, part by part in the order of :data:`AXES`, a rigid one by its resolution before that:

    k6.44          k* = 6.44
    a5_k6.44       an incidence of 5 deg and k* = 6.44
    coarse_a2.5    rigid, at the resolution 'coarse' and an incidence of 2.5 deg

Files, indices, tables, the status and the axes of figures take names, columns, order and labels
from here.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:  # jobs need not build the models of the configuration
    from equisection.config import Config

#: Digits of a value in a name; values that differ beyond them are one case.
DIGITS = 6
#: Relative difference below which a value of a table and one of a name are the same.
SAME = 1e-5

_NUMBER = r"-?[0-9]+(?:\.[0-9]+)?(?:e[+-][0-9]+)?"
_RESOLUTION = r"[A-Za-z0-9][A-Za-z0-9_.-]*"


@dataclass(frozen=True)
class Axis:
    """Axis of a study.

    Attributes
    ----------
    name
        Column of tables, and attribute of results.
    letter
        Letter before its value in the name of a case.
    symbol, tex
        Symbol in plain text, and typeset.
    unit
        Unit; ``1`` of a number.
    stable
        Side of the onset on which a beam is stable; empty of an axis without an onset.
    key
        Key of the configuration whose value a point of the study replaces; k* has none, since it
        scales the stiffness of the beam.
    """

    name: str
    letter: str
    symbol: str
    tex: str
    unit: str = "1"
    stable: Literal["", "above", "below"] = ""
    key: str = ""

    @property
    def heading(self) -> str:
        """Symbol with unit in plain text, the heading of a column."""
        return self._with_unit(self.symbol)

    @property
    def label(self) -> str:
        """Typeset symbol with unit, the label of an axis."""
        return self._with_unit(self.tex)

    def _with_unit(self, symbol: str) -> str:
        return symbol if self.unit == "1" else f"{symbol} ({self.unit})"

    def typeset(self, value: float) -> str:
        """Return a value as a figure states it, for instance ``$V$ = 30 m/s``."""
        return f"{self.tex} = {value:g}" + ("" if self.unit == "1" else f" {self.unit}")

    @property
    def pattern(self) -> str:
        """Regular expression of its part of a name."""
        return self.letter + _NUMBER

    def part(self, value: float) -> str:
        """Return its part of a name, for instance ``k6.44``."""
        return f"{self.letter}{value:.{DIGITS}g}"

    def stability(self, value: float) -> float:
        """Return a number that grows with a value towards the stable side of the onset."""
        return -value if self.stable == "below" else value

    def same(self, values: Any, value: float) -> Any:
        """Tell whether a value, or each of an array, is the same as another."""
        return abs(values - value) <= SAME * abs(value)


INCIDENCE = Axis(
    "incidence_deg", "a", "incidence", r"$\theta_0$", unit="deg", key="flow.incidence_deg"
)
K_STAR = Axis("k_star", "k", "k*", "$k^*$", stable="above")
SPEED = Axis("speed", "v", "V", "$V$", unit="m/s", stable="below", key="flow.speed")

#: Axes in the order of their parts in a name. Rigid cases have the first, which is why all that
#: stands before it is the resolution.
AXES = (INCIDENCE, K_STAR, SPEED)


@dataclass(frozen=True)
class AsGiven:
    """Beam as given: its k* (-) at a speed V (m/s), and so at every other.

    k* is a stiffness over the dynamic pressure, k* V^2 that of the beam over rho c^2/2.
    """

    k_star: float
    speed: float

    def speed_at(self, k_star: Any) -> Any:
        """Return the speed (m/s) at which it has a k*, or each of an array."""
        return self.speed * (self.k_star / k_star) ** 0.5

    def k_star_at(self, speed: Any) -> Any:
        """Return its k* (-) at a speed (m/s), or at each of an array."""
        return self.k_star * (self.speed / speed) ** 2


#: Pattern of the names of the cases of a sweep: parts of one axis or more, in order.
SWEEP_PATTERN = "|".join(
    "_".join(axis.pattern for axis in chosen)
    for number in range(1, len(AXES) + 1)
    for chosen in itertools.combinations(AXES, number)
)
#: Pattern of the names of rigid cases.
RIGID_PATTERN = f"{_RESOLUTION}_{AXES[0].pattern}" + "".join(
    f"(?:_{axis.pattern})?" for axis in AXES[1:]
)


@dataclass(frozen=True)
class Point:
    """Point of a study.

    Attributes
    ----------
    values
        Value on each of its axes, in the order of :data:`AXES`.
    resolution
        Resolution of a rigid case; empty of a case of the sweep, which all have the run's.
    """

    values: tuple[tuple[Axis, float], ...]
    resolution: str = ""

    @classmethod
    def at(cls, values: Mapping[Axis, float], resolution: str = "") -> Point:
        """Return the point with some values, in whatever order they are given."""
        return cls(tuple((axis, values[axis]) for axis in AXES if axis in values), resolution)

    @classmethod
    def named(cls, name: str) -> Point:
        """Return the point of a case by its name.

        Raises
        ------
        ValueError
            It is the name of no case.
        """
        pieces, values = name.split("_"), dict[Axis, float]()
        before = list(AXES)
        while pieces and (axis := _axis_of(pieces[-1], before)):
            values[axis] = float(pieces.pop().removeprefix(axis.letter))
            before = before[: before.index(axis)]
        resolution = "_".join(pieces)
        whole = not pieces or (AXES[0] in values and re.fullmatch(_RESOLUTION, resolution))
        if not values or not whole:
            raise ValueError(f"{name!r} is no name of a case, such as 'k6.44' or 'coarse_a2.5'")
        return cls.at(values, resolution)

    @property
    def name(self) -> str:
        """Name of its case."""
        parts = [axis.part(value) for axis, value in self.values]
        return "_".join([self.resolution, *parts] if self.resolution else parts)

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Axes on which it has a value."""
        return tuple(axis for axis, _ in self.values)

    @property
    def columns(self) -> dict[str, float]:
        """Values by the names of their axes, as tables and indices have them."""
        return {axis.name: value for axis, value in self.values}

    @property
    def order(self) -> tuple[str, tuple[float, ...]]:
        """Key by which cases are sorted: by resolution, then by ascending values."""
        return self.resolution, tuple(value for _, value in self.values)

    def __getitem__(self, axis: Axis) -> float:
        """Return the value on an axis."""
        return dict(self.values)[axis]

    def of_config(self, config: Config) -> Config:
        """Return the configuration with the point's values in the place of its own."""
        for axis, value in self.values:
            if axis.key:
                group, _, key = axis.key.partition(".")
                changed = getattr(config, group).model_copy(update={key: value})
                config = config.model_copy(update={group: changed})
        return config


def _axis_of(piece: str, among: Iterable[Axis]) -> Axis | None:
    """Return the axis that a piece of a name is a part of."""
    return next((axis for axis in among if re.fullmatch(axis.pattern, piece)), None)


def varied(config: Config) -> dict[Axis, tuple[float, ...]]:
    """Return the axes that the sweep of a configuration varies, with their values, ascending."""
    onset = K_STAR if config.sweep.speed is None else SPEED
    angles = config.sweep.incidence_deg
    values = {INCIDENCE: tuple(sorted(angles))} if angles else {}
    return values | {onset: config.sweep.values()}


def sweep_points(config: Config) -> list[Point]:
    """Return the points of the sweep of a configuration, by ascending values."""
    values = varied(config)
    axes = [axis for axis in AXES if axis in values]
    return [
        Point(tuple(zip(axes, chosen, strict=True)))
        for chosen in itertools.product(*(values[axis] for axis in axes))
    ]


def axes_among(names: Iterable[str]) -> tuple[Axis, ...]:
    """Return the axes among the names of columns or attributes, in order.

    Of k* and speed, which say the same of a beam, the one named first is the study's.
    """
    there, onset = set(), False
    for axis in (axis for name in names for axis in AXES if axis.name == name):
        if not (axis.stable and onset):
            there.add(axis)
        onset = onset or bool(axis.stable)
    return tuple(axis for axis in AXES if axis in there)


def axes_of(points: Iterable[Point]) -> tuple[Axis, ...]:
    """Return the axes that some points have values on, in order; k* of no point."""
    there = {axis for point in points for axis in point.axes}
    return tuple(axis for axis in AXES if axis in there) or (K_STAR,)


def onset_axis(axes: Iterable[Axis]) -> Axis:
    """Return the axis along which the onset is looked for.

    Raises
    ------
    ValueError
        There is none among the axes.
    """
    among = list(axes)
    for axis in among:
        if axis.stable:
            return axis
    wanted = " or ".join(axis.name for axis in AXES if axis.stable)
    given = ", ".join(axis.name for axis in among) or "nothing"
    raise ValueError(f"no onset over {given}; a study over {wanted} has one")


def onset_axis_among(names: Iterable[str]) -> Axis:
    """Return the axis among the names of columns along which the onset is looked for.

    Raises
    ------
    ValueError
        There is none.
    """
    return onset_axis(axes_among(names))
