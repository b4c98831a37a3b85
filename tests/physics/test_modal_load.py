"""The load on a beam as a mode feels it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from equisection.errors import ReductionError
from equisection.reduction.modal_load import modal_load, strip_widths

SPAN = np.linspace(0.0, 1.0, 201)
TORSION = np.sin(np.pi * SPAN / 2)
EVEN = (np.arange(400) + 0.5) / 400


@given(st.lists(st.floats(0.1, 1.0), min_size=1, max_size=60))
def test_widths_are_those_of_the_strips_with_these_middles(sizes: list[float]) -> None:
    widths = np.array(sizes) / sum(sizes)
    edges = np.concatenate([[0.0], np.cumsum(widths)])
    assert strip_widths((edges[1:] + edges[:-1]) / 2) == pytest.approx(widths, abs=1e-9)


@pytest.mark.parametrize("middles", [[], [0.5, 0.9], [0.0, 0.5, 1.0], [0.5, 0.5]])
def test_stations_that_are_no_middles_are_refused(middles: list[float]) -> None:
    with pytest.raises(ReductionError, match="not the middles of strips"):
        strip_widths(np.array(middles))


def test_uniform_load_is_felt_as_it_is() -> None:
    assert modal_load(EVEN, np.full(400, 0.3), SPAN, TORSION) == pytest.approx(0.3)


def test_load_that_has_the_shape_of_the_mode_is_felt_by_its_square() -> None:
    """Of sin(pi z/2): 1/2 over 2/pi."""
    felt = modal_load(EVEN, np.sin(np.pi * EVEN / 2), SPAN, TORSION)
    assert felt == pytest.approx(np.pi / 4, rel=1e-5)


def test_load_that_falls_to_the_tip_is_felt_less_than_its_mean() -> None:
    """An ellipse against z^2: integral of z^2 sqrt(1 - z^2) is pi/16."""
    felt = modal_load(EVEN, np.sqrt(1 - EVEN**2), SPAN, SPAN**2)
    assert felt == pytest.approx(3 * np.pi / 16, rel=1e-4)
    assert felt < np.pi / 4


def test_size_and_sign_of_the_shape_do_not_matter() -> None:
    load = 1.0 - EVEN**4
    one, other = (modal_load(EVEN, load, SPAN, factor * TORSION) for factor in (1.0, -7.0))
    assert one == pytest.approx(other)
