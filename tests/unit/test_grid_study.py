"""Table of the grid study: which meshes are compared, and what stands in a line."""

import math

import numpy as np
import pytest
import xarray as xr

from equisection.analysis.grid_study import COLUMNS, grid_study

CELLS = {"fine": 1600, "other": None, "coarse": 100, "medium": 400}


def polar(order: float = 2.0) -> xr.Dataset:
    """Return a polar of errors 0.4 h^p on cells of 1/10, 1/20 and 1/40."""
    over = ("resolution", "incidence_deg")
    incidence = np.array([0.0, 2.5])
    errors = [0.0 if number is None else 0.4 * number ** (-order / 2) for number in CELLS.values()]
    lift = 0.2 * incidence + np.array(errors)[:, None]
    is_run = np.ones(lift.shape, dtype=np.int8)
    return xr.Dataset(
        {
            "cl": (over, lift),
            "cm": (over, -lift),
            "cd": (over, 0 * lift),
            "is_run": (over, is_run),
        },
        {"resolution": list(CELLS), "incidence_deg": incidence},
    )


def test_order_and_limit_stand_at_every_incidence() -> None:
    table = grid_study(polar(), CELLS).set_index(["coefficient", "incidence_deg"])
    assert table.loc[("cl", 2.5), "observed_order"] == pytest.approx(2.0)
    assert table.loc[("cl", 2.5), "extrapolated"] == pytest.approx(0.5)
    assert table.loc[("cm", 2.5), "extrapolated"] == pytest.approx(-0.5)
    assert table.loc[("cl", 2.5), "gci"] == pytest.approx(table.loc[("cl", 2.5)].gci_second_order)
    assert table.loc[("cd", 0.0), "convergence"] == "order undefined"
    assert math.isnan(table.loc[("cd", 0.0), "observed_order"])


def test_what_is_nil_by_symmetry_has_no_line() -> None:
    """Lift and moment at 0 deg are the iterations' remainders; drag there is not nil."""
    table = grid_study(polar(), CELLS)
    assert set(table.loc[table["incidence_deg"] == 0.0, "coefficient"]) == {"cd"}
    assert set(table.loc[table["incidence_deg"] == 2.5, "coefficient"]) == {"cl", "cm", "cd"}


def test_only_similar_meshes_are_compared_by_their_cells() -> None:
    table = grid_study(polar(), CELLS)
    assert set(table["resolutions"]) == {"coarse/medium/fine"}
    assert set(table["cells"]) == {"100/400/1600"}


def test_fewer_than_three_similar_meshes_give_no_line() -> None:
    table = grid_study(polar(), {**CELLS, "fine": None})
    assert tuple(table.columns) == COLUMNS
    assert table.empty


def test_an_incidence_that_a_mesh_was_not_run_at_has_no_line() -> None:
    thin = polar()
    thin["is_run"].loc[{"resolution": "fine", "incidence_deg": 0.0}] = 0
    assert set(grid_study(thin, CELLS)["incidence_deg"]) == {2.5}


def test_a_mesh_without_any_result_is_left_out() -> None:
    """What is kept may lack a whole resolution."""
    rest = polar().sel(resolution=["coarse", "medium", "other"])
    assert grid_study(rest, CELLS).empty
