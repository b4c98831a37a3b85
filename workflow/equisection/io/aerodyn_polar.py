"""Airfoil tables of AeroDyn (OpenFAST), read and written: values before their names.

The line ``<n> NumAlf`` says how many rows follow, each with alpha (deg), c_l, c_d and c_m, and
perhaps the least pressure. The moment is about the quarter chord, nose up, and the line
``<x> Re`` has the Reynolds number in millions (OpenFAST's documentation, "AeroDyn: Airfoil Data
Input File"). A file with tables for several Reynolds numbers is refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_columns import COLUMNS, quantities
from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines, decimal, is_number, number

#: Columns of a row by their places in it.
_PLACES = {"alpha": 0, "Cl": 1, "Cm": 3, "Cd": 2}
_COUNT, _TABLES, _REYNOLDS = "NumAlf", "NumTabs", "Re"
#: Values of a row: those of _PLACES, and perhaps the least pressure.
_VALUES = (4, 5)


def _named(lines: Lines, name: str) -> list[tuple[int, int, str]]:
    """Return place, line number and value of the lines that give a name its value."""
    return [
        (place, line, text.split()[0])
        for place, (line, text) in enumerate(lines)
        if text.split(maxsplit=2)[1:2] == [name]
    ]


def _recognises(path: Path, lines: Lines) -> bool:
    del path
    return any(text.split(maxsplit=2)[1:2] == [_COUNT] for _, text in lines[:1000])


def _read(path: Path, lines: Lines) -> list[Row]:
    used = [(line, text) for line, text in lines if text and not text.startswith("!")]
    tables = _named(used, _COUNT)
    said = [value for _, _, value in _named(used, _TABLES)]
    if len(tables) > 1 or any(value != "1" for value in said):
        raise PolarFileError(
            f"{path}, line {tables[-1][1]}: {len(tables)} tables (NumTabs "
            f"{', '.join(said) or 'is missing'}); wanted the one of your Reynolds number: delete "
            "the others, and write 1 for NumTabs"
        )
    ((place, line, value),) = tables
    count = number(path, line, _COUNT, value)
    points = used[place + 1 :]
    if len(points) != count:
        raise PolarFileError(
            f"{path}, line {line}: NumAlf is {count:g}, and {len(points)} rows follow; correct one "
            "of the two"
        )
    _check_order(path, lines, line)
    rows = [(row_line, text.partition("!")[0].split()) for row_line, text in points]
    found = [_row(path, row_line, fields) for row_line, fields in rows]
    for row_line, fields in rows:
        if len(fields) != len(rows[0][1]):
            raise PolarFileError(
                f"{path}, line {row_line}: {len(fields)} values under rows of {len(rows[0][1])}; "
                "correct the line or leave it out"
            )
    return found


def _check_order(path: Path, lines: Lines, count_line: int) -> None:
    """Refuse a table whose comment names its columns in another order."""
    for line, text in lines[count_line : count_line + 5]:
        if not text.startswith("!"):
            return
        found = [name for name in quantities(text.strip("! ").split(), {}) if name]
        if len(found) >= 3 and found != [COLUMNS[0], "cl", "cd", "cm"]:
            raise PolarFileError(
                f"{path}, line {line}: the columns are {', '.join(found)}; wanted alpha, Cl, Cd, "
                "Cm, as AeroDyn reads them (InCol_Alfa 1 to InCol_Cm 4)"
            )


def _row(path: Path, line: int, fields: list[str]) -> Row:
    if len(fields) not in _VALUES:
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values; wanted alpha, Cl, Cd and Cm"
        )
    return Row(
        line, tuple(number(path, line, name, fields[place]) for name, place in _PLACES.items())
    )


def _reynolds_number(lines: Lines) -> float:
    values = [value for _, _, value in _named(lines, _REYNOLDS) if is_number(value)]
    return 1e6 * decimal(values[0]) if values and decimal(values[0]) > 0.0 else math.nan


def aerodyn_text(
    points: Iterable[Sequence[float]],
    reynolds_number: float,
    comments: Iterable[str],
    *,
    unsteady: bool = False,
) -> str:
    """Return points of a polar as the text of an airfoil table of AeroDyn.

    The moment is moved to the quarter chord, c_m,1/4 = c_m - (c_l cos alpha + c_d sin alpha)/4.
    AeroDyn warns where a table does not go from -180 to 180 deg; no value is made up here.

    Parameters
    ----------
    points
        Values in the order of COLUMNS, angles ascending, moment about mid-chord.
    reynolds_number
        Reynolds number; written as 1 million, with a comment, where it is NaN.
    comments
        Lines for the top of the file.
    unsteady
        Announce data of unsteady aerodynamics, and give none: OpenFAST computes from the table
        whatever is missing, which its unsteady models need.
    """
    known = math.isfinite(reynolds_number)
    rows = []
    for incidence_deg, lift, moment, drag in points:
        alpha = math.radians(incidence_deg)
        about_quarter = moment - 0.25 * (lift * math.cos(alpha) + drag * math.sin(alpha))
        rows.append(f"{incidence_deg:10.4f} {lift:10.5f} {drag:10.5f} {about_quarter:10.5f}")
    millions = f"{reynolds_number / 1e6:.6g}" if known else "1.0"
    whose = "Reynolds number in millions" + ("" if known else " (not known: any)")
    lines = [
        "! ------------ AirfoilInfo Input File ----------------------------------",
        *(f"! {comment}" for comment in comments),
        '"DEFAULT"     InterpOrd         ! Interpolation order',
        '"DEFAULT"     RelThickness      ! Thickness over chord, for unsteady models that need it',
        "          1   NonDimArea        ! Area of the airfoil over chord squared",
        "          0   NumCoords         ! Coordinates of the shape: none",
        '     "unused" BL_file           ! File of boundary-layer characteristics',
        "          1   NumTabs           ! Number of tables",
        f" {millions:>10}   Re                ! {whose}",
        "          0   UserProp          ! User property (control setting)",
        "True          InclUAdata        ! Unsteady coefficients: OpenFAST computes them"
        if unsteady
        else "False         InclUAdata        ! No data of unsteady aerodynamics",
        f" {len(rows):10d}   NumAlf            ! Number of data lines in the following table",
        "!    Alpha         Cl         Cd         Cm",
        "!    (deg)        (-)        (-)        (-)",
        *rows,
    ]
    return "\n".join(lines) + "\n"


AERODYN = PolarFormat("AeroDyn", _recognises, _read, 0.25, _reynolds_number)
