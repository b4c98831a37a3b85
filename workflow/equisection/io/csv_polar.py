"""Polars as tables of separated values, read and written.

Lines that start with ``#``, ``%``, ``!`` or ``//`` and empty lines are skipped. The header is the
line that names all four quantities, ``incidence_deg`` (or alpha, AoA), ``cl``, ``cm`` and ``cd``
(upper or lower case, also as c_l or C_L, with a unit in brackets, in any order), each once; others
are ignored. Lines of text may be above it, and a line of units below it. It tells what separates
columns: a semicolon, else a tab, else a comma, else blanks. Decimals have a point, or all a comma
where no comma separates. Angles in degrees; moment nose up, about mid-chord unless the reader is
told otherwise.
"""

from __future__ import annotations

import csv
import io
import itertools
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_columns import (
    COLUMNS,
    check_columns,
    check_unit,
    quantities,
    unit_of,
)
from equisection.io.polar_rows import REYNOLDS, PolarFormat, Row, validity
from equisection.io.polar_text import Lines, is_number, number

_COMMENTS = ("#", "%", "!", "//")
#: Lines that are searched for the header.
_TOP = 200
#: What separates columns, in the order in which a header is asked for it; else blanks.
_SEPARATORS = (";", "\t", ",")
#: A unit in brackets behind a blank.
_UNIT_APART = re.compile(r"\s+(?=[\[(][^\])]*[\])])")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eEdD][+-]?[0-9]+)?")
#: How programs write a number that is none.
_NOT_KNOWN = ("nan", "inf", "infinity")
_NAMES = ", ".join(COLUMNS)


def _recognises(path: Path, lines: Lines) -> bool:
    """Take every file: the format that is tried last, whose refusals say what is wanted."""
    del path, lines
    return True


def _read(path: Path, lines: Lines) -> list[Row]:
    return read_named(path, lines, {})


@dataclass(frozen=True)
class _Header:
    """The line that names the columns: its number, separator (empty: blanks) and names."""

    line: int
    separator: str
    names: list[str]
    quantities: list[str]

    @classmethod
    def of(cls, line: int, text: str, given: Mapping[str, str]) -> _Header:
        separator = next((mark for mark in _SEPARATORS if mark in text), "")
        names = _fields(_UNIT_APART.sub("", text), separator)
        return cls(line, separator, names, quantities(names, given))

    @property
    def known(self) -> int:
        """Number of quantities that it names."""
        return len(set(filter(None, self.quantities)))

    @cached_property
    def places(self) -> list[tuple[str, int]]:
        """Quantities with the place of their column."""
        return [(name, self.quantities.index(name)) for name in COLUMNS]


def read_named(path: Path, lines: Lines, given: Mapping[str, str]) -> list[Row]:
    """Read the rows of a table whose columns have the names that the user gives.

    Parameters
    ----------
    path
        The file, for messages.
    lines
        Its lines.
    given
        Names of columns by quantity (COLUMNS); those that are not given go by their usual names.

    Raises
    ------
    PolarFileError
        With file and line.
    """
    used = [(line, text) for line, text in lines if text and not text.startswith(_COMMENTS)]
    if not used:
        raise PolarFileError(
            f"{path}, line 1: the file is empty (or all comment); wanted a header with columns "
            f"{_NAMES} and 4 or more points"
        )
    header = _header(path, lines, used, given)
    check_columns(path, header.line, header.names, header.quantities, given)
    for name, place in header.places:
        check_unit(path, header.line, name, unit_of(header.names[place]))
    points = [(line, text) for line, text in used if line > header.line]
    if points and _is_of_units(_fields(points[0][1], header.separator)):
        _check_units(path, header, *points.pop(0))
    comma = _decimal_comma(path, header, points)
    return [_row(path, line, text, header, comma) for line, text in points]


