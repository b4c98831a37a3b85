"""Layers of cells at the wall of an outline, along rays that do not cross.

From each vertex of the wall goes a ray along the bisector of its edges. At a sharp convex corner
rays fan out, at a concave one the ends of the rays beside it give way to that of the corner. The
layers are as thick as their cells' growth allows, less where another wall is near. Where a cell
folds, or the front crosses itself or its edges become too short, all of them are made thinner.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.outline import edge_lengths, turning_deg
from equisection.solvers.openfoam.mesh.block_mesh import expansion
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.mesh.outline_wall import Wall, of_limited_slope
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells, corner_areas
from equisection.solvers.openfoam.process import BlowUpError

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

#: Thickness over the way to another wall along the ray, and over the length of a side that ends at
#: a concave corner.
_OF_GAP, _OF_CONCAVE_SIDE = 0.33, 0.28
#: Turning (deg) beyond which a corner counts as concave.
_CONCAVE_DEG = -15.0
#: Change of the thickness with the distance along the wall.
_SLOPE = 0.4
#: Reach of what gives way beside a concave corner, over the shift at the corner.
_GIVES_WAY = 3.0
#: Factor by which layers that fold are made thinner, and how often.
_THINNER, _TRIES = 0.8, 14
#: Least length of an edge of the front over that of its edge on the wall: cells beyond it would be
#: as much smaller than those along the wall.
_NARROWEST = 0.15
#: Passes that smooth the thickness.
_SMOOTHING = 10
#: Least cosine of half the turning at a mitred corner.
_LEAST_COSINE = 0.35


@dataclass(frozen=True)
class Layers:
    """Cells at the wall.

    Attributes
    ----------
    cells
        The cells; the first vertices are those of the wall, in its order.
    front : (m,) array of int
        Vertices of the front, counter-clockwise; an even number.
    """

    cells: PlaneCells
    front: Indices


@dataclass(frozen=True)
class _Rays:
    """Wall vertex, end from it and thickness of each ray, counter-clockwise."""

    base: Indices
    end: Floats
    thickness: Floats


def layers_of(wall: Wall, sizes: OutlineSizes, refinement: float) -> Layers:
    """Return the layers around a wall.

    Raises
    ------
    BlowUpError
        Its corners leave no room for them.
    """
    import shapely  # noqa: PLC0415

    thinner = 1.0
    for _ in range(_TRIES):
        rays = _rays(wall, sizes, refinement, thinner)
        worst = wall.points[rays.base[int(np.argmin(rays.thickness))]]
        if rays.thickness.min() < sizes.first:
            break
        layers = _layers(wall, rays, sizes, refinement)
        areas = corner_areas(layers.cells)
        front = layers.cells.points[layers.front]
        if (
            areas.min() > 0
            and _narrowing(wall, rays, front) > _NARROWEST
            and shapely.Polygon(front).is_valid
        ):
            return layers
        worst = layers.cells.points[layers.cells.corners[int(np.argmin(areas))][0]]
        thinner *= _THINNER
    raise BlowUpError(
        f"no layers of cells fit around the outline at x/c = {worst[0] + 0.5:.4g}, y/c = "
        f"{worst[1]:.4g}: widen or fill gaps and smooth the outline there"
    )


def _narrowing(wall: Wall, rays: _Rays, front: Floats) -> float:
    """Return the least length of an edge of the front over that of its edge on the wall."""
    lengths, at_front = edge_lengths(wall.points[rays.base]), edge_lengths(front)
    has_edge = lengths > 0  # not between the rays of a fan
    return float((at_front[has_edge] / lengths[has_edge]).min())


def _layers(wall: Wall, rays: _Rays, sizes: OutlineSizes, refinement: float) -> Layers:
    number, count, base = round(sizes.layers * refinement), len(rays.base), len(wall.points)
    first = np.minimum(sizes.first / refinement, rays.thickness / number)
    grown = np.array(
        [
            _growth(float(thickness), number, float(cell))
            for thickness, cell in zip(rays.thickness, first, strict=True)
        ]
    )
    depth: Floats = np.cumsum(first * grown ** np.arange(number)[:, None], axis=0)
    depth = depth / depth[-1]
    points = [wall.points]
    points += [wall.points[rays.base] + part[:, None] * rays.end for part in depth]
    at = np.arange(count)
    vertices = np.concatenate(
        [
            rays.base[None, :],
            base + count * np.arange(number)[:, None] + at,
        ]
    )
    after = np.roll(vertices, -1, axis=1)
    # the wall is passed counter-clockwise about the body, with the fluid on the right
    corners = np.stack([vertices[:-1], vertices[1:], after[1:], after[:-1]], axis=-1)
    return Layers(PlaneCells(np.concatenate(points), corners.reshape(-1, 4)), vertices[-1])


def _growth(thickness: float, number: int, first: float) -> float:
    """Return the growth from cell to cell; 1 where there is room for even ones alone."""
    if first * number >= thickness * (1 - 1e-6):
        return 1.0
    return math.exp(math.log(expansion(thickness, number, first)) / (number - 1))


def _rays(wall: Wall, sizes: OutlineSizes, refinement: float, thinner: float) -> _Rays:
    edges = np.roll(wall.points, -1, axis=0) - wall.points
    lengths = np.hypot(*edges.T)
    along = edges / lengths[:, None]
    normal = np.stack([along[:, 1], -along[:, 0]], axis=-1)
    before = np.roll(normal, 1, axis=0)
    turn = np.radians(turning_deg(wall.points))
    bisector = normal + before
    bisector /= np.maximum(np.hypot(*bisector.T), 1e-12)[:, None]
    spacing = 0.5 * (lengths + np.roll(lengths, 1)) * refinement
    room = _room(wall, lengths, bisector, turn)
    thickness = thinner * np.minimum(_of_growth(spacing, sizes), room)
    thickness = _smooth(_with_slope(thickness, lengths))
    shift = _giving_way(wall, thickness, lengths, along, turn)
    mitre = np.where(
        np.abs(turn) > math.radians(3.0), 1 / np.maximum(np.cos(turn / 2), _LEAST_COSINE), 1.0
    )
    sectors = np.where(
        turn > math.radians(sizes.fan_from_deg),
        np.maximum(2, np.rint(np.degrees(turn) / sizes.fan_step_deg * math.sqrt(refinement))),
        0,
    ).astype(int)
    if (len(turn) + sectors.sum()) % 2:  # quadrilaterals have an even number of edges around them
        sectors[np.argmax(sectors)] += 1
    base, end = [], []
    for vertex, fan in enumerate(sectors):
        if not fan:
            base.append(np.array([vertex]))
            reach = thickness[vertex] * mitre[vertex] * bisector[vertex] + shift[vertex]
            end.append(reach[None, :])
            continue
        start = math.atan2(before[vertex, 1], before[vertex, 0])
        angle = start + turn[vertex] * np.linspace(0.0, 1.0, fan + 1)
        base.append(np.full(fan + 1, vertex))
        end.append(thickness[vertex] * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    bases = np.concatenate(base)
    return _Rays(bases, np.concatenate(end), thickness[bases])


def _of_growth(spacing: Floats, sizes: OutlineSizes) -> Floats:
    """Return the thickness of layers that end with cells as thick as the spacing asks for."""
    count, first = sizes.layers, sizes.first
    last = np.clip(sizes.last * spacing, 1.05 * first, first * sizes.growth ** (count - 1))
    growth = (last / first) ** (1 / (count - 1))
    return np.asarray(first * (growth**count - 1) / (growth - 1))


def _room(wall: Wall, lengths: Floats, bisector: Floats, turn: Floats) -> Floats:
    """Return the largest thickness at each vertex that other walls leave room for."""
    room = _OF_GAP * _way_to_wall(wall.points, bisector)
    concave = turn < math.radians(_CONCAVE_DEG)
    ends = np.flatnonzero(wall.is_corner)
    for first_end, last_end in zip(ends, np.append(ends[1:], ends[:1] + len(turn)), strict=True):
        side = np.arange(first_end, last_end + 1) % len(turn)
        if concave[side[0]] or concave[side[-1]]:
            room[side] = np.minimum(room[side], _OF_CONCAVE_SIDE * lengths[side[:-1]].sum())
    return room


def _way_to_wall(points: Floats, directions: Floats) -> Floats:
    """Return the way from each vertex along its direction to another edge; infinite for none."""
    edge = np.roll(points, -1, axis=0) - points
    apart = points[None, :, :] - points[:, None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        across = (
            directions[:, None, 0] * edge[None, :, 1] - directions[:, None, 1] * edge[None, :, 0]
        )
        way = (apart[:, :, 0] * edge[None, :, 1] - apart[:, :, 1] * edge[None, :, 0]) / across
        part = (
            apart[:, :, 0] * directions[:, None, 1] - apart[:, :, 1] * directions[:, None, 0]
        ) / across
    hits = (way > 1e-6) & (part > -1e-9) & (part < 1 + 1e-9)
    own = np.arange(len(points))
    hits[own, own] = hits[own, own - 1] = False
    return np.asarray(np.where(hits, way, np.inf).min(axis=1))


def _with_slope(thickness: Floats, lengths: Floats) -> Floats:
    """Return thicknesses that change along the closed wall by no more than the slope."""
    count = len(thickness)
    s = np.concatenate([[0.0], np.cumsum(np.tile(lengths, 3))[:-1]])
    return of_limited_slope(np.tile(thickness, 3), s, _SLOPE)[count : 2 * count]


def _smooth(thickness: Floats) -> Floats:
    smooth = thickness
    for _ in range(_SMOOTHING):
        smooth = 0.5 * smooth + 0.25 * (np.roll(smooth, 1) + np.roll(smooth, -1))
    return np.asarray(np.minimum(thickness, smooth))


def _giving_way(
    wall: Wall, thickness: Floats, lengths: Floats, along: Floats, turn: Floats
) -> Floats:
    """Return the shift along the wall of the ends of the rays beside concave corners, (n, 2).

    At the corner the ray's end is t cot(phi/2) along both walls, phi the angle of the fluid. The
    shift falls to 0 over some times that length, or up to the next corner.
    """
    count = len(turn)
    shift = np.zeros((count, 2))
    for corner in np.flatnonzero(turn < math.radians(_CONCAVE_DEG)):
        at_corner = float(thickness[corner]) / math.tan((math.pi + turn[corner]) / 2)
        for step in (1, -1):
            vertex, way = int(corner), 0.0
            while True:
                edge = vertex if step > 0 else vertex - 1
                way += float(lengths[edge])
                vertex = (vertex + step) % count
                if way >= _GIVES_WAY * at_corner or wall.is_corner[vertex]:
                    break
                tangent = along[vertex] if step > 0 else -along[vertex - 1]
                shift[vertex] += at_corner * (1 - way / (_GIVES_WAY * at_corner)) * tangent
    return shift
