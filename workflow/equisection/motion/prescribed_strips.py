r"""Strips in prescribed motion: the loads of the strip system on modes that follow a given motion.

The structural states (Theta, Theta', W, W') of :mod:`equisection.motion.strip_system` are given
over time. What is left are the states a of wake, bubble and induction, in the rows of the same
matrices,

    a' = A a + B_s (Theta, Theta', W, W') + B_u u + e,

integrated as in :mod:`equisection.motion.march`: exactly, but for motion and deficits, which vary
linearly over a step. The loads of the system have the accelerations of a free structure in them, as
apparent mass. They are taken out, and those of the given motion are put in.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.errors import IncidenceOutOfRangeError
from equisection.motion.march import CORRECTIONS
from equisection.motion.steady_states import release_state
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ModalMotion:
    """Given motion of the modes of one beam at uniform times.

    Attributes
    ----------
    step
        Interval of the times (c/V).
    twist, twist_rate, twist_acceleration
        Theta_i (rad) and derivatives over s, shape (n, n_t).
    deflection, deflection_rate, deflection_acceleration
        W_j (chords) and derivatives over s, shape (n, n_b).
    """

    step: float
    twist: Floats
    twist_rate: Floats
    twist_acceleration: Floats
    deflection: Floats
    deflection_rate: Floats
    deflection_acceleration: Floats

    @property
    def states(self) -> Floats:
        """Structural states in the order of the system, shape (n, m)."""
        return np.concatenate(
            [self.twist, self.twist_rate, self.deflection, self.deflection_rate], axis=1
        )


@dataclass(frozen=True)
class ModalLoads:
    """Loads on a beam in given motion.

    Attributes
    ----------
    lift, moment
        C_L, and C_M about the moving mid-chords (-), shape (n,).
    bending, torsion
        int c_l g_j dz/L, shape (n, n_b), and int c_m,ea f_i dz/L, shape (n, n_t).
    """

    lift: Floats
    moment: Floats
    bending: Floats
    torsion: Floats


def prescribed_loads(system: StripSystem, motion: ModalMotion) -> ModalLoads:
    """Return the loads under a given motion, from steady flow at its first sample.

    Parameters
    ----------
    system
        System of one lane; mass, stiffness and damping of its structure do not matter.
    motion
        Motion of its modes, which begins at rest.

    Raises
    ------
    IncidenceOutOfRangeError
        A bubble leaves the polar.
    """
    columns = _columns(system, motion)
    layout, structure = system.layout, system.structure
    f, g, weights = structure.torsion_shapes, structure.bending_shapes, structure.weights
    mass, inertia = structure.apparent
    axis = float(structure.axis[0])
    # accelerations of the given motion less those of the free structure in the same state
    turned = motion.twist_acceleration - columns @ system.rates[0, layout.twist_rate].T
    heaved = motion.deflection_acceleration - columns @ system.rates[0, layout.deflection_rate].T
    apparent = (heaved @ g.T + axis * turned @ f.T) @ mass.T
    of_turn = (turned @ f.T) @ inertia.T
    strips = layout.strips
    lift = columns @ system.strip_loads[0, :strips].T - apparent
    moment = columns @ system.strip_loads[0, strips:].T - of_turn
    about_axis = columns @ system.axis_moments[0].T - of_turn - axis * apparent
    return ModalLoads(
        lift @ weights,
        moment @ weights,
        lift @ (weights[:, None] * g),
        about_axis @ (weights[:, None] * f),
    )


def _columns(system: StripSystem, motion: ModalMotion) -> Floats:
    """Return [Y | u | 1] of the system at each time, shape (n, columns)."""
    layout, given = system.layout, motion.states
    size, m = layout.size, layout.structural
    states, deficits = release_state(system, about=given[:1])
    rates = system.rates[0, m:]
    entering = np.concatenate([rates[:, :m], rates[:, size:-1], rates[:, -1:]], axis=1)
    phi, old, new = _held(rates[:, m:size], entering, motion.step)
    of_deficits = slice(m, -1)
    driven = given[:-1] @ old[:, :m].T + given[1:] @ new[:, :m].T + old[:, -1] + new[:, -1]
    probe = system.probe[0]
    seen = given @ probe[:, :m].T + probe[:, -1]
    state, u, earlier = states[0, m:], deficits[0], deficits[0]
    found = np.ones((len(given), system.rates.shape[2]))
    found[:, :m] = given
    for place in range(len(given)):
        if place:
            without = phi @ state + driven[place - 1] + old[:, of_deficits] @ u
            guess, earlier = 2.0 * u - earlier, u
            for _ in range(CORRECTIONS):
                state = without + new[:, of_deficits] @ guess
                x = seen[place] + probe[:, m:size] @ state + probe[:, size:-1] @ guess
                guess = system.deficits(x[None])[0]
            if not np.isfinite(guess).all():
                polar, bubbles = system.loads.branches.polar, x[: layout.strips]
                if np.isfinite(bubbles).all():
                    polar.require(float(bubbles[np.abs(bubbles).argmax()]))
                low, high = np.degrees(polar.incidence_range)
                raise IncidenceOutOfRangeError(
                    f"the motion leaves polar {polar.label!r}, which covers {low:.4g} to "
                    f"{high:.4g} deg; extend the polar"
                )
            u = guess
            state = without + new[:, of_deficits] @ u
        found[place, m:size], found[place, size:-1] = state, u
    return found


def _held(matrix: Floats, entering: Floats, step: float) -> tuple[Floats, Floats, Floats]:
    """Return the matrices of a step, on the state and on what enters at its beginning and end."""
    size, count = entering.shape
    exponent = np.zeros((size + 2 * count, size + 2 * count))
    exponent[:size, :size] = step * matrix
    exponent[:size, size : size + count] = step * entering
    exponent[size : size + count, size + count :] = np.eye(count)
    phi = scipy.linalg.expm(exponent)[:size]
    new = phi[:, size + count :]
    return phi[:, :size], phi[:, size : size + count] - new, new
