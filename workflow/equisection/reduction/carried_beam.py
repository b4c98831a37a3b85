"""Polar of the beam as it would be on the cells of another section: the ratio of the two kept.

A mesh changes the loads of section and beam alike, so that the ratio of the two on equal cells
hangs less on the mesh than either. Where the section is resolved more finely than its beam can
be, or is measured and not computed, the beam's polar is carried over to it,

    C(alpha) = c(alpha) C_ref(alpha)/c_ref(alpha),

from a section ``c_ref`` and a beam ``C_ref`` that belong together: the same cells, or the same
tunnel. The factors of Eq. 20 are then c/C = c_ref/C_ref, and the equilibrium that they are taken
at is that of ``C``. Where ``c_ref`` and ``C_ref`` differ in sign, so do ``c`` and ``C``, and there
is no factor either.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.errors import ReductionError
from equisection.reduction.correction import CorrectionFactors

#: Fewest incidences of a polar.
_FEWEST = 4
#: Part of the largest load of a section below which a ratio of another sign is one of residues.
_NIL = 0.01

Floats = NDArray[np.float64]


def beam_carried_over(section: Polar, pair: CorrectionFactors) -> Polar:
    """Return the polar of the beam that belongs to a section, by the ratio of another pair.

    Parameters
    ----------
    section
        c_l, c_m, c_d of the section that is to be corrected.
    pair
        Section and beam that belong together.

    Returns
    -------
    Polar
        C_L, C_M, C_D at each incidence that one of the three has and all cover. Incidences at
        which a load of the pair's section all but vanishes, and its beam's does not go with it,
        are left out.

    Raises
    ------
    ReductionError
        Fewer than four incidences are left, or the pair's section has no drag at one.
    """
    three = (section.continued, pair.section.continued, pair.beam.continued)
    low = max(polar.incidence_range[0] for polar in three)
    high = min(polar.incidence_range[1] for polar in three)
    incidence = np.unique(np.concatenate([polar.incidence for polar in three]))
    incidence = incidence[(incidence >= low) & (incidence <= high)]
    own, of_section, of_beam = three
    lift = _beam_over_section(
        pair.lift_factor(incidence), of_section.lift_cubic(incidence), of_beam.lift_cubic(incidence)
    )
    moment = _beam_over_section(
        pair.moment_factor(incidence),
        of_section.moment_cubic(incidence),
        of_beam.moment_cubic(incidence),
    )
    there = np.isfinite(lift) & np.isfinite(moment)
    if there.sum() < _FEWEST:
        raise ReductionError(
            f"section {pair.section.label!r} and beam {pair.beam.label!r} have a ratio of their "
            f"loads at {there.sum()} incidences that section {section.label!r} covers too, and "
            f"{_FEWEST} are needed; give steady.beam_polar and steady.beam_polar_section more "
            "incidences in common"
        )
    incidence, lift, moment = incidence[there], lift[there], moment[there]
    drag_of_section = of_section.drag_coefficient(incidence)
    if not np.all(drag_of_section > 0.0):
        at = np.degrees(incidence[drag_of_section <= 0.0][0])
        raise ReductionError(
            f"section {pair.section.label!r} has no drag at {at:.4g} deg, by which that of the "
            "beam is carried over; give steady.beam_polar_section its drag"
        )
    drag = own.drag_coefficient(incidence) * of_beam.drag_coefficient(incidence) / drag_of_section
    return Polar(
        incidence,
        drag,
        own.lift_cubic(incidence) * lift,
        own.moment_cubic(incidence) * moment,
        f"{pair.beam.label} over {pair.section.label}, of {section.label}",
    )


def _beam_over_section(factor: Floats, section: Floats, beam: Floats) -> Floats:
    """Return C_ref/c_ref (-), also where it is no factor since the two differ in sign.

    NaN where there is no factor and the section's load all but vanishes.
    """
    is_other = np.isnan(factor) & (np.abs(section) > _NIL * np.abs(section).max())
    ratio: Floats = np.where(is_other, beam / np.where(is_other, section, 1.0), 1.0 / factor)
    return ratio
