"""A sweep by CFD in which something goes wrong, as the person at the terminal sees it.

OpenFOAM is a stand-in here, whose faults come on demand.
"""

import random
import sys
from pathlib import Path

import pandas as pd
import pytest

from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from tests.conftest import ROOT
from tests.processes import wait_until
from tests.workflow.project import Project, has_nothing_to_do, jobs_run, small
from tests.workflow.test_kills import kill_family

SUMMARY = "comparison/summary.csv"
#: k* of the soft case is 5, that of the stiff one 20; the spring of the section is k*/2 or less.
SOFTEST = "6.0"


@pytest.fixture
def sweep(project: Project, monkeypatch: pytest.MonkeyPatch) -> Project:
    """A project with a sweep of two k* on the stand-in."""
    monkeypatch.setenv(PREFIX_VARIABLE, f"{sys.executable} {ROOT / 'tests/openfoam_stand_in.py'}")
    monkeypatch.setenv("STAND_IN_SOFTEST", SOFTEST)
    project.config = small(
        solver="openfoam",
        sweep={"k_star": [5.0, 20.0], "models": ["2d"]},
        unsteady={"duration": 20.0, "time_step": 0.02},
    )
    return project


def summary(project: Project) -> pd.DataFrame:
    return pd.read_csv(project.results / SUMMARY).set_index("k_star")


def log_of_solver(project: Project) -> str:
    (log,) = [
        path
        for path in (project.folder / "results" / ".store").rglob("log.pimpleFoam")
        if "FOAM FATAL" in path.read_text()
    ]
    return str(log.relative_to(project.folder))


def test_fatal_error_of_a_case_is_told_and_the_others_go_on(
    sweep: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", "fatal")
    target = sweep.target(SUMMARY)
    said = sweep.run("--keep-going", target)
    words = "FOAM FATAL ERROR: / Maximum number of iterations exceeded: 1000"
    result = sweep.target("unsteady/2d/k5.nc")
    assert f"warning: 1 of 1 in {result} failed" in said
    assert f"delete that file and run again. k5: pimpleFoam: {words}" in said
    assert log_of_solver(sweep) in said
    assert "Traceback" not in said
    table = summary(sweep)
    assert table.loc[5.0, "regime"] == "failed"
    assert words in table.loc[5.0, "reason"]
    assert table.loc[20.0, "regime"] != "failed"
    assert has_nothing_to_do(sweep.run(target))

    monkeypatch.delenv("STAND_IN_FAULT")
    Path(sweep.folder / result).unlink()
    again = sweep.run(target, sweep.target("unsteady/2d/sweep.json"))
    assert jobs_run(again)["unsteady_case"] == 1
    assert summary(sweep).loc[5.0, "regime"] != "failed"


def test_fault_of_the_machine_is_told_and_its_case_alone_runs_again(
    sweep: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", "file")
    target = sweep.target(SUMMARY)
    stopped = sweep.attempt("--keep-going", target)
    assert stopped.returncode == 1
    assert 'error: pimpleFoam: FOAM FATAL IO ERROR: / error in IOstream "U"' in stopped.stdout
    assert log_of_solver(sweep) in stopped.stdout
    assert "Traceback" not in stopped.stdout
    there = {path.name for path in (sweep.results / "unsteady" / "2d").glob("*.nc")}
    assert there == {"k20.nc"}

    monkeypatch.delenv("STAND_IN_FAULT")
    assert jobs_run(sweep.run(target))["unsteady_case"] == 1
    assert set(summary(sweep)["regime"]) != {"failed"}


def test_no_openfoam_says_how_to_get_it(sweep: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PREFIX_VARIABLE, "openfoam9999")
    stopped = sweep.attempt(sweep.target("unsteady/2d/k5.nc"))
    assert stopped.returncode == 1
    assert "error: OpenFOAM's prefix 'openfoam9999': no program 'openfoam9999'" in stopped.stdout
    assert "make openfoam" in stopped.stdout
    assert "Traceback" not in stopped.stdout


def test_sweep_killed_at_random_moments_comes_to_the_results_of_an_undisturbed_one(
    sweep: Project, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    target = sweep.target(SUMMARY)
    undisturbed = Project.fresh(tmp_path / "undisturbed", sweep.config)
    undisturbed.run(undisturbed.target(SUMMARY))

    moments = random.Random(1)
    for kill in range(3):  # a run of 1,000 steps is 4,000 pieces
        held = tmp_path / f"held {kill}"
        monkeypatch.setenv("STAND_IN_HOLD", f"pimpleFoam:{moments.randint(1, 1200)}:{held}")
        run = sweep.start("--rerun-incomplete", target)
        wait_until(lambda: held.exists() or run.poll() is not None)  # noqa: B023
        kill_family(run)
        sweep.run("--unlock")
    monkeypatch.delenv("STAND_IN_HOLD")
    sweep.run("--rerun-incomplete", target)

    cost = ["cpu_seconds", "wall_seconds"]
    pd.testing.assert_frame_equal(
        summary(sweep).drop(columns=cost), summary(undisturbed).drop(columns=cost)
    )
    assert has_nothing_to_do(sweep.run(target))
