"""The pages on extending the project: the table, and the files of the examples shown in full."""

from __future__ import annotations

import re
from collections.abc import Iterable

from tests.conftest import ROOT
from tests.extending.changes import FOLDER, Outcome

PAGE = ROOT / "docs" / "extending.md"
#: Pages with all files of a change, by its name.
IN_FULL = {
    "figure": ROOT / "docs" / "extending-a-figure.md",
    "polar_format": ROOT / "docs" / "extending-a-polar-format.md",
}
#: Most files that a person edits for a change.
MOST = 5
#: A block of code, below a comment that names the file that it is.
_BLOCK = re.compile(r"<!-- (?P<file>[\w./-]+) -->\n\n```(?P<language>\w*)\n.*?^```$", re.S | re.M)
_TABLE = re.compile(r"(?<=<!-- table -->\n\n).*?(?=\n\n)", re.S)


def table(outcomes: Iterable[Outcome]) -> str:
    """Return the table of changes."""
    rows = [
        "| change | edited | new | written by a command | works |",
        "|---|---|---|---|---|",
    ]
    for outcome in outcomes:
        change = outcome.change
        rows.append(
            f"| {change.title} | {len(change.edited)} | {len(change.new)} "
            f"| {', '.join(f'`{name}`' for name in outcome.generated) or 'none'} "
            f"| {'no' if outcome.failure else 'yes'} |"
        )
    return "\n".join(rows)


def table_of(page: str) -> str:
    """Return the table of a page."""
    found = _TABLE.search(page)
    assert found, "the page has no table"
    return found.group()


def with_table(page: str, text: str) -> str:
    """Return a page with another table."""
    return page.replace(table_of(page), text)


def with_files(page: str) -> str:
    """Return a page whose blocks of code are the files that their comments name."""

    def block(found: re.Match[str]) -> str:
        name = found["file"]
        text = (FOLDER / name).read_text(encoding="utf-8").rstrip("\n")
        return f"<!-- {name} -->\n\n```{found['language']}\n{text}\n```"

    return _BLOCK.sub(block, page)
