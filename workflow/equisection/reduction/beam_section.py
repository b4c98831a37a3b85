"""A beam reduced to its section in one step: modes, then Eq. 17."""

from __future__ import annotations

import warnings
from typing import Literal

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.errors import ModesError
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import Reduction, reduce_beam, validity_warnings
from equisection.structure.modes import modes_of_kinds

#: Modes that are computed at least; with those of the chord's plane among them.
COUNT = 4


def reduce(
    beam: Beam,
    *,
    reduction: Reduction = "consistent",
    method: Literal["solid", "beam", "analytic"] = "solid",
    elements: tuple[int, int, int] = (24, 89, 1),
) -> Section:
    """Equivalent section of a beam, per unit span.

    A ``UserWarning`` tells where the section represents the beam badly.

    Parameters
    ----------
    beam
        The beam.
    reduction
        ``consistent`` keeps the natural frequencies and recovers the tip from the section;
        ``paper`` is Eq. 17 as it is printed (:mod:`equisection.reduction.reduce`).
    method
        Computation of the modes, by default that of the configuration: ``solid``,
        three-dimensional elasticity, for a homogeneous plate. A beam with a ``cross_section`` or
        on springs at its root needs ``beam`` (one-dimensional elements) or ``analytic``.
    elements
        Elements along chord, span and thickness; ``beam`` and ``analytic`` use those along the
        span alone.

    Raises
    ------
    ModesError
        The method cannot have this beam; the message says which can.
    ReductionError
        The beam has no equivalent section.
    """
    if method == "solid" and beam.cross_section is not None:
        raise ModesError(
            "method is 'solid', which meshes a homogeneous plate, and the beam has a "
            "cross_section; give method='beam' or 'analytic'"
        )
    modes = modes_of_kinds(beam, method, elements, (1, 1), COUNT)
    section = reduce_beam(beam, modes, reduction)
    for text in (*beam.warnings, *validity_warnings(span_integrals(beam, modes, count=1))):
        warnings.warn(text, stacklevel=2)
    return section
