"""The equivalent section of a beam: Eq. 17 as the paper has it, and in consistent form.

``paper`` divides the torsion pair by A_theta,theta and both bending terms by A_theta,w (this gives
the published ratios 9.12 and 0.183; the A_theta printed under m_2D is a misprint), takes K_theta
from the slope of the shape (Eq. 7), which gives the plate of the paper its "k* = 21", and reads the
section's motion as the tip's.
``consistent`` divides each pair by its own A, takes both stiffnesses from the natural
frequencies, and recovers the tip from the section through a and b (see docs/errata.md).

Each row of the equations of motion is divided by its own D: the torsion row by D_theta =
A_theta,theta, the bending row by D_w, A_w,w in the consistent form and A_theta,w in Eq. 17.
The static imbalance belongs to both rows and gets

    S_2D = S A_theta,w / sqrt(D_w D_theta),

the only one that keeps the coupled frequencies of the beam's first two modes: S_2D^2/(m_2D I_2D) is
then the beam's. In the consistent form it is S cos(phi). Dampers are those of the damping ratios of
the first modes, and dashpots of supports as those modes feel them. Neither changes k*.

The pair is the first torsion mode and the bending mode most like it, which is the first where a
beam is held at its ends (:meth:`equisection.structure.mode_set.ModeSet.section_pair`). Lumped
masses are in M and not in A: m_2D is then not m, and S_2D has theirs too.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.errors import ReductionError
from equisection.reduction.integrals import Integrals, span_integrals
from equisection.structure.fittings import (
    deflection_dashpots,
    imbalances,
    lumped,
    twist_dashpots,
)
from equisection.structure.mode_set import ModeSet

Reduction = Literal["paper", "consistent"]
REDUCTIONS: tuple[Reduction, ...] = ("paper", "consistent")

# Below this the section still has numbers but they stand for little; see `validity_warnings`.
_LEAST_PARTICIPATION = 0.3
# An integral of shapes of this size is none.
_NONE = 1e-6


def reduce_beam(beam: Beam, modes: ModeSet, reduction: str = "consistent") -> Section:
    """Equivalent section of a beam from one mode of torsion and one of bending (Eq. 17).

    Parameters
    ----------
    beam
        The beam.
    modes
        Its modes, one of torsion and one of bending at least.
    reduction
        One of :data:`REDUCTIONS`.

    Raises
    ------
    ReductionError
        The reduction is unknown, or the beam has no such section: nothing restrains a motion, or
        the shapes of twist and deflection do not fit.
    ModesError
        A mode is missing.
    """
    if reduction not in REDUCTIONS:
        raise ReductionError(f"reduction is {reduction!r}; choose one of {', '.join(REDUCTIONS)}")
    pair = modes.section_pair()[0]
    integrals = span_integrals(beam, pair, count=1)
    if reason := not_reducible(integrals, reduction):
        raise ReductionError(reason)
    return section_of_pair(beam, pair, reduction)


def not_reducible(integrals: Integrals, reduction: str) -> str:
    """Return why a reduction has no section for a pair of modes; empty where it has.

    Where a mode has no span mean, a uniform load does not move it, and the tip cannot be recovered.

    Parameters
    ----------
    integrals
        Integrals of the pair.
    reduction
        One of :data:`REDUCTIONS`.
    """
    if reduction == "paper":
        a_tw = integrals.a_theta_w[0, 0]
        if abs(a_tw) >= _NONE:
            return ""
        return (
            f"A_theta,w is {a_tw:.1e}: first twist and first deflection have orthogonal shapes, "
            "and the paper's reduction divides by it; use reduction 'consistent'"
        )
    for name, mean in (("F", integrals.f_mean[0]), ("G", integrals.g_mean[0])):
        if abs(mean) < _NONE:
            return (
                f"{name}, the span mean of the first shape, is {mean:.1e}: a uniform load does "
                "not move this mode and the section cannot stand for the beam; run the beam "
                "(sweep.models: [3d])"
            )
    return ""


def section_of_pair(beam: Beam, pair: ModeSet, reduction: str) -> Section:
    """Section of a pair of modes, whether it can stand for the beam or not.

    A reduction that does not have one (:func:`not_reducible`) leaves out what it would divide by 0:
    the torsional stiffness is still that of k*, and the motion of the tip that of the section.

    Parameters
    ----------
    beam
        The beam.
    pair
        One mode of torsion and one of bending.
    reduction
        One of :data:`REDUCTIONS`.

    Raises
    ------
    ReductionError
        Nothing restrains a motion.
    """
    integrals = span_integrals(beam, pair, count=1)
    _require_restraint(beam, integrals)
    if reduction == "paper":
        return _paper_section(beam, pair, integrals)
    return _consistent_section(beam, pair, integrals)


def _bending_divisor(integrals: Integrals, reduction: str) -> float:
    """D_w of a reduction."""
    if reduction == "paper" and not not_reducible(integrals, reduction):
        return float(integrals.a_theta_w[0, 0])
    return float(integrals.a_w_w[0, 0])


def _paper_section(beam: Beam, pair: ModeSet, integrals: Integrals) -> Section:
    a_tt, a_tw = integrals.a_theta_theta[0, 0], integrals.a_theta_w[0, 0]
    d_w = _bending_divisor(integrals, "paper")
    return _section(
        beam,
        pair,
        divisors=(d_w, a_tt),
        a_tw=a_tw,
        torsional_stiffness=beam.torsional_rigidity
        / beam.length**2
        * float(integrals.strain_theta[0, 0] / a_tt),
        flexural_stiffness=beam.bending_rigidity
        / beam.length**4
        * float(integrals.stiffness_w[0, 0] / d_w),
        inertia=beam.inertia_per_length * float(integrals.mass_theta[0, 0] / a_tt),
        mass=beam.mass_per_length * float(integrals.mass_w[0, 0] / d_w),
        twist_recovery=1.0,
        deflection_recovery=1.0,
    )


def _consistent_section(beam: Beam, pair: ModeSet, integrals: Integrals) -> Section:
    a_tt, a_ww = integrals.a_theta_theta[0, 0], integrals.a_w_w[0, 0]
    without = not_reducible(integrals, "consistent")
    return _section(
        beam,
        pair,
        divisors=(a_ww, a_tt),
        a_tw=integrals.a_theta_w[0, 0],
        torsional_stiffness=beam.torsional_rigidity
        / beam.length**2
        * float(integrals.stiffness_theta[0, 0] / a_tt),
        flexural_stiffness=beam.bending_rigidity
        / beam.length**4
        * float(integrals.stiffness_w[0, 0] / a_ww),
        inertia=beam.inertia_per_length * float(integrals.mass_theta[0, 0] / a_tt),
        mass=beam.mass_per_length * float(integrals.mass_w[0, 0] / a_ww),
        twist_recovery=1.0 if without else float(a_tt / integrals.f_mean[0]),
        deflection_recovery=1.0 if without else float(a_ww / integrals.g_mean[0]),
    )


def _section(
    beam: Beam,
    pair: ModeSet,
    *,
    divisors: tuple[float, float],
    a_tw: float,
    **members: float,
) -> Section:
    """Return a section with the imbalance, the dampers and the axis of its beam.

    ``divisors`` are D_w and D_theta, ``members`` the others of :class:`Section`.
    """
    f, g = pair.torsion(1).shape, pair.bending(1).shape
    imbalance = beam.imbalance_per_length * float(a_tw / np.sqrt(np.prod(divisors)))
    if beam.lumps:
        of_lumps = lumped(pair.span, g, f, imbalances(beam)).item()
        imbalance += of_lumps / math.sqrt(math.prod(divisors))
    at_deflection = lumped(pair.span, g, g, deflection_dashpots(beam)).item() / divisors[0]
    at_twist = lumped(pair.span, f, f, twist_dashpots(beam)).item() / divisors[1]
    return Section(
        **members,
        static_imbalance=imbalance if beam.has_imbalance else 0.0,
        flexural_damping=2.0
        * beam.damping.bending
        * math.sqrt(members["flexural_stiffness"] * members["mass"])
        + at_deflection,
        torsional_damping=2.0
        * beam.damping.torsion
        * math.sqrt(members["torsional_stiffness"] * members["inertia"])
        + at_twist,
        chord=beam.chord,
        elastic_axis=beam.elastic_axis,
    )


def _require_restraint(beam: Beam, integrals: Integrals) -> None:
    """Refuse a beam that can turn or swing as a rigid body: it has no k_theta or no k_w."""
    for motion, key, stiffness in (
        ("twist", "root_torsional_stiffness", integrals.stiffness_theta[0, 0]),
        ("deflection", "root_bending_stiffness", integrals.stiffness_w[0, 0]),
    ):
        if stiffness <= 1e-10:
            raise ReductionError(
                f"boundary {beam.boundary!r} leaves {motion} without restraint (its first "
                "natural frequency is as good as zero), so that the section would have no spring; "
                f"give a stiffer beam.{key}, another boundary or beam.supports that hold it"
            )


def oscillation_factor(section: Section, integrals: Integrals, reduction: str) -> float:
    """Return W_tip about its mean over what the recovery of means, w/b, gives (-).

    Means are recovered by a and b, which are those of a static load. An oscillation has the kinetic
    energy of the section's rows times D_w and D_theta in the beam's modes, whatever the load, so
    that W/Theta = (w/theta) sqrt(D_theta/D_w). The twist is Theta = theta/a in both. In the
    consistent form D are the A of their own mode, and the ratio is sqrt(A_theta,theta/A_w,w)
    (:attr:`~equisection.reduction.integrals.Integrals.oscillation_ratio`). A correction for the
    finite span (Eq. 20) stands for loads and changes no D.

    Parameters
    ----------
    section
        The section, of the integrals' first pair of modes.
    integrals
        Integrals of the pair.
    reduction
        One of :data:`REDUCTIONS`.
    """
    ratio = math.sqrt(integrals.a_theta_theta[0, 0] / _bending_divisor(integrals, reduction))
    static = section.twist_recovery / section.deflection_recovery  # W/Theta over w/theta of means
    return float(ratio / static)


def validity_warnings(integrals: Integrals) -> tuple[str, ...]:
    """Return the reasons why a section represents its beam's means badly; empty if there are none.

    How it represents its flutter is said by :mod:`equisection.reduction.flutter_bias`.
    """
    warnings = []
    for name, share, load in (
        ("F^2/A_theta,theta", integrals.twist_participation, "moment"),
        ("G^2/A_w,w", integrals.deflection_participation, "lift"),
    ):
        if share < _LEAST_PARTICIPATION:
            warnings.append(
                f"{name} = {share:.3f} is below {_LEAST_PARTICIPATION}: a uniform {load} moves "
                "other modes more than the first, which is the only one that the section has"
            )
    return tuple(warnings)
