"""A beam reduced to its section in one step: modes, then Eq. 17."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from numbers import Integral
from typing import Literal

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.conventions import STANDARD_AIR
from equisection.errors import ArgumentError, ReductionError
from equisection.keys.arguments import require_positive
from equisection.reduction.flutter_bias import flutter_bias, refusal, unlike
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import Reduction, reduce_beam, validity_warnings
from equisection.structure.modes import modes_of_kinds, require_method
from equisection.structure.warping import warping_warnings

#: Modes that are computed at least; with those of the chord's plane among them.
COUNT = 4


def reduce(
    beam: Beam,
    *,
    reduction: Reduction = "consistent",
    method: Literal["solid", "beam", "analytic"] = "solid",
    elements: tuple[int, int, int] = (24, 89, 1),
    density: float = STANDARD_AIR,
) -> Section:
    """Equivalent section of a beam, per unit span.

    A ``UserWarning`` tells where the section represents the beam badly, with the difference of
    their flutter speeds by linear theory.

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
    density
        Density of the fluid rho (kg/m^3) in which section and beam are compared; by default that of
        air at sea level. It does not change the section.

    Raises
    ------
    ArgumentError
        The numbers of elements are not three, or the density is not positive.
    ModesError
        The method cannot have this beam; the message says which can.
    ReductionError
        The beam has no equivalent section: nothing restrains it, or the section would flutter at a
        speed that is 15 % or more off the beam's.
    """
    require_method(beam, method)
    require_positive("density", density, "kg/m3")
    if not (
        isinstance(elements, Sequence)
        and len(elements) == 3
        and all(isinstance(one, Integral) and one > 0 for one in elements)
    ):
        raise ArgumentError(
            f"elements is {elements!r}; wanted three whole numbers above 0, along chord, span and "
            "thickness"
        )
    modes = modes_of_kinds(beam, method, elements, (1, 1), COUNT)
    section = reduce_beam(beam, modes, reduction)
    compared = flutter_bias(section, beam, modes, density)
    reason = unlike(compared.likeness, compared.damping_ratio)
    reason = reason or refusal(compared.bias, reduction)
    if reason:
        raise ReductionError(reason)
    poor = compared.warnings(reduction)
    integrals = span_integrals(beam, modes.section_pair()[0], count=1)
    soft = warping_warnings(beam, method)
    for text in (*beam.warnings, *soft, *poor, *validity_warnings(integrals)):
        warnings.warn(text, stacklevel=2)
    return section
