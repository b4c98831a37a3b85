"""Equivalent properties and correction factors (Fig. 1): the beam as one section."""

from equisection.reduction.integrals import Integrals, span_integrals
from equisection.reduction.section import (
    REDUCTIONS,
    EquivalentSection,
    reduce_beam,
    validity_warnings,
)

__all__ = [
    "REDUCTIONS",
    "EquivalentSection",
    "Integrals",
    "reduce_beam",
    "span_integrals",
    "validity_warnings",
]
