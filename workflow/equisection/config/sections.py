"""Sections of the configuration: one model each, every default the paper's case.

Units stand in the description of each key; a name without a unit suffix is SI.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Annotated, Literal

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    field_validator,
    model_validator,
)

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$")]

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

ModelName = Literal[
    "2d",
    "2d-corrected",
    "3d",
    "2d-paper",
    "2d-corrected-paper",
    "2d-consistent",
    "2d-corrected-consistent",
]


class Section(BaseModel):
    """Base of all sections: no unknown keys, nothing changed after validation."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=False)


class Beam(Section):
    """The flexible beam: a plate of rectangular section, and how it is held."""

    chord: Positive = Field(0.1, description="Chord c (m).")
    length: Positive = Field(0.37, description="Span L (m).")
    thickness: Positive = Field(0.004, description="Thickness h (m).")
    youngs_modulus: Positive = Field(
        3.3e9, description="Young's modulus E (Pa) of the reference beam; the sweep scales it."
    )
    poisson_ratio: float = Field(0.35, gt=-1.0, lt=0.5, description="Poisson's ratio nu.")
    density: Positive = Field(1180.0, description="Density rho_s (kg/m3).")
    boundary: Boundary = Field(
        "clamped-free",
        description="How the beam is held. `pinned-pinned` has fork ends (no twist at either "
        "end), `one-fork` is pinned at both ends with the twist held at the root only, "
        "`spring-root` is held by the two root springs alone.",
    )
    root_torsional_stiffness: Positive | None = Field(
        None, description="Stiffness of the root's torsional spring (N m/rad); `spring-root` only."
    )
    root_bending_stiffness: Positive | None = Field(
        None,
        description="Stiffness of the root's rotational spring in bending (N m/rad); "
        "`spring-root` only.",
    )

    @field_validator("poisson_ratio")
    @classmethod
    def _finite(cls, value: float) -> float:
        if not math.isfinite(value):
            raise ValueError("must be finite")
        return value

    @model_validator(mode="after")
    def _slender(self) -> Beam:
        if self.thickness >= self.chord / 2:
            raise ValueError(
                f"thickness: {self.thickness:g} m is not thin for a chord of {self.chord:g} m; "
                "a plate thinner than half its chord is allowed"
            )
        if self.length <= self.chord:
            raise ValueError(
                f"length: {self.length:g} m is not a beam for a chord of {self.chord:g} m; "
                "a span longer than the chord is allowed"
            )
        springs = {
            "root_torsional_stiffness": self.root_torsional_stiffness,
            "root_bending_stiffness": self.root_bending_stiffness,
        }
        for key, value in springs.items():
            if self.boundary == "spring-root" and value is None:
                raise ValueError(
                    f"{key}: missing; boundary 'spring-root' has no rotational restraint "
                    "without it, a positive stiffness (N m/rad) is needed"
                )
            if self.boundary != "spring-root" and value is not None:
                raise ValueError(
                    f"{key}: {value:g} has no meaning with boundary '{self.boundary}'; "
                    "allowed with 'spring-root' only"
                )
        return self


class Channel(Section):
    """The channel around the beam, in chords; its walls are slip walls."""

    height_chords: Annotated[float, Field(gt=1.0, allow_inf_nan=False)] = Field(
        4.0, description="Distance of floor and ceiling H (chords)."
    )
    tip_gap_chords: NotNegative = Field(
        0.3,
        description="Gap between the beam's far end and the side wall (chords); the root "
        "stands on the other wall. 0 for a beam that spans the channel.",
    )
    upstream_chords: Annotated[float, Field(ge=1.0, allow_inf_nan=False)] = Field(
        5.0, description="Length upstream L_u (chords)."
    )
    downstream_chords: Annotated[float, Field(ge=2.0, allow_inf_nan=False)] = Field(
        15.0, description="Length downstream L_d (chords)."
    )


class Flow(Section):
    """The fluid, its speed, the rigid incidence and the channel."""

    speed: Positive = Field(20.0, description="Speed V (m/s).")
    density: Positive = Field(1.18, description="Density rho (kg/m3).")
    dynamic_viscosity: Positive = Field(1.86e-5, description="Dynamic viscosity mu (Pa s).")
    sound_speed: Positive = Field(340.0, description="Speed of sound a (m/s).")
    incidence_deg: float = Field(
        2.5, gt=-90, lt=90, description="Rigid incidence theta_0 (deg), nose up."
    )
    root_on_wall: bool = Field(
        True,
        description="Whether the root stands on a wall, which mirrors the flow. In a channel it "
        "is one of the side walls; without, the beam ends in free air.",
    )
    channel: Channel | None = Field(
        default_factory=Channel, description="The channel; `null` for free air."
    )

    @model_validator(mode="after")
    def _incompressible(self) -> Flow:
        mach = self.speed / self.sound_speed
        if mach > 0.3:
            raise ValueError(
                f"speed: {self.speed:g} m/s is Mach {mach:.2f}; "
                "up to Mach 0.3 is allowed (incompressible flow)"
            )
        return self


