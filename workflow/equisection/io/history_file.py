"""Histories as tables of other programs: columns, units and signs of each, read to one meaning.

A file is text with a line of column names over lines of numbers, separated by commas, semicolons,
tabs or blanks. Names may be in quotes, and the line of names in parentheses or behind a ``#``, as
monitors and reports of flow solvers write them. Lines before it are skipped.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.conventions import dynamic_pressure
from equisection.errors import HistoryFileError
from equisection.io.plain_text import plain_text
from equisection.io.polar_text import quoted, shortened

Floats = NDArray[np.float64]

#: Quantities of a history that every file has; ``drag`` is read where a column is named for it.
NEEDED = ("time", "twist", "deflection", "lift", "moment")
QUANTITIES = (*NEEDED, "drag")
#: Units of each quantity; ``b`` is the semi-chord c/2, ``1`` a coefficient over q c or q c^2.
UNITS: dict[str, tuple[str, ...]] = {
    "time": ("s", "ms", "c/V", "b/V"),
    "twist": ("rad", "deg"),
    "deflection": ("m", "mm", "c", "b"),
    "lift": ("N", "N/m", "1"),
    "moment": ("N m", "N m/m", "1"),
    "drag": ("N", "N/m", "1"),
}
_SEPARATORS = (",", ";", "\t", " ")
#: A step over the usual one above which samples are missing (-), and the fewest samples.
_GAP, _FEWEST = 5.0, 16
#: Largest file that is read (bytes): some 10^6 samples.
MOST_BYTES = 200_000_000


@dataclass(frozen=True)
class HistoryScales:
    """Scales by which units become those of the flow.

    Attributes
    ----------
    chord, span
        c, and the length that forces in N are of (m).
    density, speed
        rho (kg/m^3), V (m/s) of the record.
    """

    chord: float
    density: float
    speed: float
    span: float = 1.0

    def factor(self, quantity: str, unit: str) -> float:
        """Return the factor from a unit to c/V, rad, chords, or coefficients."""
        rate, force = (
            self.speed / self.chord,
            1.0 / (dynamic_pressure(self.density, self.speed) * self.chord),
        )
        if quantity == "time":
            return {"s": rate, "ms": 1e-3 * rate, "c/V": 1.0, "b/V": 0.5}[unit]
        if quantity == "twist":
            return {"rad": 1.0, "deg": math.radians(1.0)}[unit]
        if quantity == "deflection":
            return {"m": 1.0 / self.chord, "mm": 1e-3 / self.chord, "c": 1.0, "b": 0.5}[unit]
        arm = self.chord if quantity == "moment" else 1.0
        per_span = "N m/m" if quantity == "moment" else "N/m"
        return 1.0 if unit == "1" else force / arm / (1.0 if unit == per_span else self.span)


@dataclass(frozen=True)
class HistoryColumns:
    """Meaning of the columns of a file.

    Attributes
    ----------
    names
        Column of each of :data:`QUANTITIES`.
    units
        Unit of each (:data:`UNITS`).
    signs
        1, or -1 where positive is the other way: nose down, or downwards.
    release
        Time of the release in the file's unit; earlier lines are left out. None for its first.
    """

    names: Mapping[str, str]
    units: Mapping[str, str]
    signs: Mapping[str, int] = field(default_factory=dict)
    release: float | None = None


@dataclass(frozen=True)
class HistoryTable:
    """History as read, in units of rho/2, V and c, each of shape (n,).

    Attributes
    ----------
    time
        s since the release (c/V), rising.
    twist, deflection
        rad, nose up, and chords, up.
    lift, moment, drag
        Coefficients; ``drag`` is empty where it is not recorded.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift: Floats
    moment: Floats
    drag: Floats

    def sampled(self, interval: float, end: float = math.inf) -> HistoryTable:
        """Return the history at uniform times, up to its last one or an end."""
        last = float(self.time[-1])
        number = math.floor(min(last, end) / interval * (1 + 1e-9)) + 1
        return self.at(np.minimum(np.arange(number) * interval, last))

    def at(self, time: Floats) -> HistoryTable:
        """Return the history at other times, by cubic splines through the samples."""
        from scipy.interpolate import CubicSpline  # noqa: PLC0415, costly for a reader alone

        def there(values: Floats) -> Floats:
            return np.asarray(CubicSpline(self.time, values)(time)) if values.size else values

        return HistoryTable(
            time,
            there(self.twist),
            there(self.deflection),
            there(self.lift),
            there(self.moment),
            there(self.drag),
        )


def read_table(path: Path, columns: HistoryColumns, scales: HistoryScales) -> HistoryTable:
    """Read a history.

    Raises
    ------
    HistoryFileError
        The file is missing, has no such columns, or its samples have gaps, come twice or are not
        numbers; the message names file and line.
    """
    first, frame = _frame(path, columns)
    values: dict[str, Floats] = {}
    for quantity, name in columns.names.items():
        if not name:
            continue
        found = pd.to_numeric(frame[name], errors="coerce").to_numpy(dtype=np.float64)
        wrong = np.flatnonzero(~np.isfinite(found))
        if wrong.size:
            cell = quoted(str(frame[name].iloc[wrong[0]]))
            raise HistoryFileError(
                f"{path}, line {first + int(wrong[0])}: {name} is {cell}; wanted a finite number"
            )
        values[quantity] = found
    time = values["time"]
    _require_rising(path, first, columns.names["time"], time)
    start = float(time[0]) if columns.release is None else columns.release
    kept = time >= start - 1e-9 * max(abs(start), float(time[-1]))
    if kept.sum() < _FEWEST:
        raise HistoryFileError(
            f"{path}: {int(kept.sum())} samples from the release at {start:g} on; {_FEWEST} or "
            f"more are needed ({columns.names['time']} goes from {time[0]:g} to {time[-1]:g})"
        )
    values["time"] = time - start
    if columns.release is not None and time[kept][0] - start > 2.0 * np.median(np.diff(time)):
        raise HistoryFileError(
            f"{path}: the first sample is at {time[kept][0]:g}, after the release at {start:g}; "
            "correct given.release, or write the history from the release on"
        )
    in_flow = {
        name: columns.signs.get(name, 1) * scales.factor(name, columns.units[name]) * found[kept]
        for name, found in values.items()
    }
    return HistoryTable(**{name: in_flow.get(name, np.empty(0)) for name in QUANTITIES})


