r"""Equations of motion of a beam on its uncoupled modes: mass, damping and stiffness matrices.

Bending shapes g_i and torsion shapes f_j are those of the beam without imbalance. With the static
imbalance S they couple through the inertia alone. Per unit span, integrals over z/L,

    M = [ m int g_i g_i        -S int g_i f_j ]      K = diag(omega^2 M_ii)
        [ -S int f_j g_i        I int f_j f_j ]      C = diag(2 zeta omega M_ii)

The damping is viscous, a part of critical of each uncoupled mode. Shapes of one kind are
orthogonal in M. Lumped masses add to M, and dashpots of supports to C, their sums over the places
(:mod:`.fittings`): then shapes are orthogonal in M alone, and C is full.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import Beam
from equisection.structure.fittings import (
    deflection_dashpots,
    imbalances,
    inertias,
    lumped,
    masses,
    twist_dashpots,
)
from equisection.structure.mode_set import ModeSet
from equisection.structure.span import gram

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ModalMatrices:
    """Matrices of n_w bending and n_theta torsion modes per unit span, deflections first (SI).

    Attributes
    ----------
    mass, damping, stiffness
        M, C, K, shape (n, n), n = n_w + n_theta.
    likeness
        int h_i h_j over z/L of all shapes (-), shape (n, n): those of A in Eq. 12.
    bending
        Number n_w of bending modes.
    """

    mass: Floats
    damping: Floats
    stiffness: Floats
    likeness: Floats
    bending: int

    @property
    def natural_frequencies(self) -> Floats:
        """Undamped angular frequencies of the coupled beam in vacuum (rad/s), rising, (n,)."""
        squares = np.linalg.eigvals(np.linalg.solve(self.mass, self.stiffness))
        return np.asarray(np.sqrt(np.sort(squares.real)), dtype=np.float64)

    @property
    def damping_ratios(self) -> Floats:
        """Projected damping of each mode, C_ii/(2 sqrt(K_ii M_ii)) (-), (n,)."""
        mass, damping, stiffness = map(np.diag, (self.mass, self.damping, self.stiffness))
        return np.asarray(damping / (2.0 * np.sqrt(stiffness * mass)), dtype=np.float64)

    def pair(self, torsion: int, bending: int | None = None) -> ModalMatrices:
        """Matrices of one torsion and one bending mode alone, by number; the first is number 1.

        Without another number of the bending mode it is that of the torsion mode.
        """
        number = torsion if bending is None else bending
        chosen = np.ix_(*[[number - 1, self.bending + torsion - 1]] * 2)
        return ModalMatrices(
            self.mass[chosen],
            self.damping[chosen],
            self.stiffness[chosen],
            self.likeness[chosen],
            bending=1,
        )


def modal_matrices(beam: Beam, modes: ModeSet, bending: int, torsion: int) -> ModalMatrices:
    """Matrices of the first modes of a beam.

    Parameters
    ----------
    beam
        The beam, with its axes and its damping.
    modes
        Its uncoupled modes.
    bending, torsion
        Numbers n_w and n_theta of modes.

    Raises
    ------
    ModesError
        There are fewer.
    """
    deflections, twists = modes.bending(bending), modes.torsion(torsion)
    shapes = np.concatenate([deflections.shape, twists.shape])
    omega = 2.0 * np.pi * np.concatenate([deflections.frequency, twists.frequency])
    likeness = gram(modes.span, shapes, shapes)
    inertia = np.repeat([beam.mass_per_length, beam.inertia_per_length], [bending, torsion])
    ratio = np.repeat([beam.damping.bending, beam.damping.torsion], [bending, torsion])
    g, f = deflections.shape, twists.shape
    lumps = [lumped(modes.span, g, g, masses(beam)), lumped(modes.span, f, f, inertias(beam))]
    own = inertia * (np.diag(likeness) + np.concatenate([np.diag(each) for each in lumps]))
    mass = np.diag(own)
    across = -beam.imbalance_per_length * likeness[:bending, bending:]
    across = across - lumped(modes.span, g, f, imbalances(beam))
    mass[:bending, bending:] = across
    mass[bending:, :bending] = across.T
    damping = np.diag(2.0 * ratio * omega * own)
    damping[:bending, :bending] += lumped(modes.span, g, g, deflection_dashpots(beam))
    damping[bending:, bending:] += lumped(modes.span, f, f, twist_dashpots(beam))
    return ModalMatrices(
        mass=mass,
        damping=damping,
        stiffness=np.diag(omega**2 * own),
        likeness=likeness,
        bending=bending,
    )
