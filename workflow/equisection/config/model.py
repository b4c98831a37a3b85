"""The whole configuration, and the checks between its sections."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, get_args

from pydantic import Field, ValidationInfo, model_validator

from equisection.beam.outline_keys import OutlineKeys
from equisection.config.groups import (
    BY_SUPPORTS,
    FREE_TIP,
    MID_CHORD,
    Beam,
    DerivativeKeys,
    Embedded,
    Flow,
    ForcedKeys,
    Given,
    KeyGroup,
    Lump,
    OpenFoam,
    Rom,
    SolverKeys,
    StartKeys,
    Steady,
    Structure,
    Support,
    Sweep,
    Uncertainty,
    Unsteady,
)
from equisection.config.groups.flow import LARGEST_MACH
from equisection.config.groups.sweep import Range
from equisection.keys.checks import DisagreementError, Problem, check, disagreements
from equisection.keys.values import EMPTY, Name

#: Format of a figure.
FigureFormat = Literal["png", "svg", "pdf"]
#: All of them.
FIGURE_FORMATS: tuple[FigureFormat, ...] = get_args(FigureFormat)
#: Holds the recorded reference runs, which no run may mix with.
RESERVED_RUN = "reference"


class Config(KeyGroup):
    """Configuration of one run; the defaults are the paper's plate on the embedded solver."""

    run: Name = Field(
        "paper-plate", description="Name of the run; everything goes to `results/<run>/`."
    )
    solver: Literal["embedded", "openfoam", "given"] = Field(
        "embedded", description="Solver of the steady and unsteady cases."
    )
    reduction: Literal["consistent", "paper"] = Field(
        "consistent",
        description="Equivalent section of the models `2d` and `2d-corrected`: `consistent` "
        "keeps the natural frequencies, `paper` is Eq. 17 as printed.",
    )
    correction: Literal["mean", "modal"] = Field(
        "mean",
        description="Lift and moment of the rigid beam that the section is corrected by (Eq. 20): "
        "`mean`, over the span; `modal`, as the first bending and the first "
        "torsion mode feel them.",
    )
    reuse: Annotated[str, EMPTY] = Field(
        "results/reference",
        description="Folder with results of earlier runs: a case that one of them is the result "
        "of, by its hash, is not computed again. It is looked through at every depth and may hold "
        "100,000 files and folders. Empty to compute every case.",
    )
    compute: bool = Field(
        True,
        description="Whether a case without a kept result is computed. With false, results come "
        "from `reuse` alone and no solver is needed: cases that it has not are named in "
        "`comparison/missing.csv` and left out.",
    )
    figure_formats: Annotated[tuple[FigureFormat, ...], Field(min_length=1)] = Field(
        FIGURE_FORMATS,
        description="Formats of each figure: `png`, which the report shows, and any of `svg` and "
        "`pdf`.",
    )
    beam: Beam = Field(Beam(), description="The beam.")
    flow: Flow = Field(Flow(), description="The flow.")
    structure: Structure = Field(Structure(), description="Mode computation.")
    steady: Steady = Field(Steady(), description="Steady polars.")
    sweep: Sweep = Field(Sweep(), description="The sweep over k*.")
    uncertainty: Uncertainty = Field(
        Uncertainty(), description="Half-ranges of the inputs of a map of stability."
    )
    rom: Rom = Field(Rom(), description="The model learnt from a release.")
    unsteady: Unsteady = Field(Unsteady(), description="Unsteady runs.")
    forced: ForcedKeys = Field(ForcedKeys(), description="Forced motion of the section.")
    derivatives: DerivativeKeys = Field(
        DerivativeKeys(), description="Flutter derivatives of the section."
    )
    embedded: Embedded = Field(Embedded(), description="The embedded solver.")
    openfoam: OpenFoam = Field(OpenFoam(), description="OpenFOAM.")
    given: Given = Field(
        Given(), description="Histories and polars of another program or a wind tunnel."
    )

    @model_validator(mode="after")
    def _agree(self, info: ValidationInfo) -> Config:
        """Run the checks, unless only the values themselves are to be read."""
        if not (info.context or {}).get("values_only"):
            found = disagreements(self)
            if found:
                raise DisagreementError(found)
        return self

    @property
    def solver_section(self) -> SolverKeys:
        """The section of the configured solver, which has its name."""
        section: SolverKeys = getattr(self, self.solver)
        return section

    @property
    def run_resolution(self) -> str:
        """Resolution of the unsteady runs."""
        return self.unsteady.resolution or self.steady.resolution

    @property
    def reynolds_number(self) -> float:
        """Re = rho V c/mu."""
        return self.flow.density * self.flow.speed * self.beam.chord / self.flow.dynamic_viscosity


