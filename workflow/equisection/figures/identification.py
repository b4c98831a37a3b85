"""Releases of the section: recorded by CFD, and by the embedded solver with the fitted lags."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.figures.panels import letter
from equisection.figures.provenance import add_provenance
from equisection.figures.style import PAGE_WIDTH
from equisection.motion.judgement import release_of

_ROW_HEIGHT = 2.2  # inches


def draw(
    releases: Sequence[tuple[str, ReferenceHistory]], loads: UnsteadyLoads, label: str
) -> Figure:
    """Draw twist and deflection of each release over s = tV/c, a row each.

    Parameters
    ----------
    releases
        What each release was used for, and its history.
    loads
        The model with the fitted lags.
    label
        Name of the polar.
    """
    figure = Figure(figsize=(PAGE_WIDTH, _ROW_HEIGHT * len(releases) + 0.4))
    panels = figure.subplots(len(releases), 2, squeeze=False)
    for row, (use, history) in enumerate(releases):
        run = release_of(history, loads)
        title = f"{use} $k^*$ = {history.k_star:g}"
        left, right = panels[row]
        letter(left, "abcdefghijkl"[2 * row], title)
        letter(right, "abcdefghijkl"[2 * row + 1], title)
        left.plot(history.time, np.degrees(history.twist), label="CFD")
        left.plot(run.time, np.degrees(run.twist[:, 0]), "--", label="embedded solver")
        right.plot(history.time, history.deflection, label="CFD")
        right.plot(run.time, run.deflection[:, 0], "--", label="embedded solver")
        left.set_ylabel(r"$\theta_{2D}$ (deg)")
        right.set_ylabel("$w_{2D}/c$")
    for panel in panels[-1]:
        panel.set_xlabel("$tV_\\infty/c$")
    panels[0, 1].legend(loc="lower right")
    sources = dict.fromkeys(history.source for _, history in releases)
    add_provenance(figure, f"embedded solver, polar {label}", *sources)
    return figure
