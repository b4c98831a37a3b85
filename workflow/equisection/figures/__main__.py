"""Write the list of figures in ``docs/files.md``, or check that it is up to date.

``python -m equisection.figures`` writes the table between the marks; ``--check`` changes nothing.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Sequence
from pathlib import Path

from equisection.clone import CLONE
from equisection.figures.catalogue import CATALOGUE, Entry
from equisection.generated import write_or_check

COMMAND = "python -m equisection.figures"
PAGE = Path("docs/files.md")
BEGIN = f"<!-- Written by `{COMMAND}` from the first line of each figure's module. -->\n"
END = "<!-- End of what is written. -->\n"


def first_line(entry: Entry) -> str:
    """Return the first line of the docstring of a figure's module; the module is not loaded."""
    source = (Path(__file__).parent / f"{entry.module}.py").read_text(encoding="utf-8")
    return (ast.get_docstring(ast.parse(source)) or "").partition("\n")[0]


def table() -> str:
    """Return the table of figures, in the order of the catalogue."""
    rows = (f"| `{entry.name}` | {_escaped(first_line(entry))} |\n" for entry in CATALOGUE)
    return "".join(("| figure | shows |\n|---|---|\n", *rows))


def page_text(page: str) -> str:
    """Return the page with the table between its marks.

    Raises
    ------
    ValueError
        The page lacks one of the marks.
    """
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise ValueError(f"{PAGE}: one of the lines {BEGIN.strip()} and {END.strip()} is gone")
    return f"{before}{begin}\n{table()}\n{end}{after}"


def main(arguments: Sequence[str] | None = None, root: Path = CLONE) -> int:
    """Write or check the list; return the exit status."""
    wanted = {PAGE: page_text((root / PAGE).read_text(encoding="utf-8"))}
    return write_or_check(wanted, root, COMMAND, (__doc__ or "").strip(), arguments)


def _escaped(text: str) -> str:
    return text.replace("*", r"\*").replace("|", r"\|")


if __name__ == "__main__":
    sys.exit(main())
