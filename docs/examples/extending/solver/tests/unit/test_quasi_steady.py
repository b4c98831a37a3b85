"""The quasi-steady solver, from a configuration to the onset of a sweep of two k*."""

import math
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from equisection.config import load_config, resolve_config
from equisection.errors import ConfigError
from equisection.results.netcdf import read_dataset
from equisection.solvers.registry import check_provided
from equisection.study import plan

SLOPE, RIGID = 3.0, 2.5
RAW: dict[str, Any] = {
    "solver": "quasi_steady",
    "reduction": "paper",
    "quasi_steady": {"lift_slope": SLOPE},
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "bending_modes": 1,
        "torsion_modes": 1,
    },
    "flow": {"incidence_deg": RIGID},
    "steady": {"incidence_deg": [0, RIGID, 5, 10]},
    "sweep": {"k_star": [0.7, 6.0], "models": ["2d"]},
    "unsteady": {"duration": 600.0},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory, load_script: Any) -> Path:
    """A sweep up to its onset, made by the scripts that the rules call."""
    run, config = tmp_path_factory.mktemp("run"), load_config(RAW)
    raw = resolve_config(config)
    modes, section, polar = run / "modes.nc", run / "equivalent.nc", run / "polar_2d.nc"
    load_script("modes").main(config.beam, config.structure, modes, run / "study.nc")
    load_script("equivalent_section").main(config.beam, config.flow, modes, section)

    rigid, free = Path("steady/2d/polar.json"), Path("unsteady/2d/sweep.json")
    names = plan.steady_cases(config)
    load_script("steady_cases").main(raw, "2d", names, run / "cases" / rigid)
    files = {"equivalent": section}
    sweep = plan.sweep_cases(config)
    load_script("unsteady_cases").main(raw, "2d", files, sweep, run / "cases" / free)
    for index in (rigid, free):
        progress = run / "progress.json"
        load_script("run_cases").main(run / "cases" / index, run / index, run / "store", progress)

    load_script("polar").main(run / rigid, names, polar)
    summary = run / "summary.csv"
    load_script("summary").main(
        [run / free], summary, section, config.flow.speed, reduction=config.reduction
    )
    load_script("onset").main(
        summary,
        section,
        polar,
        resolution=config.steady.resolution,
        incidence_deg=RIGID,
        speed=config.flow.speed,
        reduction=config.reduction,
        output=run / "onset.csv",
    )
    return run


def test_polar_is_that_of_a_thin_section(run: Path) -> None:
    result = read_dataset(run / "steady/2d/coarse_a5.nc")
    assert float(result["cl"]) == pytest.approx(SLOPE * math.radians(5.0))
    assert float(result["cm"]) == pytest.approx(float(result["cl"]) / 4)


def test_settled_section_is_in_static_equilibrium(run: Path) -> None:
    """k* theta = c_m = (a/4) (theta_0 + theta)."""
    result = read_dataset(run / "unsteady/2d/k6.nc")
    wanted = SLOPE / 4 * RIGID / (6.0 - SLOPE / 4)
    assert result.attrs["regime"] == "settled"
    assert math.degrees(result["twist"].values[-1]) == pytest.approx(wanted, rel=0.01)


def test_section_below_divergence_is_on_the_unstable_side_of_the_onset(run: Path) -> None:
    """It diverges below k* = a/4 at the latest."""
    (row,) = pd.read_csv(run / "onset.csv").to_dict("records")
    assert (row["model"], row["k_star_unstable"], row["k_star_stable"]) == ("2d", 0.7, 6.0)


def test_beams_are_refused() -> None:
    with pytest.raises(ConfigError, match=r"sweep\.models\.0: '3d': .* 'quasi_steady' are models"):
        check_provided(load_config({**RAW, "sweep": {"models": ["3d"]}}))
