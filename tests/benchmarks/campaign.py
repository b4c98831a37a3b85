"""A campaign of 10,000 cases: the graph, nothing to do, summary and figures, status and verify.

Twice: as batches of the embedded solver, and as a solver has them that runs its cases one by one
(the embedded one in its place, which is told to). A case one by one is three files and two jobs to
Snakemake, a batch of any size is as many.
"""

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Cost, Row, limit, measured
from tests.workflow.project import Project, has_nothing_to_do, one_case_at_a_time, small

CASES = 10_000
#: Cases of the campaign whose report is made.
REPORTED = 100


def rows() -> Iterator[Row]:
    """Measure batches, cases one by one, and the report of a campaign of 100 cases."""
    with TemporaryDirectory() as folder:
        place = Path(folder)
        yield from _batches(_project(place / "batches", CASES))
        one_by_one = _project(place / "one-by-one", CASES)
        one_case_at_a_time(one_by_one)
        yield from _graph(f"{CASES:,} one by one", one_by_one)
        yield from _report(_project(place / "reported", REPORTED))


def _batches(project: Project) -> Iterator[Row]:
    what = f"{CASES:,} in a batch"
    yield from _graph(what, project)
    yield from _costs(f"{what}: run", _run(project))
    again = _run(project)
    if not has_nothing_to_do(again.output):
        raise RuntimeError(f"there was something to do:\n{again.output}")
    yield from _costs(f"{what}: nothing to do", again, 60)
    _undraw(project)
    yield from _costs(f"{what}: summary and figures", _run(project), 30)
    for command in (["status"], ["status", "--html", "status.html"], ["verify"]):
        words = [sys.executable, "-m", "equisection.run.command_line", *command]
        cost = measured(words, project.folder, project.environment())
        yield from _costs(f"{what}: {' '.join(command)}", cost)


def _graph(what: str, project: Project) -> Iterator[Row]:
    cost = _run(project, "--dry-run", "--quiet")
    yield from _costs(f"{what}: graph", cost, 60)
    yield limit(f"{what}: memory of it", cost.peak_gigabytes, 2, "GB")


def _report(project: Project) -> Iterator[Row]:
    _run(project)
    _undraw(project)
    drawn = _run(project)
    report = _run(project, "report_page")
    both = Cost(
        drawn.seconds + report.seconds,
        drawn.processor_seconds + report.processor_seconds,
        max(drawn.peak_gigabytes, report.peak_gigabytes),
        report.output,
    )
    yield from _costs(f"figures and report of {REPORTED}", both, 60)


def _costs(what: str, cost: Cost, most: float | None = None) -> Iterator[Row]:
    """Tell the time by the clock, which may have a limit, and that of the processors."""
    yield (
        Row(what, f"{cost.seconds:.3g} s") if most is None else limit(what, cost.seconds, most, "s")
    )
    yield Row(f"{what}, processors", f"{cost.processor_seconds:.3g} s")


def _undraw(project: Project) -> None:
    for made in ("comparison", "figures", "tables"):
        shutil.rmtree(project.results / made)


def _project(folder: Path, cases: int) -> Project:
    sweep = {"k_star": {"start": 4.0, "stop": 21.0, "number": cases}, "models": ["2d"]}
    return Project.fresh(folder, small(sweep=sweep, unsteady={"duration": 60.0}))


def _run(project: Project, *arguments: str) -> Cost:
    return measured(project.command(*arguments), project.folder, project.environment())
