"""Steady states of the strip system: held, in aeroelastic equilibrium, and near them.

Equilibrium is found with Newton's method on the bubble incidences x alone: all other states
follow linearly from the deficits. Linearised about equilibrium the system is Y' = J Y with

    J = A + B F (1 - E F)^-1 C,    F = du/d(signals),

whose eigenvalues are growth rate and frequency of the small oscillations.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]

NEWTON_STEPS = 50
NEWTON_TOLERANCE = 1e-12
"""Largest change of x (rad) in the last step of Newton's method."""
DEFICIT_STEPS = 200
"""Iterations for the deficits of given states."""
SHORTEST_STEP = 1e-3
"""Part of a step of Newton's method, where whole steps find nothing."""


def rigid_state(system: StripSystem) -> tuple[Floats, Floats]:
    """States Y (N, n) and deficits u (N, d S) of the beam held rigid at theta_0.

    The structure is undeformed and at rest, every lag in equilibrium with the incidence that
    the strip then has: the state from which a case is released.
    """
    return _steady(system, np.arange(system.layout.structural, system.layout.size))


def release_state(
    system: StripSystem,
    twist: Floats | float = 0.0,
    heave_rate: Floats | float = 0.0,
    about: Floats | None = None,
) -> tuple[Floats, Floats]:
    """States Y (N, n) and deficits u (N, d S) at a release from another twist or with a rate.

    The first torsion mode is held at a twist until the flow is steady, and let go with the springs'
    zero at theta_0; at that moment the first bending mode gets a rate.

    Parameters
    ----------
    system
        The assembled lanes.
    twist
        Theta_1 (rad), one value or one per lane.
    heave_rate
        W_1' (chords per c/V, that is over V), up, one value or one per lane.
    about
        Structural states, at rest, that the twist is beyond: those of static equilibrium, shape
        (N, m). None for the undeformed structure.
    """
    layout = system.layout
    held = np.zeros((system.rates.shape[0], layout.structural)) if about is None else about.copy()
    held[:, layout.twist.start] += twist
    states, deficits = _steady(system, np.arange(layout.structural, layout.size), held)
    if not np.any(heave_rate):
        return states, deficits
    states[:, layout.deflection_rate.start] += heave_rate
    return states, consistent_deficits(system, states, deficits)


def consistent_deficits(system: StripSystem, states: Floats, near: Floats) -> Floats:
    """Deficits u of given states, by iteration from near ones; NaN where it does not end."""
    one = np.ones((states.shape[0], 1))
    u = near
    for _ in range(DEFICIT_STEPS):
        columns = np.concatenate([states, u, one], axis=1)
        earlier, u = u, system.deficits(np.einsum("nij,nj->ni", system.probe, columns))
        if not np.any(np.abs(u - earlier) > NEWTON_TOLERANCE):
            return u
    u[np.any(np.abs(u - earlier) > NEWTON_TOLERANCE, axis=1)] = np.nan
    return u


def equilibrium(system: StripSystem, near: Floats | None = None) -> tuple[Floats, Floats]:
    """States Y (N, n) and deficits u (N, d S) of static aeroelastic equilibrium.

    Lanes that have none inside the polar (or near which Newton's method does not converge)
    are NaN. Of several equilibria the one near the bubble incidences ``near`` (rad), shape
    (N, S), is found.
    """
    return _steady(system, np.arange(system.layout.size), near=near)


def _steady(
    system: StripSystem,
    free: NDArray[np.intp],
    held: Floats | None = None,
    near: Floats | None = None,
) -> tuple[Floats, Floats]:
    """Steady state of the states ``free``; the first ones are ``held`` (N, m), others are zero."""
    n = system.layout.size
    matrix_a = system.rates[:, free[:, None], free]
    others = system.rates[:, free, n:].copy()
    bubbles = system.probe[:, : system.layout.strips]
    constant = bubbles[:, :, n:].copy()
    if held is not None:
        for rows, matrix in ((others, system.rates[:, free]), (constant, bubbles)):
            rows[:, :, -1] += np.einsum("nij,nj->ni", matrix[:, :, : held.shape[1]], held)
    response = -np.linalg.solve(matrix_a, others)
    probe = constant + bubbles[:, :, free] @ response
    gain, offset = probe[:, :, :-1], probe[:, :, -1]
    start = offset.copy() if not np.any(gain) else np.zeros_like(offset)
    start = start if near is None else near.copy()
    x = _newton(system, gain, offset, start)
    lost = np.asarray(np.isnan(x).any(axis=1))
    if lost.any():
        some = gain[lost], offset[lost], start[lost]
        x[lost] = _newton(system.of(lost), *some, shortest=SHORTEST_STEP)
    u = system.deficits(x)
    states = np.zeros((x.shape[0], n))
    if held is not None:
        states[:, : held.shape[1]] = held
    states[:, free] = np.einsum("nij,nj->ni", response[:, :, :-1], u) + response[:, :, -1]
    states[np.isnan(u).any(axis=1)] = np.nan
    return states, u


