"""The load model in its limits: Wagner, Theodorsen, the steady polar, and the bubble's lags."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from equisection.aerodynamics.indicial import theodorsen, theodorsen_of_jones, wagner
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, Branches, SeparationLags
from equisection.aerodynamics.unsteady_loads import (
    ForcedMotion,
    UnsteadyLoads,
    adapted_incidence,
    forced_loads,
)

POLAR_FILE = Path(__file__).parents[2] / "config/polars/plate_2d_11136.csv"
REDUCED_FREQUENCIES = (0.02, 0.1, 0.25, 0.5, 1.0)


def flat_plate_loads() -> UnsteadyLoads:
    return UnsteadyLoads.from_polar(Polar.flat_plate(0.5), SeparationLags.none())


def first_harmonic(time: np.ndarray, signal: np.ndarray, omega: float) -> complex:
    """Complex amplitude S of signal = Re(S exp(i omega s)) over the last whole periods."""
    late = time > time[-1] - 2 * math.tau / omega
    basis = np.stack(
        [np.ones(late.sum()), np.cos(omega * time[late]), np.sin(omega * time[late])], axis=1
    )
    _, cosine, sine = np.linalg.lstsq(basis, signal[late], rcond=None)[0]
    return complex(cosine, -sine)


def oscillate(
    k: float, pitch: float, heave: float, loads: UnsteadyLoads
) -> tuple[complex, complex]:
    """First harmonics of c_l and c_m per unit amplitude of pitch (rad) or heave (chords)."""
    omega = 2 * k
    time = np.arange(0.0, 150.0 + 3 * math.tau / omega, math.tau / omega / 400)
    wave = np.cos(omega * time)
    history = forced_loads(ForcedMotion(time, pitch * wave, heave * wave), loads)
    size = pitch + heave
    # the derivatives of the motion are central differences: leave out the one-sided last sample
    return (
        first_harmonic(time[:-2], history.lift_coefficient[:-2], omega) / size,
        first_harmonic(time[:-2], history.moment_coefficient[:-2], omega) / size,
    )


def theodorsen_pitch(k: float, circulation: complex) -> tuple[complex, complex]:
    """c_l and c_m per rad of pitch about mid-chord (NACA Report 496 with a = 0)."""
    rate = 2j * k
    rear = circulation * (1 + rate / 4)
    lift = 2 * math.pi * rear + math.pi / 2 * rate
    moment = math.pi / 2 * rear - math.pi / 8 * rate - math.pi / 64 * rate**2
    return lift, moment


def theodorsen_heave(k: float, circulation: complex) -> tuple[complex, complex]:
    """c_l and c_m per chord of upward heave (NACA Report 496)."""
    rate = 2j * k
    lift = -2 * math.pi * circulation * rate - math.pi / 2 * rate**2
    return lift, -math.pi / 2 * circulation * rate


def test_wagner_starts_at_one_half_and_ends_at_one():
    assert wagner(0.0) == pytest.approx(0.5)
    assert wagner(500.0) == pytest.approx(1.0, abs=1e-9)


def test_jones_form_agrees_with_garrick():
    """Garrick: phi = (tau + 2)/(tau + 4) in semi-chords (NACA TN 601), itself within 2 %."""
    semichords = np.linspace(0.0, 30.0, 301)
    garrick = (semichords + 2) / (semichords + 4)
    np.testing.assert_allclose(wagner(semichords / 2), garrick, rtol=0.03)


@pytest.mark.parametrize("k", REDUCED_FREQUENCIES)
def test_jones_form_of_theodorsens_function(k):
    """Within 0.015 of the exact C(k): the known quality of Jones' approximation."""
    assert abs(theodorsen_of_jones(k) - theodorsen(k)) < 0.015


def test_theodorsens_function_at_a_tabulated_point():
    """C(0.5) = 0.5979 - 0.1507 i (NACA Report 496, table of F and G)."""
    assert complex(theodorsen(0.5)) == pytest.approx(0.5979 - 0.1507j, abs=2e-4)


@pytest.mark.parametrize("k", REDUCED_FREQUENCIES)
@pytest.mark.parametrize(
    ("pitch", "heave", "theory"), [(1e-3, 0.0, theodorsen_pitch), (0.0, 1e-3, theodorsen_heave)]
)
def test_forced_motion_reproduces_theodorsen(k, pitch, heave, theory):
    lift, moment = oscillate(k, pitch, heave, flat_plate_loads())
    exact = theory(k, complex(theodorsen_of_jones(k)))
    scale = abs(exact[0])
    assert abs(lift - exact[0]) < 1e-3 * scale
    assert abs(moment - exact[1]) < 1e-3 * scale
    published = theory(k, complex(theodorsen(k)))
    assert abs(lift - published[0]) < 0.03 * scale
    assert abs(moment - published[1]) < 0.03 * scale


@pytest.mark.parametrize(
    "lags", [IDENTIFIED_LAGS, SeparationLags(10.0, 3.0, 5.0), SeparationLags(0.0, 0.0, 2.0)]
)
@pytest.mark.parametrize("k", [0.1, 0.5, 1.0])
def test_attached_flow_has_thin_plate_theory_for_any_lags(k, lags):
    """The lags are those of separated flow: within 2.5 % of Theodorsen up to k = 1."""
    loads = UnsteadyLoads.from_polar(Polar.flat_plate(0.5), lags)
    for pitch, heave, theory in ((1e-3, 0.0, theodorsen_pitch), (0.0, 1e-3, theodorsen_heave)):
        found = oscillate(k, pitch, heave, loads)
        np.testing.assert_allclose(found, oscillate(k, pitch, heave, flat_plate_loads()))
        lift, _ = theory(k, complex(theodorsen(k)))
        assert abs(found[0] - lift) < 0.025 * abs(lift)


