"""Table of six changes of the project: the files of each, and whether it works.

``python -m tests.extending`` applies each change to a copy of the project, runs its checks there,
and prints the table; it ends with 1 if a check fails, or a person has to edit more than five files.
``--write`` also writes the table into ``docs/extending.md``, and the files into the
pages that show a change in full. ``--into FOLDER NAME`` leaves a
copy of the project with one of the changes, to look at.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from tests.extending.changes import CHANGES, Outcome, apply, check, copy_project
from tests.extending.page import IN_FULL, MOST, PAGE, table, with_files, with_table


def main() -> int:
    """Run the command; return its exit code."""
    names = {change.name: change for change in CHANGES}
    parser = argparse.ArgumentParser(
        prog="python -m tests.extending", description=__doc__.splitlines()[0]
    )
    parser.add_argument(
        "--write", action="store_true", help=f"write {PAGE.name} and the pages in full too"
    )
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="leave one change in a copy")
    parser.add_argument("name", nargs="?", choices=sorted(names), help="the change of --into")
    options = parser.parse_args()
    if bool(options.into) != bool(options.name):
        parser.error(f"--into takes a folder and one of {', '.join(sorted(names))}")
    if options.into:
        copy_project(options.into)
        apply(names[options.name], options.into)
        return 0
    outcomes = all_outcomes()
    text = table(outcomes)
    print(f"Counted are all files that a person edits, tests and documentation too.\n\n{text}")
    if options.write:
        PAGE.write_text(with_table(PAGE.read_text("utf-8"), text), encoding="utf-8")
        for page in IN_FULL.values():
            page.write_text(with_files(page.read_text("utf-8")), encoding="utf-8")
    wrong = problems(outcomes)
    print("\n".join(wrong), file=sys.stderr, end="\n" if wrong else "")
    return 1 if wrong else 0


def all_outcomes() -> list[Outcome]:
    """Return the outcome of each change, applied to a copy of its own."""
    with tempfile.TemporaryDirectory() as place:
        return [check(change, Path(place) / change.name) for change in CHANGES]


def problems(outcomes: list[Outcome]) -> list[str]:
    """Return the checks that failed, and the changes with too many files."""
    found = [f"{one.change.title}: {one.failure}" for one in outcomes if one.failure]
    for change in (one.change for one in outcomes):
        number = len(change.new) + len(change.edited)
        if number > MOST:
            found.append(f"{change.title}: {number} files; allowed are {MOST}")
    return found


if __name__ == "__main__":
    sys.exit(main())
