"""Judgement of the identified lags: numbers of releases over k*, by CFD and by the model."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from equisection.figures.origin import add_provenance
from equisection.figures.panels import letter
from equisection.figures.style import GREY, PAGE_WIDTH
from equisection.motion.release_judgement import ReleaseJudgement
from equisection.study.axes import K_STAR

#: Quantities of the panels, with symbol and unit.
_QUANTITIES = {
    "growth_rate": "growth rate of the twist ($V/c$)",
    "frequency": r"frequency $\omega c/V$",
    "mean_twist_deg": r"mean twist $\overline{\theta}_{2D}$ (deg)",
    "mean_deflection_chords": r"mean deflection $\overline{w}_{2D}/c$",
    "last_amplitude_deg": "last twist amplitude (deg)",
}
_MARKERS = "osD^"


def draw(
    judgements: Sequence[tuple[str, ReleaseJudgement]],
    fitted_to: str,
    label: str,
    sources: Sequence[str],
) -> Figure:
    """Draw each number over k*: marks as recorded, lines as modelled, the fitted-to filled.

    Parameters
    ----------
    judgements
        Use of each release, and its judgement.
    fitted_to
        The use of the releases that the lags were fitted to.
    label
        Name of the polar.
    sources
        The flow solvers in words.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 6.6))
    panels = figure.subplots(3, 2).ravel()
    models = list(dict.fromkeys(_model(judgement) for _, judgement in judgements))
    for axes, place, name in zip(panels, "abcde", _QUANTITIES, strict=False):
        letter(axes, place)
        axes.set(xlabel=K_STAR.label, ylabel=_QUANTITIES[name])
        for number, model in enumerate(models):
            chosen = [(use, j) for use, j in judgements if _model(j) == model]
            _releases(axes, chosen, name, number, fitted_to)
    panels[0].axhline(0.0, color=GREY, linewidth=0.5)
    panels[4].set_yscale("log")
    panels[4].yaxis.set_major_locator(LogLocator())
    panels[5].axis("off")
    panels[5].legend(handles=_handles(models), loc="center")
    add_provenance(figure, f"embedded solver, polar {label}", *dict.fromkeys(sources))
    return figure


def _model(judgement: ReleaseJudgement) -> str:
    """Return the model that a release is of."""
    return judgement.name.partition("/")[0]


def _releases(
    axes: Axes,
    judgements: Sequence[tuple[str, ReleaseJudgement]],
    name: str,
    number: int,
    fitted_to: str,
) -> None:
    """Draw one quantity of the releases of a model."""
    ordered = sorted(judgements, key=lambda pair: pair[1].k_star)
    k_star = np.array([judgement.k_star for _, judgement in ordered])
    recorded = np.array([getattr(judgement.recorded, name) for _, judgement in ordered])
    modelled = np.array([getattr(judgement.modelled, name) for _, judgement in ordered])
    seen = np.array([use == fitted_to for use, _ in ordered])
    colour, marker = f"C{number}", _MARKERS[number % len(_MARKERS)]
    axes.plot(k_star, modelled, color=colour)
    for part, face in ((seen, colour), (~seen, "white")):
        axes.plot(
            k_star[part],
            recorded[part],
            color=colour,
            marker=marker,
            markerfacecolor=face,
            linestyle="none",
        )


def _handles(models: Sequence[str]) -> list[Line2D]:
    """Explain marks and lines."""
    handles = [
        Line2D([], [], color=f"C{number}", marker=_MARKERS[number % len(_MARKERS)], label=model)
        for number, model in enumerate(models)
    ]
    handles.append(Line2D([], [], color=GREY, label="line: embedded solver"))
    for face, label in (("white", "mark: CFD, not fitted to"), (GREY, "filled: CFD, fitted to")):
        handles.append(
            Line2D(
                [],
                [],
                color=GREY,
                marker="o",
                markerfacecolor=face,
                linestyle="none",
                label=label,
            )
        )
    return handles
