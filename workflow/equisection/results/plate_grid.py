"""Mesh of the plate as data: its cells in the plane at the root, its layers, and its quality."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PlateGrid:
    """A mesh that is the same in each layer along the span, but for the plate's place.

    Attributes
    ----------
    points : (n, 2) array
        x/c and y/c of the corners in the plane of the root, about mid-chord.
    corners : (m, 4) array of int
        Corners of each cell there, as numbers of points, in order around it.
    levels : (l,) array
        z/c where the layers of cells begin and end, from the root to the other wall.
    span, thickness
        L/c and h/c.
    incidence_deg
        Incidence (deg).
    cells
        Number of cells of the whole mesh.
    quality
        What the mesh generator's check says: names and numbers.
    """

    points: Floats
    corners: NDArray[np.int64]
    levels: Floats
    span: float
    thickness: float
    incidence_deg: float
    cells: int
    quality: Mapping[str, float]

    def to_dataset(self) -> xr.Dataset:
        """Return the data set that is written to file."""
        position = "of the corner from mid-chord, over the chord"
        return xr.Dataset(
            {
                "x": ("point", self.points[:, 0], _says(f"x {position}")),
                "y": ("point", self.points[:, 1], _says(f"y {position}")),
                "corners": (
                    ("cell", "corner"),
                    self.corners.astype(np.int32),
                    _says("numbers of the cell's corners, in order around it"),
                ),
                "level": (
                    "level",
                    self.levels,
                    _says("z/c where layers of cells begin and end, from the root"),
                ),
            },
            attrs={
                "span": self.span,
                "thickness": self.thickness,
                "incidence_deg": self.incidence_deg,
                "cells": self.cells,
                **self.quality,
            },
        )


def no_grid(incidence_deg: float, span: float, thickness: float) -> PlateGrid:
    """Return what stands for a mesh that is not known: one without cells."""
    nothing = np.empty((0, 4), np.int64)
    return PlateGrid(np.empty((0, 2)), nothing, np.zeros(0), span, thickness, incidence_deg, 0, {})


def _says(long_name: str) -> dict[str, str]:
    return {"units": "1", "long_name": long_name}
