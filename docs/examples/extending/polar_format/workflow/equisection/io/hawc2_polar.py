"""Profile coefficients of HAWC2 (files ``..._pc.dat``): sets of profiles, each with its rows.

The first line has the number of sets and the second that of profiles in the set. The line of a
profile has its number, how many rows follow and its thickness (%). A row has alpha (deg), c_l, c_d
and c_m, the moment about the quarter chord, nose up ("How 2 HAWC2, the user's manual", DTU). A file
with several sets or profiles is refused: it is open which one is meant.
"""

from __future__ import annotations

from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines, number

#: Columns of a row by their places in it.
_PLACES = {"alpha": 0, "Cl": 1, "Cm": 3, "Cd": 2}


def _recognises(path: Path, lines: Lines) -> bool:
    del lines
    return path.name.lower().endswith("_pc.dat")


def _read(path: Path, lines: Lines) -> list[Row]:
    used = [(line, text.split()) for line, text in lines if text]
    if len(used) < len(("sets", "profiles", "profile")):
        raise PolarFileError(f"{path}: {len(used)} lines; wanted one profile and its rows")
    for what, (line, fields) in zip(("sets", "profiles"), used, strict=False):
        if number(path, line, f"number of {what}", fields[0]) != 1:
            raise PolarFileError(
                f"{path}, line {line}: {fields[0]} {what}; wanted one: delete the others"
            )
    line, profile = used[2]
    count = number(path, line, "number of rows", " ".join(profile[1:2]))
    if len(used[3:]) != count:
        raise PolarFileError(
            f"{path}, line {line}: {count:g} rows are announced, and {len(used[3:])} follow; "
            "correct one of the two"
        )
    return [_row(path, row_line, fields) for row_line, fields in used[3:]]


def _row(path: Path, line: int, fields: list[str]) -> Row:
    if len(fields) != len(_PLACES):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values; wanted alpha, Cl, Cd and Cm"
        )
    return Row(
        line, tuple(number(path, line, name, fields[place]) for name, place in _PLACES.items())
    )


HAWC2 = PolarFormat("HAWC2", _recognises, _read, moment_axis=0.25)
