"""Parts that panels share: their letters, and the sentence in the place of missing data."""

from __future__ import annotations

import textwrap

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.style import GREY, PAGE_WIDTH


def letter(axes: Axes, name: str, title: str = "") -> None:
    """Write the panel's letter, as in "(a)", and its title above its left edge."""
    axes.set_title(f"({name})  {title}".rstrip(), loc="left", pad=5.0)


#: Label of a panel that shows nothing; of an axes, no legend has it.
_EMPTY = "empty: "


def nothing_drawn(figure: Figure) -> str:
    """Return why no panel of a figure shows anything, in sentences; empty where one does."""
    panels = [str(axes.get_label()) for axes in figure.axes if axes.get_visible()]
    if not all(label.startswith(_EMPTY) for label in panels):
        return ""
    return " ".join(dict.fromkeys(label.removeprefix(_EMPTY) for label in panels))


def say(axes: Axes, sentence: str, width: int = 38) -> None:
    """Leave the panel empty, with a plain sentence that gives the reason."""
    axes.set_label(f"{_EMPTY}{sentence}")
    axes.text(
        0.5,
        0.5,
        textwrap.fill(sentence, width),
        transform=axes.transAxes,
        ha="center",
        va="center",
        fontsize=7,
        color=GREY,
    )
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(visible=False)


def without_data(sentence: str) -> Figure:
    """Return a figure of one empty panel, with a plain sentence that gives the reason."""
    figure = Figure(figsize=(PAGE_WIDTH, 1.6))
    say(figure.subplots(), sentence, width=90)
    return figure


def in_words(regime: str) -> str:
    """Return the name of a regime for a sentence."""
    return regime.replace("-", " ")


def legend_above(figure: Figure, axes: Axes, columns: int) -> None:
    """Explain the series of one panel above all of them, clear of the data."""
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside upper center", ncols=columns)
