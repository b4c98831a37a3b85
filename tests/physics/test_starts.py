"""Starts of a free motion: a twist that is let go, a rate of heave, and what they are for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.plate_section import ATTACHED, DENSITY, PLATE, POLAR, THIN, speed_of

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.errors import ArgumentError, IncidenceOutOfRangeError
from equisection.motion.beams import BeamParameters, beam_system, release_beams
from equisection.motion.sections import release_sections, section_system
from equisection.motion.stability import stability
from equisection.motion.steady_states import (
    least_stable_eigenvalue,
    release_state,
    rigid_state,
)
from equisection.solvers.embedded.equilibrium_start import (
    equilibria_of_beams,
    equilibria_of_sections,
)
from equisection.solvers.embedded.section_release import release
from equisection.solvers.verdicts import WITHOUT_EQUILIBRIUM
from equisection.validation.flutter_values import deck
from equisection.verdict.cycles import find_cycles


def growth_of(time: np.ndarray, twist: np.ndarray, after: float) -> float:
    """Growth rate of the amplitude of the twist (per c/V) after a time."""
    cycles = find_cycles(time, twist)
    at = cycles.time[2:-2]
    late = at > after
    return float(np.polyfit(at[late], np.log(cycles.amplitude[late]), 1)[0])


def test_symmetric_section_at_zero_stays_where_it_is():
    """An exact equilibrium at a speed at which it is unstable: what the start is for."""
    section = deck(0.0).in_flow(1.22, 82.0)
    loads = UnsteadyLoads.from_polar(THIN, ATTACHED)
    assert least_stable_eigenvalue(section_system([section], loads, 0.0))[0].real > 0.02
    history = release_sections([section], loads, 0.0, 300.0)
    assert not history.twist.any()


@pytest.mark.parametrize(
    ("speed", "growth", "eigenvalue"),
    [(74.0, -0.00829, -0.00828), (78.0, 0.00735, 0.00734), (82.0, 0.02277, 0.02276)],
)
def test_deck_from_a_twist_grows_as_its_eigenvalue(speed, growth, eigenvalue):
    """The deck of IABSE TG3.1 at 0 deg from 0.1 deg of twist, on either side of 76.2 m/s."""
    section = deck(0.0).in_flow(1.22, speed)
    loads = UnsteadyLoads.from_polar(THIN, ATTACHED)
    exact = least_stable_eigenvalue(section_system([section], loads, 0.0))[0].real
    assert exact == pytest.approx(eigenvalue, abs=1e-5)
    history = release_sections([section], loads, 0.0, 300.0, twist=math.radians(0.1))
    assert history.twist[0, 0] == pytest.approx(math.radians(0.1))
    measured = growth_of(history.time, history.twist[:, 0], after=100.0)
    assert measured == pytest.approx(growth, abs=3e-5)
    assert measured == pytest.approx(exact, abs=3e-5)


def test_start_is_steady_flow_at_the_held_twist():
    """Lags and loads at the release are those of the polar at theta_0 and the twist together."""
    section = PLATE.in_flow(DENSITY, speed_of(PLATE, 8.0))
    twist = math.radians(3.0)
    system = section_system([section], UnsteadyLoads.from_polar(POLAR), math.radians(1.0))
    states, deficits = release_state(system, twist)
    elsewhere = section_system([section], UnsteadyLoads.from_polar(POLAR), math.radians(4.0))
    rigid, of_rigid = rigid_state(elsewhere)
    layout = system.layout
    np.testing.assert_allclose(states[:, layout.structural :], rigid[:, layout.structural :])
    np.testing.assert_allclose(deficits, of_rigid)
    assert states[0, 0] == twist
    history = release_sections(
        [section], UnsteadyLoads.from_polar(POLAR), math.radians(1.0), 1.0, twist=twist
    )
    # the spring, which is at rest at theta_0, pulls it back at once
    assert history.twist[1, 0] < twist
    # before it has moved, lift is the polar's and the apparent mass
    circulatory = float(POLAR.lift_coefficient(math.radians(4.0)))
    w_second = (circulatory + 0.0) / (section.mass + math.pi / 2)
    expected = circulatory - math.pi / 2 * w_second
    assert history.lift_coefficient[0, 0] == pytest.approx(expected, rel=1e-9)


def test_no_start_is_the_rigid_state():
    section = PLATE.in_flow(DENSITY, speed_of(PLATE, 8.0))
    system = section_system([section], UnsteadyLoads.from_polar(POLAR), math.radians(2.5))
    for mine, other in zip(release_state(system), rigid_state(system), strict=True):
        np.testing.assert_array_equal(mine, other)


@pytest.mark.parametrize("lags", [ATTACHED, IDENTIFIED_LAGS])
def test_rate_of_heave_is_felt_by_the_flow_at_once(lags):
    """Half of the incidence -w' acts immediately (R. T. Jones: phi(0) = 1/2)."""
    section = PLATE.in_flow(DENSITY, speed_of(PLATE, 8.0))
    system = section_system([section], UnsteadyLoads.from_polar(THIN, lags), 0.0)
    states, deficits = release_state(system, heave_rate=0.01)
    assert states[0, 3] == 0.01
    columns = np.concatenate([states[0], deficits[0], [1.0]])
    bubble = system.probe[0, 0] @ columns
    share = 1.0 + lags.delay / lags.relaxation if lags.relaxation else 0.0
    immediate = -0.5 * 0.01
    assert bubble == pytest.approx((1.0 - share) * immediate if share else immediate, rel=1e-12)


