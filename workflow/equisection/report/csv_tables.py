"""Tables of a run as a page shows them: numbers of four digits, long ones cut, the file within."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

from equisection.keys.shown import rounded
from equisection.report.embedded_files import EmbeddingError, data_address

#: Lines of a table that are shown at most.
MOST_LINES = 200
_DIGITS = 4


@dataclass(frozen=True)
class TableShown:
    """A table as a page has it.

    Attributes
    ----------
    file
        Name of its file.
    columns, lines
        Names of the columns, and cells of the first lines.
    count
        Number of all lines.
    address
        The whole file, as an address.
    """

    file: str
    columns: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]
    count: int
    address: str

    @property
    def is_cut(self) -> bool:
        """Tell whether lines are left out."""
        return self.count > len(self.lines)


def table_shown(path: Path) -> TableShown:
    """Read a table of a run, a CSV file.

    Raises
    ------
    EmbeddingError
        The file cannot be read, or has no head.
    """
    try:
        content = path.read_bytes()
        rows = list(csv.reader(io.StringIO(content.decode("utf-8"), newline="")))
    except (OSError, ValueError, csv.Error) as error:
        raise EmbeddingError(f"{path}: cannot be read as a table ({error}); run again") from None
    if not rows:
        raise EmbeddingError(f"{path}: has no head; delete it and run again")
    head, *lines = rows
    shown = tuple(tuple(map(_cell, line)) for line in lines[:MOST_LINES])
    return TableShown(path.name, tuple(head), shown, len(lines), data_address(content, "text/csv"))


def _cell(text: str) -> str:
    """Return a cell, a number of many digits with four of them."""
    try:
        number = float(text)
    except ValueError:
        return text
    if not math.isfinite(number) or len(text) <= _DIGITS + 1:
        return text
    return rounded(number, _DIGITS)