class Elements(Section):
    """Number of quadratic elements in each direction."""

    chord: int = Field(24, ge=1, le=400, description="Elements along the chord.")
    span: int = Field(89, ge=2, le=4000, description="Elements along the span.")
    thickness: int = Field(2, ge=1, le=20, description="Elements through the thickness.")


class Structure(Section):
    """Mode computation."""

    method: Literal["solid", "beam", "analytic"] = Field(
        "solid",
        description="`solid`: three-dimensional elasticity; `beam`: one-dimensional beam "
        "elements; `analytic`: closed form.",
    )
    elements: Elements = Field(
        default_factory=Elements,
        description="The mesh (beam elements use `span` alone).",
    )
    bending_modes: int = Field(4, ge=1, le=12, description="Bending modes used.")
    torsion_modes: int = Field(4, ge=1, le=12, description="Torsion modes used.")
    mesh_study: tuple[Elements, ...] = Field(
        (
            Elements(chord=4, span=15, thickness=1),
            Elements(chord=8, span=30, thickness=1),
            Elements(chord=12, span=44, thickness=1),
        ),
        description="Coarser meshes of the mesh study (Table 2), coarsest first.",
    )


class Steady(Section):
    """Steady polars of the section and of the rigid beam."""

    incidence_deg: tuple[float, ...] = Field(
        (0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0),
        min_length=4,
        description="Incidences (deg), ascending.",
    )
    resolution: Name = Field(
        "coarse", description="Resolution whose polars go into everything that follows."
    )
    study: tuple[Name, ...] = Field(
        (), description="Further resolutions for the grid study (Fig. 6)."
    )

    @field_validator("incidence_deg")
    @classmethod
    def _ascending(cls, angles: tuple[float, ...]) -> tuple[float, ...]:
        for lower, upper in zip(angles, angles[1:], strict=False):
            if not upper > lower:
                raise ValueError(f"{upper:g} follows {lower:g}; ascending angles are allowed")
        if not all(-90 < angle < 90 for angle in angles):
            raise ValueError("angles between -90 and 90 deg are allowed")
        return angles

    @model_validator(mode="after")
    def _distinct(self) -> Steady:
        names = (self.resolution, *self.study)
        if len(set(names)) != len(names):
            raise ValueError(
                f"study: {list(self.study)} repeats a resolution; each once is allowed"
            )
        return self


class Range(Section):
    """Evenly spaced values, both ends included."""

    start: Positive = Field(description="First value.")
    stop: Positive = Field(description="Last value.")
    number: int = Field(ge=2, le=20000, description="How many values.")

    @model_validator(mode="after")
    def _ordered(self) -> Range:
        if not self.stop > self.start:
            raise ValueError(f"stop: {self.stop:g} is not above start {self.start:g}")
        return self


def _shape_of_k_star(value: object) -> str:
    return "range" if isinstance(value, dict | Range) else "list"


KStar = Annotated[
    Annotated[tuple[Positive, ...], Tag("list")] | Annotated[Range, Tag("range")],
    Discriminator(_shape_of_k_star),
]


