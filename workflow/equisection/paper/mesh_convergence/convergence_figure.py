"""Figure of the onset over the cell size, with the limit of each model and the paper's k*."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.models import LOOKS, Look
from equisection.figures.origin import add_provenance
from equisection.figures.panels import letter
from equisection.figures.style import GREEN, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.paper.mesh_convergence.kept_releases import OWN_RATIOS
from equisection.paper.mesh_convergence.mesh_series import (
    MeshSeries,
    MeshValue,
    is_part_of_another,
)
from equisection.paper.mesh_convergence.onset_by_difference import (
    BY_DIFFERENCE,
    DIFFERENCE_OF_BOTH,
)
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    BY_RELEASES,
    DAMPING,
    ONSET,
    damped,
)
from equisection.paper.mesh_convergence.onset_by_mesher import AROUND, BOTH_MESHERS
from equisection.paper.mesh_convergence.onset_from_equilibrium import BY_EQUILIBRIUM

#: Looks of the models, with that of the section corrected by this project's own ratios.
_LOOKS = {
    **LOOKS,
    "2d-corrected": Look("2D corrected by Table 1", "#000000", "o"),
    OWN_RATIOS: Look("2D corrected, own ratios", GREEN, "D"),
}
#: Places of the limits of the models beside h = 0, one beside the other.
_APART, _BESIDE = 0.036, 0.005
#: Distance of models of one mesh, so that their intervals do not hide each other.
_ASIDE = 0.012
_MODELS = ("2d", "2d-corrected", OWN_RATIOS, "3d")
#: Bases that are shown, with the part of a marker that is filled.
_FILLED = {
    BY_RELEASES: "full",
    BY_MODEL: "full",
    BY_EQUILIBRIUM: "left",
    AROUND: "right",
    BOTH_MESHERS: "top",
    BY_DIFFERENCE: "bottom",
    DIFFERENCE_OF_BOTH: "bottom",
}


def draw(series: Sequence[MeshSeries], onset: tuple[float, float, float]) -> Figure:
    """Draw onsets over the cell size (left) and over the structural damping (right).

    Parameters
    ----------
    series
        Onsets over the meshes.
    onset
        k* of the onset that the paper states, and its interval.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.6))
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(1.6, 1.0))
    onsets = [one for one in series if one.quantity == ONSET]
    _over_cell_size(left, onsets)
    _over_damping(right, onsets)
    for axes in (left, right):
        axes.axhspan(*onset[1:], color=LIGHT_GREY, linewidth=0, zorder=0)
        axes.axhline(onset[0], color=GREY, linewidth=0.8, linestyle=":", label="paper")
    left.set_ylabel("$k^*$ of the onset")
    entries = {
        label: handle
        for axes in (left, right)
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(entries.values(), entries.keys(), loc="outside upper center", ncols=len(entries))
    add_provenance(
        figure,
        "open: releases by OpenFOAM v1912 (filled on the left: from equilibrium; right: so, around "
        "the outline; top: both meshers; below: 2D and difference); filled: model learnt from one "
        "release; at 0: limit with its interval",
        "grey: the paper's 5.5, give or take 10 %",
    )
    return figure


def _over_cell_size(axes: Axes, onsets: Sequence[MeshSeries]) -> None:
    letter(axes, "a", "over the cell size, without damping")
    axes.set_xlabel("cell size over that of the coarse mesh")
    for number, model in enumerate(_MODELS):
        of_model = [one for one in onsets if (one.model, one.at) == (model, "")]
        for basis in _FILLED:
            for one in of_model:
                if one.basis == basis and not is_part_of_another(one, of_model):
                    aside = _BESIDE * list(_FILLED).index(basis)
                    _series(axes, one, -_APART * (number + 1) - aside)
    axes.axvline(0.0, color=GREY, linewidth=0.6)
    axes.annotate(
        "limits",
        (0.0, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(-3, -4),
        textcoords="offset points",
        ha="right",
        va="top",
        fontsize=7,
        color=GREY,
    )
    axes.set_xlim(-_APART * (len(_MODELS) + 2), 1.06)
    axes.set_xticks([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])  # beside 0 there are no sizes


def _series(axes: Axes, one: MeshSeries, at_limit: float) -> None:
    look, learnt = _LOOKS[one.model], one.basis == BY_MODEL
    aside = _MODELS.index(one.model) - 1.5 + 0.4 * list(_FILLED).index(one.basis)
    sizes = [size / one.sizes[0] + _ASIDE * aside for size in one.sizes]
    values = [value.value for value in one.values]
    errors = _errors(one.values)
    style: dict[str, Any] = {
        "color": look.colour,
        "marker": look.marker,
        "markerfacecolor": "white" if one.basis == BY_RELEASES else look.colour,
        "markerfacecoloralt": "white",
        "fillstyle": _FILLED[one.basis],
        "markersize": 4.0,
        "capsize": 2.0,
        "elinewidth": 0.8,
    }
    label = look.label if learnt else None
    if one.basis != BOTH_MESHERS:  # whose values are those of blocks
        axes.errorbar(sizes, values, errors, linewidth=0.8, linestyle="-", label=label, **style)
    limit = one.limit
    if math.isfinite(limit.half_width):
        axes.errorbar([at_limit], [limit.value], [limit.half_width], linestyle="none", **style)


def _errors(values: Sequence[MeshValue]) -> list[list[float]]:
    """Return the distances of the ends of intervals; NaN, which is not drawn, without an end."""
    distances = [[one.value - one.low for one in values], [one.high - one.value for one in values]]
    return [[each if math.isfinite(each) else math.nan for each in side] for side in distances]


def _over_damping(axes: Axes, onsets: Sequence[MeshSeries]) -> None:
    letter(axes, "b", "over the damping, finest mesh")
    axes.set_xlabel(r"structural damping $\zeta$ (% of critical)")
    for model in _MODELS:
        shown = [
            (zeta, one)
            for zeta in DAMPING
            for one in onsets
            if (one.model, one.at, one.basis) == (model, damped(zeta), BY_MODEL) and one.values
        ]
        look = _LOOKS[model]
        finest = [one.values[-1] for _, one in shown]
        axes.errorbar(
            [100.0 * zeta for zeta, _ in shown],
            [value.value for value in finest],
            _errors(finest),
            color=look.colour,
            marker=look.marker,
            markersize=4.0,
            linewidth=0.8,
            elinewidth=0.8,
            capsize=2.0,
        )
