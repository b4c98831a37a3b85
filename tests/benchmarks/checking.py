"""Checks of inputs and results: their part of the processor time of the run that they are in.

A copy of the project counts the time of its checks while it runs, so that both are of one run on
one machine, however busy that is.
"""

import json
import shutil
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured
from tests.workflow.project import ROOT, Project

#: Part of the processor time of a run that the checks may take (%).
MOST = 2.0
#: Functions that check, by their modules; what one calls of another counts once, as the outer one.
CHECKS = {
    "configuration": {"keys/config_file.py": ("check_config_files",)},
    "configuration and files that it names": {"run/start.py": ("checked_config",)},
    "clocks": {"run/start.py": ("_of_the_future",)},
    "files of the run at the start": {"store/mend.py": ("unsound_files",)},
    "files that it made, at the end": {"run/verify.py": ("verify_made",)},
    "digests of what is read": {"results/whole.py": ("fault_of",)},
    "digests of what is written": {"results/whole.py": ("append_digest",)},
    "finite values": {"results/netcdf.py": ("_require_finite",)},
    "records of jobs": {"store/made_from.py": ("write_record",)},
}
#: Further parts of a clone that `make paper` needs.
FOR_PAPER = ("Makefile", "pyproject.toml", "docs", "results/reference")
#: Counts the time of what it wraps, and writes it when its process ends.
WATCH = """
import atexit
import functools
import json
import os
import time
from pathlib import Path

_spent, _open = {}, []


def watched(name, function):
    @functools.wraps(function)
    def call(*arguments, **keywords):
        if _open:
            return function(*arguments, **keywords)
        _open.append(name)
        start = time.thread_time()
        try:
            return function(*arguments, **keywords)
        finally:
            _spent[name] = _spent.get(name, 0.0) + time.thread_time() - start
            _open.pop()

    return call


def _write():
    if _spent:
        path = Path(os.environ["CHECKS_TAKE"]) / f"{os.getpid()}.json"
        path.write_text(json.dumps(_spent))


atexit.register(_write)
"""


def rows() -> Iterator[Row]:
    """Run the default configuration from nothing, then `make paper`."""
    paper = ("make", "-o", ".venv/run", "CORES=1", "paper")
    with TemporaryDirectory() as name:
        run = _watched(Path(name) / "run")
        yield from _parts("run from nothing", run, run.command())
        project = _watched(Path(name) / "paper")
        for part in FOR_PAPER:
            _copied(ROOT / part, project.folder / part)
        (project.folder / ".venv").symlink_to(Path(sys.prefix))
        yield from _parts("make paper", project, paper)


def _copied(source: Path, copy: Path) -> None:
    copy.parent.mkdir(exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, copy)
    else:
        shutil.copy2(source, copy)


def _watched(folder: Path) -> Project:
    """Return a copy of the project that counts the time of its checks."""
    project = Project.fresh(folder)
    package = folder / "workflow" / "equisection"
    (package / "watched_checks.py").write_text(WATCH)
    for what, modules in CHECKS.items():
        for module, functions in modules.items():
            with (package / module).open("a", encoding="utf-8") as file:
                file.write("\n\nfrom equisection.watched_checks import watched  # noqa: E402\n")
                for one in functions:
                    file.write(f"{one} = watched({what!r}, {one})\n")
    return project


def _parts(what: str, project: Project, command: Sequence[str]) -> Iterator[Row]:
    """Run a command; give the time of each check, and their part of all of it."""
    times = project.folder / "checks"
    times.mkdir()
    environment: Mapping[str, str] = {**project.environment(), "CHECKS_TAKE": str(times)}
    cost = measured(command, project.folder, environment)
    taken: Counter[str] = Counter()
    for path in times.glob("*.json"):
        taken.update(json.loads(path.read_text(encoding="utf-8")))
    for name in CHECKS:
        yield Row(f"{what}: {name}", f"{1e3 * taken[name]:.0f} ms of the processor")
    yield Row(f"{what}: all of it", f"{cost.processor_seconds:.1f} s of the processor")
    part = 100.0 * sum(taken.values()) / cost.processor_seconds
    yield limit(f"{what}: all checks", part, MOST, "%")
