"""Outline of the section in the flow: its contour as a polygon, checked, in chords.

Coordinates are over the chord, x aft from mid-chord and y up, counter-clockwise. A curve is given
by so many points that it turns by at most :data:`FINEST_TURN_DEG` from one to the next, so that
what meshes it needs no curves: a vertex that turns by more is a corner or one facet of a polygon.
"""

from __future__ import annotations

import logging
import math
import re
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.errors import OutlineError

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]

#: Turning of a curve from one of its points to the next (deg), and their largest distance (chords).
FINEST_TURN_DEG, LONGEST_STEP = 3.0, 0.02
#: Fewest points, the first one again included.
FEWEST_POINTS = 4
#: Points nearer to each other than this are one (chords).
_ONE_POINT = 1e-7
#: Limits of what is meshed: thickness and height over the chord, angle of the body at a corner
#: (deg), gap at the trailing edge of an airfoil (chords).
THINNEST, HIGHEST, SHARPEST_DEG, WIDEST_GAP = 2e-3, 2.0, 2.0, 0.1
#: Most corners, and the turning (deg) from which a vertex counts as one: more are noise, which no
#: cells follow.
MOST_CORNERS, KINK_DEG = 500, 3.5
#: Extent along the chord over the chord that is given: beyond, the units are not one.
_LIKE_CHORD = 1.25
#: Extents along x that a drawing may have, in whatever unit, and the distance from the outline to
#: its axis (chords): more of either is a mistake, and costs digits of the coordinates.
_SMALLEST, _LARGEST, FARTHEST_AXIS = 1e-9, 1e9, 5.0
#: Angle of the fluid in a notch (deg) below which it has no layers of cells, and the radius
#: (chords) of the disc that does not enter it.
NARROWEST_NOTCH_DEG, _NOTCH_RADIUS = 70.0, 0.008
#: Distance (chords) within which the mirror image of a vertex is on the contour of a symmetric one.
_SYMMETRIC = 1e-4
#: Digits of a coordinate that count, the same on every machine.
_DIGITS = 9
#: Polynomial of a four-digit section's half thickness over sqrt(x) and x to x^4, times t/0.2, with
#: the last coefficient that closes the trailing edge.
_NACA_THICKNESS = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)


@dataclass(frozen=True)
class Outline:
    """Closed contour of a section.

    Attributes
    ----------
    points : (n, 2) array
        Vertices over the chord from mid-chord, counter-clockwise, the first one not repeated.
    """

    points: Floats

    @property
    def thickness(self) -> float:
        """Extent across the chord (chords)."""
        return float(np.ptp(self.points[:, 1]))

    @property
    def perimeter(self) -> float:
        """Length of the contour (chords)."""
        return float(edge_lengths(self.points).sum())

    @property
    def area(self) -> float:
        """Area inside (chords squared)."""
        return signed_area(self.points)

    @property
    def is_symmetric(self) -> bool:
        """Tell whether the line y = 0, through the axis, parts it in two mirror images."""
        mirrored = self.points * (1.0, -1.0)
        edge = np.roll(self.points, -1, axis=0) - self.points
        apart = mirrored[:, None, :] - self.points
        part = np.clip((apart * edge).sum(axis=-1) / (edge**2).sum(axis=-1), 0.0, 1.0)
        distance = np.hypot(*np.moveaxis(apart - part[..., None] * edge, -1, 0))
        return bool(distance.min(axis=1).max() < _SYMMETRIC)

    def as_pairs(self) -> tuple[tuple[float, float], ...]:
        """Return the vertices as a case holds them."""
        return tuple((float(x), float(y)) for x, y in self.points)


def signed_area(points: Floats) -> float:
    """Return the area of a polygon, positive counter-clockwise."""
    x, y = points.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def edge_lengths(points: Floats) -> Floats:
    """Return the lengths of the edges of a closed polygon, that from each vertex on, shape (n,)."""
    return np.asarray(np.hypot(*(np.roll(points, -1, axis=0) - points).T))


