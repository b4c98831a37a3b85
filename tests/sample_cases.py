"""The paper's plate, and a steady and an unsteady case to start from."""

import math

import numpy as np
from numpy.typing import ArrayLike

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.cases import (
    BeamModes,
    EndCriteria,
    Geometry,
    Medium,
    SolverBlock,
    SteadyCase,
    UnsteadyCase,
)
from equisection.structure.analytic import bending_modes, torsion_modes
from equisection.structure.span import normalise

#: Section 2 of the paper.
PAPER = Beam(
    chord=0.1,
    length=0.37,
    thickness=0.004,
    youngs_modulus=3.3e9,
    poisson_ratio=0.35,
    density=1180.0,
)
GEOMETRY = Geometry(
    chord=0.1,
    span=3.7,
    thickness=0.04,
    root_on_wall=True,
    channel_height=4.0,
    tip_gap=0.3,
    upstream=5.0,
    downstream=15.0,
)
MEDIUM = Medium(speed=20.0, density=1.18, dynamic_viscosity=1.86e-5)
SOLVER = SolverBlock(name="embedded", version="1", settings={"strips": 8, "polar": [0.0, 0.5]})
STEADY = SteadyCase(
    dimension="2d",
    incidence_deg=2.5,
    resolution="coarse",
    geometry=GEOMETRY,
    medium=MEDIUM,
    solver=SOLVER,
)
UNSTEADY = UnsteadyCase(
    dimension="2d",
    k_star=6.44,
    incidence_deg=2.5,
    resolution="coarse",
    geometry=GEOMETRY,
    medium=MEDIUM,
    section=Section(
        torsional_stiffness=6.44,
        flexural_stiffness=0.9,
        inertia=6.7,
        mass=80.0,
        twist_recovery=0.6,
        deflection_recovery=0.4,
    ),
    duration=400.0,
    time_step=0.05,
    output_interval=0.1,
    criteria=EndCriteria(
        settled_amplitude_deg=0.05, growing_amplitude_deg=6.0, steadiness=0.02, periods=5
    ),
    solver=SOLVER,
)


def altered(beam: Beam, **changes: object) -> Beam:
    """Return a beam with other members, checked as it was."""
    return Beam(**{**dict(beam), **changes})


def beam_with(boundary: str) -> Beam:
    """Return the paper's plate held otherwise; on springs where a boundary has them."""
    springs = {"root_torsional_stiffness": 7.0, "root_bending_stiffness": 5.0}
    return altered(PAPER, boundary=boundary, **(springs if boundary == "spring-root" else {}))


def beam_modes(stiffness: float = 1.0, mass: float = 1.0, modes: int = 2) -> BeamModes:
    """Return the paper's plate in closed form (k* = 19.9 for stiffness 1) at 20 m/s."""
    beam, span = PAPER, np.linspace(0.0, 1.0, 101)
    to_reduced = 2 * math.pi * 0.1 / 20.0 * math.sqrt(stiffness / mass)
    bending, bending_shape = bending_modes(beam, span, modes)
    torsion, torsion_shape = torsion_modes(beam, span, modes)
    return BeamModes(
        span=tuple(span),
        bending_frequency=tuple(to_reduced * bending),
        bending_shape=tuple(map(tuple, normalise(bending_shape))),
        torsion_frequency=tuple(to_reduced * torsion),
        torsion_shape=tuple(map(tuple, normalise(torsion_shape))),
        inertia=mass * beam.inertia_per_length / (0.5 * 1.18 * 0.1**4),
        mass=mass * beam.mass_per_length / (0.5 * 1.18 * 0.1**2),
    )


def sections(
    k_star: ArrayLike, inertia: ArrayLike, mass_ratio: float, stiffness_ratio: float
) -> list[Section]:
    """Return sections in a flow from k*, I*, c^2 m/I and c^2 k_w/k_theta."""
    pairs = np.broadcast_arrays(np.atleast_1d(k_star), np.atleast_1d(inertia))
    return [
        Section(
            torsional_stiffness=k,
            flexural_stiffness=k * stiffness_ratio,
            inertia=i,
            mass=i * mass_ratio,
        )
        for k, i in np.stack(pairs, axis=-1).tolist()
    ]


STEADY_PLATE = STEADY.model_copy(update={"dimension": "3d"})
UNSTEADY_PLATE = UNSTEADY.model_copy(
    update={
        "dimension": "3d",
        "section": None,
        "beam": beam_modes(6.44 / 19.91),
        "time_step": 0.02,
        "output_interval": 0.1,
    }
)
