"""Lift and moment of the rigid section over incidence, at each resolution.

With a grid study, their grid convergence index and observed order are below, where they are not nil
by symmetry.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from equisection.analysis.grid_limit import is_credible
from equisection.figures.origin import add_provenance
from equisection.figures.panels import legend_above, letter, say
from equisection.figures.style import COLOURS, DASHES, GREY, MARKERS, PAGE_WIDTH
from equisection.results.netcdf import read_dataset


def from_files(polar_2d: Path, grid_study: Sequence[Path]) -> Figure:
    """Draw ``steady/polar_2d.nc``; ``grid_study`` is one table, or none."""
    return draw(read_dataset(polar_2d), *(pd.read_csv(path) for path in grid_study))


def draw(polar: xr.Dataset, grid_study: pd.DataFrame | None = None) -> Figure:
    """Draw c_l (left) and c_m (right) at every resolution, and their grid convergence (below).

    Parameters
    ----------
    polar
        ``steady/polar_2d.nc``.
    grid_study
        ``tables/grid_study.csv``, where the run has one.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.1 if grid_study is None else 5.2))
    rows = figure.subplots(1 if grid_study is None else 2, 2, squeeze=False)
    panels = rows[0]
    resolutions = [str(name) for name in polar["resolution"].values]
    densest = int(polar["is_run"].sum("incidence_deg").max()) if resolutions else 0
    for axes, name in zip(panels, ("cl", "cm"), strict=True):
        for number, resolution in enumerate(resolutions):
            of_resolution = polar.sel(resolution=resolution)
            run = of_resolution.isel(incidence_deg=of_resolution["is_run"].values == 1)
            # a line through few points would cut the bend that a denser polar shows
            joined = 2 * run["incidence_deg"].size > densest
            axes.plot(
                run["incidence_deg"],
                run[name],
                color=COLOURS[number % len(COLOURS)],
                linestyle=DASHES[number % len(DASHES)] if joined else "none",
                marker=MARKERS[number % len(MARKERS)],
                fillstyle="full" if number == 0 else "none",
                label=f"{resolution}: {polar.attrs[f'solver_{resolution}']}",
            )
        if not np.isfinite(polar[name].values).any():
            say(axes, "No incidence has a result.")
        axes.set_xlabel(r"$\theta$ (deg)")
    panels[0].set_ylabel("$c_l$")
    panels[1].set_ylabel("$c_m$ about mid-chord")
    letter(panels[0], "a", "lift")
    letter(panels[1], "b", "moment")
    if grid_study is not None:
        for axes, name, place, title in zip(
            rows[1], ("cl", "cm"), "cd", ("lift", "moment"), strict=True
        ):
            _convergence(axes, grid_study[grid_study["coefficient"] == name])
            letter(axes, place, f"grid convergence index of the {title}")
        rows[1][0].set_ylabel("GCI (%)")
    legend_above(figure, panels[0], columns=1 if len(resolutions) < 3 else 2)
    add_provenance(figure, "rigid 2D section", *_failed(polar))
    return figure


def _convergence(axes: Axes, study: pd.DataFrame) -> None:
    """Draw the index of the finest mesh with the observed order at each point."""
    credible = study["observed_order"].astype(float).map(is_credible)
    shown = study[np.isfinite(study["gci"].astype(float)) & credible]
    if shown.empty:
        say(axes, "No incidence has an observed order of convergence.")
        return
    for number, (kind, rows) in enumerate(shown.groupby("convergence")):
        axes.plot(
            rows["incidence_deg"],
            100 * rows["gci"],
            linestyle="none",
            color=COLOURS[number],
            marker=MARKERS[number],
            label=f"{kind}, with observed order p",
        )
    for _, row in shown.iterrows():
        axes.annotate(
            f"{row['observed_order']:.1f}",
            (row["incidence_deg"], 100 * row["gci"]),
            xytext=(4, 3),
            textcoords="offset points",
            fontsize=7,
            color=GREY,
        )
    undefined = study["incidence_deg"].size - shown["incidence_deg"].size
    if undefined:
        axes.plot(
            [], [], linestyle="none", label=f"none for {undefined} of {len(study)} incidences"
        )
    axes.set(xlabel=r"$\theta$ (deg)", yscale="log")
    axes.margins(x=0.08, y=0.25)
    decades = math.log10(shown["gci"].max() / shown["gci"].min())
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if decades < 2 else (1.0,)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.legend(loc="best")


def _failed(polar: xr.Dataset) -> list[str]:
    cases = polar["cl"].values[polar["is_run"].values == 1]
    count = int(np.isnan(cases).sum())
    return [f"{count} of {cases.size} cases have no result"] if count else []
