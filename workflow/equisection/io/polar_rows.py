"""Points of a polar file as plain rows, and the checks that every format has in common.

Nothing here loads numerics, so that the workflow can look at the files before any job starts.
A reader of one format gives rows; :mod:`equisection.io.formats` finds the reader of a file.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from equisection.conventions import SYMMETRY_TOLERANCE
from equisection.errors import PolarFileError

COLUMNS = ("incidence_deg", "cl", "cm", "cd")
FEWEST_POINTS = 4
#: x/c from the leading edge of the point that every polar here has its moment about.
MID_CHORD = 0.5
#: Slope of the lift (1/rad) above which a section is a lifting one; 2 pi of a thin airfoil.
LIFTING = 2.0
#: Slope of the moment over that of the lift below which it may be about the quarter chord; about
#: mid-chord it is 1/4 of a thin airfoil.
LEVEL = 0.05
#: Slope of the lift (1/rad) that no section has, and the angle (deg) below which those of a whole
#: polar are radians with such a slope: a thin airfoil would have 360.
STEEPEST, LARGEST_RADIANS = 30.0, 1.6

#: Lines of a text file without blanks at their ends, each with its number from 1.
Lines = Sequence[tuple[int, str]]
#: How a comment begins that says what beam and flow a polar is of.
_VALID_FOR = "# Valid for:"
_TRUTH = {"true": True, "false": False}


@dataclass(frozen=True)
class Row:
    """One point of the file: its line number, and its values in the order of COLUMNS."""

    line: int
    values: tuple[float, ...]

    @property
    def incidence_deg(self) -> float:
        """Incidence (deg)."""
        return self.values[0]


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
    """

    name: str
    recognises: Callable[[Path, Lines], bool]
    read: Callable[[Path, Lines], list[Row]]
    moment_axis: float | None

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
        if given is not None and not 0.0 <= given <= 1.0:
            raise PolarFileError(
                f"{path}: moment_axis is {given!r}; wanted x/c from the leading edge, from 0 to 1 "
                "(0.25 for the quarter chord)"
            )
        if self.moment_axis is None:
            return MID_CHORD if given is None else given
        if given is not None and given != self.moment_axis:
            raise PolarFileError(
                f"{path}: moment_axis is {given:g}, but moments of {self.name} are about "
                f"{self.moment_axis:g}; leave moment_axis out, or give a CSV file with the moments "
                "that you mean"
            )
        return self.moment_axis


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
    """

    rows: list[Row]
    half: bool
    format: PolarFormat

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

    def axis_of(self, path: Path, given: float | None) -> float:
        """Return x/c of the point that the moments are about (:meth:`PolarFormat.axis_of`).

        Raises
        ------
        PolarFileError
            Also where nobody says so and the moments look as if it were the quarter chord.
        """
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
    valid: dict[str, float | bool] = {}
    for number, text in text_lines(path):
        if not text.startswith(_VALID_FOR):
            continue
        for entry in filter(None, map(str.strip, text.removeprefix(_VALID_FOR).split(","))):
            name, _, value = entry.rpartition(" ")
            try:
                valid[name] = _TRUTH[value] if value in _TRUTH else float(value)
            except ValueError:
                raise PolarFileError(
                    f"{path}, line {number}: {entry!r} behind '{_VALID_FOR}'; wanted a name and a "
                    "number, true or false, as in 'h/c 0.04'"
                ) from None
    return valid


def text_lines(path: Path) -> Lines:
    """Return the lines of a text file.

    Raises
    ------
    PolarFileError
        There is no such file, or it is no text.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise PolarFileError(
            f"{path}: no such polar file (looked from {Path.cwd()}); check the path"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise PolarFileError(f"{path}: cannot be read as a text file: {error}") from error
    return [(number, line.strip()) for number, line in enumerate(text.splitlines(), start=1)]


def number(path: Path, line: int, name: str, text: str) -> float:
    """Return a value of a row as a finite number.

    Raises
    ------
    PolarFileError
        The value is not one.
    """
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise PolarFileError(
            f"{path}, line {line}: {name} is {text!r}; wanted a finite number (leave the whole "
            "line out if the point is not known)"
        )
    return value


def check_points(path: Path, rows: Sequence[Row], symmetric: bool | None) -> bool:
    """Refuse rows that make no polar; tell whether they are the half polar of a symmetric section.

    Without ``symmetric`` the rows decide: with a negative angle they are a whole polar, from 0 on
    without lift and moment there a half one, and anything else is refused as ambiguous.

    Raises
    ------
    PolarFileError
        With file and line.
    """
    if len(rows) < FEWEST_POINTS:
        where = f", line {rows[-1].line}" if rows else ""
        raise PolarFileError(
            f"{path}{where}: the file ends after {len(rows)} points; {FEWEST_POINTS} or more are "
            "needed to interpolate"
        )
    if symmetric is None:
        symmetric = _decided(path, rows)
    if symmetric:
        _check_half(path, rows)
    for before, row in itertools.pairwise(rows):
        if row.incidence_deg <= before.incidence_deg:
            kind = "repeats" if row.incidence_deg == before.incidence_deg else "is below"
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg {row.incidence_deg:g} {kind} the "
                f"{before.incidence_deg:g} of line {before.line}; sort the angles upwards, each "
                "once"
            )
    _refuse_radians(path, rows)
    return symmetric


