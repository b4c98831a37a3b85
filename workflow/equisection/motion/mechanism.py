r"""Mechanism of an instability, from where the air puts its energy into the motion.

A small motion with the eigenvalue p = sigma + i omega moves the heave by w exp(p s) and the twist
by theta exp(p s), real parts meant. With the loads (force up, moment about the elastic axis)

    f_w = Q_ww w + Q_wt theta,    f_t = Q_tw w + Q_tt theta,

the air puts the mean power Re(f conj(p x))/2 into a motion x. It has three parts:

    P_w = Re(conj(p w) Q_ww w)/2              heave alone,
    P_t = Re(conj(p theta) Q_tt theta)/2      twist alone,
    P_c, the rest with Q_wt and Q_tw          coupling, by the phase between heave and twist.

They sum to what the motion gains and its dampers take, so that at least one is positive where an
oscillation grows. The largest tells the mechanism:

*divergence*
    The motion grows without turning, omega = 0 (Bisplinghoff, Ashley & Halfman, *Aeroelasticity*,
    1955, chapter 8).
*flutter*
    The energy comes by coupling. The air damps each motion alone, and the phase between them makes
    it drive both (Dowell, *A Modern Course in Aeroelasticity*, on coalescence flutter; Simiu &
    Scanlan, *Wind Effects on Structures*, on classical flutter, where H_1* and A_2* are negative).
*galloping*
    The energy comes by heave alone, and it does so at low frequency too: there P_w is
    -(c_l' + c_d) |p w|^2/2, so that this is the criterion of Den Hartog, c_l' + c_d < 0 (Blevins,
    *Flow-Induced Vibration*, on galloping).
*stall-flutter*
    The energy comes by one motion alone, as a rule by twist near its own frequency, and comes from
    separation: the loads of attached flow damp that motion (Dowell, on stall flutter; Simiu &
    Scanlan, on torsional flutter, where A_2* is positive).

One motion that attached flow drives too is called flutter: a thin plate that turns about an axis
ahead of its quarter chord, at low frequency (Garrick & Rubinow, NACA Report 836, 1946).

Apparent mass does no work in a neutral motion. It is counted as mass here, and not as a load.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from equisection.motion.steady_states import jacobian
from equisection.motion.strip_system import StripSystem, mass_with_air

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Texts = NDArray[np.str_]
InfluenceOf = Callable[[Complexes], Complexes]
"""Loads Q, shape (N, m, m), at N eigenvalues p, shape (N,); rows and columns heave, then twist."""

SLOW = 1e-4
"""omega c/V at which heave is slow: loads are those of the steady polar in the wind it meets."""


class Mechanism(StrEnum):
    """Kinds of instability; none of a stable motion, unknown where there is no eigenvalue."""

    NONE = "none"
    DIVERGENCE = "divergence"
    FLUTTER = "flutter"
    STALL_FLUTTER = "stall-flutter"
    GALLOPING = "galloping"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Instabilities:
    """Mechanisms of N motions, and the numbers that tell them apart; arrays of shape (N,).

    The numbers are NaN of a motion that does not grow, or grows without turning.

    Attributes
    ----------
    mechanism
        Names of :class:`Mechanism`.
    heave_share, twist_share, coupling_share
        Parts of the power that the air puts into the motion (-): by heave alone, by twist alone and
        by coupling. A part that takes energy counts as 0, so that they sum to 1.
    heave_phase_deg
        Phase (deg) of the heave, up, ahead of the twist, nose up; of the first modes of a beam.
    """

    mechanism: Texts
    heave_share: Floats
    twist_share: Floats
    coupling_share: Floats
    heave_phase_deg: Floats


def instabilities(
    eigenvalue: Complexes,
    heave: Complexes,
    twist: Complexes,
    influence: InfluenceOf,
    attached: InfluenceOf | None = None,
) -> Instabilities:
    """Tell the mechanism of N motions.

    Parameters
    ----------
    eigenvalue
        p = sigma + i omega with omega >= 0 (V/c), shape (N,); NaN where there is none.
    heave, twist
        The eigenvector: heave of the elastic axis (chords, up), shape (N, n_b), and twist (rad,
        nose up), shape (N, n_t), in any common scale and phase.
    influence
        Generalised loads Q about the elastic axis, over q c and q c^2, without apparent mass.
    attached
        The same of flow that stays attached. Without them all flow is attached.
    """
    p = np.asarray(eigenvalue, dtype=np.complex128)
    motion = np.concatenate([heave, twist], axis=1)
    grows = np.isfinite(p) & (p.real > 0.0) & (p.imag > 0.0) & np.isfinite(motion).all(axis=1)
    mechanism = np.select(
        [~np.isfinite(p), p.real <= 0.0, p.imag == 0.0],
        [Mechanism.UNKNOWN, Mechanism.NONE, Mechanism.DIVERGENCE],
        Mechanism.UNKNOWN,
    ).astype(object)
    numbers = np.full((4, p.size), np.nan)
    if grows.any():
        kinds = heave.shape[1]

        def powers(loads: InfluenceOf, at: Complexes) -> Floats:
            whole = np.broadcast_to(at, p.shape) if at.size == 1 else at
            return _powers(np.where(grows, whole, 1j), motion, kinds, loads)[:, grows]

        found = powers(influence, p)
        gained = np.maximum(found, 0.0)
        numbers[:3, grows] = gained / gained.sum(axis=0)
        first = heave[grows, 0] * np.conj(twist[grows, 0])
        numbers[3, grows] = np.degrees(np.angle(first))
        largest = found.argmax(axis=0)
        gallops = powers(influence, np.array([SLOW * 1j]))[0] > 0.0
        alone = np.take_along_axis(
            found if attached is None else powers(attached, p), largest[None], axis=0
        )[0]
        mechanism[grows] = np.select(
            [largest == _COUPLING, (largest == _HEAVE) & gallops, alone <= 0.0],
            [Mechanism.FLUTTER, Mechanism.GALLOPING, Mechanism.STALL_FLUTTER],
            Mechanism.FLUTTER,
        )
    return Instabilities(mechanism.astype(np.str_), *numbers)


_HEAVE, _TWIST, _COUPLING = range(3)


def _powers(p: Complexes, motion: Complexes, kinds: int, influence: InfluenceOf) -> Floats:
    """P_w, P_t and P_c, shape (3, N), of motions whose first ``kinds`` columns are heave."""
    loads = influence(p)
    rate = np.conj(p[:, None] * motion)

    def power(rows: slice, columns: slice) -> Floats:
        force = np.einsum("nij,nj->ni", loads[:, rows, columns], motion[:, columns])
        return np.asarray(0.5 * np.real(np.einsum("ni,ni->n", rate[:, rows], force)))

    heave, twist = slice(0, kinds), slice(kinds, None)
    return np.stack(
        [power(heave, heave), power(twist, twist), power(heave, twist) + power(twist, heave)]
    )


def least_stable_instabilities(
    system: StripSystem, states: Floats, deficits: Floats
) -> tuple[Complexes, Instabilities]:
    """Eigenvalue p (V/c, omega >= 0) of largest growth about N steady states, and its mechanism.

    Parameters
    ----------
    system
        Sections or beams on strips.
    states, deficits
        Steady states, as of :func:`equisection.motion.steady_states.equilibrium`; NaN of a lane
        that has none, whose eigenvalue is NaN too.
    """
    linear = jacobian(system, states, deficits)
    found = np.asarray(np.isfinite(linear).all(axis=(1, 2)))
    p = np.full(len(linear), complex(np.nan, np.nan))
    vectors = np.zeros((len(linear), linear.shape[1]), dtype=np.complex128)
    if found.any():
        values, right = np.linalg.eig(linear[found])
        turned = np.where(values.imag < 0.0, -np.inf, values.real)
        place = turned.argmax(axis=1)
        p[found] = np.take_along_axis(values, place[:, None], axis=1)[:, 0]
        vectors[found] = np.take_along_axis(right, place[:, None, None], axis=2)[:, :, 0]
    layout = system.layout
    return p, instabilities(
        p,
        vectors[:, layout.deflection],
        vectors[:, layout.twist],
        influence_of(system, np.where(found[:, None, None], linear, 0.0)),
        influence_of(system, system.rates[:, :, : layout.size]),
    )


def influence_of(system: StripSystem, linear: Floats) -> InfluenceOf:
    """Return the loads Q of a strip system whose rates are linear about a state.

    The lags follow a motion q exp(p s), and what then accelerates the modes but for dampers and
    springs is the load.

    Parameters
    ----------
    system
        Sections or beams on strips.
    linear
        J about a steady state, shape (N, n, n); with A in its place, the rates at constant
        deficits, the loads are those of attached flow.
    """
    structure, layout = system.structure, system.layout
    modes = np.r_[layout.deflection, layout.twist]
    rates = np.r_[layout.deflection_rate, layout.twist_rate]
    lags = np.arange(layout.structural, layout.size)
    inertia, mass, across = mass_with_air(structure)
    bending, torsion = layout.bending_modes, layout.torsion_modes
    mass_matrix = np.block([[mass, across.transpose(0, 2, 1)], [across, inertia]])
    none = np.zeros((len(mass), bending, torsion))
    damping = np.block(
        [
            [structure.bending_damping, none],
            [none.transpose(0, 2, 1), structure.torsion_damping],
        ]
    )
    stiffness = np.concatenate([structure.bending_stiffness, structure.torsion_stiffness], axis=1)

    def influence(p: Complexes) -> Complexes:
        at = p[:, None, None]

        def by_mode(rows: NDArray[np.intp]) -> Complexes:
            part = linear[:, rows]
            return np.asarray(part[:, :, modes] + at * part[:, :, rates])

        following = np.linalg.solve(
            at * np.eye(lags.size) - linear[:, lags[:, None], lags], by_mode(lags)
        )
        accelerations = by_mode(rates) + linear[:, rates[:, None], lags] @ following
        held = stiffness[:, :, None] * np.eye(bending + torsion)
        return np.asarray(mass_matrix @ accelerations + at * damping + held)

    return influence
