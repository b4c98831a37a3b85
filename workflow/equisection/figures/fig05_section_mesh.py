"""Fig. 5: the mesh of the section, from the whole channel to the leading edge."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from equisection.figures.panels import letter, without_data
from equisection.figures.provenance import add_provenance, solver_of
from equisection.figures.style import BLUE, PAGE_WIDTH
from equisection.results.section_mesh import edges

#: Half widths of the near field and of the leading edge's detail (chords).
NEAR_FIELD, LEADING_EDGE = (0.95, 0.55), (0.055, 0.042)


def draw(mesh: xr.Dataset) -> Figure:
    """Draw channel (above), near field and leading edge (below).

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
        ("a", "channel", (low + high) / 2, (high - low) / 2),
        ("b", "near field", (0.0, 0.0), NEAR_FIELD),
        ("c", "leading edge", edge, LEADING_EDGE),
    ):
        _panel(panels[place], lines, np.asarray(centre), np.asarray(half))
        letter(panels[place], place, title)
    add_provenance(
        figure,
        solver_of(str(mesh.attrs["solver_description"]), str(mesh.attrs["resolution"])),
        rf"{float(mesh.attrs['incidence_deg']):g} deg",
        f"aspect ratio up to {mesh.attrs['max_aspect_ratio']:.0f}, non-orthogonality up to "
        f"{mesh.attrs['max_non_orthogonality_deg']:.0f} deg, skewness up to "
        f"{mesh.attrs['max_skewness']:.2f}",
    )
    return figure


def _panel(
    axes: Axes, lines: NDArray[np.float64], centre: NDArray[np.float64], half: NDArray[np.float64]
) -> None:
    """Draw the lines that reach into a window."""
    low, high = centre - half, centre + half
    inside = ((lines.max(axis=1) >= low) & (lines.min(axis=1) <= high)).all(axis=1)
    drawn = LineCollection(list(lines[inside]), colors=BLUE, linewidths=0.25, rasterized=True)
    axes.add_collection(drawn)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="$x/c$", ylabel="$y/c$")
    axes.set_aspect("equal")
    axes.grid(visible=False)
