"""Sensitivities of critical speeds: closed forms, similarity, and the searched onset itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.physics.test_stability_map import STIFF, beam_of, body_of, rising
from tests.plate_section import ATTACHED, CHORD, DENSITY, PLATE, POLAR, THIN, damped

from equisection.aerodynamics.polar import Polar
from equisection.errors import EquisectionError
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.critical import critical_of
from equisection.motion.onset_sensitivity import FollowedOnset
from equisection.motion.stability_map import map_lines
from equisection.motion.varied_body import PARAMETERS, BodyParameter, parameters_of

BY_NAME = {one.name: one for one in PARAMETERS}
SPEEDS = np.linspace(10.0, 100.0, 31)
DAMPED = damped(PLATE, 0.005)


def onset_of(body: BodyInFlow, incidence_deg: float) -> FollowedOnset:
    (line,) = map_lines(body, [math.radians(incidence_deg)], SPEEDS)
    return FollowedOnset(line)


def relative(onset: FollowedOnset) -> dict[str, float]:
    """D ln V/d ln p of every parameter that varies by a part."""
    return {
        one.name: onset.derivative(one) / onset.speed
        for one in parameters_of(onset.line.body)
        if one.by_a_part
    }


def test_divergence_goes_with_the_root_of_stiffness_over_density_and_slope():
    """V_D^2 = k_theta/((rho/2) c^2 c_m') (Bisplinghoff, Ashley & Halfman, chapter 8)."""
    onset = onset_of(body_of(STIFF, THIN, ATTACHED), 0.0)
    known = {"k_theta": 0.5, "density": -0.5, "moment": -0.5}
    for name, value in relative(onset).items():
        assert value == pytest.approx(known.get(name, 0.0), abs=2e-6), name


def test_divergence_over_the_place_of_the_axis_is_that_of_thin_plate_theory():
    """V^-2 goes with pi/2 + 2 pi x_ea: d ln V/dx_ea = -2 at mid-chord."""
    onset = onset_of(body_of(STIFF, THIN, ATTACHED), 0.0)
    by_axis = onset.derivative(BY_NAME["elastic_axis"]) / onset.speed
    assert by_axis == pytest.approx(-2.0, rel=1e-3)


def test_fold_keeps_its_incidence_and_goes_with_the_root_of_the_stiffness():
    onset = onset_of(body_of(STIFF, rising(), ATTACHED), 2.0)
    assert onset.is_fold
    found = relative(onset)
    assert found["k_theta"] == pytest.approx(0.5, abs=1e-6)
    assert found["density"] == pytest.approx(-0.5, abs=1e-6)
    assert found["moment"] == pytest.approx(-0.5, abs=1e-6)
    assert found["k_w"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("incidence_deg", [0.0, 2.5, 5.0])
def test_flutter_goes_with_the_root_of_all_stiffnesses(incidence_deg: float):
    """With springs s times as stiff and the same damping ratios time goes s^1/2 as fast."""
    found = relative(onset_of(body_of(DAMPED, POLAR), incidence_deg))
    assert found["k_w"] + found["k_theta"] == pytest.approx(0.5, abs=2e-6)


@pytest.mark.parametrize("incidence_deg", [0.0, 2.5, 5.0])
def test_flutter_stays_where_masses_and_springs_go_with_the_density(incidence_deg: float):
    found = relative(onset_of(body_of(DAMPED, POLAR), incidence_deg))
    structure = ("mass", "inertia", "k_w", "k_theta")
    assert sum(found[name] for name in structure) == pytest.approx(-found["density"], abs=2e-6)


def test_attached_flow_does_not_feel_the_lags_of_separation():
    found = relative(onset_of(body_of(PLATE, Polar.flat_plate(10.0)), 0.0))
    assert max(abs(found[name]) for name in ("tau_1", "tau_2", "tau_3")) < 1e-6


@pytest.mark.parametrize("parameter", PARAMETERS, ids=lambda one: one.name)
def test_derivative_is_the_difference_of_two_onsets_that_a_map_searches(parameter: BodyParameter):
    """Independent of the vectors: whole maps of two bodies, 0.02 % or 0.0002 apart either way."""
    body, step = body_of(DAMPED, POLAR), 2e-3
    ends = []
    for sign in (1, -1):
        (line,) = map_lines(parameter.changed(body, sign * step), [math.radians(2.0)], SPEEDS)
        ends.append(critical_of(line).critical_speed)
    searched = (ends[0] - ends[1]) / (2.0 * step)
    found = onset_of(body, 2.0).derivative(parameter)
    assert found == pytest.approx(searched, rel=0.01, abs=0.01)


@pytest.mark.parametrize(
    ("name", "change"),
    [("k_theta", 0.2), ("k_theta", -0.2), ("lift", -0.3), ("tau_1", 0.3), ("moment", 0.13)],
)
def test_speed_under_a_large_change_is_that_of_a_map(name: str, change: float):
    onset = onset_of(body_of(DAMPED, POLAR), 2.0)
    (line,) = map_lines(
        BY_NAME[name].changed(onset.line.body, change), [onset.line.incidence_rad], SPEEDS
    )
    searched = critical_of(line).critical_speed
    assert onset.speed_with(BY_NAME[name], change) == pytest.approx(searched, rel=1e-5)


def test_a_body_too_damped_to_flutter_is_stable_as_far_as_one_looks():
    onset = onset_of(body_of(DAMPED, POLAR), 3.0)
    assert onset.speed_with(BY_NAME["damping_torsion"], 0.2) < math.inf
    assert onset.speed_with(BY_NAME["damping_torsion"], 0.4) == math.inf


def test_beam_that_moves_as_a_whole_has_the_sensitivities_of_its_section():
    beam, section = onset_of(beam_of(POLAR), 2.5), onset_of(body_of(PLATE, POLAR), 2.5)
    for one in PARAMETERS:
        here, there = beam.derivative(one) / beam.speed, section.derivative(one) / section.speed
        assert here == pytest.approx(there, rel=1e-3, abs=1e-6), one.name
        assert beam.speed_with(one, 0.02) == pytest.approx(section.speed_with(one, 0.02), rel=1e-4)


def test_mirrored_incidence_has_the_same_sensitivities():
    up, down = (relative(onset_of(body_of(DAMPED, POLAR), angle)) for angle in (3.0, -3.0))
    assert up == pytest.approx(down, rel=1e-4, abs=1e-6)


def test_values_are_those_of_the_section():
    body = body_of(DAMPED, POLAR)
    values = {one.name: one.value(body, DENSITY) for one in PARAMETERS}
    assert values["mass"] == pytest.approx(PLATE.mass)
    assert values["inertia"] == pytest.approx(PLATE.inertia)
    assert values["k_w"] == pytest.approx(PLATE.flexural_stiffness)
    assert values["k_theta"] == pytest.approx(PLATE.torsional_stiffness)
    assert values["damping_bending"] == pytest.approx(0.005)
    assert values["damping_torsion"] == pytest.approx(0.005)


def test_mass_behind_the_axis_is_the_static_imbalance_of_the_section():
    """S = m d: the changed body is that of the section with its mass there."""
    moved = PLATE.model_copy(update={"static_imbalance": 0.05 * CHORD * PLATE.mass})
    changed = BY_NAME["mass_axis"].changed(body_of(PLATE, POLAR), 0.05)
    np.testing.assert_allclose(
        changed.structure.imbalance, body_of(moved, POLAR).structure.imbalance, rtol=1e-12
    )
    assert BY_NAME["mass_axis"].value(changed, DENSITY) == pytest.approx(0.05)


def test_denser_fluid_is_the_section_in_it():
    changed = BY_NAME["density"].changed(body_of(DAMPED, POLAR), 0.1)
    direct = body_of(DAMPED, POLAR, density=1.1 * DENSITY)
    at = np.array([30.0])
    np.testing.assert_allclose(
        changed.system(at, np.zeros(1)).rates, direct.system(at, np.zeros(1)).rates, rtol=1e-12
    )
    assert changed.k_star_at(at) == pytest.approx(direct.k_star_at(at))


def test_growth_of_an_onset_is_read_along_its_mode():
    """To first order an error of the growth moves the onset by itself over the slope."""
    onset = onset_of(body_of(DAMPED, POLAR), 2.0)
    low, high = onset.speeds_at_growth(1e-5)
    assert low < onset.speed < high
    assert high - low == pytest.approx(2e-5 / onset.growth_by_speed, rel=0.1)


def test_growth_that_no_speed_has_leaves_the_interval_open():
    low, high = onset_of(body_of(DAMPED, POLAR), 2.0).speeds_at_growth(10.0)
    assert (low, high) == (0.0, math.inf)


def test_no_onset_has_no_sensitivities():
    (line,) = map_lines(body_of(DAMPED, POLAR), [0.0], np.array([5.0, 10.0]))
    with pytest.raises(EquisectionError, match="no sensitivities"):
        FollowedOnset(line)
