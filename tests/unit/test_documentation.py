"""The documentation agrees with the project."""

import ast
import importlib.util
import re
import subprocess
import sys
from collections.abc import Iterator
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
from equisection.run.starter import EXAMPLES

ROOT = Path(__file__).parents[2]
#: Pages that send a reader to places of the project.
GUIDES = ("README.md", "CONTRIBUTING.md", "docs/architecture.md", "docs/index.md")
PLACES = "config|docs|envs|scripts|tests|workflow|results/reference"
#: A path from the project's root, in code or in a command; a module; a file of rules.
PATH = re.compile(rf"(?<![\w/.-])(?:{PLACES})/[\w./-]*|(?<=`)[\w/]+\.(?:py|smk)(?=`)")
#: Folders that such a path may start from.
STARTS = (ROOT, ROOT / "workflow" / "equisection", ROOT / "workflow" / "rules")


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
    drawn = tmp_path / "beam-and-section.svg"
    script_of("docs/drawings/beam_and_section.py").draw(drawn)
    kept = (ROOT / "docs" / "beam-and-section.svg").read_text()
    parts, kept_parts = NUMBER.split(drawn.read_text()), NUMBER.split(kept)
    assert parts[::2] == kept_parts[::2], "make drawing draws it anew"
    assert [float(part) for part in parts[1::2]] == pytest.approx(
        [float(part) for part in kept_parts[1::2]], abs=0.01
    ), "make drawing draws it anew"


def is_as_kept(drawn: Path, kept: Path) -> bool:
    """Compare two pictures, but for what another version of FreeType makes of the letters."""
    one, other = imread(drawn), imread(kept)
    return one.shape == other.shape and (np.abs(one - other).max(axis=-1) > 0.1).mean() < 2e-3


#: Software that a picture says it is of, in a chunk of its file.
SOFTWARE = re.compile(rb"tEXtSoftware\x00equisection ([\d.]+)")


def test_pictures_are_of_this_version() -> None:
    """Their footers have it: a picture of an earlier version is of other equations, maybe."""
    drawn_by = {
        str(path.relative_to(ROOT)): found[1].decode()
        for path in sorted((ROOT / "docs").rglob("*.png"))
        if (found := SOFTWARE.search(path.read_bytes()))
    }
    assert "docs/fig16-response.png" in drawn_by
    older = {name: by for name, by in drawn_by.items() if by != equisection.__version__}
    assert not older, "make paper and make pictures draw them anew"


def test_every_picture_is_on_a_page() -> None:
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    shown = "".join(page.read_text() for page in pages)
    pictures = [path.relative_to(ROOT / "docs") for path in (ROOT / "docs").rglob("*.png")]
    links = set(re.findall(r"""[("](?:docs/)?([^()"\s]+\.png)""", shown))
    assert [str(path) for path in pictures if str(path) not in links] == []


def test_drawings_of_the_gallery_are_what_their_script_draws(tmp_path: Path) -> None:
    examples = script_of("docs/drawings/examples.py")
    examples.main(tmp_path)
    drawn = sorted(tmp_path.glob("*.png"))
    assert [path.stem for path in drawn] == sorted(f"{name}-drawing" for name in examples.EXAMPLES)
    for path in drawn:
        assert is_as_kept(path, ROOT / "docs" / "gallery" / path.name), "make drawing draws it anew"


def test_examples_of_the_gallery_are_what_init_writes() -> None:
    examples = script_of("docs/drawings/examples.py").EXAMPLES
    assert {name: Path(path).name for name, path in examples.items()} == {
        name: EXAMPLES[name] for name in examples
    }
    for name in examples:
        page = (ROOT / "docs" / f"gallery-{name}.md").read_text()
        assert f"--like {name}" in page
        (block,) = re.findall(r"^```yaml\n(.*?)^```", page, re.M | re.S)
        assert is_part(yaml.safe_load(block), yaml.safe_load((ROOT / examples[name]).read_text()))


def is_part(shown: object, whole: object) -> bool:
    """Tell whether a configuration that a page shows is a part of another; of a list the first."""
    if isinstance(shown, dict):
        assert isinstance(whole, dict)
        return all(is_part(value, whole[key]) for key, value in shown.items())
    if isinstance(shown, list):
        assert isinstance(whole, list)
        return whole[: len(shown)] == shown
    return shown == whole


@pytest.mark.parametrize("page", sorted(path.name for path in (ROOT / "docs").glob("*.md")))
def test_a_page_is_short(page: str) -> None:
    written_by_a_command = {"side-by-side.md", "validation.md"}
    most = 400 if page in written_by_a_command else 300
    assert len((ROOT / "docs" / page).read_text().splitlines()) <= most