def beam_of_modes(k_star: float) -> BeamParameters:
    """Return a cantilever of two torsion modes and one bending mode."""
    span = np.linspace(0.0, 1.0, 201)
    strips = cosine_strips(12, root_on_wall=True)
    flow = PLATE.in_flow(DENSITY, speed_of(PLATE, k_star))
    return BeamParameters.from_modes(
        span=span,
        torsion_shapes=np.sin(np.outer([0.5, 1.5], np.pi * span)),
        torsion_frequencies=math.sqrt(flow.torsional_stiffness / flow.inertia)
        * np.array([[1.0, 3.0]]),
        inertia=np.array([flow.inertia]),
        bending_shapes=np.array([0.5 * span**2 * (3.0 - span)]),
        bending_frequencies=np.array([[math.sqrt(flow.flexural_stiffness / flow.mass)]]),
        mass=np.array([flow.mass]),
        stations=strips.stations,
        weights=strips.weights,
    )


def test_beam_starts_in_its_first_modes():
    """Twist of the tip in f_1, rate of the tip in g_1, and then it grows at its eigenvalue."""
    parameters = beam_of_modes(2.0)
    loads = UnsteadyLoads.from_polar(POLAR)
    exact = least_stable_eigenvalue(beam_system(parameters, loads, 0.0))[0].real
    history = release_beams(
        parameters, loads, 0.0, 150.0, tip_twist=math.radians(0.01), tip_heave_rate=1e-4
    )
    assert history.tip_twist[0, 0] == pytest.approx(math.radians(0.01))
    assert history.tip_deflection_rate[0, 0] == pytest.approx(1e-4)
    assert history.torsion_amplitudes[0, 0, 1] == 0.0
    assert exact > 0.01
    measured = growth_of(history.time, history.tip_twist[:, 0], after=80.0)
    assert measured == pytest.approx(exact, abs=3e-4)


def test_release_in_python_from_a_twist():
    unstable, stable = speed_of(PLATE, 2.2), speed_of(PLATE, 2.8)
    for speed, regime in ((unstable, "growing"), (stable, "settled")):
        motion = release(
            PLATE, POLAR, incidence_deg=0.0, speed=speed, density=DENSITY, start_twist_deg=0.2
        )
        eigen = stability(PLATE, POLAR, incidence_deg=0.0, speed=speed, density=DENSITY)
        assert (eigen["mechanism"].item() == "flutter") == (regime == "growing")
        assert np.degrees(motion["twist"].values[0]) == pytest.approx(0.2)
        assert (motion.attrs["regime"] in {"settled", "decaying"}) <= (regime == "settled")
        assert (np.ptp(motion["twist"].values[-200:]) > math.radians(0.4)) == (regime == "growing")


