"""Places along the contour of an outline: side and arc length of a point on it.

The upper side goes from the foremost to the rearmost point of the contour above the body, the lower
one below it. Of several points that are as far, the one nearest to the chord counts, and of two of
these the lower one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.outline import edge_lengths

Floats = NDArray[np.float64]

#: Digits of a coordinate by which two points are as far.
_DIGITS = 9
#: Least cosine between the normal of a face and that of the edge that it is on.
_LEAST_COSINE = 0.3
#: Points that are placed at once: each is held against every edge of the contour.
_AT_ONCE = 1000


@dataclass(frozen=True)
class Contour:
    """Contour of an outline from its rearmost point, counter-clockwise.

    Attributes
    ----------
    points : (n, 2) array
        Vertices over the chord.
    reach : (n,) array
        Arc length from the first vertex to each (chords).
    length, upper
        Arc length of the whole contour, and of its upper side.
    """

    points: Floats
    reach: Floats
    length: float
    upper: float

    @classmethod
    def of(cls, outline: Floats) -> Contour:
        """Return the contour of an outline (n, 2), counter-clockwise from any of its vertices."""
        nose, tail = (int(end) for end in ends_of(outline))
        points = np.roll(outline, -tail, axis=0)
        lengths = edge_lengths(points)
        reach = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
        upper = float(reach[(nose - tail) % len(outline)])
        return cls(points, reach, float(lengths.sum()), upper)

    def place(self, points: Floats, normals: Floats) -> tuple[NDArray[np.str_], Floats]:
        """Return side and arc length (chords) from the foremost point of points near the contour.

        Parameters
        ----------
        points, normals
            The points and the outward normals there, shape (m, 2).
        """
        starts = range(0, max(1, len(points)), _AT_ONCE)
        parts = [
            self._place(points[start : start + _AT_ONCE], normals[start : start + _AT_ONCE])
            for start in starts
        ]
        sides, arcs = zip(*parts, strict=True)
        return np.concatenate(sides), np.concatenate(arcs)

    def _place(self, points: Floats, normals: Floats) -> tuple[NDArray[np.str_], Floats]:
        edges = np.roll(self.points, -1, axis=0) - self.points
        lengths = np.hypot(*edges.T)
        along = edges / lengths[:, None]
        outward = np.stack([along[:, 1], -along[:, 0]], axis=-1)
        apart = points[:, None, :] - self.points
        part = np.clip((apart * along).sum(axis=-1), 0.0, lengths)
        distance = np.hypot(*np.moveaxis(apart - part[..., None] * along, -1, 0))
        # the walls of a thin part are near each other, and told apart by where they look
        faces = normals @ outward.T > _LEAST_COSINE * np.hypot(*normals.T)[:, None]
        distance = np.where(faces, distance, distance + self.length)
        nearest = distance.argmin(axis=1)
        row = np.arange(len(points))
        reach = self.reach[nearest] + part[row, nearest]
        is_upper = reach < self.upper
        return np.where(is_upper, "upper", "lower"), np.abs(reach - self.upper)


def ends_of(points: Floats) -> tuple[int, int]:
    """Return the numbers of the foremost and the rearmost point of a contour (n, 2)."""
    x, y = points.T.round(_DIGITS)
    nose, tail = (int(np.lexsort((y, np.abs(y), way))[0]) for way in (x, -x))
    return nose, tail


def cut_at(outline: Floats, x: float, incidence: Floats) -> Floats:
    """Return the lowest and the highest y of a body on a line across the stream, shape (m, 2).

    Parameters
    ----------
    outline
        Vertices of its contour over the chord, shape (n, 2).
    x
        Place of the line from mid-chord along the stream (chords).
    incidence
        Incidences (rad, nose up), shape (m,). NaN is returned where the line misses the body.
    """
    cosine, sine = np.cos(incidence)[:, None], np.sin(incidence)[:, None]
    along = outline[:, 0] * cosine + outline[:, 1] * sine - x
    up = outline[:, 1] * cosine - outline[:, 0] * sine
    after, up_after = np.roll(along, -1, axis=1), np.roll(up, -1, axis=1)
    crosses = (along <= 0) != (after <= 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        y = up + (up_after - up) * along / (along - after)
    low = np.where(crosses, y, np.inf).min(axis=1)
    high = np.where(crosses, y, -np.inf).max(axis=1)
    found = np.stack([low, high], axis=-1)
    return np.asarray(np.where(np.isfinite(found), found, np.nan))