def _require_rising(path: Path, first: int, name: str, time: Floats) -> None:
    """Refuse times that repeat, go back, or leave out a part of the motion."""
    if time.size < _FEWEST:
        raise HistoryFileError(f"{path}: {time.size} samples; {_FEWEST} or more are needed")
    steps = np.diff(time)
    back = np.flatnonzero(steps <= 0.0)
    if back.size:
        at = int(back[0])
        raise HistoryFileError(
            f"{path}, line {first + at + 1}: {name} goes from {time[at]:.9g} to "
            f"{time[at + 1]:.9g}; wanted rising times, each once (was the run started "
            "again from an earlier state? delete the lines that were run again)"
        )
    gap = np.flatnonzero(steps > _GAP * np.median(steps))
    if gap.size:
        at = int(gap[0])
        raise HistoryFileError(
            f"{path}, line {first + at + 1}: nothing between {name} {time[at]:.9g} and "
            f"{time[at + 1]:.9g}, {steps[at] / np.median(steps):.3g} times the usual step; put the "
            "missing samples back"
        )


def _frame(path: Path, columns: HistoryColumns) -> tuple[int, pd.DataFrame]:
    """Return the number of the first line of values, and the table as text."""
    try:
        lines = plain_text(path, "history", MOST_BYTES, HistoryFileError).split("\n")
    except FileNotFoundError:
        raise HistoryFileError(f"{path}: no such file (looked from {Path.cwd()})") from None
    wanted = [name for name in columns.names.values() if name]
    best: list[str] = []
    for number, line in enumerate(lines):
        for separator, names in _headings(line):
            if len(set(wanted) & set(names)) > len(set(wanted) & set(best)):
                best = names
            if set(wanted) <= set(names):
                twice = [name for name in wanted if names.count(name) > 1]
                if twice:
                    raise HistoryFileError(
                        f"{path}, line {number + 1}: more than one column is {', '.join(twice)}; "
                        "rename those that are not to be read"
                    )
                return number + 2, _values(path, number + 2, lines[number + 1 :], separator, names)
    seen = best or next((names for line in lines if (names := _widest(line))), [])
    missing = [
        f"{quantity} ({name!r})" for quantity, name in columns.names.items() if name not in seen
    ]
    raise HistoryFileError(
        f"{path}: no column for {', '.join(missing)}; columns are "
        f"{shortened(seen) or 'none'}; name them in given.columns"
    )


def _headings(line: str) -> Iterator[tuple[str, list[str]]]:
    text = line.strip().lstrip("#").strip()
    if text.startswith("(") and text.endswith(")"):
        text = text[1:-1]
    for separator in _SEPARATORS:
        if separator in text:
            try:
                names = next(csv.reader([text], delimiter=separator, skipinitialspace=True))
            except csv.Error:  # of a length that no name has
                continue
            yield separator, [name.strip() for name in names]


def _widest(line: str) -> list[str]:
    return max((names for _, names in _headings(line)), key=len, default=[])


def _values(
    path: Path, first: int, lines: list[str], separator: str, names: list[str]
) -> pd.DataFrame:
    """Return the lines of values as text, by the names of their columns."""
    text = "\n".join(lines)
    try:
        frame = pd.read_csv(
            io.StringIO(text),
            sep=r"\s+" if separator == " " else separator,
            header=None,
            names=range(len(names)),
            index_col=False,
            dtype=str,
            skip_blank_lines=False,
            keep_default_na=False,
            skipinitialspace=True,
            on_bad_lines="error",
        )
    except (pd.errors.ParserError, pd.errors.EmptyDataError, ValueError) as error:
        raise HistoryFileError(
            f"{path}, from line {first}: cannot be read as {len(names)} columns: {error}"
        ) from None
    frame.columns = pd.Index(names)
    frame = _without_blank_end(frame)
    _require_whole(path, first, lines[: len(frame)], separator, frame)
    return frame


def _require_whole(
    path: Path, first: int, lines: list[str], separator: str, frame: pd.DataFrame
) -> None:
    """Refuse lines with fewer values than names, and values that go over several lines.

    Either would put values under the names of others, or take lines away.
    """
    wanted = max(place for place, name in enumerate(frame.columns, start=1) if name)
    for number, line in enumerate(lines, start=first):
        there = len(line.split()) if separator == " " else line.count(separator) + 1
        if there < wanted:
            raise HistoryFileError(
                f"{path}, line {number}: {there} values under {wanted} names of columns; complete "
                "the line or leave it out"
            )
    for place in range(frame.shape[1]):
        over = frame.iloc[:, place].str.contains("\n", regex=False, na=False).to_numpy()
        if over.any():
            raise HistoryFileError(
                f"{path}, line {first + int(np.argmax(over))}: a quotation mark that is closed in "
                "another line; take it out"
            )


def _without_blank_end(frame: pd.DataFrame) -> pd.DataFrame:
    """Leave out empty lines at the end."""
    empty = (frame.fillna("") == "").all(axis=1).to_numpy()
    last = len(frame) - int(np.argmin(empty[::-1])) if not empty.all() else 0
    return frame.iloc[:last]
