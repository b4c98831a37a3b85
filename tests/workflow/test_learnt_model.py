"""`sweep.onset: model` learns the onset from a release, and runs bear it out."""

import json

import pandas as pd
import pytest

from equisection.results.netcdf import read_dataset
from tests.workflow.project import Project, has_nothing_to_do, jobs_run, small

#: Interval of the sweep that the runs of the embedded solver itself have an onset in.
SWEEP = [4.0, 8.0, 16.0]


@pytest.fixture(scope="module")
def learnt(tmp_path_factory: pytest.TempPathFactory) -> tuple[Project, str]:
    """Return a project whose onset was learnt, and what the run said."""
    config = small(
        sweep={"models": ["2d", "2d-corrected"], "k_star": SWEEP, "onset": "model"},
        steady={"incidence_deg": [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0]},
    )
    project = Project.fresh(tmp_path_factory.mktemp("learnt") / "project", config)
    return project, project.run(
        project.target("comparison/critical_speed.csv"), project.target("figures/growth-rate.png")
    )


def test_both_sections_are_learnt_from_one(learnt: tuple[Project, str]) -> None:
    for model in ("2d", "2d-corrected"):
        found = read_dataset(learnt[0].results / "rom" / model / "model.nc").attrs
        assert found["learnt_from"].startswith("2d/")
        assert found["words"].startswith("model learnt from embedded solver")
        assert found["onset_k_star_low"] < found["onset_k_star"] < found["onset_k_star_high"]
        assert found["confirmation"].startswith("not contradicted by 2 runs"), found


def test_runs_on_both_sides_bracket_the_onset(learnt: tuple[Project, str]) -> None:
    onset = pd.read_csv(learnt[0].results / "comparison" / "onset.csv")
    assert list(onset["model"]) == ["2d", "2d-corrected"]
    assert (onset["k_star_unstable"] <= onset["k_star_learnt"]).all()
    assert (onset["k_star_learnt"] <= onset["k_star_stable"]).all()


def test_speeds_of_the_model_never_pass_for_those_of_runs(learnt: tuple[Project, str]) -> None:
    table = pd.read_csv(learnt[0].results / "comparison" / "critical_speed.csv")
    assert set(table["basis"]) == {"time", "model", "eigenvalue"}
    of_model = table[(table["model"] == "2d") & (table["basis"] == "model")].iloc[0]
    assert of_model["speed_low"] < of_model["speed"] < of_model["speed_high"]


def test_few_cases_are_run_in_the_place_of_the_sweep(learnt: tuple[Project, str]) -> None:
    project, said = learnt
    rounds = sorted((project.results / "comparison" / "refine").glob("2d-corrected_*.json"))
    chosen = [json.loads(path.read_text())["cases"] for path in rounds]
    assert chosen[0] == []
    assert len(chosen[1]) == 2
    assert len(list((project.results / "unsteady" / "2d-corrected").glob("k*.nc"))) <= 4
    assert jobs_run(said)["learnt_model"] == 2


def test_learnt_run_has_nothing_to_do_afterwards(learnt: tuple[Project, str]) -> None:
    project = learnt[0]
    assert has_nothing_to_do(project.run(project.target("comparison/critical_speed.csv")))