def _newton(
    system: StripSystem, gain: Floats, offset: Floats, start: Floats, *, shortest: float = 1.0
) -> Floats:
    """Bubble incidences x (N, S) with x = gain u(x) + offset; NaN where none is found.

    Steps are shortened as long as they don't bring x nearer, down to ``shortest`` of their length.
    """

    def residual_of(x: Floats) -> Floats:
        u = system.deficits(x)
        return np.asarray(x - np.einsum("nij,nj->ni", gain, u) - offset, dtype=np.float64)

    x, residual = start, residual_of(start)
    for _ in range(NEWTON_STEPS):
        jacobian = np.eye(x.shape[1]) - gain @ system.deficit_slopes(x)
        sane = np.isfinite(residual).all(axis=1) & np.isfinite(jacobian).all(axis=(1, 2))
        change = np.full_like(x, np.nan)
        change[sane] = np.linalg.solve(jacobian[sane], residual[sane][:, :, None])[:, :, 0]
        fraction = np.ones((x.shape[0], 1))
        trial = residual_of(x - change)
        while fraction.min() > shortest:
            nearer = np.linalg.norm(trial, axis=1) < np.linalg.norm(residual, axis=1)
            far = sane & ~nearer & (fraction[:, 0] > shortest)
            if not far.any():
                break
            fraction[far] *= 0.5
            trial = residual_of(x - fraction * change)
        x, residual = x - fraction * change, trial
        if not np.any(np.abs(change) > NEWTON_TOLERANCE):
            return x
    x[np.any(np.abs(change) > NEWTON_TOLERANCE, axis=1)] = np.nan
    return x


def jacobian(system: StripSystem, states: Floats, deficits: Floats) -> Floats:
    """J of the linearised system about a steady state, shape (N, n, n)."""
    n = system.layout.size
    columns = np.concatenate([states, deficits, np.ones((states.shape[0], 1))], axis=1)
    signals = np.einsum("nij,nj->ni", system.probe, columns)
    slopes = system.deficit_slopes(signals)
    closed = np.eye(signals.shape[1]) - system.probe[:, :, n:-1] @ slopes
    seen = np.linalg.solve(closed, system.probe[:, :, :n])
    return np.asarray(
        system.rates[:, :, :n] + system.rates[:, :, n:-1] @ slopes @ seen, dtype=np.float64
    )


def least_stable_eigenvalue(system: StripSystem) -> NDArray[np.complex128]:
    """Eigenvalue sigma + i omega (per c/V, omega >= 0) of largest growth sigma, shape (N,).

    About static equilibrium; NaN where there is none inside the polar.
    """
    states, deficits = equilibrium(system)
    if not np.isfinite(states).all(axis=1).any():
        raise SolverError(
            "no lane has a static equilibrium inside the polar; extend the polar or stiffen it"
        )
    return least_stable(system, states, deficits)


def least_stable(system: StripSystem, states: Floats, deficits: Floats) -> NDArray[np.complex128]:
    """Eigenvalue sigma + i omega (per c/V, omega >= 0) of largest sigma about steady states, (N,).

    NaN for a lane whose state is not finite, or too near the end of the polar for its slope.
    """
    result = np.full(states.shape[0], complex(np.nan, np.nan), dtype=np.complex128)
    linear = jacobian(system, states, deficits)
    found = np.isfinite(linear).all(axis=(1, 2))
    if found.any():
        values = np.asarray(np.linalg.eigvals(linear[found]), dtype=np.complex128)
        chosen = np.take_along_axis(values, values.real.argmax(axis=1)[:, None], axis=1)[:, 0]
        result[found] = chosen.real + 1j * np.abs(chosen.imag)
    return result
