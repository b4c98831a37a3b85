"""Mesh of the plate as data: its cells in the plane at the root, its layers, and its quality."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from equisection.results.plane_mesh import Floats, PlaneMesh, no_cells


@dataclass(frozen=True, kw_only=True)
class PlateGrid(PlaneMesh):
    """Cells of the layer at the root; all layers along the plate have the same.

    Attributes
    ----------
    levels : (l,) array
        z/c of the planes between the layers of cells, from the root to the other wall.
    span, thickness
        L/c and h/c.
    cells
        Number of cells of the whole mesh.
    """

    levels: Floats
    span: float
    thickness: float
    cells: int

    def to_dataset(self) -> xr.Dataset:
        """Return the data set that is written to file."""
        position = {
            "units": "1",
            "long_name": "z/c where layers of cells begin and end, from the root",
        }
        return xr.Dataset(
            {**self.plane(), "level": ("level", self.levels, position)},
            attrs={
                "span": self.span,
                "thickness": self.thickness,
                "incidence_deg": self.incidence_deg,
                "cells": self.cells,
                **self.quality,
            },
        )


def no_grid(incidence_deg: float, span: float, thickness: float) -> PlateGrid:
    """Return the placeholder of an unknown mesh, which has no cells."""
    return PlateGrid(
        **no_cells(),
        levels=np.zeros(0),
        span=span,
        thickness=thickness,
        incidence_deg=incidence_deg,
        cells=0,
    )
