"""Look of each model of the sweep: its own colour, marker and line in every figure."""

from __future__ import annotations

from dataclasses import dataclass

from equisection.figures.style import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION, Dash


@dataclass(frozen=True)
class Look:
    """Name in legends, colour, marker and line of a model or another series."""

    label: str
    colour: str
    marker: str
    line: Dash = "-"


_DASHED: Dash = (0, (4, 1.6))
_DOTTED: Dash = (0, (1.4, 1.2))

LOOKS = {
    "2d": Look("2D", VERMILLION, "s"),
    "2d-corrected": Look("2D corrected", BLACK, "o"),
    "3d": Look("3D", BLUE, "^"),
    "2d-paper": Look("2D, paper's reduction", ORANGE, "D", _DASHED),
    "2d-corrected-paper": Look("2D corrected, paper's reduction", PURPLE, "v", _DASHED),
    "2d-consistent": Look("2D, consistent reduction", SKY, "P", _DOTTED),
    "2d-corrected-consistent": Look("2D corrected, consistent reduction", GREEN, "X", _DOTTED),
}
