"""Known natural frequencies and flutter of the Pazy wing, undeformed, without and with its skin.

The published beams have 15 elements between 16 nodes, with lumped masses at the nodes. Their
stiffness varies by a few per cent over most elements; a beam here has one, with which its tip
moves as far under a force there, and turns as far under a torque. The coupling of bending and twist
in the published stiffness is left out, and of the in-plane motion nothing is here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from equisection.beam.beam import Beam, CrossSection
from equisection.beam.supports import Lump
from equisection.motion.beam_flutter import FlutterOnset, beam_flutter
from equisection.structure.modal_matrices import ModalMatrices, modal_matrices
from equisection.structure.modes import modes_of_kinds
from equisection.validation.known_values import KnownValue, Source

_AXIS, _AIR = 0.44, 1.225
#: Distributed mass and inertia, of which a beam must have some: a thousandth of a node's.
_MASS, _INERTIA = 5e-4, 3e-7
_ONE_STIFFNESS = "one stiffness along the span, bending and twist not coupled"


@dataclass(frozen=True)
class PublishedWing:
    """Published beam of the Pazy wing, and its frequencies.

    Attributes
    ----------
    case, source
        Names of the case and of the place that it is from.
    length, chord
        Span and chord (m).
    nodes
        z/L of the nodes, root and tip included.
    torsion, bending
        Torsional and out-of-plane bending stiffness (N m2) of the elements.
    lumps
        Mass (kg), its place behind the axis (m) and moment of inertia (kg m2) of the nodes but the
        root, which is held.
    frequencies
        Those of the modes, bending 1, 2, torsion 1, bending 3 (Hz).
    """

    case: str
    source: Source
    length: float
    chord: float
    nodes: Sequence[float]
    torsion: Sequence[float]
    bending: Sequence[float]
    lumps: Sequence[tuple[float, float, float]]
    frequencies: tuple[float, float, float, float]

    @property
    def beam(self) -> Beam:
        """The beam here."""
        nodes = np.array(self.nodes)
        bent, turned = -np.diff((1.0 - nodes) ** 3), np.diff(nodes)
        return Beam(
            chord=self.chord,
            length=self.length,
            thickness=0.01,
            elastic_axis=_AXIS,
            mass_axis=_AXIS,
            cross_section=CrossSection(
                bending_rigidity=float(1.0 / np.sum(bent / np.array(self.bending))),
                torsional_rigidity=float(1.0 / np.sum(turned / np.array(self.torsion))),
                mass_per_length=_MASS,
                inertia_per_length=_INERTIA,
            ),
            lumps=tuple(
                Lump(at=at, mass=mass, behind_axis=behind, inertia_about_centre=inertia)
                for at, (mass, behind, inertia) in zip(self.nodes[1:], self.lumps, strict=True)
            ),
        )


_WITHOUT_SKIN = PublishedWing(
    case="Pazy wing without skin, undeformed",
    source=Source(
        "published",
        "Riso and Cesnik, Large Deflection Working Group of AePW3 (UM-A2SRL/AePW3-LDWG): beam of "
        "2022, about 44 % of the chord, frequencies of 2023; nodes of AeroBeams.jl",
    ),
    length=0.552,
    chord=0.1,
    nodes=(*(0.0695652 * number for number in range(14)), 0.9652173, 1.0),
    torsion=(*[7.28013126] * 4, *[6.44680609] * 4, *[6.45076354] * 4, *[7.04835928] * 2, 17.16135),
    bending=(
        4.59193373, 4.44735598, 4.42761615, 4.42434873, 4.42455633, 4.42464442, 4.42465,
        4.42464493, 4.42464464, 4.42460298, 4.42441646, 4.42583965, 4.43874113, 4.49851113,
        4.71030765,
    ),
    lumps=(
        (0.020678835, 0.000903119, 1.09722e-5),
        *[(0.020682882, 0.000913145, 1.09789e-5)] * 12,
        (0.025447968, -0.000811097, 1.45515e-5),
        (0.037055893, 0.004875715, 1.22188e-4),
    ),
    frequencies=(4.222246, 28.389015, 41.465523, 82.521586),
)  # fmt: skip
PAZY_WITH_SKIN = PublishedWing(
    case="Pazy wing with skin, undeformed",
    source=Source(
        "published",
        "Riso and Cesnik (UM-A2SRL/AePW3-LDWG): beam of 2022, about 44 % of the chord, frequencies "
        "and flutter of 2023 by strip loads, without tip mass; chord 0.0989 m and density 1.225 "
        "kg/m3 of the built-up model beside it",
    ),
    length=0.549843728,
    chord=0.0989,
    nodes=(*(0.06956522 * number for number in range(14)), 0.96521732, 1.0),
    torsion=(
        *[7.58259714] * 4, *[6.51183018] * 4, *[6.51583594] * 4, *[7.11892627] * 2, 17.3730728
    ),
    bending=(
        5.24743501, 4.50448461, 4.47822861, 4.47438433, 4.47481272, 4.47492882, 4.47492903,
        4.47492905, 4.47492889, 4.47488638, 4.47471764, 4.47618354, 4.48916524, 4.54819972,
        4.77037999,
    ),
    lumps=(
        (0.020678814, 0.000903114, 1.09721e-5),
        *[(0.020682860, 0.000913140, 1.09789e-5)] * 12,
        (0.025447952, -0.000811101, 1.45515e-5),
        (0.043155893, 0.005092725, 1.22200e-4),
    ),
    frequencies=(4.190634, 28.493241, 41.878928, 83.064586),
)  # fmt: skip


@cache
def _matrices(with_skin: bool) -> ModalMatrices:
    wing = (PAZY_WITH_SKIN if with_skin else _WITHOUT_SKIN).beam
    modes = modes_of_kinds(wing, "beam", (1, 80, 1), (5, 3), 4)
    return modal_matrices(wing, modes, 5, 3)


def _frequency(with_skin: bool, number: int) -> float:
    return float(_matrices(with_skin).natural_frequencies[number] / 2 / np.pi)


@cache
def _flutter() -> FlutterOnset:
    return beam_flutter(_matrices(with_skin=True), PAZY_WITH_SKIN.chord, _AXIS, _AIR)


def pazy_values() -> list[KnownValue]:
    """Known natural frequencies and flutter of the Pazy wing."""
    names = ("bending 1", "bending 2", "torsion 1", "bending 3")
    frequencies = [
        KnownValue(
            wing.case,
            name,
            "Hz",
            value,
            wing.source,
            partial(_frequency, wing is PAZY_WITH_SKIN, number),
            0.01,
            _ONE_STIFFNESS,
        )
        for wing in (_WITHOUT_SKIN, PAZY_WITH_SKIN)
        for number, (name, value) in enumerate(zip(names, wing.frequencies, strict=True))
    ]
    # Zero of the damping between the published speeds of 83 and 84 m/s, by a straight line.
    part = 2.33440785 / (2.33440785 + 1.45029852)
    known = (
        ("flutter", "m/s", 83.0 + part, lambda: _flutter().speed),
        ("flutter", "Hz", 17.8735673 - part * (17.8735673 - 17.6322338), _of_omega),
    )
    return [
        *frequencies,
        *(
            KnownValue(
                PAZY_WITH_SKIN.case,
                name,
                unit,
                value,
                PAZY_WITH_SKIN.source,
                compute,
                0.03,
                _ONE_STIFFNESS,
            )
            for name, unit, value, compute in known
        ),
    ]


def _of_omega() -> float:
    return _flutter().omega / 2 / np.pi
