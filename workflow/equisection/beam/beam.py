"""The beam: a flat plate or a given cross-section, and the supports of its two ends.

It is also the section ``beam`` of the configuration: its members are the keys, in SI units. It is
homogeneous, of a rectangular section, unless ``cross_section`` gives another. Elastic axis and mass
axis are parallel lines along the span, each at a part of the chord.

Each boundary is a pair of end conditions for bending and one for torsion. A *fork* holds the
deflection and the twist of a section and leaves its bending slope free. A pinned end is a fork,
since otherwise nothing would restrain the twist.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, get_args

from pydantic import Field, JsonValue, ValidationInfo, model_validator

from equisection.beam.outline_keys import OutlineKeys
from equisection.beam.supports import Lump, Support
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.group_file import read_group
from equisection.keys.values import NULLABLE, NUMBER, Number, Positive

if TYPE_CHECKING:
    from equisection.beam.outline import Outline

Boundary = Literal[
    "clamped-free",
    "clamped-clamped",
    "pinned-pinned",
    "clamped-pinned",
    "one-fork",
    "spring-root",
    "supports",
]
#: Boundary of a beam with both ends free, held by ``supports`` alone.
BY_SUPPORTS: Boundary = "supports"
#: Boundaries that hold the beam at its ends, by name.
BOUNDARIES: tuple[Boundary, ...] = tuple(b for b in get_args(Boundary) if b != BY_SUPPORTS)

BendingEnd = Literal["clamped", "pinned", "free", "spring"]
TorsionEnd = Literal["fixed", "free", "spring"]

_Ends = tuple[tuple[BendingEnd, BendingEnd], tuple[TorsionEnd, TorsionEnd]]
#: Names of lists of two supports, root and tip: end conditions of bending, then of twist.
_ENDS: dict[str, _Ends] = {
    "clamped-free": (("clamped", "free"), ("fixed", "free")),
    "clamped-clamped": (("clamped", "clamped"), ("fixed", "fixed")),
    "pinned-pinned": (("pinned", "pinned"), ("fixed", "fixed")),
    "clamped-pinned": (("clamped", "pinned"), ("fixed", "fixed")),
    "one-fork": (("pinned", "pinned"), ("fixed", "free")),
    "spring-root": (("spring", "free"), ("spring", "free")),
    "supports": (("free", "free"), ("free", "free")),
}

#: Boundaries whose far end moves freely, and so need a gap to the channel's wall.
FREE_TIP: frozenset[str] = frozenset({"clamped-free", "spring-root", BY_SUPPORTS})
#: h/c up to which a rectangle is a thin strip: its G J is then 6 % too large.
_THIN = 0.1


#: What a place along the chord may be, for the schema; :func:`_axes` refuses others.
_PLACE: dict[str, JsonValue] = {"minimum": 0, "maximum": 1}
MID_CHORD = 0.5

DampingRatio = Annotated[float, Field(ge=0, lt=0.2, allow_inf_nan=False), NUMBER]


class Damping(KeyGroup):
    """Structural damping: viscous, the same part of critical in each mode of a kind."""

    bending: DampingRatio = Field(
        0.0, description="Damping ratio zeta_w of the bending modes (of critical)."
    )
    torsion: DampingRatio = Field(
        0.0, description="Damping ratio zeta_theta of the torsion modes (of critical)."
    )


class CrossSection(KeyGroup):
    """Rigidities, mass and inertia of the beam's section, about its elastic axis."""

    bending_rigidity: Positive = Field(description="E I (N m2) of the deflection across the chord.")
    torsional_rigidity: Positive = Field(description="G J (N m2).")
    mass_per_length: Positive = Field(description="Mass m (kg/m).")
    inertia_per_length: Positive = Field(
        description="Polar moment of inertia about the elastic axis (kg m2/m), I_cg + m d2 with "
        "the distance d between the axes."
    )


