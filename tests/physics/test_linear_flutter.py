"""Classical linear theory of a section: Theodorsen's function, divergence, flutter."""

from __future__ import annotations

import math

import numpy as np
import pytest

from equisection.aerodynamics.indicial import theodorsen
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.errors import EquisectionError
from equisection.motion.exact_roots import exact_growth_and_frequency
from equisection.motion.linear_flutter import (
    divergence_scale,
    flutter,
    growth_and_frequency,
)
from equisection.validation.flutter_values import deck


def section(mass, inertia, flexural, torsional, axis=0.0, centre=0.0):  # noqa: PLR0917
    """Return a section in a flow; axis and centre of mass in chords behind mid-chord."""
    return Section(
        mass=mass,
        inertia=inertia,
        flexural_stiffness=flexural,
        torsional_stiffness=torsional,
        static_imbalance=mass * (centre - axis),
        elastic_axis=0.5 + axis,
    )


def textbook(axis: float, centre: float, mass_ratio: float, gyration_2: float, ratio: float):
    """Return a section from a, e, mu, r^2 and sigma of the textbooks; s is 1/V^2.

    Lengths are in half-chords, V = U/(b omega_theta).
    """
    mass = mass_ratio * math.pi / 2
    inertia = mass * gyration_2 / 4
    return section(mass, inertia, 4 * ratio**2 * mass, 4 * inertia, axis / 2, centre / 2)


def air(moved: Section) -> ThinAirfoil:
    """Return the loads about the elastic axis of a section."""
    return ThinAirfoil(moved.axis_behind_mid_chord)


#: Hodges & Pierce, Introduction to Structural Dynamics and Aeroelasticity, sections 4.2 and 5.5.
HODGES_PIERCE = textbook(-1 / 5, -1 / 10, 20, 6 / 25, 2 / 5)
#: The paper's section at s = k*, in its own reduction (c^2 m/I = 9.12, c^2 k_w/k_theta = 0.183).
PLATE = section(9.12 * 6.67, 6.67, 0.183, 1.0)


def test_no_stiffness_is_too_far_off_to_be_answered():
    """Where the air is a mass and no more, or springs are nothing to it; else NaN, and at once.

    Stiff springs turn the section at sqrt(s) times its frequencies in still air.
    """
    for given in (PLATE, HODGES_PIERCE):
        scales = np.array([0.0, 1e-300, 1e-18, 1.0, 1e18, 1e300, math.inf])
        usual = growth_and_frequency(given, scales[3:4])[0]
        p = growth_and_frequency(given, scales)
        assert np.isnan(p[[0, 1, 5, 6]]).all()
        assert p[3] == pytest.approx(usual, rel=1e-12)
        mass = given.mass_matrix + air(given).apparent_mass
        squares = np.linalg.eigvals(np.linalg.solve(mass, given.stiffness_matrix)).real
        assert np.sort(p[4].imag) == pytest.approx(1e9 * np.sqrt(np.sort(squares)), rel=1e-6)
        exact = exact_growth_and_frequency(given, scales)
        assert np.isnan(exact[[0, 1, 5, 6]]).all()
        alone = exact_growth_and_frequency(given, scales[3:4])[0]
        assert exact[3] == pytest.approx(alone, rel=1e-9, nan_ok=True)


def test_no_section_is_too_light_or_soft_to_be_answered():
    odd = (
        section(1e-100, 1.0, 1.0, 1.0),
        section(1.0, 1e300, 1.0, 1.0),
        section(1.0, 1.0, 1e-300, 1.0),
        section(1.0, 1.0, 1.0, 1e300),
    )
    for given in odd:
        for of in (growth_and_frequency, exact_growth_and_frequency):
            assert of(given, np.array([1.0])).shape == (1, 2)
        found = flutter(given)
        assert found is None or math.isfinite(found.scale)


def flutter_determinant(k, squares, numbers):
    """Return the determinant of heave h/b and pitch; ``squares`` is (omega_theta/omega)^2."""
    axis, centre, mass_ratio, gyration_2, ratio = numbers
    circulation = complex(theodorsen(k))
    lift_by_heave = 1 - 2j * circulation / k
    lift_by_pitch = -axis - 1j / k - 2 * circulation / k**2 - 2j * (0.5 - axis) * circulation / k
    moment_by_heave = -axis + 2j * (0.5 + axis) * circulation / k
    moment_by_pitch = (
        1 / 8
        + axis**2
        - 1j * (0.5 - axis) / k
        + 2 * (0.5 + axis) * circulation / k**2
        + 2j * (0.25 - axis**2) * circulation / k
    )
    offset = mass_ratio * (centre - axis)
    return np.linalg.det(
        [
            [mass_ratio * (1 - ratio**2 * squares) + lift_by_heave, offset + lift_by_pitch],
            [offset + moment_by_heave, mass_ratio * gyration_2 * (1 - squares) + moment_by_pitch],
        ]
    )


