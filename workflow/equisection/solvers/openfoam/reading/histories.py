"""Histories that OpenFOAM writes in addition to its fields, read by the names in their headers.

A run that was resumed leaves a file for each start, named by the time of the start. Times that a
later file repeats replace those of an earlier one.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError

Floats = NDArray[np.float64]

_WITHOUT_PARENTHESES = str.maketrans("()", "  ")
_TOKEN = re.compile(r"\([^()]*\)|[^\s()]+")
#: Relative distance within which two times are the same.
_SAME = 1e-9


def read_history(folder: Path, name: str, columns: Sequence[str]) -> dict[str, Floats]:
    """Return columns of a history over all starts of a run, with ``Time``.

    Parameters
    ----------
    folder
        Folder of the function object, ``postProcessing/<name>``.
    name
        Name of its file, for instance ``coefficient.dat``.
    columns
        Names in the header; a vector has shape (n, 3), a number (n,).

    Raises
    ------
    SolverError
        There is no file, a header does not name the columns, or a row does not fit its header.
    """
    files = _files(folder, name)
    if not files:
        raise SolverError(f"{folder}: no {name}; the run wrote no history")
    # a start that was killed before its first row may not even have a whole header
    parts = [read_table(path, columns) for path in files if path == files[-1] or _has_rows(path)]
    joined = parts[0]
    for part in parts[1:]:
        if not part["Time"].size:
            continue
        first = part["Time"][0]
        keep = joined["Time"] < first - _SAME * max(abs(first), 1.0)
        joined = {key: np.concatenate([joined[key][keep], part[key]]) for key in joined}
    return joined


def _files(folder: Path, name: str) -> list[Path]:
    """Return the files of all starts in the order in which they were written."""
    stem, _, suffix = name.rpartition(".")
    found = []
    for start in folder.glob("*"):
        try:
            time = float(start.name)
        except ValueError:
            continue
        # a second start from the same time has its time in the name of the file
        files = [start / name, *start.glob(f"{stem}_*.{suffix}")]
        found += [
            (time, path.name != name, path.stat().st_mtime, path)
            for path in files
            if path.is_file()
        ]
    return [path for *_, path in sorted(found)]


def _has_rows(path: Path) -> bool:
    with path.open(encoding="utf-8", errors="replace") as lines:
        return any(line.strip() and not line.startswith("#") for line in lines)


def read_table(path: Path, columns: Sequence[str]) -> dict[str, Floats]:
    """Return columns of one file; a last row that is not whole yet is left out.

    Raises
    ------
    SolverError
        The header does not name the columns, or a row does not fit it.
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    lines = text.splitlines()
    header = _header(path, lines, ["Time", *columns])
    rows = [line for line in lines if line.strip() and not line.startswith("#")]
    if rows and not text.endswith("\n"):
        rows.pop()
    if rows and len(_TOKEN.findall(rows[0])) != len(header):
        _require_last(path, 0, rows, len(_TOKEN.findall(rows[0])), len(header))
        rows = []
    if not rows:
        return {name: np.empty(0) for name in ("Time", *columns)}
    # a vector in parentheses is as many words as it has components
    widths = [len(token.strip("()").split()) for token in _TOKEN.findall(rows[0])]
    words = [row.translate(_WITHOUT_PARENTHESES).split() for row in rows]
    for number, row in enumerate(words):
        if len(row) != sum(widths):
            _require_last(path, number, rows, len(row), sum(widths))
            words.pop()
    try:
        table = np.array(words, dtype=float)
    except ValueError as error:
        raise SolverError(f"{path}: a row holds no numbers ({error})") from None
    ends = np.cumsum(widths)
    found = {}
    for name in ("Time", *columns):
        place = header.index(name)
        part = table[:, ends[place] - widths[place] : ends[place]]
        found[name] = part[:, 0] if widths[place] == 1 else part
    return found


def _require_last(path: Path, number: int, rows: Sequence[str], found: int, wanted: int) -> None:
    """Let a row that is cut short pass where it is the last."""
    if number < len(rows) - 1:
        raise SolverError(
            f"{path}: row {number + 1} has {found} columns, wanted are {wanted}; "
            "delete the case's folder in the store and run again"
        )


def _header(path: Path, lines: Sequence[str], wanted: Sequence[str]) -> list[str]:
    """Return the names in the line of the header that begins with Time."""
    for line in lines:
        names = line.lstrip("# ").split()
        if line.startswith("#") and names[:1] == ["Time"]:
            missing = [name for name in wanted if name not in names]
            if missing:
                raise SolverError(
                    f"{path}: columns {', '.join(names)}; wanted is {', '.join(missing)} among "
                    "them. This layout is of a version of OpenFOAM that is not known here"
                )
            return names
    raise SolverError(
        f"{path}: no header that names its columns; this layout is of a version of OpenFOAM that "
        "is not known here"
    )
