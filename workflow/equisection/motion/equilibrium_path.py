r"""Static equilibria of a section or beam over speed: all branches, with their folds.

A section needs no iteration: each incidence alpha of equilibrium has its own speed
(:mod:`equisection.motion.static_branch`), so its branches are the pieces of the polar on which
k*(alpha) = c_m/(alpha - theta_0) is positive, between the places where dk*/dalpha = 0.

A beam is followed from rest by pseudo-arclength continuation (Keller, *Numerical solution of
bifurcation and nonlinear eigenvalue problems*, 1977): the bubble incidences x of all strips and the
speed V are unknowns together, and with the tangent (x', V') of the curve the next point is the one
with

    x = G(V) u(x) + x_0(V),    x'.(x - x_p) + V' (V - V_p) = step,

u the deficits of the strips. Where V' changes its sign is a *fold*: at a higher speed there is no
equilibrium near, and the body diverges, while the curve goes on to lower speeds on another branch.
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
from equisection.motion.static_branch import (
    BranchEnd,
    StaticBranch,
    fold_function,
    section_equilibrium,
)
from equisection.motion.steady_states import equilibrium, rigid_state
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]

STEP, SHORTEST, LONGEST = 0.01, 1e-6, 0.03
"""First, shortest and longest step along the curve, of radians and of the highest speed."""
MOST_POINTS = 4000
NEWTON_STEPS, ARRIVED = 8, 1e-11
FOLD_HALVINGS = 40
POINTS_OF_A_BRANCH = 200


@dataclass(frozen=True)
class EquilibriumCurve:
    """Static equilibria along one branch or several that folds join.

    Attributes
    ----------
    speed
        V (m/s), shape (N,).
    incidence
        Bubble incidences of the strips (rad), shape (N, S): those of equilibrium.
    folds
        Places of the curve at which V has a maximum or minimum.
    """

    speed: Floats
    incidence: Floats
    folds: tuple[int, ...] = ()

    @property
    def branches(self) -> list[EquilibriumCurve]:
        """Its parts between folds, on each of which the speed rises or falls throughout."""
        bounds = [0, *self.folds, self.speed.size - 1]
        return [
            EquilibriumCurve(self.speed[a : b + 1], self.incidence[a : b + 1])
            for a, b in itertools.pairwise(bounds)
            if b > a
        ]


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

    def system(self, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """Return system, states Y and deficits u of equilibrium at speeds (m/s); NaN beyond."""
        first = self.curve.branches[0]
        near = np.stack(
            [np.interp(speeds, first.speed, strip) for strip in first.incidence.T], axis=1
        )
        system = self.body.system(speeds, np.full(speeds.shape, self.incidence_rad))
        states, deficits = equilibrium(system, near)
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


class _StaticMap:
    """x = G(V) u + x_0(V) of a body at rest, from its equations of motion.

    A = P + Q/V^2 holds for all columns that a body at rest has, since all rates vanish.
    """

    def __init__(self, body: BodyInFlow, incidence_rad: float) -> None:
        two = np.array([1.0, 2.0]) * body.speed
        self.system = body.system(two, np.full(2, incidence_rad)).of(np.array([True, False]))
        both = body.system(two, np.full(2, incidence_rad))
        n, strips = both.layout.size, both.layout.strips
        first, second = both.rates[:, :, :n]
        over = 1.0 / two**2
        self.by_stiffness = (first - second) / (over[0] - over[1])
        self.constant = first - over[0] * self.by_stiffness
        self.loads = both.rates[0, :, n:]
        self.probe = both.probe[0, :strips]
        self.n = n
        held, _ = rigid_state(self.system)
        self.at_rest = held[0, both.layout.lag(2)]  # where the bubble has come to rest

    def response(self, speed: float) -> tuple[Floats, Floats]:
        """Return [G | x_0] (S, d S + 1) and its derivative by V."""
        matrix = self.constant + self.by_stiffness / speed**2
        response = -np.linalg.solve(matrix, self.loads)
        change = np.linalg.solve(matrix, (2.0 / speed**3) * self.by_stiffness @ response)
        seen = self.probe[:, : self.n]
        return self.probe[:, self.n :] + seen @ response, seen @ change

    def residual(self, x: Floats, speed: float) -> tuple[Floats, Floats, Floats]:
        """Return x - G u - x_0 (S,), its derivatives by x (S, S) and by V (S,)."""
        rows, by_speed = self.response(speed)
        u = np.append(self.system.deficits(x[None])[0], 1.0)
        slopes = self.system.deficit_slopes(x[None])[0]
        return x - rows @ u, np.eye(x.size) - rows[:, :-1] @ slopes, -by_speed @ u


def continued(
    body: BodyInFlow, incidence_rad: float, highest: float
) -> tuple[EquilibriumCurve, bool]:
    """Follow the equilibria of a body from rest, through folds, up to a speed (m/s).

    Returns
    -------
    EquilibriumCurve
        The curve, which ends at the highest speed, back at the lowest, or at the end of the polar.
    bool
        Whether it has left the polar.
    """
    follower = _Follower(_StaticMap(body, incidence_rad), highest)
    return follower.curve(1e-3 * min(highest, body.slowest * body.chord))


class _Follower:
    """Pseudo-arclength continuation of the equilibria of a body."""

    def __init__(self, static: _StaticMap, highest: float) -> None:
        self.static = static
        self.scale = highest

    def curve(self, lowest: float) -> tuple[EquilibriumCurve, bool]:
        """Return the curve from the lowest speed (m/s) on, and whether it has left the polar."""
        strips = self.static.probe.shape[0]
        at_rest = np.append(self.static.at_rest, lowest / self.scale)
        start = self._corrected(at_rest, np.append(np.zeros(strips), 1.0))
        if start is None:
            return EquilibriumCurve(np.array([lowest]), np.full((1, strips), np.nan)), True
        points, folds, step, left = [start], [], STEP, False
        tangent = self._tangent(start, np.append(np.zeros(strips), 1.0))
        while len(points) < MOST_POINTS:
            reached = self._step(points[-1], tangent, step)
            if reached is None:
                step *= 0.5
                if step < SHORTEST:
                    left = True
                    break
                continue
            turned = self._tangent(reached, tangent)
            if turned @ tangent < 0.95 and step > 100 * SHORTEST:
                step *= 0.5
                continue
            if turned[-1] * tangent[-1] < 0.0:
                points.append(self._fold(points[-1], tangent, step))
                folds.append(len(points) - 1)
            points.append(reached)
            tangent, step = turned, min(1.3 * step, LONGEST)
            if reached[-1] > 1.0 or reached[-1] * self.scale < lowest:
                break
        found = np.array(points)
        return EquilibriumCurve(found[:, -1] * self.scale, found[:, :-1], tuple(folds)), left

    def _step(self, point: Floats, tangent: Floats, step: float) -> Floats | None:
        return self._corrected(point + step * tangent, tangent)

    def _corrected(self, guess: Floats, tangent: Floats) -> Floats | None:
        """Return the point of the curve in the plane through a guess; None where there is none."""
        z = guess.copy()
        for _ in range(NEWTON_STEPS):
            if z[-1] <= 0.0:
                return None
            missed, matrix = self._bordered(z, tangent)
            if not (np.isfinite(missed).all() and np.isfinite(matrix).all()):
                return None
            change = np.linalg.solve(matrix, np.append(missed, tangent @ (z - guess)))
            z = z - change
            if np.abs(change).max() < ARRIVED:
                return z
        return None

    def _bordered(self, z: Floats, tangent: Floats) -> tuple[Floats, Floats]:
        missed, by_x, by_speed = self.static.residual(z[:-1], float(z[-1]) * self.scale)
        rows = np.concatenate([by_x, (by_speed * self.scale)[:, None]], axis=1)
        return missed, np.concatenate([rows, tangent[None]])

    def _tangent(self, z: Floats, before: Floats) -> Floats:
        _, matrix = self._bordered(z, before)
        tangent = np.linalg.solve(matrix, np.append(np.zeros(z.size - 1), 1.0))
        return np.asarray(tangent / np.linalg.norm(tangent), dtype=np.float64)

    def _fold(self, point: Floats, tangent: Floats, step: float) -> Floats:
        """Return the point at which V' vanishes, within a step along the curve."""
        low, high, best = 0.0, step, point
        for _ in range(FOLD_HALVINGS):
            middle = 0.5 * (low + high)
            there = self._step(point, tangent, middle)
            if there is None:
                break
            best = there
            if self._tangent(there, tangent)[-1] * tangent[-1] > 0.0:
                low = middle
            else:
                high = middle
        return best
