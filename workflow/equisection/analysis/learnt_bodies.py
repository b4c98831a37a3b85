"""Sections and beams that a learnt model moves, as the map of stability has them.

States are ordered as those of a body on strips (:class:`equisection.motion.strip_system.
StateLayout`): torsion, its rates, bending, its rates, and the lags of the strips.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.beams import BeamParameters
from equisection.motion.learnt_beams import LearntBeams
from equisection.motion.learnt_motion import LearntSections
from equisection.motion.mechanism import InfluenceOf
from equisection.motion.sections import section_system
from equisection.motion.strip_system import StripSystem, assemble

Floats = NDArray[np.float64]

#: States (theta, theta', w, w', x) among (w, theta, w', theta', x).
_OF_SECTION = [1, 3, 0, 2, 4]


class LearntBodies(Protocol):
    """N sections or beams in their flow, with n states."""

    @property
    def size(self) -> int:
        """Number n of states."""
        ...

    @property
    def places(self) -> Floats:
        """Middles z/L of the strips, shape (S,)."""
        ...

    @property
    def slowest(self) -> float:
        """Lowest frequency omega c/V in vacuum of the first of them."""
        ...

    @property
    def pitch(self) -> float:
        """Frequency omega c/V in vacuum of the first torsion of the first of them."""
        ...

    def at_rest(self, loads: Any) -> tuple[Floats, Floats]:
        """Return states of equilibrium (N, n) and matrices of small motions (N, n, n) about them.

        They are NaN where there is no equilibrium on the branch from rest.
        """
        ...

    def influence(self, loads: Any, states: Floats) -> InfluenceOf:
        """Return the loads of small motions about states of equilibrium."""
        ...

    def attached(self, loads: Any) -> StripSystem:
        """Return their motion in flow that stays attached, with the polar's slopes at no lift."""
        ...

    def tip(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the tip in states (N, n), shape (N,)."""
        ...

    def along_span(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the strips in states, shape (N, S)."""
        ...


@dataclass(frozen=True)
class LearntSectionBodies:
    """Sections in their flow."""

    sections: tuple[Section, ...]

    @property
    def size(self) -> int:
        """Number n of states."""
        return len(_OF_SECTION)

    @property
    def places(self) -> Floats:
        """Middle z/L of the only strip, shape (1,)."""
        return np.array([0.5])

    @property
    def slowest(self) -> float:
        """Lowest frequency omega c/V in vacuum of the first of them."""
        return 2.0 * np.pi * min(self.sections[0].uncoupled_frequencies)

    @property
    def pitch(self) -> float:
        """Frequency omega c/V in vacuum of the torsion of the first of them."""
        return 2.0 * np.pi * self.sections[0].uncoupled_frequencies[0]

    def at_rest(self, loads: LearntLoads) -> tuple[Floats, Floats]:
        """Return states of equilibrium (N, 5), and matrices of small motions (N, 5, 5)."""
        moved = LearntSections(self.sections, loads)
        linear = moved.linearised()[:, _OF_SECTION][:, :, _OF_SECTION]
        twist, deflection = moved.equilibria()
        none = np.zeros_like(twist)
        return np.stack([twist, none, deflection, none, twist], axis=1), linear

    def influence(self, loads: LearntLoads, states: Floats) -> InfluenceOf:
        """Return the loads of small motions about states of equilibrium."""
        return LearntSections(self.sections, loads).influence(states[:, 0])

    def attached(self, loads: LearntLoads) -> StripSystem:
        """Return their motion in flow that stays attached, with the polar's slopes at no lift."""
        straight = UnsteadyLoads.from_polar(loads.polar)
        return section_system(list(self.sections), straight, loads.incidence_rad)

    def tip(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the tip in states (N, 5), shape (N,)."""
        twist, deflection = np.array(
            [(one.twist_recovery, one.deflection_recovery) for one in self.sections]
        ).T
        return states[:, 0] / twist, states[:, 2] / deflection

    def along_span(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the tip, which stands for the span."""
        twist, deflection = self.tip(states)
        return twist[:, None], deflection[:, None]


@dataclass(frozen=True)
class LearntBeamBodies:
    """Beams of a few modes on strips in their flow."""

    parameters: BeamParameters

    @property
    def size(self) -> int:
        """Number n of states."""
        return int(self._order.size)

    @property
    def places(self) -> Floats:
        """Middles z/L of the strips, shape (S,)."""
        return self.parameters.structure.middles

    @property
    def slowest(self) -> float:
        """Lowest frequency omega c/V in vacuum of the first of them."""
        return min(float(one[0].min()) for one in self.parameters.structure.natural_frequencies)

    @property
    def pitch(self) -> float:
        """Frequency omega c/V in vacuum of the first torsion of the first of them."""
        torsion, _ = self.parameters.structure.natural_frequencies
        return float(torsion[0, 0])

    @property
    def _modes(self) -> tuple[int, int]:
        """Numbers of torsion and of bending modes."""
        structure = self.parameters.structure
        return structure.torsion_shapes.shape[1], structure.bending_shapes.shape[1]

    @cached_property
    def _order(self) -> NDArray[np.intp]:
        """Places of (Theta, Theta', W, W', x) among (Theta, W, Theta', W', x)."""
        torsion, bending = self._modes
        modes = torsion + bending
        theta, w = np.arange(torsion), torsion + np.arange(bending)
        lags = 2 * modes + np.arange(self.parameters.structure.strips)
        return np.concatenate([theta, modes + theta, w, modes + w, lags])

    def at_rest(self, loads: LearntStrips) -> tuple[Floats, Floats]:
        """Return states of equilibrium (N, n), and matrices of small motions (N, n, n)."""
        moved = LearntBeams(self.parameters, loads)
        rest = moved.equilibria()
        torsion, _ = self._modes
        theta, w = rest[:, :torsion], rest[:, torsion:]
        lags = theta @ self.parameters.structure.torsion_shapes.T
        states = np.concatenate([theta, 0.0 * theta, w, 0.0 * w, lags], axis=1)
        return states, moved.linearised(rest)[:, self._order][:, :, self._order]

    def influence(self, loads: LearntStrips, states: Floats) -> InfluenceOf:
        """Return the loads of small motions about states of equilibrium."""
        rest = np.concatenate(self._on_modes(states), axis=1)
        return LearntBeams(self.parameters, loads).influence(rest)

    def attached(self, loads: LearntStrips) -> StripSystem:
        """Return their motion in flow that stays attached, with the polar's slopes at no lift.

        All strips have the mean of the loads along the span, with the finite span in its slopes.
        """
        polars, weights = loads.polars, self.parameters.structure.weights
        drag = np.zeros_like(polars.incidence) if polars.drag is None else polars.drag
        mean = Polar(
            polars.incidence, drag, polars.lift @ weights, polars.moment @ weights, polars.label
        )
        straight = UnsteadyLoads.from_polar(mean)
        return assemble(self.parameters.structure, straight, loads.incidence_rad)

    def tip(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the tip in states (N, n), shape (N,)."""
        theta, w = self._on_modes(states)
        return theta @ self.parameters.torsion_at_tip, w @ self.parameters.bending_at_tip

    def along_span(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return twist (rad) and deflection (chords) of the strips in states, shape (N, S)."""
        structure = self.parameters.structure
        theta, w = self._on_modes(states)
        return theta @ structure.torsion_shapes.T, w @ structure.bending_shapes.T

    def _on_modes(self, states: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        torsion, bending = self._modes
        return states[:, :torsion], states[:, 2 * torsion : 2 * torsion + bending]
