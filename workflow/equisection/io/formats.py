"""Formats of polar files: a new one is one module of this folder and its line in `FORMATS`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.aerodyn_polar import AERODYN
from equisection.io.airfoiltools_polar import AIRFOILTOOLS
from equisection.io.csv_polar import CSV, read_named
from equisection.io.polar_checks import ascending, check_points, require_enough
from equisection.io.polar_columns import COLUMNS
from equisection.io.polar_rows import PolarFormat, PolarRows
from equisection.io.polar_text import quoted, text_lines
from equisection.io.qblade_polar import QBLADE
from equisection.io.xflr5_polar import XFLR5
from equisection.io.xfoil_polar import XFOIL

#: In the order in which they are asked; CSV takes whatever the others do not.
FORMATS: tuple[PolarFormat, ...] = (XFOIL, XFLR5, QBLADE, AIRFOILTOOLS, AERODYN, CSV)


def read_rows(
    path: Path, symmetric: bool | None, columns: Mapping[str, str] | None = None
) -> PolarRows:
    """Read the points of the polar file at ``path``, in whichever format it is.

    With ``symmetric`` they must be the half polar alpha >= 0 of a symmetric section; None leaves
    it to the file (:func:`equisection.io.polar_checks.check_points`). ``columns`` are names of the
    columns of a CSV file by quantity, where they are not the usual ones.

    Raises
    ------
    PolarFileError
        The file cannot be used.
    """
    given = _checked(path, columns or {})
    lines = text_lines(path)
    found = next(format for format in FORMATS if format.recognises(path, lines))
    rows = read_named(path, lines, given) if found is CSV else found.read(path, lines)
    require_enough(path, rows)
    rows = ascending(path, rows)
    require_enough(path, rows)
    half = check_points(path, rows, symmetric)
    return PolarRows(rows, half, found, found.reynolds_number(lines))


def reynolds_number(path: Path) -> float:
    """Return the Reynolds number that the polar file at ``path`` says; NaN where it says none.

    Raises
    ------
    PolarFileError
        The file cannot be read.
    """
    lines = text_lines(path)
    found = next(format for format in FORMATS if format.recognises(path, lines))
    return found.reynolds_number(lines)


def _checked(path: Path, columns: Mapping[str, str]) -> dict[str, str]:
    """Return the names of columns that are given; refuse those of no quantity, and one for two."""
    given = {quantity: name.strip() for quantity, name in columns.items() if name.strip()}
    unknown = [quantity for quantity in given if quantity not in COLUMNS]
    if unknown:
        raise PolarFileError(
            f"{path}: columns names {quoted(unknown[0])}; allowed are {', '.join(COLUMNS)}"
        )
    if len(set(given.values())) < len(given):
        raise PolarFileError(
            f"{path}: columns gives one name to two quantities "
            f"({', '.join(f'{quantity}: {quoted(name)}' for quantity, name in given.items())}); "
            "wanted one column for each"
        )
    return given
