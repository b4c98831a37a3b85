"""Room for the meshes of a configuration in its channel, checked before any job starts."""

from __future__ import annotations

import math
from collections.abc import Iterator

from equisection.beam.outline import outline_of, rectangle
from equisection.config import Config
from equisection.config.groups.openfoam_keys import OUTLINE, OVERSET
from equisection.errors import SolverError
from equisection.keys.checks import Problem
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox, Mesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.overset_mesh import OversetMesh


def problems(config: Config) -> Iterator[Problem]:
    """Yield the problem of the first mesh that does not fit, from the largest incidence down.

    Every run has that of the rigid section; overset meshes of an outline need no more.
    """
    given, beam = config.flow.channel, config.beam
    if given is None:  # in free air, whose far field is further than any mesh around a section
        return
    channel = ChannelBox(
        beam.thickness / beam.chord,
        given.height_chords,
        given.upstream_chords,
        given.downstream_chords,
    )
    released = config.flow.incidence_deg + config.unsteady.start.twist_deg
    outline = beam.outline_in_flow()
    if outline is None and config.openfoam.mesher == OUTLINE:
        outline = outline_of(rectangle(channel.thickness))
    angles = {*config.steady.incidence_deg, config.flow.incidence_deg, released}
    if config.forced.incidence_deg is not None:
        angles.add(config.forced.incidence_deg)
    try:
        for angle in sorted(angles, key=abs, reverse=True):
            incidence = math.radians(angle)
            if outline is None:
                Mesh(channel, incidence, 1.0).points()
            else:
                OutlineMesh(outline.as_pairs(), channel, incidence, 1.0).require_room()
        if outline is None and config.openfoam.mesh_motion == OVERSET:
            OversetMesh(channel, math.radians(released), 1.0).require_room()
    except SolverError as error:
        yield Problem(
            "flow.channel",
            given.model_dump(),
            f"allowed is a channel with room for the mesh at every incidence; {error}",
        )
