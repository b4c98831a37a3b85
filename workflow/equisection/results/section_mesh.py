"""Mesh of the section as data: its cells, their quality, and the Courant number in each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SectionMesh:
    """Quadrilateral cells about mid-chord at rest, and the steady flow's Courant number.

    Attributes
    ----------
    points : (n, 2) array
        x/c and y/c of the corners.
    corners : (m, 4) array of int
        Corners of each cell, as numbers of points, in order around it.
    courant : (m,) array
        Co of each cell at ``time_step``.
    time_step
        Time step (c/V).
    incidence_deg
        Incidence (deg).
    flow
        How far the flow is known, in words.
    quality
        What the mesh generator's check says: names and numbers.
    """

    points: Floats
    corners: NDArray[np.int64]
    courant: Floats
    time_step: float
    incidence_deg: float
    flow: str
    quality: Mapping[str, float]

    def to_dataset(self) -> xr.Dataset:
        """Return the data set that is written to file."""
        position = "of the corner from mid-chord, over the chord"
        return xr.Dataset(
            {
                "x": ("point", self.points[:, 0], _says("1", f"x {position}")),
                "y": ("point", self.points[:, 1], _says("1", f"y {position}")),
                "corners": (
                    ("cell", "corner"),
                    self.corners.astype(np.int32),
                    _says("1", "numbers of the cell's corners, in order around it"),
                ),
                "area": ("cell", cell_areas(self.points, self.corners), _says("c2", "area")),
                "courant": ("cell", self.courant, _says("1", "Courant number")),
            },
            attrs={
                "time_step": self.time_step,
                "incidence_deg": self.incidence_deg,
                "flow": self.flow,
                "cells": len(self.corners),
                **self.quality,
            },
        )


def no_mesh(incidence_deg: float, time_step: float) -> SectionMesh:
    """Return what stands for a mesh that is not known: one without cells."""
    nothing = np.empty((0, 4), np.int64)
    return SectionMesh(
        np.empty((0, 2)), nothing, np.empty(0), time_step, incidence_deg, "not known", {}
    )


def cell_areas(points: Floats, corners: NDArray[np.int64]) -> Floats:
    """Return the areas of quadrilaterals (unit of the points squared), shape (m,)."""
    first, second = np.moveaxis(points[corners[:, [2, 3]]] - points[corners[:, [0, 1]]], 1, 0)
    return np.asarray(np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2)


def edges(corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the edges of quadrilaterals, each once, as two numbers of points, shape (k, 2)."""
    sides = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    return np.unique(np.sort(sides, axis=1), axis=0)


def share_below(limit: float, courant: Floats, weight: Floats) -> float:
    """Return the part of the weight (cells or areas) whose Courant number is below a limit."""
    return float(weight[courant < limit].sum() / weight.sum())


def _says(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}
