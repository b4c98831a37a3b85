"""Pressure, friction and wall distance over the rigid plate, as data.

Everything is in the frame of the plate, over the chord: x from the leading edge along the chord, y
from the chord line to the upper side, z from the root along the span. The faces close the plate's
surface but for its root, so that the loads follow from them.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field, fields

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.results import surface

Floats = NDArray[np.float64]

#: Distance along the span within which faces are in one layer (chords).
_SAME_LAYER = 1e-5
_NOTHING = np.empty(0)

#: Outward normals of the sides (x, y, z).
NORMALS = {
    **{side: (*normal, 0.0) for side, normal in surface.NORMALS.items()},
    "tip": (0.0, 0.0, 1.0),
}
#: Directions in which friction counts as positive: around the section, as in 2D, and along the
#: span; on the tip along the chord, and upwards.
ALONG = {
    **{side: (*tangent, 0.0) for side, tangent in surface.TANGENTS.items()},
    "tip": (1.0, 0.0, 0.0),
}
SPANWISE = {**dict.fromkeys(surface.TANGENTS, (0.0, 0.0, 1.0)), "tip": (0.0, 1.0, 0.0)}


@dataclass(frozen=True)
class PlateSurface:
    """Pressure, friction and y+ on each face of the plate's surface, arrays of shape (n,).

    Attributes
    ----------
    x, y, z
        Middle of the face over the chord.
    area
        Area of the face over c^2.
    side
        Side of the face, one of :data:`NORMALS`; by ascending z and x on each side.
    pressure
        c_p = (p - p_outlet)/(rho V^2/2).
    friction, spanwise_friction
        Components of tau/(rho V^2/2) in the plane of the face, positive as in :data:`ALONG` and
        :data:`SPANWISE`.
    y_plus
        y+ of the middle of the first cell.
    normal_x, normal_y
        Outward normal of the face, of an outline that is no rectangle; empty for one, whose sides
        have theirs, and 0 on the tip. The outline's sides are the upper and the lower one, as in
        2D, and friction is positive along them.
    arc
        Arc length (chords) from the foremost point of the contour along the side to the face, of
        such an outline; x on the tip.
    """

    x: Floats
    y: Floats
    z: Floats
    area: Floats
    side: NDArray[np.str_]
    pressure: Floats
    friction: Floats
    spanwise_friction: Floats
    y_plus: Floats
    normal_x: Floats = field(default_factory=lambda: _NOTHING)
    normal_y: Floats = field(default_factory=lambda: _NOTHING)
    arc: Floats = field(default_factory=lambda: _NOTHING)

    @property
    def has_outline(self) -> bool:
        """Tell whether the section is of an outline that is no rectangle."""
        return bool(self.arc.size)

    @property
    def along_side(self) -> Floats:
        """Place along the side: x/c, or the arc length of an outline, shape (n,)."""
        return self.arc if self.has_outline else self.x

    @property
    def span(self) -> float:
        """L/c, from the faces of the upper side, of which there are from root to tip."""
        upper = self.on("upper")
        if not self.has_outline:
            return float(upper.area.sum())  # over a chord of 1
        middles = np.array([upper.z[layer].mean() for layer in _layers(upper.z)])
        # each layer is as far from its middle to one edge as to the other
        return float(2 * np.abs((middles * (-1.0) ** np.arange(middles.size)).sum()))

    def variables(self) -> dict[str, tuple[str, NDArray[np.generic], dict[str, str]]]:
        """Return the variables that are written to file, over ``face``, in single precision."""
        along = "positive towards the trailing edge, at the edges upwards"
        spanwise = "positive towards the tip, on the tip upwards"
        texts = {
            "x": "x/c of the face from the leading edge along the chord",
            "y": "y/c of the face from the chord line, up",
            "z": "z/c of the face from the root along the span",
            "area": "area of the face over the chord squared",
            "cp": "pressure coefficient, from the outlet's",
            "cf": f"friction coefficient along the section, {along}",
            "cf_span": f"friction coefficient along the span, {spanwise}",
            "y_plus": "y+ of the middle of the first cell",
            "normal_x": "outward normal, along the chord",
            "normal_y": "outward normal, across the chord",
            "arc": "arc length over the chord from the foremost point of the contour",
        }
        numbers = {
            name: ("face", getattr(self, member).astype(np.float32), _says(texts[name]))
            for name, member in {**_FIELDS, **(_OF_OUTLINE if self.has_outline else {})}.items()
        }
        sides = _says(f"side of the plate: {', '.join(NORMALS)}")
        return {**numbers, "side": ("face", self.side, sides)}

    def on(self, side: str) -> PlateSurface:
        """Return the faces of one side."""
        return self.taken(self.side == side)

    def taken(self, which: NDArray[np.generic]) -> PlateSurface:
        """Return some of the faces, or all in another order, by mask or numbers."""
        values = {one.name: getattr(self, one.name) for one in fields(self)}
        return PlateSurface(**{name: v[which] if v.size else v for name, v in values.items()})

    def reattachment(self, side: str) -> tuple[Floats, Floats]:
        """Return z/c of the layers of faces from the root, and x/c of the bubble's end in each.

        As in 2D, 0 is no bubble and 1 a bubble over the whole chord
        (:func:`surface.reattachment`).
        """
        faces = self.on(side)
        layers = _layers(faces.z)
        bubble = [
            surface.reattachment(faces.x[layer], faces.area[layer], faces.friction[layer])
            for layer in layers
        ]
        return np.array([faces.z[layer].mean() for layer in layers]), np.array(bubble)

    def loads(self, incidence_deg: float) -> tuple[float, float, float]:
        """Return C_D, C_L and C_M about mid-chord, nose up, summed over the faces (Eq. 22).

        The traction on a face is -c_p n + c_f t.
        """
        normal, along, spanwise = self.directions()
        traction = self.friction[:, None] * along + self.spanwise_friction[:, None] * spanwise
        force = (traction - self.pressure[:, None] * normal) * self.area[:, None]
        moment = self.y * force[:, 0] - (self.x - 0.5) * force[:, 1]
        span = self.span
        along_chord, across = force[:, :2].sum(axis=0) / span
        turning = float(moment.sum() / span)
        return surface.in_stream(float(along_chord), float(across), turning, incidence_deg)

    def directions(self) -> tuple[Floats, Floats, Floats]:
        """Return outward normal, and directions of positive friction, of each face, (n, 3).

        On the upper side of an outline friction along the section is positive a quarter turn
        clockwise from the normal.
        """
        normal, along, spanwise = (
            np.array([directions[str(side)] for side in self.side])
            for directions in (NORMALS, ALONG, SPANWISE)
        )
        if self.has_outline:
            here = self.side != "tip"
            sense = np.where(self.side == "upper", 1.0, -1.0)[here]
            x, y = self.normal_x[here], self.normal_y[here]
            normal[here, :2] = np.stack([x, y], axis=-1)
            along[here, :2] = sense[:, None] * np.stack([y, -x], axis=-1)
        return normal, along, spanwise


def _layers(z: Floats) -> list[slice]:
    """Return the layers of faces of one side, from the root to the tip."""
    ends = np.append(np.flatnonzero(np.diff(z) > _SAME_LAYER) + 1, z.size)
    return [slice(*pair) for pair in itertools.pairwise([0, *ends])]


def joined(pieces: Sequence[PlateSurface]) -> PlateSurface:
    """Return the faces of all pieces, by side, z, place along the side and y."""
    whole = PlateSurface(
        *(
            np.concatenate([getattr(piece, one.name) for piece in pieces])
            for one in fields(PlateSurface)
        )
    )
    # the z of a layer differs by rounding between pieces
    return whole.taken(np.lexsort((whole.y, whole.along_side, whole.z.round(9), whole.side)))


#: Variables of numbers in a file, and the fields that they hold.
_FIELDS = {
    "x": "x",
    "y": "y",
    "z": "z",
    "area": "area",
    "cp": "pressure",
    "cf": "friction",
    "cf_span": "spanwise_friction",
    "y_plus": "y_plus",
}
_OF_OUTLINE = {name: name for name in ("normal_x", "normal_y", "arc")}


def plate_surface_from_dataset(dataset: xr.Dataset) -> PlateSurface | None:
    """Return the surface data of a steady result of the plate; None if it has none.

    Raises
    ------
    ResultFileError
        A side is unknown.
    """
    if "cf_span" not in dataset:
        return None
    side = surface.known_sides(dataset, NORMALS)
    names = {**_FIELDS, **(_OF_OUTLINE if "arc" in dataset else {})}
    numbers = {field: dataset[name].values.astype(float) for name, field in names.items()}
    return PlateSurface(side=side, **numbers)


def _says(long_name: str) -> dict[str, str]:
    return {"units": "1", "long_name": long_name}
