"""The digest of a job's modules follows what its script imports."""

import ast
from pathlib import Path

import pytest

import equisection
from equisection.run import source_digest as of_sources
from equisection.run.source_digest import imported, source_digest

PACKAGE = Path(equisection.__file__).parent
SCRIPTS = Path(__file__).parents[2] / "scripts"


def by_syntax(source: Path) -> set[Path]:
    """Return what a file imports, from its syntax tree."""
    found = set()
    for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and str(node.module).partition(".")[0] == "equisection":
            folder = PACKAGE.joinpath(*str(node.module).split(".")[1:])
            for alias in node.names:
                places = [folder / f"{alias.name}.py", folder / alias.name / "__init__.py"]
                if folder != PACKAGE:
                    places += [folder.with_suffix(".py"), folder / "__init__.py"]
                found.update([place for place in places if place.is_file()][:1])
    return found - {PACKAGE / "run" / "script.py"}


@pytest.mark.parametrize("folder", [PACKAGE, SCRIPTS], ids=["package", "scripts"])
def test_imports_found_in_the_text_are_those_of_the_syntax(folder: Path) -> None:
    for source in folder.rglob("*.py"):
        assert set(imported(source)) == by_syntax(source), source


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of four modules, of which the script imports the first, and that the second."""
    folder = tmp_path / "equisection"
    (folder / "room").mkdir(parents=True)
    (folder / "room" / "__init__.py").write_text("")
    (folder / "first.py").write_text(
        "def f():\n    from equisection.room import (\n        second,\n    )\n"
    )
    (folder / "room" / "second.py").write_text("D = 1\n")
    (folder / "room" / "third.py").write_text("A = 1\n")
    (folder / "fourth.py").write_text("B = 1\n")
    (tmp_path / "script.py").write_text("from equisection.first import f\n")
    monkeypatch.setattr(of_sources, "PACKAGE", folder)
    return folder


def digest(package: Path, *further: str) -> str:
    for name in ("imported", "_reached", "_file", "_text", "_content"):
        getattr(of_sources, name).cache_clear()
    return source_digest(package.parent / "script.py", further)


@pytest.mark.parametrize(
    ("module", "further", "changes"),
    [
        ("first", (), True),
        ("room/second", (), True),
        ("room/third", (), False),
        ("room/third", ("room.third",), True),
        ("room/third", ("room",), True),
        ("fourth", ("room",), False),
    ],
)
def test_an_edit_changes_the_digest_of_what_uses_it(
    package: Path, module: str, further: tuple[str, ...], changes: bool
) -> None:
    before = digest(package, *further)
    with (package / f"{module}.py").open("a") as source:
        source.write("C = 2\n")
    assert (digest(package, *further) != before) == changes


def test_a_name_without_a_module_is_an_error(package: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"room\.fifth: no module"):
        digest(package, "room.fifth")


def test_an_edited_figure_is_drawn_again_and_no_other() -> None:
    script = SCRIPTS / "figure.py"
    response, growth = (
        of_sources._in_package(f"figures.{name}")[0] for name in ("response", "growth_rate")
    )
    common = of_sources._reached(script)
    assert growth not in common | of_sources._reached(response)
    assert response not in common | of_sources._reached(growth)
