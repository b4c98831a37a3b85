"""The README's way from a clone to the critical speed of a beam of one's own."""

import os
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured
from tests.workflow.project import ROOT

COMMANDS = (
    ("clone, environment and default run", "git clone --quiet {root} clone && make -C clone run"),
    (
        "a beam of one's own",
        "cd clone && . .venv/bin/activate && equisection init my-beam --like panel "
        "&& equisection run my-beam.yaml",
    ),
)


def rows() -> Iterator[Row]:
    """Run the commands in an empty folder, with packages from the machine's index of packages."""
    environment = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
    total = 0.0
    with TemporaryDirectory() as folder:
        for what, command in COMMANDS:
            words = ["bash", "-ec", command.format(root=ROOT)]
            seconds = measured(words, Path(folder), environment).seconds
            total += seconds
            yield Row(what, f"{seconds:.3g} s")
    yield limit("both", total, 600, "s")
