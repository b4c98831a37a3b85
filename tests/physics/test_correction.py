"""Correction for the finite span: limits, identity, divergence and the paper's Table 1."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from equisection.aerodynamics.polar import Polar
from equisection.errors import DivergenceError, IncidenceOutOfRangeError, ReductionError
from equisection.reduction.carried_beam import beam_carried_over
from equisection.reduction.correction import CorrectionFactors, corrected_equilibrium
from equisection.results.correction_dataset import factor_at, factors_to_dataset
from equisection.results.netcdf import read_dataset, write_dataset

POLARS = Path(__file__).parents[2] / "config" / "polars"
SECTION = Polar.read(POLARS / "plate_2d_11136.csv")
BEAM = Polar.read(POLARS / "paper_plate_3d.csv")
PLATE = CorrectionFactors(SECTION, BEAM)
THIN_PLATE = Polar.flat_plate(0.5)
THETA_0 = np.radians(2.5)
RATIO = 0.183  # c^2 k_w/k_theta of the paper

TABLE_1_DEG = [0, 2.5, 5, 10]  # the paper's Table 1, C_L and C_M of 4.7e6 and 15e6 cells
TABLE_1 = {
    "4.7e6": ([0, 0.2554, 0.4945, 0.5727], [0, 0.0585, 0.0804, 0.0687]),
    "15e6": ([0, 0.2613, 0.4826, 0.5684], [0, 0.0602, 0.0697, 0.0659]),
}


def table_1(cells: str) -> Polar:
    """Table 1 with straight lines between its angles, drawn with many points."""
    lift, moment = TABLE_1[cells]
    degrees = np.linspace(0, 10, 401)
    return Polar(
        np.radians(degrees),
        np.full(401, 0.05),
        np.interp(degrees, TABLE_1_DEG, lift),
        np.interp(degrees, TABLE_1_DEG, moment),
        f"Table 1, {cells} cells",
    ).mirrored()


def scaled(polar: Polar, lift: float, moment: float) -> Polar:
    return Polar(polar.incidence, polar.drag, lift * polar.lift, moment * polar.moment, "scaled")


@pytest.mark.parametrize(
    ("k_star", "cells", "twist_deg", "deflection"),
    [
        (21, "4.7e6", 0.164, 0.071), (21, "15e6", 0.166, 0.072),
        (10, "4.7e6", 0.353, 0.158), (10, "15e6", 0.353, 0.160),
        (6.44, "4.7e6", 0.564, 0.263), (6.44, "15e6", 0.554, 0.263),
        (5.5, "4.7e6", 0.671, 0.318), (5.5, "15e6", 0.653, 0.317),
    ],
)  # fmt: skip
def test_equilibria_of_table_1(
    k_star: float, cells: str, twist_deg: float, deflection: float
) -> None:
    """By hand: intersection of k* theta with the straight lines between the table's angles."""
    factors = CorrectionFactors(SECTION, table_1(cells))
    equilibrium = corrected_equilibrium(factors, THETA_0, k_star, RATIO)
    assert np.degrees(equilibrium.twist_rad[0]) == pytest.approx(twist_deg, abs=6e-4)
    assert equilibrium.deflection_chords[0] == pytest.approx(deflection, abs=6e-4)


def test_corrected_section_is_in_equilibrium() -> None:
    """With factor times stiffness on the left and the section's own loads on the right."""
    k_star = np.array([3.0, 5.5, 10.0, 21.0])
    found = corrected_equilibrium(PLATE, THETA_0, k_star, RATIO)
    incidence = THETA_0 + found.twist_rad
    assert found.moment_factor * k_star * found.twist_rad == pytest.approx(
        SECTION.moment_coefficient(incidence), abs=1e-6
    )
    assert found.lift_factor * RATIO * k_star * found.deflection_chords == pytest.approx(
        SECTION.lift_coefficient(incidence), abs=1e-6
    )


def test_factors_of_equal_polars_are_one() -> None:
    same = CorrectionFactors(SECTION, SECTION)
    alpha = np.radians(np.linspace(-12, 12, 49))
    assert same.lift_factor(alpha) == pytest.approx(1, rel=1e-14)
    assert same.moment_factor(alpha) == pytest.approx(1, rel=1e-14)


