"""Sections in the time loop: vacuum, statics, divergence, flutter, convergence, batches."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq
from tests.sample_cases import sections

from equisection.aerodynamics.indicial import JONES_AMPLITUDES, LAG_RATES, wagner
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.unsteady_loads import (
    APPARENT_INERTIA,
    APPARENT_MASS,
    UnsteadyLoads,
)
from equisection.beam.section import Section
from equisection.errors import EquisectionError
from equisection.motion.march import march
from equisection.motion.sections import (
    release_sections,
    section_system,
)
from equisection.motion.steady_states import (
    equilibrium,
    jacobian,
    least_stable_eigenvalue,
    rigid_state,
)
from equisection.verdict import Criteria, assess, heave_grows
from equisection.verdict.cycles import find_cycles

POLARS = Path(__file__).parents[2] / "config/polars"
POLAR = Polar.read(POLARS / "plate_2d_11136.csv")
INCIDENCE = math.radians(2.5)
INERTIA, MASS_RATIO, STIFFNESS_RATIO = 6.67, 9.12, 0.183  # the paper's plate, A_theta,w in both


def plate_sections(k_star: object) -> list[Section]:
    return sections(k_star, INERTIA, MASS_RATIO, STIFFNESS_RATIO)


def measured(lags: SeparationLags | None = None) -> UnsteadyLoads:
    return (
        UnsteadyLoads.from_polar(POLAR) if lags is None else UnsteadyLoads.from_polar(POLAR, lags)
    )


def thin_plate() -> UnsteadyLoads:
    return UnsteadyLoads.from_polar(Polar.flat_plate(10.0), SeparationLags.none())


def cycle_amplitudes(history, lane: int) -> np.ndarray:
    valid = slice(0, int(history.samples[lane]))
    return find_cycles(history.time[valid], history.twist[valid, lane]).amplitude


def test_in_vacuo_the_energy_is_kept_and_the_frequencies_are_right():
    """Inertias 1e10 times the plate's: the air is nothing to it."""
    heavy = sections(20e10, INERTIA * 1e10, MASS_RATIO, STIFFNESS_RATIO)
    system = section_system(heavy, thin_plate(), 0.0)
    states, deficits = rigid_state(system)
    states[0, :4] = 0.1, 0.0, 0.2, 0.0
    rows = np.eye(4, system.rates.shape[2])[None]
    run = march(
        system, (states, deficits), rows, duration=500.0, time_step=0.25, output_interval=0.25
    )
    twist, twist_rate, deflection, deflection_rate = run.values[:, 0].T
    pitch_energy = 0.5 * (INERTIA * twist_rate**2 + 20 * twist**2)
    heave_energy = 0.5 * (
        INERTIA * MASS_RATIO * deflection_rate**2 + 20 * STIFFNESS_RATIO * deflection**2
    )
    np.testing.assert_allclose(pitch_energy, pitch_energy[0], rtol=1e-7)
    np.testing.assert_allclose(heave_energy, heave_energy[0], rtol=1e-7)
    np.testing.assert_allclose(twist, 0.1 * np.cos(math.sqrt(20 / INERTIA) * run.time), atol=1e-7)
    omega_heave = math.sqrt(20 * STIFFNESS_RATIO / (INERTIA * MASS_RATIO))
    np.testing.assert_allclose(deflection, 0.2 * np.cos(omega_heave * run.time), atol=1e-7)


def in_vacuo(section: Section) -> np.ndarray:
    """Return the eigenvalues p (per c/V, Im p > 0) of a section too heavy for the air."""
    names = ("torsional_stiffness", "flexural_stiffness", "inertia", "mass", "static_imbalance")
    dampings = ("torsional_damping", "flexural_damping")
    heavier = {name: 1e9 * getattr(section, name) for name in (*names, *dampings)}
    system = section_system([Section(**{**dict(section), **heavier})], thin_plate(), 0.0)
    values = np.linalg.eigvals(jacobian(system, *equilibrium(system))[0])
    return np.sort_complex(values[values.imag > 1e-3])


