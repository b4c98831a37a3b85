"""Reading a polar from a CSV file, with refusals that name file and line.

The format: comma-separated, lines that start with ``#`` and empty lines are skipped, the first
other line is the header. Columns ``incidence_deg, cl, cm, cd`` (upper or lower case, in any
order) are read, others are ignored. Angles in degrees, ascending; moment about mid-chord, nose
up. A symmetric section is given for incidence >= 0 only, from 0 on.
"""

from __future__ import annotations

import csv
import itertools
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from equisection.aerodynamics.polar import SYMMETRY_TOLERANCE, SectionPolar
from equisection.errors import PolarFileError

COLUMNS = ("incidence_deg", "cl", "cm", "cd")
FEWEST_POINTS = 4


@dataclass(frozen=True)
class _Row:
    """One point of the file: its line number, and its values in the order of COLUMNS."""

    line: int
    values: tuple[float, ...]

    @property
    def incidence_deg(self) -> float:
        return self.values[0]


def read_polar(path: Path | str, symmetric: bool = True) -> SectionPolar:
    """Polar of the file at ``path``, with the file's name (without suffix) as its label.

    With ``symmetric`` the file holds the half polar alpha >= 0 of a symmetric section, which is
    mirrored; without, the whole polar as it is. The coefficients of a finite beam are read the
    same way (C_L, C_M, C_D in the place of c_l, c_m, c_d).
    """
    path = Path(path)
    rows = _rows(path)
    _check_points(path, rows, symmetric)
    incidence_deg, lift, moment, drag = np.array([row.values for row in rows]).T
    polar = SectionPolar(np.radians(incidence_deg), drag, lift, moment, path.stem)
    return polar.mirrored() if symmetric else polar


def _rows(path: Path) -> list[_Row]:
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
        raise PolarFileError(
            f"{path}, line {header_line}: no column {', '.join(missing)}; found "
            f"{', '.join(names)}; wanted {', '.join(COLUMNS)} (others are ignored)"
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


def _row(path: Path, line: int, text: str, names: list[str]) -> _Row:
    fields = _fields(text)
    if len(fields) != len(names):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values under {len(names)} column names; wanted "
            "one value for each column, separated by commas"
        )
    by_name = dict(zip(names, fields, strict=True))
    return _Row(line, tuple(_number(path, line, name, by_name[name]) for name in COLUMNS))


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


def _check_points(path: Path, rows: list[_Row], symmetric: bool) -> None:
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


def _check_half(path: Path, rows: list[_Row]) -> None:
    for row in rows:
        if row.incidence_deg < 0:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg {row.incidence_deg:g} in the polar of a "
                "symmetric section, which is given from 0 upwards; delete the negative angles, "
                "or declare the section not symmetric"
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
                "the section not symmetric"
            )