class Sweep(Section):
    """The sweep over the non-dimensional torsional stiffness k*."""

    k_star: KStar = Field(
        (4.0, 4.5, 5.0, 5.5, 6.0, 6.44, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 18.0, 21.0),
        description="Values of k* = k_theta/(q c^2): a list, or `start`, `stop` and `number`.",
    )
    models: tuple[ModelName, ...] = Field(
        ("2d", "2d-corrected", "3d", "2d-paper", "2d-corrected-paper"),
        min_length=1,
        description="Models to run. `2d` and `2d-corrected` use the chosen `reduction`; with "
        "the ending `-paper` or `-consistent` they use that one.",
    )
    onset: Literal["sweep", "refine"] = Field(
        "sweep",
        description="`refine` runs further k* inside the bracket of the onset of each model "
        "until it is narrower than `onset_tolerance`.",
    )
    onset_tolerance: Positive = Field(
        0.02, description="Width of the onset's bracket, relative to its unstable k*."
    )
    onset_points: int = Field(
        3, ge=1, le=50, description="Values of k* that one round of refinement runs at once."
    )

    @field_validator("k_star")
    @classmethod
    def _distinct(cls, value: tuple[float, ...] | Range) -> tuple[float, ...] | Range:
        if isinstance(value, Range):
            return value
        if not value:
            raise ValueError("empty; at least one k* is needed")
        counts = Counter(f"{k:.6g}" for k in value)
        doubled = [name for name, count in counts.items() if count > 1]
        if doubled:
            raise ValueError(f"{', '.join(doubled)} stands twice; each k* once is allowed")
        return value

    @field_validator("models")
    @classmethod
    def _once(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        if len(set(value)) != len(value):
            raise ValueError("a model stands twice; each once is allowed")
        return value

    def values(self) -> tuple[float, ...]:
        """Return the values of k*, ascending."""
        if isinstance(self.k_star, Range):
            step = (self.k_star.stop - self.k_star.start) / (self.k_star.number - 1)
            return tuple(self.k_star.start + step * n for n in range(self.k_star.number))
        return tuple(sorted(self.k_star))


class Verdict(Section):
    """When an unsteady run ends, and what it is called; amplitudes are those of the tip."""

    settled_amplitude_deg: Positive = Field(
        0.05, description="Twist amplitude (deg) below which a run has settled."
    )
    growing_amplitude_deg: Positive = Field(
        6.0, description="Twist amplitude (deg) beyond which a run is growing, and ends."
    )
    steadiness: Annotated[float, Field(gt=0, lt=0.5)] = Field(
        0.02, description="Relative change of amplitude that a limit cycle may still have."
    )
    periods: int = Field(5, ge=2, le=50, description="Periods that a verdict rests on.")

    @model_validator(mode="after")
    def _ordered(self) -> Verdict:
        if self.growing_amplitude_deg <= self.settled_amplitude_deg:
            raise ValueError(
                f"growing_amplitude_deg: {self.growing_amplitude_deg:g} is not above "
                f"settled_amplitude_deg {self.settled_amplitude_deg:g}"
            )
        return self


class Unsteady(Section):
    """Runs of the free section and of the free beam, from the rigid steady state."""

    duration: Positive = Field(400.0, description="The longest a run may take (c/V).")
    time_step: Positive = Field(0.05, description="Time step (c/V).")
    output_interval: Positive = Field(0.1, description="Interval of the stored history (c/V).")
    verdict: Verdict = Field(default_factory=Verdict, description="How a run is judged.")

    @model_validator(mode="after")
    def _steps(self) -> Unsteady:
        if self.duration < 10 * self.output_interval:
            raise ValueError(
                f"duration: {self.duration:g} c/V is shorter than ten output intervals"
            )
        if self.output_interval < self.time_step * (1 - 1e-9):
            raise ValueError(
                f"output_interval: {self.output_interval:g} c/V is below the time step "
                f"{self.time_step:g} c/V"
            )
        ratio = self.output_interval / self.time_step
        if abs(ratio - round(ratio)) > 1e-6 * ratio:
            raise ValueError(
                f"output_interval: {self.output_interval:g} c/V is not a multiple of the time "
                f"step {self.time_step:g} c/V"
            )
        return self


class Separation(Section):
    """Lags of the separation bubble (c/V); the defaults are identified from CFD histories."""

    relaxation: NotNegative = Field(2.86, description="tau_1 of the bubble (c/V).")
    delay: float = Field(1.10, allow_inf_nan=False, description="tau_2 of the bubble (c/V).")
    lift_lag: NotNegative = Field(0.84, description="tau_3 of the lift behind the bubble (c/V).")


class Embedded(Section):
    """The embedded solver."""

    polars: dict[Name, str] = Field(
        default_factory=lambda: {"coarse": "config/polars/plate_2d_10398.csv"},
        min_length=1,
        description="Section polar of each resolution: a CSV file (`incidence_deg,cl,cm,cd`; "
        "path from the working directory) or `flat-plate` for the thin analytic plate.",
    )
    symmetric: bool = Field(
        True, description="The files hold non-negative incidences of a symmetric section."
    )
    separation: Separation = Field(
        default_factory=Separation, description="Lags of the separation bubble."
    )
    strips: int = Field(20, ge=4, le=100, description="Strips along the span.")