def test_lag_of_the_lift_sets_in_with_the_loss_of_suction():
    """On the plate: none near zero lift, all of it long before the incidence of least moment."""
    branches = Branches.from_polar(Polar.read(POLAR_FILE))
    alpha = np.radians(np.linspace(0.0, 12.0, 241))
    share = branches.lag_share(alpha)
    assert share[0] == 0.0
    assert np.all(np.diff(share) >= 0.0)
    np.testing.assert_allclose(share, branches.lag_share(-alpha), atol=1e-9)
    lost = 1.0 - branches.polar.moment_coefficient(alpha[1:]) / (branches.moment_slope * alpha[1:])
    assert np.all(share[1:][lost > 0.13] == 1.0)
    assert np.isnan(branches.lag_share(np.radians([13.0])))


def test_section_without_leading_edge_suction_lags_as_a_whole():
    angles = np.radians([-10.0, -5.0, 0.0, 5.0, 10.0])
    bluff = Polar(angles, 2.0 + 0 * angles, -2.7 * angles, -0.5 * angles, "bluff")
    assert np.all(Branches.from_polar(bluff).lag_share(angles) == 1.0)


def test_lag_of_the_lift_counts_incidence_from_zero_lift():
    """A camber that only shifts lift and moment leaves attached flow attached."""
    angles = np.radians(np.linspace(-10.0, 10.0, 9))
    cambered = Polar(angles, 0 * angles, 6.0 * angles + 0.4, 1.5 * angles - 0.08, "cambered")
    assert np.max(Branches.from_polar(cambered).lag_share(angles)) < 1e-9


def test_loads_at_rest_are_those_of_the_polar_at_any_incidence():
    polar = Polar.read(POLAR_FILE)
    loads = UnsteadyLoads.from_polar(polar)
    time = np.linspace(0.0, 5.0, 51)
    for incidence in np.radians(np.linspace(-11.9, 11.9, 24)):
        held = forced_loads(ForcedMotion(time, np.full(51, incidence), np.zeros(51)), loads)
        np.testing.assert_allclose(
            held.lift_coefficient, polar.lift_coefficient(incidence), atol=1e-14
        )
        np.testing.assert_allclose(
            held.moment_coefficient, polar.moment_coefficient(incidence), atol=1e-14
        )


def test_mirrored_motion_gives_mirrored_loads():
    loads = UnsteadyLoads.from_polar(Polar.read(POLAR_FILE))
    time = np.linspace(0.0, 40.0, 801)
    incidence = np.radians(2.5 + 3.0 * np.sin(time))
    heave = 0.05 * np.cos(0.7 * time)
    up = forced_loads(ForcedMotion(time, incidence, heave), loads)
    down = forced_loads(ForcedMotion(time, -incidence, -heave), loads)
    np.testing.assert_allclose(up.lift_coefficient, -down.lift_coefficient, atol=1e-13)
    np.testing.assert_allclose(up.moment_coefficient, -down.moment_coefficient, atol=1e-13)


def test_on_a_slow_ramp_the_bubble_is_behind_by_the_sum_of_its_lags():
    """tau_1 x' + x = alpha - tau_2 alpha' has x = alpha - (tau_1 + tau_2) alpha' on a ramp."""
    lags = SeparationLags(relaxation=2.0, delay=0.7, lift_lag=0.0)
    time = np.linspace(0.0, 60.0, 1201)
    bubble = adapted_incidence(0.001 * time, lags, 0.05)
    assert bubble[-1] == pytest.approx(0.001 * (60.0 - 2.7), rel=1e-9)


def test_the_lag_of_the_bubble_makes_the_moment_lead():
    """Im c_m/theta > 0 is work done on the pitching section: stall flutter's cause."""
    polar = Polar.read(POLAR_FILE)
    omega = 0.75  # of the release at k* = 5
    time = np.arange(0.0, 120.0, 0.02)
    motion = ForcedMotion(
        time, math.radians(3.0) + 1e-3 * np.cos(omega * time), np.zeros_like(time)
    )
    work = {}
    for lags in (IDENTIFIED_LAGS, SeparationLags.none()):
        moment = forced_loads(motion, UnsteadyLoads.from_polar(polar, lags)).moment_coefficient
        work[lags] = first_harmonic(time[:-2], moment[:-2], omega).imag
    assert work[IDENTIFIED_LAGS] > 0.0
    assert work[SeparationLags.none()] < 0.0


def test_attached_minus_deficit_is_the_polar():
    polar = Polar.read(POLAR_FILE)
    branches = Branches.from_polar(polar)
    alpha = np.radians(np.linspace(-12, 12, 97))
    np.testing.assert_allclose(
        branches.moment_slope * alpha - branches.moment_deficit(alpha),
        polar.moment_coefficient(alpha),
        atol=1e-15,
    )


@pytest.mark.parametrize("values", [(-1.0, 0.0, 0.0), (1.0, 0.0, -0.1), (0.0, 1.0, 0.0)])
def test_lags_that_make_no_sense_are_refused(values):
    with pytest.raises(ValueError, match=r"convective times|relaxation"):
        SeparationLags(*values)
