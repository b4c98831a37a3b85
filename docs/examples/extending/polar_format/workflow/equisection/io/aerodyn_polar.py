"""Airfoil tables of AeroDyn (OpenFAST): comments behind ``!``, values before their names.

The line ``<n> NumAlf`` says how many rows follow, each with alpha (deg), c_l, c_d and c_m. The
moment is about the quarter chord, nose up (OpenFAST's documentation, "AeroDyn: Airfoil Data Input
File"). Of a file with several tables, for several Reynolds numbers, the first is read.
"""

from __future__ import annotations

from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_rows import Lines, PolarFormat, Row, number

#: Columns of a row by their places in it.
_PLACES = {"alpha": 0, "Cl": 1, "Cm": 3, "Cd": 2}


def _recognises(path: Path, lines: Lines) -> bool:
    del path
    return any(_names_rows(text) for _, text in lines)


def _names_rows(text: str) -> bool:
    return text.split()[1:2] == ["NumAlf"]


def _read(path: Path, lines: Lines) -> list[Row]:
    used = [(line, text) for line, text in lines if text and not text.startswith("!")]
    at = next(place for place, (_, text) in enumerate(used) if _names_rows(text))
    line, text = used[at]
    count = number(path, line, "NumAlf", text.split()[0])
    points = used[at + 1 : at + 1 + int(count)]
    if len(points) != count:
        raise PolarFileError(
            f"{path}, line {line}: NumAlf is {count:g}, and {len(points)} rows follow; correct one "
            "of the two"
        )
    return [_row(path, line, text.split()) for line, text in points]


def _row(path: Path, line: int, fields: list[str]) -> Row:
    if len(fields) < len(_PLACES):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values; wanted alpha, Cl, Cd and Cm"
        )
    return Row(
        line, tuple(number(path, line, name, fields[place]) for name, place in _PLACES.items())
    )


AERODYN = PolarFormat("AeroDyn", _recognises, _read, moment_axis=0.25)
