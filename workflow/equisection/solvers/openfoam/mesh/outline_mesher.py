"""Process that makes the mesh of an outline: layers, disc and ring, written as OpenFOAM's mesh.

It is started by :class:`~equisection.solvers.openfoam.mesh.outline_mesh.OutlineMesh` with the
folder of the case, which holds its input.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from equisection.beam.outline import edge_lengths
from equisection.errors import EquisectionError
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.gmsh_fill import Size, filled
from equisection.solvers.openfoam.mesh.outline_layers import layers_of
from equisection.solvers.openfoam.mesh.outline_mesh import INPUT, NO_MESH, OutlineMesh
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.mesh.outline_wall import wall_of
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells, write_layer
from equisection.solvers.openfoam.process import BlowUpError

Floats = NDArray[np.float64]

#: Patches of the plane's boundary and their types.
PATCHES = {
    "inlet": "patch",
    "outlet": "patch",
    "floor": "symmetryPlane",
    "ceiling": "symmetryPlane",
    "plate": "wall",
}
#: Half height of the wake at the body (chords), and its growth with the distance behind.
_WAKE_HALF, _WAKE_SPREAD = 0.12, 0.25
#: Distance from the wall up to which cells are those near it (chords), and the growth beyond.
_NEAR_REACH, _NEAR_GROWTH = 0.35, 0.05
#: Growth of the cells outside of the disc, and beside the wake; length of the wake (chords) in
#: which its cells grow slowly, and by how much a chord.
_OUTSIDE, _BESIDE, _WAKE_LENGTH, _WAKE_GROWTH = 0.10, 0.15, 4.0, 0.25
#: Half height of the wake outside of the disc, over its radius.
_WAKE_OUTSIDE = 0.35
#: Least cells between channel's walls.
_FEWEST_ACROSS = 1.4


def cells_of(mesh: OutlineMesh) -> PlaneCells:
    """Return the cells of a section in its channel.

    Raises
    ------
    BlowUpError
        No layers fit around the outline.
    SolverError
        gmsh is missing.
    """
    disc, circle = disc_of(mesh)
    turned = disc.turned(-mesh.incidence)  # nose up is clockwise
    around = turned.points[circle]
    box = _box(mesh)
    ring = filled([box, around], _size_in_ring(mesh, around.mean(axis=0)))
    common = len(box) + np.arange(len(circle))
    return turned.joined(ring, common, circle)


def disc_of(mesh: OutlineMesh) -> tuple[PlaneCells, NDArray[np.int64]]:
    """Return the cells around the body in its frame, and the points of their outer circle."""
    sizes, refinement, radius = mesh.sizes, mesh.refinement, mesh.disc_radius
    outline = np.array(mesh.outline)
    layers = layers_of(wall_of(outline, sizes, refinement), sizes, refinement)
    count = 8 * round(2 * math.pi * radius / (0.9 * sizes.wake) / 8)
    count = 2 * round(count * refinement / 2)
    angle = 2 * math.pi * np.arange(count) / count
    circle = mesh.centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    front = layers.cells.points[layers.front]
    inner = filled([circle, front], _size_in_disc(mesh, front))
    disc = layers.cells.joined(inner, count + np.arange(len(front)), layers.front)
    return disc, len(layers.cells.points) + np.arange(count)


def _size_in_disc(mesh: OutlineMesh, front: Floats) -> Size:
    """Return sizes that grow from those of the layers' front, up to those near the body."""
    sizes, refinement = mesh.sizes, mesh.refinement
    lengths = edge_lengths(front)
    at_front = 0.5 * (lengths + np.roll(lengths, 1))
    tree = KDTree(front)
    edge, level = max(x for x, _ in mesh.outline), mesh.centre[1]
    half = max(_WAKE_HALF, np.ptp(np.array(mesh.outline)[:, 1]) / 2)
    near, wake = sizes.near / refinement, sizes.wake / refinement

    def size(x: float, y: float) -> float:
        way, nearest = tree.query((x, y), k=3)
        own = float(np.min(at_front[nearest] + sizes.outward * way))
        behind = x > edge and abs(y - level) < half + _WAKE_SPREAD * (x - edge)
        if behind or way[0] < _NEAR_REACH:
            return min(own, near)
        return min(own, wake, near + _NEAR_GROWTH * float(way[0] - _NEAR_REACH) / refinement)

    return size


