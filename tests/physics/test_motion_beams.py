"""Beams on strips: modes in vacuo, the section as a special case, and the lifting line at rest."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import SpanStrips, cosine_strips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.beam.section import Section
from equisection.motion.beams import BeamParameters, beam_system, release_beams
from equisection.motion.march import march
from equisection.motion.sections import release_sections
from equisection.motion.steady_states import equilibrium, least_stable_eigenvalue, rigid_state

POLAR = Polar.read(Path(__file__).parents[2] / "config/polars/plate_2d_11136.csv")
INCIDENCE = math.radians(2.5)
INERTIA = 2 * 1000.0 * 0.04 / 12  # rho_s h c^3/12 over rho c^4/2 with rho_s/rho = 1000, h = 0.04 c
MASS = 12 * INERTIA
BENDING_ROOTS = np.array([1.87510407, 4.69409113, 7.85475744, 10.99554073])
FREQUENCY_RATIO = 8.07 / 58.5  # first bending to first torsion, of the paper's plate
SPAN = np.linspace(0.0, 1.0, 201)


def torsion_shapes(count: int = 4) -> np.ndarray:
    odd = 2 * np.arange(count) + 1
    return np.sin(np.outer(odd, SPAN) * math.pi / 2) * (-1.0) ** np.arange(count)[:, None]


def bending_shapes(count: int = 4) -> np.ndarray:
    shapes = []
    for root in BENDING_ROOTS[:count]:
        x = root * SPAN
        ratio = (math.cosh(root) + math.cos(root)) / (math.sinh(root) + math.sin(root))
        shape = np.cosh(x) - np.cos(x) - ratio * (np.sinh(x) - np.sin(x))
        shapes.append(shape / shape[-1])
    return np.array(shapes)


def channel(strips: SpanStrips) -> SpanGeometry:
    """Return the span of the paper's plate."""
    return SpanGeometry.of(strips, 0.1, 0.37, 0.4, 0.4)


def plates(k_star: object, *, induced: bool = True, strips: int = 12) -> BeamParameters:
    """The paper's plate in its channel with four modes of each kind."""
    k = np.atleast_1d(np.asarray(k_star, dtype=float))
    first = np.sqrt(k / INERTIA)
    layout = cosine_strips(strips)
    return BeamParameters.from_modes(
        span=SPAN,
        torsion_shapes=torsion_shapes(),
        torsion_frequencies=np.outer(first, [1, 3, 5, 7]),
        inertia=np.full(k.shape, INERTIA),
        bending_shapes=bending_shapes(),
        bending_frequencies=np.outer(
            first, FREQUENCY_RATIO * (BENDING_ROOTS / BENDING_ROOTS[0]) ** 2
        ),
        mass=np.full(k.shape, MASS),
        stations=layout.stations,
        weights=layout.weights,
        finite_span=FiniteSpan.of(channel(layout)) if induced else None,
    )


def beam_of_shape(shape: np.ndarray, k_star: float, heave_stiffness: float) -> BeamParameters:
    """One torsion and one bending mode of the same shape, without induction."""
    layout = cosine_strips(40)
    return BeamParameters.from_modes(
        span=SPAN,
        torsion_shapes=shape[None],
        torsion_frequencies=np.array([[math.sqrt(k_star / INERTIA)]]),
        inertia=np.array([INERTIA]),
        bending_shapes=shape[None],
        bending_frequencies=np.array([[math.sqrt(heave_stiffness / MASS)]]),
        mass=np.array([MASS]),
        stations=layout.stations,
        weights=layout.weights,
    )


def section(k_star: float, heave_stiffness: float) -> list[Section]:
    return [
        Section(
            torsional_stiffness=k_star,
            flexural_stiffness=heave_stiffness,
            inertia=INERTIA,
            mass=MASS,
        )
    ]


def test_in_vacuo_every_mode_keeps_its_frequency_and_its_energy():
    plate = plates(np.array([8.0]), induced=False)
    structure = plate.structure
    heavy = replace(
        plate,
        structure=replace(
            structure,
            torsion_inertia=1e10 * structure.torsion_inertia,
            torsion_stiffness=1e10 * structure.torsion_stiffness,
            bending_mass=1e10 * structure.bending_mass,
            bending_stiffness=1e10 * structure.bending_stiffness,
        ),
    )
    loads = UnsteadyLoads.from_polar(POLAR)
    system = beam_system(heavy, loads, 0.0)
    states, deficits = rigid_state(system)
    layout = system.layout
    states[0, layout.twist] = 0.01
    states[0, layout.deflection] = 0.02
    rows = np.eye(layout.structural, system.rates.shape[2])[None]
    run = march(
        system, (states, deficits), rows, duration=100.0, time_step=0.5, output_interval=0.5
    )
    first = math.sqrt(8.0 / INERTIA)
    for mode, odd in enumerate((1, 3, 5, 7)):
        expected = 0.01 * np.cos(first * odd * run.time)
        np.testing.assert_allclose(run.values[:, 0, mode], expected, atol=1e-7)
    for mode, root in enumerate(BENDING_ROOTS):
        omega = first * FREQUENCY_RATIO * (root / BENDING_ROOTS[0]) ** 2
        expected = 0.02 * np.cos(omega * run.time)
        np.testing.assert_allclose(run.values[:, 0, 8 + mode], expected, atol=1e-7)