@check("sweep.speed", "flow.sound_speed")
def _incompressible_sweep(
    speed: tuple[float, ...] | Range | None, sound_speed: float
) -> Iterator[Problem]:
    values = speed.values() if isinstance(speed, Range) else speed or ()
    fastest = max(values, default=0.0)
    if fastest > LARGEST_MACH * sound_speed:
        yield Problem(
            "sweep.speed",
            fastest,
            f"allowed is up to {LARGEST_MACH * sound_speed:g} m/s, Mach {LARGEST_MACH:g} "
            "(incompressible flow)",
        )


@check("correction", "steady.beam_polar")
def _loads_along_the_span(correction: str, beam_polar: str) -> Iterator[Problem]:
    if correction == "modal" and beam_polar:
        yield Problem(
            "correction",
            correction,
            "allowed is 'mean' with steady.beam_polar, whose file has no loads along the span that "
            'modes could weight; or steady.beam_polar: "", with which the solver runs the beam',
        )


@check("compute", "reuse")
def _results_from_somewhere(compute: bool, reuse: str) -> Iterator[Problem]:
    if not compute and not reuse:
        yield Problem("reuse", reuse, "allowed is a folder with results where compute is false")


@check("compute", "sweep.onset")
def _refined_by_runs(compute: bool, onset: str) -> Iterator[Problem]:
    if not compute and onset == "refine":
        yield Problem("sweep.onset", onset, "allowed is 'sweep' or 'model' where compute is false")


@check("sweep.onset", "sweep.models", "beam.elastic_axis", "beam.mass_axis")
def _learnt_without_factors(
    onset: str, models: tuple[str, ...], elastic_axis: float, mass_axis: float
) -> Iterator[Problem]:
    corrected = [name for name in models if "corrected" in name]
    if onset == "model" and corrected and {elastic_axis, mass_axis} != {MID_CHORD}:
        yield Problem(
            "sweep.models",
            list(models),
            f"allowed with sweep.onset 'model' are models without {', '.join(corrected)} where "
            "beam.elastic_axis or beam.mass_axis is off mid-chord: the correction is then a factor "
            "of the loads, which the learnt model does not have",
        )


@check("sweep.onset", "sweep.models", "steady.beam_polar")
def _learnt_on_strips(onset: str, models: tuple[str, ...], beam_polar: str) -> Iterator[Problem]:
    """Refuse a beam without loads along the span, on which the learnt model rests."""
    if onset == "model" and "3d" in models and beam_polar:
        yield Problem(
            "steady.beam_polar",
            beam_polar,
            "allowed with sweep.onset 'model' and the model 3d is \"\", with which the solver runs "
            "the rigid beam: the model is learnt on its loads along the span, which such a file "
            "does not have",
        )


@check("unsteady.start", "solver", "sweep.models", "steady.beam_polar")
def _equilibrium_of_strips(
    start: StartKeys, solver: str, models: tuple[str, ...], beam_polar: str
) -> Iterator[Problem]:
    """Refuse a beam without loads along the span, by which its equilibrium is found."""
    if start.state == "equilibrium" and solver == "openfoam" and "3d" in models and beam_polar:
        yield Problem(
            "steady.beam_polar",
            beam_polar,
            "allowed with solver 'openfoam', unsteady.start.state 'equilibrium' and the model 3d "
            'is "", with which the solver runs the rigid beam: the equilibrium is that of the '
            "loads along the span, which such a file does not have",
        )


