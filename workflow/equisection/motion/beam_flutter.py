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
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.motion.exact_roots import GrowingMotion, growth_and_frequency_of
from equisection.motion.linear_flutter import (
    FlutterEquations,
    Neutral,
    flutter,
    neutral_oscillation,
)
from equisection.structure.modal_matrices import ModalMatrices

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]


@dataclass(frozen=True)
class FlutterOnset:
    """Speed (m/s) and angular frequency (rad/s) of flutter; NaN where there is none."""

    speed: float
    omega: float


def section_flutter(section: Section, density: float) -> FlutterOnset:
    """Flutter of a section (SI) in a fluid of a density (kg/m^3).

    That of :func:`equisection.motion.linear_flutter.flutter`, as a speed.
    """
    speed = reference_speed(section.torsional_stiffness, section.chord, density)
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
    flow = BeamInFlow(matrices, chord, elastic_axis, density)
    return _onset(neutral_oscillation(flow.equations), flow.speed, chord)


def beam_growth(
    matrices: ModalMatrices,
    chord: float,
    elastic_axis: float,
    density: float,
    speeds: Floats,
) -> Complexes:
    """Exact growth and frequency of a beam on its modes (1/s, rad/s), shape (n, m).

    The m motions at each speed, each followed from still air
    (:mod:`equisection.motion.exact_roots`); NaN where one has ceased to turn.

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
    speeds
        Speeds V > 0 (m/s), shape (n,), in any order.
    """
    flow = BeamInFlow(matrices, chord, elastic_axis, density)
    roots = growth_and_frequency_of(flow.motion, flow.in_still_air, (flow.speed / speeds) ** 2)
    return np.asarray(roots * speeds[:, None] / chord)


class BeamInFlow:
    """A beam on its modes at the speed at which k* is 1: matrices in units of rho/2, V and c."""

    def __init__(
        self, matrices: ModalMatrices, chord: float, elastic_axis: float, density: float
    ) -> None:
        self.chord = chord
        first = matrices.bending
        stiffness = matrices.stiffness[first, first] / matrices.likeness[first, first]
        self.speed = reference_speed(stiffness, chord, density)
        pressure = 0.5 * density * self.speed**2
        kinds = np.repeat([0, 1], [first, len(matrices.mass) - first])
        # Rows over force and moment, columns by chords and radians; rates by V/c.
        size = chord ** kinds.astype(float)
        units = pressure * np.outer(size, size)
        rate = self.speed / chord
        self.mass = matrices.mass * rate**2 / units
        self.damping = matrices.damping * rate / units
        self.stiffness = matrices.stiffness / units
        self.air = ThinAirfoil(elastic_axis - 0.5)
        self.likeness = matrices.likeness
        self.kinds = kinds

    def _on_modes(self, by_kind: Floats | Complexes) -> Complexes:
        return np.asarray(
            by_kind[np.ix_(self.kinds, self.kinds)] * self.likeness, dtype=np.complex128
        )

    @property
    def equations(self) -> FlutterEquations:
        """Equations of neutral oscillations of thin strips."""
        return self.equations_with(self.air.influence)

    def equations_with(self, influence: Callable[[float], Complexes]) -> FlutterEquations:
        """Return the equations of neutral oscillations of strips with some loads.

        Parameters
        ----------
        influence
            Q of a strip about the elastic axis at a frequency omega c/V, shape (2, 2).
        """
        return FlutterEquations(
            self.mass,
            self.damping,
            self.stiffness,
            lambda omega: self._on_modes(influence(omega)),
        )

    @property
    def motion(self) -> GrowingMotion:
        """Equations of motions that grow or decay."""
        return GrowingMotion(
            self.mass,
            self.damping,
            self.stiffness,
            lambda p: self._on_modes(self.air.influence_of_growing(p)),
            lambda p: self._on_modes(self.air.influence_slope(p)),
        )

    @property
    def in_still_air(self) -> Floats:
        """Frequencies (V/c) with the apparent mass of the air, rising."""
        mass = self.mass + self._on_modes(self.air.apparent_mass).real
        squares = np.linalg.eigvals(np.linalg.solve(mass, self.stiffness)).real
        return np.asarray(np.sqrt(np.sort(squares)))


def reference_speed(torsional_stiffness: float, chord: float, density: float) -> float:
    """Return the speed (m/s) at which k* is 1."""
    return math.sqrt(2.0 * torsional_stiffness / density) / chord


def _onset(found: Neutral | None, reference_speed: float, chord: float) -> FlutterOnset:
    if found is None:
        return FlutterOnset(math.nan, math.nan)
    speed = reference_speed / math.sqrt(found.scale)
    return FlutterOnset(speed, found.omega * speed / chord)
