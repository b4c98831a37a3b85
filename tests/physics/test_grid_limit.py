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
    assert found.half_width == pytest.approx(3.0 * change)
    assert found.low < 5.0 < found.high


def test_errors_of_opposite_signs_that_pass_for_a_high_order_are_in_the_interval() -> None:
    """Both fall, at different rates: the order looks better than any of them, and is not."""
    both = [5.0 + 0.5 * h**2 - 0.3 * h for h in SIZES]
    found = grid_limit(both, SIZES)
    assert found.order > 2.1
    assert found.low < 5.0 < found.high
    assert abs(found.value - 5.0) > 1.25 / 3.0 * found.half_width  # factor 1.25 would miss it


def test_order_of_the_scheme_is_trusted_within_what_its_fit_errs_by() -> None:
    trusted, beyond = (grid_limit(values(order), SIZES) for order in (2.05, 2.15))
    assert beyond.half_width > 2.0 * trusted.half_width


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


FOUR = (1.0, 0.7, 0.45, 0.32)


def on_four(order: float, noise: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)) -> list[float]:
    return [5.0 + 2.0 * h**order + by for h, by in zip(FOUR, noise, strict=True)]


def test_of_four_meshes_the_three_finest_count_where_all_differ_by_more_than_their_errors() -> None:
    found = grid_limit(on_four(2.0), FOUR, [0.01] * 4)
    three = grid_limit(on_four(2.0)[1:], FOUR[1:], [0.01] * 3)
    assert (found.value, found.half_width) == (three.value, three.half_width)
    assert found.value == pytest.approx(5.0)


def test_a_mesh_within_the_errors_of_the_finest_tells_no_order_and_is_passed_over() -> None:
    """By the last three meshes the order would be chance and the interval nearly the change."""
    errors = [0.02, 0.02, 0.15, 0.15]
    noise = (0.0, 0.0, -0.12, 0.08)  # the last two are alike
    values = on_four(2.0, noise)
    found = grid_limit(values, FOUR, errors)
    by_three = grid_limit([values[one] for one in (0, 1, 3)], [FOUR[one] for one in (0, 1, 3)])
    assert found.order == by_three.order
    assert found.value == by_three.value
    assert found.low < 5.0 < found.high
    assert "three of 4 meshes" in found.basis
    last = grid_limit(values[1:], FOUR[1:], errors[1:])
    assert found.half_width < 0.5 * last.half_width
    # what the line through the others misses it by counts as an error
    line = found.value + (values[3] - found.value) * (FOUR[2] / FOUR[3]) ** 2
    without = grid_limit(
        [values[one] for one in (0, 1, 3)],
        [FOUR[one] for one in (0, 1, 3)],
        [errors[one] for one in (0, 1, 3)],
    )
    assert found.half_width == pytest.approx(math.hypot(without.half_width, values[2] - line))


@pytest.mark.parametrize("seed", range(5))
def test_the_interval_of_four_noisy_meshes_holds_the_limit(seed: int) -> None:
    """Errors are half-widths of 95 %, so that a draw of their half as a standard error is usual."""
    errors = np.array([0.02, 0.02, 0.1, 0.1])
    noise = np.random.default_rng(seed).normal(size=(200, 4)) * errors / 2.0
    held = [
        (found := grid_limit(on_four(2.0, tuple(one)), FOUR, errors.tolist())).low
        < 5.0
        < found.high
        for one in noise
    ]
    assert np.mean(held) > 0.95


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
