"""What the trial of the exchange with OpenFOAM compares, and what it refuses."""

from dataclasses import replace

import numpy as np
import pytest
from tests.sample_cases import beam_modes

from equisection.errors import SolverError
from equisection.solvers.openfoam.beam.exchange_trial import (
    carried,
    require_followed,
    require_loads,
)
from equisection.solvers.openfoam.beam.lumped_points import Handed, LumpedPoints

EDGES = np.linspace(0.0, 3.7, 9)
POINTS = LumpedPoints.of(beam_modes(), EDGES)
TWIST, BEND = POINTS.release(0.1, 0.2)
#: Corners of the section at each edge of the layers.
REST = np.array([[x, y, z] for z in EDGES for x in (-0.5, 0.5) for y in (-0.02, 0.02)])
WHERE = "OpenFOAM v2506, trial"


def test_points_are_carried_as_a_rigid_section_at_each_place() -> None:
    moved = carried(POINTS, REST, TWIST + BEND).reshape(len(EDGES), 4, 3)
    rest = REST.reshape(len(EDGES), 4, 3)
    sides = [np.linalg.norm(part[:, 0] - part[:, 3], axis=1) for part in (rest, moved)]
    np.testing.assert_allclose(*sides, rtol=1e-12)
    middle = moved.mean(axis=1)
    twist, bend = (
        np.interp(EDGES, POINTS.locations, motion)
        for motion in (POINTS.twist(TWIST), POINTS.deflection(BEND))
    )
    np.testing.assert_allclose(middle[:, 1], bend, atol=1e-12)
    # nose up: the leading edge, at -x, goes up
    leading, trailing = (moved[:, part].mean(axis=1) for part in ([0, 1], [2, 3]))
    np.testing.assert_allclose(leading[:, 1] - trailing[:, 1], np.sin(twist), atol=1e-12)


@pytest.mark.parametrize(
    "wrong",
    [-TWIST + BEND, TWIST - BEND, TWIST, BEND, 1.05 * (TWIST + BEND), 0 * TWIST],
    ids=["nose down", "down", "no bending", "no twist", "too far", "not at all"],
)
def test_mesh_that_does_something_else_is_refused(wrong: np.ndarray) -> None:
    told = TWIST + BEND
    require_followed(POINTS, REST, carried(POINTS, REST, told), told, WHERE)
    with pytest.raises(SolverError, match=r"v2506, trial: points of the mesh .* 0\.\d+ c from"):
        require_followed(POINTS, REST, carried(POINTS, REST, wrong), told, WHERE)


def test_mesh_whose_points_go_with_the_nearest_lumped_point_is_refused() -> None:
    """A mesh in steps, as without the line between the lumped points."""
    nearest = np.abs(REST[:, 2, None] - POINTS.locations[None, :]).argmin(axis=1)
    z = POINTS.locations[nearest]
    stepped = carried(POINTS, np.column_stack([REST[:, :2], z]), TWIST + BEND)
    with pytest.raises(SolverError, match="points of the mesh on the beam"):
        require_followed(
            POINTS, REST, np.column_stack([stepped[:, :2], REST[:, 2]]), TWIST + BEND, WHERE
        )


def test_loads_that_are_not_those_of_the_steady_flow_are_refused() -> None:
    shares = np.diff(EDGES, prepend=0.0, append=EDGES[-1])
    forces, moments = np.zeros((2, len(POINTS.locations), 3))
    forces[:, 1], moments[:, 2] = 0.5 * 0.3 * shares, -0.5 * 0.06 * shares
    handed = Handed(0.02, forces, moments)
    require_loads(POINTS, handed, (0.302, 0.0602), WHERE)
    others = {
        "C_L": replace(handed, forces=-forces),
        "C_M": replace(handed, moments=2.0 * moments),
        "9 lumped points in the place of 10": replace(handed, forces=forces[:-1]),
    }
    for said, other in others.items():
        with pytest.raises(SolverError, match=said):
            require_loads(POINTS, other, (0.302, 0.0602), WHERE)
    with pytest.raises(SolverError, match="C_L of the lumped points is nan"):
        require_loads(POINTS, replace(handed, forces=forces * np.nan), (0.3, 0.06), WHERE)
