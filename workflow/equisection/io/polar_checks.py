"""Checks that the points of a polar pass, in whichever format they are: order, sense, symmetry."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from equisection.conventions import SYMMETRY_TOLERANCE
from equisection.errors import PolarFileError
from equisection.io.polar_columns import COLUMNS
from equisection.io.polar_rows import Row, slopes

FEWEST_POINTS = 4
#: Largest coefficient (-) and angle (deg), and least step (deg), of a polar that makes sense.
LARGEST_COEFFICIENT, LARGEST_ANGLE, LEAST_STEP = 20.0, 180.0, 1e-6
#: Most stretches of rising or falling angles that a file may have.
MOST_RUNS = 8
#: Slope of the lift (1/rad) that no section has, and the angle (deg) below which those of a whole
#: polar are radians with such a slope: a thin airfoil would have 360.
STEEPEST, LARGEST_RADIANS = 30.0, 1.6


def ascending(path: Path, rows: Sequence[Row]) -> list[Row]:
    """Return rows by ascending incidence, each angle once.

    A file may go down, or up from the middle and then down from it, as many are measured and
    computed. One that comes back among angles that it has passed may be a loop of hysteresis,
    whose branches must not be mixed, and is refused. A point that is there twice counts once.

    Raises
    ------
    PolarFileError
        With file and lines.
    """
    rows = _once(rows)
    in_order = sorted(rows, key=lambda row: row.incidence_deg)
    for before, row in itertools.pairwise(in_order):
        if row.incidence_deg == before.incidence_deg:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg {row.incidence_deg:g} repeats that of "
                f"line {before.line} with other values; wanted each angle once: delete one of the "
                "lines, or write their average"
            )
    _refuse_loops(path, rows)
    for before, row in itertools.pairwise(in_order):
        if row.incidence_deg - before.incidence_deg < LEAST_STEP:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg is {row.incidence_deg!r}, less than "
                f"{LEAST_STEP:g} deg from that of line {before.line}; delete one of the lines"
            )
    return in_order


def _once(rows: Sequence[Row]) -> list[Row]:
    """Return rows without those whose values are all there already."""
    first: dict[tuple[float, ...], Row] = {}
    for row in rows:
        first.setdefault(row.values, row)
    return list(first.values())


def _refuse_loops(path: Path, rows: Sequence[Row]) -> None:
    """Refuse rows that turn back among angles that they have passed, or that turn often."""
    passed: list[tuple[float, float]] = []
    for run in _runs(rows):
        low, high = sorted((run[0].incidence_deg, run[-1].incidence_deg))
        inside = [between for between in passed if low < between[1] and between[0] < high]
        if inside or len(passed) == MOST_RUNS:
            least, greatest = inside[0] if inside else (passed[0][0], passed[-1][1])
            raise PolarFileError(
                f"{path}, line {run[0].line}: incidence_deg {run[0].incidence_deg:g} goes back "
                f"after the angles from {least:g} to {greatest:g}; sort the angles upwards, each "
                "once; of a loop of hysteresis write one branch"
            )
        passed.append((low, high))


def _runs(rows: Sequence[Row]) -> Iterator[Sequence[Row]]:
    """Give the stretches of rows in which the angle only rises or only falls."""
    start, way = 0, 0.0
    for place, (before, row) in enumerate(itertools.pairwise(rows), start=1):
        step = row.incidence_deg - before.incidence_deg
        if step * way < 0.0:
            yield rows[start:place]
            start, way = place, 0.0
        else:
            way = step
    yield rows[start:]


def check_points(path: Path, rows: Sequence[Row], symmetric: bool | None) -> bool:
    """Refuse rows that make no polar; tell whether they are the half polar of a symmetric section.

    Without ``symmetric`` the rows decide: with a negative angle they are a whole polar, from 0 on
    without lift and moment there a half one, and anything else is refused as ambiguous.

    Parameters
    ----------
    path
        The file, for messages.
    rows
        By ascending incidence.
    symmetric
        Whether they must be a half polar.

    Raises
    ------
    PolarFileError
        With file and line.
    """
    _refuse_nonsense(path, rows)
    if symmetric is None:
        symmetric = _decided(path, rows)
    if symmetric:
        _check_half(path, rows)
    _refuse_radians(path, rows)
    return symmetric


def require_enough(path: Path, rows: Sequence[Row]) -> None:
    """Refuse fewer rows than can be interpolated.

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


def _refuse_nonsense(path: Path, rows: Sequence[Row]) -> None:
    """Refuse values that no polar has: a slip of units, columns or digits."""
    for row in rows:
        angle, *coefficients = row.values
        if abs(angle) > LARGEST_ANGLE:
            raise PolarFileError(
                f"{path}, line {row.line}: incidence_deg is {angle:g}; allowed is -180 to 180 (of "
                "an angle beyond take 360 off or add it)"
            )
        for name, value in zip(COLUMNS[1:], coefficients, strict=True):
            if abs(value) > LARGEST_COEFFICIENT:
                raise PolarFileError(
                    f"{path}, line {row.line}: {name} is {value:g}; allowed is "
                    f"-{LARGEST_COEFFICIENT:g} to {LARGEST_COEFFICIENT:g} (is it a coefficient, "
                    "with a point for decimals, in the right column?)"
                )
        if coefficients[2] < 0.0:
            raise PolarFileError(
                f"{path}, line {row.line}: cd is {coefficients[2]:g}; a drag is not negative: "
                "correct it (0 for a flow without friction), or check the columns and signs"
            )
    if not any(value for row in rows for value in row.values[1:]):
        raise PolarFileError(
            f"{path}, line {rows[0].line}: every cl, cm and cd is 0; wanted the coefficients of a "
            "section"
        )


def _refuse_radians(path: Path, rows: Sequence[Row]) -> None:
    """Refuse angles that look like radians, by a lift that no section has per degree."""
    largest, (lift, _) = max(abs(row.incidence_deg) for row in rows), slopes(rows)
    if largest <= LARGEST_RADIANS and abs(lift) > STEEPEST:
        raise PolarFileError(
            f"{path}, line {rows[-1].line}: incidence_deg ends at {rows[-1].incidence_deg:g}, and "
            f"cl changes by {math.radians(lift):.2g} a degree, where a thin airfoil has 0.11; the "
            "angles look like radians: give them in degrees"
        )


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
