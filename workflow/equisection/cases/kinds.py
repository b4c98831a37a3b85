"""Registry of the kinds of case: everything that differs from one kind to another.

The store, the kept results, the status, the verification and the cost of a run go through
:data:`KINDS`, and name no kind. A new kind takes

- a class of cases and an entry in :data:`KINDS`, both in this module;
- a class of results, which fulfils :class:`equisection.results.case_result.CaseResult`;
- the method ``run_<folder>`` of the solvers that run it, and ``<folder>_work`` of their work;
- its rules, ``workflow/rules/<folder>.smk``, which write its case files and run them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

from pydantic import model_validator

from equisection.beam.section import Section
from equisection.cases.case import (
    BeamModes,
    Case,
    EndCriteria,
    Harmonic,
    ModeShapes,
    Start,
)
from equisection.errors import CaseFileError


class SteadyCase(Case):
    """Rigid section or beam at one incidence."""

    kind: Literal["steady"] = "steady"


class UnsteadyCase(Case):
    """Free section (`2d`) or free beam (`3d`), released from a steady state."""

    left_out = frozenset({"lift_factor", "moment_factor", "start"})

    kind: Literal["unsteady"] = "unsteady"
    k_star: float  # structural, uncorrected
    section: Section | None = None  # in its flow; the corrected one in `2d-corrected`
    lift_factor: float = 1.0  # of c_l, where the correction is of the loads and not of the section
    moment_factor: float = 1.0  # of c_m about mid-chord, the same
    beam: BeamModes | None = None
    start: Start = Start()
    duration: float  # c/V
    time_step: float  # c/V
    output_interval: float  # c/V
    criteria: EndCriteria
    refusal: str = ""  # why there is no structure to move; such a case is not run
    diverges: bool = False  # the refusal is a static divergence, which is an instability

    @property
    def longest(self) -> float:
        """Longest duration of its history (c/V)."""
        return self.duration

    @property
    def not_run(self) -> str:
        """Reason for the lack of a structure to move; empty for a case that is run."""
        return self.refusal

    @property
    def section_start_twist(self) -> float:
        """Twist (rad) in which the section is held until the release; 0 for a beam."""
        if self.section is None:
            return 0.0
        pushed = math.radians(self.start.twist_deg) * self.section.twist_recovery
        return self.section_equilibrium[0] + pushed

    @property
    def section_equilibrium(self) -> tuple[float, float]:
        """Twist (rad) and deflection (chords) of the state that a section starts from."""
        if self.section is None or self.start.equilibrium is None:
            return (0.0, 0.0)
        twist, deflection = self.start.equilibrium
        return twist, deflection

    @property
    def section_heave_rate(self) -> float:
        """Rate of the section's deflection at the release (over V), up; 0 for a beam."""
        if self.section is None:
            return 0.0
        return self.start.heave_rate * self.section.deflection_recovery

    @model_validator(mode="after")
    def _one_structure(self) -> UnsteadyCase:
        if self.refusal:
            return self
        wanted = "section" if self.dimension == "2d" else "beam"
        if getattr(self, wanted) is None or (self.section is None) == (self.beam is None):
            raise ValueError(f"a case of dimension {self.dimension} holds '{wanted}' alone")
        given, beam = self.start.equilibrium, self.beam
        count = 2 if beam is None else len(beam.torsion_shape) + len(beam.bending_shape)
        if given is not None and len(given) != count:
            raise ValueError(f"start.equilibrium has {len(given)} numbers; wanted are {count}")
        return self


