"""Zigzag of the loads of stored results, and the warning of it."""

import math
from pathlib import Path

import pytest

from equisection.results.loads_zigzag import loads_zigzag, warning_of_zigzag
from equisection.results.netcdf import read_attributes
from equisection.verdict.zigzag import LARGEST_ZIGZAG

KEPT = Path(__file__).parents[2] / "results" / "reference"


def zigzag(path: str) -> float:
    """Return the zigzag of a kept result."""
    return loads_zigzag(KEPT / path, read_attributes(KEPT / path))["loads_zigzag"]


def test_two_iterations_a_step_leave_the_plate_s_loads_zigzagging_and_four_do_not():
    two = zigzag("paper-plate-openfoam-3d/unsteady/3d/k6.44.nc")
    four = zigzag("independence-3d-step0.04-outer4/unsteady/3d/k6.44.nc")
    assert two > 2 * LARGEST_ZIGZAG
    assert four < LARGEST_ZIGZAG / 20


def test_iterations_that_end_by_their_residuals_leave_none():
    paths = sorted((KEPT / "paper-plate-openfoam" / "unsteady").glob("*/*.nc"))
    assert len(paths) == 20
    assert max(zigzag(str(path.relative_to(KEPT))) for path in paths) < LARGEST_ZIGZAG / 20


def test_samples_that_pass_over_each_second_step_do_not_tell():
    assert math.isnan(zigzag("independence-3d-step0.02-outer2/unsteady/3d/k6.44.nc"))


def test_what_the_solver_has_seen_in_every_step_counts():
    path = KEPT / "independence-3d-step0.02-outer2/unsteady/3d/k6.44.nc"
    attributes = read_attributes(path) | {"loads_zigzag": 0.07}
    assert loads_zigzag(path, attributes) == {"loads_zigzag": 0.07}


def test_results_without_a_history_have_none():
    path = next((KEPT / "paper-plate-openfoam" / "steady").glob("2d/*.nc"))
    assert loads_zigzag(path, read_attributes(path)) == {}


@pytest.mark.parametrize("zigzag", [0.0, LARGEST_ZIGZAG, math.nan])
def test_no_warning_where_nothing_is_wrong_or_known(zigzag):
    assert warning_of_zigzag(zigzag) == ""


def test_the_warning_says_how_much_and_what_to_change():
    warning = warning_of_zigzag(0.0641)
    for part in ("6.4 %", "2 %", "openfoam.outer_correctors", "unsteady.time_step"):
        assert part in warning
