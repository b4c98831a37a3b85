"""`make run` of this checkout and of another one, in turn on the same machine.

    python -m tests.benchmarks.against FOLDER [--rounds 3]

FOLDER is a checkout of another commit with an environment of its own (`make run` in it makes one).
Both run the default configuration in copies without results, with their environments installed,
from nothing and then with nothing to do. The table has the least of all rounds, since whatever else
runs on the machine only adds to it; the ratio of processor times suffers less from that than that
of the times by the clock.
"""

import argparse
import os
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.console import Console
from rich.table import Table

from tests.benchmarks.measure import Cost, measured
from tests.workflow.project import PARTS, ROOT

#: What `make run` needs beside the parts of a clone that Snakemake does.
MAKE = ("Makefile", "pyproject.toml")
WHAT = ("from nothing", "with nothing to do")


def copy_of(checkout: Path, folder: Path) -> Path:
    """Copy a checkout without its results; its environment is taken as it is."""
    folder.mkdir()
    for part in (*PARTS, *MAKE):
        source = checkout / part
        if source.is_dir():
            shutil.copytree(source, folder / part)
        else:
            shutil.copy2(source, folder / part)
    (folder / ".venv").symlink_to(checkout / ".venv")
    return folder


def costs_of(copy: Path) -> list[Cost]:
    """Run a copy from nothing, and again; return the cost of both."""
    for made in (copy / "results", copy / ".snakemake"):
        shutil.rmtree(made, ignore_errors=True)
    environment = {**os.environ, "PYTHONPATH": str(copy / "workflow")}
    # the environment is installed, whatever the times of the copied files say
    command = ["make", "--assume-old=.venv/run", "run"]
    return [measured(command, copy, environment) for _ in WHAT]


def main(other: Path, rounds: int) -> None:
    """Print times and ratios, this checkout by the other.

    Raises
    ------
    SystemExit
        The other checkout has no environment.
    """
    if not (other / ".venv" / "bin" / "snakemake").exists():
        raise SystemExit(f"{other}: no environment in .venv; run 'make run' there first")
    with TemporaryDirectory() as place:
        copies = [
            copy_of(checkout, Path(place) / name)
            for checkout, name in ((ROOT, "this"), (other.resolve(), "other"))
        ]
        costs = [[costs_of(copy) for copy in copies] for _ in range(rounds)]
    table = Table("make run", "", "this", "other", "ratio")
    for number, what in enumerate(WHAT):
        for name, unit in (("seconds", "by the clock, s"), ("processor_seconds", "processor, s")):
            this, that = (
                min(getattr(one[checkout][number], name) for one in costs) for checkout in (0, 1)
            )
            table.add_row(what, unit, f"{this:.2f}", f"{that:.2f}", f"{this / that:.2f}")
    Console(width=100).print(table)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.against", description=__doc__)
    parser.add_argument("other", type=Path, metavar="FOLDER", help="checkout to compare with")
    parser.add_argument("--rounds", type=int, default=3, help="runs of each (3)")
    given = parser.parse_args()
    main(given.other, given.rounds)
