"""Write the files that come from the models, or check that they are up to date.

``python -m equisection.config`` writes ``workflow/schemas/config.schema.yaml`` whole, and the
tables of ``config/README.md`` below the mark that says so; ``--check`` changes nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import yaml

from equisection.clone import CLONE
from equisection.config.reference import reference
from equisection.config.words import schema
from equisection.generated import write_or_check

COMMAND = "python -m equisection.config"
SCHEMA = Path("workflow/schemas/config.schema.yaml")
README = Path("config/README.md")
#: What stands above it in the README is written by hand.
MARK = f"<!-- From here on written by `{COMMAND}`; edit the models instead. -->\n"


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


def main(arguments: Sequence[str] | None = None, root: Path = CLONE) -> int:
    """Write or check both files; return the exit status."""
    wanted = {SCHEMA: schema_text(), README: readme_text(root / README)}
    return write_or_check(wanted, root, COMMAND, (__doc__ or "").strip(), arguments)


if __name__ == "__main__":
    sys.exit(main())
