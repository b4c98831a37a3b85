"""The case: everything that decides the result of one solver run, and nothing else.

A case holds no name, path or machine. So two runs that ask for the same case share its result, and
an edit of code around the solver asks for no new one.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, SerializerFunctionWrapHandler, model_serializer

from equisection.errors import EquisectionError

SCHEMA_VERSION = 1


class Block(BaseModel):
    """Base of the parts of a case.

    Fields in ``left_out`` are not written down at their defaults, so that cases from before they
    were there keep their hashes.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    left_out: ClassVar[frozenset[str]] = frozenset()

    @model_serializer(mode="wrap")
    def _without_defaults(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        values: dict[str, Any] = dump(self)
        fields = type(self).model_fields
        at_default = {n for n in self.left_out if getattr(self, n) == fields[n].default}
        return {name: value for name, value in values.items() if name not in at_default}


class SolverBlock(Block):
    """Solver of a case: its name, the version of its numerics, and its settings."""

    name: str
    version: str
    settings: dict[str, Any]


class Geometry(Block):
    """Plate and channel in chords; ``channel_height`` and ``tip_gap`` None in free air.

    ``outline`` has the vertices of the section's contour over the chord, from mid-chord and
    counter-clockwise; None is the rectangle of the thickness.
    """

    left_out = frozenset({"outline"})

    chord: float  # m
    span: float  # L/c
    thickness: float  # h/c
    root_on_wall: bool  # a wall at the root mirrors the flow
    channel_height: float | None
    tip_gap: float | None
    upstream: float | None
    downstream: float | None
    outline: tuple[tuple[float, float], ...] | None = None


class Medium(Block):
    """The fluid and its speed (SI)."""

    speed: float  # m/s
    density: float  # kg/m3
    dynamic_viscosity: float  # Pa s


class Case(Block):
    """Base of the cases of every kind.

    ``kind`` is a word that each class has for itself; a case file is read by it
    (:mod:`equisection.cases.kinds`).
    """

    kind: str
    schema_version: int = SCHEMA_VERSION
    dimension: Literal["2d", "3d"]
    incidence_deg: float
    resolution: str
    geometry: Geometry
    medium: Medium
    solver: SolverBlock

    @property
    def longest(self) -> float | None:
        """Longest duration of its history (c/V); None for a case without a history."""
        return None

    @property
    def not_run(self) -> str:
        """Reason for not running it with any solver; empty for a case that is run."""
        return ""


class FittedModes(Block):
    """Lumped masses and dashpots along the span on the modes, sums over their places.

    Non-dimensional as the sectional ones of :class:`BeamModes`, which they add to: the mass of each
    bending mode and the inertia of each torsion mode, the imbalance (torsion, bending) and the
    dashpots (c_w* over V/c and c_theta*) of bending and of torsion modes as full matrices.
    """

    mass: tuple[float, ...]
    inertia: tuple[float, ...]
    imbalance: tuple[tuple[float, ...], ...]
    bending_dashpots: tuple[tuple[float, ...], ...]
    torsion_dashpots: tuple[tuple[float, ...], ...]


class BeamModes(Block):
    """Modes of the beam for one k*, non-dimensional, bending and torsion apart.

    Frequencies are omega c/V; shapes are normalised to a largest value of 1 and given over
    ``span`` = z/L, one row a mode; ``inertia`` = rho_s c^3 h/12 /(rho c^4/2) and ``mass`` =
    rho_s c h/(rho c^2/2) are the sectional ones, ``imbalance`` = S/(rho c^3/2) couples the modes,
    which are those without it. Inertia and imbalance are about the elastic axis.
    """

    left_out = frozenset(
        {"imbalance", "bending_damping", "torsion_damping", "elastic_axis", "fittings"}
    )

    span: tuple[float, ...]
    bending_frequency: tuple[float, ...]
    bending_shape: tuple[tuple[float, ...], ...]
    torsion_frequency: tuple[float, ...]
    torsion_shape: tuple[tuple[float, ...], ...]
    inertia: float
    mass: float
    imbalance: float = 0.0
    bending_damping: float = 0.0  # of critical, of every mode
    torsion_damping: float = 0.0  # the same
    elastic_axis: float = 0.5  # x/c from the leading edge
    fittings: FittedModes | None = None

    def require_defaults(self, model: str, *, but: Iterable[str] = ()) -> None:
        """Refuse a beam that has more than a model can represent.

        Parameters
        ----------
        model
            Name of the model in the message.
        but
            Fields of ``left_out`` that the model has; a field that is added later is refused until
            the model names it.

        Raises
        ------
        EquisectionError
            Another of them is not at its default.
        """
        fields = type(self).model_fields
        more = [
            f"{name} {getattr(self, name)} (allowed is {fields[name].default})"
            for name in sorted(self.left_out.difference(but, {"fittings"}))
            if getattr(self, name) != fields[name].default
        ]
        if self.fittings:
            more.append("supports or lumped masses along its span")
        if more:
            raise EquisectionError(f"{model} takes no beam with {', '.join(more)}")


class ModeShapes(Block):
    """Shapes of the beam's first modes, normalised to a largest value of 1, over ``span`` = z/L.

    One row a mode. ``elastic_axis`` is where the beam turns and its deflection is taken.
    """

    left_out = frozenset({"elastic_axis"})

    span: tuple[float, ...]
    bending: tuple[tuple[float, ...], ...]
    torsion: tuple[tuple[float, ...], ...]
    elastic_axis: float = 0.5  # x/c from the leading edge


class EndCriteria(Block):
    """Criteria for the end and the regime of a run, which leave its history as it is.

    ``rules`` is the version of the judgement in equisection.verdict. It changes whenever the same
    history would get another verdict, or get it at another time.
    """

    rules: int = 9
    settled_amplitude_deg: float
    growing_amplitude_deg: float
    steadiness: float
    periods: int


class Harmonic(Block):
    """Harmonic of a prescribed motion, amplitude times cos(frequency s + phase)."""

    frequency: float  # omega c/V
    amplitude: float  # rad of pitch, chords of heave
    phase: float  # rad


class Start(Block):
    """Start of a free motion: twist of the tip until the release (deg), and its heave rate then.

    The beam has them in its first modes, the section by its recovery factors. The twist is that
    beyond the state: the undeformed beam, or its static equilibrium in the flow. ``equilibrium`` is
    for a solver that does not know it: of a section twist (rad) and deflection (chords), of a beam
    these of its torsion modes and then of its bending modes; None where there is none.
    """

    left_out = frozenset({"state", "equilibrium"})

    state: Literal["rigid", "equilibrium"] = "rigid"
    twist_deg: float = 0.0
    heave_rate: float = 0.0  # over V, up
    equilibrium: tuple[float, ...] | None = None
