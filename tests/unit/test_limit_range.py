"""Range of a limit at vanishing cell size: exact powers, errors of iterations, its two ends."""

import math

import pytest

from equisection.analysis.grid_convergence import grid_convergence
from equisection.analysis.limit_range import limit_range

SIZES = (1.0, 0.65, 0.43)


def values(limit: float, slope: float, order: float) -> tuple[float, float, float]:
    coarse, medium, fine = (limit + slope * size**order for size in SIZES)
    return coarse, medium, fine


@pytest.mark.parametrize("order", [1.0, 1.4, 2.0])
@pytest.mark.parametrize("slope", [0.1, -0.1])
def test_limit_of_a_power_is_inside_and_is_found(order: float, slope: float) -> None:
    found = limit_range(values(0.3, slope, order), SIZES)
    assert found.value == pytest.approx(0.3)
    assert found.low <= 0.3 + 1e-12
    assert found.high >= 0.3 - 1e-12
    assert found.order_low == found.order_high == pytest.approx(order)


def test_range_is_none_where_order_and_values_are_known() -> None:
    found = limit_range(values(0.3, 0.1, 2.0), SIZES, orders=(2.0,))
    assert found.high - found.low < 1e-12


def test_first_order_reaches_further_than_second_and_errors_further_still() -> None:
    """A value that falls: (f_2 - f_1)/(r^p - 1) below the finest one is larger for p = 1."""
    three = values(0.3, 0.1, 1.5)
    exact = limit_range(three, SIZES)
    ratio = SIZES[1] / SIZES[2]
    assert exact.low == pytest.approx(three[2] - (three[1] - three[2]) / (ratio - 1))
    assert exact.high == pytest.approx(three[2] - (three[1] - three[2]) / (ratio**2 - 1))
    wider = limit_range(three, SIZES, (0.0, 0.0, 1e-3))
    # an error of the finest value counts 1 + 1/(r - 1) times at first order
    assert exact.low - wider.low >= 1e-3 * (1 + 1 / (ratio - 1)) * (1 - 1e-9)
    assert wider.order_low < 1.5 < wider.order_high


def test_values_that_do_not_converge_have_a_range_and_no_limit() -> None:
    found = limit_range((0.30, 0.29, 0.27), SIZES)
    assert math.isnan(found.value)
    assert math.isnan(grid_convergence((0.30, 0.29, 0.27), SIZES).order)
    assert found.low < found.high < 0.27
