"""Flow across the stream near the tip with its turbulence, rigid and flexible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, say
from equisection.figures.references import read_references
from equisection.figures.style import BLACK, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_dataset
from equisection.results.tip_flow import TipFlow, tip_flow_from_dataset
from equisection.results.unsteady_result import BOUNDED
from equisection.store.index import read_index, result_file
from equisection.study import plan
from equisection.study.axes import K_STAR, Point


@dataclass(frozen=True)
class Column:
    """A column of the figure.

    Attributes
    ----------
    title
        Kind of plate, for instance ``rigid``.
    says
        Solver, resolution and state of the flow; the reason if there is no flow.
    flow
        The flow near its tip, if there is one.
    """

    title: str
    says: str
    flow: TipFlow | None = None


def column_of(title: str, result: xr.Dataset) -> Column:
    """Return the column of a steady or an unsteady result of the plate."""
    flow, failure = tip_flow_from_dataset(result), failure_of(result.attrs)
    if flow is None:
        why = f"it failed ({failure})" if failure else "docs/files.md says how to have it made"
        return Column(title, f"The result has no flow near the tip: {why}.")
    made = solver_of(str(result.attrs["solver_description"]), str(result.attrs["resolution"]))
    return Column(title, f"{made}, {flow.state}", flow)


def from_files(
    index_of_rigid: Path,
    index_of_beam: Sequence[Path],
    references: Sequence[Path],
    resolution: str,
    incidence_deg: float,
) -> Figure:
    """Draw the rigid beam at the incidence nearest the run's (deg), and the flexible one.

    ``index_of_beam`` is one index, or none where the beam is not run. The figure shows the run
    nearest to a k* of the references, or else the softest whose motion stays bounded.
    """
    wanted = read_references(references, "flow_at_tip_k_star")["value"]
    return draw(
        [
            _of_rigid(index_of_rigid, resolution, incidence_deg),
            _of_flexible(index_of_beam, [float(k_star) for k_star in wanted]),
        ]
    )


def _of_rigid(index: Path, resolution: str, incidence_deg: float) -> Column:
    names = [name for name in read_index(index) if plan.rigid_point(name)[0] == resolution]
    if not names:
        return Column("rigid", f"The rigid beam has no result at resolution '{resolution}'.")
    name = min(names, key=lambda name: abs(plan.rigid_point(name)[1] - incidence_deg))
    return column_of("rigid", read_dataset(result_file(index, name)))


def _k_star(name: str) -> float:
    return Point.named(name)[K_STAR]


def _of_flexible(indices: Sequence[Path], wanted: Sequence[float]) -> Column:
    if not indices:
        return Column("flexible", "The flexible beam is not among the models of the sweep.")
    (index,) = indices
    runs = {name: result for name, result in read_index(index).items() if not failure_of(result)}
    if not runs:
        return Column("flexible", "Every run of the flexible beam failed.")
    bounded = [name for name, result in runs.items() if result["regime"] in BOUNDED]
    k_star = next(iter(wanted), min(map(_k_star, bounded or runs)))
    name = min(runs, key=lambda name: abs(_k_star(name) - k_star))
    title = f"k* = {_k_star(name):g}"
    return column_of(title, read_dataset(result_file(index, name)))


def draw(columns: Sequence[Column]) -> Figure:
    """Draw planes across the stream, from the plate into its wake, for each plate.

    Parameters
    ----------
    columns
        The plates: the rigid one (left), the flexible one (right).
    """
    flows = [shown.flow for shown in columns if shown.flow is not None]
    rows = max((flow.x.size for flow in flows), default=1)
    figure = Figure(figsize=(PAGE_WIDTH, 1.0 + 2.45 * rows if flows else 2.6))
    panels = figure.subplots(rows, len(columns), squeeze=False)
    scale = Normalize(0.0, max((float(np.nanmax(flow.turbulence)) for flow in flows), default=1.0))
    for column, shown in enumerate(columns):
        for row, axes in enumerate(panels[:, column]):
            place = "abcdefghijkl"[row * len(columns) + column]
            if shown.flow is None:
                letter(axes, place, shown.title)
                say(axes, shown.says)
                continue
            position = shown.flow.x[row] + 0.5
            letter(axes, place, f"{shown.title}, {position:.3g} c from the leading edge")
            _plane(axes, shown.flow, row, scale)
            axes.set_xlabel("$z/c$" if row == rows - 1 else "")
            axes.set_ylabel("$y/c$" if column == 0 else "")
    if flows:
        figure.colorbar(
            ScalarMappable(scale, "viridis"), ax=panels, label=r"$k/V_\infty^2$", shrink=0.7
        )
    known = [f"{shown.title}: {shown.says}" for shown in columns if shown.flow is not None]
    add_provenance(figure, *known)
    return figure


def _plane(axes: Axes, flow: TipFlow, number: int, scale: Normalize) -> None:
    # up to the plate, which hides what is inside it
    inside = np.abs(flow.y[:, None] - flow.chord_line[number]) < flow.thickness
    turbulence = np.where(inside, np.nan_to_num(flow.turbulence[number]), flow.turbulence[number])
    axes.pcolormesh(
        flow.z,
        flow.y,
        np.ma.masked_invalid(turbulence),
        norm=scale,
        cmap="viridis",
        shading="gouraud",
        rasterized=True,
    )
    across, up = (np.ma.masked_invalid(flow.velocity[number, ..., n]) for n in (2, 1))
    axes.streamplot(
        flow.z, flow.y, across, up, density=1.1, color="white", linewidth=0.45, arrowsize=0.5
    )
    _plate(axes, flow, number)
    axes.axvline(flow.span, color=LIGHT_GREY, linewidth=0.6, linestyle=":")
    half = 0.5 * (flow.y[1] - flow.y[0])
    axes.set(xlim=(flow.z[0] - half, flow.z[-1] + half), ylim=(flow.y[0] - half, flow.y[-1] + half))
    axes.set_aspect("equal")
    axes.grid(visible=False)


def _plate(axes: Axes, flow: TipFlow, number: int) -> None:
    """Draw the plate's section by the plane, which ends at the tip."""
    there = np.isfinite(flow.chord_line[number])
    if not there.any():
        return
    z, middle = flow.z[there], flow.chord_line[number, there]
    z = np.append(z, flow.span)
    middle = np.append(middle, middle[-1])
    half = 0.5 * flow.thickness
    outline = np.concatenate(
        [np.stack([z, middle + half], -1), np.stack([z, middle - half], -1)[::-1]]
    )
    axes.add_patch(Polygon(outline, facecolor=GREY, edgecolor=BLACK, linewidth=0.4, zorder=3))
