"""Known natural frequencies of the Pazy wing without its skin, undeformed and in vacuum.

The published beam has 15 elements between 16 nodes, with lumped masses at the nodes. Its stiffness
varies by a few per cent over all elements but the last ones; a beam here has one, with which its
tip turns as far under a moment or torque there. The coupling of bending and twist in the published
stiffness is left out, and of the in-plane motion nothing is here.
"""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from equisection.beam.beam import Beam, CrossSection
from equisection.beam.supports import Lump
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.modes import modes_of_kinds
from equisection.validation.known_values import KnownValue, Source

_SOURCE = Source(
    "published",
    "Riso and Cesnik, Large Deflection Working Group of AePW3 (UM-A2SRL/AePW3-LDWG): beam of "
    "2022, without skin, about 44 % of the chord, and its frequencies of 2023; places of the nodes "
    "as AeroBeams.jl has them, ribs 38.4 mm apart",
)
_LENGTH, _CHORD, _AXIS = 0.552, 0.1, 0.44
#: z/L of the nodes: root, ribs and tip rod.
_NODES = (*(0.0695652 * number for number in range(14)), 0.9652173, 1.0)
#: Torsional and out-of-plane bending stiffness (N m2) of the elements.
_TORSION = (*[7.28013126] * 4, *[6.44680609] * 4, *[6.45076354] * 4, *[7.04835928] * 2, 17.16135)
_BENDING = (
    4.59193373, 4.44735598, 4.42761615, 4.42434873, 4.42455633, 4.42464442, 4.42465, 4.42464493,
    4.42464464, 4.42460298, 4.42441646, 4.42583965, 4.43874113, 4.49851113, 4.71030765,
)  # fmt: skip
#: Mass (kg), its place behind the axis (m) and moment of inertia (kg m2) of the nodes but the root,
#: which is held.
_LUMPS = (
    (0.020678835, 0.000903119, 1.09722e-5),
    *[(0.020682882, 0.000913145, 1.09789e-5)] * 12,
    (0.025447968, -0.000811097, 1.45515e-5),
    (0.037055893, 0.004875715, 1.22188e-4),
)
#: Distributed mass and inertia, of which a beam must have some: a thousandth of a node's.
_MASS, _INERTIA = 5e-4, 3e-7


@cache
def _frequencies() -> tuple[float, ...]:
    parts = np.diff(_NODES)
    wing = Beam(
        chord=_CHORD,
        length=_LENGTH,
        thickness=0.01,
        elastic_axis=_AXIS,
        mass_axis=_AXIS,
        cross_section=CrossSection(
            bending_rigidity=float(1.0 / np.sum(parts / np.array(_BENDING))),
            torsional_rigidity=float(1.0 / np.sum(parts / np.array(_TORSION))),
            mass_per_length=_MASS,
            inertia_per_length=_INERTIA,
        ),
        lumps=tuple(
            Lump(at=at, mass=mass, behind_axis=behind, inertia_about_centre=inertia)
            for at, (mass, behind, inertia) in zip(_NODES[1:], _LUMPS, strict=True)
        ),
    )
    modes = modes_of_kinds(wing, "beam", (1, 80, 1), (5, 3), 4)
    return tuple((modal_matrices(wing, modes, 5, 3).natural_frequencies / 2 / np.pi).tolist())


def _frequency(number: int) -> float:
    return _frequencies()[number]


def pazy_values() -> list[KnownValue]:
    """Known natural frequencies of the Pazy wing."""
    names = ("bending 1", "bending 2", "torsion 1", "bending 3")
    return [
        KnownValue(
            "Pazy wing without skin, undeformed",
            name,
            "Hz",
            value,
            _SOURCE,
            partial(_frequency, number),
            0.01,
            "one stiffness along the span, without coupling of bending and twist",
        )
        for number, (name, value) in enumerate(
            zip(names, (4.222246, 28.389015, 41.465523, 82.521586), strict=True)
        )
    ]
