"""The mesh of OpenFOAM's files: points, faces, cells on either side, patches."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from foamlib import FoamFile
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]


@dataclass(frozen=True)
class PolyMesh:
    """A mesh of faces with three or four corners.

    Attributes
    ----------
    points : (n, 3) array
        Points.
    faces : (m, 4) array
        Points of each face, in order around it; the last two of a triangle are one.
    owner : (m,) array
        Cell that each face belongs to; one on its other side has a higher number.
    patches
        First and last face of each part of the boundary.
    """

    points: Floats
    faces: Numbers
    owner: Numbers
    patches: dict[str, slice]


def read_poly_mesh(folder: Path) -> PolyMesh:
    """Return the mesh of a case, written by OpenFOAM in binary, or by this project as text."""
    place = folder / "constant" / "polyMesh"
    return PolyMesh(
        points=np.asarray(_content(place / "points"), dtype=float),
        faces=_faces(_content(place / "faces")),
        owner=np.asarray(_content(place / "owner"), dtype=np.int64),
        patches={
            name: slice(patch["startFace"], patch["startFace"] + patch["nFaces"])
            for name, patch in _content(place / "boundary")
        },
    )


def _faces(content: Any) -> Numbers:
    if isinstance(content, tuple):  # places and corners, in binary
        starts, corners = (np.asarray(part, dtype=np.int64) for part in content)
        last = np.diff(starts) - 1
        return np.asarray(corners[starts[:-1, None] + np.minimum(np.arange(4), last[:, None])])
    return np.array([face if len(face) == 4 else face[[0, 1, 2, 2]] for face in content])


def _content(path: Path) -> Any:
    """Return what a file without keywords holds."""
    return FoamFile(path)[None]
