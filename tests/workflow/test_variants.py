"""The smallest sweeps that a configuration allows run to their last figure."""

import pandas as pd
import pytest
import xarray as xr

from tests.workflow.project import Project, small


def test_one_k_star_of_one_model_with_a_name_of_its_own(project: Project) -> None:
    project.config = small(sweep={"models": ["2d", "2d-corrected", "3d"]})
    # the command line has the last word over the file
    override = ("--config", "run=panel-2_b.1", "sweep={models: [3d], k_star: [21.0]}")
    project.run(*override)
    project.config["run"] = "panel-2_b.1"
    summary = pd.read_csv(project.results / "comparison" / "summary.csv")
    assert summary[["model", "k_star"]].values.tolist() == [["3d", 21.0]]
    onset = pd.read_csv(project.results / "comparison" / "onset.csv")
    assert pd.isna(onset.loc[0, "k_star_unstable"])
    figures = {path.stem for path in (project.results / "figures").glob("*")}
    assert {"response", "modal-contributions"} <= figures
    assert "hysteresis" not in figures  # of a section


def test_given_polar_of_the_beam_takes_the_place_of_its_steady_runs(project: Project) -> None:
    polar = "config/polars/paper_plate_3d.csv"
    project.config = small(
        steady={"beam_polar": polar}, sweep={"k_star": [21.0], "models": ["2d-corrected"]}
    )
    project.run()
    results = project.results
    assert not (results / "steady" / "3d").exists()
    assert not (results / "cases" / "steady" / "3d").exists()
    figures = {path.stem for path in (results / "figures").glob("*.png")}
    assert {"lift-correction", "moment-correction", "hysteresis", "response"} <= figures
    assert not {"spanwise-loads", "modal-contributions"} & figures
    section = xr.load_dataset(results / "steady" / "polar_2d.nc").sel(incidence_deg=5.0)
    correction = xr.load_dataset(results / "steady" / "correction.nc")
    factor = correction["lift_factor"].interp(incidence_deg=5.0)
    # C_L of the file at 5 deg
    assert float(factor) == pytest.approx(section["cl"].item() / 0.4826, rel=2e-3)
    assert "nothing to be done" in project.run().lower()
    (project.folder / polar).unlink()
    missing = project.attempt()
    assert missing.returncode != 0
    assert "steady.beam_polar: 'config/polars/paper_plate_3d.csv'" in missing.stdout
