"""Induction and apparent mass of a finite beam: what its strips do to each other."""

from __future__ import annotations

from dataclasses import dataclass

from equisection.aerodynamics.apparent_mass import ApparentMass, apparent_mass
from equisection.aerodynamics.unsteady_induction import InductionStates, induction_states
from equisection.aerodynamics.vortex_rings import SpanGeometry


@dataclass(frozen=True, eq=False)
class FiniteSpan:
    """Induction and apparent mass of the strips of a beam on each other.

    Attributes
    ----------
    states
        States of the induced incidence (:mod:`equisection.aerodynamics.unsteady_induction`).
    apparent
        Apparent mass (:mod:`equisection.aerodynamics.apparent_mass`).
    """

    states: InductionStates
    apparent: ApparentMass

    @classmethod
    def of(cls, geometry: SpanGeometry) -> FiniteSpan:
        """Find both; a second call with the same geometry costs nothing."""
        return cls(induction_states(geometry), apparent_mass(geometry))