@pytest.mark.parametrize("imbalance", [0.0, 4.0, -12.0])
def test_in_vacuo_imbalance_couples_and_dampers_damp(imbalance):
    """det(p^2 M + p C + K) = 0; without dampers p = i omega of the coupled section."""
    (plain,) = plate_sections(20.0)
    free = Section(**{**dict(plain), "static_imbalance": imbalance})
    p = in_vacuo(free)
    np.testing.assert_allclose(np.sort(p.imag), free.natural_frequencies, rtol=1e-7)
    np.testing.assert_allclose(p.real, 0.0, atol=1e-7)
    damped = Section(**{**dict(free), "torsional_damping": 0.7, "flexural_damping": 2.0})
    for root in in_vacuo(damped):
        matrix = damped.stiffness_matrix + root * damped.damping_matrix
        matrix = matrix + root**2 * damped.mass_matrix
        assert abs(np.linalg.det(matrix)) < 1e-6 * np.linalg.det(damped.stiffness_matrix)
        assert root.real < -0.01


def test_imbalance_and_dampers_leave_the_static_twist():
    (plain,) = plate_sections(10.0)
    more = {"static_imbalance": 5.0, "torsional_damping": 0.3, "flexural_damping": 1.0}
    both = [plain, Section(**{**dict(plain), **more})]
    states, _ = equilibrium(section_system(both, measured(), INCIDENCE))
    np.testing.assert_allclose(states[1], states[0], rtol=1e-9, atol=1e-12)


def theodorsen_with_jones(p: complex) -> np.ndarray:
    """Return Q(p) of a thin plate about mid-chord, with Jones' C (NACA Report 496, a = 0)."""
    lag = 1.0 - sum(a * p / (p + rate) for a, rate in zip(JONES_AMPLITUDES, LAG_RATES, strict=True))
    circulatory = np.outer([2 * math.pi, math.pi / 2], [-p, 1.0 + p / 4])
    mass = -math.pi / 2 * np.array([[1.0, 0.0], [0.0, 1.0 / 32.0]]) * p**2
    rate = math.pi / 2 * np.array([[0.0, 1.0], [0.0, -0.25]]) * p
    return mass + rate + lag * circulatory


@pytest.mark.parametrize("imbalance", [0.0, 6.0, -6.0])
@pytest.mark.parametrize("damping", [0.0, 0.5])
def test_section_with_imbalance_and_dampers_in_thin_plate_theory(imbalance, damping):
    """Its eigenvalues solve det(p^2 M + p C + K - Q(p)) = 0 of (w/c, theta)."""
    (plain,) = plate_sections(6.0)
    section = Section(
        **{
            **dict(plain),
            "static_imbalance": imbalance,
            "torsional_damping": damping,
            "flexural_damping": 3 * damping,
        }
    )
    system = section_system([section], thin_plate(), 0.0)
    values = np.linalg.eigvals(jacobian(system, *equilibrium(system))[0])
    oscillating = values[values.imag > 1e-6]
    assert oscillating.size == 2
    for p in oscillating:
        left = section.stiffness_matrix + p * section.damping_matrix
        left = left + p**2 * section.mass_matrix - theodorsen_with_jones(p)
        assert abs(np.linalg.det(left)) < 1e-8 * np.abs(left).max() ** 2


@pytest.mark.parametrize(
    ("damping_ratio", "onset", "onset_of_paper"),
    [
        (0.0, 8.710, 9.094),
        (0.003, 8.039, 8.389),
        (0.005, 7.685, 8.011),
        (0.01, 6.999, 7.283),
        (0.02, 6.095, 6.329),
    ],
)
def test_dampers_lower_the_onset_of_the_papers_section(damping_ratio, onset, onset_of_paper):
    """First k* of growth from above at 2.5 deg, by a code of its own with the same loads and lags.

    Ratios c^2 m/I and c^2 k_w/k_theta of the consistent section in closed form, and the paper's.
    """
    loads = measured(SeparationLags(2.58, 0.64, 0.55))
    for ratios, expected in (((12.0, 0.247), onset), ((9.12, 0.183), onset_of_paper)):
        (plain,) = sections(1.0, 20 / 3, *ratios)
        pair = {
            "torsional_damping": 2 * damping_ratio * math.sqrt(plain.inertia),
            "flexural_damping": 2
            * damping_ratio
            * math.sqrt(plain.mass * plain.flexural_stiffness),
        }
        section = Section(**{**dict(plain), **pair})

        def growth(k_star: float, section: Section = section) -> float:
            system = section_system([section.scaled(k_star)], loads, INCIDENCE)
            return float(least_stable_eigenvalue(system)[0].real)

        assert brentq(growth, 5.5, 12.0, xtol=1e-4) == pytest.approx(expected, abs=2e-3)


