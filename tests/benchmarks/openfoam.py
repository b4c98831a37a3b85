"""What the adapter around OpenFOAM costs, and what two cases side by side gain.

One case of `config/openfoam.yaml` over its first :data:`DURATION`, as a job in a process of its own
and bare: the same dictionaries, the programs started in sequence by a shell. Both are run in
turn, alone and in pairs, so that a busy machine hits them alike.
"""

import re
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from equisection.cases import UnsteadyCase, history_hash, write_cases
from equisection.errors import SolverError
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.installation import find
from tests.benchmarks.early_verdict import KEPT, case_of
from tests.benchmarks.measure import Row, limit, measured, processor_seconds
from tests.workflow.project import ROOT

#: c/V; a fifth of the longest run, so that what a job costs once is not overrated much.
DURATION = 30.0
ROUNDS = 3
#: Seconds that the tests of the real solver may take.
TESTS = 360.0
BARE = """
cd {place}/steady
{prefix} blockMesh > log.blockMesh
{prefix} checkMesh > log.checkMesh
{prefix} simpleFoam > log.simpleFoam
cp -r constant/polyMesh ../free/constant/
for field in U p k omega nut phi; do cp {iterations}/$field ../free/0/; done
cd ../free
{prefix} pimpleFoam > log.pimpleFoam
"""


@dataclass(frozen=True)
class Took:
    """Seconds by the clock and of the processors."""

    clock: float
    processor: float


@dataclass(frozen=True)
class Round:
    """What a job and the bare programs took: one alone and two side by side."""

    job: Took
    bare: Took
    jobs: Took
    bares: Took


def rows() -> Iterator[Row]:
    """Run the rounds, then the tests of the real solver."""
    try:
        version = find().version()
    except SolverError as error:
        yield Row("left out", str(error))
        return
    rounds = [_round() for _ in range(ROUNDS)]
    seconds = ", ".join(f"{one.job.clock:.3g} and {one.bare.clock:.3g}" for one in rounds)
    yield Row(f"{DURATION:g} c/V as a job and bare, {version}", f"{seconds} s")
    cost = statistics.median(100 * (one.job.clock / one.bare.clock - 1) for one in rounds)
    yield limit("the adapter beside the bare solver, median", cost, 3, "%")
    cost = statistics.median(100 * (one.job.processor / one.bare.processor - 1) for one in rounds)
    yield Row("the same in processor time", f"{cost:.3g} %")
    gain = statistics.median(2 * one.job.clock / one.jobs.clock for one in rounds)
    yield Row("throughput of two jobs over one", f"{gain:.3g} times", ">= 1.8 times", gain >= 1.8)
    gain = statistics.median(2 * one.bare.clock / one.bares.clock for one in rounds)
    yield Row("the same of the bare solver", f"{gain:.3g} times")
    command = [sys.executable, "-m", "pytest", "tests/openfoam"]
    yield limit("tests of the real solver", measured(command, ROOT).seconds, TESTS, "s")


def _round() -> Round:
    with TemporaryDirectory() as folder:
        place = Path(folder)
        jobs = [_job(place / f"job{number}") for number in range(3)]
        job = _took(jobs[:1])
        bare = [_bare(place / f"bare{number}", place / "job0") for number in range(3)]
        return Round(job=job, bare=_took(bare[:1]), jobs=_took(jobs[1:]), bares=_took(bare[1:]))


def _case() -> UnsteadyCase:
    kept = case_of(read_dataset(KEPT / "2d" / "k10.nc"))
    solver = kept.solver.model_copy(update={"version": Adapter.version})
    return kept.model_copy(update={"duration": DURATION, "solver": solver})


def _job(place: Path) -> list[str]:
    """Return the command of a job."""
    place.mkdir()
    write_cases(place / "cases.json", {"k10": _case()})
    return [sys.executable, str(ROOT / "tests" / "run_one_job.py"), str(place)]


def _bare(place: Path, job: Path) -> list[str]:
    """Return the command of the bare programs, with the dictionaries of a job that has ended."""
    done = job / "store" / history_hash(_case()) / "case0"
    for name in ("steady", "free"):
        shutil.copytree(
            done / name, place / name, ignore=shutil.ignore_patterns("polyMesh", "log*", "[1-9]*")
        )
        shutil.rmtree(place / name / "postProcessing")
    iterations = max(int(path.name) for path in (done / "steady").glob("[1-9]*"))
    control = place / "steady" / "system" / "controlDict"
    text = control.read_text(encoding="utf-8")
    for key in ("endTime", "writeInterval"):  # the writing of loads has an interval of its own
        text = re.sub(rf"^{key} .*;", f"{key} {iterations};", text, flags=re.MULTILINE)
    control.write_text(text, encoding="utf-8")
    prefix = " ".join(find().prefix)
    return ["sh", "-e", "-c", BARE.format(place=place, prefix=prefix, iterations=iterations)]


def _took(commands: Sequence[Sequence[str]]) -> Took:
    """Return what commands take that run side by side.

    Raises
    ------
    RuntimeError
        One of them failed.
    """
    start, before = time.perf_counter(), processor_seconds()
    running = [
        subprocess.Popen(
            command, env=find().variables(), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        for command in commands
    ]
    said = [process.communicate()[1] for process in running]
    took = Took(time.perf_counter() - start, processor_seconds() - before)
    for process, command, words in zip(running, commands, said, strict=True):
        if process.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {words.decode()}")
    return took
