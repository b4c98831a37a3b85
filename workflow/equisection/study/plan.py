"""The plan of a run: its cases, their names and their files.

It comes from the validated configuration alone, and from no result, so that the graph can be built
on a fresh clone. Names of cases come from the axes of the study (:mod:`equisection.study.axes`).
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from equisection.cases import FORCED, FREE, STEADY, Kind
from equisection.config.groups.flow import LARGEST_MACH
from equisection.files import require_plain_names, write_text
from equisection.solvers.protocol import Capability
from equisection.solvers.registry import SOLVERS
from equisection.study.axes import INCIDENCE, SPEED, Point, onset_axis, sweep_points, varied

if TYPE_CHECKING:  # jobs need not build the models of the configuration
    from equisection.config import Config

#: Patterns of the wildcards of the rules.
FORCED_PATTERN = r"(?:pitch|heave|(?:bending|torsion)[1-9][0-9]*)(?:_v[0-9.]+)?"
MODEL_PATTERN = r"[23]d(-corrected)?(-paper|-consistent)?"
DIMENSION_PATTERN = r"[23]d"
#: A batch is what one job of a solver that takes many cases runs: the sweep, or a round of the
#: refinement of the onset.
BATCH_PATTERN = r"sweep|round[1-9][0-9]*"
SWEEP_BATCH = "sweep"
#: Rounds of learning after the first release: a second one, the runs that confirm the onset, and
#: those that confirm it again where the first ones contradicted.
LEARNING_ROUNDS = ("round1", "round2", "round3")
#: Sections that one job marches. Up to so many, what a step costs hardly depends on their number.
MOST_TOGETHER = 500
#: Ratio of one value to the next where an onset is looked for beyond the ends of a sweep (-): a
#: factor of two in three strides.
STRIDE = 1.26


@dataclass(frozen=True)
class Model:
    """A model of the sweep, taken apart."""

    name: str
    dimension: str  # '2d' or '3d'
    corrected: bool
    reduction: str  # 'consistent' or 'paper'; without meaning in 3D


def model(name: str, default_reduction: str) -> Model:
    """Take a model's name apart, for instance ``2d-corrected-paper``."""
    parts = name.split("-")
    reduction = parts[-1] if parts[-1] in ("paper", "consistent") else default_reduction
    return Model(name, parts[0], "corrected" in parts, reduction)


def sweep_cases(config: Config, model_name: str | None = None) -> list[str]:
    """Return the names of the cases of the sweep, by ascending values.

    Of one whose onset is found by a learnt model they are the first release, which a ``model_name``
    that learns from another's has not.
    """
    if learns(config):
        other = model_name is not None and learner(config, model_name) != model_name
        return [] if other else [point.name for point in first_points(config)]
    return [point.name for point in sweep_points(config)]


def learns(config: Config) -> bool:
    """Tell whether a model that is learnt from releases takes the place of the sweep."""
    return config.sweep.onset == "model"


def learner(config: Config, name: str) -> str:
    """Return the model whose releases a model is learnt from: one for all sections, or the beam.

    The loads under a motion are those of the same flow, whatever the section's mass and springs.
    """
    if model(name, config.reduction).dimension == "3d":
        return name
    sections = [
        one for one in config.sweep.models if model(one, config.reduction).dimension == "2d"
    ]
    plain = [one for one in sections if not model(one, config.reduction).corrected]
    return next(iter([*plain, *sections]), name)


def first_release(config: Config) -> float:
    """Return the value (k* or speed) of the first release, the middle of the sweep by default."""
    if config.rom.learn_from != "auto":
        return config.rom.learn_from[0]
    values = config.sweep.values()
    return float(f"{math.sqrt(min(values) * max(values)):.4g}")


def first_points(config: Config) -> list[Point]:
    """Return the points of the first releases that are learnt from: one at each incidence."""
    axes = varied(config)
    release = {onset_axis(axes): first_release(config)}
    angles = axes.get(INCIDENCE)
    if angles is None:
        return [Point.at(release)]
    return [Point.at({**release, INCIDENCE: angle}) for angle in angles]


def learnt_names(config: Config) -> list[str]:
    """Return the names of the files of a learnt model: one at each incidence of the study."""
    angles = varied(config).get(INCIDENCE)
    if angles is None:
        return ["model"]
    return [f"model_{Point.at({INCIDENCE: angle}).name}" for angle in angles]


def steady_cases(config: Config) -> list[str]:
    """Return the names of the steady cases of either dimension, resolution by resolution."""
    return [name for resolution in resolutions(config) for name in rigid_cases(config, resolution)]


def rigid_cases(config: Config, resolution: str) -> list[str]:
    """Return the names of the steady cases of either dimension at a resolution."""
    return [rigid_case(resolution, angle) for angle in incidences(config, resolution)]


