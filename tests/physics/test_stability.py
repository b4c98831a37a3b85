"""Stability of a section by eigenvalues: published speeds, limits, folds, and what is unknown."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xarray as xr
from scipy.optimize import brentq
from tests.plate_section import (
    ASSEMBLED,
    ATTACHED,
    CHORD,
    DENSITY,
    PLATE,
    POLAR,
    THIN,
    damped,
    speed_of,
)

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.errors import ArgumentError, IncidenceOutOfRangeError
from equisection.motion.sections import section_system
from equisection.motion.stability import critical_speed, stability
from equisection.motion.static_branch import BranchEnd, StaticBranch, section_equilibrium
from equisection.motion.steady_states import equilibrium, jacobian, least_stable_eigenvalue
from equisection.validation.flutter_values import deck

#: Its polar without drag, which turns with the wind: what the independent assembly left out.
DRAGLESS = Polar(POLAR.incidence, np.zeros_like(POLAR.drag), POLAR.lift, POLAR.moment, "no drag")


def test_eigenvalues_of_the_plate():
    """Those of an independent assembly of the equations with the same polar and lags."""
    speeds = [speed_of(PLATE, k_star) for k_star in (8.0, 5.0)]
    found = stability(
        PLATE, DRAGLESS, incidence_deg=2.5, speed=speeds, density=DENSITY, lags=ASSEMBLED
    )
    sigma = found["growth_rate_convective"].values
    omega = 2 * math.pi * found["frequency_strouhal"].values
    np.testing.assert_allclose(sigma, [0.003469, 0.033278], atol=1e-6)
    np.testing.assert_allclose(omega, [0.978598, 0.724203], atol=1e-6)
    np.testing.assert_allclose(found["growth_rate"], sigma * speeds / np.array(CHORD))
    np.testing.assert_allclose(found["frequency"] * CHORD / speeds * 2 * math.pi, omega)
    assert set(found["mechanism"].values) == {"flutter"}


def test_onset_of_the_plate_over_incidence():
    """The first onset from rest by an independent assembly."""
    angles = [2.0, 2.5, 3.0, 4.0, 5.0, 6.0]
    onset = critical_speed(
        PLATE, POLAR, incidence_deg=angles, speed=(10.0, 80.0), density=DENSITY, lags=ASSEMBLED
    )
    known = [5.64, 8.71, 8.86, 11.02, 11.72, 9.76]
    np.testing.assert_allclose(onset["k_star"], known, atol=0.0075)
    assert set(onset["mechanism"].values) == {"flutter"}


def test_onset_at_zero_incidence_is_that_of_attached_flow():
    """There the section neither twists nor separates, so no lag of separation counts.

    Up to the curvature of the polar within the step of the slopes' differences.
    """
    lagging, attached = (
        critical_speed(
            PLATE, DRAGLESS, incidence_deg=0.0, speed=(10.0, 80.0), density=DENSITY, lags=lags
        )
        for lags in (IDENTIFIED_LAGS, ATTACHED)
    )
    assert float(lagging["critical_speed"]) == pytest.approx(
        float(attached["critical_speed"]), rel=2e-3
    )
    assert float(lagging["equilibrium_twist"]) == 0.0


def test_onset_with_the_default_lags_over_incidence():
    """The table of docs/embedded.md."""
    angles = [0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0]
    onset = critical_speed(PLATE, POLAR, incidence_deg=angles, speed=(10.0, 80.0), density=DENSITY)
    now = [2.34, 3.43, 5.70, 9.26, 9.48, 11.87, 12.73, 10.48]
    np.testing.assert_allclose(onset["k_star"], now, atol=0.0075)


def test_interval_of_an_onset_is_stable_below_and_unstable_above():
    onset = critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=(10.0, 80.0), density=DENSITY)
    low, high = float(onset["speed_low"]), float(onset["speed_high"])
    assert low < float(onset["critical_speed"]) < high < low * (1 + 1.01e-6)
    around = stability(PLATE, POLAR, incidence_deg=2.5, speed=[low, high], density=DENSITY)
    assert around["growth_rate"].values[0] < 0.0 < around["growth_rate"].values[1]
    assert list(around["mechanism"].values) == ["none", "flutter"]


@pytest.mark.parametrize("incidence_deg", [0.0, 0.5])
def test_deck_of_the_benchmark_flutters_where_it_is_known_to(incidence_deg):
    """76.68 m/s by Theodorsen's function (undamped); 76.165 with Jones's two states in its place.

    Attached flow is linear, so that the incidence does not matter.
    """
    onset = critical_speed(
        deck(0.0),
        THIN,
        incidence_deg=incidence_deg,
        speed=(20.0, 120.0),
        density=1.22,
        lags=ATTACHED,
    )
    assert float(onset["critical_speed"]) == pytest.approx(76.165, abs=1e-3)
    assert float(onset["critical_speed"]) == pytest.approx(76.68, rel=0.01)
    assert str(onset["mechanism"].values) == "flutter"
    assert 0.1 < float(onset["frequency"]) < 0.278


def stiff_in_bending() -> Section:
    """A section whose deflection follows at once: nothing is left to flutter with."""
    return PLATE.model_copy(update={"flexural_stiffness": 1e4 * PLATE.flexural_stiffness})


def test_thin_plate_diverges_where_the_spring_gives_way():
    """k* = dc_m/dalpha = pi/2 (Bisplinghoff, Ashley & Halfman, chapter 8)."""
    onset = critical_speed(
        stiff_in_bending(), THIN, incidence_deg=0.0, speed=(10.0, 100.0), lags=ATTACHED
    )
    assert float(onset["k_star"]) == pytest.approx(math.pi / 2, rel=3e-6)
    exact = math.sqrt(2 * PLATE.torsional_stiffness / (1.225 * CHORD**2 * math.pi / 2))
    assert float(onset["critical_speed"]) == pytest.approx(exact, rel=1e-6)
    assert str(onset["mechanism"].values) == "divergence"
    assert float(onset["frequency"]) == 0.0
    assert str(onset["reason"].values) == ""


def test_equilibrium_of_a_thin_plate_is_that_of_the_linear_spring():
    """k* theta = (pi/2) (theta_0 + theta), k_w* w/c = 2 pi (theta_0 + theta)."""
    speeds = np.array([10.0, 30.0, 50.0])
    found = stability(PLATE, THIN, incidence_deg=2.0, speed=speeds, lags=ATTACHED)
    k_star = found["k_star"].values
    rigid = math.radians(2.0)
    twist = 0.5 * math.pi * rigid / (k_star - 0.5 * math.pi)
    np.testing.assert_allclose(found["equilibrium_twist"], twist, rtol=1e-9)
    lift = 2 * math.pi * (rigid + twist) * 0.5 * 1.225 * speeds**2 * CHORD
    np.testing.assert_allclose(
        found["equilibrium_deflection"], lift / PLATE.flexural_stiffness, rtol=1e-6
    )


STIFFENING = 40.0


def rising() -> Polar:
    """A polar whose moment rises ever faster: c_m = alpha + 40 alpha^3."""
    alpha = np.radians(np.linspace(-20.0, 20.0, 161))
    moment = alpha + STIFFENING * alpha**3
    return Polar(alpha, 0.0 * alpha, 0.1 * alpha, moment, "rising")


def slowest(section: Section, branch: StaticBranch, k_star: float) -> float:
    """Real eigenvalue (V/c) nearest to zero about the equilibrium at a k*."""
    flowing = section.in_flow(DENSITY, speed_of(section, k_star))
    loads = UnsteadyLoads.from_polar(branch.polar, ATTACHED)
    system = section_system([flowing], loads, branch.start)
    linear = jacobian(system, *section_equilibrium(system, branch.incidence([k_star])))[0]
    values = np.linalg.eigvals(linear)
    real = values.real[np.abs(values.imag) < 1e-12]
    return float(real[np.abs(real).argmin()])


def test_branch_ends_in_a_fold_where_its_eigenvalue_vanishes():
    """Of c_m = a alpha + b alpha^3 the fold is at 2 b alpha^3 - 3 b theta_0 alpha^2 = a theta_0."""
    rigid = math.radians(2.0)
    roots = np.roots([2 * STIFFENING, -3 * STIFFENING * rigid, 0.0, -rigid])
    alpha = float(roots[np.abs(roots.imag) < 1e-12].real[0])
    k_star = 1.0 + 3 * STIFFENING * alpha**2  # dc_m/dalpha
    branch = StaticBranch.from_rest(rising(), rigid)
    assert branch.end is BranchEnd.FOLD
    assert branch.stop == pytest.approx(alpha, rel=1e-3)
    assert branch.k_star_end == pytest.approx(k_star, rel=1e-3)

    section = stiff_in_bending()
    fold = speed_of(section, branch.k_star_end)
    real = [slowest(section, branch, (1.0 + part) * branch.k_star_end) for part in (1e-4, 1e-6)]
    assert real[0] < real[1] < 0.0
    assert real[1] / real[0] == pytest.approx(0.1, rel=0.05)  # as the root of the distance

    speeds = fold * np.array([0.9, 0.9999, 1.0001, 1.2])
    found = stability(
        section, rising(), incidence_deg=2.0, speed=speeds, density=DENSITY, lags=ATTACHED
    )
    assert np.isnan(found["growth_rate"].values[2:]).all()
    assert list(found["mechanism"].values) == ["none"] * 2 + ["divergence"] * 2
    assert "fold" in str(found["reason"].values[-1])
    onset = critical_speed(
        section, rising(), incidence_deg=2.0, speed=(5.0, 100.0), density=DENSITY, lags=ATTACHED
    )
    assert float(onset["critical_speed"]) == pytest.approx(fold, rel=2e-6)
    assert str(onset["mechanism"].values) == "divergence"


def snapping() -> Polar:
    """A moment that rises steeply, stays, and rises again: two branches with a gap between."""
    degrees = np.array([-1.0, 0.0, 1.0, 2.0, 3.0, 6.0, 9.0, 12.0, 20.0])
    moment = np.array([0.0, 0.002, 0.004, 0.02, 0.06, 0.061, 0.062, 0.063, 0.064])
    return Polar(np.radians(degrees), 0 * degrees, 0.01 * degrees, moment, "snapping")


def test_beyond_a_fold_the_other_branch_is_not_taken_for_stable():
    """There is a stable equilibrium at a larger twist, but the section has to jump to it."""
    section = stiff_in_bending()
    branch = StaticBranch.from_rest(snapping(), 0.0)
    assert branch.end is BranchEnd.FOLD
    beyond = 0.9 * branch.k_star_end
    alpha = np.linspace(branch.stop, math.radians(20.0), 2000)
    excess = beyond * alpha - snapping().moment_coefficient(alpha)
    assert excess[0] < 0.0 < excess[-1]  # an equilibrium of the other branch is between
    found = stability(
        section, snapping(), incidence_deg=0.0, speed=speed_of(section, beyond, 1.225)
    )
    assert str(found["mechanism"].values) == "divergence"
    assert math.isnan(float(found["growth_rate"]))


def test_twist_that_leaves_the_polar_is_unknown_and_never_stable():
    polar = Polar.flat_plate(math.radians(6.0))
    speeds = np.linspace(10.0, 120.0, 60)
    section = stiff_in_bending()
    found = stability(section, polar, incidence_deg=2.0, speed=speeds, lags=ATTACHED)
    alpha = math.radians(2.0) + found["equilibrium_twist"].values
    known = found["mechanism"].values == "none"
    assert known.any()
    assert (np.abs(alpha[known]) < math.radians(6.0)).all()
    assert set(found["mechanism"].values[~known]) == {"unknown"}
    assert "leaves the polar, which covers -6 to 6 deg" in str(found["reason"].values[-1])
    onset = critical_speed(section, polar, incidence_deg=2.0, speed=(10.0, 120.0), lags=ATTACHED)
    assert math.isnan(float(onset["critical_speed"]))
    # k* theta = c_m at 6 deg: two thirds of the way to divergence in k*
    assert float(onset["speed_low"]) == pytest.approx(
        speed_of(section, 1.5 * math.pi / 2, 1.225), rel=0.01
    )
    assert str(onset["mechanism"].values) == "unknown"


def test_no_onset_in_the_range_is_said_as_such():
    none = critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=(5.0, 25.0), density=DENSITY)
    assert math.isnan(float(none["critical_speed"]))
    assert float(none["speed_low"]) == 25.0
    assert math.isnan(float(none["speed_high"]))
    assert str(none["mechanism"].values) == "none"
    assert str(none["reason"].values) == "none up to 25 m/s"
    above = critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=(40.0, 50.0), density=DENSITY)
    assert math.isnan(float(above["critical_speed"]))
    assert float(above["speed_high"]) == 40.0
    assert str(above["reason"].values) == "unstable already at 40 m/s: begin below"


def test_a_fluid_and_a_section_twice_as_heavy_and_stiff_are_the_same():
    members = ("torsional_stiffness", "flexural_stiffness", "inertia", "mass")
    twice = PLATE.model_copy(update={name: 2 * getattr(PLATE, name) for name in members})
    speeds = [20.0, 31.0, 40.0]
    one = stability(PLATE, POLAR, incidence_deg=[1.0, 2.5], speed=speeds, density=1.0)
    two = stability(twice, POLAR, incidence_deg=[1.0, 2.5], speed=speeds, density=2.0)
    xr.testing.assert_allclose(one, two, rtol=1e-9)


def test_incidence_of_the_other_sign_is_the_mirror_image():
    up, down = (
        stability(PLATE, POLAR, incidence_deg=angle, speed=[25.0, 31.0, 45.0])
        for angle in (3.0, -3.0)
    )
    np.testing.assert_allclose(up["growth_rate"], down["growth_rate"], rtol=1e-6)
    np.testing.assert_allclose(up["equilibrium_twist"], -down["equilibrium_twist"], rtol=1e-12)


def test_lists_make_dimensions_and_everything_has_units():
    shapes = {
        (2.5, 30.0): {},
        (2.5, (30.0, 31.0)): {"speed": 2},
        ((1.0, 2.5, 3.0), (30.0, 31.0)): {"incidence_deg": 3, "speed": 2},
    }
    for (angle, speed), sizes in shapes.items():
        found = stability(PLATE, POLAR, incidence_deg=angle, speed=speed)
        assert dict(found.sizes) == sizes
        for name, variable in found.variables.items():
            assert {"units", "long_name"} <= variable.attrs.keys(), name
        assert found.attrs["density"] == 1.225
        assert "identified" in found.attrs["lags"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed": 0.0}, r"speed is 0\.0; wanted numbers above 0 \(m/s\)"),
        ({"speed": [10.0, 1e300]}, "wanted numbers from 1e-18 to 1e.18"),
        ({"speed": [10.0, -1.0]}, "speed is"),
        ({"speed": []}, "speed is"),
        ({"speed": "fast"}, "speed is 'fast'"),
        ({"incidence_deg": math.nan}, "incidence_deg is nan"),
        ({"density": 0.0}, "density is 0.0"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(changes, words):
    arguments = {"incidence_deg": 2.5, "speed": 30.0, **changes}
    with pytest.raises(ArgumentError, match=words):
        stability(PLATE, POLAR, **arguments)


@pytest.mark.parametrize("speed", [30.0, (50.0, 10.0), (10.0, 20.0, 30.0), (0.0, 10.0)])
def test_a_range_is_two_rising_speeds(speed):
    with pytest.raises(ArgumentError, match="speed is"):
        critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=speed)


@pytest.mark.parametrize(
    ("ratio", "k_star"), [(0.003, 8.039), (0.005, 7.685), (0.01, 6.999), (0.02, 6.095)]
)
def test_onset_of_the_damped_plate(ratio, k_star):
    """By an independent assembly of the equations with the same polar and lags."""
    onset = critical_speed(
        damped(PLATE, ratio),
        DRAGLESS,
        incidence_deg=2.5,
        speed=(10.0, 80.0),
        density=DENSITY,
        lags=ASSEMBLED,
    )
    assert float(onset["k_star"]) == pytest.approx(k_star, abs=1e-3)


@pytest.mark.parametrize(
    ("ratio", "known"),
    [
        (0.005, [5.48, 7.68, 7.82, 9.61, 10.05, 8.47]),
        (0.01, [5.34, 7.00, 7.12, 8.68, 8.97, 7.62]),
        (0.02, [5.13, 6.10, 6.19, 7.46, 7.58, 6.52]),
    ],
)
def test_onset_of_the_damped_plate_over_incidence(ratio, known):
    """By the same independent assembly, to the digits that it was written down with."""
    angles = [2.0, 2.5, 3.0, 4.0, 5.0, 6.0]
    onset = critical_speed(
        damped(PLATE, ratio),
        POLAR,
        incidence_deg=angles,
        speed=(10.0, 80.0),
        density=DENSITY,
        lags=ASSEMBLED,
    )
    np.testing.assert_allclose(onset["k_star"], known, atol=0.0075)
    assert set(onset["mechanism"].values) == {"flutter"}


def test_damped_deck_flutters_a_little_later():
    """77.24 m/s at 0.3 per cent by Theodorsen's function, 76.679 with Jones's two states."""
    onset = critical_speed(
        deck(0.003),
        THIN,
        incidence_deg=0.0,
        speed=(20.0, 120.0),
        density=1.22,
        lags=ATTACHED,
    )
    assert float(onset["critical_speed"]) == pytest.approx(76.679, abs=1e-3)
    assert float(onset["critical_speed"]) == pytest.approx(77.24, rel=0.01)


def test_imbalance_and_dampers_leave_the_equilibrium_as_it_is():
    other = damped(PLATE, 0.01).model_copy(update={"static_imbalance": 0.1 * PLATE.mass * CHORD})
    speeds = [10.0, 20.0, 30.0]
    one, two = (
        stability(section, POLAR, incidence_deg=2.5, speed=speeds) for section in (PLATE, other)
    )
    for name in ("equilibrium_twist", "equilibrium_deflection"):
        np.testing.assert_array_equal(one[name], two[name])
    assert (one["growth_rate"] != two["growth_rate"]).all()


#: Likeness of both shapes of Goland's wing, by which its section's imbalance is smaller.
COS_PHI = 0.958641


def goland(imbalance: float = COS_PHI, axis: float = 0.33, pair: int = 1) -> Section:
    """Section (SI) of Goland's wing (J. Appl. Mech. 12, 1945), about its elastic axis.

    With a part of its imbalance; of the n-th pair of modes of such a wing between forks, whose
    natural frequencies go with n^2 in bending and with n in torsion.
    """
    mass, inertia, chord = 35.717, 8.642, 1.8288
    return Section(
        mass=mass,
        inertia=inertia,
        static_imbalance=imbalance * 0.1 * chord * mass,
        flexural_stiffness=mass * (49.4923 * pair**2) ** 2,
        torsional_stiffness=inertia * (87.1081 * pair) ** 2,
        chord=chord,
        elastic_axis=axis,
    )


def pitch_and_plunge() -> Section:
    """Section of SU2's tutorial of fluid-structure interaction with Theodorsen's axis at -1/2.

    Mass ratio 100, x_alpha 0.25, r_alpha^2 0.25, omega_alpha 45 rad/s, omega_h 0.3185 of it; for
    a fluid of density 1 kg/m^3 and the semi-chord 0.5 m.
    """
    mass = 100 * math.pi * 0.25
    return Section(
        mass=mass,
        inertia=0.25 * mass * 0.25,
        static_imbalance=0.25 * mass * 0.5,
        flexural_stiffness=mass * (0.3185 * 45.0) ** 2,
        torsional_stiffness=0.25 * mass * 0.25 * 45.0**2,
        elastic_axis=0.25,
    )


@pytest.mark.parametrize(
    ("section", "density", "jones", "exact", "mechanism"),
    [
        (goland(), 1.225, 133.954, 133.297, "flutter"),
        (goland(1.0), 1.225, None, 132.567, "flutter"),
        (goland(1.0, pair=2), 1.225, None, 120.575, "flutter"),
        (goland(0.0), 1.225, None, 252.35, "divergence"),
        (pitch_and_plunge(), 1.0, 127.61, 126.91, "flutter"),
    ],
)
def test_speeds_of_sections_with_their_axes_apart(section, density, jones, exact, mechanism):
    """By an independent Theodorsen code: C(k) exact, and with the two states of Jones."""
    onset = critical_speed(
        section, THIN, incidence_deg=0.0, speed=(20.0, 400.0), density=density, lags=ATTACHED
    )
    assert float(onset["critical_speed"]) == pytest.approx(exact, rel=0.01)
    if jones is not None:
        assert float(onset["critical_speed"]) == pytest.approx(jones, rel=5e-5)
    assert str(onset["mechanism"].values) == mechanism


def test_flutter_of_goland_under_the_loads_of_a_finite_wing():
    """Loads over 1.449 (c_l) and 1.290 (c_m about mid-chord): 148.5 m/s by an independent code.

    That is with C(k) exact. A factor on the moment about the axis would give 154.4 m/s.
    """

    def growth(speed: float) -> float:
        flowing = [goland().in_flow(1.225, speed)]
        factors = np.array([[1 / 1.449, 1 / 1.290]])
        loads = UnsteadyLoads.from_polar(THIN, ATTACHED)
        return float(least_stable_eigenvalue(section_system(flowing, loads, 0.0, factors))[0].real)

    assert brentq(growth, 120.0, 180.0) == pytest.approx(148.5, rel=0.01)


def test_thin_plate_with_its_axis_at_the_quarter_chord_never_diverges():
    """There its lift acts (Glauert), so that the flow does not turn it."""
    speeds = [10.0, 100.0, 1000.0, 10000.0]
    section = stiff_in_bending().model_copy(update={"elastic_axis": 0.25})
    found = stability(section, THIN, incidence_deg=0.0, speed=speeds, lags=ATTACHED)
    assert (found["growth_rate"].values < 0.0).all()
    ahead = section.model_copy(update={"elastic_axis": 0.2})
    found = stability(ahead, THIN, incidence_deg=1.0, speed=speeds, lags=ATTACHED)
    assert "divergence" not in found["mechanism"].values


@pytest.mark.parametrize("axis", [0.2, 0.33, 0.7])
def test_section_diverges_where_the_moment_about_its_axis_outgrows_the_spring(axis):
    """k* = c_m' + x_ea (c_l' + c_d) at zero incidence, of a polar with drag."""
    degrees = np.linspace(-20.0, 20.0, 161)
    alpha = np.radians(degrees)
    draggy = Polar(alpha, 0.4 + alpha**2, 4.0 * alpha, 1.5 * alpha, "draggy")
    section = stiff_in_bending().model_copy(update={"elastic_axis": axis})
    slope = 1.5 + (axis - 0.5) * (4.0 + 0.4)
    onset = critical_speed(
        section, draggy, incidence_deg=0.0, speed=(10.0, 400.0), density=DENSITY, lags=ATTACHED
    )
    assert float(onset["k_star"]) == pytest.approx(slope, rel=1e-4)
    assert str(onset["mechanism"].values) == "divergence"


@pytest.mark.parametrize("axis", [0.25, 0.4, 0.62])
def test_equilibrium_about_an_axis_is_that_of_the_equations_of_motion(axis):
    """The branch, which solves the statics of the polar, and Newton's method on the system."""
    section = PLATE.model_copy(update={"elastic_axis": axis})
    rigid = math.radians(3.0)
    k_star = np.array([6.0, 12.0, 40.0])
    flowing = [section.in_flow(DENSITY, speed_of(section, k)) for k in k_star]
    system = section_system(flowing, UnsteadyLoads.from_polar(POLAR), rigid)
    branch = StaticBranch.from_rest(POLAR, rigid, section.axis_behind_mid_chord)
    alpha = branch.incidence(k_star)
    states, _ = equilibrium(system)
    np.testing.assert_allclose(states[:, 0], alpha - rigid, atol=2e-8)  # the polar's table
    known, _ = section_equilibrium(system, alpha)
    np.testing.assert_allclose(states[:, 2], known[:, 2], atol=2e-7)
    normal = POLAR.lift_cubic(alpha) * np.cos(alpha)
    normal += POLAR.drag_coefficient(alpha) * np.sin(alpha)
    moment = POLAR.moment_cubic(alpha) + (axis - 0.5) * normal
    np.testing.assert_allclose(k_star * (alpha - rigid), moment, atol=1e-8)


def test_polar_about_another_point_is_the_formula_between_its_points_too():
    alpha = np.linspace(*POLAR.incidence_range, 4001)
    for axis in (-0.25, 0.1):
        normal = POLAR.lift_cubic(alpha) * np.cos(alpha)
        normal += POLAR._drag.cubic(alpha) * np.sin(alpha)
        np.testing.assert_allclose(
            POLAR.moment_cubic_about(axis)(alpha),
            POLAR.moment_cubic(alpha) + axis * normal,
            rtol=0,
            atol=1e-11,
        )
    assert POLAR.moment_cubic_about(0.0) is POLAR.moment_cubic


def test_incidence_beyond_the_polar_is_refused():
    with pytest.raises(IncidenceOutOfRangeError, match="15 deg is outside polar"):
        stability(PLATE, POLAR, incidence_deg=15.0, speed=30.0)