def offset(section: Section, axis: float, imbalance: float = 0.0) -> Section:
    return Section(**{**dict(section), "elastic_axis": axis, "static_imbalance": imbalance})


@pytest.mark.parametrize("axis", [0.25, 0.33, 0.5, 0.66])
@pytest.mark.parametrize("imbalance", [0.0, 6.0, -6.0])
def test_section_with_its_axis_anywhere_in_thin_plate_theory(axis, imbalance):
    """det(p^2 M + p C + K - Q(p)) = 0 with Theodorsen's loads about the axis (a = 2 x_ea)."""
    x = axis - 0.5
    (plain,) = plate_sections(6.0)
    section = offset(plain, axis, imbalance)
    section = Section(**{**dict(section), "torsional_damping": 0.4, "flexural_damping": 1.0})
    values = np.linalg.eigvals(
        jacobian(s := section_system([section], thin_plate(), 0.0), *equilibrium(s))[0]
    )
    oscillating = values[values.imag > 1e-6]
    assert oscillating.size == 2
    for p in oscillating:
        lag = 1.0 - sum(
            a * p / (p + rate) for a, rate in zip(JONES_AMPLITUDES, LAG_RATES, strict=True)
        )
        loads = 2 * math.pi * lag * np.outer([1.0, 0.25 + x], [-p, 1.0 + (0.25 - x) * p])
        loads = loads - math.pi / 2 * p**2 * np.array([[1.0, x], [x, 1.0 / 32.0 + x * x]])
        loads = loads + math.pi / 2 * p * np.array([[0.0, 1.0], [0.0, x - 0.25]])
        left = section.stiffness_matrix + p * section.damping_matrix
        left = left + p**2 * section.mass_matrix - loads
        assert abs(np.linalg.det(left)) < 1e-8 * np.abs(left).max() ** 2


def test_motion_described_from_another_axis_has_the_same_flow():
    """Mid-chord moves by w + x_ea theta, and with it all that is not of the structure."""
    (plain,) = plate_sections(8.0)
    system = section_system([plain], measured(), INCIDENCE)
    moved = section_system([offset(plain, 0.3)], measured(), INCIDENCE)
    layout = system.layout
    rng = np.random.default_rng(1)
    states = 0.02 * rng.standard_normal((1, layout.size))
    # of lift, of moment, the normal force, the lift that lags, the turn
    deficits = 0.01 * rng.standard_normal((1, 5))
    x = -0.2
    # mid-chord moves by w_m = w + x theta, and everything else of the flow is the same
    there = states.copy()
    there[:, 2] -= x * states[:, 0]
    there[:, 3] -= x * states[:, 1]
    here = np.concatenate([states, deficits[:, [0, 1, 3, 4]], np.ones((1, 1))], axis=1)
    seen = np.concatenate([there, deficits, np.ones((1, 1))], axis=1)
    for rows, others in ((system.probe, moved.probe), (system.rates[:, 4:], moved.rates[:, 4:])):
        np.testing.assert_allclose(rows[0] @ here[0], others[0] @ seen[0], rtol=1e-12, atol=1e-14)