def test_factors_of_proportional_polars_are_the_proportion() -> None:
    factors = CorrectionFactors(SECTION, scaled(SECTION, 0.8, 0.5))
    alpha = np.radians([-7, 0, 1e-9, 3, 11])
    assert factors.lift_factor(alpha) == pytest.approx(1 / 0.8)
    assert factors.moment_factor(alpha) == pytest.approx(2)


@pytest.mark.parametrize("distance", [1e-3, 1e-5, 1e-7])
def test_factor_is_continuous_through_zero_incidence(distance: float) -> None:
    left, middle, right = PLATE.moment_factor([-distance, 0.0, distance])
    assert middle == pytest.approx(SECTION.moment_slope() / BEAM.moment_slope(), rel=1e-12)
    assert left == pytest.approx(right, rel=1e-7)
    assert abs(right - middle) < 20 * distance


@given(st.floats(0, np.radians(10)))
def test_factors_are_even_and_positive(alpha: float) -> None:
    assert PLATE.lift_factor(-alpha) == pytest.approx(PLATE.lift_factor(alpha), rel=1e-6)
    assert PLATE.moment_factor(alpha) > 0


def test_what_a_solver_leaves_of_zero_changes_no_factor() -> None:
    left = Polar(
        SECTION.incidence, SECTION.drag, SECTION.lift - 7e-5, SECTION.moment + 2e-6, "not quite"
    )
    alpha = np.radians([0.0, 0.3, 1.0, 2.5, 5.0])
    clean, noisy = CorrectionFactors(SECTION, BEAM), CorrectionFactors(left, BEAM)
    np.testing.assert_allclose(noisy.lift_factor(alpha), clean.lift_factor(alpha), rtol=1e-12)
    np.testing.assert_allclose(noisy.moment_factor(alpha), clean.moment_factor(alpha), rtol=1e-12)


def test_beam_coefficient_that_vanishes_alone_is_named() -> None:
    degrees = np.radians([0, 1, 2, 3, 4])
    flat, rising = np.array([0, 0.1, 0.2, 0.2, 0.2]), np.array([0, 0.1, 0.0, -0.1, -0.1])
    beam = Polar(degrees, flat, flat, rising, "beam").mirrored()
    section = Polar(degrees, flat, flat, flat, "section").mirrored()
    factors = CorrectionFactors(section, beam)
    assert factors.lift_factor(np.radians(2)) == pytest.approx(1)
    assert factors.moment_factor(np.radians([1, 2, 3])) == pytest.approx(
        [1, np.nan, np.nan], nan_ok=True
    )
    with pytest.raises(ReductionError, match=r"c_m/C_M .* incidence of 2 deg.* C_M is 0,"):
        corrected_equilibrium(factors, np.radians(2), 50.0, RATIO)


def cambered(zero_deg: float, slope: float, label: str) -> Polar:
    """A moment of its own sign on either side of an angle, the lift of one sign throughout."""
    degrees = np.linspace(-4, 8, 13)
    moment = slope * np.radians(degrees - zero_deg)
    return Polar(np.radians(degrees), 0 * degrees, 0.6 + 0.05 * degrees, moment, label)


CAMBERED = CorrectionFactors(cambered(1.5, 1.2, "section"), cambered(2.5, 0.9, "beam"))


def test_cambered_section_has_no_factor_between_the_zeros_of_its_moments(tmp_path: Path) -> None:
    path = tmp_path / "correction.nc"
    write_dataset(path, factors_to_dataset(CAMBERED))
    made = read_dataset(path)
    incidence, factor = made["incidence_deg"].values, made["moment_factor"].values
    between = (incidence > 1.5) & (incidence < 2.5)
    np.testing.assert_array_equal(np.isnan(factor), between)
    expected = 1.2 / 0.9 * (incidence - 1.5) / (incidence - 2.5)
    np.testing.assert_allclose(factor[~between], expected[~between], rtol=1e-9)
    np.testing.assert_allclose(made["lift_factor"], 1.0)
    assert factor_at(made, "moment_factor", 3.0) == pytest.approx(1.2 / 0.9 * 1.5 / 0.5)
    assert factor_at(made, "moment_factor", 3.5) == pytest.approx(expected[[7, 8]].mean())
    for nowhere in (2.7, 9.0):
        assert np.isnan(factor_at(made, "moment_factor", nowhere))


