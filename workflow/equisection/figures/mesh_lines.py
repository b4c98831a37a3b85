"""Lines of a mesh in a window, and its quality in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from equisection.figures.style import BLUE

Floats = NDArray[np.float64]


def draw_lines(axes: Axes, lines: Floats, low: Floats, high: Floats) -> None:
    """Draw the lines that reach into a window.

    Parameters
    ----------
    axes
        Axes to draw on.
    lines : (k, 2, 2) array
        Ends of the lines.
    low, high : (2,) array
        Corners of the window.
    """
    inside = ((lines.max(axis=1) >= low) & (lines.min(axis=1) <= high)).all(axis=1)
    drawn = LineCollection(list(lines[inside]), colors=BLUE, linewidths=0.25, rasterized=True)
    axes.add_collection(drawn)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.set_aspect("equal")
    axes.grid(visible=False)


def quality_in_words(attributes: Mapping[Any, Any]) -> str:
    """Return the numbers of the mesh generator's check as a sentence."""
    return (
        f"aspect ratio up to {attributes['max_aspect_ratio']:.0f}, non-orthogonality up to "
        f"{attributes['max_non_orthogonality_deg']:.0f} deg, skewness up to "
        f"{attributes['max_skewness']:.2f}"
    )
