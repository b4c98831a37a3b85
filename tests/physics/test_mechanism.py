"""Mechanisms of instability: by limits in which each is the only one there is."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from equisection.aerodynamics.indicial import IMMEDIATE_SHARE, JONES_AMPLITUDES, LAG_RATES
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.exact_roots import GrowingMotion
from equisection.motion.linear_flutter import flutter
from equisection.motion.mechanism import (
    Instabilities,
    Mechanism,
    influence_of,
    instabilities,
    least_stable_instabilities,
)
from equisection.motion.sections import section_system
from equisection.motion.stability import critical_speed
from equisection.motion.static_branch import StaticBranch, section_equilibrium
from equisection.motion.steady_states import equilibrium, jacobian
from equisection.validation.flutter_values import deck

PLATE_POLAR = Polar.read(Path(__file__).parents[2] / "config/polars/plate_2d_11136.csv")
THIN = Polar.flat_plate(10.0)
ATTACHED = SeparationLags.none()
DENSITY = 1.225

#: A section in pitch and plunge like a plate of plastic, 0.1 m wide.
PLATE = Section(
    torsional_stiffness=4.7, flexural_stiffness=470.0, inertia=4e-4, mass=0.472, chord=0.1
)
#: Square prism: c_l' + c_d = -2.69 (Parkinson and Smith, Q. J. Mech. Appl. Math. 17, 1964).
ALPHA = np.radians(np.linspace(-10.0, 10.0, 41))


def prism(den_hartog: float) -> Polar:
    """A bluff polar with c_d = 2 and a sum c_l' + c_d."""
    return Polar(ALPHA, np.full(41, 2.0), (den_hartog - 2.0) * ALPHA, np.zeros(41), "prism")


def galloping_section(mass: float = 1e4) -> Section:
    """A heavy section that heaves at 1 Hz with 1 % of damping, and hardly twists."""
    return Section(
        torsional_stiffness=1e6 * mass * math.tau**2,
        flexural_stiffness=mass * math.tau**2,
        inertia=mass,
        mass=mass,
        flexural_damping=0.02 * mass * math.tau,
    )


def told(
    section: Section,
    polar: Polar,
    speed: float,
    *,
    incidence_deg: float = 0.0,
    lags: SeparationLags = ATTACHED,
    density: float = DENSITY,
) -> tuple[complex, Instabilities]:
    """Eigenvalue and mechanism of a section at a speed, about its equilibrium from rest."""
    rigid = math.radians(incidence_deg)
    branch = StaticBranch.from_rest(polar, rigid, section.axis_behind_mid_chord)
    alpha = branch.incidence([section.k_star(density, speed)])
    system = section_system(
        [section.in_flow(density, speed)], UnsteadyLoads.from_polar(polar, lags), rigid
    )
    p, found = least_stable_instabilities(system, *section_equilibrium(system, alpha))
    return complex(p[0]), found


@pytest.mark.parametrize(("den_hartog", "expected"), [(-2.69, "galloping"), (2.69, "none")])
def test_square_prism_gallops_where_lift_falls_faster_than_drag(den_hartog, expected):
    section = galloping_section()
    speed = 1.2 * 4.0 * section.mass * 0.01 * math.tau / (DENSITY * 2.69)
    p, found = told(section, prism(den_hartog), speed)
    assert found.mechanism[0] == expected
    if expected == "galloping":
        assert found.heave_share[0] == pytest.approx(1.0, abs=1e-3)
        assert p.imag * speed == pytest.approx(math.tau, rel=1e-3)


@pytest.mark.parametrize("slope", [-2.69, 1.0])
def test_slow_heave_is_damped_by_lift_slope_and_drag(slope):
    """Q_ww tends to -p (c_l' + c_d): Den Hartog."""
    system = section_system(
        [galloping_section(10.0).in_flow(DENSITY, 5.0)],
        UnsteadyLoads.from_polar(prism(slope), ATTACHED),
        0.0,
    )
    linear = jacobian(system, *equilibrium(system))
    errors = []
    for rate in (1e-2, 1e-3):
        p = np.array([1j * rate])
        errors.append(abs(influence_of(system, linear)(p)[0, 0, 0] / p[0] + slope))
    assert errors[1] < 0.2 * errors[0] < 0.1


def test_deck_of_a_bridge_flutters_by_coupling():
    """The air damps heave and twist of a flat plate alone: H_1* and A_2* are negative."""
    p, found = told(deck(0.003), THIN, 80.0, density=1.22)
    assert p.real > 0.0
    assert found.mechanism[0] == Mechanism.FLUTTER
    assert found.coupling_share[0] == 1.0
    assert 0.1 < p.imag * 80.0 / 31.0 / math.tau < 0.278


def test_power_is_what_the_motion_gains():
    """P_w + P_t + P_c = sigma |p q|^2 M + sigma k |q|^2 + c |p q|^2, at any stage of growth."""
    section = deck(0.003).in_flow(1.22, 85.0)
    system = section_system([section], UnsteadyLoads.from_polar(THIN, ATTACHED), 0.0)
    linear = jacobian(system, *equilibrium(system))
    values, vectors = np.linalg.eig(linear[0])
    place = int(np.argmax(np.where(values.imag > 0.0, values.real, -np.inf)))
    p, vector = values[place], vectors[:, place]
    motion = np.array([vector[system.layout.deflection], vector[system.layout.twist]])[:, 0]
    loads = influence_of(system, linear)(np.array([p]))[0]
    power = 0.5 * np.real(np.conj(p * motion) @ loads @ motion)
    air = ThinAirfoil(0.0).apparent_mass
    rate = p * motion
    gained = 0.5 * p.real * np.real(
        np.conj(rate) @ (section.mass_matrix + air) @ rate
        + np.conj(motion) @ section.stiffness_matrix @ motion
    ) + 0.5 * np.real(np.conj(rate) @ section.damping_matrix @ rate)
    assert power == pytest.approx(gained, rel=1e-9)


