"""Torsion of a wide plate whose clamped ends cannot warp, which beam elements leave out."""

from __future__ import annotations

import math

from equisection.beam.beam import Beam

#: Part of its torsional stiffness that a beam may lack before it is told (-).
TOLD = 0.05


def restrained_warping(beam: Beam) -> float:
    """Return by how much clamped ends stiffen a homogeneous plate in its first torsion (-).

    A clamped end holds the corners of the section, which would move along the span in free
    (Saint-Venant) torsion. The twist then begins with a boundary layer of length 1/lambda,

        lambda^2 = G J (1 - nu^2)/(E Gamma) = 24 (1 - nu)/c^2,  J = c h^3/3,  Gamma = c^3 h^3/144,

    so that the beam is shorter by it at each clamped end (Vlasov's theory of thin-walled bars, with
    the plate's modulus), and k_theta larger by (1 - n/(lambda L))^-2 with n such ends.

    Parameters
    ----------
    beam
        The beam (SI).

    Returns
    -------
    float
        k_theta of the plate over that of the beam, less one; 0 with a ``cross_section``, whose
        G J is taken as it is.
    """
    clamped = beam.bending_ends.count("clamped")
    if beam.cross_section is not None or clamped == 0:
        return 0.0
    layer = beam.chord / math.sqrt(24.0 * (1.0 - beam.poisson_ratio))
    return (1.0 - clamped * layer / beam.length) ** -2 - 1.0


def warping_warnings(beam: Beam, method: str) -> tuple[str, ...]:
    """Return the warning that a method makes a plate too soft in torsion, if it does by 5 %."""
    lacking = restrained_warping(beam)
    if method == "solid" or lacking <= TOLD:
        return ()
    return (
        f"structure.method {method!r} leaves out that clamped ends cannot warp: of a plate of "
        f"length/chord {beam.length / beam.chord:.3g} k_theta is about {100 * lacking:.0f} % "
        "larger; take structure.method: solid",
    )
