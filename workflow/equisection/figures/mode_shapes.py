"""Shapes of the first modes along the span, with those of the analytic beam."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from equisection.beam.beam import Beam
from equisection.figures.origin import add_provenance
from equisection.figures.panels import letter, say
from equisection.figures.style import COLOURS, DASHES, GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.structure import analytic
from equisection.structure.span import normalise

Floats = NDArray[np.float64]

#: Modes of either kind that are shown.
COUNT = 4
_STATIONS = 201


@dataclass(frozen=True)
class AnalyticShapes:
    """Shapes of the analytic beam.

    Attributes
    ----------
    span : (m,) array
        z/L.
    bending, torsion : (n, m) array
        g_i and f_i, largest absolute value 1.
    """

    span: Floats
    bending: Floats
    torsion: Floats


def analytic_shapes(beam: Beam) -> AnalyticShapes | None:
    """Return the first shapes of the analytic beam with the beam's ends.

    There are none of a beam with supports or lumped masses along its span.
    """
    if beam.has_fittings:
        return None
    span = np.linspace(0.0, 1.0, _STATIONS)
    return AnalyticShapes(
        span,
        normalise(analytic.bending_modes(beam, span, COUNT)[1]),
        normalise(analytic.torsion_modes(beam, span, COUNT)[1]),
    )


def from_files(modes: Path, beam: Mapping[str, Any]) -> Figure:
    """Draw ``structure/modes.nc`` of a beam, given by the configuration's section."""
    return draw(read_dataset(modes), analytic_shapes(Beam(**beam)))


def draw(modes: xr.Dataset, beam: AnalyticShapes | None) -> Figure:
    """Draw the first shapes: bending left, torsion right.

    Parameters
    ----------
    modes
        ``structure/modes.nc``.
    beam
        Shapes of the analytic beam, where there are any.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.0))
    left, right = figure.subplots(1, 2, sharey=True)
    shown = max(
        _shapes(left, modes, "bending", beam),
        _shapes(right, modes, "torsion", beam),
    )
    letter(left, "a", "bending")
    letter(right, "b", "torsion")
    left.set_ylabel("normalised shape $g_i$")
    right.set_ylabel("normalised shape $f_i$")
    handles = [
        Line2D([], [], color=COLOURS[i], linestyle=DASHES[i], label=f"mode {i + 1}")
        for i in range(shown)
    ]
    if beam is not None:
        handles.append(Line2D([], [], color=GREY, linewidth=0.6, label="analytic beam"))
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    mesh = "" if modes.attrs["elements"] == "none" else f", elements: {modes.attrs['elements']}"
    add_provenance(figure, f"modes by method '{modes.attrs['method']}'{mesh}", "no flow solver")
    return figure


def _shapes(axes: Axes, modes: xr.Dataset, kind: str, beam: AnalyticShapes | None) -> int:
    """Draw the shapes of one kind and return how many there are."""
    shapes = modes["shape"].values[modes["kind"].values == kind][:COUNT]
    for number, shape in enumerate(shapes):
        axes.plot(modes["span"], shape, color=COLOURS[number], linestyle=DASHES[number])
    if len(shapes) == 0:
        say(axes, f"No {kind} mode was computed.")
        return 0
    if beam is not None:
        for line in (beam.bending if kind == "bending" else beam.torsion)[: len(shapes)]:
            axes.plot(beam.span, line, color=GREY, linewidth=0.6)
    axes.axhline(0.0, color=GREY, linewidth=0.5)
    axes.set(xlim=(0.0, 1.0), ylim=(-1.12, 1.12), xlabel="$z/L$")
    return len(shapes)
