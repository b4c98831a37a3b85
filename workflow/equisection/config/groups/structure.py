"""Section ``structure``: computation of the modes."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from equisection.beam.beam import BOUNDARIES, BY_SUPPORTS, MID_CHORD, CrossSection
from equisection.beam.supports import Lump, Support
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import WHOLE
from equisection.structure.slenderness import most_slender

#: Boundaries that a solid plate has no counterpart of.
NOT_OF_SOLID: frozenset[str] = frozenset({"one-fork", "spring-root"})

Modes = Annotated[int, Field(ge=1, le=12), WHOLE]


class Elements(KeyGroup):
    """Number of quadratic elements in each direction."""

    chord: Annotated[int, Field(ge=1, le=400), WHOLE] = Field(
        24, description="Elements along the chord (-)."
    )
    span: Annotated[int, Field(ge=2, le=4000), WHOLE] = Field(
        89, description="Elements along the span (-)."
    )
    thickness: Annotated[int, Field(ge=1, le=20), WHOLE] = Field(
        1, description="Elements through the thickness (-)."
    )


class Structure(KeyGroup):
    """Computation of the modes."""

    method: Literal["solid", "beam", "analytic"] = Field(
        "solid",
        description="`solid`: three-dimensional elasticity; `beam`: one-dimensional beam "
        "elements; `analytic`: closed form.",
    )
    elements: Elements = Field(
        Elements(),
        description="The mesh (`beam` and `analytic` use `span` alone).",
    )
    bending_modes: Modes = Field(4, description="Bending modes used (-).")
    torsion_modes: Modes = Field(4, description="Torsion modes used (-).")
    mesh_study: Annotated[tuple[Elements, ...], Field(min_length=1)] = Field(
        (
            Elements(chord=4, span=15, thickness=1),
            Elements(chord=8, span=30, thickness=1),
            Elements(chord=12, span=44, thickness=1),
        ),
        description="Coarser meshes of the mesh study (Table 2), coarsest first.",
    )


@check("structure.mesh_study")
def _finer_and_finer(meshes: tuple[Elements, ...]) -> Iterator[Problem]:
    for place, (coarse, fine) in enumerate(itertools.pairwise(meshes), start=1):
        if any(getattr(fine, key) < getattr(coarse, key) for key in Elements.model_fields):
            yield Problem(
                f"structure.mesh_study.{place}",
                fine.model_dump(),
                "allowed is a mesh with no fewer elements in any direction than the one before",
            )


@check(
    *("beam.thickness", "beam.length", "structure.method"),
    *("structure.elements", "structure.mesh_study"),
)
def _thick_enough(
    thickness: float, length: float, method: str, elements: Elements, study: tuple[Elements, ...]
) -> Iterator[Problem]:
    """Refuse a plate whose modes by solid elements would be rounding."""
    most = most_slender(max(mesh.thickness for mesh in (elements, *study)))
    if method == "solid" and length > most * thickness:
        yield Problem(
            "beam.thickness",
            thickness,
            f"allowed with structure.method 'solid' is {length / most:.3g} m or more, 1/{most:.0f} "
            "of the length: rounding decides the modes of a thinner one; or give "
            "structure.method: beam",
        )


@check("beam.boundary", "structure.method")
def _held_by_the_method(boundary: str, method: str) -> Iterator[Problem]:
    if method == "solid" and boundary in NOT_OF_SOLID:
        allowed = ", ".join(name for name in BOUNDARIES if name not in NOT_OF_SOLID)
        yield Problem(
            "beam.boundary",
            boundary,
            f"allowed with structure.method 'solid' are {allowed}; or give structure.method: beam "
            "or analytic",
        )


@check("beam.elastic_axis", "beam.mass_axis", "structure.method")
def _axes_by_the_method(elastic_axis: float, mass_axis: float, method: str) -> Iterator[Problem]:
    for key, place in (("beam.elastic_axis", elastic_axis), ("beam.mass_axis", mass_axis)):
        if method == "solid" and 0.0 <= place <= 1.0 and place != MID_CHORD:
            yield Problem(
                key,
                place,
                f"allowed with structure.method 'solid' is {MID_CHORD:g}, where a homogeneous "
                "plate has its axes; or give structure.method: beam or analytic",
            )


@check("beam.supports", "beam.lumps", "beam.boundary", "structure.method")
def _fittings_by_the_method(
    supports: tuple[Support, ...], lumps: tuple[Lump, ...], boundary: str, method: str
) -> Iterator[Problem]:
    if method != "beam" and (supports or lumps or boundary == BY_SUPPORTS):
        yield Problem(
            "structure.method",
            method,
            "allowed with beam.supports, beam.lumps or boundary 'supports' is beam; the others "
            "hold a beam at its ends alone",
        )


@check("beam.cross_section", "structure.method")
def _section_by_the_method(given: CrossSection | None, method: str) -> Iterator[Problem]:
    if method == "solid" and given is not None:
        yield Problem(
            "structure.method",
            method,
            "allowed with beam.cross_section are beam and analytic; 'solid' meshes a homogeneous "
            "plate",
        )
