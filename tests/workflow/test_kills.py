"""A run that is killed at any moment goes on to the same results."""

import os
import random
import signal
import subprocess
import time

import psutil
import pytest
import xarray as xr

from tests.workflow.project import Project, has_nothing_to_do, small

SUMMARY = "comparison/summary.csv"
KILLS = 3


def kill_while_working(run: subprocess.Popen[str], part: float) -> bool:
    """Kill the whole process group some time after its first job began.

    The time is a part of what Snakemake took to begin it, so it is as long to a machine that is
    faster or slower.

    Returns
    -------
    bool
        Whether it was still running.
    """
    assert run.stdout is not None
    started = time.monotonic()
    for line in run.stdout:
        if line.startswith("Execute"):
            break
    time.sleep(part * (time.monotonic() - started))
    if run.poll() is not None:
        return False
    family = psutil.Process(run.pid).children(recursive=True)
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    survivors = psutil.wait_procs(family, timeout=60)[1]
    assert not survivors, f"the kill left {survivors} running"
    return True


@pytest.mark.parametrize("seed", [1, 2])
def test_killed_run_goes_on_to_the_results_of_an_undisturbed_one(
    seed: int, project: Project, finished_section: Project
) -> None:
    moments = random.Random(seed)
    project.config = small(sweep={"models": ["2d"]})
    target = project.target(SUMMARY)
    killed = 0
    for _ in range(KILLS):
        run = project.start("--rerun-incomplete", target)
        killed += kill_while_working(run, moments.random())
        project.run("--unlock")
    assert killed >= 2

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
