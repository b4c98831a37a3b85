"""The solid plate: Table 2, limits of slender bars, symmetry, convergence, classes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.linalg import eigh
from skfem import Basis, BilinearForm, ElementHex2, ElementVector, MeshHex
from skfem.helpers import dot
from skfem.models.elasticity import lame_parameters, linear_elasticity
from tests.sample_cases import PAPER, altered

from equisection.beam.beam import torsion_series_factor
from equisection.errors import ModesError
from equisection.structure.classify import KINDS, classify
from equisection.structure.mode_set import ModeSet, frequency_constants
from equisection.structure.modes import compute_modes, mesh_study, modes_of_kinds
from equisection.structure.slenderness import most_slender
from equisection.structure.solid import solid_modes
from equisection.structure.span import gram

COARSE = (12, 44, 1)


@cache
def coarse_modes() -> ModeSet:
    return compute_modes(PAPER, "solid", COARSE, 12)


def test_frequency_constants_of_table_2():
    # Table 2, row of 8.5e3 elements (24 x 89 in plan, four through the thickness).
    modes = compute_modes(PAPER, "solid", (24, 89, 2), 12)
    constants = frequency_constants(modes, PAPER)
    assert modes.kind[:5] == ("bending", "bending", "torsion", "bending", "torsion")
    assert constants[:5] == pytest.approx([2.44e-4, 1.52e-3, 1.77e-3, 4.28e-3, 5.49e-3], rel=5e-3)
    # The coarse mesh that other tests use is as good as this one for the first eight.
    assert coarse_modes().frequency[:8] == pytest.approx(modes.frequency[:8], rel=4e-3)
    assert len(modes.torsion(4).frequency) == 4


def test_order_and_kinds_of_the_papers_plate():
    modes = coarse_modes()
    assert modes.kind[:8] == (
        *("bending", "bending", "torsion", "bending", "torsion", "in-plane", "bending", "torsion"),
    )
    beam = compute_modes(PAPER, "analytic", COARSE, 12)
    # A clamp that holds warping and Poisson contraction stiffens both, torsion the more.
    assert 1.0 < modes.bending(1).frequency / beam.bending(1).frequency < 1.03
    assert 1.05 < modes.torsion(1).frequency / beam.torsion(1).frequency < 1.08


def test_folding_by_symmetry_gives_the_modes_of_the_whole_mesh():
    plate = altered(PAPER, length=0.2, thickness=0.02)
    elements = (3, 4, 2)  # an odd count puts an element on the mirror
    folded = solid_modes(plate, elements, 10).frequency
    mesh = MeshHex.init_tensor(
        np.linspace(0, plate.chord, 4), np.linspace(0, plate.thickness, 3), np.linspace(0, 0.2, 5)
    )
    basis = Basis(mesh, ElementVector(ElementHex2()), intorder=4)
    stiffness = linear_elasticity(*lame_parameters(3.3e9, 0.35)).assemble(basis).toarray()
    mass = 1180.0 * BilinearForm(lambda u, v, _: dot(u, v)).assemble(basis).toarray()
    free = np.flatnonzero(basis.doflocs[2] > 1e-9)
    block = np.ix_(free, free)
    whole = eigh(stiffness[block], mass[block], eigvals_only=True, subset_by_index=[0, 9])
    assert folded == pytest.approx(np.sqrt(whole) / (2 * np.pi), rel=1e-7)


def test_modes_of_the_solid_are_even_or_odd_in_the_chord():
    solid = solid_modes(PAPER, (6, 22, 1), 6)
    u_y = solid.displacement[..., 1]
    found = classify(solid.chord_position, solid.span, solid.displacement)
    for mode, kind in enumerate(found.kind):
        mirrored = u_y[mode, :, ::-1]
        if kind in ("bending", "torsion"):
            sign = 1.0 if kind == "bending" else -1.0
            assert mirrored == pytest.approx(sign * u_y[mode], abs=1e-6 * np.abs(u_y[mode]).max())
        assert found.share[mode, KINDS.index(kind)] > 0.9
    assert found.share.sum(axis=1) == pytest.approx(np.ones(6))


def test_frequencies_follow_stiffness_mass_and_size():
    # omega ~ sqrt(E/rho)/length for similar bodies.
    elements = (4, 8, 1)
    reference = compute_modes(PAPER, "solid", elements, 5).frequency
    stiff = altered(PAPER, youngs_modulus=4 * PAPER.youngs_modulus, density=PAPER.density / 9)
    assert compute_modes(stiff, "solid", elements, 5).frequency == pytest.approx(6 * reference)
    large = altered(PAPER, chord=0.2, length=0.74, thickness=0.008)
    assert compute_modes(large, "solid", elements, 5).frequency == pytest.approx(reference / 2)


def test_a_slender_bar_bends_as_euler_and_bernoulli_have_it():
    slender = altered(PAPER, chord=0.01, length=0.8, poisson_ratio=0.3)
    solid = compute_modes(slender, "solid", (2, 80, 1), 4)
    exact = compute_modes(slender, "analytic", (2, 80, 1), 4)
    assert solid.bending(2).frequency == pytest.approx(exact.bending(2).frequency, rel=2e-3)
    assert solid.kind[0] == "bending"


def test_a_plate_keeps_its_modes_until_it_is_too_thin_for_rounding():
    """The lowest frequency over h does not change; beyond the bound it would, by a multiple."""
    elements = (2, 8, 1)
    thickest, thinnest = PAPER.length / 300.0, 1.001 * PAPER.length / most_slender(elements[2])
    first = [
        solid_modes(altered(PAPER, thickness=h), elements, 1).frequency[0] / h
        for h in (thickest, thinnest)
    ]
    assert first[1] == pytest.approx(first[0], rel=2e-3)
    with pytest.raises(ModesError, match=r"as long as thick; .* up to 819, .* use method 'beam'"):
        solid_modes(altered(PAPER, thickness=0.99 * thinnest), elements, 1)


def test_a_slender_bar_twists_as_saint_venant_has_it():
    # Far from a clamp warping is free; J is then the exact series and the inertia counts h^2.
    bar = altered(PAPER, chord=0.012, length=0.8, boundary="pinned-pinned")
    solid = compute_modes(bar, "solid", (6, 60, 4), 16).torsion(1).frequency
    thin_strip = compute_modes(bar, "analytic", (6, 60, 4), 16).torsion(1).frequency
    inertia = 1.0 + (bar.thickness / bar.chord) ** 2
    expected = thin_strip * np.sqrt(torsion_series_factor(bar.thickness / bar.chord) / inertia)
    assert solid == pytest.approx(expected, rel=2e-3)


def test_in_plane_bending_is_the_beam_turned_on_its_side():
    slim = altered(PAPER, chord=0.02, length=0.6, poisson_ratio=0.0)
    modes = compute_modes(slim, "solid", (2, 40, 1), 6)
    first = modes.frequency[modes.kind.index("in-plane")]
    assert first / modes.bending(1).frequency[0] == pytest.approx(0.02 / 0.004, rel=5e-3)


def test_extension_and_chordwise_modes_are_told_apart():
    stub = altered(PAPER, length=0.12, thickness=0.016)
    modes = compute_modes(stub, "solid", (8, 8, 1), 10)
    assert "chordwise" in modes.kind
    assert "extension" in modes.kind
    bar = np.sqrt(stub.youngs_modulus / stub.density) / (4 * stub.length)
    extension = modes.frequency[modes.kind.index("extension")]
    assert extension == pytest.approx(bar, rel=0.05)


def test_a_slender_solid_has_the_torsion_modes_that_are_wanted():
    plate = altered(PAPER, length=1.5)
    modes = modes_of_kinds(plate, "solid", (4, 40, 1), (4, 4), 12)
    assert len(modes.kind) > 12
    beam = compute_modes(plate, "analytic", (4, 40, 1), 30)
    assert modes.torsion(4).frequency == pytest.approx(beam.torsion(4).frequency, rel=0.05)


def test_the_papers_plate_keeps_its_twelve_lowest_modes_to_the_last_digit():
    asked = compute_modes(PAPER, "solid", (4, 15, 1), 12)
    modes = modes_of_kinds(PAPER, "solid", (4, 15, 1), (4, 4), 12)
    assert modes.kind == asked.kind
    assert (modes.frequency == asked.frequency).all()
    assert (modes.shape == asked.shape).all()


def test_section_shapes_are_orthogonal_like_those_of_a_beam():
    modes = coarse_modes()
    for part in (modes.bending(4), modes.torsion(4)):
        mass = gram(part.span, part.shape, part.shape)
        size = np.sqrt(np.diag(mass))
        assert mass / np.outer(size, size) == pytest.approx(np.eye(4), abs=2e-3)


def test_nested_meshes_bring_every_frequency_down():
    # A conforming Galerkin space that contains another has no higher frequency.
    study = mesh_study(PAPER, [(4, 11, 1), (8, 22, 1), (16, 44, 1)], count=8)
    assert (study.change < 0.0).all()
    assert (np.abs(study.change[1]) < np.abs(study.change[0])).all()
    assert np.abs(study.change[1]).max() < 0.02
    assert study.error[-1] == pytest.approx(np.zeros(8))
    assert study.kind == coarse_modes().kind[:8]


def test_modes_that_are_known_of_the_finest_mesh_are_not_computed_again():
    levels = [(2, 6, 1), (4, 11, 1)]
    known = compute_modes(PAPER, "solid", levels[-1], 10)
    twice = replace(known, frequency=2.0 * known.frequency)
    study, of_known = (mesh_study(PAPER, levels, solved=modes) for modes in (None, twice))
    assert of_known.frequency[0] == pytest.approx(study.frequency[0], rel=1e-9)
    assert of_known.frequency[1] == pytest.approx(2.0 * study.frequency[1], rel=1e-9)
    coarser = mesh_study(PAPER, levels[:1], solved=twice)
    assert coarser.frequency[0] == pytest.approx(study.frequency[0], rel=1e-9)


def test_a_mesh_study_pairs_modes_that_a_coarse_mesh_has_in_another_order():
    # At L/c = 6 the fourth bending mode passes the second of torsion as the mesh is refined.
    plate = altered(PAPER, length=0.6)
    levels = [(4, 15, 1), (6, 24, 1)]
    coarse, fine = (compute_modes(plate, "solid", level, 8) for level in levels)
    assert coarse.kind != fine.kind

    study = mesh_study(plate, levels)

    assert study.kind == fine.kind
    assert study.frequency[1] == pytest.approx(fine.frequency, rel=1e-12)
    for kind in ("bending", "torsion", "in-plane"):
        of_kind = [i for i, this in enumerate(fine.kind) if this == kind]
        alike = coarse.frequency[[i for i, this in enumerate(coarse.kind) if this == kind]]
        assert study.frequency[0, of_kind] == pytest.approx(alike, rel=1e-9)
    assert (np.abs(study.change) < 0.05).all()


def test_a_mesh_without_a_mode_of_the_finest_leaves_it_empty_and_says_so(caplog):
    plate = altered(PAPER, length=0.6)
    study = mesh_study(plate, [(1, 2, 1), (1, 15, 1)], "beam", count=8)
    assert study.kind.count("bending") > 4  # what two elements can have
    assert np.isnan(study.frequency[0]).sum() == study.kind.count("bending") - 4
    assert np.isfinite(study.frequency[1]).all()
    assert "structure.mesh_study: the mesh of 1 x 2 x 1 elements lacks modes of bending" in (
        caplog.text
    )


def test_a_fork_is_softer_than_a_clamp():
    frequency = {
        boundary: compute_modes(altered(PAPER, boundary=boundary), "solid", (6, 22, 1), 6)
        for boundary in ("pinned-pinned", "clamped-pinned", "clamped-clamped")
    }
    first = [modes.bending(1).frequency[0] for modes in frequency.values()]
    assert first == sorted(first)
    fork = frequency["pinned-pinned"]
    # Forks leave warping free, so that the first shapes are the sines of a beam.
    half_sine = np.sin(np.pi * fork.span)
    assert fork.bending(1).shape[0] == pytest.approx(half_sine, abs=1e-3)
    assert fork.torsion(1).shape[0] == pytest.approx(half_sine, abs=1e-3)


def test_all_modes_in_the_plane_of_a_thick_bar_are_found():
    """As many as a beam with shear and rotary inertia has, more than are asked for at first."""
    bar = altered(PAPER, length=4.0, chord=0.1, thickness=0.045, boundary="clamped-clamped")
    modes = compute_modes(bar, "solid", (2, 40, 1), 24)
    in_plane = modes.frequency[[kind == "in-plane" for kind in modes.kind]]
    waves = np.array([4.73004, 7.85320, 10.99561, *((np.arange(4, 30) + 0.5) * np.pi)])
    speed = np.sqrt(bar.youngs_modulus / bar.density)  # of sound along the bar (m/s)
    slender = waves**2 * speed * bar.chord / np.sqrt(12.0) / (2.0 * np.pi * bar.length**2)
    # Timoshenko (1921), to first order in (k c)^2, with the shear factor 5/6 of a rectangle
    shear = 2.0 * (1.0 + bar.poisson_ratio) / (5.0 / 6.0)
    beam = slender * (1.0 - (waves * bar.chord / bar.length) ** 2 / 24.0 * (1.0 + shear))
    assert in_plane.size > 4
    assert in_plane == pytest.approx(beam[: in_plane.size], rel=0.01)
    assert modes.frequency[-1] < beam[in_plane.size]