def turning_deg(points: Floats) -> Floats:
    """Return the angle (deg) that a closed polygon turns by at each vertex, shape (n,).

    It is positive at a convex vertex of a counter-clockwise polygon; the angles add up to 360.
    """
    after = np.roll(points, -1, axis=0) - points
    before = np.roll(after, 1, axis=0)
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.asarray(np.degrees(np.arctan2(cross, (before * after).sum(axis=1))))


def rectangle(thickness: float, edge_radius: float = 0.0) -> Floats:
    """Return a rectangle of a thickness, its edges rounded by a radius (chords).

    Raises
    ------
    OutlineError
        The radius is larger than half the thickness.
    """
    if edge_radius > thickness / 2 * (1 + 1e-9):
        raise OutlineError(
            f"an edge radius of {edge_radius:g} c: allowed is up to half the thickness, "
            f"{thickness / 2:g} c"
        )
    half, radius = thickness / 2, min(edge_radius, thickness / 2)
    corners = ((0.5, -half), (0.5, half), (-0.5, half), (-0.5, -half))
    if radius == 0.0:
        return np.array(corners)
    parts = []
    steps = math.ceil(90.0 / FINEST_TURN_DEG)
    for quarter, (x, y) in enumerate(corners):
        angle = np.radians(90.0) * (quarter - 1 + np.linspace(0.0, 1.0, steps + 1))
        centre = (x - math.copysign(radius, x), y - math.copysign(radius, y))
        parts.append(centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1))
    return np.concatenate(parts)


def naca(digits: str) -> Floats:
    """Return a four-digit NACA section with a closed trailing edge, from it round the upper side.

    Thickness is perpendicular to the mean line (Jacobs, Ward and Pinkerton, NACA Report 460, 1933).

    Raises
    ------
    OutlineError
        The digits are not those of a section with a thickness.
    """
    if not re.fullmatch("[0-9]{4}", digits) or int(digits[2:]) == 0:
        raise OutlineError(
            "allowed are four digits in quotes such as '0012': camber, its place and the thickness"
        )
    camber, place, thickness = int(digits[0]) / 100, int(digits[1]) / 10, int(digits[2:]) / 100
    if camber and not place:
        raise OutlineError("a camber needs its place, the second digit, from 1 to 9")
    x = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, 401)))
    powers = np.stack([np.sqrt(x), x, x**2, x**3, x**4])
    half = 5.0 * thickness * np.array(_NACA_THICKNESS) @ powers
    half[-1] = 0.0
    line, slope = np.zeros_like(x), np.zeros_like(x)
    if camber:
        ahead = x < place
        scale = np.where(ahead, camber / place**2, camber / (1.0 - place) ** 2)
        line = scale * np.where(ahead, 2 * place * x - x**2, 1 - 2 * place + 2 * place * x - x**2)
        slope = scale * 2.0 * (place - x)
    across = np.stack([-np.sin(np.arctan(slope)), np.cos(np.arctan(slope))]) * half
    upper, lower = np.stack([x, line]) + across, np.stack([x, line]) - across
    return np.concatenate([upper.T[::-1], lower.T[1:]])


def along_curve(points: Floats) -> Floats:
    """Return points of the smooth curve through given ones, from the first to the last.

    The curve is a cubic spline over the chord length. Its points follow its curvature
    (:data:`FINEST_TURN_DEG`, :data:`LONGEST_STEP`).
    """
    points = _without_doubles(points, _ONE_POINT * float(np.ptp(points[:, 0])))
    reach = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    curve = scipy.interpolate.CubicSpline(reach, points)
    s = np.linspace(0.0, reach[-1], 20 * len(points) + 1)
    (dx, dy), (ddx, ddy) = curve(s, 1).T, curve(s, 2).T
    curvature = np.abs(dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3
    longest = LONGEST_STEP * float(np.ptp(points[:, 0]))
    density = np.maximum(curvature / math.radians(FINEST_TURN_DEG), 1.0 / longest)
    number = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(s))])
    steps = math.ceil(number[-1])
    return np.asarray(curve(np.interp(np.linspace(0.0, number[-1], steps + 1), number, s)))


