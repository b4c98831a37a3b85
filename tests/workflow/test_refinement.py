"""`sweep.onset: refine` narrows the bracket of the onset."""

import json

import pandas as pd
import pytest

from tests.workflow.project import Project, has_nothing_to_do, jobs_run, one_case_at_a_time, small

TOLERANCE = 0.4


@pytest.fixture(scope="module", params=["batches", "one case at a time"])
def refined(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Project, str]:
    """Return a project after its refinement, and what the run said."""
    sweep = {
        "models": ["2d"],
        "k_star": [6.0, 21.0],
        "onset": "refine",
        "onset_tolerance": TOLERANCE,
        "onset_points": 2 if request.param == "batches" else 1,
    }
    project = Project.fresh(tmp_path_factory.mktemp("refined") / "project", small(sweep=sweep))
    if request.param == "one case at a time":
        one_case_at_a_time(project)
    return project, project.run(project.target("comparison/onset.csv"))


def test_bracket_becomes_narrower_than_the_tolerance(refined: tuple[Project, str]) -> None:
    onset = pd.read_csv(refined[0].results / "comparison" / "onset.csv").iloc[0]
    assert 6.0 <= onset["k_star_unstable"] < onset["k_star_stable"] <= 21.0
    assert onset["k_star_stable"] / onset["k_star_unstable"] - 1 <= TOLERANCE


def test_each_round_runs_the_k_star_that_it_chose(refined: tuple[Project, str]) -> None:
    project, said = refined
    rounds = sorted((project.results / "comparison" / "refine").glob("2d_round*.json"))
    chosen = [name for path in rounds for name in json.loads(path.read_text())["cases"]]
    assert len(rounds) >= 2
    assert len(chosen) == len(set(chosen)) >= 2
    there = {path.stem for path in (project.results / "unsteady" / "2d").glob("*.nc")}
    assert there == {"k6", "k21", *chosen}
    done = jobs_run(said)
    if "unsteady_batch" in done:
        assert done["unsteady_batch"] == 1 + len(rounds)
    else:
        assert done["unsteady_case"] == 2 + len(chosen)
    summary = pd.read_csv(project.results / "comparison" / "summary.csv")
    assert summary["k_star"].is_monotonic_increasing
    assert len(summary) == 2 + len(chosen)


def test_refined_run_has_nothing_to_do_afterwards(refined: tuple[Project, str]) -> None:
    project = refined[0]
    assert has_nothing_to_do(project.run(project.target("comparison/onset.csv")))
