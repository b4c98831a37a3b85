"""Section ``beam``: the flexible beam and how it is held."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, get_args

from pydantic import Field

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NULLABLE, NUMBER, Positive

Boundary = Literal[
    "clamped-free",
    "clamped-clamped",
    "pinned-pinned",
    "clamped-pinned",
    "one-fork",
    "spring-root",
]
#: Boundaries whose far end moves freely, and so need a gap to the channel's wall.
FREE_TIP: frozenset[str] = frozenset({"clamped-free", "spring-root"})
#: Boundaries that a solid plate has no counterpart of.
NOT_OF_SOLID: frozenset[str] = frozenset({"one-fork", "spring-root"})


class CrossSection(KeyGroup):
    """What the beam's section is to bending and torsion, about axes at mid-chord."""

    bending_rigidity: Positive = Field(description="E I (N m2) of the deflection across the chord.")
    torsional_rigidity: Positive = Field(description="G J (N m2).")
    mass_per_length: Positive = Field(description="Mass m (kg/m).")
    inertia_per_length: Positive = Field(
        description="Polar moment of inertia about mid-chord (kg m2/m)."
    )


class Beam(KeyGroup):
    """The flexible beam, of constant section, and how it is held."""

    chord: Positive = Field(0.1, description="Chord c (m).")
    length: Positive = Field(0.37, description="Span L (m), longer than the chord.")
    thickness: Positive = Field(0.004, description="Thickness h (m), below half the chord.")
    youngs_modulus: Positive = Field(
        3.3e9,
        description="Young's modulus E (Pa) of the beam as given; the sweep scales all of its "
        "stiffness, root springs included.",
    )
    poisson_ratio: Annotated[float, Field(gt=-1, lt=0.5, allow_inf_nan=False), NUMBER] = Field(
        0.35, description="Poisson's ratio nu (-)."
    )
    density: Positive = Field(1180.0, description="Density rho_s (kg/m3).")
    boundary: Boundary = Field(
        "clamped-free",
        description="How the beam is held, root first. `pinned-pinned` has fork ends (no twist "
        "at either end), `one-fork` is pinned at both ends with the twist held at the root "
        "only, `spring-root` is held by the two root springs alone; these two need "
        "`structure.method` `beam` or `analytic`.",
    )
    root_torsional_stiffness: Annotated[Positive | None, NULLABLE] = Field(
        None,
        description="Stiffness of the root's torsional spring (N m/rad); needed with "
        "`spring-root`, and only there.",
    )
    root_bending_stiffness: Annotated[Positive | None, NULLABLE] = Field(
        None,
        description="Stiffness of the root's rotational spring in bending (N m/rad); needed "
        "with `spring-root`, and only there.",
    )
    cross_section: Annotated[CrossSection | None, NULLABLE] = Field(
        None,
        description="Rigidities and masses of a section that is no homogeneous rectangle, such as "
        "a bridge deck's; all four, in the place of what `thickness`, `youngs_modulus`, "
        "`poisson_ratio` and `density` make. `thickness` stays the body's in the flow. Needs "
        "`structure.method` `beam` or `analytic`.",
    )


@check("beam.thickness", "beam.chord")
def _thin(thickness: float, chord: float) -> Iterator[Problem]:
    if thickness >= chord / 2:
        yield Problem(
            "beam.thickness",
            thickness,
            f"allowed is a number above 0 and below half the chord, {chord / 2:g} m",
        )


@check("beam.length", "beam.chord")
def _slender(length: float, chord: float) -> Iterator[Problem]:
    if length <= chord:
        yield Problem(
            "beam.length", length, f"allowed is a number above the chord, beam.chord = {chord:g} m"
        )


@check("beam.boundary", "structure.method")
def _held_by_the_method(boundary: str, method: str) -> Iterator[Problem]:
    if method == "solid" and boundary in NOT_OF_SOLID:
        allowed = ", ".join(name for name in get_args(Boundary) if name not in NOT_OF_SOLID)
        yield Problem(
            "beam.boundary",
            boundary,
            f"allowed with structure.method 'solid' are {allowed}; or give structure.method: beam "
            "or analytic",
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


@check("beam.root_torsional_stiffness", "beam.boundary")
def _torsional_spring(stiffness: float | None, boundary: str) -> Iterator[Problem]:
    yield from _spring("beam.root_torsional_stiffness", stiffness, boundary)


@check("beam.root_bending_stiffness", "beam.boundary")
def _bending_spring(stiffness: float | None, boundary: str) -> Iterator[Problem]:
    yield from _spring("beam.root_bending_stiffness", stiffness, boundary)


def _spring(key: str, stiffness: float | None, boundary: str) -> Iterator[Problem]:
    if boundary == "spring-root" and stiffness is None:
        yield Problem(
            key,
            stiffness,
            "allowed is a number above 0 (N m/rad); with boundary 'spring-root' nothing else "
            "holds the root's rotation",
        )
    if boundary != "spring-root" and stiffness is not None:
        yield Problem(
            key, stiffness, f"allowed is null with boundary '{boundary}', which has no root spring"
        )
