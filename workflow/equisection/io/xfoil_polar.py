"""Polars that XFOIL accumulates (its command PACC)."""

from __future__ import annotations

from pathlib import Path

from equisection.io.polar_rows import PolarFormat, Row
from equisection.io.polar_text import Lines
from equisection.io.program_table import reynolds_number, table_rows


def _recognises(path: Path, lines: Lines) -> bool:
    first = next((text for _, text in lines if text), "")
    return path.suffix.lower() == ".pol" or first.startswith("XFOIL")


def _read(path: Path, lines: Lines) -> list[Row]:
    return table_rows(path, lines, "XFOIL's PACC")


XFOIL = PolarFormat("XFOIL", _recognises, _read, 0.25, reynolds_number)
