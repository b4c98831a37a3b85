"""Part of each mode in the mean deformation of the beam at its stiffest case."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from equisection.analysis.deviations import NIL
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, say, without_data
from equisection.figures.style import COLOURS, DASHES, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.keys.shown import rounded
from equisection.results.netcdf import read_dataset
from equisection.store.index import read_index, result_file
from equisection.study import plan

Floats = NDArray[np.float64]

#: Modes that are shown.
COUNT = 4


@dataclass(frozen=True)
class ModalParts:
    """Mean deformation along the span, mode by mode.

    Attributes
    ----------
    span : (m,) array
        z/L.
    parts : (n, m) array
        Part of each mode, rad or chords.
    amplitudes : (n,) array
        Mean amplitude of each mode, that is its part where its shape is 1 (rad or chords).
    """

    span: Floats
    parts: Floats
    amplitudes: Floats

    @property
    def ratios(self) -> Floats:
        """Amplitude of the first mode over that of each mode (1 for the first)."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.abs(self.amplitudes[0]) / np.abs(self.amplitudes))


def modal_parts(modes: xr.Dataset, run: xr.Dataset, kind: str) -> ModalParts | None:
    """Return the mean deformation by modes over the window of the verdict, if there is any.

    Parameters
    ----------
    modes
        ``structure/modes.nc``.
    run
        Result of a beam (``unsteady/3d/<case>.nc``).
    kind
        ``bending`` or ``torsion``.
    """
    name = f"{kind}_amplitude"
    if name not in run or run["time"].size == 0 or run.attrs["regime"] == "failed":
        return None
    window = run["time"].values >= float(run.attrs["window_start"])
    amplitudes = run[name].values[:COUNT, window].mean(axis=1)
    shapes = modes["shape"].values[modes["kind"].values == kind][: len(amplitudes)]
    return ModalParts(
        span=modes["span"].values, parts=amplitudes[:, None] * shapes, amplitudes=amplitudes
    )


def from_files(modes: Path, index_of_beam: Sequence[Path]) -> Figure:
    """Draw the part of each mode in the deformation of the stiffest beam that was run."""
    (index,) = index_of_beam
    case = plan.stiffest_case(read_index(index))
    if case is None:
        return without_data("There is no run of the beam.")
    return draw(read_dataset(modes), read_dataset(result_file(index, case)))


def draw(modes: xr.Dataset, run: xr.Dataset) -> Figure:
    """Draw the deformation along the span by modes, and the size of each mode's part.

    Parameters
    ----------
    modes
        ``structure/modes.nc``.
    run
        Result of the beam at one k*.
    """
    parts_of = {kind: modal_parts(modes, run, kind) for kind in ("bending", "torsion")}
    if _is_nil(parts_of):
        return without_data(
            f"The beam at k* = {run.attrs['k_star']:g} has no mean deformation: it is symmetric, "
            "at no incidence."
        )
    figure = Figure(figsize=(PAGE_WIDTH, 4.6))
    panels = figure.subplots(2, 2, height_ratios=(1.0, 0.8))
    titles = {"bending": "bending", "torsion": "torsion"}
    labels = {"bending": r"$\overline{\Delta w}/c$", "torsion": r"$\overline{\Delta\theta}$ (deg)"}
    symbols = {"bending": "W", "torsion": r"\Theta"}
    for column, (kind, parts) in enumerate(parts_of.items()):
        along, sizes = panels[0, column], panels[1, column]
        letter(along, "ab"[column], f"{titles[kind]}, mean deformation")
        if parts is None:
            reason = f"No history at k* = {run.attrs['k_star']:g}: {run.attrs['reason']}."
            say(along, reason)
            letter(sizes, "cd"[column], f"{titles[kind]}, part of each mode")
            say(sizes, "No amplitudes to show.")
            continue
        letter(sizes, "cd"[column], f"{titles[kind]}, {_dominance(parts)}")
        _along_span(along, parts, labels[kind], np.degrees(1.0) if kind == "torsion" else 1.0)
        _sizes(sizes, parts, symbols[kind])
    handles, _ = panels[0, 0].get_legend_handles_labels()
    if handles:
        two_orders = Line2D([], [], color=GREY, linewidth=0.8, linestyle=":", label="1/100")
        figure.legend(handles=[*handles, two_orders], loc="outside upper center", ncols=6)
    solver = solver_of(str(run.attrs["solver_description"]), str(run.attrs["resolution"]))
    add_provenance(
        figure,
        f"3D beam at k* = {run.attrs['k_star']:g} ({run.attrs['regime']}): {solver}",
        f"{modes.attrs['method']} modes",
    )
    return figure


def _is_nil(parts_of: Mapping[str, ModalParts | None]) -> bool:
    """Tell whether there is no mean deformation but what is left of an oscillation."""
    largest = {
        "bending": NIL["mean_deflection_chords"],
        "torsion": math.radians(NIL["mean_twist_deg"]),
    }
    known = {kind: parts for kind, parts in parts_of.items() if parts is not None}
    return bool(known) and all(
        np.abs(parts.parts.sum(axis=0)).max(initial=0.0) < largest[kind]
        for kind, parts in known.items()
    )


def _dominance(parts: ModalParts) -> str:
    if len(parts.ratios) < 2:
        return "one mode alone"
    return f"mode 1 is {rounded(parts.ratios[1:].min(), 3)} times the next"


def _along_span(axes: Axes, parts: ModalParts, label: str, unit: float) -> None:
    axes.plot(
        parts.span,
        unit * parts.parts.sum(axis=0),
        color=LIGHT_GREY,
        linewidth=4.5,
        solid_capstyle="butt",
        label="all modes",
    )
    for number, part in enumerate(parts.parts):
        axes.plot(
            parts.span,
            unit * part,
            color=COLOURS[number],
            linestyle=DASHES[number],
            label=f"mode {number + 1}",
        )
    axes.set(xlim=(0.0, 1.0), xlabel="$z/L$", ylabel=label)


def _sizes(axes: Axes, parts: ModalParts, symbol: str) -> None:
    relative = 1.0 / parts.ratios
    number = np.arange(1, len(relative) + 1)
    floor = 10.0 ** np.floor(np.log10(max(relative[relative > 0].min(), 1e-9)) - 0.3)
    axes.bar(
        number,
        np.maximum(relative, floor),
        width=0.55,
        color=COLOURS[: len(relative)],
        edgecolor="white",
    )
    for n, value, ratio in zip(number, relative, parts.ratios, strict=True):
        text = "1" if n == 1 else ("0" if not np.isfinite(ratio) else f"1/{ratio:.0f}")
        axes.annotate(
            text,
            (n, max(value, floor)),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
        )
    axes.axhline(1e-2, color=GREY, linewidth=0.8, linestyle=":")
    axes.set_yscale("log")
    axes.set_ylim(floor, 6.0)
    axes.set_xticks(number, [str(n) for n in number])
    axes.set(xlabel="mode $i$", ylabel=rf"$|{symbol}_i/{symbol}_1|$")
    axes.grid(visible=False, axis="x")