class TestTheodorsensFunction:
    def test_limits(self):
        assert theodorsen(1e-6) == pytest.approx(1.0, abs=2e-5)
        assert theodorsen(1e5) == pytest.approx(0.5, abs=1e-5)
        np.testing.assert_allclose(theodorsen([1e-300, 1e12, 1e300]), [1.0, 0.5, 0.5], atol=2e-9)

    @pytest.mark.parametrize(
        ("k", "real", "imaginary"),
        [
            (0.05, 0.9090, -0.1306),
            (0.1, 0.8319, -0.1723),
            (0.2, 0.7276, -0.1886),
            (0.5, 0.5979, -0.1507),
            (1.0, 0.5394, -0.1003),
            (4.0, 0.5037, -0.0305),
        ],
    )
    def test_table_values(self, k, real, imaginary):
        """Theodorsen, NACA Report 496, Table II; to the last digit printed there."""
        assert theodorsen(k) == pytest.approx(complex(real, imaginary), abs=6e-5)


class TestLoads:
    def test_steady_lift_acts_at_the_quarter_chord(self):
        for axis in (-0.25, 0.0, 0.1):
            loads = ThinAirfoil(axis).influence(0.0)
            np.testing.assert_allclose(loads[:, 0], 0.0)
            assert loads[0, 1] == pytest.approx(2 * math.pi)
            assert loads[1, 1] == pytest.approx(2 * math.pi * (0.25 + axis))

    def test_slow_heave_is_a_steady_incidence(self):
        """w/c = -theta/(i omega) blows against the plate as the incidence theta does."""
        omega = 1e-4
        loads = ThinAirfoil().influence(omega)
        assert -loads[0, 0] / (1j * omega) == pytest.approx(2 * math.pi, rel=1e-3)

    def test_loads_about_another_axis_are_the_same_loads(self):
        """Move the axis by d: w = w' + d theta, M' = M + d L."""
        d, omega = 0.13, 0.9
        here, there = (ThinAirfoil(axis).influence(omega) for axis in (0.0, d))
        place = np.array([[1.0, d], [0.0, 1.0]])
        np.testing.assert_allclose(place.T @ here @ place, there, rtol=1e-12)

    def test_fast_motion_meets_the_mass_of_a_cylinder(self):
        """Apparent mass rho pi b^2 and inertia rho pi b^4/8 (Lamb, Hydrodynamics, article 71)."""
        omega = 1e5
        loads = ThinAirfoil().influence(omega) / omega**2
        np.testing.assert_allclose(np.diag(loads).real, [math.pi / 2, math.pi / 64], rtol=1e-4)


class TestDivergence:
    def test_of_the_textbook(self):
        """Hodges & Pierce: U_D = r sqrt(mu/(1 + 2 a)) b omega_theta."""
        speed = 1 / math.sqrt(divergence_scale(HODGES_PIERCE))
        assert speed == pytest.approx(math.sqrt(6 / 25 * 20 / (1 - 2 / 5)), rel=1e-12)
        assert speed == pytest.approx(2.828, abs=5e-4)

    def test_of_a_plate_about_mid_chord(self):
        assert divergence_scale(PLATE) == pytest.approx(math.pi / 2)

    @pytest.mark.parametrize("given", [HODGES_PIERCE, PLATE], ids=["textbook", "plate"])
    def test_leaves_no_static_stiffness(self, given):
        scale = divergence_scale(given)
        left = scale * given.stiffness_matrix - air(given).influence(0.0)
        assert abs(np.linalg.det(left)) < 1e-12 * np.linalg.det(scale * given.stiffness_matrix)

    @pytest.mark.parametrize("axis", [-0.25, -0.3])
    def test_none_about_an_axis_at_the_quarter_chord_or_before_it(self, axis):
        assert divergence_scale(section(60.0, 7.0, 0.2, 1.0, axis, axis)) == 0.0


