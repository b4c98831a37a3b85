r"""Apparent mass of a finite beam: air that it accelerates without circulation around its sections.

At infinite frequency a plate has no wake, only a bound vortex sheet. It is a lattice of rings, M a
chord on each strip (bound vortex at a quarter, incidence at three quarters of each panel; Katz and
Plotkin, *Low-Speed Aerodynamics*, 2001, chapter 13), whose strength Gamma follows from the
incidence alone. The pressure jump is 2 dGamma/ds, so that a unit acceleration of strip j gives at
strip i

    M_w,ij = 2 sum_m Gamma_mi l_m    for an incidence of 1,
    M_t,ij = 2 sum_m x_m Gamma_mi l_m    for an incidence of x behind mid-chord,

l_m being the length of chord from one bound vortex to the next, or to the trailing edge, and x_m
its middle. Both are scaled by what the same lattice gives in two dimensions in the same channel,
where the air has the mass pi/2 and the inertia pi/64 of a thin plate (Theodorsen, NACA Report 496,
1935). A beam from wall to wall has exactly these.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.unsteady_loads import APPARENT_INERTIA, APPARENT_MASS
from equisection.aerodynamics.vortex_rings import SpanGeometry

Floats = NDArray[np.float64]

CHORDWISE_PANELS = 8
"""M, rings of a chord."""


@dataclass(frozen=True, eq=False)
class ApparentMass:
    """Apparent mass of the strips on each other, each of shape (S, S).

    Attributes
    ----------
    mass
        M_w: c_l = M_w (theta' - w'') without circulation.
    inertia
        M_t: c_m = -M_t theta''.
    """

    mass: Floats
    inertia: Floats


@lru_cache(maxsize=32)
def apparent_mass(geometry: SpanGeometry, panels: int = CHORDWISE_PANELS) -> ApparentMass:
    """Find the apparent mass of a beam; a second call with the same geometry costs nothing."""
    chord = _Chord(panels)
    section = geometry.section_downwash(chord.ways)
    above = geometry.downwash_above_section(chord.ways.ravel())
    strips = geometry.strips
    beam = above.reshape(*chord.ways.shape, strips, strips) + section[..., None, None] * np.eye(
        strips
    )
    mass, inertia = chord.masses(beam)
    section_mass, section_inertia = chord.masses(section[..., None, None])
    found = ApparentMass(
        APPARENT_MASS / section_mass[0, 0] * mass,
        APPARENT_INERTIA / section_inertia[0, 0] * inertia,
    )
    for array in (found.mass, found.inertia):
        array.flags.writeable = False  # shared by all that ask
    return found


class _Chord:
    """Places of M rings of a chord, from mid-chord back."""

    def __init__(self, panels: int) -> None:
        length = 1.0 / panels
        first = -0.5 + length * np.arange(panels)
        bound = first + 0.25 * length
        self.collocation = first + 0.75 * length
        ends = np.append(bound, 0.5 + 0.25 * length)
        self.ways = self.collocation[:, None] - ends
        self.lengths = np.append(np.full(panels - 1, length), 0.75 * length)
        self.middles = bound + 0.5 * self.lengths

    def masses(self, downwash: Floats) -> tuple[Floats, Floats]:
        """M_w and M_t not yet scaled, of G at ``ways``, shape (M, M + 1, S, S)."""
        panels, strips = downwash.shape[0], downwash.shape[-1]
        rings = downwash[:, :-1] - downwash[:, 1:]
        system = rings.transpose(0, 2, 1, 3).reshape(panels * strips, panels * strips)
        unit = np.eye(strips)
        heave = np.tile(unit, (panels, 1))
        pitch = (self.collocation[:, None, None] * unit).reshape(panels * strips, strips)
        strength = np.linalg.solve(system, np.concatenate([heave, pitch], axis=1))
        of_strips = strength.reshape(panels, strips, 2 * strips)
        lift = 2.0 * np.tensordot(self.lengths, of_strips[..., :strips], axes=1)
        moment = 2.0 * np.tensordot(self.lengths * self.middles, of_strips[..., strips:], axes=1)
        return lift, moment