def placed(
    points: Floats, chord: float | None = None, axis: tuple[float, float, float] | None = None
) -> Floats:
    """Return points in any unit over the chord, from mid-chord.

    Parameters
    ----------
    points
        Points, shape (n, 2).
    chord
        The chord in their unit; None for their extent along x.
    axis
        Place (x, y) of the elastic axis in their unit, and its x/c from the leading edge: the
        outline is moved so that its axis is there, on the line y = 0. None leaves y as it is and
        has the foremost point at the leading edge.

    Raises
    ------
    OutlineError
        The points have no extent, or one that is not the chord's; the axis is far from them.
    """
    extent = float(np.ptp(points[:, 0]))
    if extent <= 0.0:
        raise OutlineError("all points have the same x; allowed is an outline along x")
    if not _SMALLEST <= extent <= _LARGEST:
        raise OutlineError(
            f"it is {extent:.4g} long along x; allowed is from {_SMALLEST:g} to {_LARGEST:g}: draw "
            "it in another unit"
        )
    chord = extent if chord is None else chord
    if not 1 / _LIKE_CHORD <= extent / chord <= _LIKE_CHORD:
        raise OutlineError(
            f"it is {extent:g} long along x, which is {extent / chord:.4g} of the chord given, "
            f"{chord:g}; the chord is in the file's unit: give about {extent:.4g}, or leave it out"
        )
    _require_axis_near(points, chord, axis)
    if axis is None:
        moved = points - (points[:, 0].min(), 0.0)
        return moved / chord - (0.5 * extent / chord, 0.0)
    x, y, behind = axis
    return (points - (x, y)) / chord + (behind - 0.5, 0.0)


def _require_axis_near(
    points: Floats, chord: float, axis: tuple[float, float, float] | None
) -> None:
    """Refuse an axis that is far from the outline, as one in another unit is."""
    low, high = points.min(axis=0), points.max(axis=0)
    at = np.array([low[0], 0.0] if axis is None else axis[:2])
    away = float(np.hypot(*np.maximum(np.maximum(low - at, at - high), 0.0))) / chord
    if away <= FARTHEST_AXIS:
        return
    what = "y = 0, where its axis is" if axis is None else f"its axis at {at[0]:g}, {at[1]:g}"
    raise OutlineError(
        f"it is {away:.4g} c away from {what}; allowed is up to {FARTHEST_AXIS:g} c: give "
        "beam.outline.axis in the unit of the file"
    )


def outline_of(points: Floats, *, is_airfoil: bool = False) -> Outline:
    """Return the outline through points over the chord, whichever way round, open or closed.

    Points that come twice in a row are dropped. Notches that are too narrow for layers of cells are
    filled, with a warning.

    Parameters
    ----------
    points
        Points in order round the section, shape (n, 2).
    is_airfoil
        They lie on a smooth curve from trailing edge to trailing edge.

    Raises
    ------
    OutlineError
        It is not one closed contour that does not cross itself, or cannot be meshed; the message
        has the place.
    """
    if not np.isfinite(points).all():
        raise OutlineError("a coordinate is not a finite number")
    if is_airfoil:
        gap = math.dist(points[0], points[-1])
        if gap > WIDEST_GAP:
            raise OutlineError(
                f"an airfoil that is open by {gap:.3g} c from {_place(points[0])} to "
                f"{_place(points[-1])}; allowed is up to {WIDEST_GAP:g} c, a blunt trailing edge"
            )
    if len(points) < FEWEST_POINTS:
        raise OutlineError(
            f"{len(points)} points; allowed are {FEWEST_POINTS} or more, of a triangle with the "
            "first one again at the end"
        )
    clean = _loop(points)
    if len(clean) < FEWEST_POINTS - 1:
        raise OutlineError(f"{len(clean)} different points; allowed are three or more")
    _require_size(clean)
    _require_one_loop(clean)
    if is_airfoil:
        is_blunt = gap > _ONE_POINT
        clean = _loop(along_curve(clean if is_blunt else np.concatenate([clean, clean[:1]])))
        _require_one_loop(clean)
    if signed_area(clean) < 0:
        clean = clean[::-1]
    corners = int((np.abs(turning_deg(clean)) > KINK_DEG).sum())
    if corners > MOST_CORNERS:
        raise OutlineError(
            f"{corners} vertices turn by more than {KINK_DEG:g} deg; allowed are {MOST_CORNERS}: "
            "smooth it, or leave out points"
        )
    clean = _without_notches(clean)
    _require_blunt(clean)
    return Outline(np.round(clean, _DIGITS) + 0.0)


