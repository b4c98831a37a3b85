"""A run that is killed at any moment goes on to the same results."""

import os
import random
import signal
import subprocess

import psutil
import pytest
import xarray as xr

from tests.processes import LONG
from tests.workflow.project import Project, has_nothing_to_do, small

SUMMARY = "comparison/summary.csv"
KILLS = 3
#: Starts and ends of jobs after which a run is killed, at most; it has more of them for each kill.
MOST_EVENTS = 4


def kill_while_working(run: subprocess.Popen[str], events: int) -> None:
    """Kill the whole process group when so many starts and ends of jobs have been told."""
    assert run.stdout is not None
    for line in run.stdout:
        events -= line.startswith(("Execute", "Finished jobid"))
        if events == 0:
            break
    kill_family(run)


def kill_family(run: subprocess.Popen[str]) -> None:
    """Kill a run that goes on, with all of its jobs."""
    assert run.poll() is None, "it came to its end"
    family = psutil.Process(run.pid).children(recursive=True)
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    survivors = psutil.wait_procs(family, timeout=LONG)[1]
    assert not survivors, f"the kill left {survivors} running"


@pytest.mark.parametrize("seed", [1, 2])
def test_killed_run_goes_on_to_the_results_of_an_undisturbed_one(
    seed: int, project: Project, finished_section: Project
) -> None:
    moments = random.Random(seed)
    project.config = small(sweep={"models": ["2d"]})
    target = project.target(SUMMARY)
    for _ in range(KILLS):
        run = project.start_slowly("--rerun-incomplete", target)
        kill_while_working(run, moments.randint(1, MOST_EVENTS))
        project.run("--unlock")

    project.run("--rerun-incomplete", target)

    assert has_nothing_to_do(project.run(target))
    cost = ("wall_seconds", "cpu_seconds", "batch_cases", "command")
    for name in ("k6", "k10", "k21"):
        there, undisturbed = (
            xr.load_dataset(run.results / "unsteady" / "2d" / f"{name}.nc")
            for run in (project, finished_section)
        )
        for attribute in cost:
            del there.attrs[attribute], undisturbed.attrs[attribute]
        xr.testing.assert_identical(there, undisturbed)
    for path in project.results.rglob(".tmp-*"):
        assert path.suffix in (".nc", ".csv", ".json"), path  # left over, and taken for nothing
    results = {path.name for path in (project.results / "unsteady" / "2d").glob("k*")}
    assert results == {"k6.nc", "k10.nc", "k21.nc"}