def _refuse_radians(path: Path, rows: Sequence[Row]) -> None:
    """Refuse angles that look like radians, by a lift that no section has per degree."""
    largest, (lift, _) = max(abs(row.incidence_deg) for row in rows), slopes(rows)
    if largest <= LARGEST_RADIANS and abs(lift) > STEEPEST:
        raise PolarFileError(
            f"{path}, line {rows[-1].line}: incidence_deg ends at {rows[-1].incidence_deg:g}, and "
            f"cl changes by {math.radians(lift):.2g} a degree, where a thin airfoil has 0.11; the "
            "angles look like radians: give them in degrees"
        )


def slopes(rows: Sequence[Row]) -> tuple[float, float]:
    """Return the slopes of c_l and c_m (1/rad) between the points around zero lift.

    Of several such pairs the one nearest to zero incidence counts; without one, the two points of
    least lift.
    """
    pairs = list(itertools.pairwise(rows))
    around = [pair for pair in pairs if pair[0].values[1] <= 0.0 <= pair[1].values[1]]
    one, two = min(around or pairs, key=lambda pair: max(abs(row.values[1]) for row in pair))
    lift, moment = (two.values[place] - one.values[place] for place in (1, 2))
    step = math.radians(two.incidence_deg - one.incidence_deg)
    return lift / step, moment / step


def _decided(path: Path, rows: Sequence[Row]) -> bool:
    """Tell whether rows are a half polar, where nobody has said so."""
    if any(row.incidence_deg < 0 for row in rows):
        return False
    first = rows[0]
    if first.incidence_deg != 0 or max(map(abs, first.values[1:3])) > SYMMETRY_TOLERANCE:
        found = ", ".join(
            f"{name} {value:g}" for name, value in zip(COLUMNS[:3], first.values, strict=False)
        )
        raise PolarFileError(
            f"{path}, line {first.line}: no negative incidence, and the first point is {found}: "
            "it is open whether the section is symmetric; give symmetric=False to take the polar "
            "as it is, or let it start at 0 deg with cl = cm = 0 to have it mirrored"
        )
    return True


def _check_half(path: Path, rows: Sequence[Row]) -> None:
    for row in rows:
        if row.incidence_deg < 0:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg {row.incidence_deg:g} in the polar of a "
                "symmetric section, which is given from 0 upwards; delete the negative angles, "
                "or declare the section not symmetric (embedded.symmetric: false; "
                "symmetric=False in Python)"
            )
    first = rows[0]
    if first.incidence_deg != 0:
        raise PolarFileError(
            f"{path}, line {first.line}: the polar of a symmetric section starts at "
            f"incidence_deg {first.incidence_deg:g}; wanted 0 first, where cl = cm = 0"
        )
    for name, value in zip(COLUMNS[1:3], first.values[1:3], strict=True):
        if abs(value) > SYMMETRY_TOLERANCE:
            raise PolarFileError(
                f"{path}, line {first.line}: {name} is {value:g} at 0 deg; that of a symmetric "
                f"section vanishes there (up to {SYMMETRY_TOLERANCE:g}); correct it, or declare "
                "the section not symmetric (embedded.symmetric: false; symmetric=False in Python)"
            )