def test_a_beam_of_constant_shapes_is_the_section():
    loads = UnsteadyLoads.from_polar(POLAR)
    beam = release_beams(beam_of_shape(np.ones(201), 6.44, 1.2), loads, INCIDENCE, 40.0)
    same = release_sections(section(6.44, 1.2), loads, INCIDENCE, 40.0)
    np.testing.assert_allclose(beam.tip_twist, same.twist, atol=1e-10)
    np.testing.assert_allclose(beam.tip_deflection, same.deflection, atol=1e-10)
    np.testing.assert_allclose(beam.lift_coefficient, same.lift_coefficient, atol=1e-10)
    np.testing.assert_allclose(beam.moment_coefficient, same.moment_coefficient, atol=1e-10)


def test_a_beam_with_equal_shapes_is_the_section_at_a_scaled_incidence():
    """With f = g and a linear polar the projected loads are A = int f^2 times the section's.

    The rigid incidence enters with F = int f instead: the section of sectional inertia and mass
    (the consistent reduction) at theta_0 F/A has the twist of the tip.
    """
    shape = np.sin(SPAN * math.pi / 2)
    loads = UnsteadyLoads.from_polar(Polar.flat_plate(5.0), SeparationLags.none())
    factor = (2 / math.pi) / 0.5  # F/A, 1/a of the consistent reduction
    beam = release_beams(beam_of_shape(shape, 6.44, 1.2), loads, INCIDENCE, 60.0)
    same = release_sections(section(6.44, 1.2), loads, INCIDENCE * factor, 60.0)
    np.testing.assert_allclose(beam.tip_twist, same.twist, rtol=0, atol=2e-5)
    np.testing.assert_allclose(beam.tip_deflection, same.deflection, rtol=0, atol=2e-4)


def test_the_rigid_beam_carries_the_load_of_the_lifting_line():
    strips = cosine_strips(12)
    line = LiftingLine.of(POLAR, strips, channel(strips))
    steady = line.solve(INCIDENCE)
    system = beam_system(plates(8.0), UnsteadyLoads.from_polar(POLAR), INCIDENCE)
    states, deficits = rigid_state(system)
    circulatory = states[0, system.layout.lag(3)]  # c_l has apparent mass once it is let go
    assert strips.weights @ circulatory == pytest.approx(steady.lift, rel=1e-9)
    columns = np.concatenate([states[0], deficits[0], [1.0]])
    np.testing.assert_allclose(
        system.probe[0, : system.layout.strips] @ columns,
        steady.effective_incidence,
        rtol=0,
        atol=1e-9,
    )


def test_rigid_beam_beyond_a_drop_of_the_lift_carries_the_load_of_the_lifting_line():
    """At 7.5 deg, where whole steps of Newton's method jump to and fro over the drop at 5 deg."""
    degrees = np.array([0.0, 3.0, 5.0, 6.0, 8.0, 10.0, 16.0])
    angles, lift = np.radians(degrees), np.array([0.0, 0.45, 0.75, 0.55, 0.575, 0.6, 0.6])
    drop = Polar(angles, 0.05 + 0 * angles, lift, 0.2 * angles, "drop").mirrored()
    strips = cosine_strips(20)
    line = LiftingLine.of(drop, strips, channel(strips))
    incidence = math.radians(7.5)
    system = beam_system(plates(21.0, strips=20), UnsteadyLoads.from_polar(drop), incidence)
    states, _ = rigid_state(system)
    assert strips.weights @ states[0, system.layout.lag(3)] == pytest.approx(
        line.solve(incidence).lift, rel=1e-9
    )


def test_static_equilibrium_carries_the_load_of_the_lifting_line():
    parameters = plates(np.array([6.44, 21.0]))
    loads = UnsteadyLoads.from_polar(POLAR)
    system = beam_system(parameters, loads, INCIDENCE)
    states, deficits = equilibrium(system)
    strips = cosine_strips(12)
    line = LiftingLine.of(POLAR, strips, channel(strips))
    shapes = parameters.structure.torsion_shapes
    for lane in range(2):
        amplitudes = states[lane, system.layout.twist]
        steady = line.solve(INCIDENCE, shapes @ amplitudes)
        weighted = strips.weights @ (steady.cm_section[:, None] * shapes)
        stiffness = parameters.structure.torsion_stiffness[lane]
        np.testing.assert_allclose(stiffness * amplitudes, weighted, rtol=1e-7, atol=1e-12)
        lifted = strips.weights @ (steady.cl_section[:, None] * parameters.structure.bending_shapes)
        stiffness = parameters.structure.bending_stiffness[lane]
        np.testing.assert_allclose(
            stiffness * states[lane, system.layout.deflection], lifted, rtol=1e-7, atol=1e-12
        )
    assert np.isfinite(deficits).all()


