"""A run opened as one tree: common axes, units on all, and every broken part named."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from tests.conftest import ROOT

from equisection.analysis.run_tree import open_run
from equisection.analysis.summary import with_both
from equisection.config import load_config
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.store.index import write_index
from equisection.store.made_from import write_record
from equisection.study.axes import AsGiven

KEPT = ROOT / "results/reference"
#: Cases by their places in a run; the two models have other intervals of output and other ends.
CASES = {
    ("2d", "k5"): KEPT / "paper-plate-openfoam/unsteady/2d/k5.nc",
    ("2d", "k10"): KEPT / "paper-plate-openfoam/unsteady/2d/k10.nc",
    ("3d", "k5"): KEPT / "paper-plate-openfoam-3d/unsteady/3d/k5.nc",
}
SUMMARY = "model,k_star,regime,mean_twist_deg,cpu_seconds,reason\n2d,5.0,none,0.5,,\n"


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """A run with histories of two models, the equivalent section of none, and one table."""
    folder = tmp_path / "results" / "made-up"
    for (model, name), kept in CASES.items():
        place = folder / "unsteady" / model
        place.mkdir(parents=True, exist_ok=True)
        shutil.copy(kept, place / f"{name}.nc")
    for model in ("2d", "3d"):
        place = folder / "unsteady" / model
        attributes = {path.stem: read_attributes(path) for path in place.glob("*.nc")}
        write_index(place / "sweep.json", attributes, {"k7": "no kept result"})
    (folder / "comparison").mkdir()
    (folder / "comparison" / "summary.csv").write_text(SUMMARY)
    config = load_config({"run": "made-up"}).model_dump(mode="json")
    (folder / "config.resolved.yaml").write_text(yaml.safe_dump(config))
    return folder


def test_each_history_is_found_by_its_coordinates(run: Path) -> None:
    histories = open_run(run)["histories"].to_dataset()
    assert histories["twist"].dims == ("model", "k_star", "incidence_deg", "time")
    assert list(histories["model"].values) == ["2d", "3d"]
    assert list(histories["k_star"].values) == [5.0, 10.0]
    assert list(histories["incidence_deg"].values) == [2.5]
    for (model, name), kept in CASES.items():
        case = histories.sel(model=model, k_star=float(name[1:]), incidence_deg=2.5)
        own = read_dataset(kept)
        for variable in ("twist", "deflection", "cl", "cm"):
            there = case[variable].dropna("time")
            np.testing.assert_allclose(there["time"], own["time"], atol=1e-6)
            np.testing.assert_array_equal(there, own[variable])
        assert str(case["regime"].values) == own.attrs["regime"]
        assert float(case["mean_twist_deg"]) == own.attrs["mean_twist_deg"]
    missing = histories.sel(model="3d", k_star=10.0)
    assert np.isnan(missing["twist"]).all()
    assert str(missing["regime"].values[0]) == ""


@pytest.mark.parametrize("axis", ["speed", "k_star"])
def test_histories_of_a_sweep_over_speed_are_found_by_it(run: Path, axis: str) -> None:
    """And those of one over k*, of which the summary has speeds at its end, are not."""
    values = {"speed": [28.2842712, 20.0], "k_star": [5.0, 10.0]}[axis]
    summary = with_both(pd.DataFrame({"model": "2d", axis: values}), AsGiven(10.0, 20.0))
    summary.to_csv(run / "comparison" / "summary.csv", index=False)
    is_found = axis == "speed"
    histories = open_run(run)["histories"].to_dataset()
    assert ("speed" in histories.coords) == is_found
    if is_found:
        by_speed, by_k_star = histories.sel(speed=20.0), histories.sel(k_star=10.0)
        np.testing.assert_array_equal(by_speed["twist"], by_k_star["twist"])
        assert histories["speed"].attrs["units"] == "m s-1"


def test_amplitudes_of_modes_belong_to_the_beam_alone(run: Path) -> None:
    amplitude = open_run(run)["histories/torsion_amplitude"]
    own = read_dataset(CASES["3d", "k5"])["torsion_amplitude"]
    there = amplitude.sel(model="3d", k_star=5.0, incidence_deg=2.5).dropna("time")
    np.testing.assert_array_equal(there.transpose("torsion_mode", "time"), own)
    assert np.isnan(amplitude.sel(model="2d")).all()


def test_everything_has_units_and_a_name_and_can_be_written(run: Path, tmp_path: Path) -> None:
    tree = open_run(run)
    bare = [
        f"{node.path}: {name}"
        for node in tree.subtree
        for name, variable in node.dataset.variables.items()
        if not {"units", "long_name"} <= variable.attrs.keys()
    ]
    assert not bare
    tree.to_netcdf(tmp_path / "whole.nc")
    again = xr.open_datatree(tmp_path / "whole.nc")
    xr.testing.assert_equal(again["histories/twist"].load(), tree["histories/twist"])


def test_tables_keep_their_words_and_their_gaps(run: Path) -> None:
    table = open_run(run)["comparison/summary"]
    assert table["regime"].values.tolist() == ["none"]
    assert table["mean_twist_deg"].attrs["units"] == "deg"
    assert np.isnan(table["cpu_seconds"].values).all()


def test_parts_that_a_run_does_not_have_are_absent(run: Path) -> None:
    shutil.rmtree(run / "unsteady")
    tree = open_run(run)
    assert "histories" not in tree.children
    assert "structure" not in tree.children
    assert tree.attrs["run"] == "made-up"


@pytest.mark.parametrize(
    ("broken", "text", "words"),
    [
        ("config.resolved.yaml", None, r"made-up: no folder of a run.*give results/<run>"),
        ("config.resolved.yaml", "run: [", r"config\.resolved\.yaml: cannot be read"),
        ("config.resolved.yaml", "run: x", r"config\.resolved\.yaml: cannot be read"),
        ("unsteady/2d/k5.nc", "x", r"k5\.nc: truncated"),
        ("unsteady/2d/k5.nc", None, r"k5\.nc: missing"),
        ("unsteady/3d/sweep.json", "{}", r"sweep\.json: cannot be read as an index"),
        (
            "unsteady/3d/sweep.json",
            '{"schema_version": 1, "results": {"k5": {}}}',
            r"sweep\.json: case k5 has no k_star",
        ),
        ("comparison/summary.csv", "", r"summary\.csv: cannot be read as a table"),
        ("comparison/summary.csv", "a,b\n1,2\n1,2,3\n", r"summary\.csv: cannot be read"),
        ("structure/modes.nc", "x", r"modes\.nc: truncated"),
    ],
)
def test_what_is_broken_is_named_in_one_line(
    run: Path, broken: str, text: str | None, words: str
) -> None:
    path = run / broken
    path.unlink(missing_ok=True)
    if text is not None:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    with pytest.raises(ResultFileError, match=words) as caught:
        open_run(run)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["comparison/summary.csv", "unsteady/2d/sweep.json"])
def test_what_was_edited_since_its_job_made_it_is_refused(name: str, run: Path) -> None:
    write_record(run / "logs" / "job.log", [], [run / name])
    open_run(run)
    (run / name).write_text((run / name).read_text().replace("5", "6"))
    with pytest.raises(ResultFileError, match=rf"{name}: edited since its job made it"):
        open_run(run)
