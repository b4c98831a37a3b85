"""Cases from the configuration, the modes, the equivalent section and the correction.

Here the arrows of Fig. 1 meet: all that decides a run is put into its case file.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import xarray as xr

from equisection.aerodynamics.strip_polars import StripPolars
from equisection.beam.section import Section
from equisection.cases import (
    BeamModes,
    EndCriteria,
    Geometry,
    Medium,
    SolverBlock,
    Start,
    SteadyCase,
    UnsteadyCase,
)
from equisection.cases.beam_in_flow import beam_modes_in_flow
from equisection.config import Config
from equisection.errors import DivergenceError, EquisectionError, ReductionError
from equisection.motion.beam_equilibrium import beam_in_equilibrium
from equisection.motion.static_branch import section_in_equilibrium
from equisection.reduction.corrected_section import corrected_section
from equisection.reduction.flutter_bias import refusal as bias_refusal
from equisection.reduction.flutter_bias import unlike
from equisection.reduction.reduce import Reduction
from equisection.results.correction_dataset import factors_from_dataset
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.polar_dataset import polar_at, strip_polars_at
from equisection.results.section_dataset import no_section, section_from_dataset
from equisection.solvers.embedded.releases import beam_parameters
from equisection.solvers.protocol import Capability, HasRecords, OfFlow, Solver
from equisection.solvers.verdicts import pitch_frequency
from equisection.study.axes import K_STAR, Point
from equisection.study.plan import Model

#: Of the twist, below which its extrema are not where they seem to be.
FEWEST_SAMPLES_A_PERIOD = 6


def steady_case(
    config: Config, dimension: str, incidence_deg: float, resolution: str, solver: Solver
) -> SteadyCase:
    """Return the case of the rigid section (``2d``) or beam (``3d``) at an incidence (deg)."""
    return SteadyCase(
        dimension=dimension,
        incidence_deg=incidence_deg,
        resolution=resolution,
        geometry=_geometry(config),
        medium=_medium(config),
        solver=_solver_block(solver, dimension),
    )


def case_at(
    config: Config, model: Model, point: Point, data: Mapping[str, xr.Dataset], solver: Solver
) -> UnsteadyCase:
    """Return the case of a model at a point of the sweep.

    Incidence and speed of the point take the place of the configuration's. Without a k* the beam is
    as given, and has the k* of its speed. Parameters and errors are those of
    :func:`unsteady_case`.
    """
    there = point.of_config(config)
    k_star = point.columns.get(K_STAR.name) or k_star_as_given(there, data["equivalent"])
    if isinstance(solver, OfFlow):
        solver = solver.in_flow(there)
    case = unsteady_case(there, model, k_star, data, solver)
    if not isinstance(solver, HasRecords):
        return case
    settings = solver.record_of(model.name, point.name, point.columns)
    return case.model_copy(update={"solver": case.solver.model_copy(update={"settings": settings})})


def unsteady_case(
    config: Config, model: Model, k_star: float, data: Mapping[str, xr.Dataset], solver: Solver
) -> UnsteadyCase:
    """Return the case of a model at a k*.

    Parameters
    ----------
    config
        The configuration.
    model
        The model of the sweep.
    k_star
        k* of the uncorrected structural stiffness.
    data
        ``equivalent``, with ``modes`` in 3D and ``correction`` for a corrected model, and with
        ``polar_2d`` or ``polar_3d`` for a section or beam that starts from an equilibrium that its
        solver does not know.
    solver
        The solver that is to run it.

    Notes
    -----
    A corrected section without a static equilibrium inside the polars is not run: its case has the
    reason, and the other k* go on. Its result is ``growing`` if it diverges, else ``failed``. So it
    is with one so stiff that its history would be written too seldom to tell an oscillation.
    """
    stiffness_scale = k_star / k_star_as_given(config, data["equivalent"])
    section, beam, refusal, diverges = None, None, "", False
    factors = (1.0, 1.0)
    if model.dimension == "3d":
        beam = _beam_modes(config, data["modes"], stiffness_scale)
    else:
        try:
            section, factors = _section(config, model, data, stiffness_scale)
        except EquisectionError as error:
            refusal = str(error)
            diverges = isinstance(error, DivergenceError)
    unsteady = config.unsteady
    case = UnsteadyCase(
        dimension=model.dimension,
        k_star=k_star,
        incidence_deg=config.flow.incidence_deg,
        resolution=config.run_resolution,
        geometry=_geometry(config),
        medium=_medium(config),
        section=section,
        lift_factor=factors[0],
        moment_factor=factors[1],
        beam=beam,
        start=_start(config, section or beam, factors, data, solver),
        duration=unsteady.duration,
        time_step=unsteady.time_step,
        output_interval=unsteady.output_interval,
        criteria=EndCriteria(**unsteady.verdict.model_dump()),
        solver=_solver_block(solver, model.dimension),
        refusal=refusal,
        diverges=diverges,
    )
    if not case.not_run and (reason := _seldom(case)):
        return case.model_copy(update={"section": None, "beam": None, "refusal": reason})
    return case


def _start(
    config: Config,
    body: Section | BeamModes | None,
    factors: tuple[float, float],
    data: Mapping[str, xr.Dataset],
    solver: Solver,
) -> Start:
    """Return the start of a case, with the equilibrium that its solver does not know."""
    start = Start(**config.unsteady.start.model_dump())
    known = Capability.STATES in solver.provides or start.state != "equilibrium"
    if known or body is None:
        return start
    rigid, mesh = math.radians(config.flow.incidence_deg), config.steady.resolution
    if isinstance(body, BeamModes):
        found = _beam_equilibrium(body, strip_polars_at(data["polar_3d"], mesh).continued, rigid)
    elif "polar_2d" in data:
        polar = polar_at(data["polar_2d"], mesh).continued
        found = section_in_equilibrium(body, polar, rigid, factors)
    else:
        return start
    return start.model_copy(update={"equilibrium": found})


def _beam_equilibrium(
    beam: BeamModes, polars: StripPolars, incidence_rad: float
) -> tuple[float, ...] | None:
    found = beam_in_equilibrium(beam_parameters([beam], polars.strips, None), polars, incidence_rad)
    return None if found is None else tuple(map(float, found))


def _seldom(case: UnsteadyCase) -> str:
    """Return why a history would be written so seldom that an oscillation looks at rest."""
    most = 1.0 / (FEWEST_SAMPLES_A_PERIOD * pitch_frequency(case))
    if case.output_interval <= most:
        return ""
    return (
        f"unsteady.output_interval is {case.output_interval:g} c/V; allowed is up to {most:.2g} "
        f"c/V at k* = {case.k_star:g}, {FEWEST_SAMPLES_A_PERIOD} samples a period of the pitch; "
        "give it so, or leave out this k*"
    )


def _geometry(config: Config) -> Geometry:
    beam, flow = config.beam, config.flow
    channel, outline = flow.channel, beam.outline_in_flow()
    return Geometry(
        chord=beam.chord,
        span=beam.length / beam.chord,
        thickness=beam.thickness / beam.chord if outline is None else outline.thickness,
        root_on_wall=flow.root_on_wall,
        channel_height=channel.height_chords if channel else None,
        tip_gap=channel.tip_gap_chords if channel else None,
        upstream=channel.upstream_chords if channel else None,
        downstream=channel.downstream_chords if channel else None,
        outline=None if outline is None else outline.as_pairs(),
    )


def _medium(config: Config) -> Medium:
    flow = config.flow
    return Medium(speed=flow.speed, density=flow.density, dynamic_viscosity=flow.dynamic_viscosity)


def _solver_block(solver: Solver, dimension: str) -> SolverBlock:
    settings = solver.settings(dimension)
    return SolverBlock(name=solver.name, version=solver.version, settings=settings)


def k_star_as_given(config: Config, equivalent: xr.Dataset) -> float:
    """Return k* of the beam as configured at the configuration's speed (-).

    It is that of Eq. 17 in the paper's form, the axis of every comparison: both reductions and the
    beam have the same k* when they have the same Young's modulus.
    """
    flow = config.flow
    return section_from_dataset(equivalent, "paper").k_star(flow.density, flow.speed)


def section_refusal(equivalent: xr.Dataset, reduction: str) -> str:
    """Return why the section of a reduction cannot stand for its beam; empty where it can."""
    reason = no_section(equivalent, reduction)
    if "flutter_bias" not in equivalent:
        return reason
    if "section_likeness" in equivalent:
        pair = equivalent[["section_likeness", "section_damping_ratio"]]
        reason = unlike(*(float(pair[name]) for name in pair)) or reason
    bias = equivalent["flutter_bias"].sel(reduction=reduction)
    return reason or bias_refusal(float(bias), reduction)


def _section(
    config: Config, model: Model, data: Mapping[str, xr.Dataset], stiffness_scale: float
) -> tuple[Section, tuple[float, float]]:
    """Return the section of a model in the flow, and the factors of its c_l and c_m."""
    reduction: Reduction = "paper" if model.reduction == "paper" else "consistent"
    if reason := section_refusal(data["equivalent"], reduction):
        raise ReductionError(reason)
    section = section_from_dataset(data["equivalent"], reduction).scaled(stiffness_scale)
    in_flow = section.in_flow(config.flow.density, config.flow.speed)
    if not model.corrected:
        return in_flow, (1.0, 1.0)
    factors = factors_from_dataset(data["correction"])
    return corrected_section(in_flow, factors, math.radians(config.flow.incidence_deg))


def _beam_modes(config: Config, dataset: xr.Dataset, stiffness_scale: float) -> BeamModes:
    """Return the beam's modes, with frequencies that grow as the square root of E."""
    structure, flow = config.structure, config.flow
    return beam_modes_in_flow(
        config.beam,
        modes_from_dataset(dataset),
        (structure.bending_modes, structure.torsion_modes),
        density=flow.density,
        speed=flow.speed,
        stiffness_scale=stiffness_scale,
    )