def rigid_case(resolution: str, incidence_deg: float) -> str:
    """Return the name of a steady case, for instance ``coarse_a2.5``."""
    return Point.at({INCIDENCE: incidence_deg}, resolution).name


def rigid_point(name: str) -> tuple[str, float]:
    """Return resolution and incidence (deg) of a steady case.

    Raises
    ------
    ValueError
        It is the name of no steady case.
    """
    point = Point.named(name)
    if not point.resolution:
        raise ValueError(f"{name!r} is no name of a steady case, such as 'coarse_a2.5'")
    return point.resolution, point[INCIDENCE]


def incidences(config: Config, resolution: str) -> tuple[float, ...]:
    """Return the incidences (deg) that a resolution is run at."""
    steady = config.steady
    of_study = steady.study_incidence_deg or steady.incidence_deg
    return steady.incidence_deg if resolution == steady.resolution else of_study


def resolutions(config: Config) -> tuple[str, ...]:
    """Return the resolutions of the steady cases: that of the run, then those of the study."""
    return (config.steady.resolution, *config.steady.study)


def refinement_rounds(config: Config) -> int:
    """Return the number of rounds that find a bracket and narrow it to the tolerance.

    Each round of n points leaves at most one of n + 1 equal parts of the widest bracket of the
    sweep. Where the onset is beyond its ends, :func:`rounds_beyond` come before, and leave a
    bracket of their own width.
    """
    if learns(config):
        return len(LEARNING_ROUNDS)
    if config.sweep.onset != "refine":
        return 0
    values = varied(config)
    along = values[onset_axis(values)]
    widest = max(((b - a) / a for a, b in itertools.pairwise(along)), default=0.0)
    beyond = rounds_beyond(config)
    within = _rounds_to_narrow(config, widest)
    return max(within, beyond + _rounds_to_narrow(config, STRIDE - 1.0) if beyond else 0)


def highest_of_sweep(config: Config) -> float:
    """Return the value above which no run of the sweep may be: the speed of Mach 0.3 (m/s)."""
    if SPEED not in varied(config):
        return math.inf
    return LARGEST_MACH * config.flow.sound_speed


def rounds_beyond(config: Config) -> int:
    """Return the number of rounds that look beyond the ends of the sweep, in strides."""
    strides = math.log(config.sweep.onset_reach) / math.log(STRIDE)
    return math.ceil(strides / config.sweep.onset_points - 1e-9)


def _rounds_to_narrow(config: Config, width: float) -> int:
    """Return the number of rounds that narrow a bracket of a relative width to the tolerance."""
    if width <= config.sweep.onset_tolerance:
        return 0
    parts = config.sweep.onset_points + 1
    return math.ceil(math.log(width / config.sweep.onset_tolerance) / math.log(parts) - 1e-9)


def batches(config: Config) -> list[str]:
    """Return the batches of a model: the sweep, then the rounds of refinement."""
    return [SWEEP_BATCH, *(f"round{n}" for n in range(1, refinement_rounds(config) + 1))]


def sections_together(config: Config) -> tuple[str, ...]:
    """Return the models of a section whose sweeps one job runs, none if each has its own.

    A solver that takes many cases marches them at the cost of one model. More than `MOST_TOGETHER`
    cases are divided by model, for the processors that there may be.
    """
    sections = tuple(
        name for name in config.sweep.models if model(name, config.reduction).dimension == "2d"
    )
    many = len(sections) * len(sweep_cases(config)) > MOST_TOGETHER
    alone = Capability.BATCH not in SOLVERS[config.solver].provides or len(sections) < 2
    return () if many or alone else sections


def batches_before(batch: str) -> list[str]:
    """Return the batches that a round of refinement decides on."""
    return [SWEEP_BATCH, *(f"round{n}" for n in range(1, int(batch.removeprefix("round"))))]


def starts_by_polar(config: Config) -> bool:
    """Tell whether section and beam start from the equilibrium that the run's steady polars have.

    A solver whose motions are equations knows it by itself.
    """
    is_known = Capability.STATES in SOLVERS[config.solver].provides
    return config.unsteady.start.state == "equilibrium" and not is_known


@dataclass(frozen=True)
class PlannedCases:
    """Cases of a kind that a configuration asks for: of one model, at one resolution.

    Attributes
    ----------
    kind
        Their kind.
    model
        Model of the sweep, or dimension of rigid cases: the folder of their files.
    dimension
        Dimension, ``2d`` or ``3d``.
    resolution
        Resolution.
    names
        Names of the cases.
    refined
        Further cases, at most, that the refinement of the onset asks for.
    """

    kind: Kind
    model: str
    dimension: str
    resolution: str
    names: tuple[str, ...]
    refined: int = 0


