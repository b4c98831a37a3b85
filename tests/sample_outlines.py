"""Outlines to mesh: plain shapes, airfoils, and the drawings of the examples."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from equisection.beam import outline as shapes
from equisection.beam.outline import Outline, outline_of, placed
from equisection.io.outline_file import read_outline

ROOT = Path(__file__).parents[1]


def polygon(corners: Sequence[Sequence[float]]) -> Outline:
    return outline_of(placed(np.array(corners, dtype=float)))


def drawing(name: str) -> Outline:
    """Return the outline of an example."""
    file = ROOT / "config" / "examples" / "outlines" / f"{name}.csv"
    return outline_of(placed(read_outline(file).points))


ROUND = 2 * np.pi * np.arange(60) / 60
# fmt: off
SHAPES = {
    "rectangle": outline_of(shapes.rectangle(0.04)),
    "rounded": outline_of(shapes.rectangle(0.04, 0.02)),
    "naca 0012": outline_of(placed(shapes.naca("0012"), 1.0), is_airfoil=True),
    "naca 4412": outline_of(placed(shapes.naca("4412"), 1.0), is_airfoil=True),
    "deck": drawing("deck"),
    "h": drawing("h_section"),
    "tracker": drawing("tracker"),
    "circle": polygon(np.stack([np.cos(ROUND), np.sin(ROUND)], axis=-1).tolist()),
}
# fmt: on
#: Those of the four examples on OpenFOAM.
EXAMPLES = ("naca 0012", "deck", "tracker", "h")