def test_cambered_section_is_corrected_where_its_equilibrium_has_a_factor() -> None:
    """From theta_0 = 4 deg the twist is nose up, away from the zeros; from 2 deg it is not."""
    found = corrected_equilibrium(CAMBERED, np.radians(4), 5.0, RATIO)
    assert found.twist_rad == pytest.approx(0.9 * np.radians(1.5) / (5.0 - 0.9))
    assert found.moment_factor > 1.2 / 0.9
    with pytest.raises(ReductionError, match="c_m/C_M is not a positive number"):
        corrected_equilibrium(CAMBERED, np.radians(2), 5.0, RATIO)


def test_incidence_beyond_either_polar_is_refused() -> None:
    with pytest.raises(IncidenceOutOfRangeError, match="paper_plate_3d"):
        PLATE.lift_factor(np.radians(11))


@pytest.mark.parametrize("k_star", [1.7, 3.0, 20.0])
def test_thin_plate_twists_as_the_formula_says(k_star: float) -> None:
    """theta = s theta_0/(k* - s) with s = pi/2: diverges at k* = s."""
    thin = CorrectionFactors(THIN_PLATE, THIN_PLATE)
    slope = 0.5 * np.pi
    found = corrected_equilibrium(thin, 0.01, k_star, RATIO)
    assert found.twist_rad == pytest.approx(slope * 0.01 / (k_star - slope), rel=1e-9)
    mirrored = corrected_equilibrium(thin, -0.01, k_star, RATIO)
    assert mirrored.twist_rad == pytest.approx(-found.twist_rad, rel=1e-9)


@pytest.mark.parametrize("k_star", [0.5 * np.pi, 0.5 * np.pi * 0.999, 0.5])
def test_undeflected_state_may_be_unstable(k_star: float) -> None:
    thin = CorrectionFactors(THIN_PLATE, THIN_PLATE)
    with pytest.raises(DivergenceError, match=rf"k\* = {k_star:.4g} .*statically unstable"):
        corrected_equilibrium(thin, 0.0, [21.0, k_star], RATIO)


@pytest.mark.parametrize("k_star", [0.5 * np.pi, 0.5 * np.pi * 0.999, 0.5])
@pytest.mark.parametrize("theta_0", [0.01, -0.01])
def test_divergence_is_an_error_with_k_star_and_range(k_star: float, theta_0: float) -> None:
    thin = CorrectionFactors(THIN_PLATE, THIN_PLATE)
    with pytest.raises(ReductionError, match=rf"k\* = {k_star:.4g} .*-28.65 to 28.65 deg"):
        corrected_equilibrium(thin, theta_0, [21.0, k_star], RATIO)


def test_polar_that_ends_where_the_section_stands_tells_no_divergence() -> None:
    """With c_m < 0 at 0 deg and a polar from 0 deg on: what is below is not known."""
    degrees = np.linspace(0, 8, 9)
    down = Polar(
        np.radians(degrees), 0.1 + 0 * degrees, 0.1 * degrees, 0.02 * degrees - 0.05, "deck"
    )
    with pytest.raises(ReductionError, match=r"too short; .*steady\.incidence_deg") as refused:
        corrected_equilibrium(CorrectionFactors(down, down), 0.0, [0.5], RATIO)
    assert not isinstance(refused.value, DivergenceError)


def half(polar: Polar, residue: float = 0.0) -> Polar:
    """The half from zero incidence on, with what a solver may leave of zero there."""
    kept = polar.incidence >= 0
    lift, moment = polar.lift[kept], polar.moment[kept]
    lift[0] = residue
    return Polar(polar.incidence[kept], polar.drag[kept], lift, moment, polar.label)


