"""Where the package cannot run, a sentence says what to do."""

import ast
import subprocess
import sys
import tomllib

import pytest
from tests.conftest import ROOT

from equisection import needs

PACKAGE = ROOT / "workflow" / "equisection"
#: Packages whose module has another name.
MODULES = {"pyyaml": "yaml", "scikit-fem": "skfem", "pillow": "PIL"}


def test_every_dependency_is_looked_for() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    names = [name.partition(">")[0] for name in project["dependencies"]]
    assert [MODULES.get(name, name) for name in names] == list(needs.MODULES)
    assert project["requires-python"] == ">=" + ".".join(map(str, needs.OLDEST_PYTHON))


def test_nothing_is_missing_here() -> None:
    assert needs.missing() == ""


def test_an_old_python_is_named_with_the_one_that_is_needed() -> None:
    said = needs.missing((3, 10))
    assert said.startswith(f"equisection needs Python 3.11 or newer, and {sys.executable} is 3.10:")
    assert "make run PYTHON=" in said
    assert "\n" not in said


@pytest.mark.parametrize("name", ["__init__.py", "clone.py", "needs.py"])
def test_an_old_python_can_read_what_tells_it(name: str) -> None:
    ast.parse((PACKAGE / name).read_text(), feature_version=(3, 7))


def test_a_missing_package_is_named_with_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(needs, "MODULES", ("numpy", "no_such_package"))
    said = needs.missing()
    assert said.startswith(f"equisection is not installed in {sys.prefix} (missing: no_such_pack")
    assert f"'pip install -c envs/constraints.txt -e .' in {ROOT}, or 'make run' there" in said


@pytest.mark.parametrize(
    "program",
    [
        ("-m", "equisection.run.command_line", "status"),
        ("-m", "equisection.config", "--check"),
        ("scripts/polar.py",),
    ],
)
def test_a_program_ends_with_that_sentence_alone(program: tuple[str, ...]) -> None:
    """Started by a Python without any package (``-S`` leaves those of the environment out)."""
    ended = subprocess.run(
        [sys.executable, "-S", *program],
        cwd=ROOT,
        env={"PYTHONPATH": str(ROOT / "workflow"), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 1
    (line,) = ended.stderr.splitlines()
    assert line.startswith("error: equisection is not installed in ")


def test_a_program_of_others_gets_an_error_that_it_can_catch() -> None:
    program = "try:\n import equisection\nexcept ImportError as error:\n print(error)"
    ended = subprocess.run(
        [sys.executable, "-S", "-c", program],
        env={"PYTHONPATH": str(ROOT / "workflow"), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert ended.stdout.startswith("equisection is not installed in ")
