"""Outlines of cross-sections as files: airfoils (Selig, Lednicer), and polygons (CSV).

Coordinates are in any unit, x aft and y up. An airfoil's file (``.dat``) has a title and two
columns: round the section from the trailing edge (Selig), or each side from the leading edge behind
a line with the two numbers of points (Lednicer). A polygon's file (``.csv``) has two columns ``x,
y`` separated by commas, with or without a header; lines with ``#`` and empty lines are skipped.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.errors import OutlineError
from equisection.io.plain_text import plain_text
from equisection.io.polar_text import decimal, quoted

#: Suffixes of the formats.
AIRFOIL, POLYGON = ".dat", ".csv"
#: Largest file that is read (bytes).
_LARGEST = 2_000_000
#: Line, and the numbers on it.
Row = tuple[int, list[float]]


@dataclass(frozen=True)
class OutlineFile:
    """Points of an outline in the file's units, shape (n, 2), in the order round the section.

    Attributes
    ----------
    points
        The points.
    is_airfoil
        The points lie on a smooth curve with its only corners at the trailing edge; those of a
        polygon are its corners.
    """

    points: NDArray[np.float64]
    is_airfoil: bool


def read_outline(path: Path) -> OutlineFile:
    """Return the outline of a file.

    Raises
    ------
    OutlineError
        It cannot be read, or is of no format; the message names file and line.
    """
    suffix = path.suffix.lower()
    if suffix not in (AIRFOIL, POLYGON):
        raise OutlineError(
            f"{path}: allowed is an airfoil of Selig's or Lednicer's format ({AIRFOIL}) or a "
            f"polygon x,y ({POLYGON}); name the file so"
        )
    try:
        text = plain_text(path, "outline", _LARGEST, OutlineError)
    except FileNotFoundError:
        raise OutlineError("there is no such file") from None
    lines = [(number, line.strip()) for number, line in enumerate(text.split("\n"), 1)]
    if suffix == POLYGON:
        return OutlineFile(_polygon(path, lines), is_airfoil=False)
    return OutlineFile(_airfoil(path, lines), is_airfoil=True)


def _polygon(path: Path, lines: list[tuple[int, str]]) -> NDArray[np.float64]:
    used = [(number, line) for number, line in lines if line and not line.startswith("#")]
    if used and re.fullmatch(r'"?x"?\s*,\s*"?y"?', used[0][1], flags=re.IGNORECASE):
        used = used[1:]
    rows = [(number, _numbers(path, number, line.split(","))) for number, line in used]
    return _points(path, rows)


def _airfoil(path: Path, lines: list[tuple[int, str]]) -> NDArray[np.float64]:
    used = [(number, line) for number, line in lines if line and not line.startswith("#")]
    if used and not _is_row(used[0][1]):
        used = used[1:]  # the title
    rows = [
        (number, _numbers(path, number, re.split(r"[\s,]+", line.strip(" ,"))))
        for number, line in used
    ]
    if rows and len(rows[0][1]) == 2 and all(_is_count(value) for value in rows[0][1]):
        upper, lower = (int(count) for count in rows[0][1])
        points = _points(path, rows[1:])
        if len(points) != upper + lower:
            raise OutlineError(
                f"{path}, line {rows[0][0]}: {upper} and {lower} points are announced and "
                f"{len(points)} follow"
            )
        # each side is from the leading edge; round the section from the trailing edge
        return np.concatenate([points[:upper][::-1], points[upper:]])
    return _points(path, rows)


def _is_count(value: float) -> bool:
    """Tell whether a number is a count of points, as no coordinate over the chord is."""
    return value > 1.5 and value.is_integer() and value < 1e5


def _is_row(line: str) -> bool:
    try:
        return len([decimal(part) for part in re.split(r"[\s,]+", line.strip(" ,"))]) == 2
    except ValueError:
        return False


def _numbers(path: Path, line: int, parts: list[str]) -> list[float]:
    try:
        values = [decimal(part) for part in parts]
    except ValueError:
        raise OutlineError(
            f"{path}, line {line}: {quoted(' '.join(parts))}: allowed are two numbers, x and y"
        ) from None
    if len(values) != 2:
        raise OutlineError(f"{path}, line {line}: {len(values)} numbers; allowed are two, x and y")
    if not all(map(math.isfinite, values)):
        raise OutlineError(
            f"{path}, line {line}: {quoted(' '.join(parts))}: allowed are finite numbers"
        )
    return values


def _points(path: Path, rows: list[Row]) -> NDArray[np.float64]:
    if not rows:
        raise OutlineError(f"{path}: no points; wanted are four or more, x and y")
    return np.array([values for _, values in rows])
