"""Points of a polar file as plain rows, and what their format says of their moments.

Nothing here loads numerics, so that the workflow can look at the files before any job starts.
A reader of one format gives rows; :mod:`equisection.io.formats` finds the reader of a file.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from equisection.errors import PolarFileError
from equisection.io.polar_text import Lines, decimal, quoted, text_lines

#: x/c from the leading edge of the point that every polar here has its moment about.
MID_CHORD = 0.5
#: Slope of the lift (1/rad) above which a section is a lifting one; 2 pi of a thin airfoil.
LIFTING = 2.0
#: Slope of the moment over that of the lift below which it may be about the quarter chord; about
#: mid-chord it is 1/4 of a thin airfoil.
LEVEL = 0.05
#: The same above which it may be about mid-chord, half of 1/4.
RISING = 0.125

#: How a comment begins that says what beam and flow a polar is of, and its name for one of them.
_VALID_FOR = "# Valid for:"
REYNOLDS = "Reynolds number"
_TRUTH = {"true": True, "false": False}


class Row(NamedTuple):
    """One point of the file: its line number, and its values in the order of COLUMNS."""

    line: int
    values: tuple[float, ...]

    @property
    def incidence_deg(self) -> float:
        """Incidence (deg)."""
        return self.values[0]


def _says_nothing(lines: Lines) -> float:
    """Return NaN: the format has no Reynolds number."""
    del lines
    return math.nan


@dataclass(frozen=True)
class PolarFormat:
    """One format of polar files.

    Attributes
    ----------
    name
        Name for messages.
    recognises
        Tells from path and lines whether a file is of this format.
    read
        Gives the rows of a file, or raises PolarFileError with file and line.
    moment_axis
        x/c from the leading edge of the point that moments of this format are about; None where
        the format leaves it open.
    reynolds_number
        Gives the Reynolds number that a file says, NaN where it says none.
    """

    name: str
    recognises: Callable[[Path, Lines], bool]
    read: Callable[[Path, Lines], list[Row]]
    moment_axis: float | None
    reynolds_number: Callable[[Lines], float] = _says_nothing

    def axis_of(self, path: Path, given: float | None) -> float:
        """Return x/c of the point that the moments of a file are about.

        Parameters
        ----------
        path
            The file, for messages.
        given
            x/c that the user gives; None for what the format says, else mid-chord.

        Raises
        ------
        PolarFileError
            The format has its moments about another point than the given one.
        """
        if given is not None:
            _check_on_chord(path, given)
        if self.moment_axis is None:
            return MID_CHORD if given is None else given
        if given is not None and given != self.moment_axis:
            raise PolarFileError(
                f"{path}: moment_axis is {given:g}, but moments of {self.name} are about "
                f"{self.moment_axis:g}; leave moment_axis out, or give a CSV file with the moments "
                "that you mean"
            )
        return self.moment_axis


def _check_on_chord(path: Path, axis: float) -> None:
    if not 0.0 <= axis <= 1.0:
        raise PolarFileError(
            f"{path}: moment_axis is {axis!r}; wanted x/c from the leading edge, from 0 to 1 "
            "(0.25 for the quarter chord)"
        )


@dataclass(frozen=True)
class PolarRows:
    """Points of a polar file that have passed the checks.

    Attributes
    ----------
    rows
        By ascending incidence.
    half
        True where they are the half alpha >= 0 of a symmetric section's polar.
    format
        Format that they were read in.
    reynolds_number
        Reynolds number that the file says, NaN where it says none.
    """

    rows: list[Row]
    half: bool
    format: PolarFormat
    reynolds_number: float

    @property
    def about_quarter_chord(self) -> str:
        """Signs, in words, that its moments are about the quarter chord; empty without any."""
        lift, moment = slopes(self.rows)
        if lift <= LIFTING or abs(moment) >= LEVEL * lift:
            return ""
        return (
            f"its lift rises by {lift:.2g} per rad and its moment by {moment:.2g} only, as about "
            "the quarter chord"
        )

    @property
    def about_mid_chord(self) -> str:
        """Signs, in words, that its moments are about mid-chord; empty without any."""
        lift, moment = slopes(self.rows)
        if lift <= LIFTING or moment <= RISING * lift:
            return ""
        return (
            f"its lift rises by {lift:.2g} per rad and its moment by {moment:.2g}, as about "
            "mid-chord"
        )

    def axis_of(self, path: Path, given: float | None) -> float:
        """Return x/c of the point that the moments are about (:meth:`PolarFormat.axis_of`).

        Raises
        ------
        PolarFileError
            Also where nobody says so and the moments look as if it were the quarter chord, or as
            if it were not the point of the format.
        """
        if self.format.moment_axis is not None and self.about_mid_chord:
            if given is None:
                raise PolarFileError(
                    f"{path}: {self.about_mid_chord}, but moments of {self.format.name} are about "
                    f"{self.format.moment_axis:g}; say where it is: moment_axis "
                    f"(embedded.moment_axis) {self.format.moment_axis:g}, or 0.5 if it is about "
                    "mid-chord"
                )
            _check_on_chord(path, given)
            return given
        axis = self.format.axis_of(path, given)
        if given is None and self.format.moment_axis is None and self.about_quarter_chord:
            raise PolarFileError(
                f"{path}: {self.about_quarter_chord}; say where it is: moment_axis "
                "(embedded.moment_axis) 0.25, or 0.5 if it is about mid-chord"
            )
        return axis


def read_validity(path: Path) -> dict[str, float | bool]:
    """Return what beam and flow a polar says that it is of, by name; nothing if it does not say.

    The file says so in comments that begin with ``# Valid for:``, as in
    ``# Valid for: L/c 3.7, flow.root_on_wall true``.

    Raises
    ------
    PolarFileError
        The file cannot be read, or such a comment cannot.
    """
    return validity(path, text_lines(path))


def validity(path: Path, lines: Lines) -> dict[str, float | bool]:
    """Return what lines say of beam and flow (:func:`read_validity`).

    Raises
    ------
    PolarFileError
        Such a comment cannot be read.
    """
    valid: dict[str, float | bool] = {}
    for number, text in lines:
        if not text.startswith(_VALID_FOR):
            continue
        for entry in filter(None, map(str.strip, text.removeprefix(_VALID_FOR).split(","))):
            name, _, value = entry.rpartition(" ")
            try:
                valid[name] = _TRUTH[value] if value in _TRUTH else decimal(value)
            except ValueError:
                raise PolarFileError(
                    f"{path}, line {number}: {quoted(entry)} behind '{_VALID_FOR}'; wanted a "
                    "name and a number, true or false, as in 'h/c 0.04'"
                ) from None
    return valid


def slopes(rows: Sequence[Row]) -> tuple[float, float]:
    """Return the slopes of c_l and c_m (1/rad) between the points around zero lift.

    Of several such pairs the one nearest to zero incidence counts; without one, the two points of
    least lift.
    """
    pairs = list(itertools.pairwise(rows))
    around = [pair for pair in pairs if pair[0].values[1] <= 0.0 <= pair[1].values[1]]
    if around:
        one, two = min(around, key=lambda pair: max(abs(row.incidence_deg) for row in pair))
    else:
        one, two = min(pairs, key=lambda pair: max(abs(row.values[1]) for row in pair))
    lift, moment = (two.values[place] - one.values[place] for place in (1, 2))
    step = math.radians(two.incidence_deg - one.incidence_deg)
    return lift / step, moment / step
