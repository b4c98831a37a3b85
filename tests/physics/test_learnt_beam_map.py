"""Learnt beams at rest and about it: branch from rest, small motions, other axes, other starts."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.physics.test_learnt_beam import KNOWN, POLARS, SECTION, SHARE, STRIPS, beams, recorded

from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.analysis.learnt_bodies import LearntBeamBodies
from equisection.analysis.reduced_beam import learnt_beam, predicted_beams
from equisection.errors import ArgumentError
from equisection.motion.beam_lesson import learn_strips
from equisection.motion.learnt_beams import LearntBeams
from equisection.motion.mechanism import influence_of, instabilities
from equisection.motion.static_branch import StaticBranch

ONE = np.ones(STRIPS.stations.size)
#: Strips that are all a section, with its drag.
ALIKE = StripPolars(
    SECTION.incidence,
    STRIPS.stations,
    np.outer(SECTION.lift, ONE),
    np.outer(SECTION.moment, ONE),
    "alike",
    SECTION.drag,
)


def at_incidence(degrees: float, **changes) -> LearntStrips:
    return replace(KNOWN, incidence_rad=math.radians(degrees), **changes)


@pytest.mark.parametrize("axis", [0.0, -0.1])
def test_equilibrium_is_on_the_branch_from_rest_and_ends_at_its_fold(axis):
    """A beam that turns as a whole is one section, whose branches are known exactly."""
    rigid = math.radians(0.5)
    branch = StaticBranch.from_rest(SECTION, rigid, axis)
    fold = branch.k_star_end
    stiffnesses = np.array([0.99, 1.01, 1.5]) * fold
    parameters = beams([6.44] * 3, "rigid", axis=axis)
    structure = replace(parameters.structure, torsion_stiffness=stiffnesses[:, None])
    moved = LearntBeams(replace(parameters, structure=structure), at_incidence(0.5, polars=ALIKE))
    twist = moved.equilibria()[:, 0]
    assert math.isnan(twist[0])
    np.testing.assert_allclose(twist[1:], branch.incidence(stiffnesses[1:]) - rigid, rtol=2e-3)


def test_small_motions_are_the_same_about_any_axis():
    """Without a spring of the heave no axis is elastic: the same body turns about another place."""
    x, inertia, mass = 0.15, 6.67, 80.0
    straight = replace(ALIKE, drag=0.0 * SECTION.drag)
    found = []
    for axis in (0.0, x):
        turned = inertia + mass * axis**2
        parameters = beams(
            [6.44],
            "rigid",
            axis=axis,
            inertia=np.array([turned]),
            imbalance=np.array([-mass * axis]),
            torsion_frequencies=np.array([[math.sqrt(12.0 / turned)]]),
            bending_frequencies=np.array([[1e-9]]),
        )
        moved = LearntBeams(parameters, at_incidence(0.0, polars=straight))
        values = np.linalg.eigvals(moved.linearised(np.zeros((1, 2)))[0])
        found.append(values[np.argsort(values.imag + 1e-3 * values.real)][[0, 1, -2, -1]])
    np.testing.assert_allclose(found[0], found[1], atol=1e-6)


def test_loads_of_small_motions_are_those_of_the_eigenvalues():
    """det(p^2 M + p C + K - Q(p)) vanishes at each p, off mid-chord and with dampers."""
    parameters = beams([9.0], axis=-0.1, imbalance=np.array([1.5]), damping_ratios=(0.02, 0.03))
    moved = LearntBeams(parameters, KNOWN)
    rest = moved.equilibria()
    values = np.linalg.eigvals(moved.linearised(rest)[0])
    swap = [2, 3, 0, 1]  # bending first
    with_air = np.linalg.inv(moved._inverse[0])[swap][:, swap]
    springs, dampers = (one[0][swap][:, swap] for one in (moved._stiffness, moved._damping))
    for p in values[values.imag > 0.05]:
        loads = moved.influence(rest)(np.array([p]))[0]
        left = p**2 * with_air + p * dampers + springs - loads
        assert np.abs(np.linalg.eigvals(left)).min() < 1e-8 * np.abs(left).max()


def test_small_release_from_a_start_goes_as_the_eigenvalue():
    """A symmetric beam at 0 deg moves from a start alone: held in it, and then let go."""
    straight = replace(
        POLARS,
        lift=7.0 * np.outer(SECTION.incidence, SHARE),
        moment=1.7 * np.outer(SECTION.incidence, SHARE),
    )
    loads, k_star = at_incidence(0.0, polars=straight), [9.0, 12.0]
    parameters = beams(k_star)
    moved = LearntBeams(parameters, loads)
    assert np.abs(moved.released(10.0).torsion).max() < 1e-15
    swings = moved.released(10.0, start=(0.002, 0.001))
    np.testing.assert_allclose(swings.torsion[0] @ parameters.torsion_at_tip, 0.002)
    rate = np.diff(swings.bending[:2] @ parameters.bending_at_tip, axis=0)[0] / swings.time[1]
    np.testing.assert_allclose(rate, 0.001, rtol=0.5)  # until the lift of the twist has worked
    model = replace(learnt_beam(recorded(beams([6.44])), POLARS), loads=loads, refits=())
    found = predicted_beams(model, k_star, parameters, start=(1e-3, 0.0))
    natural = moved.natural_frequencies[:, 0]
    for growth, values, pitch in zip(
        found["growth_rate"], moved.eigenvalues(), natural, strict=True
    ):
        near = np.abs(values.imag / (2.0 * math.pi * pitch) - 1.0).argmin()
        assert growth == pytest.approx(values.real[near], abs=3e-4)


def test_loads_are_learnt_wherever_the_axis_is():
    """Moments about the axis are those of the known loads, and c_m is found about mid-chord."""
    off = beams([6.44], axis=-0.05, imbalance=np.array([2.0]))
    loads = replace(KNOWN, polars=replace(POLARS, drag=SECTION.drag))
    found = learn_strips(recorded(off, loads), loads.polars, 45.0)
    assert found.rate == pytest.approx(KNOWN.rate, rel=0.05)
    np.testing.assert_allclose(found.moment[:3], KNOWN.moment[:3], rtol=0.2)
    assert found.residual_moment < 0.02
    assert found.residual_lift < 0.03


def test_bodies_of_the_map_move_as_the_beams():
    """States of the map are those of the beam in another order, its tip where shapes are 1."""
    parameters = beams([9.0, 14.0])
    bodies, moved = LearntBeamBodies(parameters), LearntBeams(parameters, KNOWN)
    states, linear = bodies.at_rest(KNOWN)
    rest = moved.equilibria()
    np.testing.assert_allclose(
        np.sort(np.linalg.eigvals(linear[1]).real), np.sort(moved.eigenvalues()[1].real), atol=1e-9
    )
    twist, deflection = bodies.tip(states)
    np.testing.assert_allclose(twist, rest[:, :2] @ parameters.torsion_at_tip)
    np.testing.assert_allclose(deflection, rest[:, 2:] @ parameters.bending_at_tip)
    along, _ = bodies.along_span(states)
    assert along.shape == (2, bodies.places.size)
    assert (np.diff(along[0]) > 0.0).all()  # a cantilever turns most at its tip
    attached = bodies.attached(KNOWN)
    layout = attached.layout
    values, vectors = np.linalg.eig(linear[0])
    place = np.flatnonzero(values.imag > 0.0)[np.argmax(values.real[values.imag > 0.0])]
    told = instabilities(
        values[[place]],
        vectors[None, layout.deflection, place],
        vectors[None, layout.twist, place],
        bodies.influence(KNOWN, states[:1]),
        influence_of(attached, attached.rates[:, :, : layout.size]),
    )
    assert (values[place].real > 0.0) == (told.mechanism[0] != "none")


def test_drag_of_another_number_of_incidences_is_refused():
    with pytest.raises(ArgumentError, match=r"drag .* wanted is one of the beam at each of"):
        replace(POLARS, drag=SECTION.drag[1:])