def test_factor_of_the_loads_is_its_inverse_on_mass_spring_and_damper():
    """Eq. 20 the other way round, where nothing couples the rows but the air."""
    (plain,) = plate_sections(8.0)
    lift, moment = 0.7, 0.8
    members = {"lift": ("mass", "flexural_stiffness"), "moment": ("inertia", "torsional_stiffness")}
    factors = {"lift": lift, "moment": moment}
    corrected = {
        name: getattr(plain, name) / factors[load] for load in members for name in members[load]
    }
    scaled = section_system([Section(**{**dict(plain), **corrected})], measured(), INCIDENCE)
    loaded = section_system([plain], measured(), INCIDENCE, np.array([[lift, moment]]))
    np.testing.assert_allclose(loaded.rates, scaled.rates, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(loaded.strip_loads, scaled.strip_loads, rtol=1e-12, atol=1e-13)


def test_sections_with_other_axes_run_together():
    (plain,) = plate_sections(8.0)
    mixed = [plain, offset(plain, 0.33, 3.0), offset(plain, 0.6)]
    together = release_sections(mixed, measured(), INCIDENCE, 40.0)
    for lane, section in enumerate(mixed):
        alone = release_sections([section], measured(), INCIDENCE, 40.0)
        np.testing.assert_allclose(together.twist[:, lane], alone.twist[:, 0], rtol=0, atol=1e-11)
        np.testing.assert_allclose(
            together.moment_coefficient[:, lane], alone.moment_coefficient[:, 0], atol=1e-9
        )
        about = together.axis_moment_coefficient[:, lane]
        if section is plain:
            np.testing.assert_allclose(about, together.moment_coefficient[:, 0])
            assert alone.axis_moment_coefficient is None


def test_work_of_the_moment_about_the_axis_is_the_energy_of_the_section():
    """The loads that are recorded are those that move it: energy rises by their work."""
    (plain,) = plate_sections(6.0)
    section = offset(plain, 0.35, 4.0)
    history = release_sections(
        [section], measured(), INCIDENCE, 60.0, time_step=0.005, output_interval=0.01
    )
    w, w_rate, twist, rate = (
        getattr(history, name)[:, 0]
        for name in ("deflection", "deflection_rate", "twist", "twist_rate")
    )
    moved, motion = np.stack([w, twist]), np.stack([w_rate, rate])
    energy = 0.5 * np.einsum("in,ij,jn->n", motion, section.mass_matrix, motion)
    energy += 0.5 * np.einsum("in,ij,jn->n", moved, section.stiffness_matrix, moved)
    power = history.lift_coefficient[:, 0] * w_rate + history.axis_moment_coefficient[:, 0] * rate
    work = cumulative_trapezoid(power, history.time, initial=0.0)
    np.testing.assert_allclose(energy, work, atol=1e-4 * energy.max())


def test_section_in_si_units_is_refused():
    (plain,) = plate_sections(10.0)
    with pytest.raises(EquisectionError, match=r"section\.in_flow"):
        section_system([Section(**{**dict(plain), "chord": 0.1})], thin_plate(), 0.0)


def test_a_wing_started_from_rest_builds_its_lift_up_as_wagner_says():
    stiff = sections(1e9, 1e9, 1.0, 1.0)
    system = section_system(stiff, thin_plate(), 0.1)
    run = march(
        system,
        (np.zeros((1, system.layout.size)), np.zeros((1, 2))),
        system.strip_loads,
        duration=50.0,
        time_step=0.1,
        output_interval=0.1,
    )
    np.testing.assert_allclose(run.values[:, 0, 0], 2 * math.pi * 0.1 * wagner(run.time), rtol=1e-6)
    np.testing.assert_allclose(run.values[:, 0, 1], run.values[:, 0, 0] / 4, rtol=1e-6)


def test_static_twist_of_a_thin_plate():
    """k* theta = (pi/2)(theta_0 + theta), k_w* w/c = 2 pi (theta_0 + theta)."""
    k_star = np.array([3.0, 10.0, 21.0])
    states, _ = equilibrium(section_system(plate_sections(k_star), thin_plate(), 0.02))
    twist = 0.5 * math.pi * 0.02 / (k_star - 0.5 * math.pi)
    np.testing.assert_allclose(states[:, 0], twist, rtol=1e-10)
    deflection = 2 * math.pi * (0.02 + twist) / (k_star * STIFFNESS_RATIO)
    np.testing.assert_allclose(states[:, 2], deflection, rtol=1e-10)


def test_static_divergence_at_the_slope_of_the_moment():
    """Bisplinghoff, Ashley & Halfman, chapter 8: k* = dc_m/dtheta, pi/2 for a thin plate."""

    def growth(k_star: float) -> float:
        system = section_system(plate_sections(k_star), thin_plate(), 0.0)
        values = np.linalg.eigvals(jacobian(system, *equilibrium(system))[0])
        return float(values[values.imag == 0.0].real.max())

    assert brentq(growth, 1.4, 1.7) == pytest.approx(math.pi / 2, rel=1e-6)


def test_flutter_of_the_textbook_section():
    """Hodges & Pierce, Introduction to Structural Dynamics and Aeroelasticity, section 5.5.

    a = -1/5, e = -1/10, mu = 20, r^2 = 6/25, sigma = 2/5: Theodorsen's theory gives flutter at
    U/(b omega_theta) = 2.165. The pitch axis of that section is not mid-chord, so its structure
    is coupled here in the test and takes nothing but the air from the package.
    """
    mass = 20 * math.pi / 2
    axis, centre = -0.2 / 2, -0.1 / 2  # chords behind mid-chord
    inertia_axis = mass * (6 / 25) / 4
    inertia_centre = inertia_axis - mass * (centre - axis) ** 2
    held = sections(1.0, 1e12, 1.0, 1.0)  # loads without accelerations
    system = section_system(held, thin_plate(), 0.0)
    n = system.layout.size
    loads = np.stack([system.strip_loads[0, 1, :n], system.strip_loads[0, 0, :n]])  # c_m, c_l
    structure_mass = np.array(
        [[inertia_centre + mass * centre**2, -mass * centre], [-mass * centre, mass]]
    )
    apparent = np.diag([APPARENT_INERTIA, APPARENT_MASS])

    def growth(speed: float) -> float:
        pitch = inertia_axis * (2 / speed) ** 2
        heave = mass * (0.4 * 2 / speed) ** 2
        stiffness = np.array([[pitch + heave * axis**2, -heave * axis], [-heave * axis, heave]])
        matrix = system.rates[0, :, :n].copy()
        force = loads.copy()
        force[:, 0] -= stiffness[:, 0]
        force[:, 2] -= stiffness[:, 1]
        matrix[[1, 3]] = np.linalg.solve(structure_mass + apparent, force)
        return float(np.linalg.eigvals(matrix).real.max())

    assert brentq(growth, 1.5, 2.6) == pytest.approx(2.165, rel=0.01)


def test_steady_equilibrium_is_where_a_damped_section_ends():
    given = plate_sections([10.0, 21.0])
    loads, incidence = measured(SeparationLags.none()), math.radians(1.0)
    states, _ = equilibrium(section_system(given, loads, incidence))
    history = release_sections(given, loads, incidence, 600.0, output_interval=1.0)
    np.testing.assert_allclose(history.twist[-1], states[:, 0], atol=1e-5)
    np.testing.assert_allclose(history.deflection[-1], states[:, 2], atol=1e-4)
    twist = states[:, 0]
    np.testing.assert_allclose(
        np.array([10.0, 21.0]) * twist, POLAR.moment_coefficient(incidence + twist)
    )


def test_second_order_in_the_time_step():
    """Errors of the deficits' interpolation; all else is exact."""
    given = plate_sections([5.0, 10.0])

    def twist(step: float) -> np.ndarray:
        run = release_sections(
            given, measured(), INCIDENCE, 20.0, time_step=step, output_interval=0.4
        )
        return run.twist

    exact = twist(0.4 / 128)
    errors = [np.abs(twist(0.4 / n) - exact).max() for n in (1, 2, 4, 8, 16)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders[-3:].mean() > 1.9
    assert errors[3] < 2e-4 * np.abs(exact).max()  # the default step, 0.05


def test_a_linear_polar_has_no_time_step_error():
    given = plate_sections([5.0, 21.0])
    coarse, fine = (
        release_sections(given, thin_plate(), 0.02, 60.0, time_step=step, output_interval=1.0)
        for step in (1.0, 0.05)
    )
    np.testing.assert_allclose(coarse.twist, fine.twist, atol=1e-9)
    np.testing.assert_allclose(coarse.deflection, fine.deflection, atol=1e-9)


def test_a_very_stiff_section_is_safe_at_a_long_step():
    history = release_sections(
        plate_sections(1e5), measured(), INCIDENCE, 200.0, time_step=1.0, output_interval=1.0
    )
    assert np.abs(history.twist).max() < 2.1 * POLAR.moment_coefficient(0.05) / 1e5


def test_a_batch_gives_what_single_runs_give():
    k_star = np.array([4.0, 6.44, 10.0, 21.0])
    batch = release_sections(plate_sections(k_star), measured(), INCIDENCE, 60.0)
    for lane, value in enumerate(k_star):
        single = release_sections(plate_sections(value), measured(), INCIDENCE, 60.0)
        np.testing.assert_allclose(batch.twist[:, lane], single.twist[:, 0], rtol=0, atol=1e-13)
        np.testing.assert_allclose(
            batch.lift_coefficient[:, lane], single.lift_coefficient[:, 0], rtol=0, atol=1e-12
        )


def test_a_section_that_leaves_the_polar_is_named_and_the_others_go_on():
    history = release_sections(plate_sections([2.6, 21.0]), measured(), INCIDENCE, 150.0)
    (failure,) = history.failures
    assert failure.lane == 0
    assert abs(failure.incidence_rad) > math.radians(12.0)
    last = int(history.samples[0]) - 1
    assert history.time[last] < failure.time <= history.time[last] + 0.1 + 1e-9
    assert np.isfinite(history.twist[: last + 1, 0]).all()
    assert np.isnan(history.twist[last + 1 :, 0]).all()
    assert np.isfinite(history.twist[:, 1]).all()


def test_a_section_that_starts_outside_the_polar_is_named():
    incidence = np.radians([2.5, 13.0])
    history = release_sections(plate_sections([21.0, 21.0]), measured(), incidence, 5.0)
    (failure,) = history.failures
    assert (failure.lane, failure.time) == (1, 0.0)
    assert failure.incidence_rad == pytest.approx(math.radians(13.0))
    assert history.samples.tolist() == [51, 0]


def test_a_monitor_stops_lanes_and_progress_is_told():
    told: list[tuple[float, float]] = []

    def monitor(history, active):
        return active[(history.time[-1] > 20.0) & (active == 1)]

    history = release_sections(
        plate_sections([10.0, 15.0, 21.0]),
        measured(),
        INCIDENCE,
        50.0,
        monitor=monitor,
        progress=lambda done, total: told.append((done, total)),
    )
    assert history.samples.tolist() == [501, 251, 501]
    assert told[0] == (0.0, pytest.approx(50.0))
    assert told[-1][0] == pytest.approx(50.0)
    free = release_sections(plate_sections(21.0), measured(), INCIDENCE, 50.0)
    np.testing.assert_allclose(history.twist[:, 2], free.twist[:, 0], rtol=0, atol=1e-13)


def growth_rates(loads: UnsteadyLoads, incidence_deg: float, k_star: object) -> np.ndarray:
    system = section_system(plate_sections(k_star), loads, math.radians(incidence_deg))
    return least_stable_eigenvalue(system).real


@pytest.mark.parametrize("incidence_deg", [1.0, 2.0, 2.5])
def test_without_lag_of_the_bubble_nothing_flutters(incidence_deg):
    """Below k* of 4 the static equilibrium may be outside the polar."""
    growth = growth_rates(measured(SeparationLags.none()), incidence_deg, np.linspace(4, 40, 60))
    assert (growth < 0.0).all()


@pytest.mark.parametrize("incidence_deg", [3.0, 4.0, 5.0])
def test_falling_moment_alone_makes_little_of_the_flutter(incidence_deg):
    """A polar whose c_m falls has negative damping in quasi-steady flow too, at these angles."""
    alone = growth_rates(measured(SeparationLags.none()), incidence_deg, 4.0)
    assert alone < 0.2 * growth_rates(measured(), incidence_deg, 4.0)


def test_stall_flutter_comes_from_the_polar_and_the_lags():
    """Decay at k* = 21, growth at 6.44 and 5 (as the flow solver shows it), from one release."""
    history = release_sections(plate_sections([21.0, 6.44, 5.0]), measured(), INCIDENCE, 80.0)
    decaying, growing, fast = (cycle_amplitudes(history, lane) for lane in range(3))
    assert decaying[-1] < 0.75 * decaying[0]
    assert growing[-1] > 1.5 * growing[len(growing) // 3]
    assert fast[-1] > 3.0 * fast[len(fast) // 3]


def test_growth_of_a_release_is_that_of_the_linearised_system():
    k_star = 15.0
    eigenvalue = least_stable_eigenvalue(
        section_system(plate_sections(k_star), measured(), INCIDENCE)
    )[0]
    history = release_sections(plate_sections(k_star), measured(), INCIDENCE, 600.0)
    late = history.time > 300.0
    cycles = find_cycles(history.time[late], history.twist[late, 0])
    growth = np.polyfit(cycles.amplitude_time, np.log(cycles.amplitude), 1)[0]
    assert growth == pytest.approx(eigenvalue.real, abs=1e-4)
    assert math.tau / cycles.period(cycles.time.size) == pytest.approx(eigenvalue.imag, rel=2e-3)


def test_section_whose_lift_falls_gallops():
    """Den Hartog: with dc_l/dalpha + c_d < 0 the heave is unstable, however stiff the twist."""
    degrees = np.array([0.0, 3.0, 6.0, 10.0, 14.0, 18.0])
    lift = np.array([0.0, 0.33, 0.60, 0.50, 0.40, 0.30])
    falling = Polar(
        np.radians(degrees),
        np.full(6, 0.04),
        lift,
        np.array([0.0, 0.05, 0.08, 0.08, 0.08, 0.08]),
        "falling",
    ).mirrored()
    incidence = math.radians(10.0)
    for polar, regime in ((falling, "growing"), (POLAR, "settled")):
        loads = UnsteadyLoads.from_polar(polar, SeparationLags.none())
        at = incidence if regime == "growing" else INCIDENCE
        section = plate_sections(30.0)
        growth = float(least_stable_eigenvalue(section_system(section, loads, at))[0].real)
        history = release_sections(section, loads, at, 200.0)
        valid = slice(0, int(history.samples[0]))
        twist, deflection = history.twist[valid, 0], history.deflection[valid, 0]
        verdict = assess(history.time[valid], twist, deflection, final=True)
        assert (growth > 0) == (regime == "growing")
        assert verdict.regime == regime
        assert math.degrees(verdict.twist_amplitude) < 0.5


@pytest.mark.parametrize(
    ("slope", "inertia", "stiffness_ratio", "k_star"),
    [
        (-1.0, 6.67, 0.0085, 40.0),  # so slow that it has not swung when the twist is at rest
        (-1.0, 6.67, 0.183, 40.0),  # grows by less than a tenth in a period
        (-1.0, 2.0, 0.183, 40.0),  # still small when the twist is at rest
        (-3.0, 4.0, 42.0, 6.0),  # faster than the twist
        (-3.0, 20.0, 0.034, 5.0),  # two swings in all
    ],
)
def test_heave_that_grows_is_told_stable_neither_early_nor_at_the_end(
    slope, inertia, stiffness_ratio, k_star
):
    """Of a section with a linear c_l that falls the eigenvalue at equilibrium knows the truth."""
    angles = np.radians(np.linspace(-30.0, 30.0, 121))
    bluff = Polar(angles, np.full(121, 0.1), slope * angles, 0.3 * angles, "bluff")
    loads = UnsteadyLoads.from_polar(bluff, SeparationLags.none())
    section = sections(k_star, inertia, 12.0, stiffness_ratio)
    unstable = least_stable_eigenvalue(section_system(section, loads, INCIDENCE))[0]
    assert unstable.real > 0.001
    history = release_sections(section, loads, INCIDENCE, 400.0)
    valid = slice(0, int(history.samples[0]))
    motion = [history.time[valid], history.twist[valid, 0], history.deflection[valid, 0]]
    natural = math.sqrt(k_star / inertia) / (2 * math.pi)
    for end in range(50, motion[0].size, 50):
        so_far = assess(*(values[:end] for values in motion), Criteria(periods=10))
        assert so_far.regime in {"undecided", "growing"}
    verdict = assess(*motion, Criteria(periods=10), final=True, natural_frequency=natural)
    assert verdict.regime == "growing"
    assert heave_grows(*motion, natural)


def test_heave_whose_growth_cannot_be_seen_yet_leaves_the_mean_unknown():
    """One swing of the heave in all of the run."""
    angles = np.radians(np.linspace(-30.0, 30.0, 121))
    bluff = Polar(angles, np.full(121, 0.1), -angles, 0.3 * angles, "bluff")
    loads = UnsteadyLoads.from_polar(bluff, SeparationLags.none())
    section = sections(10.0, 20.0, 12.0, 0.0085)
    history = release_sections(section, loads, INCIDENCE, 400.0)
    motion = history.time, history.twist[:, 0], history.deflection[:, 0]
    verdict = assess(*motion, final=True, natural_frequency=math.sqrt(0.5) / (2 * math.pi))
    assert verdict.regime == "settled"
    assert not verdict.mean_known
    assert "which a longer run would tell" in verdict.reason


def test_section_that_came_to_rest_long_ago_has_no_amplitude():
    """The paper's plate in water: the twist is dead after one swing of the heave."""
    section = sections(3.0, 0.2, MASS_RATIO, STIFFNESS_RATIO)
    system = section_system(section, measured(), INCIDENCE)
    history = release_sections(section, measured(), INCIDENCE, 400.0)
    natural = math.sqrt(3.0 / 0.2) / (2 * math.pi)
    motion = history.time, history.twist[:, 0], history.deflection[:, 0]
    verdict = assess(*motion, final=True, natural_frequency=natural)
    states, _ = equilibrium(system)
    assert verdict.regime == "settled"
    assert math.degrees(verdict.twist_amplitude) < 1e-3
    assert verdict.mean_twist == pytest.approx(states[0, 0], rel=1e-3)
    assert verdict.mean_deflection == pytest.approx(states[0, 2], rel=1e-3)


@pytest.mark.parametrize("shift_deg", [-4.0, -1.0, 3.0])
def test_stability_does_not_hang_on_where_incidence_is_counted_from(shift_deg):
    """The same section in the same flow, its incidence read from another chord line."""
    shift = math.radians(shift_deg)
    moved = Polar(POLAR.incidence + shift, POLAR.drag, POLAR.lift, POLAR.moment, "moved")
    sections = plate_sections(np.array([5.0, 8.0, 14.0]))
    first, second = (
        least_stable_eigenvalue(section_system(sections, UnsteadyLoads.from_polar(polar), at))
        for polar, at in ((POLAR, INCIDENCE), (moved, INCIDENCE + shift))
    )
    # tables of the polar have their nodes elsewhere
    np.testing.assert_allclose(second, first, rtol=0, atol=2e-6)


def test_limit_cycles_just_below_the_onset():
    """The polar's stall bounds the growth: at k* = 7 a limit cycle of 9.5 deg, steady to 2 %."""
    history = release_sections(
        plate_sections(7.0), measured(), INCIDENCE, 1600.0, output_interval=0.2
    )
    amplitudes = np.degrees(cycle_amplitudes(history, 0))
    assert amplitudes[-1] == pytest.approx(9.47, rel=0.02)
    np.testing.assert_allclose(amplitudes[-10:], amplitudes[-1], rtol=0.02)


@pytest.mark.parametrize(
    ("incidence_deg", "onset"), [(1.0, 3.65), (2.0, 5.84), (2.5, 9.50), (3.0, 9.88), (5.0, 13.2)]
)
def test_onset_of_the_uncorrected_section(incidence_deg, onset):
    """Growth passes zero there: the table of docs/embedded.md."""
    assert section_onset(measured(), incidence_deg) == pytest.approx(onset, rel=0.01)


def test_onset_with_the_polar_of_the_whole_plate():
    """The section with the loads of the paper's Table 1, docs/embedded.md."""
    whole = UnsteadyLoads.from_polar(Polar.read(POLARS / "paper_plate_3d.csv"))
    assert section_onset(whole, 2.5) == pytest.approx(6.63, rel=0.01)


def section_onset(loads: UnsteadyLoads, incidence_deg: float) -> float:
    def growth(k_star: float) -> float:
        system = section_system(plate_sections(k_star), loads, math.radians(incidence_deg))
        return float(least_stable_eigenvalue(system)[0].real)

    return float(brentq(growth, 3.5, 40.0, xtol=1e-4))


def test_parameters_that_make_no_sense_are_refused():
    with pytest.raises(ValueError, match=r"torsional_stiffness\n.*greater than 0"):
        plate_sections([5.0, -1.0])