class ForcedCase(Case):
    """Section that is moved in pitch or heave about a mean incidence (`2d`), or beam (`3d`).

    A beam is moved in one of its torsion modes (pitch) or bending modes (heave).
    """

    left_out = frozenset({"shapes", "mode", "mean_twist_deg"})

    kind: Literal["forced"] = "forced"
    component: Literal["pitch", "heave"]  # of mid-chord; of a beam that of its elastic axis
    shapes: ModeShapes | None = None
    mode: int = 0  # number of the mode that moves, from 1
    mean_twist_deg: float = 0.0  # of the first torsion mode where it is largest
    harmonics: tuple[Harmonic, ...]
    ramp: float  # c/V in which the motion sets in
    settling: float  # c/V that are left out of the record
    duration: float  # c/V
    time_step: float  # c/V
    output_interval: float  # c/V

    @property
    def longest(self) -> float:
        """Longest duration of its history (c/V)."""
        return self.duration

    @property
    def reduced_velocity(self) -> float:
        """V/(f c) of its slowest harmonic."""
        return math.tau / min(one.frequency for one in self.harmonics)

    @model_validator(mode="after")
    def _mode_of_a_beam(self) -> ForcedCase:
        if (self.dimension == "3d") != (self.shapes is not None):
            raise ValueError("a case of dimension 3d holds 'shapes', and no other does")
        if self.shapes is not None:
            own = self.shapes.torsion if self.component == "pitch" else self.shapes.bending
            if not 1 <= self.mode <= len(own):
                raise ValueError(f"mode is {self.mode}; allowed is 1 to {len(own)}")
        return self


@dataclass(frozen=True)
class Kind:
    """Kind of case.

    Attributes
    ----------
    name
        Name.
    case
        Class of its cases. Its ``kind`` also names the folders of a run and the file of its rules.
    point
        Fields that distinguish a case from others of its study; its result has them as attributes.
    has_history
        True if its results are histories over time.
    ends
        Fields that decide the end of a history, and nothing before it. Cases that differ in these
        alone share a history.
    of_sweep
        True if its cases are those of the sweep's models. Others are named after a dimension.
    title
        Title of its cases in a summary, and before the model in a list. A model of the sweep is
        listed by its own name.
    """

    name: str
    case: type[Case]
    point: tuple[str, ...]
    has_history: bool
    ends: frozenset[str] = frozenset()
    of_sweep: bool = False
    title: str = ""

    @property
    def folder(self) -> str:
        """Folder of its case files and results in a run, and ``kind`` of its cases."""
        return str(self.case.model_fields["kind"].default)

    @property
    def unit(self) -> str:
        """Unit of the progress of a job."""
        return TIME if self.has_history else "cases"

    @property
    def cost_term(self) -> str:
        """Coefficient of the cost model that is fitted to its cases."""
        return "step" if self.has_history else "iteration"

    @property
    def run_method(self) -> str:
        """Method of a solver that runs its cases."""
        return f"run_{self.folder}"

    @property
    def work_function(self) -> str:
        """Name of the function that gives the work of a job, in a solver's module of work."""
        return f"{self.folder}_work"

    def model_of(self, part: str) -> str:
        """Return the model of the cases in a folder ``<kind>/<part>``, in the words of lists."""
        return part if self.of_sweep else f"{self.title} {part}"


#: Unit of the progress of a job whose cases have histories.
TIME = "c/V"

STEADY = Kind("steady", SteadyCase, ("incidence_deg",), has_history=False, title="steady")
FREE = Kind(
    "free",
    UnsteadyCase,
    ("k_star", "incidence_deg"),
    has_history=True,
    ends=frozenset({"criteria", "duration"}),
    of_sweep=True,
    title="sweep",
)

FORCED = Kind(
    "forced",
    ForcedCase,
    ("reduced_velocity", "incidence_deg"),
    has_history=True,
    title="forced",
)

#: Kinds by their folders, in the order in which a run's cases are listed.
KINDS: dict[str, Kind] = {kind.folder: kind for kind in (STEADY, FREE, FORCED)}


def kind_of(case: Case) -> Kind:
    """Return the kind of a case."""
    return KINDS[case.kind]


def kind_named(word: Any) -> Kind:
    """Return the kind of cases whose ``kind`` is a word.

    Raises
    ------
    CaseFileError
        There is no such kind.
    """
    if word not in KINDS:
        raise CaseFileError(f"kind: {word!r} is not known; allowed are {', '.join(KINDS)}")
    return KINDS[word]


def point_of(case: Case) -> dict[str, float]:
    """Return the point of a case in its study: the values of its kind's ``point`` by name."""
    return {name: getattr(case, name) for name in kind_of(case).point}


def ends_of(case: dict[str, Any]) -> frozenset[str]:
    """Return the fields that decide the end of a case's history; ``case`` is as JSON holds it."""
    kind = KINDS.get(case.get("kind", ""))
    return kind.ends if kind else frozenset()
