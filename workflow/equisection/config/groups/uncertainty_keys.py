"""Section ``uncertainty``: half-ranges behind the interval of the critical speeds of a map."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NUMBER, NotNegative

KNOWN: Literal["known"] = "known"
USUAL: Literal["usual"] = "usual"


def _shape(value: object) -> str:
    return str(value) if value in (KNOWN, USUAL) else "half-range"


_Part = Annotated[float, Field(ge=0, le=0.9, allow_inf_nan=False), NUMBER]
_Chords = Annotated[float, Field(ge=0, le=0.5, allow_inf_nan=False), NUMBER]
KnownOrPart = Annotated[
    Annotated[Literal["known"], Tag("known")] | Annotated[_Part, Tag("half-range")],
    Discriminator(_shape),
]
UsualOrPart = Annotated[
    Annotated[Literal["usual"], Tag("usual")] | Annotated[_Part, Tag("half-range")],
    Discriminator(_shape),
]
KnownOrNumber = Annotated[
    Annotated[Literal["known"], Tag("known")] | Annotated[NotNegative, Tag("half-range")],
    Discriminator(_shape),
]


class Uncertainty(KeyGroup):
    """Half-ranges of the inputs of a map of stability (`sweep.incidence_deg`)."""

    mass: UsualOrPart = Field(
        USUAL,
        description="Half-range of the mass as a part of it (-). `usual`: 0.02, an assumption. "
        "0: not in the interval.",
    )
    inertia: UsualOrPart = Field(
        USUAL, description="The same for the moment of inertia about the elastic axis."
    )
    bending_stiffness: UsualOrPart = Field(
        USUAL,
        description="Half-range of the bending stiffness as a part of it (-). `usual`: 0.03, the "
        "coefficient of variation of E of rolled steel (JCSS Probabilistic Model Code, 2001); "
        "other materials, joints and what holds the beam vary more. 0: not in the interval.",
    )
    torsional_stiffness: UsualOrPart = Field(
        USUAL, description="The same for the torsional stiffness."
    )
    mass_axis: _Chords = Field(
        0.0,
        description="Half-range of the place of the centre of mass (chords), inertia about the "
        "elastic axis kept. 0: not in the interval.",
    )
    elastic_axis: _Chords = Field(0.0, description="The same for the elastic axis.")
    damping: Annotated[float, Field(ge=0, le=0.5, allow_inf_nan=False), NUMBER] = Field(
        0.0,
        description="Half-range of `beam.damping.bending` and `beam.damping.torsion` (of critical, "
        "not below zero damping). 0: not in the interval.",
    )
    lags: KnownOrPart = Field(
        KNOWN,
        description="Half-range of each lag in `embedded.separation` as a part of it (-). `known`: "
        "what the choice of releases makes of the default lags on the default polar, nothing for "
        "others. 0: not in the interval.",
    )
    lift: KnownOrPart = Field(
        KNOWN,
        description="Half-range of c_l of the polar as a part of it (-). `known`: what the mesh "
        "makes of the default polar, nothing for others. 0: not in the interval.",
    )
    moment: KnownOrPart = Field(KNOWN, description="The same for c_m.")
    drag: _Part = Field(
        0.0, description="Half-range of c_d as a part of it (-). 0: not in the interval."
    )
    density: _Part = Field(
        0.0,
        description="Half-range of the fluid's density as a part of it (-); of air from -10 to "
        "30 deg C 0.07. 0: not in the interval.",
    )
    growth: KnownOrNumber = Field(
        KNOWN,
        description="Half-range of the growth of an oscillation (V/c). `known`: the root mean "
        "square of its known error against kept CFD (`growth_error_rms`). 0: not in the interval.",
    )
    mesh: KnownOrPart = Field(
        KNOWN,
        description="Half-range of the critical speed itself, as a part of it (-), by the strips "
        "and modes of a beam. `known`: how far half the strips, and one mode of each kind less, "
        "move it. 0: not in the interval.",
    )


@check("uncertainty", "sweep.incidence_deg")
def _of_a_map(given: Uncertainty, incidence_deg: tuple[float, ...]) -> Iterator[Problem]:
    if incidence_deg:
        return
    for name in type(given).model_fields:
        value = getattr(given, name)
        if value != getattr(Uncertainty(), name):
            yield Problem(
                f"uncertainty.{name}",
                value,
                "allowed is the default without sweep.incidence_deg: only a map of stability has "
                "this interval",
            )
