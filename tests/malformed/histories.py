"""Histories of another program that are wrong in one place."""

import math
from collections.abc import Iterator
from pathlib import Path

from equisection.errors import HistoryFileError
from equisection.io.history_file import HistoryColumns, HistoryScales, read_table
from tests.malformed.given import ARABIC, WIDE, WORDS, Malformed, judged, no_files

NAMES = ("time", "twist", "deflection", "lift", "moment")
COLUMNS = HistoryColumns(
    dict(zip(NAMES, NAMES, strict=True)),
    {"time": "s", "twist": "rad", "deflection": "m", "lift": "N", "moment": "N m"},
)
SCALES = HistoryScales(chord=0.2, density=1.2, speed=10.0, span=0.5)
GOOD = [
    [f"{0.01 * n:.2f}", f"{math.sin(0.1 * n):.6f}", "0.001", f"{1 + 0.01 * n:.4f}", "0.2"]
    for n in range(40)
]


def text(rows: list[list[str]], separator: str, names: tuple[str, ...] = NAMES) -> str:
    """Return a history's file."""
    return "\n".join(separator.join(row) for row in ([*names], *rows)) + "\n"


def _damaged() -> Iterator[tuple[str, list[list[str]]]]:
    right = GOOD[20][1]
    values = (
        *(right.translate(ARABIC), right.translate(WIDE), f"{right[:-1]}_{right[-1]}"),
        *("high", "nan", "inf", "1e999", "0x1", "−0.1", "1.2.3", "--1", ""),
        *("0.1\x1b[2J", *WORDS),
    )
    for value in values:
        yield f"twist {value!a}", [*GOOD[:20], [GOOD[20][0], value, *GOOD[20][2:]], *GOOD[21:]]
    yield "a gap", [*GOOD[:10], *GOOD[20:]]
    yield "a part twice", [*GOOD[:20], *GOOD[15:]]
    yield "ten samples", GOOD[:10]
    yield "a value more", [*GOOD[:20], [*GOOD[20], "7"], *GOOD[21:]]
    yield "a value less", [*GOOD[:20], GOOD[20][:3], *GOOD[21:]]
    yield "no sample", []


def histories() -> list[Malformed]:
    """Return the malformed histories."""
    found = []
    for separator in (",", ";", "\t", " "):
        found += [
            Malformed(
                f"{separator!r}: {what}", "mine.txt", text(rows, separator).encode(), "mine.txt"
            )
            for what, rows in _damaged()
        ]
    renamed = ("time", "theta", "deflection", "lift", "moment")
    doubled = ("time", "twist", "deflection", "lift", "twist")
    wide = [[*row, "x"] for row in GOOD]  # with a column that is not read
    for what, content in (
        ("a value less where one is not read", _wide([*wide[:20], wide[20][:-1], *wide[21:]])),
        (
            "a value less in the middle",
            _wide([*wide[:20], wide[20][:1] + wide[20][2:], *wide[21:]]),
        ),
        (
            "a quotation over several lines",
            _wide([*wide[:20], [*GOOD[20], '"x'], *wide[21:22], [*GOOD[22], 'x"'], *wide[23:]]),
        ),
        ("5,000 columns of other names", ",".join(f"c{n}" for n in range(5000)).encode()),
        ("a line of 200,000 characters", b'"' + b"x" * 200_000 + b'",a\n'),
        ("an escape in a name", text(GOOD, ",", ("time\x1b[2J", *NAMES[1:])).encode()),
        ("empty", b""),
        ("a picture", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 10),
        ("another name", text(GOOD, ",", renamed).encode()),
        ("a name twice", text(GOOD, ",", doubled).encode()),
        ("UTF-16 without its mark", text(GOOD, ",").encode("utf-16-le")),
    ):
        found.append(Malformed(what, "mine.txt", content, "mine.txt"))
    return [*found, *no_files("mine.txt"), Malformed("not there", "none.txt", None, "none.txt")]


def _wide(rows: list[list[str]]) -> bytes:
    return text(rows, ",", (*NAMES, "note")).encode()


def read(one: Malformed, folder: Path) -> tuple[str, str]:
    """Return how a history is taken, in a word, and what is said."""
    try:
        read_table(one.write(folder), COLUMNS, SCALES)
    except HistoryFileError as error:
        return judged(one, str(error))
    except Exception as error:  # whatever comes through
        return "uncaught", repr(error)
    return "accepted", ""
