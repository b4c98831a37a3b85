"""Supports, springs, dashpots and lumped masses along the span of a beam.

Both are keys of the configuration, in SI units. A support holds or springs the deflection of the
elastic axis and the twist at one place; it leaves the slope of the deflection free. Its springs are
at rest in still air under dead load.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NotNegative, Number, Positive

Hold = Literal["free", "fixed"]
#: Part of the span below which two places are one.
_ONE_PLACE = 1e-6


class Fitting(KeyGroup):
    """Place along the span."""

    at: Number = Field(
        description="Place as a part of the span z/L (-): 0 at the root, 1 at the tip."
    )


class Support(Fitting):
    """One support along the span."""

    deflection: Hold = Field(
        "free", description="`fixed` holds the deflection of the elastic axis."
    )
    twist: Hold = Field("free", description="`fixed` holds the twist.")
    deflection_stiffness: NotNegative = Field(
        0.0, description="Spring of the deflection (N/m) where that is free."
    )
    twist_stiffness: NotNegative = Field(
        0.0, description="Spring of the twist (N m/rad) where that is free."
    )
    deflection_damping: NotNegative = Field(
        0.0, description="Dashpot of the deflection (N s/m) where that is free."
    )
    twist_damping: NotNegative = Field(
        0.0, description="Dashpot of the twist (N m s/rad) where that is free."
    )

    @property
    def restrains_deflection(self) -> bool:
        """Presence of a spring or a fixing of the deflection."""
        return self.deflection == "fixed" or self.deflection_stiffness > 0.0

    @property
    def restrains_twist(self) -> bool:
        """Presence of a spring or a fixing of the twist."""
        return self.twist == "fixed" or self.twist_stiffness > 0.0


class Lump(Fitting):
    """One lumped mass: a motor, a tip store, a joint."""

    mass: Positive = Field(description="Mass M (kg).")
    inertia_about_centre: NotNegative = Field(
        0.0, description="Moment of inertia about its own centre of mass, of the twist (kg m2)."
    )
    behind_axis: Number = Field(
        0.0,
        description="Distance of its centre of mass behind the elastic axis (m); negative is in "
        "front of it.",
    )

    @property
    def inertia_about_axis(self) -> float:
        """Moment of inertia about the elastic axis (kg m^2): I + M d^2 (Steiner)."""
        return self.inertia_about_centre + self.mass * self.behind_axis**2

    @property
    def imbalance(self) -> float:
        """Static imbalance M d about the elastic axis (kg m)."""
        return self.mass * self.behind_axis


def _places(key: str, given: tuple[Fitting, ...]) -> Iterator[Problem]:
    """Refuse places beyond the span, and two at one place."""
    for number, one in enumerate(given):
        name = f"{key}.{number}.at"
        if not 0.0 <= one.at <= 1.0:
            yield Problem(
                name, one.at, "allowed is a number from 0 (root) to 1 (tip), a part of the span"
            )
        for before, other in enumerate(given[:number]):
            if abs(one.at - other.at) < _ONE_PLACE:
                yield Problem(
                    name,
                    one.at,
                    f"allowed is another place than that of {key}.{before}; make one entry of both",
                )


@check("beam.lumps")
def _places_of_lumps(lumps: tuple[Lump, ...]) -> Iterator[Problem]:
    yield from _places("beam.lumps", lumps)


@check("beam.supports")
def _supports_alone(supports: tuple[Support, ...]) -> Iterator[Problem]:
    yield from _places("beam.supports", supports)
    for number, support in enumerate(supports):
        for motion in ("deflection", "twist"):
            if getattr(support, motion) != "fixed":
                continue
            for kind in ("stiffness", "damping"):
                value = getattr(support, f"{motion}_{kind}")
                if value:
                    yield Problem(
                        f"beam.supports.{number}.{motion}_{kind}",
                        value,
                        f"allowed is 0 where {motion} is 'fixed', which does not move; or give "
                        f"{motion}: free",
                    )
        if support == Support(at=support.at):
            yield Problem(
                f"beam.supports.{number}",
                {"at": support.at},
                "allowed is a support that fixes, springs or damps the deflection or the twist",
            )
