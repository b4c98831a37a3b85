"""Exact growth and frequency in the p-plane: limits, p-k at flutter, published roots."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.physics.test_beam_flutter import AIR, modes_of
from tests.physics.test_beam_flutter import goland as golands_beam
from tests.physics.test_linear_flutter import HODGES_PIERCE, PLATE, air, deck, goland, section

from equisection.aerodynamics.indicial import (
    JONES_AMPLITUDES,
    LAG_RATES,
    theodorsen,
    theodorsen_of_growing,
    theodorsen_slope,
)
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.errors import EquisectionError
from equisection.motion.beam_flutter import beam_growth
from equisection.motion.exact_roots import divergence_rate, exact_growth_and_frequency
from equisection.motion.linear_flutter import divergence_scale, flutter, growth_and_frequency
from equisection.structure.modal_matrices import modal_matrices

SECTIONS = {
    "textbook": HODGES_PIERCE,
    "plate": PLATE,
    "Goland": goland().in_flow(AIR, 100.0),
    "damped deck": deck(0.01).in_flow(1.22, 80.0),
}
each_section = pytest.mark.parametrize("given", SECTIONS.values(), ids=SECTIONS)


class TestTheodorsensFunctionOfArbitraryMotion:
    @pytest.mark.parametrize("k", [0.01, 0.3, 2.0, 40.0])
    def test_is_theodorsens_on_the_imaginary_axis(self, k):
        assert theodorsen_of_growing(1j * k) == pytest.approx(complex(theodorsen(k)), rel=1e-13)

    def test_limits_of_slow_and_fast_growth(self):
        assert theodorsen_of_growing(1e-9) == pytest.approx(1.0, abs=1e-7)
        assert theodorsen_of_growing(1e6) == pytest.approx(0.5, abs=1e-6)

    @pytest.mark.parametrize("z", [0.3 + 0.2j, 0.05 + 0.1j, 1.5])
    def test_jones_fitted_the_same_function(self, z):
        """z times the transform of Wagner's function, of which Jones's form is within 2 %."""
        lags = zip(JONES_AMPLITUDES, LAG_RATES, strict=True)
        jones = 1 - sum(a * z / (z + rate / 2) for a, rate in lags)
        assert theodorsen_of_growing(z) == pytest.approx(jones, rel=0.02)

    @pytest.mark.parametrize("z", [0.3j, 0.1 + 0.5j, -0.2 + 0.4j, 2.0])
    def test_slope_is_the_limit_of_differences(self, z):
        step = 1e-5
        rise = theodorsen_of_growing(z + step) - theodorsen_of_growing(z - step)
        assert theodorsen_slope(z) == pytest.approx(rise / (2 * step), rel=1e-7)

    def test_values_across_the_cut_are_conjugate(self):
        above, below = theodorsen_of_growing(-0.3 + 1e-12j), theodorsen_of_growing(-0.3 - 1e-12j)
        assert above == pytest.approx(below.conjugate())
        assert abs(above - below) > 0.5

    @pytest.mark.parametrize("axis", [-0.25, 0.0, 0.1])
    def test_loads_are_those_of_harmonic_motion_and_their_slope(self, axis):
        plate, p, step = ThinAirfoil(axis), 0.1 + 0.7j, 1e-5
        np.testing.assert_allclose(
            plate.influence_of_growing(0.7j), plate.influence(0.7), rtol=1e-13
        )
        rise = plate.influence_of_growing(p + step) - plate.influence_of_growing(p - step)
        np.testing.assert_allclose(plate.influence_slope(p), rise / (2 * step), rtol=1e-7)


class TestSection:
    @each_section
    def test_each_is_a_root_of_the_equations(self, given):
        scales = flutter(given).scale * np.geomspace(30.0, 0.6, 12)
        for scale, roots in zip(scales, exact_growth_and_frequency(given, scales), strict=True):
            for p in roots:
                left = scale * given.stiffness_matrix - air(given).influence_of_growing(p)
                matrix = p * p * given.mass_matrix + left
                matrix += p * math.sqrt(scale) * given.damping_matrix
                assert abs(np.linalg.det(matrix)) < 1e-10 * np.abs(left).max() ** 2

    @each_section
    def test_p_k_is_exact_at_flutter_and_nowhere_else(self, given):
        found = flutter(given)
        scales = found.scale * np.array([1 / 0.9**2, 1.0, 0.8])
        exact = exact_growth_and_frequency(given, scales)
        approximate = growth_and_frequency(given, scales)
        assert exact[1, 1] == pytest.approx(1j * found.omega, abs=1e-9)
        assert approximate[1, 1] == pytest.approx(exact[1, 1], abs=1e-8)
        # Both agree in the sign; at nine tenths of the speed p-k has 8 to 20 % too little decay.
        short = 1 - approximate[0, 1].real / exact[0, 1].real
        assert 0.08 < short < 0.2
        assert approximate[2, 1].real > 0 < exact[2, 1].real

    def test_small_growth_is_that_of_the_loads_at_the_frequency(self):
        """A heavy section: both are first order in 1/m*, and their difference is second order."""
        differences = []
        for mass in (1e4, 1e5):
            given = section(mass, mass / 9.12, 0.03 * mass, 0.5 * mass)
            exact = exact_growth_and_frequency(given, np.array([1.0]))
            p_k = growth_and_frequency(given, np.array([1.0]))
            np.testing.assert_allclose(exact.real, p_k.real, rtol=300 / mass)
            differences.append(np.abs(exact - p_k).max())
        assert differences[0] / differences[1] == pytest.approx(100, rel=0.05)

    @each_section
    def test_jones_states_are_near_it_and_no_nearer_than_their_fit(self, given):
        """Eigenvalues with Jones's states: C(p/2) in error by 2 %, growth by as much of the loads.

        The states are p z_i = rate_i (alpha_34 - z_i), loads r (0.5 alpha_34 + sum A_i z_i).
        """
        scale = 0.9 * flutter(given).scale
        exact = exact_growth_and_frequency(given, np.array([scale]))[0]
        plate = air(given)
        by_place, by_rate = plate._circulatory

        def jones(p):
            lags = zip(JONES_AMPLITUDES, LAG_RATES, strict=True)
            lag = 1 - sum(a * p / (p + rate) for a, rate in lags)
            loads = p * p * plate._apparent_mass + p * plate._apparent_rate
            loads = loads + lag * (by_place + p * by_rate)
            matrix = p * p * given.mass_matrix + scale * given.stiffness_matrix - loads
            return np.linalg.det(matrix + p * math.sqrt(scale) * given.damping_matrix)

        p = complex(exact[1])
        for _ in range(30):  # Newton's method with a difference
            p -= jones(p) * 2e-6 / (jones(p + 1e-6) - jones(p - 1e-6))
        assert 0.0 < abs(p - exact[1]) < 0.02 * abs(p)
        assert p.real > 0.0

    @each_section
    def test_result_does_not_depend_on_what_else_is_asked_for(self, given):
        scales = flutter(given).scale * np.geomspace(40.0, 0.6, 40)
        dense = exact_growth_and_frequency(given, scales)
        few = exact_growth_and_frequency(given, scales[[30, 2, 17]])
        np.testing.assert_allclose(few, dense[[30, 2, 17]], rtol=1e-9)
        assert np.abs(np.diff(dense, axis=0)).max() < 0.2 * np.abs(dense[0]).max()

    def test_dampers_in_vacuum_have_their_damping_ratio(self):
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
        p = exact_growth_and_frequency(heavy, np.array([1.0]))[0]
        np.testing.assert_allclose(p, np.array([heave, pitch]) * turn, rtol=1e-6)

    def test_a_motion_that_ceases_to_turn_has_no_root(self):
        """Light heave on a soft spring, and pitch that diverges in the place of flutter."""
        light = section(0.1, 0.05, 0.02, 40.0, -0.25, -0.25)
        p = exact_growth_and_frequency(light, np.array([1e3, 1e-3]))
        assert np.isfinite(p[0]).all()
        assert np.isnan(p[1, 0])
        p = exact_growth_and_frequency(PLATE, np.array([0.1]))[0]
        assert np.isnan(p[1])
        assert divergence_rate(PLATE, 0.1) > 0.09

    def test_si_units_are_refused(self):
        with pytest.raises(EquisectionError, match=r"section\.in_flow\("):
            exact_growth_and_frequency(goland(), np.array([1.0]))


class TestDivergence:
    @each_section
    def test_grows_from_nothing_at_its_speed(self, given):
        scale = divergence_scale(given)
        assert divergence_rate(given, scale) == 0.0
        slow, fast = (divergence_rate(given, part * scale) for part in (0.999, 0.9))
        assert 0.0 < slow < 0.02 * fast

    def test_fast_divergence_is_that_of_the_apparent_mass(self):
        """Without stiffness, damping or mass to speak of p does not depend on the speed."""
        given = section(60.0, 7.0, 1e-9, 1e-9)
        p = divergence_rate(given, 1.0)
        matrix = p * p * given.mass_matrix - ThinAirfoil().influence_of_growing(p)
        assert abs(np.linalg.det(matrix)) < 1e-9 * 60 * 7


class TestBeam:
    def test_goland_beyond_flutter_by_transfer_matrices(self):
        """3.70 + 68.2i (1/s) at 150 m/s: ContourRoots, tutorial 11, no modes and no fit of C.

        Its centre of mass is 0.183 m behind the axis, a tenth of the chord to three digits; it has
        flutter at 136.983977 m/s.
        """
        beam = golands_beam(mass_axis=0.33 + 0.183 / 1.8288)
        matrices = modal_matrices(beam, modes_of(beam, 6), 6, 6)
        args = (matrices, beam.chord, beam.elastic_axis, AIR)
        roots = beam_growth(*args, np.array([120.0, 136.983977, 150.0]))
        growing = roots[2, np.nanargmax(roots[2].real)]
        assert growing.real == pytest.approx(3.70, abs=0.005)
        assert growing.imag == pytest.approx(68.2, abs=0.05)
        assert np.nanmax(roots[0].real) < 0.0
        assert np.nanmax(roots[1].real) == pytest.approx(0.0, abs=1e-4)

    def test_still_air(self):
        """46, 93, 233 and 337 rad/s (ContourRoots, tutorial 11)."""
        beam = golands_beam()
        matrices = modal_matrices(beam, modes_of(beam, 6), 6, 6)
        roots = beam_growth(matrices, beam.chord, beam.elastic_axis, AIR, np.array([0.1]))[0]
        np.testing.assert_allclose(roots.imag[:4], [46, 93, 233, 337], atol=0.5)