def test_factors_are_the_same_whether_the_other_half_is_listed_or_not() -> None:
    alpha = np.radians([-9.0, -0.3, 0.0, 0.3, 1.0, 2.4, 2.5, 7.0, 10.0])
    halves = CorrectionFactors(half(SECTION), half(BEAM))
    np.testing.assert_allclose(halves.lift_factor(alpha), PLATE.lift_factor(alpha), rtol=1e-12)
    np.testing.assert_allclose(halves.moment_factor(alpha), PLATE.moment_factor(alpha), rtol=1e-12)
    np.testing.assert_allclose(halves.lift_factor(-alpha), halves.lift_factor(alpha), rtol=1e-12)
    for theta_0 in (0.3, 2.5):
        ends = [
            corrected_equilibrium(factors, np.radians(theta_0), 6.44, RATIO)
            for factors in (halves, PLATE)
        ]
        assert ends[0].twist_rad == pytest.approx(ends[1].twist_rad, rel=1e-12)


def test_what_a_solver_leaves_of_zero_is_no_camber() -> None:
    alpha = np.radians([1.0, 2.5, 7.0])
    left = CorrectionFactors(half(SECTION), half(BEAM, -4e-4)).lift_factor(alpha)
    np.testing.assert_allclose(left, PLATE.lift_factor(alpha), rtol=0.02)


def test_cambered_polar_is_not_continued() -> None:
    cambered = Polar(BEAM.incidence[3:], BEAM.drag[3:], BEAM.lift[3:], BEAM.moment[3:], "c")
    lifted = Polar(cambered.incidence, cambered.drag, cambered.lift + 0.05, cambered.moment, "c")
    assert lifted.continued is lifted
    with pytest.raises(IncidenceOutOfRangeError):
        CorrectionFactors(lifted, lifted).lift_factor(-0.01)


def test_no_incidence_no_twist() -> None:
    found = corrected_equilibrium(PLATE, 0.0, [5.5, 21.0], RATIO)
    assert np.all(found.twist_rad == 0)
    assert np.all(found.deflection_chords == 0)
    assert found.moment_factor == pytest.approx(SECTION.moment_slope() / BEAM.moment_slope())


@pytest.mark.parametrize("left", [0.0, 1e-5, -1e-5])
def test_what_a_solver_leaves_of_zero_decides_no_equilibrium(left: float) -> None:
    """The moment rises with 1.2/rad to stall at 4 deg: the plate's, a little off at zero."""
    degrees = np.linspace(-10, 10, 41)
    moment = 1.2 * np.radians(np.clip(degrees, -4, 4))
    beam = Polar(
        np.radians(degrees), 0 * moment, moment, moment + left * moment.max(), "a little off"
    )
    factors = CorrectionFactors(SECTION, beam)
    slope = beam.moment_slope()
    found = corrected_equilibrium(factors, 0.0, [1.001 * slope, 5.0], RATIO)
    assert np.all(found.twist_rad == 0.0)
    for k_star in (0.999 * slope, 0.5 * slope):
        with pytest.raises(DivergenceError, match="static divergence"):
            corrected_equilibrium(factors, 0.0, k_star, RATIO)


def test_first_of_several_roots_is_taken() -> None:
    """A moment that levels off and rises again cuts k* theta three times."""
    degrees = np.radians([0, 1, 2, 4, 6, 7, 8, 12])
    moment = np.array([0, 0.02, 0.03, 0.03, 0.05, 0.2, 0.25, 0.26])
    beam = Polar(degrees, 0 * moment, moment, moment, "wavy").mirrored()
    k_star = 1.5
    found = corrected_equilibrium(CorrectionFactors(beam, beam), np.radians(1), k_star, RATIO)
    twist = np.linspace(0, np.radians(11), 20001)
    balance = k_star * twist - beam.moment_coefficient(np.radians(1) + twist)
    crossings = twist[1:][np.diff(np.sign(balance)) != 0]
    assert crossings.size == 3
    assert found.twist_rad[0] == pytest.approx(crossings[0], abs=1e-4)


#: Section and plate on equal cells.
PAIR = CorrectionFactors(
    Polar.read(POLARS / "plate_2d_3132.csv", symmetric=False),
    Polar.read(POLARS / "plate_3d_85284.csv", symmetric=False),
)


