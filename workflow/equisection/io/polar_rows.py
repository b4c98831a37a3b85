"""The rows of a polar file, with refusals that name file and line.

Nothing here loads numerics, so that the workflow can look at the files before any job starts. The
format is that of :mod:`equisection.io.polar_file`.
"""

from __future__ import annotations

import csv
import itertools
import math
from dataclasses import dataclass
from pathlib import Path

from equisection.conventions import SYMMETRY_TOLERANCE
from equisection.errors import PolarFileError

COLUMNS = ("incidence_deg", "cl", "cm", "cd")
FEWEST_POINTS = 4
#: How a comment begins that says what beam and flow a polar is of.
_VALID_FOR = "# Valid for:"
_TRUTH = {"true": True, "false": False}
#: What other programs separate columns by.
_OTHER_SEPARATORS = set(";\t ")


@dataclass(frozen=True)
class Row:
    """One point of the file: its line number, and its values in the order of COLUMNS."""

    line: int
    values: tuple[float, ...]

    @property
    def incidence_deg(self) -> float:
        """Incidence (deg)."""
        return self.values[0]


def read_rows(path: Path, symmetric: bool) -> list[Row]:
    """Return the points of the file at ``path``.

    With ``symmetric`` they must be the half polar alpha >= 0 of a symmetric section.

    Raises
    ------
    PolarFileError
        The file cannot be used.
    """
    rows = _rows(path)
    _check_points(path, rows, symmetric)
    return rows


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
    for number, text in _lines(path):
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


def _rows(path: Path) -> list[Row]:
    lines = [(number, text) for number, text in _lines(path) if text and not text.startswith("#")]
    if not lines:
        raise PolarFileError(
            f"{path}, line 1: the file is empty (or all comment); wanted a header with columns "
            f"{', '.join(COLUMNS)} and {FEWEST_POINTS} or more points"
        )
    (header_line, header), *points = lines
    names = [_column(name) for name in _fields(header)]
    missing = [name for name in COLUMNS if name not in names]
    if missing:
        advice = "others are ignored"
        if len(names) == 1 and _OTHER_SEPARATORS & set(header):
            advice = "separated by commas, with a point for decimals"
        raise PolarFileError(
            f"{path}, line {header_line}: no column {', '.join(missing)}; found "
            f"{', '.join(names)}; wanted {', '.join(COLUMNS)} ({advice})"
        )
    return [_row(path, line, text, names) for line, text in points]


def _lines(path: Path) -> list[tuple[int, str]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise PolarFileError(
            f"{path}: no such polar file (looked from {Path.cwd()}); check the path in the "
            "configuration"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise PolarFileError(f"{path}: cannot be read as a text file: {error}") from error
    return [(number, line.strip()) for number, line in enumerate(text.splitlines(), start=1)]


def _column(name: str) -> str:
    """Return the name of a column, which may be written as the symbol is: c_l, C_L."""
    name = name.strip().lower()
    return name.replace("c_", "c", 1) if name.startswith("c_") else name


def _fields(text: str) -> list[str]:
    return next(csv.reader([text], skipinitialspace=True))


def _row(path: Path, line: int, text: str, names: list[str]) -> Row:
    fields = _fields(text)
    if len(fields) != len(names):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values under {len(names)} column names; wanted "
            "one value for each column, separated by commas"
        )
    by_name = dict(zip(names, fields, strict=True))
    return Row(line, tuple(_number(path, line, name, by_name[name]) for name in COLUMNS))


def _number(path: Path, line: int, name: str, text: str) -> float:
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


def _check_points(path: Path, rows: list[Row], symmetric: bool) -> None:
    if len(rows) < FEWEST_POINTS:
        where = f", line {rows[-1].line}" if rows else ""
        raise PolarFileError(
            f"{path}{where}: the file ends after {len(rows)} points; {FEWEST_POINTS} or more are "
            "needed to interpolate"
        )
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


def _check_half(path: Path, rows: list[Row]) -> None:
    for row in rows:
        if row.incidence_deg < 0:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg {row.incidence_deg:g} in the polar of a "
                "symmetric section, which is given from 0 upwards; delete the negative angles, "
                "or declare the section not symmetric (embedded.symmetric: false)"
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
                "the section not symmetric (embedded.symmetric: false)"
            )
