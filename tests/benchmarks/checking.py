"""Checks of inputs and results: their part of the processor time of a run from nothing."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from equisection.config import check_config_files, read_config_file
from equisection.provenance import file_hash
from equisection.results.whole import fault_of
from equisection.run import start
from equisection.run.verify import verify_made
from equisection.store.made_from import FOLDER, read_record
from equisection.store.mend import unsound_files
from tests.benchmarks.measure import Row, limit, measured
from tests.workflow.project import ROOT, Project

#: Parts of the processor time of a run that the checks may take (%).
MOST = 2.0


def rows() -> Iterator[Row]:
    """Run the default configuration from nothing, then its checks alone, as often as it does."""
    with TemporaryDirectory() as folder:
        project = Project.fresh(Path(folder) / "project")
        cost = measured(project.command(), project.folder, project.environment())
        run = project.folder / "results" / "paper-plate"
        yield from parts(run, project.folder, cost.processor_seconds)


def parts(run: Path, folder: Path, whole: float) -> Iterator[Row]:
    """Give the time of each check of a run that took so much processor time (s)."""
    config = ROOT / "config" / "config.yaml"
    records = [read_record(path) for path in sorted((run / FOLDER).glob("*.json"))]
    used = [
        path
        for record in records
        for name in (*record.inputs, *record.outputs)
        if (path := run / name if (run / name).is_file() else folder / name).is_file()
    ]
    checks: dict[str, Callable[[], object]] = {
        "configuration": lambda: (
            check_config_files([config]),
            start.checked_config(read_config_file(config), ROOT),
        ),
        "files of the run at the start": lambda: unsound_files(run),
        "files that it made, at the end": lambda: verify_made(run, 0.0),
        "digests of what its jobs read and wrote": lambda: [
            fault_of(path) for path in used if path.suffix == ".nc"
        ],
        "records of its jobs": lambda: [file_hash(path) for path in used],
    }
    taken = {}
    for name, check in checks.items():
        check()  # modules are loaded by the run itself
        begun = time.process_time()
        check()
        taken[name] = time.process_time() - begun
        yield Row(name, f"{1e3 * taken[name]:.0f} ms of the processor")
    yield Row("the run from nothing", f"{whole:.1f} s of the processor")
    yield limit("all checks of the run", 100.0 * sum(taken.values()) / whole, MOST, "%")
