r"""Static equilibria of a section or beam over speed: all branches, with their folds.

A section needs no iteration: each incidence alpha of equilibrium has its own speed
(:mod:`equisection.motion.static_branch`), so its branches are the pieces of the polar on which
k*(alpha) = c_m/(alpha - theta_0) is positive, between the places where dk*/dalpha = 0.

A beam is followed from rest (:mod:`equisection.motion.continuation`).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from equisection.errors import IncidenceOutOfRangeError, SolverError
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.continuation import EquilibriumCurve, continued
from equisection.motion.static_branch import (
    BranchEnd,
    StaticBranch,
    fold_function,
    section_equilibrium,
)
from equisection.motion.steady_states import equilibrium
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]

POINTS_OF_A_BRANCH = 200


class PathFromRest(Protocol):
    """Branch of equilibria that a body comes along when the speed rises slowly from zero."""

    @property
    def end(self) -> BranchEnd:
        """Kind of its end."""
        ...

    @property
    def end_speed(self) -> float:
        """Speed (m/s) at its end; infinite of a branch without one."""
        ...

    def system(self, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """Return system, states Y and deficits u of equilibrium at speeds (m/s); NaN beyond."""
        ...


@dataclass(frozen=True)
class SectionPath:
    """Branch from rest of a section, exact."""

    body: BodyInFlow
    incidence_rad: float
    branch: StaticBranch = field(init=False)

    def __post_init__(self) -> None:
        body = self.body
        polar = body.correction.polar if body.correction else body.loads.branches.polar
        axis = float(body.structure.axis[0])
        branch = StaticBranch.from_rest(polar, self.incidence_rad, axis)
        object.__setattr__(self, "branch", branch)

    @property
    def end(self) -> BranchEnd:
        """Kind of its end."""
        return self.branch.end

    @property
    def end_speed(self) -> float:
        """Speed (m/s) at its end; infinite of a branch without one."""
        lowest = self.branch.k_star_end
        return self.body.speed * math.sqrt(self._stiffness / lowest) if lowest else math.inf

    def incidences(self, speeds: Floats) -> Floats:
        """Incidence alpha (rad) of equilibrium at speeds (m/s); NaN beyond the end."""
        return self.branch.incidence(self._stiffness * (self.body.speed / speeds) ** 2)

    @property
    def _stiffness(self) -> float:
        """k* (-) of the section itself at the speed of reference."""
        return float(self.body.structure.torsion_stiffness[0, 0])

    def system(self, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """Return system, states Y and deficits u of equilibrium at speeds (m/s); NaN beyond."""
        return systems_of_sections([self], [speeds])


def systems_of_sections(
    paths: list[SectionPath], speeds: list[Floats]
) -> tuple[StripSystem, Floats, Floats]:
    """Return system, states and deficits of equilibrium of one section at many incidences.

    Parameters
    ----------
    paths
        Branches of the same section.
    speeds
        Speeds (m/s) of each, which follow each other in the lanes.
    """
    body = paths[0].body
    alpha = np.concatenate([path.incidences(v) for path, v in zip(paths, speeds, strict=True)])
    rigid = np.repeat([path.incidence_rad for path in paths], [len(v) for v in speeds])
    factors = None if body.correction is None else body.correction.load_factors(alpha)
    system = body.system(np.concatenate(speeds), rigid, factors)
    states, deficits = section_equilibrium(system, alpha)
    if factors is not None:
        states[np.isnan(factors).any(axis=1)] = np.nan
    return system, states, deficits


@dataclass(frozen=True)
class BeamPath:
    """Branch from rest of a beam, by continuation up to a highest speed (m/s)."""

    body: BodyInFlow
    incidence_rad: float
    highest: float
    curve: EquilibriumCurve = field(init=False)
    end: BranchEnd = field(init=False)

    def __post_init__(self) -> None:
        curve, left_polar = continued(self.body, self.incidence_rad, self.highest)
        end = BranchEnd.POLAR if left_polar else BranchEnd.NONE
        end = BranchEnd.FOLD if curve.folds else end
        object.__setattr__(self, "curve", curve)
        object.__setattr__(self, "end", end if curve.branches else BranchEnd.MISSING)

    @property
    def end_speed(self) -> float:
        """Speed (m/s) at its end; infinite of a branch that goes on above the highest speed."""
        if self.end is BranchEnd.NONE:
            return math.inf
        if self.end is BranchEnd.MISSING:
            return 0.0
        return float(self.curve.branches[0].speed[-1])

    def incidences_near(self, speeds: Floats) -> Floats:
        """Return incidences (rad) of the strips by straight lines along the curve, shape (N, S)."""
        first = self.curve.branches[0]
        return np.stack(
            [np.interp(speeds, first.speed, strip) for strip in first.incidence.T], axis=1
        )

    def system(self, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """Return system, states Y and deficits u of equilibrium at speeds (m/s); NaN beyond."""
        system = self.body.system(speeds, np.full(speeds.shape, self.incidence_rad))
        states, deficits = equilibrium(system, self.incidences_near(speeds))
        states[speeds >= self.end_speed] = np.nan
        return system, states, deficits


@dataclass(frozen=True)
class NoPath:
    """No branch: there is no steady flow at rest, for a reason in words."""

    reason: str
    end: BranchEnd = BranchEnd.MISSING
    end_speed: float = 0.0

    def system(self, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """Refuse, since there is nothing to linearise about.

        Raises
        ------
        SolverError
            Always.
        """
        raise SolverError(f"at {speeds} m/s: {self.reason}")


def path_from_rest(body: BodyInFlow, incidence_rad: float, highest: float) -> PathFromRest:
    """Return the branch from rest of a section or beam at theta_0 (rad).

    ``highest`` is the speed (m/s) up to which a beam is followed.

    Where the polar does not cover theta_0, or the flow about the beam at rest has no solution,
    there is none (:class:`NoPath`).
    """
    try:
        body.loads.branches.polar.require(incidence_rad)
        if body.is_section:
            return SectionPath(body, incidence_rad)
    except IncidenceOutOfRangeError as error:
        return NoPath(str(error))
    path = BeamPath(body, incidence_rad, highest)
    if path.end is not BranchEnd.MISSING:
        return path
    return NoPath(
        f"no steady flow about the beam at rest was found at {math.degrees(incidence_rad):.4g} "
        "deg: the lift falls too steeply; take fewer strips"
    )


def all_branches(body: BodyInFlow, incidence_rad: float, highest: float) -> list[EquilibriumCurve]:
    """Return every branch of static equilibria up to a speed (m/s), that from rest first.

    Of a section these are all that the polar has; of a beam those that folds join to the one
    from rest.
    """
    if not body.is_section:
        return continued(body, incidence_rad, highest)[0].branches
    polar = body.correction.polar if body.correction else body.loads.branches.polar
    cubic = polar.moment_cubic_about(float(body.structure.axis[0]))
    least, greatest = polar.incidence_range
    zeros = np.concatenate(
        [curve.roots(extrapolate=False) for curve in (cubic, fold_function(cubic, incidence_rad))]
    )
    inside = zeros[np.isfinite(zeros) & (zeros > least) & (zeros < greatest)]
    bounds = np.unique(np.concatenate([[least], inside, [greatest], [incidence_rad]]))
    found = []
    for low, high in itertools.pairwise(bounds):
        alpha = np.linspace(low, high, POINTS_OF_A_BRANCH + 2)[1:-1]
        k_star = cubic(alpha) / (alpha - incidence_rad)
        if k_star[k_star.size // 2] <= 0.0:
            continue
        own = float(body.structure.torsion_stiffness[0, 0])
        speed = body.speed * np.sqrt(own / np.maximum(k_star, 1e-300))
        near = (k_star > 0.0) & (speed <= highest)
        if near.any():
            order = np.argsort(speed[near])
            found.append(EquilibriumCurve(speed[near][order], alpha[near][order][:, None]))
    if float(cubic(incidence_rad)) == 0.0:  # it does not twist at any speed
        rest = np.array([0.0, highest])
        found.append(EquilibriumCurve(rest, np.full((2, 1), incidence_rad)))
    return sorted(found, key=lambda one: abs(float(one.incidence[0, 0]) - incidence_rad))
