"""Cases: all that decides a result, and nothing else, as a small canonical file with a hash."""

from equisection.cases.case import (
    BeamModes,
    Case,
    EndCriteria,
    FittedModes,
    Geometry,
    Medium,
    SolverBlock,
    Start,
)
from equisection.cases.case_file import (
    are_alike,
    canonical,
    case_hash,
    history_hash,
    read_cases,
    write_cases,
)
from equisection.cases.kinds import (
    FREE,
    KINDS,
    STEADY,
    Kind,
    SteadyCase,
    UnsteadyCase,
    kind_of,
    point_of,
)

__all__ = [
    "FREE",
    "KINDS",
    "STEADY",
    "BeamModes",
    "Case",
    "EndCriteria",
    "FittedModes",
    "Geometry",
    "Kind",
    "Medium",
    "SolverBlock",
    "Start",
    "SteadyCase",
    "UnsteadyCase",
    "are_alike",
    "canonical",
    "case_hash",
    "history_hash",
    "kind_of",
    "point_of",
    "read_cases",
    "write_cases",
]
