"""Mesh of the plate in a shape of its modes, for the flow around a plate that is held so.

The mesh at rest is moved there without a flow, with the motion solver and the entries of a coupled
run, so that the run goes on from it as from any state of its own.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.beam.lumped_points import (
    Handed,
    LumpedPoints,
    motion_schemes,
    motion_solvers,
    write_lumped_motion,
)
from equisection.solvers.openfoam.beam.pipes import Alive, Pipes, names
from equisection.solvers.openfoam.case_folder import emptied, states
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.process import SILENCE, run_beside, run_program
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.section.rigid_section import require_sound_mesh

#: Steps in which the plate goes to its shape, and those after them in which the mesh follows.
_STEPS, _FOLLOWING = 20, 20
_FIELDS = ("pointDisplacement", "cellDisplacement")


def deform_mesh(
    installation: Installation,
    folder: Path,
    points: LumpedPoints,
    position: NDArray[np.float64],
    work: Path,
    *,
    of_outline: bool = False,
) -> None:
    """Move the mesh at time 0 of a folder, divided or not, to a position of the modes.

    Parameters
    ----------
    folder
        Folder with the mesh at rest.
    points
        The plate's lumped points.
    position
        Position of the modes.
    work
        Folder in which it is done.
    of_outline
        The mesh is that of an outline.

    Raises
    ------
    BlowUpError
        The mesh is not sound there.
    SolverError
        A program failed.
    """
    place, ranks = emptied(work), len(parts(folder))
    for part in parts(folder):
        shutil.copytree(part / "constant", place / part.relative_to(folder) / "constant")
    if ranks > 1:
        shutil.copytree(folder / "system", place / "system")
    write_lumped_motion(place, points, names())
    end = _STEPS + _FOLLOWING
    entries = {**control("moveDynamicMesh", end, 1, end), "functions": {}}
    entries["libs"] = ['"liblumpedPointMotion.so"']
    solution = flow.unsteady_solution()
    solution["solvers"] |= motion_solvers(of_outline=of_outline)
    solution["PIMPLE"]["nOuterCorrectors"] = 1  # no flow to agree with
    schemes = flow.schemes(steady=False)
    schemes["laplacianSchemes"] |= motion_schemes()
    write_system(place, entries, schemes, solution)
    with closing(Pipes(place, SILENCE)) as pipes:
        serve = _Holding(place, points, position, pipes)
        run_beside(installation, "moveDynamicMesh", place, serve, ranks=ranks)
    run_program(installation, "checkMesh", place, arguments=("-latestTime",), ranks=ranks)
    require_sound_mesh(place / "log.checkMesh")
    for part in parts(place):
        last, start = states(part)[-1], folder / part.relative_to(place) / "0"
        (start / "polyMesh").mkdir(parents=True, exist_ok=True)
        shutil.copyfile(last / "polyMesh" / "points", start / "polyMesh" / "points")
        for name in _FIELDS:
            shutil.copyfile(last / name, start / name)


@dataclass(frozen=True)
class _Holding:
    """The other side of the exchange, which brings the plate to its shape, whatever its loads."""

    folder: Path
    points: LumpedPoints
    position: NDArray[np.float64]
    pipes: Pipes

    def __call__(self, alive: Alive, end: Callable[[], None]) -> None:
        """Serve the program until it has ended."""
        del end
        while (message := self.pipes.receive(alive)) is not None:
            part = min(1.0, Handed.read(message, self.folder).time / _STEPS)
            if not self.pipes.send(self.points.message(part * self.position), alive):
                break
