"""Static loads on the supports of a beam: statics, and closed forms of indeterminate beams."""

from __future__ import annotations

import numpy as np
import pytest

from equisection.beam.beam import Beam
from equisection.structure.static_loads import StaticLoads, static_loads

LENGTH, Q, T = 2.0, 30.0, 4.0
EI, GJ = 50.0, 20.0


def beam_with(**more) -> Beam:
    section = {
        "bending_rigidity": EI,
        "torsional_rigidity": GJ,
        "mass_per_length": 1.0,
        "inertia_per_length": 0.01,
    }
    return Beam(
        **{"chord": 0.5, "length": LENGTH, "thickness": 0.05, "cross_section": section, **more}
    )


def uniform(beam: Beam) -> StaticLoads:
    return static_loads(beam, np.array([0.0, 1.0]), np.array([Q]), np.array([T]))


def forces(loads: StaticLoads) -> dict[str, tuple[float, float, float]]:
    return {one.name: (one.force, one.bending_moment, one.torque) for one in loads.supports}


@pytest.mark.parametrize(
    ("boundary", "root", "tip"),
    [
        ("clamped-free", (1, 1 / 2, 1), None),
        ("clamped-clamped", (1 / 2, 1 / 12, 1 / 2), (1 / 2, -1 / 12, 1 / 2)),
        ("pinned-pinned", (1 / 2, 0, 1 / 2), (1 / 2, 0, 1 / 2)),
        ("clamped-pinned", (5 / 8, 1 / 8, 1 / 2), (3 / 8, 0, 1 / 2)),
        ("one-fork", (1 / 2, 0, 1), (1 / 2, 0, 0)),
    ],
)
def test_uniform_load_on_every_boundary(boundary, root, tip):
    """Parts of qL, qL^2 and tL (Timoshenko, Strength of Materials)."""
    found = forces(uniform(beam_with(boundary=boundary)))
    unit = np.array([Q * LENGTH, Q * LENGTH**2, T * LENGTH])
    assert found["root"] == pytest.approx(tuple(root * unit), rel=1e-9, abs=1e-9)
    assert ("tip" in found) == (tip is not None)
    if tip is not None:
        assert found["tip"] == pytest.approx(tuple(tip * unit), rel=1e-9, abs=1e-9)


def test_two_equal_spans_have_five_quarters_on_the_middle():
    """Of a beam on three props the middle one carries 5/8 of qL, the ends 3/16."""
    supports = [{"at": at, "deflection": "fixed"} for at in (0.0, 0.5, 1.0)]
    supports[1]["twist"] = "fixed"
    loads = uniform(beam_with(boundary="supports", supports=supports))
    found = forces(loads)
    parts = [found[f"supports.{number}"][0] / (Q * LENGTH) for number in range(3)]
    assert parts == pytest.approx([3 / 16, 5 / 8, 3 / 16], rel=1e-9)
    assert found["supports.1"][2] == pytest.approx(T * LENGTH)
    assert set(found) == {"supports.0", "supports.1", "supports.2"}
    # the hogging moment over the middle, q (L/2)^2/8, is the largest
    assert abs(loads.largest_bending_moment) == pytest.approx(Q * LENGTH**2 / 32, rel=1e-9)
    assert loads.bending_moment_at == pytest.approx(0.5)
    assert abs(loads.largest_torque) == pytest.approx(T * LENGTH / 2)
    assert loads.bending_moment == loads.torque == 0.0


def test_largest_moment_of_a_pinned_beam_is_in_the_middle_of_it():
    loads = uniform(beam_with(boundary="pinned-pinned"))
    assert loads.largest_bending_moment == pytest.approx(-Q * LENGTH**2 / 8, rel=1e-9)
    assert loads.bending_moment_at == pytest.approx(0.5)


def test_spring_shares_with_the_clamp_by_the_stiffness_of_both():
    """A cantilever's tip sinks by qL^4/8EI, and a force F lifts it by FL^3/3EI."""
    stiffness = 70.0
    support = {"at": 1.0, "deflection_stiffness": stiffness, "twist_stiffness": 5.0}
    found = forces(uniform(beam_with(supports=[support])))
    flexible = LENGTH**3 / (3 * EI)
    force = Q * LENGTH**4 / (8 * EI) / (flexible + 1 / stiffness)
    torque = T * LENGTH**2 / (2 * GJ) / (LENGTH / GJ + 1 / 5.0)
    assert found["supports.0"] == pytest.approx((force, 0.0, torque), rel=1e-9)


def test_springs_at_the_root_carry_all_of_a_beam_that_they_hold():
    found = forces(
        uniform(
            beam_with(
                boundary="spring-root", root_torsional_stiffness=3.0, root_bending_stiffness=8.0
            )
        )
    )
    assert found == {"root": pytest.approx((Q * LENGTH, Q * LENGTH**2 / 2, T * LENGTH))}


@pytest.mark.parametrize("boundary", ["clamped-clamped", "clamped-pinned", "supports"])
def test_what_the_air_puts_in_the_supports_take_out(boundary):
    """Sums of forces, of moments about the root and of torques, of an uneven load."""
    supports = [
        {"at": 0.3, "deflection_stiffness": 40.0, "twist": "fixed"},
        {"at": 0.75, "deflection": "fixed", "twist_stiffness": 2.0},
    ]
    lumps = [{"at": 0.4, "mass": 3.0}]
    edges = np.array([0.0, 0.2, 0.55, 0.9, 1.0])
    lift, torque = np.array([20.0, 35.0, -10.0, 60.0]), np.array([3.0, -2.0, 5.0, 1.0])
    beam = beam_with(boundary=boundary, supports=supports, lumps=lumps)
    found = static_loads(beam, edges, lift, torque)
    size, middle = LENGTH * np.diff(edges), LENGTH * (edges[1:] + edges[:-1]) / 2
    assert sum(one.force for one in found.supports) == pytest.approx(lift @ size)
    about_root = sum(one.bending_moment + one.force * one.at * LENGTH for one in found.supports)
    assert about_root == pytest.approx(lift @ (size * middle))
    assert sum(one.torque for one in found.supports) == pytest.approx(torque @ size)


def test_linear_twist_and_lift_of_a_cantilever_are_summed_from_the_tip():
    """Of a cantilever the largest loads are those at the root, whatever their distribution."""
    edges = np.linspace(0.0, 1.0, 9)
    lift, torque = Q * (1.0 + edges[1:]), T * edges[1:]
    loads = static_loads(beam_with(), edges, lift, torque)
    assert loads.largest_bending_moment == pytest.approx(loads.bending_moment, rel=1e-9)
    assert loads.largest_torque == pytest.approx(loads.torque, rel=1e-9)
    assert (loads.bending_moment_at, loads.torque_at) == (0.0, 0.0)
