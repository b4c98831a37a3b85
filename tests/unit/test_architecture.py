"""Imports point one way, and a name stands for one thing."""

from __future__ import annotations

import ast
import graphlib
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import equisection

PACKAGE = Path(equisection.__file__).parent

#: Rooms of the package from the bottom up: each may import from those before it.
ROOMS = (
    "clone",
    "needs",
    "conventions",
    "errors",
    "files",
    "generated",
    "provenance",
    "keys",
    "io",
    "beam",
    "structure",
    "verdict",
    "aerodynamics",
    "motion",
    "reduction",
    "cases",
    "results",
    "config",
    "solvers",
    "store",
    "study",
    "analysis",
    "figures",
    "run",
    "report",
    "validation",
    "paper",
)
#: Modules that are the same idea of two solvers.
OF_EACH_SOLVER = {"adapter", "job_work"}
CLASSES_OF_EACH_SOLVER = {"Adapter"}


def modules() -> dict[str, Path]:
    """Return the modules of the package by their dotted names below it."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        found[".".join(part for part in parts if part != "__init__")] = path
    return found


MODULES = modules()


def imported(path: Path) -> Iterator[str]:
    """Yield the modules of the package that a module imports, wherever in it that stands."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert not any(name.name.startswith("equisection.") for name in node.names), path
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import"
            source = f"{node.module}."
            if source.startswith("equisection."):
                below = source.removeprefix("equisection.")
                for alias in node.names:
                    module = f"{below}{alias.name}"
                    yield module if module in MODULES else below.rstrip(".")


def test_every_module_is_in_a_room():
    rooms = {name.partition(".")[0] for name in MODULES} - {""}
    assert rooms == set(ROOMS)


def test_imports_point_one_way():
    wrong = [
        f"{name} imports {other}"
        for name, path in MODULES.items()
        if name  # the public door, which opens on every room
        for other in imported(path)
        if other and ROOMS.index(other.partition(".")[0]) > ROOMS.index(name.partition(".")[0])
    ]
    assert not wrong, "\n".join(wrong)


def test_no_module_imports_itself_by_way_of_others():
    graph = {name: set(imported(path)) - {name} for name, path in MODULES.items() if name}
    graphlib.TopologicalSorter(graph).prepare()  # raises CycleError with the circle


def test_nothing_imports_what_knows_the_paper():
    knowing = [
        name
        for name, path in MODULES.items()
        if not name.startswith("paper")
        for other in imported(path)
        if other.partition(".")[0] == "paper"
    ]
    assert not knowing


#: What a line says that speaks of the paper outside of its room: it cites a place in it, or names
#: its reduction, a run of its plate, or the plate that the defaults are.
CITATION = re.compile(
    r"\b(Eqs?|Figs?)\. ?\d|\bSection \d|reduction|[\"'`-]paper\b|_paper_section"
    r"|paper[-.](plate|smk)|defaults are|paper's J is kept|\bpaper divides"
)


def test_other_rooms_speak_of_the_paper_in_citations_alone():
    workflow = PACKAGE.parent
    sources = [path for name, path in MODULES.items() if not name.startswith("paper")]
    sources += [path for path in (workflow / "rules").glob("*.smk") if path.stem != "paper"]
    sources += [workflow / "Snakefile", *(workflow / "report").rglob("*.rst")]
    wrong = [
        f"{path.relative_to(workflow)}:{number}: {line.strip()}"
        for path in sources
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if "paper" in line.lower() and not CITATION.search(line)
    ]
    assert not wrong, "\n".join(wrong)


def test_a_module_has_its_name_to_itself():
    stems = Counter(path.stem for path in MODULES.values() if not path.stem.startswith("__"))
    assert not {stem for stem, times in stems.items() if times > 1} - OF_EACH_SOLVER


def test_a_class_has_its_name_to_itself():
    classes = Counter(
        node.name
        for path in MODULES.values()
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.ClassDef)
    )
    assert not {name for name, times in classes.items() if times > 1} - CLASSES_OF_EACH_SOLVER
