"""Formats of polar files: a new one is one module of this folder and its line in `FORMATS`."""

from __future__ import annotations

from pathlib import Path

from equisection.io.csv_polar import CSV
from equisection.io.polar_rows import PolarFormat, PolarRows, check_points, text_lines
from equisection.io.xfoil_polar import XFOIL

#: In the order in which they are asked; CSV takes whatever the others do not.
FORMATS: tuple[PolarFormat, ...] = (XFOIL, CSV)


def read_rows(path: Path, symmetric: bool | None) -> PolarRows:
    """Read the points of the polar file at ``path``, in whichever format it is.

    With ``symmetric`` they must be the half polar alpha >= 0 of a symmetric section; None leaves
    it to the file (:func:`equisection.io.polar_rows.check_points`).

    Raises
    ------
    PolarFileError
        The file cannot be used.
    """
    lines = text_lines(path)
    found = next(format for format in FORMATS if format.recognises(path, lines))
    rows = found.read(path, lines)
    return PolarRows(rows, check_points(path, rows, symmetric), found)
