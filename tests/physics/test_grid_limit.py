"""Limit over the cell size: exact for an error of one order, with the interval that it deserves."""

import math

import numpy as np
import pytest

from equisection.analysis.grid_limit import grid_limit, is_credible
from equisection.paper.mesh_convergence.mesh_series import (
    LIMIT,
    MeshSeries,
    MeshValue,
    as_table,
)

SIZES = (1.0, 0.7, 0.45)


def values(order: float, limit: float = 5.0, error: float = 2.0) -> list[float]:
    """Return a value with an error of one order on three meshes."""
    return [limit + error * size**order for size in SIZES]


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_error_of_one_order_is_extrapolated_away(order: float) -> None:
    found = grid_limit(values(order), SIZES)
    assert found.value == pytest.approx(5.0)
    assert found.order == pytest.approx(order)
    assert found.half_width == pytest.approx(1.25 * 2.0 * SIZES[-1] ** order)


def test_order_beyond_that_of_the_scheme_is_not_used() -> None:
    """It would make the interval narrower than the scheme warrants."""
    found = grid_limit(values(3.0), SIZES)
    assert found.order == pytest.approx(3.0)
    change = 2.0 * (SIZES[1] ** 3 - SIZES[2] ** 3) / ((SIZES[1] / SIZES[2]) ** 2 - 1.0)
    assert found.half_width == pytest.approx(1.25 * change)
    assert found.low < 5.0 < found.high


@pytest.mark.parametrize("three", [[1.0, 1.2, 1.1], [1.0, 1.1, 1.3], [1.0, 0.5, 0.49999]])
def test_without_an_order_the_interval_is_that_of_the_differences(three: list[float]) -> None:
    """Oscillation, changes that grow, and an order that chance decides."""
    found = grid_limit(three, SIZES)
    assert math.isnan(found.order)
    assert found.value == three[-1]
    assert found.half_width == pytest.approx(3.0 * (max(three) - min(three)))


def test_two_meshes_have_an_interval_that_holds_other_orders() -> None:
    for order in (1.2, 2.0, 3.0):
        found = grid_limit(values(order)[:2], SIZES[:2])
        assert found.low < 5.0 < found.high
        assert found.meshes == 2
        assert math.isnan(found.order)


def test_one_mesh_has_no_limit() -> None:
    found = grid_limit([1.0], [0.5])
    assert math.isnan(found.half_width)
    assert found.basis == "one mesh, no interval"
    assert grid_limit([], []).basis == "no mesh"


def test_errors_of_the_values_widen_the_interval() -> None:
    exact = grid_limit(values(2.0), SIZES)
    loose = grid_limit(values(2.0), SIZES, [0.0, 0.0, 0.1])
    part = 1.0 / ((SIZES[1] / SIZES[2]) ** 2 - 1.0)
    assert loose.value == exact.value
    assert loose.half_width == pytest.approx(np.hypot(exact.half_width, 0.1 * (1.0 + part)))


def test_order_is_credible_around_that_of_the_scheme() -> None:
    assert is_credible(2.6)
    assert not is_credible(10.6)
    assert not is_credible(math.nan)


def series(common_error: bool) -> MeshSeries:
    cells = [round(size**-2 * 1e4) for size in SIZES]
    on_mesh = zip(("coarse", "medium", "fine"), cells, values(2.0), strict=True)
    points = [MeshValue(*one, one[2] - 0.2, one[2] + 0.2) for one in on_mesh]
    shuffled = (points[2], points[0], points[1])
    return MeshSeries("k*", "2d", "", "runs", 2, shuffled, common_error=common_error)


def test_error_that_all_meshes_share_is_in_the_limit_once() -> None:
    shared, apart = series(common_error=True), series(common_error=False)
    assert shared.limit.value == pytest.approx(5.0, rel=1e-3) == apart.limit.value
    exact = grid_limit([v.value for v in shared.values], shared.sizes).half_width
    assert shared.limit.half_width == pytest.approx(np.hypot(exact, 0.2))
    assert apart.limit.half_width > shared.limit.half_width


def test_table_has_the_meshes_from_coarse_to_fine_and_the_limit() -> None:
    table = as_table([series(common_error=True)])
    assert list(table["mesh"]) == ["coarse", "medium", "fine", LIMIT]
    assert table["observed_order"].iloc[-1] == pytest.approx(2.0, rel=1e-3)
