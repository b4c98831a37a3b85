"""What the documentation says of the project, beside the project."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import yaml
from matplotlib.image import imread

import equisection
from equisection.figures.catalogue import CATALOGUE
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style

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


@pytest.fixture(scope="module")
def drawing() -> ModuleType:
    """The script that draws the workflow."""
    spec = importlib.util.spec_from_file_location("drawing", ROOT / "docs" / "workflow_drawing.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_drawing_of_the_workflow_has_rules_that_there_are(drawing: ModuleType) -> None:
    sources = "".join(path.read_text() for path in (ROOT / "workflow" / "rules").glob("*.smk"))
    rules = set(re.findall(r"^ *(?:rule|checkpoint) (\w+):", sources, flags=re.MULTILINE))
    rules |= set(re.findall(r"^ *use rule \w+ as (\w+) with:", sources, flags=re.MULTILINE))
    rules |= {entry.job for entry in CATALOGUE}
    drawn = {rule for box in drawing.BOXES.values() for rule in box.rules} - {"…"}
    assert drawn <= rules
    assert {name for arrow in drawing.ARROWS for name in arrow} == set(drawing.BOXES)


def test_drawing_of_the_workflow_is_up_to_date(drawing: ModuleType, tmp_path: Path) -> None:
    """But for what another version of FreeType makes of the letters."""
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        save_figure(drawing.draw(), [tmp_path / "workflow.png"])
    drawn, kept = imread(tmp_path / "workflow.png"), imread(drawing.FOLDER / "workflow.png")
    assert drawn.shape == kept.shape, "python docs/workflow_drawing.py"
    differ = np.abs(drawn - kept).max(axis=-1) > 0.1
    assert differ.mean() < 2e-3, "python docs/workflow_drawing.py"
