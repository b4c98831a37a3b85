"""A copy of the project in a folder of its own, and Snakemake run in it as a user would."""

import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from copy import deepcopy
from pathlib import Path
from typing import Any

import yaml

from tests.processes import LONG, narrow_pipe

ROOT = Path(__file__).parents[2]
#: What a clone holds that a run needs.
PARTS = ("Snakefile", "config", "envs", "scripts", "workflow")

#: Small enough for a test: one-dimensional modes, few angles, few k*, short runs, one
#: format of the figures.
SMALL: dict[str, Any] = {
    "run": "small",
    "figure_formats": ["png"],
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "mesh_study": [{"chord": 4, "span": 15, "thickness": 1}],
        "bending_modes": 2,
        "torsion_modes": 2,
    },
    "steady": {"incidence_deg": [0.0, 2.5, 5.0, 7.5, 10.0]},
    "sweep": {"k_star": [6.0, 10.0, 21.0], "models": ["2d", "2d-corrected", "3d"]},
    "unsteady": {"duration": 150.0},
    "embedded": {"strips": 8},
}


def small(**changes: Any) -> dict[str, Any]:
    """Return the small configuration with some keys changed, section by section."""
    config = deepcopy(SMALL)
    for section, value in changes.items():
        if isinstance(value, dict):
            config.setdefault(section, {}).update(value)
        else:
            config[section] = value
    return config


class Project:
    """One copy of the project."""

    #: What Python starts, and where jobs run.
    program: tuple[str, ...] = ("-m", "snakemake")
    where: tuple[str, ...] = ("--cores", "2")

    def __init__(self, folder: Path, config: dict[str, Any] | None = None) -> None:
        self.folder = folder
        self.config = deepcopy(config)

    @classmethod
    def fresh(cls, folder: Path, config: dict[str, Any] | None = None) -> "Project":
        """Copy the project as it would be cloned, without results."""
        folder.mkdir(parents=True)
        for part in PARTS:
            source = ROOT / part
            if source.is_dir():
                # with its bytecode, but what another process is writing of it
                without = shutil.ignore_patterns("*.pyc.*")
                shutil.copytree(source, folder / part, ignore=without)
            else:
                shutil.copy2(source, folder / part)
        return cls(folder, config)

    def copy(self, folder: Path) -> "Project":
        """Copy the project with its results, times and links."""
        subprocess.run(["cp", "-a", self.folder, folder], check=True)
        return Project(folder, self.config)

    @property
    def results(self) -> Path:
        """Where the run puts its files."""
        assert self.config is not None
        return self.folder / "results" / str(self.config["run"])

    def environment(self) -> dict[str, str]:
        """Return the environment, in which this copy of the package is the one imported."""
        return {**os.environ, "PYTHONPATH": str(self.folder / "workflow"), "COLUMNS": "200"}

    def command(self, *arguments: str) -> list[str]:
        """Return the command line of Snakemake."""
        command = [sys.executable, *self.program, *arguments, *self.where]
        if self.config is not None:
            path = self.folder / f"{self.config['run']}.yaml"
            path.write_text(yaml.safe_dump(self.config), encoding="utf-8")
            command += ["--configfile", path.name]
        return command

    def start(self, *arguments: str) -> subprocess.Popen[str]:
        """Start Snakemake in a process group of its own."""
        return subprocess.Popen(
            self.command(*arguments),
            cwd=self.folder,
            env=self.environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def start_slowly(self, *arguments: str) -> subprocess.Popen[str]:
        """Start Snakemake so that it says nothing before what it said before has been read.

        It cannot come to its end while it is read, however long that takes (on Linux).
        """
        read, write = narrow_pipe()
        run = subprocess.Popen(
            self.command(*arguments),
            cwd=self.folder,
            env=self.environment(),
            stdout=write,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        os.close(write)
        run.stdout = os.fdopen(read, encoding="utf-8")
        return run

    def attempt(
        self, *arguments: str, environment: dict[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        """Run Snakemake to its end, whatever that is."""
        return subprocess.run(
            self.command(*arguments),
            cwd=self.folder,
            env=environment or self.environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            timeout=LONG,
        )

    def run(self, *arguments: str) -> str:
        """Run Snakemake and return what it said; it must end well."""
        ended = self.attempt(*arguments)
        assert ended.returncode == 0, ended.stdout
        return ended.stdout

    def target(self, path: str) -> str:
        """Return a file of the run as Snakemake is asked for it."""
        return str((self.results / path).relative_to(self.folder))

    def files(self) -> dict[str, bytes]:
        """Return name and content of every file of the run, apart from logs."""
        return {
            str(path.relative_to(self.results)): path.read_bytes()
            for path in self.results.rglob("*")
            if path.is_file() and "logs" not in path.relative_to(self.results).parts
        }


def one_case_at_a_time(project: Project) -> None:
    """Let the copy's solver say that it takes no batches, as a CFD solver does."""
    registry = project.folder / "workflow" / "equisection" / "solvers" / "registry.py"
    text = registry.read_text()
    assert "frozenset({Capability.BATCH, " in text
    registry.write_text(text.replace("frozenset({Capability.BATCH, ", "frozenset({"))


def jobs_planned(dry_run: str) -> Counter[str]:
    """Return how many jobs of each rule a dry run lists."""
    table = dry_run.partition("Job stats:")[2].partition("\ntotal")[0]
    return Counter(
        {name: int(count) for name, count in re.findall(r"^(\w+) +(\d+)$", table, re.MULTILINE)}
    )


def jobs_run(output: str) -> Counter[str]:
    """Return how many jobs of each rule a run has finished."""
    return Counter(re.findall(r"^Finished jobid: \d+ \(Rule: (\w+)\)", output, re.MULTILINE))


def has_nothing_to_do(output: str) -> bool:
    """Tell whether a run found everything made."""
    return "Nothing to be done" in output and not jobs_run(output)
