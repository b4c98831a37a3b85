"""Forced motion in the workflow: nothing without its key, a table and its onset with it."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from equisection.aerodynamics.derivatives import Derivatives
from tests.workflow.project import Project, jobs_planned, jobs_run, one_case_at_a_time, small

FORCED = {"forced_derivatives", "flutter_derivatives"}


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return Project.fresh(tmp_path_factory.mktemp("forced") / "project")


def planned(clone: Project, **forced: object) -> dict[str, int]:
    project = Project(clone.folder, small(forced=forced))
    return dict(jobs_planned(project.run("-n", "--forceall")))


def test_nothing_is_moved_without_the_key(clone: Project) -> None:
    assert not [name for name in planned(clone) if "forced" in name or name in FORCED]


def test_both_components_go_to_one_job_of_a_solver_of_many_cases(clone: Project) -> None:
    jobs = planned(clone, run=True)
    assert {
        name: jobs[name] for name in ("forced_cases", "forced_batch", *FORCED)
    } == dict.fromkeys(("forced_cases", "forced_batch", *FORCED), 1)


def test_derivatives_are_made_without_the_key_if_asked_for_by_name(clone: Project) -> None:
    project = Project(clone.folder, small(forced={"reduced_velocity": [4, 6, 8, 12]}))
    project.run(project.target("derivatives/2d.csv"))
    table = Derivatives.read(project.results / "derivatives/2d.csv")
    assert table.reduced_velocity.tolist() == [4, 6, 8, 12]


def test_each_motion_is_a_job_of_a_solver_of_one_case(tmp_path: Path) -> None:
    project = Project.fresh(tmp_path / "project")
    one_case_at_a_time(project)
    motion = {"run": True, "motion": "harmonic", "reduced_velocity": [4, 6, 8, 12]}
    jobs = planned(project, **motion)
    assert (jobs["forced_case_file"], jobs["forced_case"], jobs["forced_results"]) == (8, 8, 1)


def test_a_run_leaves_table_and_onset_and_is_not_made_again(clone: Project) -> None:
    forced = {"run": True, "reduced_velocity": [4, 6, 8, 12, 16, 20, 24]}
    project = Project(clone.folder, small(forced=forced, sweep={"models": ["2d"]}))
    project.run()
    table = Derivatives.read(project.results / "derivatives/2d.csv")
    assert table.reduced_velocity.tolist() == forced["reduced_velocity"]
    found = pd.read_csv(project.results / "comparison/critical_speed.csv")
    (row,) = found[found["basis"] == "derivatives"].to_dict("records")
    assert (row["model"], row["incidence_deg"]) == ("2d", 2.5)
    assert (project.results / "figures/flutter-derivatives.png").stat().st_size > 10_000
    assert not jobs_run(project.run())
