"""Cells in a plane as data, common to the meshes of section and plate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PlaneMesh:
    """Quadrilateral cells about mid-chord at rest, and the quality of the whole mesh.

    Attributes
    ----------
    points : (n, 2) array
        x/c and y/c of the corners.
    corners : (m, 4) array of int
        Corners of each cell, as numbers of points, in order around it.
    incidence_deg
        Incidence (deg).
    quality
        Numbers of the mesh generator's check, by name.
    """

    points: Floats
    corners: NDArray[np.int64]
    incidence_deg: float
    quality: Mapping[str, float]

    def plane(self) -> dict[str, Any]:
        """Return points and corners as variables of a data set."""
        position = "of the corner from mid-chord, over the chord"
        return {
            "x": ("point", self.points[:, 0], _says(f"x {position}")),
            "y": ("point", self.points[:, 1], _says(f"y {position}")),
            "corners": (
                ("cell", "corner"),
                self.corners.astype(np.int32),
                _says("numbers of the cell's corners, in order around it"),
            ),
        }


def no_cells() -> dict[str, Any]:
    """Return points, corners and quality of a mesh that is not known."""
    return {"points": np.empty((0, 2)), "corners": np.empty((0, 4), np.int64), "quality": {}}


def cell_areas(points: Floats, corners: NDArray[np.int64]) -> Floats:
    """Return the areas of quadrilaterals (unit of the points squared), shape (m,)."""
    first, second = np.moveaxis(points[corners[:, [2, 3]]] - points[corners[:, [0, 1]]], 1, 0)
    return np.asarray(np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2)


def edges(corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the edges of quadrilaterals, each once, as two numbers of points, shape (k, 2)."""
    sides = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    return np.unique(np.sort(sides, axis=1), axis=0)


def _says(long_name: str) -> dict[str, str]:
    return {"units": "1", "long_name": long_name}
