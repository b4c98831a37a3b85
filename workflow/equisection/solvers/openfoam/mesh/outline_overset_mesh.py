r"""Two meshes, one above the other: the channel's, and the disc around an outline that moves in it.

::

    +-----------------------------------------+  ceiling
    | . . . . . . . . . . . . . . . . . . . . |
    | . . . . . .  .-----.  . . . . . . . . . |
    | . . . . .  /  disc   \  . background  . |
    | . . . . . |   ====    | . . . . . . . . |
    | . . . . .  \ (moves) /  . . . . . . . . |
    | . . . . . .  '-----'  . . . . . . . . . |
    +-----------------------------------------+  floor

The disc is that of :mod:`~equisection.solvers.openfoam.mesh.outline_mesh`, the same cells. It ends
in a patch ``overset``, at which it takes its values from the background. The background fills
channel or free air as if there were no section, with even cells where disc and wake come.
"""

from __future__ import annotations

import math
import re
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox, expansion
from equisection.solvers.openfoam.mesh.outline_mesh import LOG, TIME_LIMIT, OutlineMesh, made_by

Floats = NDArray[np.float64]

#: Module that makes both meshes.
_MESHER = "outline_overset_mesher"
#: Even cells of the background (chords) at refinement 1, and their growth beyond.
_EVEN, _GROWTH = 0.06, 1.2
#: Where the background has even cells, from the disc at rest on: ahead, behind and to either side
#: (chords), each as a part of the room up to the end or wall at the most.
_AHEAD, _BEHIND, _ASIDE, _PART = 0.2, 1.4, 0.7, 0.85


@dataclass(frozen=True)
class OutlineOversetMesh:
    """Input of both meshes of a section of any outline.

    Attributes
    ----------
    section
        Mesh of the section in one piece, whose disc moves above the background.
    """

    section: OutlineMesh

    @property
    def channel(self) -> ChannelBox:
        """Channel, or the box of free air."""
        return self.section.channel

    @property
    def background_cells(self) -> int:
        """Number of cells of the background."""
        x, y = self.background_lines()
        return (x.size - 1) * (y.size - 1)

    def background_lines(self) -> tuple[Floats, Floats]:
        """Return the lines of the background along x and y (chords)."""
        section, channel = self.section, self.channel
        radius = section.disc_radius + math.hypot(*section.centre)
        size, growth = _EVEN / section.refinement, _GROWTH ** (1 / section.refinement)

        def even(beyond: float, room: float) -> float:
            return min(radius + beyond, max(_PART * room, section.disc_radius))

        along = _lines(
            (-channel.upstream, channel.downstream),
            (-even(_AHEAD, channel.upstream), even(_BEHIND, channel.downstream)),
            size,
            growth,
        )
        across = _lines(
            (channel.floor, channel.ceiling),
            (-even(_ASIDE, -channel.floor), even(_ASIDE, channel.ceiling)),
            size,
            growth,
        )
        return along, across

    def require_room(self) -> None:
        """Refuse a channel that the disc does not fit into.

        Raises
        ------
        SolverError
            With the channel and what the disc needs.
        """
        self.section.require_room()

    def reach(self, twist: ArrayLike, deflection: ArrayLike) -> Floats:
        """Return the reach of the disc from the middle of the channel (chords).

        The section is at twists (rad) and deflections of mid-chord (chords) beyond those of the
        mesh.
        """
        (x, y), angle = self.section.centre, self.section.incidence + np.asarray(twist)
        height = self.channel.section_height + np.asarray(deflection)
        return np.abs(height + y * np.cos(angle) - x * np.sin(angle)) + self.section.disc_radius

    def ends(self, twist: ArrayLike, along: ArrayLike) -> tuple[Floats, Floats]:
        """Return the foremost and the rearmost x of the disc (chords).

        The section is at twists (rad) beyond those of the mesh, mid-chord at places along the
        stream (chords).
        """
        (x, y), angle = self.section.centre, self.section.incidence + np.asarray(twist)
        centre = np.asarray(along) + x * np.cos(angle) + y * np.sin(angle)
        return centre - self.section.disc_radius, centre + self.section.disc_radius

    def write(self, folder: Path, time_limit: float = TIME_LIMIT) -> int:
        """Make both meshes, write ``constant/polyMesh``, and return their number of cells.

        Cells of the background come first.

        Raises
        ------
        BlowUpError
            The outline has no mesh.
        SolverError
            The disc has no room; gmsh is missing, crashed, or did not end in time (processor s).
        """
        self.require_room()
        made_by(_MESHER, folder, asdict(self.section), time_limit)
        found = re.match(r"\d+", (folder / LOG).read_text(encoding="utf-8").splitlines()[-1])
        if found is None:
            raise SolverError(f"{folder / LOG}: no number of cells at its end")
        return int(found[0])


def _lines(
    ends: tuple[float, float], even: tuple[float, float], size: float, growth: float
) -> Floats:
    """Return lines from one end to the other, even between two places, growing outwards."""
    (first, last), (low, high) = ends, even
    count = round((high - low) / size)
    return np.concatenate(
        [
            low - _outward(low - first, size, growth)[::-1],
            np.linspace(low, high, count + 1),
            high + _outward(last - high, size, growth),
        ]
    )


def _outward(length: float, size: float, growth: float) -> Floats:
    """Return distances of lines that grow from the even size outwards, up to a length."""
    cells = math.ceil(math.log1p(length / size * (growth - 1)) / math.log(growth))
    ratio = expansion(length, cells, size) ** (1 / max(1, cells - 1))
    steps = ratio ** np.arange(cells)
    return np.asarray(length * np.cumsum(steps) / steps.sum())
