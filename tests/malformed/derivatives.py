"""Tables of flutter derivatives that are wrong in one place."""

from collections.abc import Iterator

from tests.malformed.given import ARABIC, WIDE, WORDS, Malformed, no_files

#: Configuration that names the table.
CONFIG = """
structure: {{method: beam}}
derivatives: {{table: "{file}"}}
"""
COMMENTS = ("# convention: Scanlan", "# force: rho V^2 B/2", "# heave: down", "# axis: 0.5")
NAMES = "reduced_velocity,H1,H2,H3,H4,A1,A2,A3,A4"
GOOD = [
    [f"{2 * n}", *(f"{factor * n:.4f}" for factor in (-2.5, -0.4, -2, 0.3, -0.6, -0.12, 0.5, 0.1))]
    for n in range(1, 9)
]


def text(
    rows: list[list[str]] | None = None,
    comments: tuple[str, ...] = COMMENTS,
    names: str = NAMES,
) -> str:
    """Return a table's file."""
    values = [",".join(row) for row in (GOOD if rows is None else rows)]
    return "\n".join([*comments, names, *values]) + "\n"


def _cell(value: str, column: int = 3) -> list[list[str]]:
    return [*GOOD[:4], [*GOOD[4][:column], value, *GOOD[4][column + 1 :]], *GOOD[5:]]


def _damaged() -> Iterator[tuple[str, str]]:
    right = GOOD[4][3]
    spellings = (right.translate(ARABIC), right.translate(WIDE), right.replace(".0", ".0_"))
    for value in (*spellings, "high", "nan", "inf", "1e999", "0x1", "", "0\x1b[2J", *WORDS):
        yield f"H3 {value!a}", text(_cell(value))
    yield "a velocity of 0", text(_cell("0", 0))
    yield "a velocity below 0", text(_cell("-4", 0))
    yield "a velocity twice", text(_cell("4", 0))
    yield "a value less", text([*GOOD[:4], GOOD[4][:-1], *GOOD[5:]])
    yield "two rows", text(GOOD[:2])
    yield "no row", text([])
    for place, comment in enumerate(COMMENTS):
        key = comment.split(":")[0]
        yield f"without '{key}'", text(comments=COMMENTS[:place] + COMMENTS[place + 1 :])
        wrong = (*COMMENTS[:place], f"{key}: nonsense", *COMMENTS[place + 1 :])
        yield f"'{key}' nonsense", text(comments=wrong)
    yield "an escape in a name", text(names=NAMES.replace("A4", "\x1b[2J"))
    yield "a mark that turns the writing", text(names=NAMES.replace("A4", "\u202eA4"))
    yield "a name of 2,000 characters", text(names=NAMES.replace("A4", "A" * 2000))
    yield "60,000 columns", text(names=",".join([NAMES, *["x"] * 60_000]))
    yield "5,000 other columns", text(names=",".join(f"c{n}" for n in range(5000)))
    yield "a derivative of 1e250", text(_cell("1e250"))
    for value in ("1e250", "1e-250", "1e5"):
        yield f"a velocity of {value}", text(_cell(value, 0))
    yield "a quotation", text(_cell('"1'))
    yield "an axis in per cent", text(comments=(*COMMENTS[:3], "# axis: 50"))
    yield "an axis in other digits", text(comments=(*COMMENTS[:3], "# axis: ٠.٥"))
    for old, new in (("H3", "H2"), ("A4", "A5"), ("reduced_velocity", "V"), ("H", "h")):
        yield f"{new} for {old}", text(names=NAMES.replace(old, new).replace("A", old[0]))


def tables() -> list[Malformed]:
    """Return the malformed tables."""
    found = [
        Malformed(what, "mine.csv", content.encode(), "mine.csv") for what, content in _damaged()
    ]
    for what, content in (
        ("empty", b""),
        ("a picture", b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 10),
        ("UTF-16 without its mark", text().encode("utf-16-le")),
    ):
        found.append(Malformed(what, "mine.csv", content, "mine.csv"))
    return [*found, *no_files("mine.csv"), Malformed("not there", "none.csv", None, "none.csv")]
