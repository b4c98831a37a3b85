"""The load on a beam as a mode feels it."""

import numpy as np
import pytest

from equisection.reduction.modal_load import modal_load

SPAN = np.linspace(0.0, 1.0, 201)
TORSION = np.sin(np.pi * SPAN / 2)


def middles(count: int) -> np.ndarray:
    return (np.arange(count) + 0.5) / count


def towards_the_tip(count: int) -> np.ndarray:
    """Return stations that are closer to each other towards the tip."""
    return np.sin(np.pi / 2 * middles(count))


STATIONS = [middles(400), towards_the_tip(400)]


@pytest.mark.parametrize("z", STATIONS)
def test_uniform_load_is_felt_as_it_is(z: np.ndarray) -> None:
    assert modal_load(z, np.full(z.size, 0.3), SPAN, TORSION) == pytest.approx(0.3)


@pytest.mark.parametrize("z", STATIONS)
def test_load_that_has_the_shape_of_the_mode_is_felt_by_its_square(z: np.ndarray) -> None:
    """Of sin(pi z/2): 1/2 over 2/pi."""
    felt = modal_load(z, np.sin(np.pi * z / 2), SPAN, TORSION)
    assert felt == pytest.approx(np.pi / 4, rel=1e-5)


@pytest.mark.parametrize("z", STATIONS)
def test_load_that_falls_to_the_tip_is_felt_less_than_its_mean(z: np.ndarray) -> None:
    """An ellipse against z^2: integral of z^2 sqrt(1 - z^2) is pi/16."""
    felt = modal_load(z, np.sqrt(1 - z**2), SPAN, SPAN**2)
    assert felt == pytest.approx(3 * np.pi / 16, rel=1e-4)
    assert felt < np.pi / 4


@pytest.mark.parametrize("stations", [middles, towards_the_tip])
def test_error_is_of_second_order_in_the_distance_of_the_stations(stations) -> None:
    exact = modal_load(middles(20_000), 1 - middles(20_000) ** 4, SPAN, TORSION)
    errors = [
        abs(modal_load(z, 1 - z**4, SPAN, TORSION) - exact) for z in (stations(20), stations(40))
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.2)


def test_size_and_sign_of_the_shape_do_not_matter() -> None:
    z = middles(40)
    one, other = (modal_load(z, 1.0 - z**4, SPAN, factor * TORSION) for factor in (1.0, -7.0))
    assert one == pytest.approx(other)