class TestFlutter:
    def test_of_the_textbook(self):
        """Hodges & Pierce, section 5.5: U_F = 2.165 b omega_theta."""
        assert 1 / math.sqrt(flutter(HODGES_PIERCE).scale) == pytest.approx(2.165, rel=0.01)

    @pytest.mark.parametrize(
        "numbers",
        [(-1 / 5, -1 / 10, 20, 6 / 25, 2 / 5), (-0.15, 0.10, 76, 0.388, 55.9 / 64.1)],
        ids=["Hodges & Pierce", "Fung, section 6.9"],
    )
    def test_flutter_determinant_of_the_textbooks_vanishes(self, numbers):
        """Scanlan & Rosenbaum, Aircraft Vibration and Flutter (1951), in their own coefficients."""
        found = flutter(textbook(*numbers))
        speed = 1 / math.sqrt(found.scale)
        k = found.omega / 2
        assert abs(flutter_determinant(k, 1 / (k * speed) ** 2, numbers)) < 1e-6

    def test_the_p_k_method_is_neutral_where_the_k_method_is(self):
        found = flutter(HODGES_PIERCE)
        p = growth_and_frequency(HODGES_PIERCE, found.scale * np.array([1.05, 1.0, 0.95]))
        place = int(np.argmax(p[1].real))
        assert p[1, place] == pytest.approx(1j * found.omega, abs=1e-7)
        assert p[0, place].real < 0.0 < p[2, place].real

    def test_heavy_sections_vibrate_as_in_vacuum(self):
        heavy = section(1e9, 1e8, 4e8, 9e8)
        p = growth_and_frequency(heavy, np.array([1.0]))[0]
        np.testing.assert_allclose(p.imag, [math.sqrt(0.4), 3.0], rtol=1e-7)
        np.testing.assert_allclose(p.real, 0.0, atol=1e-7)

    def test_slow_motions_far_below_divergence_are_found(self):
        """Half of the way in each round goes to and fro here, without an end."""
        given = section(621.2183, 19.31120, 0.3852723, 1.0, -0.1162656, -0.2037957)
        scales = np.geomspace(50.0, 0.2, 60)
        for scale, roots in zip(scales, growth_and_frequency(given, scales), strict=True):
            for p in roots:
                left = scale * given.stiffness_matrix - air(given).influence(max(p.imag, 0.0))
                terms = p**2 * given.mass_matrix + left
                assert abs(np.linalg.det(terms)) < 1e-8 * np.abs(left).max() ** 2

    def test_order_of_the_scales_does_not_matter(self):
        scales = np.array([4.0, 21.0, 8.0])
        p = growth_and_frequency(PLATE, scales)
        np.testing.assert_allclose(p, growth_and_frequency(PLATE, scales[::-1])[::-1], rtol=1e-8)

    @pytest.mark.parametrize("given", [HODGES_PIERCE, PLATE], ids=["textbook", "plate"])
    def test_other_scales_that_are_asked_for_do_not_matter(self, given):
        dense = np.append(np.geomspace(30.0, 1.5, 400), [2.0, 15.0])
        p = growth_and_frequency(given, dense)
        for few in ([1.5], [2.0, 15.0], [30.0], [15.0, 1.5, 2.0]):
            places = [int(np.argmin(np.abs(dense - scale))) for scale in few]
            alone = growth_and_frequency(given, np.array(few))
            np.testing.assert_allclose(alone, p[places], rtol=1e-8)

    def test_motions_change_little_from_one_scale_to_the_next_and_keep_apart(self):
        p = growth_and_frequency(PLATE, np.geomspace(100.0, 0.5, 600))
        assert np.abs(np.diff(p, axis=0)).max() < 0.02
        assert np.abs(p[:, 0] - p[:, 1]).min() > 0.05

    def test_both_motions_of_the_papers_section_below_its_flutter(self):
        """Growth of pitch between flutter (s = 1.93) and divergence (s = 1.57) and beyond."""
        p = growth_and_frequency(PLATE, np.array([1.5]))[0]
        np.testing.assert_allclose(p, [-0.213 + 0.168j, 0.036 + 0.236j], atol=1e-3)

    def test_a_motion_is_not_lost_where_both_come_close(self):
        """At s = 1.86 both guesses lead to one motion, and either is a p of its own loads."""
        given = section(136.4, 18.43, 10.61, 1.0, -0.03439, 0.1837)
        scales = np.geomspace(30.0, 0.5, 80)
        p = growth_and_frequency(given, scales)
        assert np.abs(p[:, 0] - p[:, 1]).min() > 0.03
        for scale, roots in zip(scales, p, strict=True):
            for root in roots:
                loads = air(given).influence(root.imag) - scale * given.stiffness_matrix
                terms = root**2 * given.mass_matrix - loads
                assert abs(np.linalg.det(terms)) < 1e-7 * np.abs(loads).max() ** 2

    @pytest.mark.parametrize("given", [HODGES_PIERCE, PLATE], ids=["textbook", "plate"])
    def test_stiff_sections_vibrate_with_the_mass_of_the_air(self, given):
        """In vacuum but for the apparent mass, which is a mass at any stiffness."""
        scale = 1e8
        mass = given.mass_matrix + air(given).apparent_mass
        squares = np.linalg.eigvals(np.linalg.solve(mass, given.stiffness_matrix))
        p = growth_and_frequency(given, np.array([scale]))[0]
        np.testing.assert_allclose(p.imag, np.sqrt(scale * np.sort(squares)), rtol=1e-5)

    def test_heave_of_a_heavy_section_is_damped_by_its_lift(self):
        """Quasi-steady: p = -2 pi C/(2 m*), small against omega (Fung, section 6.9)."""
        mass, omega = 1e4, 0.02
        given = section(mass, 1e9, mass * omega**2, 1e9)
        p = growth_and_frequency(given, np.array([1.0]))[0, 0]
        assert p.real == pytest.approx(-math.pi * theodorsen(omega / 2).real / mass, rel=0.01)

    def test_of_the_papers_section_is_far_below_its_onset(self):
        """Section 5.2 of the paper: no linear flutter is expected with centre and axis in one.

        There is one, at a third of the k* of the instability and next to divergence; at the k* of
        the paper both motions decay.
        """
        found = flutter(PLATE)
        assert divergence_scale(PLATE) < found.scale == pytest.approx(1.93, abs=0.005)
        assert growth_and_frequency(PLATE, np.linspace(4.0, 21.0, 35)).real.max() < -0.01

    def test_a_centre_behind_the_axis_flutters_sooner(self):
        """The same section with its mass 0.1 c further aft."""
        aft = section(9.12 * 6.67, 6.67 + 9.12 * 6.67 * 0.01, 0.183, 1.0, 0.0, 0.1)
        assert flutter(aft).scale > 1.3 * flutter(PLATE).scale


