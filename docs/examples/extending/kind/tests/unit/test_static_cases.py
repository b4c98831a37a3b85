"""Static equilibrium as a kind of case: its physics, and its way through store and status."""

import math
from pathlib import Path
from typing import Any

import pytest

from equisection.cases import read_cases
from equisection.config import load_config, resolve_config
from equisection.results.netcdf import read_dataset
from equisection.run.listing import cases_of_run
from equisection.run.status import State, run_status
from equisection.run.verify import verify_run
from equisection.store.index import read_index
from equisection.store.made_from import write_record
from equisection.store.result_store import ResultStore, task_of
from equisection.study import plan

RAW: dict[str, Any] = {
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "bending_modes": 1,
        "torsion_modes": 1,
    },
    "flow": {"incidence_deg": 1.0},
    "steady": {"incidence_deg": [0, 2.5, 5, 10], "resolution": "thin"},
    "embedded": {"polars": {"thin": "flat-plate"}},
    "sweep": {"k_star": [1.6, 4.0, 21.0], "models": ["2d"]},
}
INDEX = "static/2d/sweep.json"


@pytest.fixture
def run(tmp_path: Path, load_script: Any) -> Path:
    """A run whose static cases have run."""
    config = load_config(RAW)
    run = tmp_path / "results" / "beam"
    (run / "logs").mkdir(parents=True)
    modes, section = run / "modes.nc", run / "equivalent.nc"
    load_script("modes").main(config.beam, config.structure, modes, run / "study.nc")
    load_script("equivalent_section").main(config.beam, config.flow, modes, section)
    cases, log = run / "cases" / INDEX, run / "logs" / "static_2d.log"
    names = plan.sweep_cases(config)
    load_script("static_cases").main(resolve_config(config), section, names, cases)
    progress = log.with_suffix(".progress.json")
    load_script("run_cases").main(cases, run / INDEX, run.parent / ".store", progress)
    write_record(log, [cases], [run / INDEX])
    return run


def test_spring_holds_the_moment_of_the_flow(run: Path) -> None:
    """Of a thin plate k* theta = pi/2 (theta_0 + theta), without an equilibrium below pi/2."""
    for name in ("k4", "k21"):
        result = read_dataset(run / f"static/2d/{name}.nc")
        k_star, rigid = result.attrs["k_star"], math.radians(result.attrs["incidence_deg"])
        twist = 0.5 * math.pi * rigid / (k_star - 0.5 * math.pi)
        assert float(result["cm"]) == pytest.approx(k_star * twist, rel=1e-6)
        assert result.attrs["method"] == "static equilibrium"


def test_equilibrium_beyond_the_polar_is_a_failed_case(run: Path) -> None:
    assert "no static equilibrium" in read_index(run / INDEX)["k1.6"]["failure"]


def test_store_and_status_know_them(run: Path) -> None:
    cases = read_cases(run / "cases" / INDEX)
    store = ResultStore(run.parent / ".store")
    assert store.known(task_of(cases["k4"]))
    assert {listed.model for listed in cases_of_run(run)} == {"static 2d"}
    states = {entry.case: entry.state for entry in run_status(run).entries}
    assert states == {"k1.6": State.FAILED, "k4": State.DONE, "k21": State.DONE}
    assert verify_run(run).faults == {}
