"""Polars that XFLR5 and flow5 export, as text or with commas: tables as XFOIL's.

They compute by XFOIL's method, so moments are about the quarter chord (A. Deperrois, "XFLR5:
Analysis of foils and wings operating at low Reynolds numbers", 2009). Lines may have values behind
those that the header names.
"""

from __future__ import annotations

from pathlib import Path

from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines
from equisection.io.program_table import reynolds_number, table_rows


def _recognises(path: Path, lines: Lines) -> bool:
    del path
    first = next((text for _, text in lines if text), "")
    return first.lower().startswith(("xflr5", "flow5"))


def _read(path: Path, lines: Lines) -> list[Row]:
    return table_rows(path, lines, "XFLR5", more=True)


XFLR5 = PolarFormat("XFLR5", _recognises, _read, 0.25, reynolds_number)
