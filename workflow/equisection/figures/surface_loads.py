"""y+, pressure and friction along both sides of the section, and the length of its bubble."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.panels import letter, say
from equisection.figures.references import read_references
from equisection.figures.style import BLUE, COLOURS, DASHES, GREY, MARKERS, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.surface import SectionSurface, suction_side, surface_from_dataset
from equisection.store.index import result_file
from equisection.study import plan

#: Incidences (deg) that are shown beside the run's own.
WANTED_DEG = (1.0, 5.0, 10.0)
#: x/c from which friction is shown: the vortices at the leading edge would hide the rest.
CLEAR = 0.02
#: Line of each side.
SIDES = {"upper": DASHES[0], "lower": DASHES[1]}


def incidences_shown(available_deg: Sequence[float], own_deg: float) -> list[float]:
    """Return the run's incidence and those wanted (deg), as far as there are any, ascending."""
    return sorted({*WANTED_DEG, own_deg} & set(available_deg))


def from_files(
    index: Path,
    bubble: Path,
    references: Sequence[Path],
    resolution: str,
    incidence_deg: float,
) -> Figure:
    """Draw the results at a resolution, at the incidence of the run (deg) and others."""
    table = pd.read_csv(bubble)
    there = table[(table["resolution"] == resolution) & table["bubble"].notna()]
    surfaces = {}
    for angle in incidences_shown(there["incidence_deg"].tolist(), incidence_deg):
        result = read_dataset(result_file(index, plan.rigid_case(resolution, angle)))
        surface = surface_from_dataset(result)
        if surface is not None:
            surfaces[angle] = surface
    return draw(surfaces, table, resolution, read_references(references, "bubble"))


def draw(
    surfaces: Mapping[float, SectionSurface],
    bubble: pd.DataFrame,
    resolution: str,
    stated: pd.DataFrame,
) -> Figure:
    """Draw y+ (a), c_p (b) and c_f (c) over x/c, and the bubble over incidence (d).

    Parameters
    ----------
    surfaces
        Surface data of the incidences (deg) to show, at the resolution of the run.
    bubble
        ``tables/bubble.csv``.
    resolution
        The resolution of the run.
    stated
        Further lengths of the bubble over the chord to draw, by incidence (deg), as
        :func:`read_references` returns them.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 5.2))
    panels = figure.subplots(2, 2).ravel()
    for axes, place, title in zip(
        panels,
        "abcd",
        (
            "wall distance",
            "pressure",
            f"friction on the suction side from {CLEAR:g} c on",
            "length of the bubble",
        ),
        strict=True,
    ):
        letter(axes, place, title)
    if surfaces:
        _wall_distance(panels[0], surfaces)
        _pressure(panels[1], surfaces)
        _friction(panels[2], surfaces)
        handles = _legend(surfaces, bubble[bubble["resolution"] == resolution])
        figure.legend(handles=handles, loc="outside upper center", ncols=3)
    else:
        for axes in panels[:3]:
            say(axes, f"No incidence has surface data at resolution '{resolution}'.")
    _bubble(panels[3], bubble, stated)
    add_provenance(figure, *_sources(bubble, resolution))
    return figure


def _wall_distance(axes: Axes, surfaces: Mapping[float, SectionSurface]) -> None:
    for number, surface in enumerate(surfaces.values()):
        for side, line in SIDES.items():
            faces = surface.on(side)
            axes.plot(faces.x, faces.y_plus, color=COLOURS[number], linestyle=line)
    axes.axhline(1.0, color=GREY, linewidth=0.7, linestyle=":")
    axes.set(yscale="log", xlim=(0.0, 1.0), xlabel="$x/c$", ylabel="$y^+$")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())


def _pressure(axes: Axes, surfaces: Mapping[float, SectionSurface]) -> None:
    for number, surface in enumerate(surfaces.values()):
        for side, line in SIDES.items():
            faces = surface.on(side)
            axes.plot(faces.x, faces.pressure, color=COLOURS[number], linestyle=line)
    axes.invert_yaxis()
    axes.set(xlim=(0.0, 1.0), xlabel="$x/c$", ylabel="$c_p$")


def _friction(axes: Axes, surfaces: Mapping[float, SectionSurface]) -> None:
    axes.axhline(0.0, color=GREY, linewidth=0.7, linestyle=":")
    for number, (angle, surface) in enumerate(surfaces.items()):
        side = suction_side(angle)
        faces = surface.on(side)
        clear = faces.x > CLEAR
        axes.plot(
            faces.x[clear],
            1e3 * faces.friction[clear],
            color=COLOURS[number],
            linestyle=SIDES[side],
        )
    axes.set(xlim=(0.0, 1.0), xlabel="$x/c$", ylabel="$10^3 c_f$")


def _legend(surfaces: Mapping[float, SectionSurface], bubble: pd.DataFrame) -> list[Line2D]:
    methods = dict(zip(bubble["incidence_deg"], bubble["method"], strict=True))
    angles = []
    for number, angle in enumerate(surfaces):
        mean = ", mean of unsteady" if str(methods[angle]).startswith("mean") else ""
        label = rf"$\theta$ = {angle:g} deg{mean}"
        angles.append(Line2D([], [], color=COLOURS[number], label=label))
    sides = [
        Line2D([], [], color=GREY, linestyle=line, label=f"{side} side")
        for side, line in SIDES.items()
    ]
    return [*angles, *sides]


def _bubble(axes: Axes, bubble: pd.DataFrame, stated: pd.DataFrame) -> None:
    known = bubble[bubble["bubble"].notna()]
    if known.empty:
        say(axes, "No result has surface data.")
        return
    for number, (resolution, rows) in enumerate(known.groupby("resolution", sort=False)):
        axes.plot(
            rows["incidence_deg"],
            rows["bubble"],
            color=COLOURS[number],
            linestyle=DASHES[number],
            marker=MARKERS[number],
            fillstyle="full" if number == 0 else "none",
            label=str(resolution),
        )
    for label, values in stated.groupby("label", sort=False):
        axes.plot(
            values["at"],
            values["value"],
            linestyle="none",
            color=BLUE,
            marker="*",
            markersize=9,
            label=str(label),
        )
    axes.set(xlabel=r"$\theta$ (deg)", ylabel="reattachment $x/c$", ylim=(0.0, 1.05))
    axes.legend(loc="best")


def _sources(bubble: pd.DataFrame, resolution: str) -> list[str]:
    """Say who made the bubbles, how the curves of the run were made, and what is missing."""
    made = solvers_of(zip(bubble["solver"], bubble["resolution"], strict=True))
    without = int(bubble["bubble"].isna().sum())
    notes = [f"(a) to (c): resolution {resolution}"]
    if without:
        notes.append(f"{without} of {len(bubble)} cases have no surface data, see bubble.csv")
    return ["rigid 2D section", *made, *notes]
