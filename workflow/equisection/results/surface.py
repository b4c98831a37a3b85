"""Pressure, friction and wall distance around the section, as data.

Everything is in the frame of the section: x from the leading edge along the chord, y from the
chord line to the upper side, over the chord. The faces close the contour, so that the loads
follow from them.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, field

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.errors import ResultFileError

Floats = NDArray[np.float64]

_NOTHING = np.empty(0)
#: Outward normals of the sides of a rectangle, and the directions in which friction counts as
#: positive: towards the trailing edge along the chord, and upwards at the edges.
NORMALS = {
    "upper": (0.0, 1.0),
    "lower": (0.0, -1.0),
    "leading edge": (-1.0, 0.0),
    "trailing edge": (1.0, 0.0),
}
TANGENTS = {
    "upper": (1.0, 0.0),
    "lower": (1.0, 0.0),
    "leading edge": (0.0, 1.0),
    "trailing edge": (0.0, 1.0),
}


@dataclass(frozen=True)
class SectionSurface:
    """Pressure, friction and y+ on each face of the section's contour, arrays of shape (n,).

    Attributes
    ----------
    x, y
        Middle of the face over the chord.
    length
        Length of the face over the chord.
    side
        Side of the face, one of :data:`NORMALS`; by ascending x or y on each side.
    pressure
        c_p = (p - p_outlet)/(rho V^2/2).
    friction
        c_f = tau/(rho V^2/2), positive as in :data:`TANGENTS`; negative on the upper and the lower
        side where the flow at the wall is reversed.
    y_plus
        y+ of the middle of the first cell.
    normal_x, normal_y
        Outward normal of the face, of an outline that is no rectangle; empty for one, whose sides
        have theirs. The outline's sides are the upper and the lower one, from the foremost to the
        rearmost point of the contour, with the faces in this order, and friction is positive along
        them.
    """

    x: Floats
    y: Floats
    length: Floats
    side: NDArray[np.str_]
    pressure: Floats
    friction: Floats
    y_plus: Floats
    normal_x: Floats = field(default_factory=lambda: _NOTHING)
    normal_y: Floats = field(default_factory=lambda: _NOTHING)

    def variables(self) -> dict[str, tuple[str, NDArray[np.generic], dict[str, str]]]:
        """Return the variables that are written to file, over ``face``."""
        along = "positive towards the trailing edge, at the edges upwards"
        normals: dict[str, tuple[str, NDArray[np.generic], dict[str, str]]] = {}
        if self.normal_x.size:
            normals = {
                "normal_x": ("face", self.normal_x, _says("outward normal, along the chord")),
                "normal_y": ("face", self.normal_y, _says("outward normal, across the chord")),
            }
        return {
            **normals,
            "x": ("face", self.x, _says("x/c of the face from the leading edge along the chord")),
            "y": ("face", self.y, _says("y/c of the face from the chord line, up")),
            "length": ("face", self.length, _says("length of the face over the chord")),
            "side": ("face", self.side, _says(f"side of the section: {', '.join(NORMALS)}")),
            "cp": ("face", self.pressure, _says("pressure coefficient, from the outlet's")),
            "cf": ("face", self.friction, _says(f"friction coefficient, {along}")),
            "y_plus": ("face", self.y_plus, _says("y+ of the middle of the first cell")),
        }

    def on(self, side: str) -> SectionSurface:
        """Return the faces of one side."""
        here = self.side == side
        return SectionSurface(
            self.x[here],
            self.y[here],
            self.length[here],
            self.side[here],
            self.pressure[here],
            self.friction[here],
            self.y_plus[here],
            self.normal_x[here] if self.normal_x.size else _NOTHING,
            self.normal_y[here] if self.normal_y.size else _NOTHING,
        )

    def normals_and_tangents(self) -> tuple[Floats, Floats]:
        """Return the outward normal, and the direction of positive friction, of each face, (n, 2).

        On the upper side of an outline that is a quarter turn clockwise from the normal.
        """
        sides = [str(side) for side in self.side]
        if not self.normal_x.size:
            normal = np.array([NORMALS[side] for side in sides])
            return normal, np.array([TANGENTS[side] for side in sides])
        normal = np.stack([self.normal_x, self.normal_y], axis=-1)
        sense = np.where(self.side == "upper", 1.0, -1.0)
        return normal, sense[:, None] * np.stack([self.normal_y, -self.normal_x], axis=-1)

    def reattachment(self, side: str) -> float:
        """Return x/c where the bubble of a side ends; see :func:`reattachment`."""
        faces = self.on(side)
        return reattachment(faces.x, faces.length, faces.friction)

    def loads(self, incidence_deg: float) -> tuple[float, float, float]:
        """Return c_d, c_l and c_m about mid-chord, nose up, summed over the contour.

        The traction on a face is -c_p n + c_f t; a no-slip wall has no other.
        """
        normal, tangent = self.normals_and_tangents()
        traction = self.friction[:, None] * tangent - self.pressure[:, None] * normal
        force = traction * self.length[:, None]
        along, across = force.sum(axis=0)
        moment = (self.y * force[:, 0] - (self.x - 0.5) * force[:, 1]).sum()
        return in_stream(float(along), float(across), float(moment), incidence_deg)


def reattachment(x: Floats, length: Floats, friction: Floats) -> float:
    """Return x/c where the bubble from the leading edge ends: 0 for none, 1 for all the chord.

    There c_f changes from negative to positive. Of several such places (the small vortices at the
    corners of the edges have their own) it is the one up to which the integral of c_f over x is
    smallest.

    Parameters
    ----------
    x, length, friction
        Middle and length over the chord, and c_f, of the faces from the leading edge to the
        trailing edge, shape (n,).
    """
    reversed_faces = int(np.argmin(np.cumsum(np.append(0.0, friction * length))))
    if reversed_faces in (0, x.size):
        return float(reversed_faces > 0)
    both = slice(reversed_faces - 1, reversed_faces + 1)
    return float(np.interp(0.0, friction[both], x[both]))


def in_stream(
    along: float, across: float, moment: float, incidence_deg: float
) -> tuple[float, float, float]:
    """Return drag, lift and moment of a force along the chord and across it, and a moment."""
    cosine, sine = math.cos(math.radians(incidence_deg)), math.sin(math.radians(incidence_deg))
    return along * cosine + across * sine, across * cosine - along * sine, moment


def suction_side(incidence_deg: float) -> str:
    """Return the side of lower pressure; the upper one at 0 deg, where both have the same."""
    return "lower" if incidence_deg < 0 else "upper"


def surface_from_dataset(dataset: xr.Dataset) -> SectionSurface | None:
    """Return the surface data of a steady result of the section; None if it has none.

    Raises
    ------
    ResultFileError
        A side is unknown.
    """
    if "cp" not in dataset:
        return None
    side = known_sides(dataset, NORMALS)
    names = ("x", "y", "length", "cp", "cf", "y_plus")
    x, y, length, pressure, friction, y_plus = (dataset[name].values for name in names)
    normal = [
        dataset[name].values if name in dataset else _NOTHING for name in ("normal_x", "normal_y")
    ]
    return SectionSurface(x, y, length, side, pressure, friction, y_plus, *normal)


def known_sides(dataset: xr.Dataset, allowed: Collection[str]) -> NDArray[np.str_]:
    """Return the side of each face.

    Raises
    ------
    ResultFileError
        A side is not one of those allowed.
    """
    side: NDArray[np.str_] = dataset["side"].values.astype(str)
    unknown = sorted(set(side) - set(allowed))
    if unknown:
        raise ResultFileError(
            f"side: {', '.join(unknown)}; allowed are {', '.join(allowed)}; run the case again"
        )
    return side


def _says(long_name: str) -> dict[str, str]:
    return {"units": "1", "long_name": long_name}
