"""Wind that a moving section meets: galloping, heave damping, and the limits without it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import Branches, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.velocity_triangle import force_across, pressure_rise
from equisection.beam.section import Section
from equisection.motion.march import march
from equisection.motion.sections import section_system
from equisection.motion.stability import critical_speed
from equisection.motion.steady_states import equilibrium, jacobian, release_state

#: A square prism at small incidence: c_y rises by A_1 with the rate, and c_d is 2
#: (Parkinson and Smith, Q. J. Mech. Appl. Math. 17, 1964, have A_1 = 2.69).
A_1, DRAG = 2.69, 2.0
RATE, DENSITY = math.tau, 1.225
ALPHA = np.radians(np.linspace(-10.0, 10.0, 41))
PRISM = Polar(ALPHA, np.full(41, DRAG), -(A_1 + DRAG) * ALPHA, np.zeros(41), "prism")
DRAGLESS = Polar(ALPHA, np.zeros(41), PRISM.lift, PRISM.moment, "prism without drag")
NONE = SeparationLags.none()


def prism(mass: float, ratio: float = 0.01) -> Section:
    """A section of chord 1 m that heaves at 1 Hz and hardly twists."""
    return Section(
        torsional_stiffness=1e6 * mass * RATE**2,
        flexural_stiffness=mass * RATE**2,
        inertia=mass,
        mass=mass,
        flexural_damping=2.0 * ratio * mass * RATE,
        torsional_damping=2.0 * ratio * mass * 1e3 * RATE,
    )


def galloping_speed(mass: float, slope: float) -> float:
    """V_g = 4 m zeta omega/(rho c slope) (m/s), quasi-steady (Den Hartog)."""
    return 4.0 * mass * 0.01 * RATE / (DENSITY * slope)


def test_closed_form_of_the_prism():
    assert galloping_speed(10.0, A_1) == pytest.approx(0.76270, abs=3e-5)
    assert galloping_speed(10.0, A_1 + DRAG) == pytest.approx(0.43744, abs=3e-5)


@pytest.mark.parametrize(("polar", "slope"), [(PRISM, A_1), (DRAGLESS, A_1 + DRAG)])
def test_galloping_tends_to_the_quasi_steady_speed(polar, slope):
    """The heavier the body, the slower its heave beside the wind: lags and air's mass vanish."""
    errors = []
    for mass in (1e4, 1e5, 1e6):
        known = galloping_speed(mass, slope)
        onset = critical_speed(
            prism(mass),
            polar,
            incidence_deg=0.0,
            speed=(0.9 * known, 1.2 * known),
            density=DENSITY,
            lags=NONE,
        )
        assert float(onset["frequency"]) == pytest.approx(1.0, rel=2e-3)
        errors.append(abs(float(onset["critical_speed"]) / known - 1.0))
    assert errors[2] < 1e-4
    assert errors[1] < 0.2 * errors[0]
    assert errors[2] < 0.2 * errors[1]


def test_march_gallops_where_the_eigenvalue_does():
    """The heave of a march grows at the closed form's rate on either side of the onset."""
    mass = 1e7
    known = galloping_speed(mass, A_1)
    for speed in (0.8 * known, 1.2 * known):
        section = prism(mass).in_flow(DENSITY, speed)
        system = section_system([section], UnsteadyLoads.from_polar(PRISM, NONE), 0.0)
        outputs = np.eye(system.layout.size, system.rates.shape[2])[None, [2, 3]]
        omega = math.sqrt(section.flexural_stiffness / section.mass)
        period = math.tau / omega
        recording = march(
            system,
            release_state(system, heave_rate=1e-4),
            outputs,
            duration=5.0 * period,
            time_step=period / 200,
            output_interval=period / 40,
        )
        w, rate = recording.values[:, 0].T
        energy = (omega * w) ** 2 + rate**2
        growth = math.log(energy[-1] / energy[0]) / (2.0 * recording.time[-1])
        expected = 0.5 * (A_1 - section.flexural_damping) / section.mass
        assert (growth > 0.0) == (speed > known)
        assert growth == pytest.approx(expected, rel=2e-3)


def test_turned_force_is_that_of_the_rotated_wind():
    rate = np.linspace(-0.6, 0.6, 13)
    lift, drag = 0.7 * np.ones(13), 0.4 * np.ones(13)
    phi = np.arctan(rate)
    turned = (1.0 + rate**2) * (lift * np.cos(phi) - drag * np.sin(phi))
    np.testing.assert_allclose(force_across(lift, drag, rate), turned, rtol=1e-14)
    np.testing.assert_allclose(np.sqrt(1.0 + pressure_rise(rate)) * np.cos(phi), 1.0, rtol=1e-14)


@pytest.mark.parametrize("incidence_deg", [0.0, 2.0, -4.0])
@pytest.mark.parametrize("axis", [0.5, 0.33])
def test_drag_adds_its_own_size_to_the_damping_of_heave(incidence_deg, axis):
    """d c_y/d w' = -(c_l' + c_d): with drag the heave row of J changes by -c_d(alpha) alone."""
    polars = (
        Polar(ALPHA, 0.1 + 2.0 * ALPHA**2, 5.0 * ALPHA, 1.2 * ALPHA, "with drag"),
        Polar(ALPHA, np.zeros(41), 5.0 * ALPHA, 1.2 * ALPHA, "without"),
    )
    section = Section(
        torsional_stiffness=50.0, flexural_stiffness=4.0, inertia=6.0, mass=60.0, elastic_axis=axis
    )
    rows, at = [], 0.0
    for polar in polars:
        loads = UnsteadyLoads.from_polar(polar, NONE)
        system = section_system([section], loads, math.radians(incidence_deg))
        states, deficits = equilibrium(system)
        if polar is polars[0]:
            at = math.radians(incidence_deg) + float(states[0, 0])
        linear = jacobian(system, states, deficits)[0]
        x = axis - 0.5
        mass = np.array(
            [
                [6.0 + math.pi / 64 + math.pi / 2 * x**2, math.pi / 2 * x],
                [math.pi / 2 * x, 60.0 + math.pi / 2],
            ]
        )
        rows.append(mass @ linear[[1, 3]])
    change = rows[0][1] - rows[1][1]
    drag = float(polars[0].drag_coefficient(at))
    assert change[3] == pytest.approx(-drag, rel=1e-5)  # of w'
    assert change[1] == pytest.approx(drag * (0.25 - x), rel=1e-5)  # of theta', at 3/4 chord


def test_point_of_the_incidence_decides_pitch_damping_alone():
    """At rest and in heave it is nothing; in pitch the incidence is that of the point."""
    section = Section(torsional_stiffness=50.0, flexural_stiffness=4.0, inertia=6.0, mass=60.0)
    branches = Branches.from_polar(PRISM)
    systems = [
        section_system([section], UnsteadyLoads(branches, NONE, point), math.radians(2.0))
        for point in (0.0, 0.25)
    ]
    at_rest = [equilibrium(system) for system in systems]
    np.testing.assert_allclose(at_rest[0][0], at_rest[1][0], atol=1e-15)
    linear = [jacobian(system, *state)[0] for system, state in zip(systems, at_rest, strict=True)]
    same = [0, 2, 3, *range(4, linear[0].shape[0])]
    np.testing.assert_allclose(linear[0][:, same], linear[1][:, same], atol=1e-9)
    arm = 0.25 * branches.lift_slope * 0.5  # half of the lift is immediate (Jones)
    mass = 60.0 + math.pi / 2
    assert mass * (linear[1][3, 1] - linear[0][3, 1]) == pytest.approx(arm + 0.25 * DRAG, rel=1e-6)
