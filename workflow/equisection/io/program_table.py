"""Tables of XFOIL and of the programs that write as it does: blanks between columns.

A header names the section, and its Reynolds number as in ``Re = 1.000 e 6``; then come a line of
column names that begins with ``alpha``, a line of dashes, and one line a point. Moments are about
the quarter chord, nose up (M. Drela, XFOIL 6.9 User Primer, section "Polar Accumulation").
"""

from __future__ import annotations

import math
import re
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_columns import COLUMNS, check_columns, quantities
from equisection.io.polar_rows import Row
from equisection.io.polar_text import Lines, number

#: Names of two words, which blanks would take apart.
_OF_TWO_WORDS = re.compile(r"\b(Top|Bot) (Xtr)\b")
_REYNOLDS = re.compile(r"\bRe *= *([0-9]+\.?[0-9]*) *(?:e *([+-]?[0-9]{1,2}))?(?![\w.])")


def reynolds_number(lines: Lines) -> float:
    """Return the Reynolds number of a header, as in ``Re = 1.000 e 6``; NaN where it has none."""
    for _, text in lines:
        if text.startswith("alpha"):
            break
        found = _REYNOLDS.search(text)
        if found:
            return float(f"{found[1]}e{found[2] or 0}") or math.nan
    return math.nan


def table_rows(path: Path, lines: Lines, program: str, *, more: bool = False) -> list[Row]:
    """Return the rows of a table.

    Parameters
    ----------
    path
        The file, for messages.
    lines
        Its lines.
    program
        Name of the program.
    more
        Whether lines may have further values behind those that the header names.

    Raises
    ------
    PolarFileError
        With file and line.
    """
    at = next((i for i, (_, text) in enumerate(lines) if text.lower().startswith("alpha")), None)
    if at is None:
        raise PolarFileError(
            f"{path}: no line of column names that begins with 'alpha'; wanted a polar as "
            f"{program} writes it, or a CSV file with the columns {', '.join(COLUMNS)}"
        )
    line, text = lines[at]
    commas = "," in text
    names = _fields(_OF_TWO_WORDS.sub(r"\1_\2", text), commas)
    found = quantities(names, {})
    check_columns(path, line, names, found, {})
    places = [(names[found.index(name)], found.index(name)) for name in COLUMNS]
    rows = []
    for row_line, row_text in lines[at + 1 :]:
        if not row_text or row_text.startswith("-----"):
            continue
        fields = _fields(row_text, commas)
        if len(fields) < len(names) or (len(fields) > len(names) and not more):
            raise PolarFileError(
                f"{path}, line {row_line}: {len(fields)} values under {len(names)} column names; "
                "correct the line or leave it out"
            )
        rows.append(
            Row(row_line, tuple(number(path, row_line, name, fields[i]) for name, i in places))
        )
    return rows


def _fields(text: str, commas: bool) -> list[str]:
    return [field.strip() for field in text.split(",")] if commas else text.split()
