"""A case that has no result says so, and the others go on."""

from pathlib import Path

import pandas as pd
import pytest
import xarray as xr

from tests.workflow.project import Project, has_nothing_to_do, small

POLAR = "config/polars/up_to_3_deg.csv"


@pytest.fixture(scope="module")
def run_beyond_its_polar(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A run whose polar ends at 3 deg, where the softer beams twist beyond it."""
    config = small(
        embedded={"polars": {"short": POLAR}},
        steady={"resolution": "short", "incidence_deg": [0.0, 1.0, 2.0, 2.5, 3.0, 5.0]},
        sweep={"k_star": [1.0, 6.0, 40.0]},
    )
    project = Project.fresh(tmp_path_factory.mktemp("failed") / "project", config)
    lines = (project.folder / "config" / "polars" / "plate_2d_11136.csv").read_text().splitlines()
    end = next(number for number, line in enumerate(lines) if line.startswith("4,"))
    (project.folder / POLAR).write_text("\n".join(lines[:end]) + "\n")
    project.run()
    return project


@pytest.fixture
def summary(run_beyond_its_polar: Project) -> pd.DataFrame:
    table = pd.read_csv(run_beyond_its_polar.results / "comparison" / "summary.csv")
    return table.set_index(["model", "k_star"])


@pytest.mark.parametrize("model", ["2d", "2d-corrected", "3d"])
def test_case_beyond_its_polar_has_failed_and_says_why(model: str, summary: pd.DataFrame) -> None:
    row = summary.loc[model, 1.0]
    assert row["regime"] == "failed"
    assert "polar" in row["reason"]
    assert pd.isna(row["mean_twist_deg"])


@pytest.mark.parametrize("model", ["2d", "2d-corrected", "3d"])
def test_cases_inside_the_polar_are_there(model: str, summary: pd.DataFrame) -> None:
    row = summary.loc[model, 40.0]
    assert row["regime"] != "failed"
    assert 0 < row["mean_twist_deg"] < 0.5


def test_steady_polar_keeps_the_angles_that_have_a_value(run_beyond_its_polar: Project) -> None:
    with xr.open_dataset(run_beyond_its_polar.results / "steady" / "polar_2d.nc") as polar:
        there = polar["cl"].sel(resolution="short").notnull()
        assert polar["incidence_deg"].values[there.values].tolist() == [0.0, 1.0, 2.0, 2.5, 3.0]
        assert "short 5 deg: " in polar.attrs["failures"]


def test_figures_and_tables_are_made_all_the_same(run_beyond_its_polar: Project) -> None:
    figures = {path.name for path in Path(run_beyond_its_polar.results / "figures").iterdir()}
    assert {"response.png", "fig17-hysteresis.png", "lift-correction.png"} <= figures
    assert (run_beyond_its_polar.results / "comparison" / "paper.csv").exists()


def test_failed_cases_are_not_run_again(run_beyond_its_polar: Project) -> None:
    assert has_nothing_to_do(run_beyond_its_polar.run())
