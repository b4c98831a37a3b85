r"""A section or a beam in a flow of any speed: its equations of motion from those at one speed.

In units of rho/2, V and c the same body at another speed has stiffnesses that go with 1/V^2 and
dampings that go with 1/V; mass, inertia and imbalance stay
(:meth:`equisection.beam.section.Section.in_flow`). So a body is held as one lane of strips at a
speed of reference, and any number of speeds and incidences are lanes of one system
(:mod:`equisection.motion.strip_system`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.beams import BeamParameters
from equisection.motion.sections import section_system
from equisection.motion.strip_system import StripStructure, StripSystem, assemble

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SpanCorrection:
    """Loads of a finite beam in the place of those of its section (Eqs. 19, 20).

    Attributes
    ----------
    polar
        C_L, C_M and C_D of the rigid beam.
    load_factors
        C_L/c_l and C_M/c_m at incidences alpha (rad) of shape (N,), shape (N, 2); NaN where there
        are none.
    """

    polar: Polar
    load_factors: Callable[[Floats], Floats]


@dataclass(frozen=True)
class BodyInFlow:
    """A section or beam, and the air that it is in.

    Attributes
    ----------
    structure
        One lane of strips at the speed of reference.
    loads
        Unsteady loads of the section's polar.
    speed
        Speed of reference (m/s).
    chord
        c (m).
    k_star
        k* (-) at the speed of reference.
    twist_of_tip, deflection_of_tip
        Twist of the tip (rad) for each Theta_i, and its deflection (chords) for each W_j, shape
        (n_t,) and (n_b,).
    correction
        Correction of a section for the finite span; None without.
    """

    structure: StripStructure
    loads: UnsteadyLoads
    speed: float
    chord: float
    k_star: float
    twist_of_tip: Floats
    deflection_of_tip: Floats
    correction: SpanCorrection | None = None

    @classmethod
    def of_section(
        cls,
        section: Section,
        loads: UnsteadyLoads,
        density: float,
        correction: SpanCorrection | None = None,
    ) -> BodyInFlow:
        """Return a section (SI) in a fluid of a density (kg/m^3)."""
        speed = section.k_star(density, 1.0) ** 0.5  # k* is 1 there
        flowing = section.in_flow(density, speed)
        return cls.of_section_in_flow(
            flowing, loads, speed=speed, chord=section.chord, k_star=1.0, correction=correction
        )

    @classmethod
    def of_section_in_flow(
        cls,
        section: Section,
        loads: UnsteadyLoads,
        *,
        speed: float,
        chord: float,
        k_star: float,
        correction: SpanCorrection | None = None,
    ) -> BodyInFlow:
        """Return a section in a flow of a speed (m/s), at which it is said to have a k* (-).

        Raises
        ------
        EquisectionError
            The section is in SI units.
        """
        system = section_system([section], loads, 0.0)
        return cls(
            system.structure,
            loads,
            speed,
            chord,
            k_star,
            np.array([1.0 / section.twist_recovery]),
            np.array([1.0 / section.deflection_recovery]),
            correction,
        )

    @classmethod
    def of_beam(
        cls,
        parameters: BeamParameters,
        loads: UnsteadyLoads,
        *,
        speed: float,
        chord: float,
        k_star: float,
    ) -> BodyInFlow:
        """Return a beam, the only lane of its parameters, which are those at a speed (m/s)."""
        return cls(
            parameters.structure,
            loads,
            speed,
            chord,
            k_star,
            parameters.torsion_at_tip,
            parameters.bending_at_tip,
        )

    @property
    def is_section(self) -> bool:
        """Presence of one strip with one mode of each kind, whose equilibria have a closed form."""
        of_modes = self.structure.torsion_shapes.shape[1] + self.structure.bending_shapes.shape[1]
        return self.structure.strips == 1 and of_modes == 2

    @property
    def slowest(self) -> float:
        """Lowest angular frequency in vacuum (rad/s) of its modes without imbalance."""
        slowest = min(float(one.min()) for one in self.structure.natural_frequencies)
        return slowest * self.speed / self.chord

    @property
    def pitch_frequency(self) -> float:
        """Frequency (Hz) of the first torsion mode in vacuum, without imbalance."""
        torsion, _ = self.structure.natural_frequencies
        return float(torsion[0, 0]) * self.speed / (math.tau * self.chord)

    @property
    def bending_frequencies(self) -> Floats:
        """Frequencies (Hz) of the bending modes in vacuum, without imbalance, ascending."""
        _, bending = self.structure.natural_frequencies
        return np.asarray(bending[0] * self.speed / (math.tau * self.chord))

    def tip(self, states: NDArray[Any]) -> tuple[Any, Any]:
        """Return twist (rad) and deflection (chords) of the tip in states Y of shape (..., n)."""
        torsion, bending = self.twist_of_tip.size, self.deflection_of_tip.size
        first = 2 * torsion
        return (
            states[..., :torsion] @ self.twist_of_tip,
            states[..., first : first + bending] @ self.deflection_of_tip,
        )

    def k_star_at(self, speeds: Floats) -> Floats:
        """Return k* (-) at speeds (m/s)."""
        return np.asarray(self.k_star * (self.speed / speeds) ** 2)

    def system(
        self, speeds: Floats, incidence_rad: Floats, load_factors: Floats | None = None
    ) -> StripSystem:
        """Return the system of N lanes, each with its speed (m/s) and theta_0 (rad), shape (N,).

        ``load_factors`` are C_L/c_l and C_M/c_m of each, shape (N, 2); None for those of the
        structure.
        """
        one = self.structure
        slower = (self.speed / np.asarray(speeds))[:, None]
        lanes = slower.shape[0]

        def each(values: Floats) -> Floats:
            return np.broadcast_to(values, (lanes, *values.shape[1:]))

        factors = (one.lift_factor, one.moment_factor)
        if load_factors is not None:
            factors = (load_factors[:, 0], load_factors[:, 1])
        structure = replace(
            one,
            torsion_inertia=each(one.torsion_inertia),
            torsion_stiffness=one.torsion_stiffness * slower**2,
            bending_mass=each(one.bending_mass),
            bending_stiffness=one.bending_stiffness * slower**2,
            imbalance=each(one.imbalance),
            torsion_damping=one.torsion_damping * slower[:, :, None],
            bending_damping=one.bending_damping * slower[:, :, None],
            axis=each(one.axis),
            lift_factor=each(factors[0]),
            moment_factor=each(factors[1]),
        )
        return assemble(structure, self.loads, np.broadcast_to(incidence_rad, (lanes,)))