#: Goland's wing, J. Appl. Mech. 12 (1945): per metre, about its elastic axis at 33 % of the chord,
#: the centre of mass at 43 %. Frequencies (rad/s) of its first bending and torsion mode alone.
GOLAND_CHORD, GOLAND_MASS, GOLAND_INERTIA = 1.8288, 35.717, 8.642
GOLAND_HEAVE, GOLAND_PITCH = 49.4923, 87.1081
GOLAND_IMBALANCE = 0.1 * GOLAND_CHORD * GOLAND_MASS
#: Likeness of both shapes, by which the imbalance of the equivalent section is smaller.
COS_PHI = 0.958641


def goland(imbalance=COS_PHI, axis=0.33, damping_ratio=0.0, pair=1) -> Section:
    """Return Goland's section (SI), with a part of its imbalance; of the n-th pair between forks.

    Natural frequencies of a beam between forks go with n^2 in bending, with n in torsion.
    """
    heave, pitch = GOLAND_HEAVE * pair**2, GOLAND_PITCH * pair
    return Section(
        mass=GOLAND_MASS,
        inertia=GOLAND_INERTIA,
        static_imbalance=imbalance * GOLAND_IMBALANCE,
        flexural_stiffness=GOLAND_MASS * heave**2,
        torsional_stiffness=GOLAND_INERTIA * pitch**2,
        flexural_damping=2 * damping_ratio * GOLAND_MASS * heave,
        torsional_damping=2 * damping_ratio * GOLAND_INERTIA * pitch,
        chord=GOLAND_CHORD,
        elastic_axis=axis,
    )


def flutter_speed(section: Section, density: float) -> tuple[float, float]:
    """Return speed (m/s) and angular frequency (rad/s) of flutter."""
    found = flutter(section.in_flow(density, 100.0))
    speed = 100.0 / math.sqrt(found.scale)
    return speed, found.omega * speed / section.chord


