"""Runs through the scheduler, with the memory, time and ranks that the cost model asks for."""

import re
from collections import Counter

import pandas as pd
import pytest

from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.run.cost import COST_MODEL, read_cost_model
from equisection.run.jobs import solver_jobs
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


def rules_of_jobs(node: Node) -> Counter[str]:
    """Return how many jobs of each rule SLURM knows of."""
    known = said("scontrol", "show", "job")
    words = re.findall(r"Comment=rule_(\w+?)(?:_wildcards\S*)?\s*$", known, re.MULTILINE)
    return Counter(words)


def test_default_solver_to_the_report(node: Node, project: ClusterProject) -> None:
    project.config = small(sweep={"models": ["2d"]})
    before = rules_of_jobs(node)
    project.run()
    submitted = rules_of_jobs(node) - before
    assert submitted == {"modes": 1, "steady_batch": 2, "unsteady_batch": 1}

    table = pd.read_csv(project.results / SUMMARY)
    assert set(table["k_star"]) == {6.0, 10.0, 21.0}
    assert "failed" not in set(table["regime"])

    *_, told = solver_jobs(load_config(project.config), read_cost_model(ROOT / COST_MODEL))
    job = asked_for(node, "unsteady_batch")
    assert job["JobState"] == "COMPLETED"
    assert job["NumTasks"] == job["NumCPUs"] == "1"
    assert minutes(job["TimeLimit"]) == told.minutes
    assert job["MinMemoryNode"] == f"{told.megabytes}M"

    project.run("--report", "report.html")
    report = (project.folder / "report.html").read_text()
    for name in ("response.png", "growth-rate.png", "summary.csv", "onset.csv"):
        assert name in report


def coarser(project: ClusterProject) -> None:
    """Let the copy's coarse mesh of the plate have 15,128 cells."""
    presets = project.folder / "workflow/equisection/solvers/openfoam/mesh/presets.py"
    text = presets.read_text()
    assert "plate=0.52" in text
    presets.write_text(text.replace("plate=0.52", "plate=0.3"))


@pytest.mark.openfoam
def test_plate_on_two_ranks_to_the_report(
    installation: Installation, node: Node, project: ClusterProject
) -> None:
    """A release of the coupled plate, with the steady flow that it starts from."""
    del installation
    coarser(project)
    project.config = small(
        solver="openfoam",
        openfoam={"ranks": 2, "outer_correctors": 2, "velocity_relaxation": 0.98},
        sweep={"k_star": [10.0], "models": ["3d"]},
        unsteady={"duration": 2.0, "time_step": 0.04, "output_interval": 0.2},
    )
    project.run(project.target(SUMMARY))
    project.run("--report", "report.html", project.target(SUMMARY))
    assert "summary.csv" in (project.folder / "report.html").read_text()
    (row,) = pd.read_csv(project.results / SUMMARY).to_dict("records")
    assert (row["model"], row["k_star"], row["solver"]) == ("3d", 10.0, "openfoam")
    assert 1.79 < row["end_time"] < 2.01  # the last interval may lack its end
    found = read_dataset(project.results / "unsteady" / "3d" / "k10.nc")
    assert found["twist"][-1] > found["twist"][0] == 0.0
    for program in ("simpleFoam", "pimpleFoam"):
        (log,) = (project.folder / "results" / ".store").rglob(f"log.{program}")
        assert re.search(r"^nProcs : 2$", log.read_text(), re.MULTILINE)
    job = asked_for(node, "unsteady_case")
    assert job["NumTasks"] == job["NumCPUs"] == "2"
    # mpirun would not be a step of the job
    assert f"StepId={job['JobId']}.0 " in (node.folder / "slurmd.out").read_text()