@check("sweep.onset", "unsteady.start")
def _learnt_from_this_start(onset: str, start: StartKeys) -> Iterator[Problem]:
    """Refuse a start from which the learnt models do not release."""
    if onset == "model" and start.state != "rigid":
        yield Problem(
            "unsteady.start.state",
            start.state,
            "allowed with sweep.onset 'model' is 'rigid': a learnt model releases from there",
        )


@check("figure_formats")
def _shown_in_the_report(formats: tuple[str, ...]) -> Iterator[Problem]:
    if "png" not in formats:
        yield Problem(
            "figure_formats", list(formats), "allowed is 'png', which the report shows, and others"
        )


@check("run")
def _not_reserved(run: str) -> Iterator[Problem]:
    if run.lower() == RESERVED_RUN:
        yield Problem("run", run, "allowed is another name; results/reference holds recorded runs")


@check("flow.channel.tip_gap_chords", "beam.boundary")
def _tip_needs_room(gap: float | None, boundary: str) -> Iterator[Problem]:
    if gap == 0 and boundary in FREE_TIP:
        yield Problem(
            "flow.channel.tip_gap_chords",
            gap,
            f"allowed is a number above 0 with the free tip of boundary '{boundary}'",
        )


@check("beam.elastic_axis", "beam.mass_axis", "reduction")
def _reduction_with_imbalance(
    elastic_axis: float, mass_axis: float, reduction: str
) -> Iterator[Problem]:
    if reduction == "paper" and elastic_axis != mass_axis:
        yield Problem(
            "reduction",
            reduction,
            "allowed is consistent where beam.elastic_axis and beam.mass_axis differ: Eq. 17 "
            "has no static imbalance; to have it all the same name 2d-paper in sweep.models",
        )


@check("sweep.models", "beam.elastic_axis", "beam.mass_axis", "solver")
def _factors_of_the_loads(
    models: tuple[str, ...], elastic_axis: float, mass_axis: float, solver: str
) -> Iterator[Problem]:
    """Refuse factors of the loads on OpenFOAM, whose flow moves its body as it is."""
    corrected = [name for name in models if "corrected" in name]
    if solver == "openfoam" and corrected and {elastic_axis, mass_axis} != {MID_CHORD}:
        yield Problem(
            "sweep.models",
            list(models),
            f"allowed with solver 'openfoam' are models without {', '.join(corrected)} where "
            "beam.elastic_axis or beam.mass_axis is off mid-chord: the correction is then a factor "
            "of the loads, and OpenFOAM's body moves under those of its flow; 'embedded' takes it",
        )


@check("beam.supports", "beam.lumps", "beam.boundary", "solver")
def _fittings_of_the_solver(
    supports: tuple[Support, ...], lumps: tuple[Lump, ...], boundary: str, solver: str
) -> Iterator[Problem]:
    if solver == "openfoam" and (supports or lumps or boundary == BY_SUPPORTS):
        yield Problem(
            "solver",
            solver,
            "allowed with beam.supports, beam.lumps or boundary 'supports' is 'embedded': "
            "OpenFOAM's bodies do not have them",
        )


@check("unsteady.resolution", "openfoam.meshes", "solver")
def _resolution_of_runs_is_a_mesh(
    resolution: str, meshes: dict[str, str], solver: str
) -> Iterator[Problem]:
    """Refuse runs at a resolution of their own where it is no mesh: the polars are the flow."""
    allowed = sorted(meshes) if solver == "openfoam" else []
    if resolution and resolution not in allowed:
        names = ", ".join(allowed)
        yield Problem(
            "unsteady.resolution",
            resolution,
            f"allowed is a name in openfoam.meshes: {names}"
            if names
            else f"allowed with solver '{solver}' is none: its runs have the polars of "
            "steady.resolution",
        )


