"""Text of a polar file: lines, numbers, and values as messages quote them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.plain_text import plain_text

#: Lines of a text file without blanks at their ends, each with its number from 1.
Lines = Sequence[tuple[int, str]]
#: Most bytes and lines of a polar file; a full turn in steps of 0.01 deg has 36,001 points.
MOST_BYTES, MOST_LINES = 32_000_000, 100_000
#: Most characters of a line.
_LONGEST_LINE = 10_000
#: Longest value that a message quotes.
_LONGEST = 40
#: Most names of columns that a message lists.
_MOST_NAMES = 10
#: A number in decimal digits, with an exponent by E or, as Fortran writes it, by D.
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?")


def text_lines(path: Path) -> Lines:
    """Return the lines of a text file.

    Raises
    ------
    PolarFileError
        There is no such file, it is no text, or it is far too long for a polar.
    """
    try:
        text = plain_text(path, "polar", MOST_BYTES, PolarFileError)
    except FileNotFoundError:
        raise PolarFileError(
            f"{path}: no such polar file (looked from {Path.cwd()}); check the path"
        ) from None
    if text.count("\n") > MOST_LINES:
        raise PolarFileError(
            f"{path}: {text.count(chr(10)):,} lines; a polar has {MOST_LINES:,} at most (36,001 "
            "points are 0.01 deg apart over a full turn); give fewer points"
        )
    lines = [(number, line.strip()) for number, line in enumerate(text.split("\n"), start=1)]
    number, longest = max(lines, key=lambda line: len(line[1]))
    if len(longest) > _LONGEST_LINE:
        raise PolarFileError(
            f"{path}, line {number}: {len(longest):,} characters; a polar has one point a line"
        )
    return lines


def quoted(text: str) -> str:
    """Return a value of a file as a message quotes it: short, in one line, printable."""
    shown = text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
    return ascii(shown) if not shown.isprintable() else repr(shown)


def shortened(names: Sequence[str]) -> str:
    """Return names of columns as a message lists them: the first ones, each quoted."""
    shown = ", ".join(map(quoted, names[:_MOST_NAMES]))
    return shown + (f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else "")


def is_number(text: str) -> bool:
    """Tell whether a text is a number in decimal digits."""
    return _NUMBER.fullmatch(text) is not None


def decimal(text: str) -> float:
    """Return the number that a text is in decimal digits.

    Python's own reading takes underscores and the digits of any script as well.

    Raises
    ------
    ValueError
        It is none.
    """
    if not is_number(text):
        raise ValueError(f"{quoted(text)} is no number in decimal digits")
    return float(text.lower().replace("d", "e"))


def number(path: Path, line: int, name: str, text: str) -> float:
    """Return a value of a row as a finite number.

    Raises
    ------
    PolarFileError
        The value is not one.
    """
    text = text.strip()
    value = decimal(text) if is_number(text) else math.nan
    if not math.isfinite(value):
        raise PolarFileError(
            f"{path}, line {line}: {name} is {quoted(text)}; wanted a finite number in digits, as "
            "-0.31 (leave the whole line out if the point is not known)"
        )
    return value
