"""What decides a result, and nothing else, as a small canonical file with a hash."""

from equisection.cases.case import (
    BeamModes,
    Case,
    EndCriteria,
    Geometry,
    Medium,
    SolverBlock,
    SteadyCase,
    UnsteadyCase,
)
from equisection.cases.case_file import (
    ENDS,
    are_alike,
    canonical,
    case_hash,
    history_hash,
    read_cases,
    write_cases,
)

__all__ = [
    "ENDS",
    "BeamModes",
    "Case",
    "EndCriteria",
    "Geometry",
    "Medium",
    "SolverBlock",
    "SteadyCase",
    "UnsteadyCase",
    "are_alike",
    "canonical",
    "case_hash",
    "history_hash",
    "read_cases",
    "write_cases",
]
