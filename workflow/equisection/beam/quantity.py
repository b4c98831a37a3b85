"""Quantities of a section: unit, meaning, and the number that each becomes in a flow."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """Unit and meaning of a member of a section, and its number in a flow.

    Attributes
    ----------
    units
        SI unit, as results have it.
    meaning
        Meaning in words, with the symbol.
    flow_name, flow_meaning
        Name and formula of its number in a flow; empty of one that is the same there.
    speeds, chords
        Powers of V and c in the unit of that number, (rho/2) V^speeds c^chords.
    stiffness
        Power with which it grows with the stiffness of the beam.
    """

    units: str
    meaning: str
    flow_name: str = ""
    flow_meaning: str = ""
    speeds: int = 0
    chords: int = 0
    stiffness: float = 0.0
