r"""Static equilibria of a beam over speed by continuation, through folds.

The curve is followed from rest by pseudo-arclength continuation (Keller, *Numerical solution of
bifurcation and nonlinear eigenvalue problems*, 1977): the bubble incidences x of all strips and the
speed V are unknowns together, and with the tangent (x', V') of the curve the next point is the one
with

    x = G(V) u(x) + x_0(V),    x'.(x - x_p) + V' (V - V_p) = step,

u the deficits of the strips. Where V' changes its sign is a *fold*: at a higher speed there is no
equilibrium near, and the body diverges, while the curve goes on to lower speeds on another branch.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.steady_states import rigid_state

Floats = NDArray[np.float64]

STEP, SHORTEST, LONGEST = 0.01, 1e-6, 0.03
"""First, shortest and longest step along the curve, of radians and of the highest speed."""
MOST_POINTS = 4000
NEWTON_STEPS, ARRIVED = 8, 1e-11
FOLD_HALVINGS = 40


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


class _StaticMap:
    """x = G(V) u + x_0(V) of a body at rest, from its equations of motion.

    A = P + Q/V^2 holds for all columns that a body at rest has, since all rates vanish.
    """

    def __init__(self, body: BodyInFlow, incidence_rad: float) -> None:
        two = np.array([1.0, 2.0]) * body.speed
        both = body.system(two, np.full(2, incidence_rad))
        self.system = both.of(np.array([True, False]))
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