def planned_cases(config: Config) -> Iterator[PlannedCases]:
    """Yield the cases that a configuration asks for, kind by kind in the order of a run."""
    for dimension in steady_dimensions(config):
        for resolution in resolutions(config):
            names = tuple(rigid_cases(config, resolution))
            yield PlannedCases(STEADY, dimension, dimension, resolution, names)
    refined = refinement_rounds(config) * config.sweep.onset_points
    if learns(config):
        refined = config.rom.most_runs * len(learnt_names(config))
    for name in config.sweep.models:
        dimension = model(name, config.reduction).dimension
        of_sweep = tuple(sweep_cases(config, name))
        yield PlannedCases(FREE, name, dimension, config.run_resolution, of_sweep, refined)
    for dimension in forced_dimensions(config):
        names = forced_names(config, dimension)
        yield PlannedCases(FORCED, dimension, dimension, config.steady.resolution, names)


def forced_dimensions(config: Config) -> tuple[str, ...]:
    """Return the dimensions of the forced motions: the section, and the beam if its modes move."""
    if not config.forced.run:
        return ()
    return ("2d", "3d") if config.forced.beam_modes else ("2d",)


def forced_names(config: Config, dimension: str = "2d") -> tuple[str, ...]:
    """Return the names of the forced cases of a dimension.

    Such as ``pitch`` or ``heave_v12`` of the section, and ``bending1`` or ``torsion2_v12`` of the
    beam.
    """
    parts = [""]
    if config.forced.motion == "harmonic":
        parts = [f"_v{velocity:.6g}" for velocity in config.forced.reduced_velocity]
    moved = ["pitch", "heave"]
    if dimension == "3d":
        numbers = range(1, config.forced.beam_modes + 1)
        moved = [f"{kind}{number}" for kind in ("bending", "torsion") for number in numbers]
    return tuple(f"{component}{part}" for component in moved for part in parts)


def write_refinement(path: Path, points: Sequence[Point]) -> None:
    """Write the points that a round of refinement chose, by the names of their cases."""
    write_text(path, json.dumps({"cases": [point.name for point in points]}) + "\n")


def read_refinement(path: Path) -> list[str]:
    """Return the names of the cases that a round of refinement chose."""
    names: list[str] = json.loads(path.read_text(encoding="utf-8"))["cases"]
    require_plain_names(names)
    return names


def dimensions(config: Config) -> set[str]:
    """Return the dimensions of the models that are compared."""
    return {model(name, config.reduction).dimension for name in config.sweep.shown}


def has_both(config: Config) -> bool:
    """Tell whether both a section and the beam are compared."""
    return dimensions(config) == {"2d", "3d"}


def steady_dimensions(config: Config) -> tuple[str, ...]:
    """Return the dimensions of the steady cases; a beam whose polar is given has none.

    Nor has one that no model needs and whose solver leaves it out then.
    """
    models, outline = config.sweep.models, config.beam.outline
    if config.steady.beam_polar or not config.solver_section.runs_rigid_beam(outline, models):
        return ("2d",)
    return SOLVERS[config.solver].dimensions


def has_beam_polar(config: Config) -> bool:
    """Tell whether the rigid beam's polar is given or computed, and with it the correction."""
    return bool(config.steady.beam_polar) or "3d" in steady_dimensions(config)


def corrects(config: Config) -> bool:
    """Tell whether a model of the sweep is a section with the correction for the finite span."""
    return any(model(name, config.reduction).corrected for name in config.sweep.models)


def has_mesh(config: Config) -> bool:
    """Tell whether the configured solver has a mesh."""
    return Capability.MESH in SOLVERS[config.solver].provides


def has_surface(config: Config) -> bool:
    """Tell whether the configured solver has pressure and friction along the section."""
    return Capability.SURFACE in SOLVERS[config.solver].provides


def has_stability_map(config: Config) -> bool:
    """Tell whether the run has a map of stability: incidences, and equations of motion.

    These are the solver's, or those of the models that were learnt.
    """
    if not config.sweep.incidence_deg:
        return False
    return learns(config) or Capability.STATES in SOLVERS[config.solver].provides


def has_learnt_map(config: Config) -> bool:
    """Tell whether the map of stability is one of learnt models."""
    return has_stability_map(config) and learns(config)


def has_grid_study(config: Config) -> bool:
    """Tell whether the section is run on the three meshes that an order of convergence needs."""
    return has_mesh(config) and len(resolutions(config)) >= 3


def stiffest_case(names: Iterable[str]) -> str | None:
    """Return the case of the stiffest beam relative to the flow: largest k*, or lowest speed."""

    def stiffness(name: str) -> float:
        point = Point.named(name)
        axis = onset_axis(point.axes)
        return axis.stability(point[axis])

    return max(names, key=stiffness, default=None)
