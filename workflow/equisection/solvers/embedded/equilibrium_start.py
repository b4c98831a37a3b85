"""Static equilibria that releases of the embedded solver may start from.

They are those of the branch that comes from rest when the speed rises slowly: the motion is then
that of small disturbances, and none of it is spent on the way from the undeformed structure.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.errors import IncidenceOutOfRangeError
from equisection.motion.beams import BeamParameters
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.equilibrium_path import path_from_rest
from equisection.motion.sections import section_system
from equisection.motion.static_branch import StaticBranch
from equisection.motion.steady_states import equilibrium

Floats = NDArray[np.float64]

#: Speed and chord of a body whose equilibrium is wanted at the speed of its numbers alone.
_ITS_OWN = 1.0
#: Ratio of the highest speed that a branch is followed to, to that speed.
_BEYOND = 1.01


def equilibria_of_sections(
    sections: Sequence[Section],
    loads: UnsteadyLoads,
    incidence_rad: float,
    load_factors: Floats | None = None,
) -> Floats:
    """Structural states in static equilibrium of N sections in their flow, shape (N, 4).

    NaN where the branch from rest has none.

    Parameters
    ----------
    sections
        The sections (:meth:`equisection.beam.section.Section.in_flow`).
    loads
        Unsteady loads of their polar.
    incidence_rad
        Rigid incidence theta_0 (rad).
    load_factors
        Factors of c_l and c_m (:func:`equisection.motion.sections.section_system`).
    """
    factors = np.ones((len(sections), 2)) if load_factors is None else load_factors
    system = section_system(sections, loads, incidence_rad, factors)
    axis = system.structure.axis
    is_scaled = (factors != 1.0).any(axis=1) & (axis != 0.0)
    alpha = np.full(len(sections), np.nan)
    for lane, section in enumerate(sections):
        try:
            branch = StaticBranch.from_rest(loads.branches.polar, incidence_rad, float(axis[lane]))
        except IncidenceOutOfRangeError:
            continue
        alpha[lane] = branch.incidence(section.torsional_stiffness / factors[lane, 1])
    near = np.where(is_scaled, incidence_rad, alpha)  # those have no branch in closed form
    exists, states = np.isfinite(near), np.full((len(sections), system.layout.size), np.nan)
    if exists.any():
        states[exists] = equilibrium(system.of(exists), near[exists, None])[0]
    return states[:, : system.layout.structural]


def equilibria_of_beams(
    beams: Sequence[BeamParameters], loads: UnsteadyLoads, incidence_rad: float
) -> Floats:
    """Structural states in static equilibrium of N beams, shape (N, m); NaN where there is none.

    Parameters
    ----------
    beams
        One lane each.
    loads
        Unsteady loads of the section polar.
    incidence_rad
        Rigid incidence theta_0 (rad).
    """
    found = []
    for beam in beams:
        body = BodyInFlow.of_beam(beam, loads, speed=_ITS_OWN, chord=_ITS_OWN, k_star=_ITS_OWN)
        path = path_from_rest(body, incidence_rad, _BEYOND * _ITS_OWN)
        modes = beam.torsion_at_tip.size + beam.bending_at_tip.size
        if path.end_speed <= _ITS_OWN:
            found.append(np.full(2 * modes, np.nan))
            continue
        _, states, _ = path.system(np.array([_ITS_OWN]))
        found.append(states[0, : 2 * modes])
    return np.array(found)
