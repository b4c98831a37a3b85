"""`sweep.onset: model` learns the onset from a release, and runs bear it out or contradict."""

import json

import pandas as pd
import pytest

from equisection.results.netcdf import read_dataset
from tests.workflow.project import Project, has_nothing_to_do, jobs_run, small

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


def test_corrected_section_has_no_release_of_its_own(learnt: tuple[Project, str]) -> None:
    released = learnt[0].results / "unsteady" / "2d-corrected" / "sweep.json"
    assert json.loads(released.read_text())["results"] == {}


def test_model_says_what_it_was_learnt_from(learnt: tuple[Project, str]) -> None:
    found = read_dataset(learnt[0].results / "rom" / "2d-corrected" / "model.nc").attrs
    assert found["words"].startswith("model learnt from embedded solver")
    assert found["onset_k_star_low"] < found["onset_k_star"] < found["onset_k_star_high"]


def test_limit_cycles_end_at_the_onset(learnt: tuple[Project, str]) -> None:
    """Well above the onset's k* a release decays, and below it swings."""
    found = read_dataset(learnt[0].results / "rom" / "2d" / "model.nc")
    assert found.attrs["limit_cycles"].startswith("limit cycle by a model learnt from all ")
    k_star, size = found["k_star"].values, found["limit_cycle_deg"].values
    assert (size[k_star > 1.5 * found.attrs["onset_k_star"]] < 0.2).all()
    near = (k_star > 0.8 * found.attrs["onset_k_star"]) & (k_star < found.attrs["onset_k_star_low"])
    assert (size[near] > 0.5).all()


def test_onset_is_within_a_tenth_of_the_embedded_sweep(learnt: tuple[Project, str]) -> None:
    """Growth of its releases is zero at k* 7.9 between 40 and 100 c/V; one lag stands for several.

    The second model, learnt from a run that contradicted, is nearer than the first one.
    """
    onset = pd.read_csv(learnt[0].results / "comparison" / "onset.csv").set_index("model")
    assert onset.loc["2d", "k_star_learnt"] == pytest.approx(7.9, rel=0.1)


def test_runs_contradict_where_they_are_on_the_wrong_side(learnt: tuple[Project, str]) -> None:
    """What the table says of each model agrees with its runs."""
    onset = pd.read_csv(learnt[0].results / "comparison" / "onset.csv")
    assert list(onset["model"]) == ["2d", "2d-corrected"]
    for row in onset.to_dict("records"):
        wrong = (
            row["k_star_unstable"] >= 0.999 * row["k_star_learnt_high"]
            or row["k_star_stable"] <= 1.001 * row["k_star_learnt_low"]
        )
        assert row["confirmation"].startswith("contradicted" if wrong else "not contradicted"), row


def test_contradiction_is_learnt_from(learnt: tuple[Project, str]) -> None:
    """The first runs of the section contradict: the next model is learnt from one of them."""
    folder = learnt[0].results
    first = json.loads((folder / "comparison" / "refine" / "2d_round2.json").read_text())["cases"]
    then = json.loads((folder / "comparison" / "refine" / "2d_round3.json").read_text())["cases"]
    assert 1 <= len(then) <= 2  # an end that was run is not run again
    learnt_from = read_dataset(folder / "rom" / "2d" / "model.nc").attrs["learnt_from"]
    assert learnt_from.removeprefix("2d/") in first


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
