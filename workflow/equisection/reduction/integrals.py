"""The integrals of Eqs. 6, 7 and 12 over the mode shapes.

Stiffness comes in two forms. Eq. 7 squares derivatives of the shapes; for the exact modes of a
beam it equals M omega^2 made dimensionless. For modes of a solid the two differ, because the
clamp restrains warping (in torsion) and Poisson contraction (in bending) and the strain energy of
that is in the frequency but not in f' or g''. ``stiffness_*`` are from the frequencies,
``strain_theta`` is Eq. 7 for torsion. Eq. 7 for bending is not offered: a second derivative of a
finite-element shape is noise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import Beam
from equisection.structure.fittings import inertias, lumped, masses
from equisection.structure.mode_set import ModeSet, torsion_strain
from equisection.structure.span import gram, integrate

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Integrals:
    """Integrals over z/L of n torsion shapes f_i and n bending shapes g_i, all dimensionless.

    Attributes
    ----------
    mass_theta, mass_w : (n, n) arrays
        M_theta, M_w (Eq. 6), with lumped masses over I L and m L.
    stiffness_theta, stiffness_w : (n, n) arrays
        K_theta, K_w (Eq. 7) as omega_i omega_j M_ij over GJ/(L^2 rho c^3 h/12) and
        EI/(L^4 rho c h). Springs at the root count as stiffness.
    strain_theta : (n, n) array
        K_theta (Eq. 7) from the slopes of the shapes. Springs at the root count as stiffness.
    a_theta_theta, a_theta_w, a_w_w : (n, n) arrays
        A of Eq. 12. Row of A_theta,w: torsion; column: bending.
    f_mean, g_mean : (n,) arrays
        F_i, G_i: integrals of f_i and g_i.
    """

    mass_theta: Floats
    mass_w: Floats
    stiffness_theta: Floats
    stiffness_w: Floats
    strain_theta: Floats
    a_theta_theta: Floats
    a_theta_w: Floats
    a_w_w: Floats
    f_mean: Floats
    g_mean: Floats

    @property
    def cos_phi(self) -> float:
        """Likeness of the first shapes: A_theta,w over sqrt(A_theta,theta A_w,w) (-).

        1 where twist and deflection have one shape: only then can a section carry the coupling
        of the two exactly.
        """
        a_tt, a_ww = self.a_theta_theta[0, 0], self.a_w_w[0, 0]
        return float(self.a_theta_w[0, 0] / np.sqrt(a_tt * a_ww))

    @property
    def oscillation_ratio(self) -> float:
        """sqrt(A_theta,theta/A_w,w) (-): W/Theta of an oscillating tip over the section's w/theta.

        In amplitudes that give both first modes the inertia of the section's rows, sqrt(A_w,w) W
        and sqrt(A_theta,theta) Theta, the equations of motion of the two are those of the
        section. Under static loads it is a/b instead, since no inertia is in them.
        """
        return float(np.sqrt(self.a_theta_theta[0, 0] / self.a_w_w[0, 0]))

    @property
    def twist_participation(self) -> float:
        """F^2/A_theta,theta (-): share of a uniform moment's work taken by the first mode's."""
        return float(self.f_mean[0] ** 2 / self.a_theta_theta[0, 0])

    @property
    def deflection_participation(self) -> float:
        """G^2/A_w,w (-), the same of a uniform lift and the first bending mode."""
        return float(self.g_mean[0] ** 2 / self.a_w_w[0, 0])


def span_integrals(beam: Beam, modes: ModeSet, count: int = 4) -> Integrals:
    """Integrals over the first ``count`` modes of torsion and of bending.

    The spline through the stations of the modes is integrated exactly.
    """
    torsion, bending = modes.torsion(count), modes.bending(count)
    z, f, g = modes.span, torsion.shape, bending.shape
    a_theta_theta, a_w_w = gram(z, f, f), gram(z, g, g)
    omega_theta = 2.0 * np.pi * torsion.frequency
    omega_w = 2.0 * np.pi * bending.frequency
    rate_theta = beam.torsional_rigidity / (beam.inertia_per_length * beam.length**2)
    rate_w = beam.bending_rigidity / (beam.mass_per_length * beam.length**4)
    # For a uniform beam M and A are one integral (Eqs. 6, 12); lumped masses are in M alone.
    mass_theta = a_theta_theta + lumped(z, f, f, inertias(beam))
    mass_w = a_w_w + lumped(z, g, g, masses(beam))
    return Integrals(
        mass_theta=mass_theta,
        mass_w=mass_w,
        stiffness_theta=np.outer(omega_theta, omega_theta) * mass_theta / rate_theta,
        stiffness_w=np.outer(omega_w, omega_w) * mass_w / rate_w,
        strain_theta=torsion_strain(modes, beam, count),
        a_theta_theta=a_theta_theta,
        a_theta_w=gram(z, f, g),
        a_w_w=a_w_w,
        f_mean=integrate(z, f),
        g_mean=integrate(z, g),
    )
