"""Meshes of the beam: that of the solid, and that of the flow around it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from equisection.figures.mesh_lines import draw_lines, quality_in_words
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, say, without_data
from equisection.figures.style import BLACK, BLUE, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.plane_mesh import edges

Floats = NDArray[np.float64]

#: Half widths of the detail of the plate and of that of its leading edge (chords).
PLATE, LEADING_EDGE = np.array([0.75, 0.5]), np.array([0.09, 0.06])
#: Distance within which points are on a wall of the channel, and an edge is upright (chords).
ON_PLATE = 1e-6


def from_files(plate_mesh: Path, method: str, elements: Mapping[str, int]) -> Figure:
    """Draw ``steady/plate_mesh.nc``, and the mesh of the solid that the configuration asks for."""
    counts = (elements["chord"], elements["span"], elements["thickness"])
    return draw(read_dataset(plate_mesh), method, counts)


def draw(grid: xr.Dataset, method: str, elements: tuple[int, int, int]) -> Figure:
    """Draw solid and flow seen from above (top), and the flow in the plane (below).

    Parameters
    ----------
    grid
        ``steady/plate_mesh.nc``.
    method
        Method by which the modes are computed, ``structure.method``.
    elements
        Elements along chord, span and thickness, ``structure.elements``.
    """
    if not grid.sizes["cell"]:
        return without_data("The mesh of the plate is not kept.")
    figure = Figure(figsize=(PAGE_WIDTH, 4.1))
    panels = figure.subplot_mosaic([["a", "b"], ["c", "d"]], height_ratios=[1.0, 2.1])
    for place, title in (
        ("a", "solid, from above"),
        ("b", "flow, from above"),
        ("c", "flow, section"),
        ("d", "flow, leading edge"),
    ):
        letter(panels[place], place, title)
    levels, span = grid["level"].values, float(grid.attrs["span"])
    corner = np.array([levels[-1], 1.0])
    points = np.stack([grid["x"].values, grid["y"].values], axis=-1)
    incidence = math.radians(float(grid.attrs["incidence_deg"]))
    along_span = np.linspace(0.0, span, elements[1] + 1)
    along_chord = np.linspace(0.0, 1.0, elements[0] + 1) if method == "solid" else np.array([0.5])
    if method == "analytic":
        say(panels["a"], "The modes are in closed form: the solid has no mesh.")
    else:
        _from_above(panels["a"], along_span, along_chord, corner)
    on_plate = _on_upper_side(points, grid["corners"].values, incidence)
    _from_above(panels["b"], levels, on_plate, corner)
    panels["b"].axvline(span, color=BLACK, linewidth=0.8)
    lines = points[edges(grid["corners"].values)]
    edge = np.array([-0.5 * math.cos(incidence), 0.5 * math.sin(incidence)])
    for place, middle, half in (("c", np.zeros(2), PLATE), ("d", edge, LEADING_EDGE)):
        draw_lines(panels[place], lines, middle - half, middle + half)
        panels[place].set(xlabel="$x/c$", ylabel="$y/c$")
    add_provenance(
        figure,
        f"flow: {solver_of(str(grid.attrs['solver_description']), str(grid.attrs['resolution']))}",
        f"{grid.attrs['incidence_deg']:g} deg, {levels.size - 1} layers along the span",
        quality_in_words(grid.attrs),
        f"solid: {_in_words(method, elements)}",
    )
    return figure


def _from_above(axes: Axes, z: Floats, x: Floats, corner: Floats) -> None:
    """Draw the lines of a grid over span and chord, in a window from (0, 0) to a corner."""
    across = [[(place, x[0]), (place, x[-1])] for place in z]
    along = [[(z[0], place), (z[-1], place)] for place in x]
    if x.size == 1:  # a beam: nodes on its axis
        axes.plot(z, np.full(z.size, x[0]), ".", color=BLUE, markersize=1.5)
    draw_lines(axes, np.array([*across, *along]), np.zeros(2), corner)
    axes.invert_yaxis()
    axes.set(xlabel="$z/c$", ylabel="$x/c$")


def _on_upper_side(points: Floats, corners: NDArray[np.int64], incidence: float) -> Floats:
    """Return x/c from the leading edge of the mesh's points on the body's upper side.

    The body is the hole that the cells leave: an edge on it is of one cell, as those of the
    channel's walls are, and has that cell above it on the upper side.
    """
    cosine, sine = math.cos(incidence), math.sin(incidence)
    x, y = (points @ np.array(axis) for axis in ((cosine, -sine), (sine, cosine)))
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    cell = np.repeat(np.arange(len(corners)), corners.shape[1])
    real = ends[:, 0] != ends[:, 1]
    ends, cell = ends[real], cell[real]
    _, first, count = np.unique(
        np.sort(ends, axis=1), axis=0, return_index=True, return_counts=True
    )
    ends, cell = ends[first[count == 1]], cell[first[count == 1]]
    along, up = np.ptp(x[ends], axis=1), y[corners[cell]].mean(axis=1) - y[ends].mean(axis=1)
    box = np.abs(points[:, None, :] - [points.min(axis=0), points.max(axis=0)]) < ON_PLATE
    on_body = ~box.any(axis=(1, 2))[ends].any(axis=1)
    return np.unique(x[ends[on_body & (along > ON_PLATE) & (up > 0)]]) + 0.5


def _in_words(method: str, elements: tuple[int, int, int]) -> str:
    if method == "solid":
        return f"{' x '.join(map(str, elements))} quadratic hexahedra (chord, span, thickness)"
    return f"{elements[1]} beam elements" if method == "beam" else "closed form"
