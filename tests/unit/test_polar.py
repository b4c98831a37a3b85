"""Section polars: limits, symmetry, the range of the data and the reading table."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from equisection.aerodynamics.polar import Polar
from equisection.errors import IncidenceOutOfRangeError

ANGLES = np.radians([0, 1, 2, 3, 5, 8, 12])
LIFT = np.array([0, 0.17, 0.34, 0.49, 0.66, 0.72, 0.70])
MOMENT = np.array([0, 0.033, 0.059, 0.066, 0.058, 0.056, 0.07])
DRAG = np.array([0.043, 0.045, 0.053, 0.066, 0.107, 0.165, 0.24])
HALF = Polar(ANGLES, DRAG, LIFT, MOMENT, "half")
WHOLE = HALF.mirrored()


def test_flat_plate_is_thin_plate_theory() -> None:
    plate = Polar.flat_plate(0.2)
    alpha = np.linspace(-0.2, 0.2, 77)
    assert plate.lift_coefficient(alpha) == pytest.approx(2 * np.pi * alpha, abs=1e-13)
    assert plate.moment_coefficient(alpha) == pytest.approx(np.pi / 2 * alpha, abs=1e-13)
    assert np.all(plate.drag_coefficient(alpha) == 0)
    assert plate.lift_slope() == pytest.approx(2 * np.pi)
    assert plate.moment_slope(0.1) == pytest.approx(np.pi / 2)


def test_points_are_met() -> None:
    assert WHOLE.lift_coefficient(ANGLES) == pytest.approx(LIFT, abs=1e-6)
    assert WHOLE.moment_coefficient(-ANGLES) == pytest.approx(-MOMENT, abs=1e-6)
    assert WHOLE.drag_coefficient(-ANGLES) == pytest.approx(DRAG, abs=1e-6)


def test_table_is_the_monotone_cubic() -> None:
    alpha = np.random.default_rng(1).uniform(*WHOLE.incidence_range, 5000)
    cubic = PchipInterpolator(WHOLE.incidence, WHOLE.lift)
    assert np.max(np.abs(WHOLE.lift_coefficient(alpha) - cubic(alpha))) < 1e-6


def test_mirrored_polar_is_exactly_zero_at_zero() -> None:
    assert WHOLE.lift_coefficient(0.0) == 0.0
    assert WHOLE.moment_coefficient(0.0) == 0.0


@given(st.floats(-ANGLES[-1], ANGLES[-1]))
def test_mirrored_polar_is_odd_with_even_drag(alpha: float) -> None:
    assert WHOLE.lift_coefficient(-alpha) == pytest.approx(-WHOLE.lift_coefficient(alpha))
    assert WHOLE.moment_coefficient(-alpha) == pytest.approx(-WHOLE.moment_coefficient(alpha))
    assert WHOLE.drag_coefficient(-alpha) == pytest.approx(WHOLE.drag_coefficient(alpha))


@given(st.floats(ANGLES[0], ANGLES[-1]))
def test_interpolation_adds_no_peak(alpha: float) -> None:
    segment = np.clip(np.searchsorted(ANGLES, alpha), 1, ANGLES.size - 1)
    bounds = LIFT[segment - 1 : segment + 1]
    assert bounds.min() - 1e-6 <= WHOLE.lift_coefficient(alpha) <= bounds.max() + 1e-6


def test_outside_the_data_is_nan_and_leaves_the_other_lanes_alone() -> None:
    greatest = WHOLE.incidence_range[1]
    alpha = np.array([0.01, greatest, greatest + 1e-9, -0.3, np.nan, np.inf, -1e305])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        inside = np.isfinite(WHOLE.lift_coefficient(alpha))
    assert inside.tolist() == [True, True, False, False, False, False, False]


def test_shape_is_kept() -> None:
    assert WHOLE.lift_coefficient(np.zeros((3, 4))).shape == (3, 4)
    assert WHOLE.lift_coefficient(0.02).shape == ()


def test_slope_is_the_limit_of_the_secant() -> None:
    step = 1e-3
    secant = WHOLE.lift_coefficient(0.01 + step) - WHOLE.lift_coefficient(0.01 - step)
    assert WHOLE.lift_slope(0.01) == pytest.approx(secant / (2 * step), rel=1e-2)


def test_covers_and_require_name_value_and_range() -> None:
    assert WHOLE.covers([0.1, -0.2])
    assert not WHOLE.covers([0.1, 0.3])
    assert not WHOLE.covers(np.nan)
    with pytest.raises(IncidenceOutOfRangeError, match=r"17\.19 deg.*-12 to 12 deg"):
        WHOLE.require([0.1, 0.3])
    with pytest.raises(IncidenceOutOfRangeError):
        WHOLE.lift_slope(0.3)


def test_polar_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        WHOLE.lift[0] = 1.0


@pytest.mark.parametrize(
    ("incidence", "lift", "words"),
    [
        ([0, 0.1, 0.2], [0, 1, 2], "4 or more"),
        ([0, 0.1, 0.1, 0.2], [0, 1, 2, 3], "ascend"),
        ([0, 0.1, 0.2, 0.3], [0, 1, 2, np.nan], "not finite"),
        ([0, 0.1, 0.2, 0.3], [0, 1, 2], "one for each"),
    ],
)
def test_bad_polar_is_refused(incidence: list[float], lift: list[float], words: str) -> None:
    zeros = np.zeros(len(incidence))
    with pytest.raises(ValueError, match=words):
        Polar(np.array(incidence), zeros, np.array(lift), zeros, "bad")


def test_only_a_half_polar_of_a_symmetric_section_is_mirrored() -> None:
    with pytest.raises(ValueError, match="starts at -12 deg"):
        WHOLE.mirrored()
    with pytest.raises(ValueError, match="vanish"):
        Polar(ANGLES, DRAG, LIFT + 0.01, MOMENT, "cambered").mirrored()
