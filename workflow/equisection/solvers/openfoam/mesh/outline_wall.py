"""Vertices of the mesh along an outline: fine at corners and where it curves."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.beam.outline import KINK_DEG, turning_deg
from equisection.solvers.openfoam.mesh.outline_sizes import CORNER_DEG, OutlineSizes

Floats = NDArray[np.float64]

#: Places along a side at which its spacing is given, and the smallest spacing (chords).
_PLACES, _SMALLEST = 2001, 4e-4
#: Fewest cells of a side between corners, and between kinks.
_BETWEEN_CORNERS, _BETWEEN_KINKS = 4, 2


@dataclass(frozen=True)
class Wall:
    """Vertices of the mesh on the outline, counter-clockwise.

    Attributes
    ----------
    points : (n, 2) array
        The vertices (chords).
    is_corner : (n,) array of bool
        They are corners of the outline.
    """

    points: Floats
    is_corner: NDArray[np.bool_]


@dataclass(frozen=True)
class _Side:
    """A part of the outline without kinks, and whether each of its ends is a corner."""

    points: Floats
    corners: tuple[bool, bool]


def wall_of(outline: Floats, sizes: OutlineSizes, refinement: float) -> Wall:
    """Return the vertices of the mesh on an outline (n, 2), counter-clockwise."""
    points, is_corner = [], []
    for side in _sides(outline):
        vertices = _spaced(side, sizes, refinement)
        points.append(vertices[:-1])
        is_corner.append((np.arange(len(vertices) - 1) == 0) & side.corners[0])
    return Wall(np.concatenate(points), np.concatenate(is_corner))


def _sides(outline: Floats) -> list[_Side]:
    """Return the sides between kinks; a smooth contour is one that begins behind."""
    turning = np.abs(turning_deg(outline))
    kinks = np.flatnonzero(turning > KINK_DEG)
    if not kinks.size:
        kinks = np.array([np.argmax(outline[:, 0])])
    closed = np.concatenate([outline, outline])
    ends = np.append(kinks, kinks[0] + len(outline))
    corner = turning > CORNER_DEG
    return [
        _Side(closed[a : b + 1], (bool(corner[a]), bool(corner[b % len(outline)])))
        for a, b in itertools.pairwise(ends)
    ]


def _spaced(side: _Side, sizes: OutlineSizes, refinement: float) -> Floats:
    """Return the vertices of a side, its ends included."""
    edges = np.diff(side.points, axis=0)
    lengths = np.hypot(*edges.T)
    reach = np.concatenate([[0.0], np.cumsum(lengths)])
    length = float(reach[-1])
    s = np.linspace(0.0, length, _PLACES)
    spacing = np.full_like(s, sizes.wall)
    if len(lengths) > 1:
        angle = np.unwrap(np.arctan2(edges[:, 1], edges[:, 0]))
        curvature = np.abs(np.diff(angle)) / (0.5 * (lengths[1:] + lengths[:-1]))
        of_curve = np.radians(sizes.turn_deg) / np.maximum(curvature, 1e-9)
        spacing = np.minimum(spacing, np.interp(s, reach[1:-1], of_curve))
    spacing = np.maximum(spacing, _SMALLEST)
    at_corner = min(sizes.at_corner, length / sizes.side_over_corner)
    for is_corner, distance in zip(side.corners, (s, length - s), strict=True):
        if is_corner:
            spacing = np.minimum(spacing, at_corner + sizes.wall_growth * distance)
    fewest = _BETWEEN_CORNERS if any(side.corners) else _BETWEEN_KINKS
    spacing = of_limited_slope(np.minimum(spacing, length / fewest), s, sizes.wall_growth)
    number = scipy.integrate.cumulative_trapezoid(1 / spacing, s, initial=0)
    cells = max(fewest, round(float(number[-1])))
    cells = max(fewest, 2 * round(cells * refinement / 2))
    at = np.interp(np.linspace(0.0, number[-1], cells + 1), number, s)
    return np.stack([np.interp(at, reach, side.points[:, axis]) for axis in (0, 1)], axis=-1)


def of_limited_slope(values: Floats, s: Floats, slope: float) -> Floats:
    """Return the largest values below the given ones whose slope is at most the given one."""
    forward = np.minimum.accumulate(values - slope * s) + slope * s
    return np.asarray(np.minimum.accumulate((forward + slope * s)[::-1])[::-1] - slope * s)
