r"""Downwash of the vortex rings of a flat beam in a channel, above that of two-dimensional flow.

Lengths are in chords: x downstream, z along the span, y up. The beam and its wake are flat vortex
rings in the plane y = 0. A rectangular ring of strength Gamma is four straight vortices, and the
law of Biot and Savart gives its downwash as a sum over its corners, with signs that alternate
(Katz and Plotkin, *Low-Speed Aerodynamics*, 2001, section 10.4.5, for one straight vortex),

    w/(Gamma/4 pi) = sum +- F(X, Z, Y),
    F(X, Z, Y) = (X Z/R) [1/(X^2 + Y^2) + 1/(Z^2 + Y^2)],    R^2 = X^2 + Y^2 + Z^2,

X, Z, Y being the way from the corner to the point. A spanwise vortex at x = a across the strip j,
with legs that trail to infinity upstream and downstream in equal parts, therefore has at station i

    G_ij(X) = 1/(4 pi) [F(X, z_i - e_j, 0) - F(X, z_i - e_{j+1}, 0)],    X = x - a,

and a ring from a to b the difference G(x - a) - G(x - b). In two dimensions F is sgn(Z) X/(X^2 +
Y^2), which belongs to the section and its polar. What is left,

    F - sgn(Z) X/(X^2 + Y^2) = (Z/(Z^2 + Y^2)) (X/R) + (X/(X^2 + Y^2)) (Z/R - sgn Z),

vanishes at X = 0 and tends to +-Z/(Z^2 + Y^2) far up- and downstream.

Slip walls are images (:mod:`equisection.aerodynamics.channel`): side walls repeat each strip and
its mirror image with the period 2 W, floor and ceiling repeat all that at Y = n H with the sign
(-1)^n. The sums over Z/(Z^2 + Y^2) are closed (`lattice_kernel`). The rest is summed image by
image, those beyond the last as a uniform load; its alternating series in n ends with Euler's means.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.channel import lattice_kernel
from equisection.aerodynamics.span_strips import SpanStrips

Floats = NDArray[np.float64]

REACH = 120.0
"""Chords along the span within which images of the side walls are summed one by one."""

HEIGHTS = 12.0
"""Heights of the channel within which they are: beyond, floor and ceiling cancel them."""

_STOREYS, _MEANS = 12, 5
"""Images in floor and ceiling on each side, and how many of the last partial sums are averaged."""


@dataclass(frozen=True)
class SpanGeometry:
    """Strips of a beam between slip walls; lengths in chords, z from the wall or the root on.

    Attributes
    ----------
    edges, stations
        z of the strips' edges, length S + 1, and of their stations, length S.
    width
        W, distance of the side walls at z = 0 and z = W; None: no second side wall.
    height
        H, distance of floor and ceiling; None: neither.
    wall_at_root
        Whether there is a wall at z = 0.
    """

    edges: tuple[float, ...]
    stations: tuple[float, ...]
    width: float | None
    height: float | None
    wall_at_root: bool

    @classmethod
    def of(
        cls,
        strips: SpanStrips,
        chord: float,
        length: float,
        channel_width: float | None = None,
        channel_height: float | None = None,
        *,
        root_on_wall: bool = True,
    ) -> SpanGeometry:
        """Take a beam of chord c and length L (m); only ratios of lengths matter.

        Parameters
        ----------
        strips
            Strips of the span, see `cosine_strips`.
        chord, length
            c and L (m).
        channel_width
            W (m), distance of the side walls. The root is on one of them, or, without
            ``root_on_wall``, the beam is in the middle between them. With L = W both ends are
            closed by walls, and a constant load trails nothing. None: no other side wall.
        channel_height
            H (m), distance of floor and ceiling, beam half way between them. None: neither.
        root_on_wall
            Presence of a wall at z = 0 that closes the root. Otherwise both ends are free.

        Raises
        ------
        ValueError
            The beam is longer than the channel is wide.
        """
        if channel_width is not None and length > channel_width:
            raise ValueError(
                f"a beam of length {length:g} does not fit into a channel of width "
                f"{channel_width:g}"
            )
        first = 0.0
        if not root_on_wall and channel_width is not None:
            first = 0.5 * (channel_width - length)
        edges = (first + length * strips.edges) / chord
        stations = (first + length * strips.stations) / chord
        return cls(
            tuple(edges.tolist()),
            tuple(stations.tolist()),
            None if channel_width is None else channel_width / chord,
            None if channel_height is None else channel_height / chord,
            root_on_wall or channel_width is not None,
        )

    @property
    def strips(self) -> int:
        """Number S of strips."""
        return len(self.stations)

    def section_downwash(self, x: ArrayLike) -> Floats:
        """G of a vortex that never ends (-), any shape: X/(2 pi) sum (-1)^n/(X^2 + (n H)^2).

        Parameters
        ----------
        x
            X != 0 (chords), from the vortex downstream to the point.
        """
        way = np.asarray(x, dtype=np.float64)
        height = math.inf if self.height is None else self.height
        kernel = 1.0 / way if math.isinf(height) else lattice_kernel(way, None, height).real
        return np.asarray(kernel / (2 * np.pi), dtype=np.float64)

    def downwash_above_section(self, x: ArrayLike) -> Floats:
        """G less that of two-dimensional flow (-), shape (m, S, S), for X (chords), shape (m,).

        Rows are stations and columns are strips.
        """
        way = np.atleast_1d(np.asarray(x, dtype=np.float64))
        corners = np.sign(way)[:, None, None] * self._far() + self._near(way)
        return np.asarray((corners[:, :, :-1] - corners[:, :, 1:]) / (4 * np.pi), dtype=np.float64)

    def _far(self) -> Floats:
        """Sum of Z/(Z^2 + Y^2) over all images of the edges (1/c), shape (S, S + 1)."""
        station, edge = np.array(self.stations)[:, None], np.array(self.edges)
        kernel = lattice_kernel(station - edge, self.width, self.height).real
        if self.wall_at_root:
            kernel = kernel - lattice_kernel(station + edge, self.width, self.height).real
        return np.asarray(kernel, dtype=np.float64)

    def _near(self, way: Floats) -> Floats:
        """Sum of what F lacks of both its limits, shape (m, S, S + 1)."""
        station, edge = np.array(self.stations)[:, None], np.array(self.edges)
        shifts, signs = self._images()
        images = shifts[:, None, None] + np.where(signs[:, None, None] > 0, edge, -edge)
        distances = station - images
        total = np.zeros((way.size, self.strips, edge.size))
        x = way[:, None, None]
        for lift, weight in self._storeys():
            total += weight * _lack_of_images(x, distances, signs, lift)
            if self.width is not None:
                beyond = float(shifts.max()) + self.width
                total += weight * _lack(x, np.array(beyond), lift) * 2.0 * edge / self.width
        return total

    def _images(self) -> tuple[Floats, Floats]:
        """Shifts along z of the strip (sign 1) and of its mirror image (sign -1)."""
        shifts: Floats = np.zeros(1)
        if self.width is not None:
            reach = REACH if self.height is None else min(REACH, HEIGHTS * self.height)
            count = max(2, math.ceil(reach / (2 * self.width)))
            steps = np.arange(-count, count + 1, dtype=np.float64)
            shifts = np.asarray(2.0 * self.width * steps, dtype=np.float64)
        if not self.wall_at_root:
            return shifts, np.ones(shifts.size)
        return np.tile(shifts, 2), np.repeat([1.0, -1.0], shifts.size)

    def _storeys(self) -> list[tuple[float, float]]:
        """Heights Y = n H >= 0 of the images and their weights; both signs of n in one."""
        if self.height is None:
            return [(0.0, 1.0)]
        weights = np.ones(_STOREYS + 1)
        binomial = [math.comb(_MEANS - 1, number) for number in range(_MEANS)]
        weights[-_MEANS + 1 :] = 1.0 - np.cumsum(binomial[:-1]) / 2 ** (_MEANS - 1)
        weights[1:] *= 2.0
        signs = (-1.0) ** np.arange(weights.size)
        heights = self.height * np.arange(weights.size)
        return list(zip(heights.tolist(), (signs * weights).tolist(), strict=True))


def _lack_of_images(x: Floats, distances: Floats, signs: Floats, y: float) -> Floats:
    """Sum of :func:`_lack` over images, for X of shape (m, 1, 1) and Z of shape (n, S, S + 1).

    With a = Z/(Z^2 + Y^2), b = X/(X^2 + Y^2) and R it is a b (R + Y^2/R) - a sgn X - b sgn Z: one
    root and one quotient for each X and Z.
    """
    across = signs[:, None, None] * distances / (distances**2 + y**2)
    along = x / (x**2 + y**2 + (x == 0.0))
    squares = x**2 + y**2
    summed = np.zeros((x.shape[0], *distances.shape[1:]))
    radius, quotient = np.empty_like(summed), np.empty_like(summed)
    for one, distance in zip(across, distances, strict=True):
        np.add(squares, distance**2, out=radius)
        np.sqrt(radius, out=radius)
        if y:
            np.divide(y**2, radius, out=quotient)
            radius += quotient
        radius *= one
        summed += radius
    sides = (signs[:, None, None] * np.sign(distances)).sum(axis=0)
    return np.asarray(along * (summed - sides) - np.sign(x) * across.sum(axis=0))


def _lack(x: Floats, z: Floats, y: float) -> Floats:
    """F(X, Z, Y) less sgn(Z) X/(X^2 + Y^2) and less sgn(X) Z/(Z^2 + Y^2), of shapes that match."""
    radius = np.sqrt(x**2 + y**2 + z**2)
    trailing = z / (z**2 + y**2) * (x / radius - np.sign(x))
    spanwise = x / (x**2 + y**2 + (x == 0.0)) * (z / radius - np.sign(z))
    return np.asarray(trailing + spanwise, dtype=np.float64)
