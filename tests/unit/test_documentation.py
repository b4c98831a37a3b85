"""What the documentation says of the project, beside the project."""

import re
from pathlib import Path

import yaml

import equisection

ROOT = Path(__file__).parents[2]


def test_citation_is_of_this_version() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["version"] == equisection.__version__
    assert {"cff-version", "message", "title", "authors"} <= citation.keys()


def test_every_page_is_in_the_site() -> None:
    index = (ROOT / "docs" / "index.md").read_text()
    pages = {path.stem for path in (ROOT / "docs").glob("*.md")} - {"index"}
    listed = set(re.findall(r"^([\w-]+)$", index, flags=re.MULTILINE))
    assert pages <= listed
    assert pages <= set(re.findall(r"\]\(([\w-]+)\.md", index))
