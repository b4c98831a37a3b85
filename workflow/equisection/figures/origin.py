"""The line in every picture that names its solver and resolution."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.figure import Figure

import equisection
from equisection.figures.style import GREY

_SIZE = 6.0
#: Characters of this size that fit on a line, for each inch of width.
_CHARACTERS_PER_INCH = 21


def add_provenance(figure: Figure, *sources: str) -> None:
    """Write the sources of the data and the version of equisection below the panels."""
    words = " · ".join([*sources, f"equisection {equisection.__version__}"]).split(" ")
    width = int(figure.get_figwidth() * _CHARACTERS_PER_INCH)
    lines = [""]
    for word in words:
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append(word)
        else:
            lines[-1] = f"{lines[-1]} {word}".strip()
    figure.supxlabel(
        _literal("\n".join(lines)), x=0.01, ha="left", fontsize=_SIZE, color=GREY, linespacing=1.3
    )


def solver_of(description: str, resolution: str) -> str:
    """Return solver and resolution in words."""
    return f"{description}, resolution {resolution}"


def solvers_of(pairs: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Return each solver and resolution once in words, in the order in which they come."""
    return tuple(dict.fromkeys(solver_of(*pair) for pair in pairs))


def _literal(text: str) -> str:
    """Keep names with dollar signs from being read as mathematics."""
    return text.replace("$", r"\$")
