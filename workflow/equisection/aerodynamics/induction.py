"""Incidence that the trailing vortices of a beam induce on its own sections.

A straight beam of chord c carries the circulation Gamma(z) = V c c_l(z)/2 along its span. What it
loses along dz trails downstream as a vortex of strength -dGamma, a straight half-line that
starts at the bound line, so it induces there half of what an infinite line would. With K of the
channel (1/zeta in free air) the section at z sees its incidence reduced by

    alpha_i(z) = (c/8 pi) int dc_l/dz' [K(z - z') - K(z + z')] dz',

the second term for a root on a wall, where the mirror image continues the beam to -L (Prandtl
1918; Glauert, *The Elements of Aerofoil and Airscrew Theory*, chapters X, XI and XIV for the
walls). The beam is cut into strips of constant c_l; vortices trail from the edges of the strips.
Edges and stations at equal steps of the angle phi, z ~ cos phi, give the constant induced
incidence of an elliptic load exactly up to a factor 1 - O(n^-2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.channel import lattice_kernel

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


def induction_matrix(
    strips: SpanStrips,
    chord: float,
    length: float,
    channel_width: float | None = None,
    channel_height: float | None = None,
    *,
    root_on_wall: bool = True,
) -> Floats:
    """Matrix D (rad) with alpha_i = D @ c_l: rows are stations, columns are strips; shape (n, n).

    The effective incidence of the sections is theta_0 + theta - D @ c_l.

    Parameters
    ----------
    strips
        Strips of the span, see `cosine_strips`.
    chord, length
        c and L (m); only ratios of lengths matter.
    channel_width
        W (m), distance of the side walls. The root is on one of them, or, without
        ``root_on_wall``, the beam is in the middle between them. With L = W both ends are closed
        by walls, nothing trails and D = 0 up to a constant c_l. None: no other side wall.
    channel_height
        H (m), distance of floor and ceiling, beam half way between them. None: neither.
    root_on_wall
        Whether a wall at z = 0 closes the root. Otherwise both ends are free.
    """
    if channel_width is not None and length > channel_width:
        raise ValueError(
            f"a beam of length {length:g} does not fit into a channel of width {channel_width:g}"
        )
    has_mirror_image = root_on_wall or channel_width is not None
    wall_to_root = 0.0
    if not root_on_wall and channel_width is not None:
        wall_to_root = 0.5 * (channel_width - length)
    station = (wall_to_root + length * strips.stations)[:, np.newaxis]
    edge = (wall_to_root + length * strips.edges)[np.newaxis, :]

    kernel = lattice_kernel(station - edge, channel_width, channel_height).real
    if has_mirror_image:
        kernel = kernel - lattice_kernel(station + edge, channel_width, channel_height).real
    return chord / (8 * np.pi) * (kernel[:, :-1] - kernel[:, 1:])
