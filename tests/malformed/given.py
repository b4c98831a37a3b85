"""A malformed input, and the answer to it of the function behind ``equisection check``."""

import contextlib
import io
import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from equisection.run.command_line import main

#: Most characters of a line that a person reads.
LONGEST = 700
#: Words of a fault of the program, or of a library's own messages.
JARGON = ("Traceback", "pydantic", "Input should be", "Value error", "object has no attribute")
#: Digits of other scripts, which Python's ``float`` takes as well.
ARABIC, WIDE = (
    str.maketrans("0123456789", digits) for digits in ("٠١٢٣٤٥٦٧٨٩", "０１２３４５６７８９")
)
#: What stands in a cell that is no number: of a spreadsheet, a report, another language, a slip.
WORDS = (
    *("1/3", "0.1±0.1", "=A1", "0.1*", "0.1%", "0.1f", "1e5e5", "+-1", "NULL", "#N/A", "-", "True"),
    *(
        "0.1\xa02",
        "0.1'2",
        "1O",
        "0.1\N{EN DASH}1",
        "<<<<<<<",
        "0x1p3",
        "1e",
        "e5",
        ".",
        "+",
        "1..2",
    ),
    "z" * 2000,
)


@dataclass(frozen=True)
class Malformed:
    """An input that is to be refused.

    Attributes
    ----------
    what
        What is wrong with it.
    file
        Name of the file.
    content
        Its bytes; None for a file that is not there.
    named
        What the refusal has to name: the key, or the file.
    further
        Files beside it, by name.
    made
        Makes what has its name and is no file, in the place of content.
    """

    what: str
    file: str
    content: bytes | None
    named: str
    further: dict[str, bytes] = field(default_factory=dict)
    made: Callable[[Path], object] | None = field(default=None, kw_only=True)

    def write(self, folder: Path) -> Path:
        """Write it with its further files; return its path."""
        for name, content in self.further.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
        path = folder / self.file
        if self.content is not None:
            path.write_bytes(self.content)
        if self.made is not None:
            self.made(path)
        return path


def no_files(name: str) -> list[Malformed]:
    """Return what has the name of a file and is none."""
    made: dict[str, Callable[[Path], object]] = {
        "a folder": Path.mkdir,
        "a pipe that nobody writes to": os.mkfifo,
        "a device without an end": lambda path: path.symlink_to("/dev/zero"),
        "a link to itself": lambda path: path.symlink_to(path),
        "6 GB of nothing": _vast,
    }
    return [Malformed(what, name, None, name, made=make) for what, make in made.items()]


def _vast(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(6_000_000_000)  # takes no place on the disk


def answered(one: Malformed, folder: Path, config: str = "") -> tuple[str, str]:
    """Return how ``equisection check`` takes an input, in a word, and what it says.

    ``config`` is the configuration that names the file; without one the file is a configuration.
    The word is ``named`` for one clear line and status 1.
    """
    path = one.write(folder)
    if config:
        path = folder / "config.yaml"
        path.write_text(config.format(file=folder / one.file), encoding="utf-8")
    before = sorted(folder.iterdir())
    out, err = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = main(["check", str(path)])
    except Exception as error:  # whatever comes through
        return "uncaught", repr(error)
    if sorted(folder.iterdir()) != before:
        return "files were made", err.getvalue()
    if status == 0:
        return "accepted", out.getvalue()
    return judged(one, err.getvalue().removeprefix("error: "))


def judged(one: Malformed, said: str) -> tuple[str, str]:
    """Return how clear a refusal is, in a word, and the refusal."""
    lines = said.rstrip("\n").split("\n")
    if len(lines) != 1:
        return "several lines", said
    if any(word in said for word in JARGON) or not lines[0].isprintable():
        return "unclear", said
    if len(lines[0]) > LONGEST:
        return "long", said
    return ("named" if one.named in said else "unnamed"), said
