"""Sections of the configuration: one model each, every default the paper's case.

Units stand in the description of each key; a name without a unit suffix is SI.
"""

from equisection.config.sections.base import Section
from equisection.config.sections.beam import FREE_TIP, Beam, Boundary, CrossSection
from equisection.config.sections.embedded import FLAT_PLATE, Embedded, Separation
from equisection.config.sections.flow import Channel, Flow
from equisection.config.sections.openfoam import OpenFoam
from equisection.config.sections.steady import Steady
from equisection.config.sections.structure import Elements, Structure
from equisection.config.sections.sweep import ModelName, Range, Sweep
from equisection.config.sections.unsteady import Unsteady, Verdict

__all__ = [
    "FLAT_PLATE",
    "FREE_TIP",
    "Beam",
    "Boundary",
    "Channel",
    "CrossSection",
    "Elements",
    "Embedded",
    "Flow",
    "ModelName",
    "OpenFoam",
    "Range",
    "Section",
    "Separation",
    "Steady",
    "Structure",
    "Sweep",
    "Unsteady",
    "Verdict",
]