class TestSectionsAsTheyAreBuilt:
    """Numbers of a code of its own: Theodorsen's loads by Hankel functions, complex roots in V.

    The beam of Goland flutters at 137.0 m/s and 70.0 rad/s (transfer matrices); its section, which
    has one shape in bending and in torsion, a little earlier.
    """

    @pytest.mark.parametrize(
        ("section", "speed", "omega"),
        [
            (goland(), 133.297, 71.019),
            (goland(1.0), 132.567, None),
            (goland(0.0, 0.5), 126.06, None),  # neither axis nor imbalance
            (goland(0.0), 276.9, None),
            (goland(COS_PHI, 0.5), 97.6, None),
            (goland(1.0, pair=2), 120.575, 227.264),
            (goland(damping_ratio=0.01), 136.198, None),
        ],
        ids=["Goland", "S whole", "about mid-chord", "axis", "S", "second pair", "damped"],
    )
    def test_flutter_of_golands_section(self, section, speed, omega):
        found = flutter_speed(section, 1.225)
        assert found[0] == pytest.approx(speed, rel=4e-4)
        assert omega is None or found[1] == pytest.approx(omega, rel=1e-4)

    @pytest.mark.parametrize(
        ("density", "damping_ratio", "speed"),
        [
            (1.22, 0.0, 76.682),
            (1.22, 0.003, 77.242),
            (1.22, 0.005, 77.600),
            (1.22, 0.01, 78.449),
            (1.22, 0.02, 80.002),
            (1.25, 0.0, 75.773),
            (1.25, 0.005, 76.688),
        ],
    )
    def test_flutter_of_a_bridge_deck_by_its_damping(self, density, damping_ratio, speed):
        found, omega = flutter_speed(deck(damping_ratio), density)
        assert found == pytest.approx(speed, abs=2e-3)
        if damping_ratio == 0.003:
            assert omega / (2 * math.pi) == pytest.approx(0.19358, abs=2e-5)

    def test_divergence(self):
        """Goland 252.35 m/s; the deck 90.466 m/s."""
        for section, density, speed in ((goland(), 1.225, 252.35), (deck(0.01), 1.22, 90.466)):
            scale = divergence_scale(section.in_flow(density, 100.0))
            assert 100.0 / math.sqrt(scale) == pytest.approx(speed, rel=2e-5)

    @pytest.mark.parametrize("section", [goland(damping_ratio=0.01), deck(0.02)])
    def test_the_p_k_method_is_neutral_where_the_k_method_is(self, section):
        here = section.in_flow(1.22, 100.0)
        found = flutter(here)
        p = growth_and_frequency(here, found.scale * np.array([1.02, 1.0, 0.98]))
        place = int(np.argmax(p[1].real))
        assert p[1, place] == pytest.approx(1j * found.omega, abs=1e-7)
        assert p[0, place].real < 0.0 < p[2, place].real

    def test_dampers_in_vacuum_have_their_damping_ratio(self):
        """p = omega (-zeta + i sqrt(1 - zeta^2)), at any stiffness."""
        ratio, heave, pitch = 0.05, math.sqrt(0.4), 3.0
        heavy = Section(
            mass=1e9,
            inertia=1e8,
            flexural_stiffness=4e8,
            torsional_stiffness=9e8,
            flexural_damping=2 * ratio * 1e9 * heave,
            torsional_damping=2 * ratio * 1e8 * pitch,
        )
        turn = complex(-ratio, math.sqrt(1 - ratio**2))
        scales = np.array([0.25, 1.0, 9.0])
        p = growth_and_frequency(heavy, scales)
        np.testing.assert_allclose(p, np.outer(np.sqrt(scales), [heave, pitch]) * turn, rtol=1e-6)

    def test_little_damping_is_near_none(self):
        """The quadratic problem of the dampers against the linear one without."""
        scales = np.geomspace(0.4, 30.0, 20)
        undamped = goland().in_flow(1.225, 100.0)
        damped = goland(damping_ratio=1e-9).in_flow(1.225, 100.0)
        np.testing.assert_allclose(
            growth_and_frequency(damped, scales),
            growth_and_frequency(undamped, scales),
            atol=1e-7,
        )

    @pytest.mark.parametrize("method", [flutter, divergence_scale])
    def test_a_section_in_si_units_is_refused(self, method):
        with pytest.raises(EquisectionError, match=r"chord 1\.8288 m .* section\.in_flow\("):
            method(goland())
