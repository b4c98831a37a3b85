"""Flutter of a beam on its modes by linear strip theory, and what its section makes of it.

Each strip carries Theodorsen's loads Q(omega) of a thin plate about the elastic axis, in free air
and without an induced incidence. With (w/c, theta) = sum of shapes h_i times q_i, the first n_w of
them deflections, the generalised loads are

    Q_ij = Q_ab(omega) int h_i h_j dz/L,    a, b = w or theta, the kinds of i and j,

with which :func:`equisection.motion.linear_flutter.neutral_oscillation` finds the onset exactly:
neither p-k nor a state model is between. It is the first speed that the modes of the beam flutter
at, and the measure of its section: with one mode of each kind beam and section differ by the
likeness of both shapes alone, which the section takes for 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.motion.linear_flutter import (
    FlutterEquations,
    Neutral,
    flutter,
    neutral_oscillation,
)
from equisection.structure.modal_matrices import ModalMatrices

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class FlutterOnset:
    """Speed (m/s) and angular frequency (rad/s) of flutter; NaN where there is none."""

    speed: float
    omega: float


def section_flutter(section: Section, density: float) -> FlutterOnset:
    """Flutter of a section (SI) in a fluid of a density (kg/m^3).

    That of :func:`equisection.motion.linear_flutter.flutter`, as a speed.
    """
    speed = _reference_speed(section.torsional_stiffness, section.chord, density)
    return _onset(flutter(section.in_flow(density, speed)), speed, section.chord)


def beam_flutter(
    matrices: ModalMatrices, chord: float, elastic_axis: float, density: float
) -> FlutterOnset:
    """Flutter of a beam on its modes.

    Parameters
    ----------
    matrices
        Modes of the beam (SI).
    chord
        Chord c (m).
    elastic_axis
        Place of the elastic axis (x/c from the leading edge).
    density
        Density of the fluid rho (kg/m^3).
    """
    first = matrices.bending
    stiffness = matrices.stiffness[first, first] / matrices.likeness[first, first]
    speed = _reference_speed(stiffness, chord, density)
    pressure = 0.5 * density * speed**2
    kinds = np.repeat([0, 1], [first, len(matrices.mass) - first])
    # Rows over force and moment, columns by chords and radians; rates by V/c.
    size = chord ** kinds.astype(float)
    units = pressure * np.outer(size, size)
    rate = speed / chord
    air = ThinAirfoil(elastic_axis - 0.5)

    def influence(omega: float) -> NDArray[np.complex128]:
        by_kind = air.influence(omega)[np.ix_(kinds, kinds)]
        return np.asarray(by_kind * matrices.likeness, dtype=np.complex128)

    equations = FlutterEquations(
        mass=matrices.mass * rate**2 / units,
        damping=matrices.damping * rate / units,
        stiffness=matrices.stiffness / units,
        influence=influence,
    )
    return _onset(neutral_oscillation(equations), speed, chord)


def _reference_speed(torsional_stiffness: float, chord: float, density: float) -> float:
    """Return the speed (m/s) at which k* is 1."""
    return math.sqrt(2.0 * torsional_stiffness / density) / chord


def _onset(found: Neutral | None, reference_speed: float, chord: float) -> FlutterOnset:
    if found is None:
        return FlutterOnset(math.nan, math.nan)
    speed = reference_speed / math.sqrt(found.scale)
    return FlutterOnset(speed, found.omega * speed / chord)
