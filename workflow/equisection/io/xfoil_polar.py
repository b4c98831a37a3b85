"""Polars that XFOIL accumulates (its command PACC): blanks between columns, moment at c/4.

A header names the section and its Reynolds number; then come a line of column names that begins
with ``alpha``, a line of dashes, and one line a point. XFOIL's moment is about the quarter chord,
nose up (M. Drela, XFOIL 6.9 User Primer, section "Polar Accumulation").
"""

from __future__ import annotations

from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_rows import COLUMNS, Lines, PolarFormat, Row, number

#: XFOIL's names of COLUMNS.
_NAMES = ("alpha", "CL", "CM", "CD")


def _recognises(path: Path, lines: Lines) -> bool:
    first = next((text for _, text in lines if text), "")
    return path.suffix.lower() == ".pol" or first.startswith("XFOIL")


def _read(path: Path, lines: Lines) -> list[Row]:
    header = next((i for i, (_, text) in enumerate(lines) if text.startswith("alpha")), None)
    if header is None:
        raise PolarFileError(
            f"{path}: no line of column names that begins with 'alpha'; wanted a polar as XFOIL's "
            "PACC writes it, or a CSV file with the columns " + ", ".join(COLUMNS)
        )
    line, text = lines[header]
    names = text.split()
    missing = [name for name in _NAMES if name not in names]
    if missing:
        raise PolarFileError(
            f"{path}, line {line}: no column {', '.join(missing)}; found {', '.join(names)}"
        )
    return [
        _row(path, line, text, names)
        for line, text in lines[header + 1 :]
        if text and not text.startswith("-----")
    ]


def _row(path: Path, line: int, text: str, names: list[str]) -> Row:
    fields = text.split()
    if len(fields) != len(names):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values under {len(names)} column names"
        )
    by_name = dict(zip(names, fields, strict=True))
    return Row(line, tuple(number(path, line, name, by_name[name]) for name in _NAMES))


XFOIL = PolarFormat("XFOIL", _recognises, _read, moment_axis=0.25)