@check("steady.resolution", "steady.study", "embedded.polars", "openfoam.meshes", "solver")
def _resolutions_exist(
    resolution: str,
    study: tuple[str, ...],
    polars: dict[str, str],
    meshes: dict[str, str],
    solver: str,
) -> Iterator[Problem]:
    named = {"embedded": ("embedded.polars", polars), "openfoam": ("openfoam.meshes", meshes)}
    if solver not in named:  # one without resolutions takes any name
        return
    key_of_names, there = named[solver]
    names = {"steady.resolution": resolution}
    names |= {f"steady.study.{place}": name for place, name in enumerate(study)}
    for key, name in names.items():
        if name not in there:
            yield Problem(
                key, name, f"allowed is a name in {key_of_names}: {', '.join(sorted(there))}"
            )


@check(
    "flow.incidence_deg", "sweep.incidence_deg", "embedded.symmetric", "solver", "unsteady.start"
)
def _set_in_motion(
    incidence_deg: float,
    of_sweep: tuple[float, ...],
    symmetric: bool,
    solver: str,
    start: StartKeys,
) -> Iterator[Problem]:
    """Refuse a release from an equilibrium, after which anything looks stable."""
    if solver == "embedded" and symmetric and not start.is_given:
        yield from release_from_equilibrium(incidence_deg, of_sweep)


@check("flow.incidence_deg", "sweep.incidence_deg", "beam.outline", "solver", "unsteady.start")
def _set_in_motion_by_a_flow(
    incidence_deg: float,
    of_sweep: tuple[float, ...],
    outline: OutlineKeys | None,
    solver: str,
    start: StartKeys,
) -> Iterator[Problem]:
    """Refuse the same where the loads are those of the shape in the flow.

    Of an outline in a file that is known once it is read (:mod:`equisection.study.given_outline`).
    """
    if solver in ("embedded", "given") or start.is_given:  # a record has what moved it
        return
    if outline is None or outline.is_symmetric:
        yield from release_from_equilibrium(incidence_deg, of_sweep)


def release_from_equilibrium(
    incidence_deg: float, of_sweep: tuple[float, ...]
) -> Iterator[Problem]:
    """Yield the problem of a symmetric section that is let go at 0 deg, without a start.

    Parameters
    ----------
    incidence_deg, of_sweep
        ``flow.incidence_deg``, and ``sweep.incidence_deg``, which takes its place if there are any.
    """
    if 0.0 in of_sweep:
        yield Problem(
            f"sweep.incidence_deg.{of_sweep.index(0.0)}",
            0.0,
            "allowed is 0 with unsteady.start.twist_deg, such as 0.1: a symmetric section has no "
            "loads at 0 deg, so nothing sets it in motion and its runs would say nothing",
        )
    elif incidence_deg == 0 and not of_sweep:
        yield Problem(
            "flow.incidence_deg",
            incidence_deg,
            "allowed is 0 with unsteady.start.twist_deg, or any other, such as 0.1: a symmetric "
            "section has no loads at 0 deg, so nothing sets it in motion and the sweep would say "
            "nothing of its stability",
        )


@check("steady.incidence_deg", "flow.incidence_deg", "embedded.symmetric", "solver")
def _polar_on_both_sides(
    angles: tuple[float, ...], incidence_deg: float, symmetric: bool, solver: str
) -> Iterator[Problem]:
    """Refuse a polar without one side: a cambered section twists either way, unmirrored."""
    if solver != "embedded" or symmetric or not min(angles) <= incidence_deg <= max(angles):
        return
    if incidence_deg in (min(angles), max(angles)):
        yield Problem(
            "steady.incidence_deg",
            list(angles),
            f"allowed are angles on both sides of flow.incidence_deg, {incidence_deg:g} deg, with "
            "embedded.symmetric: false: such a section may twist either way",
        )


@check("flow.incidence_deg", "steady.incidence_deg")
def _incidence_within_polar(incidence_deg: float, angles: tuple[float, ...]) -> Iterator[Problem]:
    low, high = min(angles), max(angles)
    if not low <= incidence_deg <= high:
        yield Problem(
            "flow.incidence_deg",
            incidence_deg,
            f"allowed is {low:g} to {high:g} deg, what steady.incidence_deg covers",
        )
