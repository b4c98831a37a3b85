"""Section corrected for the finite span at its aeroelastic equilibrium (Eq. 20)."""

from __future__ import annotations

from equisection.beam.section import Section
from equisection.reduction.correction import CorrectionFactors, corrected_equilibrium

#: Members of a section beyond mass and springs that the correction for the finite span has.
_CORRECTED = ("static_imbalance", "elastic_axis", "flexural_damping", "torsional_damping")


def corrected_section(
    section: Section, factors: CorrectionFactors, incidence_rad: float
) -> tuple[Section, tuple[float, float]]:
    """Return a section (in the flow) corrected by Eq. 20 at the aeroelastic equilibrium.

    The factors multiply its masses and stiffnesses; where it has an imbalance or its axis off
    mid-chord they divide its loads instead, and come back beside it as factors of c_l and c_m
    (:mod:`equisection.reduction.correction`).

    Parameters
    ----------
    section
        The section as it is (:meth:`equisection.beam.section.Section.in_flow`).
    factors
        Polars of section and beam.
    incidence_rad
        theta_0 (rad).

    Raises
    ------
    ReductionError
        There is no equilibrium inside the polars.
    """
    section.require_defaults("the correction for the finite span", but=_CORRECTED)
    equilibrium = corrected_equilibrium(
        factors,
        incidence_rad,
        section.torsional_stiffness,
        section.stiffness_ratio,
        section.axis_behind_mid_chord,
    )
    lift_factor, moment_factor = (
        float(factor[0]) for factor in (equilibrium.lift_factor, equilibrium.moment_factor)
    )
    if section.has_offset:
        return section, (1.0 / lift_factor, 1.0 / moment_factor)
    corrected = Section(
        torsional_stiffness=moment_factor * section.torsional_stiffness,
        flexural_stiffness=lift_factor * section.flexural_stiffness,
        inertia=moment_factor * section.inertia,
        mass=lift_factor * section.mass,
        torsional_damping=moment_factor * section.torsional_damping,
        flexural_damping=lift_factor * section.flexural_damping,
        twist_recovery=section.twist_recovery,
        deflection_recovery=section.deflection_recovery,
    )
    return corrected, (1.0, 1.0)
