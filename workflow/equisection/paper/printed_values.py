"""Every number that the paper states, with its place in the paper.

Figures of the paper are pictures: no value was read off them. A number that the text prints wrongly
is given as printed, with the number that follows from the paper's own values.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

#: How a value is meant: a number, an approximate one, or a bound.
Relation = Literal["equal", "about", "at least", "above", "below"]


@dataclass(frozen=True)
class Published:
    """One number of the paper.

    Attributes
    ----------
    quantity
        Name with unit; also the key by which this run's value is found.
    value
        The number.
    source
        Its place in the paper.
    relation
        Relation of the quantity to the value: equal to it, or bounded by it.
    mesh
        The paper's mesh, where it gives the quantity on several.
    note
        Remark that the comparison needs.
    """

    quantity: str
    value: float
    source: str
    relation: Relation = "equal"
    mesh: str = ""
    note: str = ""

    @property
    def name(self) -> str:
        """Quantity and mesh: unique among :data:`PUBLISHED`."""
        return f"{self.quantity} ({self.mesh})" if self.mesh else self.quantity

    def holds(self, here: float) -> bool:
        """Tell whether a value obeys the bound; an equality holds for every value."""
        match self.relation:
            case "at least":
                return here >= self.value
            case "above":
                return here > self.value
            case "below":
                return here < self.value
        return True


#: Part of a value by which one that the paper calls approximate may be off. The paper gives no
#: interval; this is the assumption of every comparison here.
ABOUT = 0.1

#: Table 1: C_D, C_L, C_M of the rigid plate by mesh and incidence (deg).
TABLE_1: dict[str, dict[float, tuple[float, float, float]]] = {
    "4.7e6 cells": {
        0.0: (0.0473, 0.0000, 0.0000),
        2.5: (0.0555, 0.2554, 0.0585),
        5.0: (0.0872, 0.4945, 0.0804),
        10.0: (0.1551, 0.5727, 0.0687),
    },
    "7.0e6 cells": {
        0.0: (0.0450, 0.0000, 0.0000),
        2.5: (0.0554, 0.2554, 0.0585),
        5.0: (0.0867, 0.4861, 0.0711),
        10.0: (0.1550, 0.5725, 0.0677),
    },
    "15e6 cells": {
        0.0: (0.0438, 0.0000, 0.0000),
        2.5: (0.0541, 0.2613, 0.0602),
        5.0: (0.0858, 0.4826, 0.0697),
        10.0: (0.1535, 0.5684, 0.0659),
    },
}
#: The paper's names of the coefficients of Table 1, with those of the data sets.
COEFFICIENTS = {"C_D": "cd", "C_L": "cl", "C_M": "cm"}

#: Table 2: C_1 to C_5 of Eq. 23 by mesh.
TABLE_2: dict[str, tuple[float, float, float, float, float]] = {
    "8.5e3 elements": (2.44e-4, 1.52e-3, 1.77e-3, 4.28e-3, 5.49e-3),
    "5.0e4 elements": (2.42e-4, 1.49e-3, 1.73e-3, 4.19e-3, 5.35e-3),
}
#: Kinds of the modes of Table 2.
TABLE_2_KINDS = ("bending", "bending", "torsion", "bending", "torsion")

_CASE = (
    Published("chord c (m)", 0.1, "Section 2"),
    Published("span L/c", 3.7, "Section 2"),
    Published("thickness h/c", 0.04, "Section 2"),
    Published("aspect ratio 2L/c", 7.4, "Section 2"),
    Published("channel height H/c", 4.0, "Section 2"),
    Published("channel upstream L_u/c", 5.0, "Section 2"),
    Published("channel downstream L_d/c", 15.0, "Section 2"),
    Published("incidence theta_0 (deg)", 2.5, "Section 2"),
    Published("speed V (m/s)", 20.0, "Section 2"),
    Published("density rho (kg/m3)", 1.18, "Section 2"),
    Published("viscosity mu (Pa s)", 1.86e-5, "Section 2"),
    Published("sound speed a (m/s)", 340.0, "Section 2"),
    Published("Young's modulus E (Pa)", 3.3e9, "Section 2"),
    Published("Poisson's ratio nu", 0.35, "Section 2"),
    Published("density of the plate rho_s (kg/m3)", 1180.0, "Section 2"),
    Published(
        "Reynolds number",
        1.5e5,
        "Section 2",
        "about",
        "Section 2",
        "rho V c/mu of the paper's own values is 1.27e5",
    ),
    Published(
        "Reynolds number",
        1.0e5,
        "Section 4.1, on Fig. 8",
        "about",
        "Fig. 8",
        "rho V c/mu of the paper's own values is 1.27e5",
    ),
    Published(
        "Reynolds number",
        1.18 * 20.0 * 0.1 / 1.86e-5,
        "follows from Section 2",
        mesh="rho V c/mu",
        note="not printed in the paper",
    ),
    Published("Mach number", 0.06, "Section 2", "about"),
)

_SECTION = (
    Published("c^2 k_w/k_theta", 0.183, "Section 3, after Eq. 18", "about"),
    Published("c^2 m_2D/I_2D", 9.12, "Section 3, after Eq. 18", "about"),
    Published(
        "k* of the plate as given", 21.0, "caption of Fig. 15", "about", note="a nominal value"
    ),
)

_TABLE_1 = tuple(
    Published(f"{name} at {angle:g} deg", value, "Table 1", mesh=mesh)
    for mesh, rows in TABLE_1.items()
    for angle, values in rows.items()
    for name, value in zip(COEFFICIENTS, values, strict=True)
)
_TABLE_2 = tuple(
    Published(f"C_{number} ({kind})", value, "Table 2", mesh=mesh)
    for mesh, values in TABLE_2.items()
    for number, (kind, value) in enumerate(zip(TABLE_2_KINDS, values, strict=True), start=1)
)

_AERODYNAMICS = (
    Published("c_l/C_L at theta_0", 1.0, "Section 5.1, on Figs. 13 and 14", "above"),
    Published("c_m/C_M at theta_0", 1.0, "Section 5.1, on Figs. 13 and 14", "above"),
    Published("c_l/C_L at 10 deg", 1.0, "Section 5.1, on Figs. 13 and 14", "below"),
    Published("c_m/C_M at 10 deg", 1.0, "Section 5.1, on Figs. 13 and 14", "below"),
)

_RESPONSE = (
    Published("first torsion mode over the others", 100.0, "Section 5.2, on Fig. 15", "at least"),
    Published("first bending mode over the others", 100.0, "Section 5.2, on Fig. 15", "at least"),
    Published("k* of the onset", 5.5, "Section 5.2, on Fig. 16", "about"),
    Published(
        "cost of 3D over 2D, per time simulated",
        (5e6 / 5.0e-7) / (5.1e4 / 1.25e-6),
        "follows from Sections 4.1 and 4.2",
        "about",
        note="(cells/time step) of 3D over 2D; the paper says 'orders of magnitude'",
    ),
)

#: Length of the section's bubble over the chord, by incidence (deg).
BUBBLE_2D = {1.0: 0.5, 5.0: 1.0}
#: The same at the root of the plate (Section 5.1, on Fig. 11).
BUBBLE_AT_ROOT = {2.0: 0.25, 4.0: 0.8}

_SURFACE = (
    Published("bubble over chord, 2D at 1 deg", BUBBLE_2D[1.0], "Section 4.1, on Fig. 7", "about"),
    Published("bubble over chord, 2D at 5 deg", BUBBLE_2D[5.0], "Section 4.1, on Fig. 7"),
    Published(
        "wall y+, 2D",
        1.0,
        "Section 4.1, on Fig. 7",
        "below",
        note="the paper says 'for the whole plate'",
    ),
)

_FLOW_FIELD = (
    Published("bubble over chord, 3D root at 2 deg", 0.25, "Section 5.1, on Fig. 11", "about"),
    Published("bubble over chord, 3D at 4 deg", 0.8, "Section 5.1, on Fig. 11", "about"),
    Published("CFL of the major part of the cells, 2D", 2.0, "Section 4.1, on Fig. 8", "below"),
    Published("CFL of 90 % of the volume, 2D", 1.5, "Section 4.1, on Fig. 8", "below"),
    Published("CFL of 92 % of the volume, 3D", 1.0, "Section 4.2, on Fig. 8", "below"),
)

_DISCRETISATION = (
    Published("cells, 2D", 5.1e4, "Section 4.1", "about", "mesh"),
    Published("cells, 2D", 3.5e4, "Section 4.1, on Fig. 8", "equal", "Fig. 8"),
    Published("cells, 3D", 5e6, "Section 4.2", "about"),
    Published("time step (s), 2D", 1.25e-6, "Section 4.1", note="if in seconds; printed as dt c/V"),
    Published("time step (s), 3D", 5.0e-7, "Section 4.2", note="if in seconds; printed as dt c/V"),
    Published("cell size over chord at the wall, 2D", 0.004, "Section 4.1", "about"),
    Published("cell size over chord at the overset, 2D", 0.020, "Section 4.1", "about"),
    Published("cell size over chord in the wake, 2D", 0.040, "Section 4.1", "about"),
    Published("cell size over chord, largest, 2D", 0.200, "Section 4.1", "about"),
    Published("prism layer over chord, 2D", 0.075, "Section 4.1"),
    Published("cells across the prism layer, 2D", 5.0, "Section 4.1"),
    Published("cell size over chord at the wall, 3D", 0.010, "Section 4.2", "about"),
    Published("cell size over chord at the overset, 3D", 0.020, "Section 4.2", "about"),
    Published("cell size over chord in the wake, 3D", 0.040, "Section 4.2", "about"),
    Published("cell size over chord, largest, 3D", 0.400, "Section 4.2", "about"),
    Published("element size of the plate over chord", 0.035, "Section 4.2", "about"),
    Published("elements through the plate's thickness", 4.0, "Section 4.2"),
)

#: All of them, in the order of the comparison.
PUBLISHED: tuple[Published, ...] = (
    *_CASE,
    *_SECTION,
    *_TABLE_2,
    *_TABLE_1,
    *_AERODYNAMICS,
    *_RESPONSE,
    *_SURFACE,
    *_FLOW_FIELD,
    *_DISCRETISATION,
)
#: k* of the onset, and its interval.
_ONSET = next(value.value for value in PUBLISHED if value.quantity == "k* of the onset")
PAPER_ONSET = (_ONSET, (1.0 - ABOUT) * _ONSET, (1.0 + ABOUT) * _ONSET)
#: Quantities that only a resolved flow field has.
FLOW_FIELD: frozenset[str] = frozenset(value.quantity for value in _FLOW_FIELD)
#: Quantities of the paper's meshes and time steps.
DISCRETISATION: frozenset[str] = frozenset(value.quantity for value in _DISCRETISATION)


def relative_difference(paper: float, here: float) -> float:
    """Return (here - paper)/paper; NaN where either is missing or the paper's value is 0.

    Rounded to nine decimals, so that the same number with another last bit is no difference.
    """
    if not (math.isfinite(paper) and math.isfinite(here)) or paper == 0.0:
        return math.nan
    return round((here - paper) / paper, 9) + 0.0
