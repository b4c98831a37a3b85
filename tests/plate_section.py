"""The paper's plate as a section in closed form, with its polar, and what maps are compared by."""

import math
from pathlib import Path

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.beam.section import Section

POLAR = Polar.read(Path(__file__).parents[1] / "config/polars/plate_2d_11136.csv")
THIN = Polar.flat_plate(10.0)
ATTACHED = SeparationLags.none()
#: Lags of an independent assembly, which lags all lift; so does the model beyond 2 deg.
ASSEMBLED = SeparationLags(2.58, 0.64, 0.55)
DENSITY = 1.18

#: The paper's plate, its consistent section in closed form: a clamped-free beam of GJ, EI.
CHORD, LENGTH, THICKNESS, E, NU, SOLID = 0.1, 0.37, 0.004, 3.3e9, 0.35, 1180.0
PLATE = Section(
    torsional_stiffness=E / (2 + 2 * NU) * CHORD * THICKNESS**3 / 3 * (math.pi / 2 / LENGTH) ** 2,
    flexural_stiffness=E * CHORD * THICKNESS**3 / 12 * (1.8751040687 / LENGTH) ** 4,
    inertia=SOLID * CHORD**3 * THICKNESS / 12,
    mass=SOLID * CHORD * THICKNESS,
    chord=CHORD,
)


def damped(section: Section, ratio: float) -> Section:
    """Return the section with the same part of critical damping in twist and in deflection."""
    k_theta, k_w = section.torsional_stiffness, section.flexural_stiffness
    return section.model_copy(
        update={
            "torsional_damping": 2 * ratio * math.sqrt(k_theta * section.inertia),
            "flexural_damping": 2 * ratio * math.sqrt(k_w * section.mass),
        }
    )


def speed_of(section: Section, k_star: float, density: float = DENSITY) -> float:
    """Return the speed (m/s) at which a section has a k*."""
    return math.sqrt(section.k_star(density, 1.0) / k_star)
