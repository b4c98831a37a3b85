"""Closed-form modes against published roots, and beam elements against closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.sample_cases import PAPER, altered, beam_with

from equisection.beam.beam import BOUNDARIES, Beam, CrossSection
from equisection.errors import ModesError
from equisection.reduction.reduce import reduce_beam
from equisection.structure.analytic import bending_modes, bending_roots, torsion_modes
from equisection.structure.modes import compute_modes, modes_of_kinds
from equisection.structure.span import gram

SPAN = np.linspace(0.0, 1.0, 401)


DECK = CrossSection(
    bending_rigidity=6.41e14,
    torsional_rigidity=2.014e12,
    mass_per_length=22740.0,
    inertia_per_length=2.47e6,
)


@pytest.mark.parametrize("method", ["beam", "analytic"])
def test_section_as_given_has_the_frequencies_of_its_own_rigidities(method):
    """Between forks: (pi/L)^2 sqrt(EI/m) n^2 and (pi/L) sqrt(GJ/I) n, in rad/s."""
    deck = Beam(
        chord=31.0, length=1624.0, thickness=4.0, boundary="pinned-pinned", cross_section=DECK
    )
    modes = compute_modes(deck, method, (1, 60, 1), count=8)
    n = np.arange(1, 3)
    wave = math.pi / 1624.0
    bending = wave**2 * math.sqrt(6.41e14 / 22740.0) * n**2 / (2 * math.pi)
    torsion = wave * math.sqrt(2.014e12 / 2.47e6) * n / (2 * math.pi)
    assert modes.bending(2).frequency == pytest.approx(bending, rel=1e-4)
    assert modes.torsion(2).frequency == pytest.approx(torsion, rel=1e-4)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_section_of_a_plate_given_as_it_is_changes_nothing(boundary):
    """Modes and equivalent section, with springs at the root too."""
    plate = beam_with(boundary)
    given = altered(
        plate,
        youngs_modulus=1.0,
        density=1.0,
        cross_section=CrossSection(
            bending_rigidity=plate.bending_rigidity,
            torsional_rigidity=plate.torsional_rigidity,
            mass_per_length=plate.mass_per_length,
            inertia_per_length=plate.inertia_per_length,
        ),
    )
    modes, same = (compute_modes(each, "beam", (1, 30, 1), count=8) for each in (plate, given))
    np.testing.assert_allclose(same.frequency, modes.frequency, rtol=1e-9)
    assert same.kind == modes.kind
    first, second = reduce_beam(plate, modes), reduce_beam(given, same)
    for name in ("torsional_stiffness", "flexural_stiffness", "inertia", "mass"):
        assert getattr(second, name) == pytest.approx(getattr(first, name), rel=1e-6)


@pytest.mark.parametrize(
    ("ends", "roots"),
    [
        # Blevins, Formulas for Natural Frequency and Mode Shape, table 8-1.
        (("clamped", "free"), [1.87510407, 4.69409113, 7.85475744, 10.99554073]),
        (("clamped", "clamped"), [4.73004074, 7.85320462, 10.9956078, 14.1371655]),
        (("clamped", "pinned"), [3.92660231, 7.06858275, 10.21017612, 13.35176878]),
        (("pinned", "pinned"), [np.pi, 2 * np.pi, 3 * np.pi, 4 * np.pi]),
    ],
)
def test_bending_roots_of_blevins(ends, roots):
    assert bending_roots(ends, 0.0, 4) == pytest.approx(roots, rel=1e-8)


def test_a_root_spring_runs_from_hinge_to_clamp():
    ends = ("spring", "free")
    hinge = bending_roots(ends, 0.0, 4)
    assert hinge == pytest.approx([0.0, 3.92660231, 7.06858275, 10.21017612], abs=1e-7)
    assert bending_roots(ends, 1e9, 4) == pytest.approx(bending_roots(("clamped", "free"), 0, 4))
    roots = np.array([bending_roots(ends, spring, 4) for spring in (0.01, 0.1, 1.0, 10.0, 100.0)])
    assert (np.diff(roots, axis=0) > 0).all()
    # A soft spring carries the beam as a rigid body: omega^2 = k_b/(rho c h L^3/3).
    for spring in (1e-4, 1e-12, 1e-20):
        first = bending_roots(ends, spring, 2)
        assert first[0] ** 4 == pytest.approx(3 * spring, rel=1e-4)
        assert first[1] == pytest.approx(3.92660231, rel=1e-4)


def test_a_soft_torsion_spring_turns_the_beam_as_a_rigid_body():
    plate = altered(beam_with("spring-root"), root_torsional_stiffness=1e-3)
    frequency, shape = torsion_modes(plate, SPAN, 1)
    inertia = plate.inertia_per_length * plate.length
    assert frequency == pytest.approx([np.sqrt(1e-3 / inertia) / (2 * np.pi)], rel=1e-3)
    assert np.ptp(shape) < 1e-3


def test_sprung_shapes_meet_the_root_conditions():
    plate = beam_with("spring-root")
    z = np.linspace(0.0, 1.0, 20001)
    step = z[1]
    _, g = bending_modes(plate, z, 3)
    slope = (-3 * g[:, 0] + 4 * g[:, 1] - g[:, 2]) / (2 * step)
    bend = (2 * g[:, 0] - 5 * g[:, 1] + 4 * g[:, 2] - g[:, 3]) / step**2
    spring = plate.root_bending_stiffness * plate.length / plate.bending_rigidity
    assert bend == pytest.approx(spring * slope, rel=1e-4)
    _, f = torsion_modes(plate, z, 3)
    rate = (-3 * f[:, 0] + 4 * f[:, 1] - f[:, 2]) / (2 * step)
    spring = plate.root_torsional_stiffness * plate.length / plate.torsional_rigidity
    assert rate == pytest.approx(spring * f[:, 0], rel=1e-5)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_modes_of_one_kind_are_orthogonal(boundary):
    for solve in (bending_modes, torsion_modes):
        _, shape = solve(beam_with(boundary), SPAN, 4)
        mass = gram(SPAN, shape, shape)
        size = np.sqrt(np.diag(mass))
        assert mass / np.outer(size, size) == pytest.approx(np.eye(4), abs=1e-7)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_elements_agree_with_closed_form(boundary):
    plate = beam_with(boundary)
    exact = compute_modes(plate, "analytic", (1, 60, 1), 8)
    beam = compute_modes(plate, "beam", (1, 60, 1), 8)
    assert beam.kind == exact.kind
    assert beam.frequency == pytest.approx(exact.frequency, rel=5e-6)
    assert beam.shape == pytest.approx(exact.shape, abs=2e-4)
    assert (beam.frequency >= exact.frequency * (1 - 1e-7)).all()  # Rayleigh: from above


@pytest.mark.parametrize("boundary", ["clamped-free", "spring-root"])
def test_element_frequencies_converge_with_the_fourth_power(boundary):
    plate = beam_with(boundary)
    exact = compute_modes(plate, "analytic", (1, 8, 1), 6)
    error = [
        compute_modes(plate, "beam", (1, n, 1), 6).frequency / exact.frequency - 1.0
        for n in (8, 16)
    ]
    order = np.log2(error[0] / error[1])[2:]  # the lowest are at rounding already
    assert order == pytest.approx(np.full(4, 4.0), abs=0.3)


@pytest.mark.parametrize("method", ["beam", "analytic"])
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_shapes_are_normalised_and_signed(method, boundary):
    modes = compute_modes(beam_with(boundary), method, (1, 40, 1), 8)
    assert np.abs(modes.shape).max(axis=1) == pytest.approx(np.ones(8))
    free = np.abs(modes.shape[:, -1]) > 1e-6
    assert (modes.shape[free, -1] > 0).all()
    for shape in modes.shape[~free]:
        assert shape[np.argmax(np.abs(shape) > 1 - 1e-6)] > 0
    assert (np.diff(modes.frequency) >= 0).all()


def test_what_is_missing_is_named():
    modes = compute_modes(PAPER, "analytic", (1, 20, 1), 3)
    assert modes.bending(2).frequency == pytest.approx(modes.frequency[:2])
    with pytest.raises(ModesError, match="4 torsion modes are needed and 1 are among the 3"):
        modes.torsion(4)
    with pytest.raises(ModesError, match=r"modes\.method"):
        compute_modes(PAPER, "guess")
    with pytest.raises(ModesError, match="'beam' or 'analytic'"):
        compute_modes(beam_with("one-fork"), "solid", (4, 8, 1), 4)


@pytest.mark.parametrize("method", ["beam", "analytic"])
@pytest.mark.parametrize("aspect", [16, 40])
def test_a_slender_plate_has_the_torsion_modes_that_are_wanted(method, aspect):
    plate = altered(PAPER, length=aspect * PAPER.chord)
    with pytest.raises(ModesError, match="4 torsion modes are needed"):
        compute_modes(plate, method, (1, 60, 1), 12).torsion(4)
    modes = modes_of_kinds(plate, method, (1, 60, 1), (4, 4), 12)
    assert len(modes.torsion(4).frequency) == 4
    assert modes.kind[-1] == "torsion"  # no more than are needed
    exact = compute_modes(plate, "analytic", (1, 60, 1), len(modes.kind))
    assert modes.kind == exact.kind
    assert modes.frequency == pytest.approx(exact.frequency, rel=1e-3)


@pytest.mark.parametrize("method", ["beam", "analytic"])
def test_a_plate_whose_lowest_modes_hold_what_is_wanted_keeps_them(method):
    asked = compute_modes(PAPER, method, (1, 40, 1), 12)
    modes = modes_of_kinds(PAPER, method, (1, 40, 1), (4, 4), 12)
    assert modes.kind == asked.kind
    assert (modes.frequency == asked.frequency).all()
    assert (modes.shape == asked.shape).all()


def test_modes_that_a_mesh_cannot_have_are_refused_by_the_keys_that_ask_for_them():
    with pytest.raises(ModesError, match=r"lower structure\.bending_modes or refine structure\.el"):
        modes_of_kinds(PAPER, "beam", (1, 2, 1), (5, 1), 10)
