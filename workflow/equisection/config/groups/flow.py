"""Section ``flow``: the fluid, its speed, the rigid incidence and the channel."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NULLABLE, NUMBER, Angle, NotNegative, Positive, Truth

#: Above this the flow is not incompressible any more.
LARGEST_MACH = 0.3


class Channel(KeyGroup):
    """The channel around the beam, in chords; its walls are slip walls."""

    height_chords: Annotated[float, Field(gt=1, le=1e6, allow_inf_nan=False), NUMBER] = Field(
        4.0,
        description="Distance of floor and ceiling H (chords); the beam is half way. Free air is "
        "`flow.channel: null`.",
    )
    tip_gap_chords: NotNegative = Field(
        0.3,
        description="Gap between the beam's far end and the side wall (chords); the root stands "
        "on the other wall. 0 for a beam that spans the channel. With `root_on_wall: false` "
        "the sum of the gaps at both ends.",
    )
    upstream_chords: Annotated[float, Field(ge=1, allow_inf_nan=False), NUMBER] = Field(
        5.0, description="Length upstream L_u (chords)."
    )
    downstream_chords: Annotated[float, Field(ge=2, allow_inf_nan=False), NUMBER] = Field(
        15.0, description="Length downstream L_d (chords)."
    )


class Flow(KeyGroup):
    """The fluid, its speed, the rigid incidence and the channel."""

    speed: Positive = Field(20.0, description="Speed V (m/s), up to Mach 0.3.")
    design_speed: Annotated[Positive | None, NULLABLE] = Field(
        None,
        description="Speed (m/s) that the beam has to withstand; the margin to it stands in "
        "`comparison/critical_speed.csv`. `null`: none is given.",
    )
    density: Positive = Field(1.18, description="Density rho (kg/m3).")
    dynamic_viscosity: Positive = Field(1.86e-5, description="Dynamic viscosity mu (Pa s).")
    sound_speed: Positive = Field(
        340.0, description="Speed of sound a (m/s); the flow is refused above Mach 0.3."
    )
    incidence_deg: Angle = Field(
        2.5,
        description="Rigid incidence theta_0 (deg), nose up; within `steady.incidence_deg`, and "
        "not 0 for a symmetric section, which nothing but `unsteady.start` would set in motion.",
    )
    root_on_wall: Truth = Field(
        True,
        description="Whether the root stands on a wall, which mirrors the flow: one of the "
        "channel's side walls or, in free air, a wall of its own. With `false` both ends "
        "stand free.",
    )
    channel: Annotated[Channel | None, NULLABLE] = Field(
        Channel(), description="The channel; `null` for free air."
    )


@check("flow.speed", "flow.sound_speed")
def _incompressible(speed: float, sound_speed: float) -> Iterator[Problem]:
    if speed > LARGEST_MACH * sound_speed:
        yield Problem(
            "flow.speed",
            speed,
            f"allowed is up to {LARGEST_MACH * sound_speed:g} m/s, Mach {LARGEST_MACH:g} "
            "(incompressible flow)",
        )
