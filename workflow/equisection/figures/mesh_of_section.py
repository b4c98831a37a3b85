"""Mesh of the section, from the whole of it to the leading edge."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.mesh_lines import draw_lines, quality_in_words
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, without_data
from equisection.figures.style import PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.plane_mesh import edges

#: Half widths of the near field and of the leading edge's detail (chords).
NEAR_FIELD, LEADING_EDGE = (0.95, 0.55), (0.055, 0.042)


def from_files(section_mesh: Path) -> Figure:
    """Draw ``steady/section_mesh.nc``."""
    return draw(read_dataset(section_mesh))


def draw(mesh: xr.Dataset) -> Figure:
    """Draw the whole (above), near field and leading edge (below).

    Parameters
    ----------
    mesh
        ``steady/section_mesh.nc``.
    """
    if not mesh.sizes["cell"]:
        return without_data("The mesh of the section is not kept.")
    points = np.stack([mesh["x"].values, mesh["y"].values], axis=-1)
    lines = points[edges(mesh["corners"].values)]
    figure = Figure(figsize=(PAGE_WIDTH, 4.6))
    panels = figure.subplot_mosaic([["a", "a"], ["b", "c"]], height_ratios=[1.0, 1.45])
    low, high = points.min(axis=0), points.max(axis=0)
    incidence = math.radians(float(mesh.attrs["incidence_deg"]))
    edge = (-0.5 * math.cos(incidence), 0.5 * math.sin(incidence))
    for place, title, centre, half in (
        ("a", "whole mesh", (low + high) / 2, (high - low) / 2),
        ("b", "near field", (0.0, 0.0), NEAR_FIELD),
        ("c", "leading edge", edge, LEADING_EDGE),
    ):
        middle, reach = np.asarray(centre), np.asarray(half)
        draw_lines(panels[place], lines, middle - reach, middle + reach)
        panels[place].set(xlabel="$x/c$", ylabel="$y/c$")
        letter(panels[place], place, title)
    add_provenance(
        figure,
        solver_of(str(mesh.attrs["solver_description"]), str(mesh.attrs["resolution"])),
        rf"{float(mesh.attrs['incidence_deg']):g} deg",
        quality_in_words(mesh.attrs),
    )
    return figure
