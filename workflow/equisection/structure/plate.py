"""The beam: a flat plate or a cross-section as given, and how its two ends are held.

Each boundary is a pair of end conditions for bending and one for torsion. A *fork* holds the
deflection and the twist of a section and leaves its bending slope free, which is what a pinned
end has to be if the twist is to have any restraint at all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

from equisection.errors import ConfigError

Boundary = Literal[
    "clamped-free",
    "clamped-clamped",
    "pinned-pinned",
    "clamped-pinned",
    "one-fork",
    "spring-root",
]
#: h/c up to which a rectangle is a thin strip: its G J is then 6 % too large.
_THIN = 0.1

BOUNDARIES: tuple[Boundary, ...] = get_args(Boundary)

BendingEnd = Literal["clamped", "pinned", "free", "spring"]
TorsionEnd = Literal["fixed", "free", "spring"]

_BENDING_ENDS: dict[str, tuple[BendingEnd, BendingEnd]] = {
    "clamped-free": ("clamped", "free"),
    "clamped-clamped": ("clamped", "clamped"),
    "pinned-pinned": ("pinned", "pinned"),
    "clamped-pinned": ("clamped", "pinned"),
    "one-fork": ("pinned", "pinned"),
    "spring-root": ("spring", "free"),
}
_TORSION_ENDS: dict[str, tuple[TorsionEnd, TorsionEnd]] = {
    "clamped-free": ("fixed", "free"),
    "clamped-clamped": ("fixed", "fixed"),
    "pinned-pinned": ("fixed", "fixed"),
    "clamped-pinned": ("fixed", "fixed"),
    "one-fork": ("fixed", "free"),
    "spring-root": ("spring", "free"),
}


@dataclass(frozen=True)
class CrossSection:
    """What a beam of any constant section, its axes at mid-chord, is to bending and torsion.

    Attributes
    ----------
    bending_rigidity : float
        E I (N m^2), of the deflection across the chord.
    torsional_rigidity : float
        G J (N m^2).
    mass_per_length : float
        m (kg/m).
    inertia_per_length : float
        Polar moment of inertia about mid-chord (kg m^2/m).
    """

    bending_rigidity: float
    torsional_rigidity: float
    mass_per_length: float
    inertia_per_length: float

    def __post_init__(self) -> None:
        for number in fields(self):
            value = getattr(self, number.name)
            if not (math.isfinite(value) and value > 0.0):
                raise ConfigError(
                    f"cross_section.{number.name} is {value}; give a positive number in SI units"
                )


@dataclass(frozen=True)
class Plate:
    """A flat plate or another beam of constant section, in SI units.

    It is homogeneous, of a rectangular section, unless ``cross_section`` says what its section is.

    Attributes
    ----------
    chord : float
        c (m).
    length : float
        Span L (m).
    thickness : float
        h (m).
    youngs_modulus : float
        E (Pa).
    poisson_ratio : float
        nu (-).
    density : float
        rho_s (kg/m^3).
    boundary : str
        ``clamped-free``; ``clamped-clamped``; ``pinned-pinned`` (a fork at both ends);
        ``clamped-pinned`` (a fork at the tip); ``one-fork`` (pinned at both ends, twist held at
        the root only); ``spring-root`` (springs at the root, free tip).
    root_torsional_stiffness, root_bending_stiffness : float or None
        Stiffness of the root's springs against twist and against bending slope (N m/rad), for
        ``spring-root`` only. None holds that motion rigidly.
    cross_section : CrossSection or None
        Rigidities, mass and inertia in the place of those of the rectangle of ``thickness``,
        ``youngs_modulus``, ``poisson_ratio`` and ``density``.
    """

    chord: float
    length: float
    thickness: float
    youngs_modulus: float
    poisson_ratio: float
    density: float
    boundary: str = "clamped-free"
    root_torsional_stiffness: float | None = None
    root_bending_stiffness: float | None = None
    cross_section: CrossSection | None = None

    @classmethod
    def from_values(cls, values: Mapping[str, Any]) -> Plate:
        """Return the beam of a configuration's section ``beam``, as plain values."""
        given = values.get("cross_section")
        return cls(**{**values, "cross_section": given and CrossSection(**given)})

    def __post_init__(self) -> None:
        for name in ("chord", "length", "thickness", "youngs_modulus", "density"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ConfigError(f"plate.{name} is {value}; give a positive number in SI units")
        if not -1.0 < self.poisson_ratio < 0.5:
            raise ConfigError(
                f"plate.poisson_ratio is {self.poisson_ratio}; give a number between -1 and 0.5"
            )
        if self.boundary not in BOUNDARIES:
            raise ConfigError(
                f"plate.boundary is {self.boundary!r}; choose one of {', '.join(BOUNDARIES)}"
            )
        self._check_springs()

    def _check_springs(self) -> None:
        springs = {
            "root_torsional_stiffness": self.root_torsional_stiffness,
            "root_bending_stiffness": self.root_bending_stiffness,
        }
        given = {name: value for name, value in springs.items() if value is not None}
        if self.boundary != "spring-root" and given:
            raise ConfigError(
                f"plate.{' and plate.'.join(given)} given with boundary {self.boundary!r}; "
                "root springs need boundary 'spring-root'"
            )
        if self.boundary == "spring-root" and not given:
            raise ConfigError(
                "plate.boundary is 'spring-root' without a spring; give "
                "plate.root_torsional_stiffness or plate.root_bending_stiffness (N m/rad), or "
                "use boundary 'clamped-free'"
            )
        for name, value in given.items():
            if not (math.isfinite(value) and value >= 0.0):
                raise ConfigError(
                    f"plate.{name} is {value}; give a number of N m/rad, zero or more, or leave "
                    "it out for a rigid root"
                )

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
    def torsion_series_factor(self) -> float:
        """Saint-Venant's exact J divided by c h^3/3 (-), for the record.

        1 - (192/pi^5)(h/c) sum over odd n of tanh(n pi c/2h)/n^5 (Timoshenko and Goodier,
        Theory of Elasticity, art. 109): 0.975 for h/c = 0.04. The paper's J is kept so that
        Eq. 17 is its own; three-dimensional elasticity needs neither.
        """
        ratio = self.thickness / self.chord
        total = sum(math.tanh(n * math.pi / (2.0 * ratio)) / n**5 for n in range(1, 40, 2))
        return 1.0 - 192.0 / math.pi**5 * ratio * total

    @property
    def warnings(self) -> tuple[str, ...]:
        """Say what a thick rectangle is not; empty for a thin one or a section as given."""
        ratio = self.thickness / self.chord
        if self.cross_section is not None or ratio <= _THIN:
            return ()
        return (
            f"h/c = {ratio:.3g} is above {_THIN:g}: of a thin strip, as which the plate is taken, "
            f"G J is {100 * (1 / self.torsion_series_factor - 1):.1f} % too large and the moment "
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
        """Polar inertia about mid-chord rho_s c^3 h/12 (kg m^2/m), Eq. 5 (h^2 against c^2 left)."""
        if self.cross_section is not None:
            return self.cross_section.inertia_per_length
        return self.density * self.chord**3 * self.thickness / 12.0

    @property
    def bending_ends(self) -> tuple[BendingEnd, BendingEnd]:
        """How bending is held at root and tip; a root spring of None is a clamp."""
        root, tip = _BENDING_ENDS[self.boundary]
        if root == "spring" and self.root_bending_stiffness is None:
            return "clamped", tip
        return root, tip

    @property
    def torsion_ends(self) -> tuple[TorsionEnd, TorsionEnd]:
        """How twist is held at root and tip; a root spring of None is rigid."""
        root, tip = _TORSION_ENDS[self.boundary]
        if root == "spring" and self.root_torsional_stiffness is None:
            return "fixed", tip
        return root, tip