@pytest.mark.parametrize("guide", GUIDES)
def test_every_place_that_a_guide_names_is_there(guide: str) -> None:
    text = re.sub(r"\]\([^)]*\)", "]", (ROOT / guide).read_text())  # Sphinx follows the links
    named = {path.rstrip(".") for path in PATH.findall(text)}
    assert (
        sorted(path for path in named if not any((start / path).exists() for start in STARTS)) == []
    )


@pytest.mark.parametrize("guide", GUIDES)
def test_every_make_target_that_a_guide_names_is_there(guide: str) -> None:
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(), flags=re.MULTILINE))
    text = (ROOT / guide).read_text()
    named = set(re.findall(r"(?:^|`)make ([a-z-]+)", text, flags=re.MULTILINE))
    assert named <= targets


def test_rooms_are_in_the_page_in_the_order_that_imports_keep() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text()
    table = page.partition("\n## Rooms")[2].partition("\n## ")[0]
    firsts = [line.split("|")[1] for line in table.splitlines() if line.startswith("| `")]
    shown = [room for first in firsts for room in re.findall(r"`(\w+)(?:\.py|/)`", first)]
    architecture = (ROOT / "tests" / "unit" / "test_architecture.py").read_text()
    (rooms,) = re.findall(r"^ROOMS = \((.*?)^\)", architecture, re.M | re.S)
    assert shown == re.findall(r'"(\w+)"', rooms)


def test_the_python_of_the_readme_prints_what_it_says() -> None:
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", (ROOT / "README.md").read_text(), re.M | re.S)
    (at,) = (i for i, (language, _) in enumerate(blocks) if language == "python")
    run = subprocess.run(
        [sys.executable, "-c", blocks[at][1]], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert run.stdout == blocks[at + 1][1], run.stderr


def script_of(place: str) -> ModuleType:
    """Return a script of the project as a module."""
    spec = importlib.util.spec_from_file_location(f"script_{Path(place).stem}", ROOT / place)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def drawing() -> ModuleType:
    """The script that draws the workflow."""
    return script_of("docs/workflow_drawing.py")


def test_drawing_of_the_workflow_has_rules_that_there_are(drawing: ModuleType) -> None:
    sources = "".join(path.read_text() for path in (ROOT / "workflow" / "rules").glob("*.smk"))
    rules = set(re.findall(r"^ *(?:rule|checkpoint) (\w+):", sources, flags=re.MULTILINE))
    rules |= set(re.findall(r"^ *use rule \w+ as (\w+) with:", sources, flags=re.MULTILINE))
    rules |= {entry.job() for entry in CATALOGUE}
    drawn = {rule for box in drawing.BOXES.values() for rule in box.rules} - {"…"}
    assert drawn <= rules
    assert {name for arrow in drawing.ARROWS for name in arrow} == set(drawing.BOXES)


def test_drawing_of_the_workflow_is_up_to_date(drawing: ModuleType, tmp_path: Path) -> None:
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        save_figure(drawing.draw(), [tmp_path / "workflow.png"])
    kept = drawing.FOLDER / "workflow.png"
    assert is_as_kept(tmp_path / "workflow.png", kept), "python docs/workflow_drawing.py"


#: Words that no public docstring begins with; it begins with a noun or a verb.
QUESTIONS = {"what", "which", "who", "whose", "whether", "how", "where", "when", "why", "that"}
#: Places of Python with docstrings that a reader meets.
DOCUMENTED = ("workflow/equisection", "scripts", "docs/examples", "docs/drawings")
Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def public_docstrings(node: Documented, name: str) -> Iterator[tuple[str, str]]:
    """Yield name and docstring of a module, and of the public classes and functions in it."""
    docstring = ast.get_docstring(node)
    if docstring:
        yield name, docstring
    for child in node.body:
        if isinstance(child, Documented) and not child.name.startswith("_"):
            yield from public_docstrings(child, f"{name}: {child.name}")


def begins_with_a_question(docstring: str) -> bool:
    (word,) = re.findall(r"\w+", docstring)[:1] or [""]
    return word.lower() in QUESTIONS


def test_docstrings_begin_with_a_noun_or_a_verb() -> None:
    files = [path for place in DOCUMENTED for path in (ROOT / place).rglob("*.py")]
    found: list[tuple[str, str]] = []
    for path in files:
        module = ast.parse(path.read_text(encoding="utf-8"))
        found += public_docstrings(module, str(path.relative_to(ROOT)))
    assert len(found) > len(files)  # modules have a docstring, and so has what is in them
    wrong = [
        f"{name}: {text.splitlines()[0]}" for name, text in found if begins_with_a_question(text)
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    ("docstring", "wrong"),
    [
        ("Whether a run may end.", True),
        ("``What`` a run shows.", True),
        ("How far a run is.", True),
        ("Tell whether a run may end.", False),
        ("Wake of a beam.", False),
        ("Thatched roofs, whose loads are not known.", False),
    ],
)
def test_a_docstring_that_begins_with_a_question_is_found(docstring: str, wrong: bool) -> None:
    assert begins_with_a_question(docstring) is wrong
