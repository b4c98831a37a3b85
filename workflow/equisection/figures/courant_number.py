"""Courant number on the mesh of the section, and its distribution."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from numpy.typing import NDArray

from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import legend_above, letter, without_data
from equisection.figures.references import read_references
from equisection.figures.style import BLUE, COLOURS, DASHES, GREY, PAGE_WIDTH
from equisection.keys.shown import rounded
from equisection.results.netcdf import read_dataset
from equisection.results.section_mesh import share_below

#: Window of the map (chords), and smallest number of its colours.
WINDOW, SMALLEST = ((-1.2, 1.8), (-0.9, 0.9)), 0.01
#: Courant number whose share of the area is told, unless another one is to be compared with.
LIMIT = 1.0

Floats = NDArray[np.float64]


def from_files(section_mesh: Path, references: Sequence[Path]) -> Figure:
    """Draw ``steady/section_mesh.nc``."""
    limits = read_references(references, "courant_number_limit")["value"]
    return draw(read_dataset(section_mesh), *map(float, limits[:1]))


def draw(mesh: xr.Dataset, limit: float = LIMIT) -> Figure:
    """Draw the Courant number around the section (left) and its distribution (right).

    Parameters
    ----------
    mesh
        ``steady/section_mesh.nc``.
    limit
        Courant number below which the share of the area is given.
    """
    if not mesh.sizes["cell"]:
        return without_data("The mesh of the section, and the flow on it, is not kept.")
    figure = Figure(figsize=(PAGE_WIDTH, 3.0))
    left, right = figure.subplots(1, 2, width_ratios=[1.25, 1.0])
    _map(figure, left, mesh)
    _distribution(right, mesh["courant"].values, mesh["area"].values, limit)
    letter(left, "a", "around the section")
    letter(right, "b", "distribution")
    legend_above(figure, right, columns=3)
    add_provenance(
        figure,
        solver_of(str(mesh.attrs["solver_description"]), str(mesh.attrs["resolution"])),
        f"{mesh.attrs['incidence_deg']:g} deg, {mesh.attrs['flow']}",
        f"time step {mesh.attrs['time_step']:g} c/V",
    )
    return figure


def _map(figure: Figure, axes: Axes, mesh: xr.Dataset) -> None:
    points = np.stack([mesh["x"].values, mesh["y"].values], axis=-1)
    cells, courant = points[mesh["corners"].values], mesh["courant"].values
    low, high = np.asarray(WINDOW).T
    inside = ((cells.max(axis=1) >= low) & (cells.min(axis=1) <= high)).all(axis=1)
    shown = np.maximum(courant[inside], SMALLEST)
    drawn = PolyCollection(
        list(cells[inside]),
        array=shown,
        cmap="viridis",
        norm=LogNorm(SMALLEST, max(float(shown.max()), 1.0)),
        edgecolors="none",
        antialiaseds=False,
        rasterized=True,
    )
    axes.add_collection(drawn)
    axes.set(xlim=WINDOW[0], ylim=WINDOW[1], xlabel="$x/c$", ylabel="$y/c$")
    axes.set_aspect("equal")
    axes.grid(visible=False)
    figure.colorbar(drawn, ax=axes, label="Co", shrink=0.8, extend="min")


def _distribution(axes: Axes, courant: Floats, area: Floats, limit: float) -> None:
    order = np.argsort(courant)
    for number, (weight, name) in enumerate(
        ((area, "part of the area"), (np.ones_like(area), "part of the cells"))
    ):
        mean = float(np.average(courant, weights=weight))
        axes.plot(
            courant[order],
            100 * np.cumsum(weight[order]) / weight.sum(),
            color=COLOURS[number],
            linestyle=DASHES[number],
            label=f"{name}, mean {rounded(mean, 2)}",
        )
    below = 100 * share_below(limit, courant, area)
    axes.axvline(
        limit,
        color=BLUE,
        linewidth=0.7,
        linestyle=DASHES[3],
        label=f"{below:.1f} % of the area below {limit:g}",
    )
    axes.axvline(courant.max(), color=GREY, linewidth=0.7, linestyle=":")
    axes.annotate(
        f"largest {rounded(courant.max(), 2)}",
        (courant.max(), 50.0),
        xytext=(-3, 0),
        textcoords="offset points",
        rotation=90,
        ha="right",
        va="center",
        fontsize=7,
        color=GREY,
    )
    axes.set(xscale="log", xlim=(SMALLEST, 1.6 * courant.max()), ylim=(0, 102))
    axes.set(xlabel="Co", ylabel="part with less (%)")
