"""Text of a polar file: encoding, lines, numbers, and values as messages quote them.

A file is read as UTF-8 or UTF-16 with a byte-order mark, as UTF-8 without one, else as Windows-1252
(of which Latin-1's printable characters are a part). Control characters are refused, so that none
of them reaches a terminal by a message.
"""

from __future__ import annotations

import codecs
import math
import re
import stat
from collections.abc import Sequence
from pathlib import Path

from equisection.errors import PolarFileError

#: Lines of a text file without blanks at their ends, each with its number from 1.
Lines = Sequence[tuple[int, str]]
#: Most bytes and lines of a polar file; a full turn in steps of 0.01 deg has 36,001 points.
MOST_BYTES, MOST_LINES = 32_000_000, 100_000
#: Most characters of a line.
_LONGEST_LINE = 10_000
#: Longest value that a message quotes.
_LONGEST = 40
#: What is no text: control characters but tab and line ends, and invisible marks that turn the
#: direction of writing or join words.
_NO_TEXT = re.compile(
    "[\x00-\x08\x0b-\x0c\x0e-\x1f\x7f-\x9f\xad\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff"
    "\ufff9-\uffff\ud800-\udfff\U000e0000-\U000e0fff]"
)
#: A number in decimal digits, with an exponent by E or, as Fortran writes it, by D.
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?")


def text_lines(path: Path) -> Lines:
    """Return the lines of a text file.

    Raises
    ------
    PolarFileError
        There is no such file, it is no text, or it is far too long for a polar.
    """
    data = _bytes(path)
    try:
        text = decoded(data).replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeError as error:
        raise PolarFileError(
            f"{path}: cannot be read as a text file: {error}; save the polar as plain text (UTF-8)"
        ) from None
    if text.count("\n") > MOST_LINES:
        raise _too_many(path, text.count("\n"))
    strange = _NO_TEXT.search(text)
    if strange:
        line = text.count("\n", 0, strange.start()) + 1
        raise PolarFileError(
            f"{path}, line {line}: an invisible character (U+{ord(strange[0]):04X}), so that it "
            "cannot be read as a text file; save the polar as plain text (UTF-8)"
        )
    lines = [(number, line.strip()) for number, line in enumerate(text.split("\n"), start=1)]
    number, longest = max(lines, key=lambda line: len(line[1]))
    if len(longest) > _LONGEST_LINE:
        raise PolarFileError(
            f"{path}, line {number}: {len(longest):,} characters; a polar has one point a line"
        )
    return lines


def _bytes(path: Path) -> bytes:
    try:
        found = path.stat()
        if not stat.S_ISREG(found.st_mode):
            raise PolarFileError(
                f"{path}: cannot be read as a text file: it is a folder or a device; name a file"
            )
        if found.st_size > MOST_BYTES:
            raise PolarFileError(
                f"{path}: {found.st_size:,} bytes; a polar file has {MOST_BYTES:,} at most; give "
                "fewer points, or another file"
            )
        data = path.read_bytes()
    except FileNotFoundError:
        raise PolarFileError(
            f"{path}: no such polar file (looked from {Path.cwd()}); check the path"
        ) from None
    except (OSError, ValueError) as error:
        raise PolarFileError(f"{path}: cannot be read as a text file: {error}") from error
    if data.count(b"\n") > MOST_LINES:
        raise _too_many(path, data.count(b"\n"))
    return data


def _too_many(path: Path, count: int) -> PolarFileError:
    return PolarFileError(
        f"{path}: {count:,} lines; a polar has {MOST_LINES:,} at most (36,001 points are 0.01 deg "
        "apart over a full turn); give fewer points"
    )


def decoded(data: bytes) -> str:
    """Return the text of a file.

    Raises
    ------
    UnicodeError
        It is of none of the encodings.
    """
    marked = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    for encoding in ["utf-16"] if marked else ["utf-8-sig", "cp1252"]:
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise UnicodeError("its bytes are neither UTF-8 nor UTF-16 nor Windows-1252")


def quoted(text: str) -> str:
    """Return a value of a file as a message quotes it: short, in one line, printable."""
    shown = text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
    return ascii(shown) if not shown.isprintable() else repr(shown)


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