def _size_in_ring(mesh: OutlineMesh, centre: Floats) -> Size:
    """Return sizes that grow from those at the disc's edge, slowly behind it."""
    refinement, radius = mesh.refinement, mesh.disc_radius
    wake, far = mesh.sizes.wake / refinement, _far(mesh)

    def size(x: float, y: float) -> float:
        ahead, aside = x - centre[0], abs(y - centre[1])
        found = wake + _OUTSIDE * max(0.0, math.hypot(ahead, aside) - radius)
        if ahead > 0:
            beside = max(0.0, aside - _WAKE_OUTSIDE * radius)
            beyond = max(0.0, ahead - radius - _WAKE_LENGTH)
            slowly = wake * (1 + _WAKE_GROWTH * min(ahead, _WAKE_LENGTH))
            found = min(found, slowly + _BESIDE * beside + _OUTSIDE * beyond)
        return min(found, far)

    return size


def _far(mesh: OutlineMesh) -> float:
    """Return the size of the largest cells (chords)."""
    return mesh.sizes.far * mesh.channel.height / mesh.refinement


def _box(mesh: OutlineMesh) -> Floats:
    """Return the points along the channel's walls and ends, counter-clockwise, an even number."""
    channel, far = mesh.channel, _far(mesh)
    length = channel.upstream + channel.downstream
    along, across = round(length / far), round(_FEWEST_ACROSS * channel.height / far)
    corners = np.array(
        [
            (-channel.upstream, channel.floor),
            (channel.downstream, channel.floor),
            (channel.downstream, channel.ceiling),
            (-channel.upstream, channel.ceiling),
        ]
    )
    return np.concatenate(
        [
            start + (end - start) * np.arange(count)[:, None] / count
            for start, end, count in zip(
                corners, np.roll(corners, -1, axis=0), (along, across, along, across), strict=True
            )
        ]
    )


def patches_of(channel: ChannelBox, first: Floats, last: Floats) -> NDArray[np.str_]:
    """Return the patch of edges of the boundary with given ends, each (n, 2)."""
    x, y = ((first + last) / 2).T
    tiny = 1e-9 * max(channel.height, channel.downstream)
    return np.select(
        [
            np.abs(x + channel.upstream) < tiny,
            np.abs(x - channel.downstream) < tiny,
            np.abs(y - channel.floor) < tiny,
            np.abs(y - channel.ceiling) < tiny,
        ],
        ["inlet", "outlet", "floor", "ceiling"],
        "plate",
    )


def write_mesh(mesh: OutlineMesh, folder: Path) -> int:
    """Write the mesh into the folder of a case, and return its number of cells."""
    return write_layer(
        folder, [cells_of(mesh)], PATCHES, lambda a, b: patches_of(mesh.channel, a, b)
    )


def read_mesh(found: dict[str, Any]) -> OutlineMesh:
    """Return the mesh of a section from its input."""
    given = dict(found)
    outline = tuple((float(x), float(y)) for x, y in given.pop("outline"))
    channel, sizes = ChannelBox(**given.pop("channel")), OutlineSizes(**given.pop("sizes"))
    return OutlineMesh(outline=outline, channel=channel, sizes=sizes, **given)


def make(write: Callable[[dict[str, Any], Path], int]) -> int:
    """Make the mesh of the folder on the command line; return the status of the process.

    ``write`` writes it from its input into the folder, and returns the number of cells.
    """
    folder = Path(sys.argv[1])
    try:
        found = json.loads((folder / INPUT).read_text(encoding="utf-8"))
        print(f"{write(found, folder)} cells")
    except BlowUpError as error:
        print(error)
        return NO_MESH
    except EquisectionError as error:
        print(error)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(make(lambda found, folder: write_mesh(read_mesh(found), folder)))