def _loop(points: Floats) -> Floats:
    """Return points without doubles, and without the first one again at the end."""
    clean = _without_doubles(points, _ONE_POINT)
    is_closed = len(clean) > 1 and math.dist(clean[0], clean[-1]) < _ONE_POINT
    return clean[:-1] if is_closed else clean


def _without_doubles(points: Floats, distance: float) -> Floats:
    steps = np.hypot(*np.diff(points, axis=0).T)
    return np.asarray(points[np.concatenate([[True], steps > distance])])


def _require_size(points: Floats) -> None:
    height = float(np.ptp(points[:, 1]))
    if height < THINNEST:
        raise OutlineError(
            f"it is {height:.3g} c thick, less than the cells at its wall; allowed is from "
            f"{THINNEST:g} c"
        )
    if height > HIGHEST:
        raise OutlineError(
            f"it is {height:.3g} c high; allowed is up to {HIGHEST:g} c (x is along the chord, and "
            "flow.incidence_deg turns the section)"
        )


def _require_one_loop(points: Floats) -> None:
    """Refuse a contour that crosses or touches itself.

    Raises
    ------
    OutlineError
        It does, or shapely is missing.
    """
    try:
        import shapely  # noqa: PLC0415
    except ImportError:
        raise OutlineError(
            "outlines need the packages of the extra 'openfoam': make openfoam, or "
            "pip install -c envs/constraints.txt -e '.[openfoam]'"
        ) from None
    polygon = shapely.Polygon(points)
    if not polygon.is_valid:
        reason = shapely.is_valid_reason(polygon)
        what, _, place = reason.partition("[")
        at = (
            f" at {_place([float(number) for number in place.rstrip(']').split()])}"
            if place
            else ""
        )
        kind = "touches" if what.startswith("Ring") else "crosses"
        raise OutlineError(
            f"it {kind} itself{at}: allowed is one loop, its points in order round the section"
        )


def _require_blunt(points: Floats) -> None:
    angle = 180.0 - turning_deg(points)
    sharpest = int(np.argmin(angle))
    if angle[sharpest] < SHARPEST_DEG:
        raise OutlineError(
            f"an edge of {max(angle[sharpest], 0.0):.2g} deg at {_place(points[sharpest])}, which "
            f"has no mesh: allowed is from {SHARPEST_DEG:g} deg; cut it off, so that the edge is "
            "blunt"
        )


def _without_notches(points: Floats) -> Floats:
    """Return a contour with its notches filled where a disc does not enter them."""
    narrowest = 180.0 + float(turning_deg(points).min())
    if narrowest >= NARROWEST_NOTCH_DEG:
        return points
    import shapely  # noqa: PLC0415

    at = points[int(np.argmin(turning_deg(points)))]
    grown = shapely.Polygon(points).buffer(
        _NOTCH_RADIUS, quad_segs=30, join_style="mitre", mitre_limit=20
    )
    closed = grown.buffer(-_NOTCH_RADIUS, quad_segs=30)
    filled = np.asarray(closed.exterior.coords)[:-1]
    filled = filled if closed.exterior.is_ccw else filled[::-1]
    logger.warning(
        "the outline's notch of %.0f deg at %s is filled by a radius of %g c: cells have no room "
        "in it",
        narrowest,
        _place(at),
        _NOTCH_RADIUS,
    )
    return _without_doubles(filled, 1e-6)


def _place(point: Floats | list[float]) -> str:
    """Return a place as x/c from the leading edge and y/c."""
    return f"x/c = {point[0] + 0.5:.4g}, y/c = {point[1]:.4g}"
