"""Likeness of loads in a prescribed motion to those of the polar: its limits, and what is named."""

from __future__ import annotations

import math

import numpy as np
import pytest

from equisection.aerodynamics.indicial import theodorsen
from equisection.aerodynamics.load_likeness import MovedLoads, expected_loads, mistakes
from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import ForcedMotion

THIN = Polar.flat_plate(math.radians(20.0))
TIME = np.arange(0.0, 120.0, 0.05)
LATE = TIME > 40.0
OMEGA = 0.8


def pitching(amplitude_deg: float = 0.5) -> ForcedMotion:
    incidence = math.radians(1.0) + math.radians(amplitude_deg) * np.sin(OMEGA * TIME)
    return ForcedMotion(TIME, incidence, np.zeros_like(TIME))


def expected() -> MovedLoads:
    found = expected_loads(pitching(), THIN)
    assert found is not None
    return MovedLoads(found.lift[LATE], found.moment[LATE])


def test_expected_loads_of_a_thin_plate_are_theodorsens() -> None:
    """c_l = 2 pi C(k) (theta + theta'/4) + pi/2 theta' about mid-chord, k = omega/2."""
    loads = expected()
    lift = load_response(TIME[LATE], loads.lift, np.array([OMEGA])).response[0]
    twist = load_response(TIME[LATE], pitching().incidence[LATE], np.array([OMEGA])).response[0]
    lag = complex(np.ravel(theodorsen(np.array([OMEGA / 2.0])))[0])
    exact = 2.0 * math.pi * lag * (1.0 + 0.25j * OMEGA) + 0.5j * math.pi * OMEGA
    assert lift / twist == pytest.approx(exact, rel=2e-3)


def test_a_motion_beyond_the_polar_has_none() -> None:
    assert expected_loads(pitching(25.0), THIN) is None


@pytest.mark.parametrize(
    ("lift", "moment", "words"),
    [
        (1.0, 1.0, ""),
        (2.0, 0.6, ""),  # a bluff section
        (-1.0, -1.0, "signs.twist: -1"),
        (1.0, -1.0, "signs.moment: -1"),
        (-1.0, 1.0, "signs.lift: -1"),
        (10.0, 10.0, "lift and moment some 0.1 times as large"),
        (1.0, 0.01, "a moment some 1e+02 times as large"),
    ],
)
def test_one_mistake_is_named_and_another_section_is_not(
    lift: float, moment: float, words: str
) -> None:
    loads = expected()
    recorded = MovedLoads(lift * loads.lift + 0.3, moment * loads.moment - 0.1)  # means are free
    _, found = mistakes(recorded, loads, "pitch", 0.5)
    assert (words in found) if words else not found


def test_moments_about_another_point_are_named() -> None:
    """A moment about 0.25 that is said to be about mid-chord: c_m + (0.25 - 0.5) c_l."""
    loads = expected()
    recorded = MovedLoads(loads.lift, loads.moment - 0.25 * loads.lift)
    difference, found = mistakes(recorded, loads, "pitch", 0.5)
    assert difference > 1.0
    assert "moment_axis: 0.25" in found


def test_difference_of_the_other_sign_is_four_and_of_a_factor_symmetric() -> None:
    loads = expected().varying
    other = MovedLoads(-loads.lift, loads.moment)
    assert loads.difference(other) == pytest.approx(4.0)
    large = MovedLoads(3.0 * loads.lift, loads.moment)
    small = MovedLoads(loads.lift / 3.0, loads.moment)
    assert loads.difference(large) == pytest.approx(loads.difference(small))
    assert loads.difference(loads) == 0.0
