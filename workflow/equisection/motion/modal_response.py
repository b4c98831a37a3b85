r"""Modes of a structure under loads from a flow solver, one step at a time.

Modes q_i of generalised inertia M_ii, each row over it,

    sum_j mu_ij q_j'' + 2 zeta_i omega_i q_i' + omega_i^2 q_i = p_i(s),    mu_ii = 1,

with viscous damping zeta (of critical) and, between bending and torsion, the inertial coupling
mu_ij = M_ij/M_ii of a static imbalance. Where p goes linearly from p_0 to p_1 over a step h, the
motion is known exactly: state, load and its rise obey one linear system of constant coefficients,
and its matrix exponential takes them over the step (Van Loan, IEEE Trans. Autom. Control 23, 1978).
Of an undamped mode alone that is Duhamel's integral (c = cos omega h, s = sin omega h):

    q_1  = c q_0 + s/omega v_0 + (1 - c)/omega^2 p_0 + (1/omega^2 - s/(omega^3 h)) (p_1 - p_0)
    v_1  = -omega s q_0 + c v_0 + s/omega p_0 + (1 - c)/(omega^2 h) (p_1 - p_0)

so the structure has neither numerical damping nor an error of its period, at any step.

The load at the end of a step is not known before the flow has been solved there. So it is
extrapolated, the flow is solved around the position that follows, and the state of the structure is
computed again with the load from the flow (:class:`Staggered`). The two positions differ by O(h^4)
where loads are smooth: both sides together are of second order in the time step.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ModalState:
    """Modes at a time, and the loads on them now and a step earlier, each of shape (n,)."""

    time: float
    position: Floats
    velocity: Floats
    load: Floats
    earlier_load: Floats

    def expected_load(self) -> Floats:
        """Return the load a step later by extrapolation."""
        return 2.0 * self.load - self.earlier_load


@dataclass(frozen=True)
class ModalStep:
    """A step h of modes, rows over their generalised inertia.

    Attributes
    ----------
    frequency
        omega (rad per unit of time), shape (n,).
    step
        h.
    damping_ratio
        zeta, of critical, shape (n,); None for none.
    mass
        mu, 1 on the diagonal, shape (n, n); None for modes that are not coupled.
    """

    frequency: Floats
    step: float
    damping_ratio: Floats | None = None
    mass: Floats | None = None

    @cached_property
    def _over_a_step(self) -> Floats:
        """Matrix from (q, v, p, rise of p) to (q, v) a step later, shape (2 n, 4 n)."""
        count = self.frequency.size
        one, none = np.eye(count), np.zeros((count, count))
        ratio = np.zeros(count) if self.damping_ratio is None else self.damping_ratio
        inverse = one if self.mass is None else np.linalg.inv(self.mass)
        stiffness = inverse * self.frequency**2
        damping = inverse * (2.0 * ratio * self.frequency)
        rates = np.block(
            [
                [none, one, none, none],
                [-stiffness, -damping, inverse, none],
                [none, none, none, one / self.step],
                [none, none, none, none],
            ]
        )
        return np.asarray(scipy.linalg.expm(rates * self.step)[: 2 * count], dtype=np.float64)

    def advanced(self, state: ModalState, load: Floats) -> ModalState:
        """Return the state a step later, where the load is ``load``."""
        before = [state.position, state.velocity, state.load, load - state.load]
        position, velocity = np.split(self._over_a_step @ np.concatenate(before), 2)
        return ModalState(state.time + self.step, position, velocity, load, state.load)


class Staggered:
    """Structure and flow in turns, with any number of turns a step.

    Parameters
    ----------
    modes
        The step of the modes.
    start
        Their state when the flow takes over; None before the first load is known.
    position, velocity
        Of the modes at the release, for the state that the first load completes; None for
        undeformed and at rest.
    """

    def __init__(
        self,
        modes: ModalStep,
        start: ModalState | None = None,
        *,
        position: Floats | None = None,
        velocity: Floats | None = None,
    ) -> None:
        self._modes = modes
        self._release = position, velocity
        self.state = start
        self._proposed = start if start is None else modes.advanced(start, start.expected_load())

    @property
    def proposed_position(self) -> Floats | None:
        """Position of the modes that the flow was given last; None for undeformed at first."""
        return self._release[0] if self._proposed is None else self._proposed.position

    def turn(self, time: float, load: Floats) -> Floats:
        """Take the load that the flow has computed, and return the position of modes at ``time``.

        In the first turn of a step the load is that at its beginning, and the state there becomes
        final. In a later turn it is the load at the end of the step.
        """
        if self._proposed is None:
            position, velocity = (
                np.zeros_like(load) if given is None else given for given in self._release
            )
            self.state = ModalState(time - self._modes.step, position, velocity, load, load)
        elif self.is_new_step(time):
            assert self.state is not None
            self.state = self._modes.advanced(self.state, load)
        else:
            assert self.state is not None
            self._proposed = self._modes.advanced(self.state, load)
            return self._proposed.position
        self._proposed = self._modes.advanced(self.state, self.state.expected_load())
        return self._proposed.position

    def is_new_step(self, time: float) -> bool:
        """Tell whether a time belongs to a step that has not begun."""
        return self._proposed is None or time > self._proposed.time + 0.5 * self._modes.step