def _header(path: Path, lines: Lines, used: Lines, given: Mapping[str, str]) -> _Header:
    """Return the header: a line that names all quantities, a comment if no other does."""
    top = list(itertools.takewhile(lambda entry: not _is_row(entry[1]), used[:_TOP]))
    candidates = [_Header.of(line, text, given) for line, text in top]
    best = max(candidates, key=lambda header: header.known, default=None)
    if best is None or best.known < len(COLUMNS):
        first = used[len(top)][0] if len(top) < len(used) else math.inf
        comments = [
            _Header.of(line, text.lstrip("#%!/ \t"), given)
            for line, text in lines[:_TOP]
            if line < first and text.startswith(_COMMENTS)
        ]
        whole = [header for header in comments if header.known == len(COLUMNS)]
        best = whole[-1] if whole else best
    if best is None or not best.known:
        raise PolarFileError(
            f"{path}, line {used[0][0]}: no line names the columns, as a polar's header does; "
            f"wanted {_NAMES}, or the names in this file: embedded.columns (columns= in Python)"
        )
    return best


def _is_row(text: str) -> bool:
    """Tell whether a line is one of numbers."""
    fields = [field for field in re.split(r"[;\t, ]+", text) if field]
    return len(fields) >= len(COLUMNS) and all(map(is_number, fields))


def _is_of_units(fields: Sequence[str]) -> bool:
    """Tell whether a line is one of units: no number in it, also none that failed."""
    return not any(
        is_number(field)
        or _DECIMAL_COMMA.fullmatch(field)
        or field.lower().lstrip("+-") in _NOT_KNOWN
        for field in fields
    )


def _fields(text: str, separator: str) -> list[str]:
    if not separator:
        return text.split()
    if '"' not in text:
        return [field.strip() for field in text.split(separator)]
    try:
        (fields,) = csv.reader([text], delimiter=separator, skipinitialspace=True)
    except csv.Error:
        return [text]
    return [field.strip() for field in fields]


def _check_units(path: Path, header: _Header, line: int, text: str) -> None:
    """Refuse a line of units in which one is another than what is read."""
    units = _fields(text, header.separator)
    if len(units) != len(header.names):
        raise _uneven(path, line, units, header)
    for name, place in header.places:
        check_unit(path, line, name, units[place])


def _uneven(path: Path, line: int, fields: Sequence[str], header: _Header) -> PolarFileError:
    by = {"": "blanks", "\t": "tabs", ",": "commas, with a point for decimals"}
    return PolarFileError(
        f"{path}, line {line}: {len(fields)} values under {len(header.names)} column names; wanted "
        f"one value for each column, separated by {by.get(header.separator, 'semicolons')}, as "
        "the names are"
    )


def _decimal_comma(path: Path, header: _Header, points: Lines) -> bool:
    """Tell whether decimals have a comma; refuse a file in which some have a point."""
    if header.separator == ",":
        return False
    if not any("," in text for _, text in points):
        return False
    places = [place for _, place in header.places]
    first: dict[str, int] = {}
    for line, text in points:
        fields = _fields(text, header.separator)
        for field in (fields[place] for place in places if place < len(fields)):
            first.update({mark: line for mark in ",." if mark in field and mark not in first})
    if len(first) > 1:
        raise PolarFileError(
            f"{path}, line {first[',']}: a decimal comma, and in line {first['.']} a decimal "
            "point; write all decimals with a point"
        )
    return "," in first


def _row(path: Path, line: int, text: str, header: _Header, comma: bool) -> Row:
    fields = _fields(text, header.separator)
    if len(fields) != len(header.names):
        raise _uneven(path, line, fields, header)
    if comma:
        fields = [
            field.replace(",", ".") if _DECIMAL_COMMA.fullmatch(field) else field
            for field in fields
        ]
    return Row(
        line, tuple([number(path, line, name, fields[place]) for name, place in header.places])
    )


def _reynolds_number(lines: Lines) -> float:
    comments = [(line, text) for line, text in lines[:_TOP] if text.startswith("#")]
    return float(validity(Path(), comments).get(REYNOLDS, math.nan))


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


CSV = PolarFormat("CSV", _recognises, _read, None, _reynolds_number)
