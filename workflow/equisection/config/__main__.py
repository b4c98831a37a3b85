"""Write the files that come from the models, or check that they are up to date.

``python -m equisection.config`` writes ``workflow/schemas/config.schema.yaml`` whole, and the
tables of ``config/README.md`` below the mark that says so; ``--check`` changes nothing.
"""

from __future__ import annotations

import argparse
import difflib
import sys
from collections.abc import Sequence
from pathlib import Path

import yaml

from equisection.config.reference import reference
from equisection.config.words import schema
from equisection.files import write_text

COMMAND = "python -m equisection.config"
SCHEMA = Path("workflow/schemas/config.schema.yaml")
README = Path("config/README.md")
#: What stands above it in the README is written by hand.
MARK = f"<!-- From here on written by `{COMMAND}`; edit the models instead. -->\n"
ROOT = Path(__file__).parents[3]


def schema_text() -> str:
    """Return the JSON schema as YAML."""
    head = f"# Written by `{COMMAND}`; edit the models in workflow/equisection/config instead.\n"
    body = yaml.safe_dump(
        {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema()},
        sort_keys=False,
        width=100,
        allow_unicode=True,
    )
    return head + body


def readme_text(readme: Path) -> str:
    """Return the README with the part above the mark as it is."""
    text = readme.read_text(encoding="utf-8") if readme.is_file() else ""
    return f"{text.partition(MARK)[0]}{MARK}\n{reference()}"


def main(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Write or check both files; return the exit status."""
    parser = argparse.ArgumentParser(prog=COMMAND, description=__doc__)
    parser.add_argument("--check", action="store_true", help="change nothing, exit 1 if outdated")
    check = parser.parse_args(arguments).check
    wanted = {SCHEMA: schema_text(), README: readme_text(root / README)}
    outdated = False
    for path, text in wanted.items():
        file = root / path
        found = file.read_text(encoding="utf-8") if file.is_file() else ""
        if found == text:
            continue
        outdated = True
        if check:
            _print_difference(path, found, text)
        else:
            write_text(file, text)
            print(f"written: {path}")
    if check and outdated:
        print(f"\nThe models have changed; to mend it: {COMMAND}", file=sys.stderr)
    return int(check and outdated)


def _print_difference(path: Path, found: str, wanted: str) -> None:
    sys.stdout.writelines(
        difflib.unified_diff(
            found.splitlines(keepends=True),
            wanted.splitlines(keepends=True),
            fromfile=f"{path} (found)",
            tofile=f"{path} (from the models)",
        )
    )


if __name__ == "__main__":
    sys.exit(main())
