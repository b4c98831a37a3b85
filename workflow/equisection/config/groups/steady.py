"""Section ``steady``: polars of the section and of the rigid beam."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import EMPTY, Angle, Name


class Steady(KeyGroup):
    """Steady polars of the section and of the rigid beam."""

    incidence_deg: Annotated[tuple[Angle, ...], Field(min_length=4)] = Field(
        (0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0),
        description="Incidences (deg), ascending; different in their first six digits.",
    )
    resolution: Name = Field(
        "coarse", description="Resolution whose polars go into everything that follows."
    )
    study: tuple[Name, ...] = Field(
        (), description="Further resolutions for the grid study (Fig. 6)."
    )
    study_incidence_deg: tuple[Angle, ...] = Field(
        (),
        description="Incidences (deg) that the further resolutions are run at, some of "
        "`steady.incidence_deg`; empty for all of them.",
    )
    beam_polar: Annotated[str, EMPTY] = Field(
        "",
        description="Polar of the rigid beam (CSV file: incidence_deg, C_L, C_M, C_D), measured "
        "or computed elsewhere; the solver then runs no rigid beam. Empty to have it run.",
    )
    beam_polar_section: Annotated[str, EMPTY] = Field(
        "",
        description="Polar of the section that belongs to the one in `steady.beam_polar` (CSV "
        "file): on the same cells, or measured the same way. The correction is then the ratio of "
        "these two, and the beam's polar is carried over to the run's own section by it. Empty: "
        "the run's own section is divided by `steady.beam_polar`.",
    )


@check("steady.incidence_deg")
def _ascending(angles: tuple[float, ...]) -> Iterator[Problem]:
    for place, (lower, upper) in enumerate(itertools.pairwise(angles), start=1):
        key = f"steady.incidence_deg.{place}"
        if not upper > lower:
            yield Problem(key, upper, f"allowed is an angle above the one before it, {lower:g} deg")
        elif f"{upper:.6g}" == f"{lower:.6g}":
            yield Problem(
                key,
                upper,
                "allowed is an angle that differs from the one before it in the first six "
                f"digits, which name its files ({lower:.6g})",
            )


@check("steady.beam_polar_section", "steady.beam_polar")
def _section_with_its_beam(section: str, beam: str) -> Iterator[Problem]:
    if section and not beam:
        yield Problem(
            "steady.beam_polar_section",
            section,
            "allowed with steady.beam_polar, the polar of the beam that this section belongs to; "
            'or "", with which the run\'s own section is divided by its beam',
        )


@check("steady.study", "steady.resolution")
def _distinct(study: tuple[str, ...], resolution: str) -> Iterator[Problem]:
    names = [resolution, *study]
    for place, name in enumerate(study):
        if name in names[: place + 1]:
            yield Problem(
                f"steady.study.{place}",
                name,
                "allowed is a resolution that stands neither before it nor in steady.resolution",
            )


@check("steady.study_incidence_deg", "steady.incidence_deg")
def _of_the_polar(study_angles: tuple[float, ...], angles: tuple[float, ...]) -> Iterator[Problem]:
    for place, angle in enumerate(study_angles):
        key = f"steady.study_incidence_deg.{place}"
        if angle not in angles:
            allowed = ", ".join(f"{value:g}" for value in angles)
            yield Problem(key, angle, f"allowed is an angle of steady.incidence_deg: {allowed}")
        elif angle in study_angles[:place]:
            yield Problem(key, angle, "allowed is an angle that does not stand before it")
