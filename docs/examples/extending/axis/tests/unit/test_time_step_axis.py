"""The time step as an axis of the study: names, cases and columns, up to the onset of each step."""

from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from equisection.analysis.onset import onset_table
from equisection.analysis.summary import summary_of
from equisection.cases import UnsteadyCase, read_cases
from equisection.config import load_config, resolve_config
from equisection.errors import ConfigError
from equisection.store.index import write_index
from equisection.store.job import run_cases
from equisection.study import plan
from equisection.study.axes import K_STAR, TIME_STEP, Point

RAW: dict[str, Any] = {
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "bending_modes": 1,
        "torsion_modes": 1,
    },
    "steady": {"incidence_deg": [0, 2.5, 5, 10], "resolution": "thin"},
    "embedded": {"polars": {"thin": "flat-plate"}},
    "sweep": {"k_star": [1.4, 4.0], "time_step": [0.05, 0.1], "models": ["2d"]},
    "unsteady": {"duration": 120.0},
}


def test_cases_are_named_by_both_axes() -> None:
    names = plan.sweep_cases(load_config(RAW))
    assert names == ["k1.4_t0.05", "k1.4_t0.1", "k4_t0.05", "k4_t0.1"]
    assert Point.named("k4_t0.1") == Point.at({TIME_STEP: 0.1, K_STAR: 4.0})
    without = load_config({"sweep": {"k_star": [1.4, 4.0]}})
    assert plan.sweep_cases(without) == ["k1.4", "k4"]


def test_step_that_is_no_part_of_the_output_interval_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"sweep\.time_step\.1: 0\.03: allowed are the output"):
        load_config({"sweep": {"time_step": [0.05, 0.03]}})


def test_onset_of_a_sweep_is_that_of_each_step(tmp_path: Path, load_script: Any) -> None:
    """Thin-airfoil theory diverges below k* = pi/2, whatever the step."""
    config = load_config(RAW)
    modes, section = tmp_path / "modes.nc", tmp_path / "equivalent.nc"
    load_script("modes").main(config.beam, config.structure, modes, tmp_path / "study.nc")
    load_script("equivalent_section").main(config.beam, config.flow, modes, section)
    written = tmp_path / "cases" / "unsteady" / "2d" / "sweep.json"
    files = {"equivalent": section}
    names = plan.sweep_cases(config)
    load_script("unsteady_cases").main(resolve_config(config), "2d", files, names, written)
    cases = read_cases(written)
    assert {
        name: case.time_step for name, case in cases.items() if isinstance(case, UnsteadyCase)
    } == {name: Point.named(name)[TIME_STEP] for name in names}

    index = tmp_path / "unsteady" / "2d" / "sweep.json"
    found = run_cases(cases, index.parent, tmp_path / ".store", tmp_path / "progress.json")
    write_index(index, found)
    onset = onset_table(summary_of([index]))
    wanted = {"model": "2d", "k_star_stable": 4.0, "k_star_unstable": 1.4}
    expected = pd.DataFrame([{**wanted, "time_step": step} for step in (0.05, 0.1)])
    pd.testing.assert_frame_equal(onset[list(expected.columns)], expected)
