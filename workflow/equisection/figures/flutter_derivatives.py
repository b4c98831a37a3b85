"""Flutter derivatives of the section over the reduced velocity, with those of a thin plate."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from equisection.aerodynamics.derivatives import Derivatives
from equisection.figures.origin import add_provenance
from equisection.figures.panels import legend_above
from equisection.figures.style import COLOURS, GREY, MARKERS, PAGE_WIDTH
from equisection.io.derivative_table import DERIVATIVES


def from_files(table: Path) -> Figure:
    """Draw ``derivatives/2d.csv``."""
    return draw(Derivatives.read(table))


def draw(table: Derivatives) -> Figure:
    """Draw H1* to H4* (above) and A1* to A4* (below), with their spread.

    Parameters
    ----------
    table
        The derivatives.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.9))
    panels = figure.subplots(2, 4, sharex=True)
    first, last = map(float, table.reduced_velocity[[0, -1]])
    plate = Derivatives.theodorsen(np.linspace(first, last, 80), table.axis)
    for number, (axes, name) in enumerate(zip(panels.flat, DERIVATIVES, strict=True)):
        axes.plot(plate.reduced_velocity, plate.values[:, number], color=GREY, label=plate.label)
        axes.errorbar(
            table.reduced_velocity,
            table.values[:, number],
            yerr=None if table.spread is None else table.spread[:, number],
            color=COLOURS[0],
            marker=MARKERS[0],
            linestyle="none",
            label=table.label or "derivatives",
        )
        axes.set_ylabel(f"${name[0]}_{name[1]}^*$")
        axes.axhline(0.0, color=GREY, linewidth=0.4)
    for axes in panels[1]:
        axes.set_xlabel("$V/(f c)$")
    legend_above(figure, panels[0][0], columns=2)
    add_provenance(figure, "2D section, about mid-chord, Scanlan's convention, heave down")
    return figure