def test_loads_of_the_strips_are_those_of_theory():
    """Theodorsen's about mid-chord without apparent mass, C(k) by the two states of Jones."""
    section = deck(0.0).in_flow(1.22, 60.0)
    system = section_system([section], UnsteadyLoads.from_polar(THIN, ATTACHED), 0.0)
    p = np.array([0.01 + 0.4j])
    loads = influence_of(system, jacobian(system, *equilibrium(system)))(p)[0]
    lagging = sum(a / (1.0 + p[0] / b) for a, b in zip(JONES_AMPLITUDES, LAG_RATES, strict=True))
    rear = np.array([-p[0], 1.0 + 0.25 * p[0]])
    effective = (IMMEDIATE_SHARE + lagging) * rear
    rate = np.array([0.0, p[0]])
    lift = 2.0 * math.pi * effective + 0.5 * math.pi * rate
    moment = 0.5 * math.pi * (effective - 0.25 * rate)
    np.testing.assert_allclose(loads, [lift, moment], rtol=1e-9, atol=1e-11)


def test_exact_theory_tells_the_same():
    """Loads by the function of Theodorsen in the place of Jones's states."""
    section = deck(0.0)
    neutral = flutter(section.in_flow(1.22, 60.0))
    assert neutral is not None
    equations = GrowingMotion.of_section(section.in_flow(1.22, 60.0))
    p = complex(equations.root(0.99 * neutral.scale, 1j * neutral.omega))
    motion = np.linalg.svd(equations.matrix(p, 0.99 * neutral.scale))[2][-1].conj()[None]
    found = instabilities(
        np.array([p]),
        motion[:, :1],
        motion[:, 1:],
        lambda values: np.array([equations.influence(complex(value)) for value in values]),
    )
    assert found.mechanism[0] == Mechanism.FLUTTER
    _, by_strips = told(section, THIN, 60.0 / math.sqrt(0.98 * neutral.scale), density=1.22)
    assert found.heave_phase_deg[0] == pytest.approx(by_strips.heave_phase_deg[0], abs=3.0)


def stiff_in_bending() -> Section:
    return PLATE.model_copy(update={"flexural_stiffness": 1e5 * PLATE.flexural_stiffness})


def test_plate_that_cannot_heave_flutters_in_stall_alone():
    """Pitch alone: attached flow damps it about mid-chord, a bubble that lags drives it."""
    section = stiff_in_bending()
    onset = critical_speed(
        section, PLATE_POLAR, incidence_deg=4.0, speed=(5.0, 60.0), lags=IDENTIFIED_LAGS
    )
    speed = 1.01 * float(onset["critical_speed"])
    p, found = told(section, PLATE_POLAR, speed, incidence_deg=4.0, lags=IDENTIFIED_LAGS)
    assert p.real > 0.0
    assert found.mechanism[0] == Mechanism.STALL_FLUTTER
    assert found.twist_share[0] > 0.999
    torsion = math.sqrt(section.torsional_stiffness / section.inertia)
    assert p.imag * speed / 0.1 == pytest.approx(torsion, rel=0.1)


def test_thin_plate_that_cannot_heave_diverges():
    section = stiff_in_bending()
    speed = math.sqrt(2.0 * section.torsional_stiffness / (DENSITY * 0.01 * math.pi / 2))
    assert told(section, THIN, 1.01 * speed)[1].mechanism[0] == Mechanism.DIVERGENCE
    assert told(section, THIN, 0.99 * speed)[1].mechanism[0] == Mechanism.NONE


def test_scale_and_phase_of_the_eigenvector_do_not_matter():
    section = deck(0.0).in_flow(1.22, 85.0)
    system = section_system([section], UnsteadyLoads.from_polar(THIN, ATTACHED), 0.0)
    influence = influence_of(system, jacobian(system, *equilibrium(system)))
    heave, twist = np.array([[-0.3 - 0.5j]]), np.array([[1.0 + 0.0j]])
    p = np.array([0.02 + 0.4j])
    one = instabilities(p, heave, twist, influence)
    other = instabilities(p, heave * 7j, twist * 7j, influence)
    assert one.coupling_share[0] == 1.0
    for name in ("heave_share", "twist_share", "coupling_share", "heave_phase_deg"):
        np.testing.assert_allclose(getattr(other, name), getattr(one, name), rtol=1e-12)
    assert other.mechanism[0] == one.mechanism[0]


def test_what_has_no_eigenvalue_is_unknown():
    nothing = np.array([[complex(math.nan, math.nan)]])
    found = instabilities(nothing[0], nothing, nothing, lambda p: np.zeros((1, 2, 2)) + 0j * p)
    assert found.mechanism[0] == Mechanism.UNKNOWN
    assert np.isnan(found.coupling_share[0])
