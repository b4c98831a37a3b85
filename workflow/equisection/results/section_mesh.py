"""Mesh of the section as data: its cells, their quality, and the Courant number in each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr

from equisection.results.plane_mesh import Floats, PlaneMesh, cell_areas, no_cells


@dataclass(frozen=True, kw_only=True)
class SectionMesh(PlaneMesh):
    """The section's cells, and the steady flow's Courant number.

    Attributes
    ----------
    courant : (m,) array
        Co of each cell at ``time_step``.
    time_step
        Time step (c/V).
    flow
        The steady flow in words, with its number of iterations.
    """

    courant: Floats
    time_step: float
    flow: str

    def to_dataset(self) -> xr.Dataset:
        """Return the data set that is written to file."""
        return xr.Dataset(
            {
                **self.plane(),
                "area": (
                    "cell",
                    cell_areas(self.points, self.corners),
                    {"units": "c2", "long_name": "area"},
                ),
                "courant": (
                    "cell",
                    self.courant,
                    {"units": "1", "long_name": "Courant number"},
                ),
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
    """Return the placeholder of an unknown mesh, which has no cells."""
    return SectionMesh(
        **no_cells(),
        courant=np.empty(0),
        time_step=time_step,
        incidence_deg=incidence_deg,
        flow="not known",
    )


def share_below(limit: float, courant: Floats, weight: Floats) -> float:
    """Return the part of the weight (cells or areas) whose Courant number is below a limit."""
    return float(weight[courant < limit].sum() / weight.sum())
