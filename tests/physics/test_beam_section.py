"""A beam reduced in one step, and from there to its onset."""

from __future__ import annotations

import warnings

import pytest
from tests.plate_section import DENSITY, PLATE, POLAR

import equisection as eq
from equisection.beam.beam import CrossSection
from equisection.errors import ModesError

MEMBERS = ("torsional_stiffness", "flexural_stiffness", "inertia", "mass", "chord")


def test_section_of_a_cantilever_is_the_closed_form():
    """k_theta = G J (pi/2L)^2, k_w = E I (1.875/L)^4, mass and inertia those per length."""
    section = eq.reduce(eq.Beam(), method="analytic")
    for name in MEMBERS:
        assert getattr(section, name) == pytest.approx(getattr(PLATE, name), rel=1e-4), name


def test_beam_elements_come_to_the_closed_form():
    section = eq.reduce(eq.Beam(), method="beam")
    for name in MEMBERS:
        assert getattr(section, name) == pytest.approx(getattr(PLATE, name), rel=1e-4), name


def test_solid_comes_from_above_and_is_stiffer_since_the_clamp_restrains_warping():
    """Conforming elements are too stiff, the less the finer they are."""
    coarse, fine = (eq.reduce(eq.Beam(), elements=mesh) for mesh in ((4, 15, 1), (8, 30, 1)))
    for name in ("torsional_stiffness", "flexural_stiffness"):
        assert getattr(coarse, name) > getattr(fine, name) > getattr(PLATE, name), name
    assert fine.mass == pytest.approx(PLATE.mass, rel=1e-3)
    assert fine.inertia == pytest.approx(PLATE.inertia, rel=1e-3)


def test_onset_of_the_papers_plate_from_its_beam():
    """By an independent assembly of the same section, polar and lags."""
    section = eq.reduce(eq.Beam(), method="analytic")
    onset = eq.critical_speed(
        section,
        POLAR,
        incidence_deg=2.5,
        speed=(10.0, 80.0),
        density=DENSITY,
        lags=eq.SeparationLags(2.58, 0.64, 0.55),
    )
    assert float(onset.k_star) == pytest.approx(8.710, abs=1e-3)


DECK = CrossSection(
    bending_rigidity=6.41e14,
    torsional_rigidity=2.014e12,
    mass_per_length=22740.0,
    inertia_per_length=2.47e6,
)


@pytest.mark.parametrize(
    ("beam", "words"),
    [
        (
            {"chord": 31.0, "length": 1624.0, "thickness": 4.0, "cross_section": DECK},
            "method is 'solid'.*cross_section; give method='beam'",
        ),
        ({"boundary": "one-fork"}, "'one-fork' has no counterpart on a solid.*method 'beam'"),
    ],
)
def test_a_beam_that_is_no_solid_plate_is_not_reduced_as_one(beam, words):
    with pytest.raises(ModesError, match=words):
        eq.reduce(eq.Beam(**beam))


def test_a_section_that_is_unlike_its_beam_warns():
    """Pinned at both ends with the twist held at one: cos(phi) = 0.85, and it flutters early."""
    with pytest.warns(UserWarning, match=r"flutters at 61\.0.* flutters at 64\.2.* \(-5\.0 %\)"):
        eq.reduce(eq.Beam(boundary="one-fork"), method="analytic")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        eq.reduce(eq.Beam(length=3.0), method="analytic")
