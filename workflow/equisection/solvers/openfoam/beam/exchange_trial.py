"""One step of a coupled beam, which shows that OpenFOAM and the structure understand each other.

OpenFOAM's ``lumpedPointMovement`` was written anew after v1912. Its later forms are known here from
their published sources (OpenCFD, v2312 and later) and were not run. So the first step of each run
shows that loads and places mean the same on both sides: the lumped points add up to the lift and
the moment of the steady flow, and the faces of the beam go where the points carry them.
"""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from foamlib import FoamFile
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.beam.lumped_points import Handed, LumpedPoints
from equisection.solvers.openfoam.beam.pipes import FOLDER, Alive, Pipes
from equisection.solvers.openfoam.case_folder import states
from equisection.solvers.openfoam.dictionaries import PLATE
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.process import SILENCE, run_beside
from equisection.solvers.openfoam.ranks import parts

Floats = NDArray[np.float64]

#: Twist (rad) and deflection (chords) of the tip in the trial, small for the mesh.
_TWIST, _DEFLECTION = math.radians(0.1), 0.005
#: Part of the largest displacement by which a point may be elsewhere: between the lumped points
#: OpenFOAM has the tensors of the rotation linear, and here the angle is.
_ELSEWHERE = 0.02
#: Coefficients may differ by the friction, which the lumped points leave out, and by a steady flow
#: that has not converged: part of the coefficient, and what is added.
_OTHERWISE = (0.05, 0.005)


def try_exchange(
    installation: Installation,
    folder: Path,
    points: LumpedPoints,
    position: Floats,
    *,
    steady: tuple[float, float],
    write_system: Callable[[Path], None],
) -> None:
    """Make one step with a copy of a run and compare what either side understands.

    Parameters
    ----------
    folder
        The coupled run, at time 0.
    position
        Position of the modes there.
    steady
        C_L and C_M about mid-chord at rest of the steady flow that is at time 0.
    write_system
        Writes what controls a run of one step, whose state is written, into a folder.

    Raises
    ------
    SolverError
        A program failed, or the two sides do not understand each other.
    """
    place = folder.with_name("trial")
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(folder, place, ignore=shutil.ignore_patterns(FOLDER, "postProcessing", "log.*"))
    write_system(place)
    twist, deflection = points.release(_TWIST, _DEFLECTION)
    there = position + twist + deflection
    with closing(Pipes(place, SILENCE)) as pipes:
        serve = _Trial(place, points.message(there), pipes)
        run_beside(installation, "pimpleFoam", place, serve, ranks=len(parts(place)))
    where = f"OpenFOAM {installation.version()}, {place}"
    if not serve.handed:
        raise _misunderstood(where, "no loads were handed over")
    require_loads(points, serve.handed[0], steady, where)
    for part in parts(place):
        mesh = read_poly_mesh(part)
        on_plate = np.unique(mesh.faces[mesh.patches[PLATE]])
        moved = np.asarray(FoamFile(states(part)[-1] / "polyMesh" / "points")[None], dtype=float)
        require_followed(points, mesh.points[on_plate], moved[on_plate], there, where)
    shutil.rmtree(place)


@dataclass
class _Trial:
    """The structure's side, which has one answer, and keeps what it was told."""

    folder: Path
    answer: str
    pipes: Pipes
    handed: list[Handed] = field(default_factory=list)

    def __call__(self, alive: Alive, end: Callable[[], None]) -> None:
        """Serve the program until it has ended."""
        del end
        while (message := self.pipes.receive(alive)) is not None:
            self.handed.append(Handed.read(message, self.folder))
            if not self.pipes.send(self.answer, alive):
                break


def require_loads(
    points: LumpedPoints, handed: Handed, steady: tuple[float, float], where: str
) -> None:
    """Refuse loads of the lumped points that are not those of the steady flow.

    Parameters
    ----------
    handed
        The first loads, with moments about the points at rest.
    steady
        C_L and C_M of the steady flow about mid-chord at rest.
    where
        Version and folder, for the message.

    Raises
    ------
    SolverError
        There is another number of points, or their sums are not the coefficients.
    """
    found, wanted = len(handed.forces), len(points.locations)
    if found != wanted:
        raise _misunderstood(where, f"{found} lumped points in the place of {wanted}")
    part, more = _OTHERWISE
    found_both = points.coefficients(handed.forces, handed.moments)
    for name, value, expected in zip(("C_L", "C_M"), found_both, steady, strict=True):
        if not abs(value - expected) <= part * abs(expected) + more:
            raise _misunderstood(
                where,
                f"{name} of the lumped points is {value:.4g}, of the steady flow {expected:.4g}",
            )


def require_followed(
    points: LumpedPoints, rest: Floats, moved: Floats, position: Floats, where: str
) -> None:
    """Refuse a mesh whose points on the beam are not where the lumped points carry them.

    Parameters
    ----------
    rest, moved
        Points of the mesh on the beam, at rest and after the step, shape (n, 3).
    position
        Position of the modes that was told.
    where
        Version and folder, for the message.

    Raises
    ------
    SolverError
        A point is elsewhere.
    """
    expected = carried(points, rest, position)
    off = np.linalg.norm(moved - expected, axis=1).max(initial=0.0)
    far = np.linalg.norm(expected - rest, axis=1).max(initial=0.0)
    if not off <= _ELSEWHERE * far + 1e-6:
        raise _misunderstood(
            where,
            f"points of the mesh on the beam are up to {off:.2g} c from where they should be, "
            f"up to {far:.2g} c from rest",
        )


def carried(points: LumpedPoints, rest: Floats, position: Floats) -> Floats:
    """Return where the lumped points carry points of the beam's surface, shape (n, 3).

    Each turns about mid-chord of its place along the span and goes with it; in between the lumped
    points twist and shift are linear.
    """
    z = rest[:, 2]
    twist, along, up = (
        np.interp(z, points.locations, motion)
        for motion in (points.twist(position), *points.mid_chord(position))
    )
    x, y = rest[:, 0], rest[:, 1]
    return np.stack(
        [
            along + x * np.cos(twist) + y * np.sin(twist),
            up - x * np.sin(twist) + y * np.cos(twist),
            z,
        ],
        axis=-1,
    )


def _misunderstood(where: str, what: str) -> SolverError:
    return SolverError(
        f"{where}: {what}; the coupled beam was run on v1912 alone, and the lumpedPointMovement of "
        "this version does something else than its published sources say: run it on v1912, or "
        "leave the model 3d out of sweep.models and forced.beam_modes at 0"
    )
