"""Sections of the configuration: one model each; the defaults are one plate in one channel.

The description of each key has its unit; a name without a unit suffix is SI.
"""

from equisection.beam.beam import (
    BY_SUPPORTS,
    FREE_TIP,
    MID_CHORD,
    Beam,
    Boundary,
    CrossSection,
    Damping,
)
from equisection.beam.supports import Lump, Support
from equisection.config.groups.derivative_keys import DerivativeKeys
from equisection.config.groups.embedded_keys import FLAT_PLATE, Embedded, Separation
from equisection.config.groups.flow import Channel, Flow
from equisection.config.groups.forced_keys import ForcedKeys
from equisection.config.groups.given_keys import Given
from equisection.config.groups.openfoam_keys import OpenFoam
from equisection.config.groups.rom_keys import Rom
from equisection.config.groups.solver_keys import SolverKeys
from equisection.config.groups.steady import Steady
from equisection.config.groups.structure import Elements, Structure
from equisection.config.groups.sweep import ModelName, Range, Sweep
from equisection.config.groups.uncertainty_keys import Uncertainty
from equisection.config.groups.unsteady import StartKeys, Unsteady, VerdictKeys
from equisection.keys.group import KeyGroup

__all__ = [
    "BY_SUPPORTS",
    "FLAT_PLATE",
    "FREE_TIP",
    "MID_CHORD",
    "Beam",
    "Boundary",
    "Channel",
    "CrossSection",
    "Damping",
    "DerivativeKeys",
    "Elements",
    "Embedded",
    "Flow",
    "ForcedKeys",
    "Given",
    "KeyGroup",
    "Lump",
    "ModelName",
    "OpenFoam",
    "Range",
    "Rom",
    "Separation",
    "SolverKeys",
    "StartKeys",
    "Steady",
    "Structure",
    "Support",
    "Sweep",
    "Uncertainty",
    "Unsteady",
    "VerdictKeys",
]
