"""Polars that QBlade exports: tables as XFOIL's, and its own polar files (``.plr``).

In a polar file values stand before their keys, as in ``1e6 REYNOLDS``; the rows below have alpha
(deg), c_l, c_d and c_m. Moments are about the quarter chord, nose up (QBlade's documentation,
"Polar"). A file for several Reynolds numbers, and one with decomposed (attached and separated)
coefficients, is refused, since it is open which rows are meant.
"""

from __future__ import annotations

import math
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io import program_table
from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines, decimal, is_number, number

#: Columns of a row of a polar file by their places in it.
_PLACES = {"alpha": 0, "Cl": 1, "Cm": 3, "Cd": 2}
_KEY, _DECOMPOSED = "REYNOLDS", "ISDECOMPOSED"


def _recognises(path: Path, lines: Lines) -> bool:
    del path
    first = next((text for _, text in lines if text), "")
    return "qblade" in first.lower() or _is_polar_file(lines)


def _is_polar_file(lines: Lines) -> bool:
    return any("POLARNAME" in text.split() for _, text in lines[:100])


def _values(lines: Lines, key: str) -> tuple[int, list[str]]:
    """Return the line of a key and the values before it; line 0 where there is none."""
    for line, text in lines[:100]:
        fields = text.split()
        if key in fields:
            return line, fields[: fields.index(key)]
    return 0, []


def _read(path: Path, lines: Lines) -> list[Row]:
    if not _is_polar_file(lines):
        return program_table.table_rows(path, lines, "QBlade", more=True)
    line, reynolds = _values(lines, _KEY)
    if len(reynolds) > 1:
        raise PolarFileError(
            f"{path}, line {line}: {len(reynolds)} Reynolds numbers; wanted the polar of one: "
            "export it alone"
        )
    decomposed_line, decomposed = _values(lines, _DECOMPOSED)
    if decomposed and decomposed[0].lower() not in ("0", "false"):
        raise PolarFileError(
            f"{path}, line {decomposed_line}: the polar is decomposed into attached and separated "
            "flow; export it without (ISDECOMPOSED 0)"
        )
    rows = [
        (row_line, text.split())
        for row_line, text in lines
        if text and all(map(is_number, text.split()))
    ]
    for row_line, fields in rows:
        if len(fields) != len(_PLACES):
            raise PolarFileError(
                f"{path}, line {row_line}: {len(fields)} values; wanted alpha, Cl, Cd and Cm"
            )
    if rows:
        _refuse_other_lines(path, lines, rows[0][0])
    return [
        Row(
            row_line,
            tuple(number(path, row_line, name, fields[place]) for name, place in _PLACES.items()),
        )
        for row_line, fields in rows
    ]


def _refuse_other_lines(path: Path, lines: Lines, first: int) -> None:
    """Refuse lines among the rows that are no row, such as one with a value that is not known."""
    for line, text in lines[first:]:
        if text and not text.startswith("--") and not all(map(is_number, text.split())):
            raise PolarFileError(
                f"{path}, line {line}: no row of alpha, Cl, Cd and Cm among such rows; correct it "
                "or leave it out"
            )


def _reynolds_number(lines: Lines) -> float:
    if not _is_polar_file(lines):
        return program_table.reynolds_number(lines)
    _, values = _values(lines, _KEY)
    return decimal(values[0]) if values and is_number(values[0]) else math.nan


QBLADE = PolarFormat("QBlade", _recognises, _read, 0.25, _reynolds_number)
