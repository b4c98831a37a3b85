"""Sizes of the cells of the mesh around an outline, in chords at refinement 1.

The layers at the wall are thicker than a separation bubble: thin ones, with the sizes of the mesh
outside on the shear layer, cost 4 % of the rectangle's lift at 2.5 deg. A refinement r multiplies
all counts by r and divides all sizes by it, so that meshes of a grid study are similar.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

#: Reynolds number (chord) up to which the first cells are fine enough, and the power of it that y+
#: goes with. On a flat plate with a turbulent boundary layer c_f = 0.058 Re^(-1/5) (Prandtl;
#: Schlichting, Boundary-Layer Theory), so that y+ = (y/c) Re sqrt(c_f/2): 2.8 at the middle of a
#: first cell of 3e-4 c, and about twice that where the stream turns round a nose.
FINE_UP_TO, POWER = 4e5, 0.9
#: Reynolds number above which the first cells are no thinner, and y+ grows: they would be more than
#: 1000 times as long as thick, which checkMesh finds fault with.
THIN_UP_TO = 1e7


@dataclass(frozen=True)
class OutlineSizes:
    """Sizes (chords), growths (-) and counts (-).

    Attributes
    ----------
    first, layers, growth
        First cell off the wall, number of layers, and their largest growth.
    last
        Thickness of the last layer over the spacing along the wall.
    wall, at_corner, turn_deg
        Largest spacing along the wall, that at a corner, and the turning of a curve in a cell.
    wall_growth
        Change of the spacing with the distance along the wall.
    side_over_corner
        Length of a side over the spacing at its corners, at the least.
    fan_from_deg, fan_step_deg
        Turning of a convex corner from which rays fan out, and the angle between them.
    near, wake, outward
        Largest cells around the body and behind it, and the growth of the size with the distance.
    disc
        Radius of the disc around the body whose cells turn with it.
    far
        Largest cells at the channel's ends, as a part of its height.
    """

    first: float = 3e-4
    layers: int = 26
    growth: float = 1.18
    last: float = 1.2
    wall: float = 0.014
    at_corner: float = 2e-3
    turn_deg: float = 6.0
    wall_growth: float = 0.16
    side_over_corner: float = 14.0
    fan_from_deg: float = 50.0
    fan_step_deg: float = 18.0
    near: float = 0.035
    wake: float = 0.05
    outward: float = 0.16
    disc: float = 1.0
    far: float = 0.075

    def resolving(self, reynolds: float) -> OutlineSizes:
        """Return sizes with first cells that have no larger y+ at a Reynolds number of the chord.

        They are thinner from :data:`FINE_UP_TO` to :data:`THIN_UP_TO`, in as many more layers as
        keep the growth and with it the thickness of all.
        """
        if reynolds <= FINE_UP_TO:
            return self
        thinner = (min(reynolds, THIN_UP_TO) / FINE_UP_TO) ** POWER
        more = math.ceil(math.log(thinner) / math.log(self.growth))
        return replace(self, first=self.first / thinner, layers=self.layers + more)


#: Number of cells at refinement 1 in a channel of 4 c, of a section of the usual shapes.
TYPICAL_CELLS = 11_000
#: Turning of a vertex (deg) from which it is a corner with small cells.
CORNER_DEG = 25.0
