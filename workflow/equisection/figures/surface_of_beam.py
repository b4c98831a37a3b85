"""Pressure and lines of the wall shear stress on both sides of the rigid beam."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from equisection.figures.incidences import nearest_incidences
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, say
from equisection.figures.style import BLACK, PAGE_WIDTH, VERMILLION
from equisection.results.netcdf import read_dataset
from equisection.results.plate_surface import PlateSurface, plate_surface_from_dataset
from equisection.results.surface import suction_side
from equisection.store.index import read_index, result_file
from equisection.study import plan

Floats = NDArray[np.float64]

#: Incidences (deg) that are shown, or those nearest: two of a short and a long bubble, and one
#: beyond stall.
WANTED_DEG = (2.0, 4.0, 10.0)
#: Distance of the points of the regular grid (chords), and part of the faces that is left out of
#: the scale at either end.
STEP, BEYOND_SCALE = 0.02, 0.02
#: More than the rounding of places in a file (chords).
ROUNDING = 1e-5


@dataclass(frozen=True)
class ShownSurface:
    """Surface data of the plate at an incidence, and their origin."""

    surface: PlateSurface
    method: str


@dataclass(frozen=True)
class Side:
    """One side of the plate on a regular grid.

    Attributes
    ----------
    z, x : (n,), (m,) array
        z/c, and x/c or the arc length of an outline.
    pressure, friction, spanwise_friction : (m, n) array
        c_p, and c_f along the chord and along the span.
    """

    z: Floats
    x: Floats
    pressure: Floats
    friction: Floats
    spanwise_friction: Floats


def on_grid(faces: PlateSurface, span: float) -> Side:
    """Interpolate the faces of one side linearly; beyond their middles nothing changes.

    Those of an outline that is no rectangle are laid out along their arc length.
    """
    x = _middles(float(faces.along_side.max())) if faces.has_outline else _middles(1.0)
    z = _middles(span)
    grid = np.meshgrid(_within(z, faces.z), _within(x, faces.along_side))
    values = np.stack([faces.pressure, faces.friction, faces.spanwise_friction], axis=-1)
    there = scipy.interpolate.griddata(
        np.stack([faces.z, faces.along_side], axis=-1), values, tuple(grid), method="linear"
    )
    return Side(z, x, there[..., 0], there[..., 1], there[..., 2])


def _middles(end: float) -> Floats:
    count = round(end / STEP)
    return (np.arange(count) + 0.5) * end / count


def _within(places: Floats, known: Floats) -> Floats:
    """Return the places moved into the range of those known, a little more than rounding."""
    return np.clip(places, known.min() + ROUNDING, known.max() - ROUNDING)


def from_files(index_of_rigid: Path, resolution: str) -> Figure:
    """Draw the results at a resolution, at the incidences nearest to those wanted."""
    names = {plan.rigid_point(name): name for name in read_index(index_of_rigid)}
    found, without, source = {}, [], ""
    for (_, angle), name in sorted(item for item in names.items() if item[0][0] == resolution):
        result = read_dataset(result_file(index_of_rigid, name))
        source = solver_of(str(result.attrs["solver_description"]), resolution)
        surface = plate_surface_from_dataset(result)
        if surface is None:
            without.append(f"{angle:g}")
        else:
            found[angle] = ShownSurface(surface, str(result.attrs["method"]))
    shown = {angle: found[angle] for angle in nearest_incidences(list(found), WANTED_DEG)}
    missing = [f"no surface data at {', '.join(without)} deg"] if without else []
    return draw(shown, missing, source)


def draw(surfaces: Mapping[float, ShownSurface], missing: Sequence[str], source: str) -> Figure:
    """Draw the pressure side (left) and the suction side (right) at each incidence.

    The title of a suction side has the end of its bubble in the layer at the root.

    Parameters
    ----------
    surfaces
        Surface data by incidence (deg), ascending.
    missing
        Incidences that have none, a sentence each with the reason.
    source
        Solver and resolution, in words.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 0.9 + 1.1 * max(len(surfaces), 1)))
    panels = figure.subplots(max(len(surfaces), 1), 2, squeeze=False)
    if not surfaces:
        for axes, place in zip(panels.ravel(), "ab", strict=True):
            letter(axes, place, "pressure side" if place == "a" else "suction side")
            say(axes, "No incidence has surface data of the plate.")
    scale = _scale(surfaces)
    for row, (angle, shown) in enumerate(surfaces.items()):
        suction = suction_side(angle)
        sides = ("lower" if suction == "upper" else "upper", suction)
        for column, (side, name) in enumerate(zip(sides, ("pressure", "suction"), strict=True)):
            axes = panels[row, column]
            title = rf"$\theta$ = {angle:g} deg, {name} side"
            if name == "suction":
                title += f": bubble {shown.surface.reattachment(side)[1][0]:.2f} c"
            letter(axes, "abcdefgh"[2 * row + column], title)
            _map(axes, on_grid(shown.surface.on(side), shown.surface.span), scale)
            axes.set_xlabel("$z/c$" if row == len(surfaces) - 1 else "")
            along = "$s/c$" if shown.surface.has_outline else "$x/c$"
            axes.set_ylabel(along if column == 0 else "")
    if surfaces:
        _explain(figure, panels, scale)
    methods = [f"{angle:g} deg: {shown.method}" for angle, shown in surfaces.items()]
    add_provenance(figure, f"rigid 3D beam: {source}", *methods, *missing)
    return figure


def _scale(surfaces: Mapping[float, ShownSurface]) -> Normalize:
    """Return one scale of the pressure for all panels, without the peaks at the edges."""
    every = [
        shown.surface.on(side).pressure
        for shown in surfaces.values()
        for side in ("lower", "upper")
    ]
    values = np.concatenate(every) if every else np.zeros(1)
    return Normalize(*np.quantile(values, [BEYOND_SCALE, 1.0 - BEYOND_SCALE]))


def _map(axes: Axes, side: Side, scale: Normalize) -> None:
    axes.pcolormesh(
        side.z,
        side.x,
        side.pressure,
        norm=scale,
        cmap="viridis",
        shading="nearest",
        rasterized=True,
    )
    axes.streamplot(
        side.z,
        side.x,
        side.spanwise_friction,
        side.friction,
        density=(1.3, 0.5),
        color=BLACK,
        linewidth=0.4,
        arrowsize=0.5,
    )
    if side.friction.min() < 0.0 < side.friction.max():
        axes.contour(side.z, side.x, side.friction, levels=[0.0], colors=VERMILLION, linewidths=0.8)
    # seen from above, the stream comes from the top of the panel
    axes.set(xlim=(0.0, side.z[-1] + side.z[0]), ylim=(side.x[-1] + side.x[0], 0.0))
    axes.set_aspect("equal")
    axes.grid(visible=False)


def _explain(figure: Figure, panels: NDArray[np.object_], scale: Normalize) -> None:
    figure.colorbar(
        ScalarMappable(scale, "viridis"), ax=panels, label="$c_p$", extend="both", shrink=0.8
    )
    handles = [
        Line2D([], [], color=BLACK, linewidth=0.6, label="lines of the wall shear stress"),
        Line2D([], [], color=VERMILLION, linewidth=0.8, label="$c_f$ = 0 along the chord"),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=2)
