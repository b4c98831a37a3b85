"""Strips of constant load along the span of a beam.

Vortices trail from the edges of the strips, and incidence is taken at their stations. Both at equal
steps of the angle phi, z ~ cos phi, give the constant induced incidence of an elliptic load up to a
factor 1 - O(n^-2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpanStrips:
    """Strips of constant load along the span, root at 0, tip at 1.

    Attributes
    ----------
    edges
        z/L of the strips' edges, ascending from 0 to 1, shape (n + 1,).
    stations
        z/L where the section's incidence is taken, one in each strip, shape (n,).
    """

    edges: Floats
    stations: Floats

    @property
    def weights(self) -> Floats:
        """Share of each strip in the span, shape (n,), sum 1: C_L = weights @ c_l (Eq. 22)."""
        return np.diff(self.edges)


def cosine_strips(count: int, root_on_wall: bool = True) -> SpanStrips:
    """``count`` strips that narrow towards each free end.

    With the root on a wall only the tip is free and the strips are half of those of the beam
    and its mirror image; otherwise both ends are free.
    """
    if root_on_wall:
        angle = 0.5 * np.pi / count
        edges = np.sin(angle * np.arange(count + 1))
        stations = np.sin(angle * (np.arange(count) + 0.5))
    else:
        angle = np.pi / count
        edges = 0.5 - 0.5 * np.cos(angle * np.arange(count + 1))
        stations = 0.5 - 0.5 * np.cos(angle * (np.arange(count) + 0.5))
    edges[-1] = 1.0
    return SpanStrips(edges, stations)
