"""Orders that are known are recovered; the published sample calculations are reproduced."""

import math

import pytest

from equisection.analysis.grid_convergence import Convergence, cell_size, grid_convergence


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0, 3.7])
@pytest.mark.parametrize("error", [0.3, -0.04])
@pytest.mark.parametrize(
    "sizes",
    [(4.0, 2.0, 1.0), (2.25, 1.5, 1.0), (math.sqrt(5.0), math.sqrt(2.5), 1.0), (3.0, 1.2, 1.0)],
    ids=["2, 2", "1.5, 1.5", "sqrt 2, sqrt 5/2", "2.5, 1.2"],
)
def test_order_and_limit_of_a_manufactured_value(
    order: float, error: float, sizes: tuple[float, float, float]
) -> None:
    coarse, medium, fine = (1.7 + error * size**order for size in sizes)
    found = grid_convergence((coarse, medium, fine), sizes)
    assert found.convergence is Convergence.MONOTONIC
    assert found.order == pytest.approx(order, rel=1e-6)
    assert found.extrapolated == pytest.approx(1.7, rel=1e-7)
    assert found.index * fine == pytest.approx(1.25 * abs(error), rel=1e-5)


@pytest.mark.parametrize(
    ("cells", "values", "kind", "printed"),
    [
        ((4500, 8000, 18000), (5.863, 5.972, 6.063), "monotonic", (1.53, 6.1685, 0.022)),
        ((980, 4500, 18000), (10.6050, 10.7250, 10.7880), "monotonic", (0.75, 10.8801, 0.011)),
        ((980, 4500, 18000), (6.0909, 5.9624, 6.0042), "oscillatory", (1.51, 6.0269, 0.005)),
    ],
    ids=["monotonic", "order below 1", "oscillatory"],
)
def test_sample_calculations_of_celik_et_al_table_1(
    cells: tuple[int, int, int],
    values: tuple[float, float, float],
    kind: str,
    printed: tuple[float, float, float],
) -> None:
    """J. Fluids Eng. 130 (2008) 078001, Table 1."""
    coarse, medium, fine = (cell_size(number, 2) for number in cells)
    found = grid_convergence(values, (coarse, medium, fine))
    order, extrapolated, index = printed
    assert found.convergence == kind
    assert found.order == pytest.approx(order, abs=0.006)
    assert found.extrapolated == pytest.approx(extrapolated, abs=6e-4)
    assert found.index == pytest.approx(index, abs=6e-4)


def test_changes_of_opposite_sign_are_oscillatory() -> None:
    assert grid_convergence((1.1, 1.0, 1.02), (4, 2, 1)).convergence is Convergence.OSCILLATORY
    growing = grid_convergence((1.01, 1.0, 1.1), (4, 2, 1))
    assert growing.convergence is Convergence.OSCILLATORY
    assert math.isnan(growing.order)


@pytest.mark.parametrize(
    "values",
    [(1.0, 1.1, 1.3), (1.0, 1.0, 1.0), (1.0, 1.1, 1.1), (math.nan, 1.1, 1.2), (3.0, 2.0, 1.0)],
    ids=["diverging", "constant", "fine as medium", "no coarse value", "order zero"],
)
def test_order_is_undefined_where_changes_do_not_become_smaller(
    values: tuple[float, float, float],
) -> None:
    found = grid_convergence(values, (4, 2, 1))
    assert found.convergence is Convergence.UNDEFINED
    assert math.isnan(found.order)
    assert math.isnan(found.index)


@pytest.mark.parametrize("values", [(1.0, 1.1, 1.3), (1.01, 1.0, 1.1), (1.0, 1.1, 1.25)])
def test_changes_that_do_not_become_smaller_have_no_index_of_any_order(
    values: tuple[float, float, float],
) -> None:
    """That of second order would be less than the change from grid to grid."""
    assert math.isnan(grid_convergence(values, (4, 2, 1)).index_second_order)


@pytest.mark.parametrize("coarse", [1.0, 1.1, math.nan])
def test_index_of_second_order_needs_two_grids_only(coarse: float) -> None:
    """1.25 |e_21/f_1|/(2^2 - 1), of changes that become smaller or are none."""
    fine = 1.1 if coarse == 1.1 else 1.13
    found = grid_convergence((coarse, 1.1, fine), (4, 2, 1))
    assert found.index_second_order == pytest.approx(1.25 * (fine / 1.1 - 1) * 1.1 / fine / 3)


def test_value_of_zero_has_no_relative_index() -> None:
    found = grid_convergence((0.16, 0.04, 0.0), (4, 2, 1))
    assert found.order == pytest.approx(math.log2(3.0))
    assert math.isnan(found.index)


def test_grids_in_the_wrong_order_are_refused() -> None:
    with pytest.raises(ValueError, match="coarsest first"):
        grid_convergence((1.0, 1.1, 1.2), (1, 2, 4))
