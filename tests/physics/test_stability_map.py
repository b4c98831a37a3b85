"""Map of stability: published and independent onsets, folds, modes followed, and faults by name."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.plate_section import ASSEMBLED, ATTACHED, CHORD, DENSITY, PLATE, POLAR, THIN, damped

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.beams import BeamParameters
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.continuation import continued
from equisection.motion.critical import Critical, critical_of, jumps
from equisection.motion.equilibrium_path import BeamPath, SectionPath, all_branches
from equisection.motion.map_dataset import map_of_body
from equisection.motion.sections import section_system
from equisection.motion.stability import critical_speed
from equisection.motion.stability_map import MapLine, map_lines
from equisection.motion.static_branch import BranchEnd, StaticBranch
from equisection.motion.steady_states import equilibrium, jacobian, least_stable_eigenvalue

#: A section whose deflection follows at once: nothing is left to flutter with.
STIFF = PLATE.model_copy(update={"flexural_stiffness": 1e4 * PLATE.flexural_stiffness})


def body_of(
    section: Section,
    polar: Polar,
    lags: SeparationLags = IDENTIFIED_LAGS,
    density: float = DENSITY,
) -> BodyInFlow:
    return BodyInFlow.of_section(section, UnsteadyLoads.from_polar(polar, lags), density)


def speed_at(body: BodyInFlow, k_star: float) -> float:
    return body.speed * math.sqrt(body.k_star / k_star)


def criticals(body: BodyInFlow, degrees: list[float], speeds: list[float]) -> list[Critical]:
    lines = map_lines(body, [math.radians(angle) for angle in degrees], np.array(speeds))
    return [critical_of(line) for line in lines]


@pytest.mark.parametrize(
    ("ratio", "known"),
    [
        (0.0, [5.64, 8.71, 8.86, 11.02, 11.72, 9.76]),
        (0.005, [5.48, 7.68, 7.82, 9.61, 10.05, 8.47]),
        (0.01, [5.34, 7.00, 7.12, 8.68, 8.97, 7.62]),
        (0.02, [5.13, 6.10, 6.19, 7.46, 7.58, 6.52]),
    ],
)
def test_onset_of_the_plate_over_incidence_and_damping(ratio, known):
    """By an independent assembly of the equations with the same polar and lags, within 1 %."""
    found = criticals(
        body_of(damped(PLATE, ratio), POLAR, ASSEMBLED),
        [2.0, 2.5, 3.0, 4.0, 5.0, 6.0],
        list(np.linspace(10.0, 80.0, 30)),
    )
    np.testing.assert_allclose([one.critical_k_star for one in found], known, rtol=0.01)


def test_onset_is_that_of_a_search_in_steps_of_half_a_per_cent():
    angles = [0.0, 1.0, 2.5, 5.0]
    stepped = critical_speed(
        PLATE, POLAR, incidence_deg=angles, speed=(10.0, 80.0), density=DENSITY
    )
    found = criticals(body_of(PLATE, POLAR), angles, [10.0, 40.0, 80.0])
    np.testing.assert_allclose(
        [one.critical_speed for one in found], stepped["critical_speed"], rtol=3e-6
    )
    np.testing.assert_allclose(
        [one.critical_frequency for one in found], stepped["frequency"], rtol=1e-4
    )


def test_incidence_of_the_other_sign_is_the_mirror_image():
    up, down = criticals(body_of(PLATE, POLAR), [3.0, -3.0], [10.0, 80.0])
    assert up.critical_speed == pytest.approx(down.critical_speed, rel=1e-6)
    assert up.critical_twist == pytest.approx(-down.critical_twist, rel=1e-6)
    assert up.tip_ratio == pytest.approx(down.tip_ratio, rel=1e-5)


def test_body_at_another_speed_is_the_section_in_that_flow():
    """Stiffness goes with 1/V^2, damping with 1/V; mass, inertia and imbalance stay."""
    section = damped(PLATE, 0.02).model_copy(
        update={"static_imbalance": 0.1 * PLATE.mass * CHORD, "elastic_axis": 0.4}
    )
    loads = UnsteadyLoads.from_polar(POLAR)
    body = BodyInFlow.of_section(section, loads, DENSITY)
    speeds = np.array([12.0, 30.0])
    direct = section_system([section.in_flow(DENSITY, v) for v in speeds], loads, 0.04)
    np.testing.assert_allclose(
        body.system(speeds, np.full(2, 0.04)).rates, direct.rates, rtol=1e-12, atol=1e-15
    )


def test_modes_are_named_in_still_air_and_keep_their_frequencies_there():
    (line,) = map_lines(body_of(PLATE, POLAR), [0.0], np.array([10.0, 60.0]))
    assert line.modes.names == ("bending 1", "torsion 1")
    start = line.modes.values[0].imag * line.lowest / CHORD
    air = 0.25 * math.pi * DENSITY * CHORD**2  # apparent mass, and of the twist c^2/32 of it
    bending = math.sqrt(PLATE.flexural_stiffness / (PLATE.mass + air))
    torsion = math.sqrt(PLATE.torsional_stiffness / (PLATE.inertia + air * CHORD**2 / 32))
    np.testing.assert_allclose(start, [bending, torsion], rtol=2e-3)


def test_followed_modes_do_not_jump():
    """From one speed to the next each eigenvalue (1/s) goes on smoothly, onset or not."""
    (line,) = map_lines(body_of(PLATE, POLAR), [math.radians(2.5)], np.linspace(5.0, 70.0, 60))
    values = line.modes.values * line.modes.spectrum.speed[:, None] / CHORD
    change = np.abs(np.diff(values, axis=0))
    between = np.abs(values[:, 0] - values[:, 1])[:-1, None]
    assert (change < 0.5 * between).all()


STIFFENING = 40.0


def rising() -> Polar:
    """A polar whose moment rises ever faster: c_m = alpha + 40 alpha^3."""
    alpha = np.radians(np.linspace(-20.0, 20.0, 161))
    moment = alpha + STIFFENING * alpha**3
    return Polar(alpha, 0.0 * alpha, 0.1 * alpha, moment, "rising")


def test_fold_is_where_the_determinant_vanishes_and_is_called_divergence():
    """Of c_m = a alpha + b alpha^3 the fold is at 2 b alpha^3 - 3 b theta_0 alpha^2 = a theta_0."""
    rigid = math.radians(2.0)
    roots = np.roots([2 * STIFFENING, -3 * STIFFENING * rigid, 0.0, -rigid])
    alpha = float(roots[np.abs(roots.imag) < 1e-12].real[0])
    body = body_of(STIFF, rising(), ATTACHED)
    exact = speed_at(body, 1.0 + 3 * STIFFENING * alpha**2)
    (found,) = criticals(body, [2.0], [5.0, 100.0])
    assert found.critical_mechanism == "divergence"
    assert found.critical_speed == pytest.approx(exact, rel=1e-3)
    assert found.divergence_speed == pytest.approx(found.critical_speed, rel=2e-6)
    assert "fold" in found.note
    path = SectionPath(body, rigid)
    near, nearer = (
        np.linalg.det(jacobian(*path.system(np.array([(1.0 - part) * path.end_speed]))))[0]
        for part in (1e-4, 1e-6)
    )
    assert nearer / near == pytest.approx(0.1, rel=0.05)  # as the root of the distance


def test_thin_plate_diverges_by_a_real_root_where_the_spring_gives_way():
    """k* = dc_m/dalpha = pi/2 (Bisplinghoff, Ashley & Halfman, chapter 8)."""
    body = body_of(STIFF, THIN, ATTACHED)
    (found,) = criticals(body, [0.0], [10.0, 100.0])
    assert found.critical_mechanism == "divergence"
    assert found.critical_k_star == pytest.approx(math.pi / 2, rel=3e-6)
    assert found.critical_frequency == 0.0
    assert found.divergence_speed == pytest.approx(found.critical_speed, rel=1e-9)


def test_all_branches_of_a_section_without_incidence():
    """Below k* = dc_m/dalpha a plate has three equilibria: none, and two that mirror each other."""
    body = body_of(PLATE, POLAR)
    slope = POLAR.moment_slope(0.0)
    speed = speed_at(body, 0.5 * slope)
    there = []
    for branch in all_branches(body, 0.0, 2.0 * speed):
        if branch.speed[0] <= speed <= branch.speed[-1]:
            there.append(float(np.interp(speed, branch.speed, branch.incidence[:, 0])))
    assert len(there) == 3
    assert min(map(abs, there)) == 0.0
    assert min(there) == pytest.approx(-max(there), rel=1e-9)
    assert 0.5 * slope * max(there) == pytest.approx(
        float(POLAR.moment_cubic(max(there))), rel=1e-3
    )


def test_continuation_of_a_section_is_its_exact_branch():
    """Of one strip the curve that continuation follows is k* (alpha - theta_0) = c_m."""
    rigid = math.radians(2.5)
    body = body_of(PLATE, POLAR)
    curve, _ = continued(body, rigid, 80.0)
    assert curve.folds == ()
    exact = StaticBranch.from_rest(POLAR, rigid).incidence(body.k_star_at(curve.speed))
    np.testing.assert_allclose(curve.incidence[:, 0], exact, atol=1e-6)


def test_continuation_goes_round_a_fold():
    rigid = math.radians(2.0)
    body = body_of(STIFF, rising(), ATTACHED)
    curve, _ = continued(body, rigid, 100.0)
    (fold,) = curve.folds
    exact = StaticBranch.from_rest(rising(), rigid)
    assert exact.end is BranchEnd.FOLD
    assert curve.speed[fold] == pytest.approx(speed_at(body, exact.k_star_end), rel=1e-5)
    assert curve.incidence[fold, 0] == pytest.approx(exact.stop, rel=1e-2)
    out, back = curve.branches
    assert (np.diff(out.speed) > 0.0).all()
    assert (np.diff(back.speed) < 0.0).all()
    assert back.incidence[-1, 0] > out.incidence[-1, 0]


def beam_of(polar: Polar, lags: SeparationLags = IDENTIFIED_LAGS, strips: int = 6) -> BodyInFlow:
    """Clamped-free beam whose bending and torsion are alike: each strip is a section to itself.

    With both shapes 1 all along the span it is the section, whatever its number of strips.
    """
    flowing = PLATE.in_flow(DENSITY, 20.0)
    ones = np.ones((1, 11))
    weights = np.full(strips, 1.0 / strips)
    parameters = BeamParameters.from_modes(
        span=np.linspace(0.0, 1.0, 11),
        torsion_shapes=ones,
        torsion_frequencies=np.array([[math.sqrt(flowing.torsional_stiffness / flowing.inertia)]]),
        inertia=np.array([flowing.inertia]),
        bending_shapes=ones,
        bending_frequencies=np.array([[math.sqrt(flowing.flexural_stiffness / flowing.mass)]]),
        mass=np.array([flowing.mass]),
        stations=np.cumsum(weights) - 0.5 * weights,
        weights=weights,
    )
    loads = UnsteadyLoads.from_polar(polar, lags)
    k_star = PLATE.k_star(DENSITY, 20.0)
    return BodyInFlow.of_beam(parameters, loads, speed=20.0, chord=CHORD, k_star=k_star)


def test_beam_that_moves_as_a_whole_is_its_section():
    """Continuation, eigenvalues and names of six strips give what the exact path of one gives."""
    angles, speeds = [0.0, 2.5, 5.0], [10.0, 30.0, 60.0]
    beam = criticals(beam_of(POLAR), angles, speeds)
    section = criticals(body_of(PLATE, POLAR), angles, speeds)
    for one, other in zip(beam, section, strict=True):
        assert one.critical_speed == pytest.approx(other.critical_speed, rel=1e-5)
        assert one.critical_frequency == pytest.approx(other.critical_frequency, rel=1e-4)
        assert one.critical_twist == pytest.approx(other.critical_twist, abs=1e-7)
        assert (one.critical_mechanism, one.critical_mode) == (
            other.critical_mechanism,
            other.critical_mode,
        )


def test_path_of_a_beam_is_the_equilibrium_that_newton_finds():
    body = beam_of(POLAR)
    rigid = math.radians(2.5)
    speeds = np.array([15.0, 30.0, 45.0])
    system, states, _ = BeamPath(body, rigid, 60.0).system(speeds)
    np.testing.assert_allclose(states, equilibrium(system)[0], atol=1e-10)
    direct = least_stable_eigenvalue(system)
    (line,) = map_lines(body, [rigid], speeds)
    places = np.searchsorted(line.modes.spectrum.speed, speeds)
    np.testing.assert_allclose(line.least_stable[places], direct, atol=1e-9)


def test_beam_diverges_at_its_fold():
    body = beam_of(rising(), ATTACHED)
    stiff = BodyInFlow.of_section(PLATE, body.loads, DENSITY)
    path, exact = BeamPath(body, math.radians(2.0), 90.0), SectionPath(stiff, math.radians(2.0))
    assert path.end is exact.end is BranchEnd.FOLD
    assert path.end_speed == pytest.approx(exact.end_speed, rel=1e-5)


def one_line(body: BodyInFlow, degrees: float, speeds: list[float]) -> MapLine:
    return map_lines(body, [math.radians(degrees)], np.array(speeds))[0]


def test_range_without_an_onset_says_up_to_where_it_is_stable():
    found = critical_of(one_line(body_of(PLATE, POLAR), 2.5, [5.0, 25.0]))
    assert math.isnan(found.critical_speed)
    assert (found.speed_low, found.critical_mechanism) == (25.0, "none")
    assert found.note == "stable up to 25 m/s"


def test_incidence_beyond_the_polar_is_named_and_the_others_go_on():
    data = map_of_body(body_of(PLATE, POLAR), [2.5, 20.0], [10.0, 40.0])
    assert "20 deg is outside polar" in str(data["note"].values[1])
    assert str(data["critical_mechanism"].values[1]) == "unknown"
    assert set(data["mechanism"].values[1]) == {"unknown"}
    assert np.isnan(data["growth_rate"].values[1]).all()
    alone = critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=(10.0, 40.0), density=DENSITY)
    assert float(data["critical_speed"][0]) == pytest.approx(
        float(alone["critical_speed"]), rel=3e-6
    )


def test_equilibrium_that_leaves_the_polar_is_named():
    body = body_of(STIFF, Polar.flat_plate(math.radians(6.0)), ATTACHED)
    found = critical_of(one_line(body, 2.0, [10.0, 120.0]))
    assert found.critical_mechanism == "unknown"
    assert "leaves the polar (-6 to 6 deg): extend it" in found.note
    # k* theta = c_m at 6 deg; slopes there need a little of the polar beyond
    assert 0.99 < found.speed_low / speed_at(body, 1.5 * math.pi / 2) < 1.0


def test_jump_of_a_polar_between_rest_and_onset_is_named():
    lift = POLAR.lift.copy()
    lift[POLAR.incidence > math.radians(3.5)] += 2.0
    jumping = Polar(POLAR.incidence, POLAR.drag, lift, POLAR.moment, "jumping")
    ((low, high),) = jumps(jumping)
    assert math.degrees(low) == pytest.approx(3.0)
    assert math.degrees(high) == pytest.approx(4.0)
    found = criticals(body_of(PLATE, jumping), [2.5, -2.5], [10.0, 60.0])
    assert "jumps between 3 and 4 deg" in found[0].note
    assert "jumps" not in found[1].note
    assert jumps(POLAR) == []
    below = criticals(body_of(damped(PLATE, 0.15), jumping), [2.99, -2.5], [5.0, 15.0])
    assert below[0].critical_mechanism == "none"
    assert "stable up to 15 m/s" in below[0].note
    assert "jumps between 3 and 4 deg" in below[0].note
    assert "jumps" not in below[1].note


def test_modes_that_cross_are_named_and_the_onset_stays():
    line = one_line(body_of(PLATE, POLAR), 2.5, [10.0, 40.0])
    assert line.modes.crossings == ()
    crossing = replace(line.modes, crossings=((21.5, "bending 1", "torsion 1"),))
    found = critical_of(replace(line, modes=crossing))
    assert found.note == (
        "bending 1 and torsion 1 cross at 21.5 m/s, beyond which their names may be exchanged"
    )
    assert found.critical_speed == critical_of(line).critical_speed


def test_what_is_unstable_at_rest_has_no_onset_after_a_band_of_stability():
    """Two bands of twist with galloping: it starts in the first one and turns into the other."""
    degrees = np.array([-10.0, 0.0, 4.0, 6.0, 8.0, 10.0, 14.0, 16.0, 18.0, 20.0, 30.0])
    lift = np.array([-1.0, 0.0, 0.4, 0.5, 0.3, 0.1, 0.5, 0.6, 0.3, 0.1, 0.8])
    polar = Polar(np.radians(degrees), 0.01 + 0.0 * degrees, lift, 0.01 * degrees, "dips")
    line = one_line(body_of(PLATE, polar, ATTACHED), 7.0, list(np.linspace(2.0, 140.0, 70)))
    assert [one.rises for one in line.crossings[:2]] == [False, True]
    assert line.onset is None
    found = critical_of(line)
    assert math.isnan(found.critical_speed)
    assert "unstable already" in found.note


def test_band_of_instability_that_ends_is_named():
    """Galloping from -c_l' - c_d > 0 in a band of twist that the section leaves as it turns."""
    degrees = np.array([-10.0, -4.0, 0.0, 4.0, 6.0, 8.0, 10.0, 14.0, 20.0, 30.0])
    lift = np.array([-1.0, -0.4, 0.0, 0.4, 0.5, 0.3, 0.1, 0.4, 0.8, 1.4])
    polar = Polar(np.radians(degrees), 0.01 + 0.0 * degrees, lift, 0.01 * degrees, "dip")
    section = damped(PLATE, 0.001)
    line = one_line(body_of(section, polar, ATTACHED), 3.0, list(np.linspace(2.0, 140.0, 70)))
    assert line.humps, critical_of(line)
    found = critical_of(line)
    assert "then stable again" in found.note
    assert found.critical_speed < found.unstable_to == pytest.approx(line.humps[0][1])


def test_everything_has_units_and_the_map_agrees_with_its_critical_speeds():
    data = map_of_body(body_of(PLATE, POLAR), [0.0, 2.5], list(np.linspace(10.0, 70.0, 31)))
    for name, variable in data.variables.items():
        assert {"units", "long_name"} <= variable.attrs.keys(), name
    for angle in (0.0, 2.5):
        one = data.sel(incidence_deg=angle)
        grows = one["growth_rate"].values > 0.0
        first = float(one["speed"].values[grows][0])
        last = float(one["speed"].values[~grows][-1])
        assert last < float(one["critical_speed"]) < first
        assert (one["mechanism"].values[~grows] == "none").all()
        assert (one["mechanism"].values[grows] != "none").all()
        least = one["mode_damping"].min("mode").values
        assert ((least < 0.0) == grows).all()
