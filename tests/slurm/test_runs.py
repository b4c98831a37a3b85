"""Runs through the scheduler, with the memory, time and ranks that the cost model asks for."""

import re

import pandas as pd
import pytest

from equisection.config import load_config
from equisection.jobs import solver_jobs
from equisection.results.netcdf import read_dataset
from equisection.solvers.cost import COST_MODEL, read_cost_model
from equisection.solvers.openfoam.installation import Installation
from tests.conftest import ROOT
from tests.slurm.cluster_project import ClusterProject
from tests.slurm.node import Node, said
from tests.workflow.project import small

SUMMARY = "comparison/summary.csv"


def asked_for(node: Node, rule: str) -> dict[str, str]:
    """Return what SLURM knows of the last job of a rule."""
    for job in sorted(map(int, node.jobs()), reverse=True):
        known = said("scontrol", "show", "job", str(job))
        if f"Comment=rule_{rule}_wildcards" in known:
            return dict(re.findall(r"(\w[\w/:]*)=(\S*)", known)) | {"JobId": str(job)}
    raise AssertionError(f"no job of {rule} among {node.jobs()}")


def minutes(limit: str) -> int:
    """Return a time limit as SLURM writes it, days-hours:minutes:seconds, in minutes."""
    days, _, clock = limit.rpartition("-")
    hours, of_hour, _ = map(int, clock.split(":"))
    return (int(days or 0) * 24 + hours) * 60 + of_hour


def test_default_solver_to_the_summary(node: Node, project: ClusterProject) -> None:
    project.config = small(sweep={"models": ["2d"]})
    project.run(project.target(SUMMARY))
    table = pd.read_csv(project.results / SUMMARY)
    assert set(table["k_star"]) == {6.0, 10.0, 21.0}
    assert "failed" not in set(table["regime"])

    *_, told = solver_jobs(load_config(project.config), read_cost_model(ROOT / COST_MODEL))
    job = asked_for(node, "unsteady_batch")
    assert job["JobState"] == "COMPLETED"
    assert job["NumTasks"] == job["NumCPUs"] == "1"
    assert minutes(job["TimeLimit"]) == told.minutes
    assert job["MinMemoryNode"] == f"{told.megabytes}M"


def coarser(project: ClusterProject) -> None:
    """Let the copy's coarse mesh of the plate have 15,128 cells."""
    presets = project.folder / "workflow" / "equisection" / "solvers" / "openfoam" / "presets.py"
    text = presets.read_text()
    assert "plate=0.52" in text
    presets.write_text(text.replace("plate=0.52", "plate=0.3"))


@pytest.mark.openfoam
def test_plate_on_two_ranks_that_slurm_starts(
    installation: Installation, node: Node, project: ClusterProject
) -> None:
    del installation
    coarser(project)
    project.config = small(
        solver="openfoam",
        openfoam={"ranks": 2},
        sweep={"models": ["3d"]},
        unsteady={"time_step": 0.04, "output_interval": 0.2},
    )
    result = project.target("steady/3d/coarse_a2.5.nc")
    project.run(result)
    found = read_dataset(project.folder / result)
    assert found.attrs["method"].startswith("steady")
    assert 0.2 < float(found["cl"]) < 0.5
    (log,) = (project.folder / "results" / ".store").rglob("log.simpleFoam")
    assert re.search(r"^nProcs : 2$", log.read_text(), re.MULTILINE)
    job = asked_for(node, "steady_case")
    assert job["NumTasks"] == job["NumCPUs"] == "2"
    # mpirun would not be a step of the job
    assert f"StepId={job['JobId']}.0 " in (node.folder / "slurmd.out").read_text()