def test_starts_that_make_no_sense_are_refused():
    with pytest.raises(ArgumentError, match="start_heave_rate"):
        release(PLATE, POLAR, incidence_deg=0.0, speed=20.0, start_heave_rate=math.nan)
    with pytest.raises(IncidenceOutOfRangeError, match="deg is outside polar"):
        release(PLATE, POLAR, incidence_deg=0.0, speed=20.0, start_twist_deg=30.0)


def test_equilibrium_is_left_by_nothing_but_a_push():
    """Section and beam stay in static equilibrium, where twist and deflection carry the loads."""
    loads, rigid = UnsteadyLoads.from_polar(POLAR), math.radians(2.5)
    section = PLATE.in_flow(DENSITY, speed_of(PLATE, 12.0))
    about = equilibria_of_sections([section], loads, rigid)
    history = release_sections([section], loads, rigid, 40.0, about=about)
    twist, deflection = history.twist[:, 0], history.deflection[:, 0]
    assert np.ptp(twist) < 1e-9
    assert section.torsional_stiffness * twist[0] == pytest.approx(
        float(POLAR.moment_coefficient(rigid + twist[0])), rel=1e-9
    )
    assert section.flexural_stiffness * deflection[-1] == pytest.approx(
        float(POLAR.lift_coefficient(rigid + twist[0])), rel=1e-9
    )
    beam = beam_of_modes(5.0)
    of_beam = equilibria_of_beams([beam], loads, rigid)
    moved = release_beams(beam, loads, rigid, 40.0, about=of_beam)
    assert abs(moved.tip_twist[0, 0]) > math.radians(0.3)
    assert np.ptp(moved.tip_twist) < 1e-9


@pytest.mark.parametrize("k_star", [8.0, 10.0])
def test_small_push_from_equilibrium_grows_as_the_eigenvalue(k_star):
    """The plate at 2.5 deg on either side of its onset at 8.71, from 0.02 deg."""
    loads, rigid = UnsteadyLoads.from_polar(POLAR), math.radians(2.5)
    section = PLATE.in_flow(DENSITY, speed_of(PLATE, k_star))
    about = equilibria_of_sections([section], loads, rigid)
    push = math.radians(0.02)
    history = release_sections([section], loads, rigid, 120.0, about=about, twist=push)
    assert history.twist[0, 0] == pytest.approx(about[0, 0] + push)
    exact = least_stable_eigenvalue(section_system([section], loads, rigid))[0].real
    measured = growth_of(history.time, history.twist[:, 0], after=30.0)
    assert measured == pytest.approx(exact, abs=3e-4)


def test_section_without_equilibrium_is_released_undeformed_and_says_so():
    """Below the fold of the twist there is none on the branch from rest."""
    polar = Polar.flat_plate(0.6)
    settings = {"incidence_deg": 1.0, "density": DENSITY, "start_twist_deg": 0.2}
    beyond, before = speed_of(PLATE, 1.2), speed_of(PLATE, 8.0)
    lost = release(PLATE, polar, speed=beyond, from_equilibrium=True, **settings)
    assert WITHOUT_EQUILIBRIUM in lost.attrs["reason"]
    assert lost.attrs["start_state"] == "rigid"
    assert np.degrees(lost["twist"].values[0]) == pytest.approx(0.2)
    kept = release(PLATE, polar, speed=before, from_equilibrium=True, **settings)
    assert WITHOUT_EQUILIBRIUM not in kept.attrs["reason"]
    assert kept.attrs["start_state"] == "equilibrium"
    assert np.degrees(kept["twist"].values[0]) > 0.3
    with pytest.raises(ArgumentError, match="from_equilibrium is True; wanted start_twist_deg"):
        release(PLATE, polar, speed=before, incidence_deg=1.0, from_equilibrium=True)
