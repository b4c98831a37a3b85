"""Polars as comma-separated files, read and written.

The format: lines that start with ``#`` and empty lines are skipped, the first other line is the
header. Columns ``incidence_deg, cl, cm, cd`` (upper or lower case, also as c_l or C_L, in any
order) are read, each once, others are ignored. Angles in degrees, ascending; moment nose up, about
mid-chord unless the reader is told otherwise.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_rows import COLUMNS, FEWEST_POINTS, Lines, PolarFormat, Row, number

#: What other programs separate columns by.
_OTHER_SEPARATORS = set(";\t ")


def _recognises(path: Path, lines: Lines) -> bool:
    """Take every file: the format that is tried last, whose refusals say what is wanted."""
    del path, lines
    return True


def _read(path: Path, lines: Lines) -> list[Row]:
    used = [(line, text) for line, text in lines if text and not text.startswith("#")]
    if not used:
        raise PolarFileError(
            f"{path}, line 1: the file is empty (or all comment); wanted a header with columns "
            f"{', '.join(COLUMNS)} and {FEWEST_POINTS} or more points"
        )
    (header_line, header), *points = used
    names = [_column(name) for name in _fields(header)]
    twice = [name for name in COLUMNS if names.count(name) > 1]
    if twice:
        raise PolarFileError(
            f"{path}, line {header_line}: more than one column is {', '.join(twice)}; found "
            f"{', '.join(_fields(header))}; delete or rename those that are not to be read"
        )
    missing = [name for name in COLUMNS if name not in names]
    if missing:
        advice = "others are ignored"
        if len(names) == 1 and _OTHER_SEPARATORS & set(header):
            advice = "separated by commas, with a point for decimals"
        raise PolarFileError(
            f"{path}, line {header_line}: no column {', '.join(missing)}; found "
            f"{', '.join(names)}; wanted {', '.join(COLUMNS)} ({advice})"
        )
    return [_row(path, line, text, names) for line, text in points]


def _column(name: str) -> str:
    """Return the name of a column, which may be written as the symbol is: c_l, C_L."""
    name = name.strip().lower()
    return name.replace("c_", "c", 1) if name.startswith("c_") else name


def _fields(text: str) -> list[str]:
    return next(csv.reader([text], skipinitialspace=True))


def _row(path: Path, line: int, text: str, names: list[str]) -> Row:
    fields = _fields(text)
    if len(fields) != len(names):
        raise PolarFileError(
            f"{path}, line {line}: {len(fields)} values under {len(names)} column names; wanted "
            "one value for each column, separated by commas"
        )
    by_name = dict(zip(names, fields, strict=True))
    return Row(line, tuple(number(path, line, name, by_name[name]) for name in COLUMNS))


def csv_text(rows: Iterable[tuple[Sequence[float], str]], comments: Iterable[str]) -> str:
    """Return points of a polar as the text of a file.

    Parameters
    ----------
    rows
        Values in the order of COLUMNS, moment about mid-chord, with how they were obtained.
    comments
        Lines for the top of the file.
    """
    text = io.StringIO()
    text.writelines(f"# {comment}\n" for comment in comments)
    table = csv.writer(text, lineterminator="\n")
    table.writerow((*COLUMNS, "method"))
    for (incidence_deg, *coefficients), method in rows:
        table.writerow((f"{incidence_deg:g}", *(f"{value:.5f}" for value in coefficients), method))
    return text.getvalue()


CSV = PolarFormat("CSV", _recognises, _read, moment_axis=None)
