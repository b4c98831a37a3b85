"""A coefficient of section, root and beam over incidence, and its correction factor."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.models import Look
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import legend_above, letter, say, without_data
from equisection.figures.style import BLACK, BLUE, GREY, PAGE_WIDTH, PURPLE, VERMILLION
from equisection.results.netcdf import read_dataset
from equisection.results.polar_dataset import at_resolution

#: Least distance of the factor 1 from both ends of its axis: a beam from wall to wall has 1 to
#: rounding, which is not to be enlarged.
_LEAST_MARGIN = 0.02


@dataclass(frozen=True)
class Coefficient:
    """A coefficient, by its names in files and its symbols."""

    name: str  # in the polars
    factor: str  # in the correction
    section: str  # symbol of the section's
    beam: str  # symbol of the beam's
    title: str


@dataclass(frozen=True)
class SteadyData:
    """``steady/polar_2d.nc``, ``polar_3d.nc`` and ``correction.nc``, and the resolution shown."""

    section: xr.Dataset
    beam: xr.Dataset
    correction: xr.Dataset
    resolution: str


def read_steady(polar_2d: Path, polar_3d: Path, correction: Path, resolution: str) -> SteadyData:
    """Read the two polars and the correction between them."""
    return SteadyData(
        read_dataset(polar_2d), read_dataset(polar_3d), read_dataset(correction), resolution
    )


def draw_correction(data: SteadyData, coefficient: Coefficient) -> Figure:
    """Draw the coefficient over incidence (left) and its correction factor (right)."""
    for polar, what in ((data.section, "section"), (data.beam, "beam")):
        if data.resolution not in polar["resolution"].values:
            return without_data(f"No rigid {what} was run at resolution '{data.resolution}'.")
    figure = Figure(figsize=(PAGE_WIDTH, 3.1))
    left, right = figure.subplots(1, 2)
    _coefficients(left, data, coefficient)
    _factor(right, data.correction, coefficient)
    letter(left, "a", coefficient.title)
    letter(right, "b", "correction factor (dotted: 1, no correction)")
    legend_above(figure, left, columns=3)
    solvers = {
        place: solver_of(str(polar.attrs[f"solver_{data.resolution}"]), data.resolution)
        for place, polar in (("2D", data.section), ("3D", data.beam))
    }
    if solvers["2D"] == solvers["3D"]:
        add_provenance(figure, f"2D and 3D: {solvers['2D']}")
    else:
        add_provenance(figure, *(f"{place}: {text}" for place, text in solvers.items()))
    return figure


def _coefficients(axes: Axes, data: SteadyData, coefficient: Coefficient) -> None:
    section = at_resolution(data.section, data.resolution)
    beam = at_resolution(data.beam, data.resolution)
    name = coefficient.name
    series = [
        (section[name], Look("2D section", VERMILLION, "s", (0, (5, 1.6)))),
        (beam[name], Look("3D global", BLACK, "o")),
    ]
    if beam.sizes.get("span"):
        root = beam[f"{name}_section"].isel(span=int(np.argmin(beam["span"].values)))
        label = f"3D root section ($z/L$ = {float(root['span']):.2g})"
        series.insert(1, (root, Look(label, BLUE, "^", (0, (2.2, 1.2)))))
    if data.correction.attrs.get("correction") == "modal":
        felt = data.correction[f"beam_{name}"].rename(beam_incidence_deg="incidence_deg")
        series.append((felt, Look("3D, as the first mode feels it", PURPLE, "D", (0, (1, 1)))))
    if not any(np.isfinite(values).any() for values, _ in series):
        say(axes, "No incidence has a result.")
        return
    for values, look in series:
        axes.plot(
            values["incidence_deg"],
            values,
            label=look.label,
            color=look.colour,
            marker=look.marker,
            linestyle=look.line,
        )
    axes.set(xlabel=r"$\theta$ (deg)", ylabel=f"${coefficient.section}$,  ${coefficient.beam}$")


def _factor(axes: Axes, correction: xr.Dataset, coefficient: Coefficient) -> None:
    factor = correction[coefficient.factor]
    if not np.isfinite(factor).any():
        say(axes, "There is no correction factor.")
        return
    axes.axhline(1.0, color=GREY, linewidth=1.0, linestyle=":")
    axes.plot(factor["incidence_deg"], factor, color=BLACK, marker="o")
    low, high = axes.get_ylim()
    margin = max(0.05 * (high - low), _LEAST_MARGIN)
    axes.set_ylim(min(low, 1.0 - margin), max(high, 1.0 + margin))
    axes.set(xlabel=r"$\theta$ (deg)", ylabel=f"${coefficient.section}/{coefficient.beam}$")
