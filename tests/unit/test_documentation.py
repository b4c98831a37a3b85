"""The documentation agrees with the project."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
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


#: A number that is no part of a name or a colour.
NUMBER = re.compile(r"(?<![\w#.-])(-?\d+(?:\.\d+)?)(?![\w.])")


def test_the_drawing_is_what_its_script_draws(tmp_path: Path) -> None:
    """Lines, colours and words are the same, places to a hundredth of a point."""
    script = ROOT / "docs" / "drawings" / "beam_and_section.py"
    drawn = tmp_path / "beam-and-section.svg"
    subprocess.run([sys.executable, script, drawn], check=True)
    kept = (ROOT / "docs" / "beam-and-section.svg").read_text()
    parts, kept_parts = NUMBER.split(drawn.read_text()), NUMBER.split(kept)
    assert parts[::2] == kept_parts[::2], "make drawing draws it anew"
    assert [float(part) for part in parts[1::2]] == pytest.approx(
        [float(part) for part in kept_parts[1::2]], abs=0.01
    ), "make drawing draws it anew"