class Beam(KeyGroup):
    """The flexible beam of constant section, and its supports."""

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
        "`structure.method` `beam` or `analytic`. `supports` leaves both ends free: "
        "`beam.supports` alone hold the beam.",
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
    elastic_axis: Number = Field(
        MID_CHORD,
        json_schema_extra=_PLACE,
        description="Place of the elastic axis, about which the section turns and whose deflection "
        "is w (x/c from the leading edge).",
    )
    mass_axis: Number = Field(
        MID_CHORD,
        json_schema_extra=_PLACE,
        description="Place of the centre of mass (x/c from the leading edge); that of a "
        "homogeneous rectangle is at mid-chord.",
    )
    damping: Damping = Field(Damping(), description="Structural damping.")
    supports: tuple[Support, ...] = Field(
        (),
        description="Supports, springs and dashpots along the span, beside what `boundary` holds; "
        "needs `structure.method: beam`. The sweep scales their springs with the beam's own "
        "stiffness, and dashpots with its square root: the same beam at another speed.",
    )
    lumps: tuple[Lump, ...] = Field(
        (), description="Lumped masses along the span; needs `structure.method: beam`."
    )
    outline: Annotated[OutlineKeys | None, NULLABLE] = Field(
        None,
        description="Outline of the section in the flow, which OpenFOAM meshes; `null` is the "
        "rectangle of `thickness`. The embedded solver knows a section by its polars alone.",
    )

    @model_validator(mode="after")
    def _agree(self, info: ValidationInfo) -> Beam:
        self.require_agreement("beam", info)
        return self

    @classmethod
    def from_yaml(cls, path: Path | str) -> Beam:
        """Read the section ``beam`` of a configuration file; keys that it lacks are defaults.

        Raises
        ------
        ConfigError
            The file has no section ``beam`` or cannot be read, or one line for each problem.
        """
        return read_group(Path(path), "beam", cls)

    def outline_in_flow(self, directory: Path = Path()) -> Outline | None:
        """Return the outline in the flow; None for the rectangle of ``thickness``.

        Parameters
        ----------
        directory
            Folder that the outline's file is seen from.

        Raises
        ------
        OutlineError
            The file cannot be read, or the outline not be used.
        """
        if self.outline is None:
            return None
        return self.outline.outline(self.chord, self.thickness, self.elastic_axis, directory)

    @property
    def input_files(self) -> list[str]:
        """Files that decide the beam."""
        return [self.outline.file] if self.outline is not None and self.outline.file else []

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + nu)) (Pa), below Eq. 4."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def second_moment(self) -> float:
        """I = c h^3/12 (m^4), below Eq. 4."""
        return self.chord * self.thickness**3 / 12.0

    @property
    def torsion_constant(self) -> float:
        """J = c h^3/3 (m^4), the thin-strip limit below Eq. 4; see `torsion_series_factor`."""
        return self.chord * self.thickness**3 / 3.0

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings where formulas of a thin strip do not hold; none with a ``cross_section``."""
        ratio = self.thickness / self.chord
        if self.cross_section is not None or ratio <= _THIN:
            return ()
        return (
            f"h/c = {ratio:.3g} is above {_THIN:g}: of a thin strip, as which the beam is taken, "
            f"G J is {100 * (1 / torsion_series_factor(ratio) - 1):.1f} % too large and the moment "
            f"of inertia {100 * (1 - 1 / (1 + ratio**2)):.1f} % too small; give the section as it "
            "is (beam.cross_section)",
        )

    @property
    def bending_rigidity(self) -> float:
        """E I (N m^2)."""
        if self.cross_section is not None:
            return self.cross_section.bending_rigidity
        return self.youngs_modulus * self.second_moment

    @property
    def torsional_rigidity(self) -> float:
        """G J (N m^2)."""
        if self.cross_section is not None:
            return self.cross_section.torsional_rigidity
        return self.shear_modulus * self.torsion_constant

    @property
    def mass_per_length(self) -> float:
        """rho_s c h (kg/m), Eq. 5."""
        if self.cross_section is not None:
            return self.cross_section.mass_per_length
        return self.density * self.chord * self.thickness

    @property
    def inertia_per_length(self) -> float:
        """Polar inertia I about the elastic axis (kg m^2/m).

        That of a rectangle is rho_s c^3 h/12, Eq. 5 (h^2 is neglected), and m d^2 (Steiner).
        """
        if self.cross_section is not None:
            return self.cross_section.inertia_per_length
        about_centre = self.density * self.chord**3 * self.thickness / 12.0
        return about_centre + self.mass_per_length * self.axes_apart**2

    @property
    def axes_apart(self) -> float:
        """Distance d of the centre of mass behind the elastic axis (m)."""
        return (self.mass_axis - self.elastic_axis) * self.chord

    @property
    def imbalance_per_length(self) -> float:
        """Static imbalance S = m d (kg), positive with the centre of mass behind the axis."""
        return self.mass_per_length * self.axes_apart

    @property
    def axes_in_words(self) -> str:
        """Places of both axes, for people to read them back."""
        return (
            f"elastic axis at {_percent(self.elastic_axis)} and centre of mass at "
            f"{_percent(self.mass_axis)} of the chord"
        )

    @property
    def bending_ends(self) -> tuple[BendingEnd, BendingEnd]:
        """End conditions of bending at root and tip."""
        return _ENDS[self.boundary][0]

    @property
    def torsion_ends(self) -> tuple[TorsionEnd, TorsionEnd]:
        """End conditions of twist at root and tip."""
        return _ENDS[self.boundary][1]

    @property
    def has_fittings(self) -> bool:
        """Presence of supports or lumped masses along the span, or of nothing else to hold it."""
        return bool(self.supports or self.lumps) or self.boundary == BY_SUPPORTS

    @property
    def has_imbalance(self) -> bool:
        """Presence of a static imbalance, of the section or of a lumped mass."""
        return self.imbalance_per_length != 0.0 or any(lump.imbalance for lump in self.lumps)


def torsion_series_factor(thickness_over_chord: float) -> float:
    """Saint-Venant's exact J of a rectangle divided by c h^3/3 (-), for the record.

    1 - (192/pi^5)(h/c) sum over odd n of tanh(n pi c/2h)/n^5 (Timoshenko and Goodier,
    Theory of Elasticity, art. 109): 0.975 for h/c = 0.04. The paper's J is kept so that
    Eq. 17 is its own; three-dimensional elasticity needs neither.
    """
    ratio = thickness_over_chord
    total = sum(math.tanh(n * math.pi / (2.0 * ratio)) / n**5 for n in range(1, 40, 2))
    return 1.0 - 192.0 / math.pi**5 * ratio * total


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


@check("beam.outline", "beam.cross_section")
def _structure_of_an_outline(
    outline: OutlineKeys | None, given: CrossSection | None
) -> Iterator[Problem]:
    """Refuse to take the structure of another shape for that of a homogeneous rectangle."""
    if outline is not None and given is None and (outline.naca or outline.file):
        yield Problem(
            "beam.cross_section",
            given,
            "allowed with beam.outline are rigidities and masses of the section: without them the "
            "structure would be that of a homogeneous rectangle of beam.thickness",
        )


@check("beam.root_torsional_stiffness", "beam.boundary")
def _torsional_spring(stiffness: float | None, boundary: str) -> Iterator[Problem]:
    yield from _spring("beam.root_torsional_stiffness", stiffness, boundary)


@check("beam.root_bending_stiffness", "beam.boundary")
def _bending_spring(stiffness: float | None, boundary: str) -> Iterator[Problem]:
    yield from _spring("beam.root_bending_stiffness", stiffness, boundary)


@check("beam.supports", "beam.boundary")
def _restrained(supports: tuple[Support, ...], boundary: str) -> Iterator[Problem]:
    """Refuse a beam that can turn or swing as a rigid body, and what an end holds already."""
    bending, torsion = _ENDS[boundary]
    if boundary == BY_SUPPORTS:
        held = sum(support.restrains_deflection for support in supports)
        if held < 2:
            yield Problem(
                "beam.supports",
                f"{held} of them hold the deflection",
                "allowed with boundary 'supports' are two or more that fix or spring the "
                "deflection; with fewer the beam moves as a rigid body",
            )
        if not any(support.restrains_twist for support in supports):
            yield Problem(
                "beam.supports",
                "none of them holds the twist",
                "allowed with boundary 'supports' are supports of which one or more fix or spring "
                "the twist; without, the beam turns as a rigid body",
            )
    for number, support in enumerate(supports):
        if support.at not in (0.0, 1.0):
            continue
        end = int(support.at)
        for motion, ends in (("deflection", bending), ("twist", torsion)):
            acts = any(
                getattr(support, key) not in ("free", 0.0)
                for key in (motion, f"{motion}_stiffness", f"{motion}_damping")
            )
            held_by_end = ends[end] == "fixed" or (motion == "deflection" and ends[end] != "free")
            if acts and held_by_end:
                yield Problem(
                    f"beam.supports.{number}.at",
                    support.at,
                    f"allowed is a place where boundary '{boundary}' does not hold the {motion} "
                    "already",
                )


def _percent(place: float) -> str:
    return f"{100 * place:.4g} %"


@check("beam.elastic_axis")
def _elastic_axis_on_chord(place: float) -> Iterator[Problem]:
    yield from _on_chord("beam.elastic_axis", place, "an axis")


@check("beam.mass_axis")
def _mass_axis_on_chord(place: float) -> Iterator[Problem]:
    yield from _on_chord("beam.mass_axis", place, "a centre of mass")


def _on_chord(key: str, place: float, what: str) -> Iterator[Problem]:
    """Refuse a place beyond the chord; one in per cent, or from mid-chord, is read back."""
    if 0.0 <= place <= 1.0:
        return
    allowed = "allowed is a number from 0 to 1, x/c from the leading edge"
    if 1.0 < place <= 100.0:
        meant = place / 100
        allowed += f"; write {meant:.4g} for {what} at {_percent(meant)} of the chord"
    elif -MID_CHORD <= place < 0.0:
        meant = MID_CHORD + place
        allowed += (
            f"; counted from mid-chord it would be {what} at {_percent(meant)} of the chord, "
            f"{meant:.4g}"
        )
    yield Problem(key, place, allowed)


@check("beam.mass_axis", "beam.cross_section")
def _centre_of_a_rectangle(mass_axis: float, given: CrossSection | None) -> Iterator[Problem]:
    if given is None and 0.0 <= mass_axis <= 1.0 and mass_axis != MID_CHORD:
        yield Problem(
            "beam.mass_axis",
            mass_axis,
            f"allowed is {MID_CHORD:g} without beam.cross_section: a homogeneous rectangle has its "
            "centre of mass at mid-chord; give the section as it is (beam.cross_section)",
        )


@check("beam.cross_section", "beam.mass_axis", "beam.elastic_axis", "beam.chord")
def _inertia_of_a_body(
    given: CrossSection | None, mass_axis: float, elastic_axis: float, chord: float
) -> Iterator[Problem]:
    """Refuse an inertia about the elastic axis that is less than that of the mass at its centre."""
    if given is None or not (0.0 <= mass_axis <= 1.0 and 0.0 <= elastic_axis <= 1.0):
        return
    least = given.mass_per_length * ((mass_axis - elastic_axis) * chord) ** 2
    if given.inertia_per_length <= least:
        yield Problem(
            "beam.cross_section.inertia_per_length",
            given.inertia_per_length,
            f"allowed is a number above m d2 = {least:.4g} kg m2/m: it is about the elastic axis, "
            f"at {_percent(elastic_axis)} of the chord, and the centre of mass is at "
            f"{_percent(mass_axis)}",
        )


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