def test_tip_of_a_beam_held_at_both_ends_is_where_its_first_mode_is_largest():
    """Of modes sin(n pi z/L): mid-span, where they are 1, 0, -1."""
    modes = np.sin(np.outer([1, 2, 3], SPAN) * math.pi)
    layout = cosine_strips(12)
    parameters = BeamParameters.from_modes(
        span=SPAN,
        torsion_shapes=modes,
        torsion_frequencies=np.array([[1.0, 2.0, 3.0]]),
        inertia=np.array([INERTIA]),
        bending_shapes=modes,
        bending_frequencies=np.array([[0.2, 0.8, 1.8]]),
        mass=np.array([MASS]),
        stations=layout.stations,
        weights=layout.weights,
    )
    np.testing.assert_allclose(parameters.torsion_at_tip, [1.0, 0.0, -1.0], atol=1e-12)
    np.testing.assert_allclose(parameters.bending_at_tip, [1.0, 0.0, -1.0], atol=1e-12)


def test_a_sweep_gives_what_single_runs_give():
    k_star = np.array([4.0, 21.0])
    loads = UnsteadyLoads.from_polar(POLAR)
    sweep = release_beams(plates(k_star), loads, INCIDENCE, 30.0)
    for lane, value in enumerate(k_star):
        single = release_beams(plates(value), loads, INCIDENCE, 30.0)
        np.testing.assert_allclose(
            sweep.tip_twist[:, lane], single.tip_twist[:, 0], rtol=0, atol=1e-12
        )
        np.testing.assert_allclose(
            sweep.bending_amplitudes[:, lane],
            single.bending_amplitudes[:, 0],
            rtol=0,
            atol=1e-11,
        )


def test_second_order_in_the_time_step():
    def twist(step: float) -> np.ndarray:
        return release_beams(
            plates(5.0),
            UnsteadyLoads.from_polar(POLAR),
            INCIDENCE,
            16.0,
            time_step=step,
            output_interval=0.4,
        ).tip_twist

    exact = twist(0.4 / 64)
    errors = [np.abs(twist(0.4 / n) - exact).max() for n in (1, 2, 4, 8)]
    assert np.log2(errors[1] / errors[3]) / 2 > 1.8
    assert errors[3] < 1e-3 * np.abs(exact).max()  # the default step, 0.05


def test_first_modes_rule():
    """A uniform moment alone leaves the second torsion mode 1/27 of the first (F_i/omega_i^2)."""
    history = release_beams(plates(21.0), UnsteadyLoads.from_polar(POLAR), INCIDENCE, 100.0)
    late = history.time > 50.0
    torsion = np.abs(history.torsion_amplitudes[late, 0]).mean(axis=0)
    bending = np.abs(history.bending_amplitudes[late, 0]).mean(axis=0)
    assert (torsion[1:] < 0.06 * torsion[0]).all()
    assert (torsion[2:] < 0.01 * torsion[0]).all()
    assert (bending[1:] < 0.03 * bending[0]).all()


def test_more_strips_do_not_move_the_onset():
    """Growth rates at k* = 5 and 10 with 12 and 24 strips."""
    growth = [
        least_stable_eigenvalue(
            beam_system(
                plates(np.array([5.0, 10.0]), strips=strips),
                UnsteadyLoads.from_polar(POLAR),
                INCIDENCE,
            )
        ).real
        for strips in (12, 24)
    ]
    np.testing.assert_allclose(growth[0], growth[1], atol=5e-4)


def test_the_beam_decays_at_high_and_flutters_at_low_stiffness():
    loads = UnsteadyLoads.from_polar(POLAR)
    growth = least_stable_eigenvalue(
        beam_system(plates(np.array([4.0, 21.0])), loads, INCIDENCE)
    ).real
    assert growth[0] > 0.01
    assert growth[1] < 0.0


@pytest.mark.parametrize(("induced", "onset"), [(True, 6.80), (False, 9.47)])
def test_onset_of_the_beam(induced, onset):
    """With and without induced incidence: docs/embedded.md on the worth of the first."""

    def growth(k_star: float) -> float:
        parameters = plates(k_star, induced=induced)
        loads = UnsteadyLoads.from_polar(POLAR)
        return float(least_stable_eigenvalue(beam_system(parameters, loads, INCIDENCE))[0].real)

    assert brentq(growth, 4.0, 21.0, xtol=1e-3) == pytest.approx(onset, rel=0.02)


def test_without_lag_of_the_bubble_the_beam_does_not_flutter():
    loads = UnsteadyLoads.from_polar(POLAR, SeparationLags.none())
    k_star = np.linspace(3.0, 30.0, 20)
    growth = least_stable_eigenvalue(beam_system(plates(k_star), loads, INCIDENCE)).real
    assert (growth < 0.0).all()
