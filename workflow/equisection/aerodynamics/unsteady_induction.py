r"""Unsteady incidence that the wake of a finite beam induces on its own sections.

Lengths are in chords and times in c/V, so omega is omega c/V = 2 k. A strip of circulatory lift c
carries the circulation 2 Gamma/(V c) = L(k) c on a line at the quarter chord, x_B = -1/4. In
harmonic motion a thin plate has

    L(k) = S(k) exp(-i k)/C(k),

with the functions of Theodorsen (NACA Report 496, 1935) and Sears (J. Aeronaut. Sci. 8, 1941): the
circulation of the whole section over what its steady relation to the circulatory lift would give.
The circulation goes on as a ring to the trailing edge, x_T = 1/2, and leaves it as a sheet that is
swept downstream with its phase, exp(-i omega q) at the distance q. As in Weissinger's method for
steady flow (NACA TM 1120, 1947) the incidence is that at three quarters of the chord, x_C = 1/4;
with G of :mod:`equisection.aerodynamics.vortex_rings`,

    alpha_i = T(omega) c,
    T = (L(k)/2) { G(x_C - x_B) - G(x_C - x_T) + int_0^inf exp(-i omega q) d[-G(x_C - x_T - q)] }.

G is without that of two-dimensional flow, which the section's own lag (``indicial``) and its polar
have. A beam from wall to wall, whose strips all carry one load, therefore induces nothing, at any
frequency. T(0) is Weissinger's matrix less the section's own, so that any section polar may follow.
T falls with omega^-1/2: nothing is induced at once.

The incidence at the quarter chord, with G(0) = 0 of the bound line in its own place, is T_q(omega)
c. (T - T_q) c over half a chord is the rise of the induced incidence along the chord, of which the
share kappa acts on the leading edge as a pitch rate does (``CURVATURE_SHARE``).

**As states.** With three fixed rates p, the same for every beam,

    q_p' = p (c - q_p),    alpha_i = sum_p R_p q_p,    sum_p R_p = T(0) exactly,

and the matrices R_p (Q_p for T_q) fitted by linear least squares, entry by entry. They depend on
geometry only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.indicial import theodorsen
from equisection.aerodynamics.vortex_rings import SpanGeometry

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

BOUND_LINE, COLLOCATION_POINT, TRAILING_EDGE = -0.25, 0.25, 0.5
"""x_B, x_C, x_T, chords behind mid-chord."""

INDUCTION_RATES = (0.16, 1.0, 7.2)
"""Rates p (V/c) of the induction states. Chosen for the least error of the loads of rectangular
wings of aspect ratio 4 to 20 and of a beam in a channel."""

FITTED_AT = np.concatenate([np.linspace(0.02, 1.0, 15), np.linspace(1.1, 3.0, 12)])
"""omega c/V at which the matrices of the states are fitted."""

WAKE_LENGTH = 60.0
"""Chords of wake that are integrated; of the rest the phase is taken to run out at its start."""

CURVATURE_SHARE = 0.65
"""kappa: share of the rise of the induced incidence along the chord that acts on the leading edge
as a pitch rate; it would be 1 for a downwash linear along the chord. Calibrated on vortex lattices
of aspect ratio 4 to 20 in pitch, torsion and bending."""

_FIRST_STEP, _STEP_RATIO, _LONGEST_STEP = 0.01, 1.12, 0.5


def circulation_of_lift(reduced_frequency: float) -> complex:
    """L(k), 2 Gamma/(V c) of a thin plate over its circulatory lift, at k >= 0; 1 at rest."""
    k = reduced_frequency
    if k == 0.0:
        return 1.0
    zeroth, first = scipy.special.hankel2(0, k), scipy.special.hankel2(1, k)
    sears = 2.0 / (np.pi * k * (zeroth - 1j * first))
    return complex(sears * np.exp(-1j * k) / theodorsen(k))


@dataclass(frozen=True, eq=False)
class UnsteadyInduction:
    """Downwash of rings and wake of a beam at one point of the chord, in three dimensions only.

    Attributes
    ----------
    bound
        Downwash of the ring from x_B to x_T of 2 Gamma/(V c) = 2 (-), shape (S, S).
    wake_edges
        Distances q (chords) behind the trailing edge, from 0 on, shape (m + 1,).
    wake
        Downwash of the wake between them, shape (m, S, S).
    rest
        Downwash of the wake beyond the last, shape (S, S).
    """

    bound: Floats
    wake_edges: Floats
    wake: Floats
    rest: Floats

    @classmethod
    def at(cls, point: float, geometry: SpanGeometry) -> UnsteadyInduction:
        """Sum the downwash at ``point``, chords behind mid-chord: x_C for T, x_B for T_q."""
        distances = _wake_edges()
        ways = np.concatenate([[point - BOUND_LINE], point - TRAILING_EDGE - distances])
        downwash = geometry.downwash_above_section(ways)
        far = geometry.downwash_above_section([-1e9])[0]
        behind = downwash[1:]
        return cls(downwash[0] - behind[0], distances, behind[:-1] - behind[1:], behind[-1] - far)

    def matrix(self, omega: float) -> Complexes:
        """T or T_q (rad) at omega c/V >= 0, shape (S, S): alpha_i of circulatory c_l of 1."""
        if omega == 0.0:
            return np.asarray(0.5 * (self.bound + self.wake.sum(axis=0) + self.rest), complex)
        start, end = self.wake_edges[:-1], self.wake_edges[1:]
        phase = np.exp(-0.5j * omega * (start + end)) * np.sinc(omega * (end - start) / (2 * np.pi))
        last = self.wake_edges[-1]
        total = (
            self.bound
            + np.tensordot(phase, self.wake, axes=1)
            + self.rest * np.exp(-1j * omega * last) / (1.0 + 1j * omega * last)
        )
        return np.asarray(0.5 * circulation_of_lift(0.5 * omega) * total, dtype=np.complex128)


@dataclass(frozen=True, eq=False)
class InductionStates:
    """Matrices of the induction states.

    Attributes
    ----------
    rates
        p (V/c), shape (P,).
    incidence
        R_p (rad), shape (P, S, S): alpha_i = sum_p R_p q_p at three quarters of the chord.
    front
        Q_p (rad), shape (P, S, S): the same at the quarter chord.
    """

    rates: Floats
    incidence: Floats
    front: Floats

    def matrix(self, omega: float) -> Complexes:
        """T (rad) of the states at omega c/V, shape (S, S)."""
        share = self.rates / (1j * omega + self.rates)
        return np.asarray(np.tensordot(share, self.incidence, axes=1), dtype=np.complex128)

    def front_matrix(self, omega: float) -> Complexes:
        """T_q (rad) of the states at omega c/V, shape (S, S)."""
        share = self.rates / (1j * omega + self.rates)
        return np.asarray(np.tensordot(share, self.front, axes=1), dtype=np.complex128)


@lru_cache(maxsize=32)
def steady_induction(geometry: SpanGeometry) -> tuple[Floats, Floats]:
    """Find T(0) and T_q(0) (rad), each of shape (S, S), without the wake's time.

    The rings of a steady wake add up to one from the bound line to far downstream.
    """
    ways = np.array([COLLOCATION_POINT - BOUND_LINE, 0.0, -1e9])
    rear, front, far = 0.5 * geometry.downwash_above_section(ways)
    return rear - far, front - far


@lru_cache(maxsize=32)
def induction_states(geometry: SpanGeometry) -> InductionStates:
    """Fit the induction states of a beam; a second call with the same geometry costs nothing."""
    rates = np.array(INDUCTION_RATES)
    found = InductionStates(
        rates,
        _fitted(UnsteadyInduction.at(COLLOCATION_POINT, geometry), rates),
        _fitted(UnsteadyInduction.at(BOUND_LINE, geometry), rates),
    )
    for array in (found.rates, found.incidence, found.front):
        array.flags.writeable = False  # shared by all that ask
    return found


def _fitted(induction: UnsteadyInduction, rates: Floats) -> Floats:
    """Matrices of the states (P, S, S), by least squares over ``FITTED_AT``, exact at rest."""
    steady = induction.matrix(0.0).real
    unsteady = np.array([induction.matrix(float(omega)) for omega in FITTED_AT])
    basis = rates / (1j * FITTED_AT[:, None] + rates)
    free = basis[:, :-1] - basis[:, -1:]
    wanted = unsteady - basis[:, -1, None, None] * steady
    rows = np.concatenate([free.real, free.imag])
    values = np.concatenate([wanted.real, wanted.imag]).reshape(rows.shape[0], -1)
    first = np.linalg.lstsq(rows, values, rcond=None)[0].reshape(-1, *steady.shape)
    return np.asarray(np.concatenate([first, [steady - first.sum(axis=0)]]), dtype=np.float64)


def _wake_edges() -> Floats:
    """Distances (chords) behind the trailing edge, close to it at first."""
    distances, step = [0.0], _FIRST_STEP
    while distances[-1] < WAKE_LENGTH:
        distances.append(distances[-1] + step)
        step = min(step * _STEP_RATIO, _LONGEST_STEP)
    return np.array(distances)
