"""Six changes of the project as data, applied to copies of it.

A change is a folder of ``docs/examples/extending``: new files at the places that they have in the
project, and ``edits.patch`` with the lines that it adds to files that are there.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from tests.conftest import ROOT

FOLDER = ROOT / "docs" / "examples" / "extending"
EDITS = "edits.patch"
#: What a copy is without: what git does not keep, and kept results, which it links to.
LEFT_OUT = (".git", ".venv", ".*_cache", ".snakemake", ".sphinx", ".hypothesis", "site")


@dataclass(frozen=True)
class Change:
    """One change.

    Attributes
    ----------
    title
        Title.
    name
        Name of its folder.
    standing
        Tests of the project that notice a change of its sort that is not whole, in addition to
        that of the architecture.
    asked
        Arguments of a dry run of Snakemake that shows it, and the rule that has to be among its
        jobs; nothing of a change without a rule.
    """

    title: str
    name: str
    standing: tuple[str, ...]
    asked: tuple[str, ...] = ()
    rule: str = ""

    @property
    def folder(self) -> Path:
        """Its folder."""
        return FOLDER / self.name

    @property
    def new(self) -> list[str]:
        """New files, from the project's root."""
        return sorted(
            path.relative_to(self.folder).as_posix()
            for path in self.folder.rglob("*")
            if path.is_file() and path.name != EDITS and "__pycache__" not in path.parts
        )

    @property
    def edited(self) -> list[str]:
        """Files that get further lines."""
        return sorted(re.findall(r"^\+\+\+ b/(.+)$", self.patch.read_text("utf-8"), re.MULTILINE))

    @property
    def patch(self) -> Path:
        """Its edits."""
        return self.folder / EDITS


SECTIONS_ALONE = 'sweep={"models": ["2d"]}'
CHANGES = (
    Change(
        "new figure",
        "figure",
        ("figures_catalogue", "figures_captions"),
        ("results/paper-plate/figures/twist-amplitude.png",),
        rule="twist_amplitude",
    ),
    Change("new polar format", "polar_format", ("polar_file",)),
    Change(
        "new solver",
        "solver",
        ("config",),
        (
            "results/paper-plate/comparison/onset.csv",
            "--config",
            "solver=quasi_steady",
            SECTIONS_ALONE,
        ),
        rule="unsteady_batch",
    ),
    Change(
        "new axis of a study",
        "axis",
        ("config", "axes"),
        (
            "results/paper-plate/comparison/onset.csv",
            "--config",
            'sweep={"models": ["2d"], "time_step": [0.05, 0.1]}',
        ),
        rule="onset",
    ),
    Change("new quantity of a section", "section_quantity", ("one_section", "kept_hashes")),
    Change("new kind of run", "kind", ("kinds",), ("static",), rule="static"),
)


@dataclass(frozen=True)
class Outcome:
    """Outcome of a change that was applied to a copy.

    Attributes
    ----------
    change
        The change.
    generated
        Files that a command of the project then wrote anew.
    failure
        Words of the check that failed; empty if all passed.
    """

    change: Change
    generated: tuple[str, ...]
    failure: str = ""


def copy_project(folder: Path) -> None:
    """Copy the project into a new folder, with a link to its kept results."""
    shutil.copytree(ROOT, folder, ignore=_left_out, symlinks=True)
    (folder / "results").mkdir()
    (folder / "results" / "reference").symlink_to(ROOT / "results" / "reference")


def _left_out(directory: str, names: list[str]) -> set[str]:
    of_root = {"results"} if Path(directory) == ROOT else set()
    return of_root | shutil.ignore_patterns(*LEFT_OUT, "__pycache__")(directory, names)


def apply(change: Change, folder: Path) -> tuple[str, ...]:
    """Apply a change to a copy of the project; return the files that were generated anew.

    Raises
    ------
    subprocess.CalledProcessError
        Its edits do not fit the project, or the generated files cannot be written.
    """
    outside = {**os.environ, "GIT_CEILING_DIRECTORIES": str(folder.resolve().parent)}
    command = ("git", "apply", "--whitespace=nowarn", str(change.patch))
    subprocess.run(command, cwd=folder, env=outside, check=True, capture_output=True, text=True)
    for name in change.new:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(change.folder / name, folder / name)
    generated = {
        path: path.read_bytes()
        for path in (folder / "config/README.md", folder / "workflow/schemas/config.schema.yaml")
    }
    run(folder, "-m", "equisection.config").check_returncode()
    return tuple(
        path.relative_to(folder).as_posix()
        for path, before in generated.items()
        if path.read_bytes() != before
    )


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python in a copy of the project, on the package of that copy."""
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(folder / "workflow"), "COLUMNS": "200"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )


def check(change: Change, folder: Path) -> Outcome:
    """Apply a change to a new copy of the project, and look whether it works.

    Its own tests pass, and those of the project that notice a change that is not whole; Snakemake
    has its rule.
    """
    copy_project(folder)
    try:
        generated = apply(change, folder)
    except subprocess.CalledProcessError as error:
        return Outcome(change, (), (error.stderr or "") + (error.stdout or ""))
    tests = [name for name in change.new if name.startswith("tests/")]
    tests += [f"tests/unit/test_{name}.py" for name in ("architecture", *change.standing)]
    ended = run(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", *tests)
    if ended.returncode:
        return Outcome(change, generated, ended.stdout)
    if change.asked:
        target, *options = change.asked
        dry = run(folder, "-m", "snakemake", "-n", "--cores", "1", target, *options)
        if dry.returncode or not re.search(rf"^{change.rule} +\d+$", dry.stdout, re.MULTILINE):
            return Outcome(change, generated, dry.stdout)
    return Outcome(change, generated)
