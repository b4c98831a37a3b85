"""Section ``uncertainty``: half-ranges behind the interval of the critical speeds of a map."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NUMBER, NotNegative

KNOWN: Literal["known"] = "known"


def _shape(value: object) -> str:
    return "known" if value == KNOWN else "half-range"


_Part = Annotated[float, Field(ge=0, le=0.9, allow_inf_nan=False), NUMBER]
KnownOrPart = Annotated[
    Annotated[Literal["known"], Tag("known")] | Annotated[_Part, Tag("half-range")],
    Discriminator(_shape),
]
KnownOrNumber = Annotated[
    Annotated[Literal["known"], Tag("known")] | Annotated[NotNegative, Tag("half-range")],
    Discriminator(_shape),
]


class Uncertainty(KeyGroup):
    """Half-ranges of the inputs of a map of stability (`sweep.incidence_deg`)."""

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
    growth: KnownOrNumber = Field(
        KNOWN,
        description="Half-range of the growth of an oscillation (V/c). `known`: the root mean "
        "square of its known error against kept CFD (`growth_error_rms`). 0: not in the interval.",
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
