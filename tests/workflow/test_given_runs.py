"""Solver 'given' in the workflow: histories of another run, in files, have its onset."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from equisection.results.netcdf import read_dataset
from tests.workflow.project import Project, jobs_run, small

MODELS = ["2d", "2d-corrected"]
SWEEP = {"models": MODELS, "k_star": [5.0, 7.0, 10.0, 21.0]}
NAMES = ("time", "twist", "deflection", "lift", "moment")
LEFT_OUT = Path("2d-corrected/k5.csv")


def write_histories(run: Path, place: Path) -> None:
    """Write the releases of a run as tables: c/V, degrees nose down, millimetres, coefficients."""
    for release in run.glob("unsteady/2d*/k*.nc"):
        data = read_dataset(release)
        path = place / release.parent.name / f"{release.stem}.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        values = (
            data["time"].values,
            -np.degrees(data["twist"].values),
            1000.0 * data["deflection"].values,
            data["cl"].values,
            data["cm"].values,
        )
        pd.DataFrame(dict(zip(NAMES, values, strict=True))).to_csv(path, index=False)


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Project, Project]:
    """A run of the embedded solver, and one of its histories without one of them."""
    folder = tmp_path_factory.mktemp("given") / "project"
    computed = Project.fresh(folder, small(run="computed", sweep=SWEEP))
    computed.run(computed.target("comparison/critical_speed.csv"))
    write_histories(computed.results, folder / "data")
    (folder / "data" / LEFT_OUT).unlink()
    given = {
        "histories": "data/{model}/k{k_star}.csv",
        "polars": {"coarse": "config/polars/plate_2d_11136.csv"},
        "basis": "time",  # the embedded solver's loads are those of the motion
        "units": {
            "time": "c/V",
            "twist": "deg",
            "deflection": "mm",
            "lift": "1",
            "moment": "1",
        },
        "signs": {"twist": -1},
        "moment_axis": 0.5,
    }
    steady = {**small()["steady"], "beam_polar": "config/polars/paper_plate_3d.csv"}
    recorded = Project(
        folder, small(run="recorded", solver="given", given=given, sweep=SWEEP, steady=steady)
    )
    recorded.run()
    return computed, recorded


def summary(project: Project) -> pd.DataFrame:
    return pd.read_csv(project.results / "comparison/summary.csv").set_index(["model", "k_star"])


def test_the_section_has_the_verdicts_of_the_run_that_its_files_are_of(
    runs: tuple[Project, Project],
) -> None:
    computed, recorded = (summary(project).loc["2d"] for project in runs)
    # a batch is looked at for its verdict at other times than a record, and so ends at others: of a
    # decay more is left at one end than at the other
    regimes = [one["regime"].replace("settled", "decaying") for one in (recorded, computed)]
    assert list(regimes[0]) == list(regimes[1])
    assert {"growing", "decaying"} <= set(regimes[0])
    off = (recorded["growth_rate"] - computed["growth_rate"]).abs()
    same_end = recorded["end_time"] == computed["end_time"]
    assert same_end.any()
    assert (off[same_end] < 5e-5).all()
    assert (recorded["growth_low"] <= computed["growth_high"]).all()
    assert (recorded["growth_high"] >= computed["growth_low"]).all()


def test_the_onset_is_the_same_and_says_what_it_is_from(runs: tuple[Project, Project]) -> None:
    onset = [pd.read_csv(one.results / "comparison/onset.csv").set_index("model") for one in runs]
    bracket = ["k_star_stable", "k_star_unstable"]
    assert list(onset[0].loc["2d", bracket]) == list(onset[1].loc["2d", bracket])
    speeds = pd.read_csv(runs[1].results / "comparison/critical_speed.csv")
    assert set(speeds["basis"]) == {"time"}
    assert set(speeds["model"]) == set(MODELS)


def test_a_release_without_a_file_is_missing(runs: tuple[Project, Project]) -> None:
    missing = pd.read_csv(runs[1].results / "comparison/missing.csv")
    assert list(missing["model"] + "/" + missing["case"]) == ["2d-corrected/k5"]
    assert "no file data/2d-corrected/k5.csv" in missing["reason"][0]
    assert ("2d-corrected", 5.0) not in summary(runs[1]).index


def test_figures_are_drawn_and_nothing_is_made_again(runs: tuple[Project, Project]) -> None:
    assert (runs[1].results / "figures/response.png").stat().st_size > 10_000
    assert not jobs_run(runs[1].run())


def test_a_file_that_comes_later_is_taken(runs: tuple[Project, Project]) -> None:
    _, recorded = runs
    place = recorded.folder / "data"
    write_histories(runs[0].results, place)
    recorded.run(
        recorded.target("comparison/missing.csv"), recorded.target("comparison/summary.csv")
    )
    assert pd.read_csv(recorded.results / "comparison/missing.csv").empty
    assert math.isfinite(summary(recorded).loc["2d", "growth_rate"].iloc[0])
    assert ("2d-corrected", 5.0) in summary(recorded).index
