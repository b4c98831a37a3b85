"""Polars that airfoiltools.com offers as CSV: XFOIL's, below lines of a key and a value.

The moment is XFOIL's, about the quarter chord.
"""

from __future__ import annotations

import math
from pathlib import Path

from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines, decimal, is_number
from equisection.io.program_table import table_rows

#: Lines at the top that are looked through.
_TOP = 30


def _recognises(path: Path, lines: Lines) -> bool:
    del path
    return any(text.lower().startswith("polar key,") for _, text in lines[:_TOP])


def _read(path: Path, lines: Lines) -> list[Row]:
    return table_rows(path, lines, "airfoiltools.com")


def _reynolds_number(lines: Lines) -> float:
    for _, text in lines[:_TOP]:
        key, _, value = text.partition(",")
        if key.lower() == "reynolds number" and is_number(value.strip()):
            return decimal(value.strip())
    return math.nan


AIRFOILTOOLS = PolarFormat("airfoiltools.com", _recognises, _read, 0.25, _reynolds_number)