def test_beam_carried_over_to_its_own_section_is_itself() -> None:
    """Up to what the solver leaves of zero lift at 0 deg (3.7e-4), which a ratio leaves out."""
    carried = beam_carried_over(PAIR.section, PAIR)
    at = np.radians([1.0, 2.5, 4.0, 5.0, 10.0])
    assert carried.lift_cubic(at) == pytest.approx(PAIR.beam.lift_cubic(at), abs=4e-4)
    assert carried.moment_cubic(at) == pytest.approx(PAIR.beam.moment_cubic(at), abs=4e-4)
    assert carried.drag_coefficient(at) == pytest.approx(PAIR.beam.drag_coefficient(at), rel=1e-4)


def test_ratio_is_kept_whatever_mesh_does_to_both() -> None:
    """A section with 1.1 times the lift and 0.9 times the moment has a beam that has them too."""
    other = scaled(PAIR.section, 1.1, 0.9)
    factors = CorrectionFactors(other, beam_carried_over(other, PAIR))
    at = np.radians([0.0, 0.5, 2.5, 4.0, 7.0])
    assert factors.lift_factor(at) == pytest.approx(PAIR.lift_factor(at), rel=2e-3)
    assert factors.moment_factor(at) == pytest.approx(PAIR.moment_factor(at), rel=2e-3)
    pair, own = (corrected_equilibrium(each, THETA_0, 7.0, RATIO) for each in (PAIR, factors))
    assert own.deflection_chords / pair.deflection_chords == pytest.approx(1.1, rel=0.05)
    assert own.twist_rad < pair.twist_rad


def test_own_ratio_of_lift_is_less_than_that_of_other_cells() -> None:
    """The excess of lift of a mesh is in section and beam and goes out of the ratio of both."""
    own = CorrectionFactors(SECTION, beam_carried_over(SECTION, PAIR))
    mixed = CorrectionFactors(SECTION, Polar.read(POLARS / "paper_plate_3d.csv", symmetric=False))
    at = np.radians(3.1)
    assert 1.15 < own.lift_factor(at) < 1.30 < mixed.lift_factor(at)
    assert own.moment_factor(at) < mixed.moment_factor(at)


def test_pair_that_differs_in_sign_gives_no_factor_there() -> None:
    """The plate's moment is gone at 5 deg, the section's at 7 deg: none is made up in between."""
    at = np.radians([0.0, 2, 4, 6, 8, 10, 12])
    moments = (
        [0, 0.05, 0.05, 0.03, -0.02, -0.05, -0.06],
        [0, 0.04, 0.03, -0.01, -0.03, -0.05, -0.06],
    )
    section, beam = (Polar(at, 0.05 + 0 * at, at, np.array(one), "either") for one in moments)
    pair = CorrectionFactors(section, beam)
    carried = beam_carried_over(section, pair)
    assert carried.moment_cubic(at) == pytest.approx(beam.moment_cubic(at))
    alpha = np.radians([2.0, 4.0, 5.5, 6.0, 6.5, 8.0, 10.0])
    factors = CorrectionFactors(section, carried).moment_factor(alpha)
    assert list(np.isnan(factors)) == [False, False, True, True, True, False, False]


def test_section_of_the_pair_without_drag_is_refused() -> None:
    own = PAIR.section
    section = Polar(own.incidence, np.zeros_like(own.drag), own.lift, own.moment, "bare")
    with pytest.raises(ReductionError, match=r"no drag at -10 deg.*steady\.beam_polar_section"):
        beam_carried_over(PAIR.section, CorrectionFactors(section, PAIR.beam))


def test_pair_with_too_few_incidences_in_common_is_refused() -> None:
    high = Polar(np.radians([5.0, 8, 9, 12]), np.ones(4), np.ones(4), np.ones(4), "high")
    low = Polar(np.radians([0.5, 1, 2, 6]), np.ones(4), np.ones(4), np.ones(4), "low")
    with pytest.raises(ReductionError, match=r"at 2 incidences .* steady\.beam_polar_section"):
        beam_carried_over(low, CorrectionFactors(high, high))
