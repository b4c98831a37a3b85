"""Onset and critical speed of each model, linear theory, and the sections against the beam."""

import logging
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from equisection.analysis import critical_speeds
from equisection.analysis.deviations import deviations
from equisection.analysis.known_growth_error import (
    KnownErrors,
    known_errors_of,
    with_known_errors,
)
from equisection.analysis.known_growth_error import in_words as errors_in_words
from equisection.analysis.linear_theory import (
    linear_onset,
    linear_theory,
    moment_slope,
    with_linear_theory,
)
from equisection.analysis.onset import onset_table, with_speeds
from equisection.beam.section import Section
from equisection.config import Config, load_config
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.results.section_dataset import nominal_k_star, section_from_dataset
from equisection.run.script import logged
from equisection.solvers.known_error import KnownError
from equisection.solvers.protocol import HasSectionLoads, Solver
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.assemble import section_refusal
from equisection.study.axes import INCIDENCE, SPEED, AsGiven, onset_axis, varied

if TYPE_CHECKING:  # what few runs ask for is imported where it is asked for
    from equisection.aerodynamics.generalised_forces import GeneralisedForces
    from equisection.analysis.derivative_speeds import Equilibrium
    from equisection.motion.derivative_flutter import FlowingBody
    from equisection.structure.modal_matrices import ModalMatrices


def main(
    summary: Path,
    equivalent: Path,
    polar_2d: Path,
    *,
    resolution: str,
    incidence_deg: float,
    speed: float,
    reduction: str,
    output: Path,
    known: KnownErrors | None = None,
    learnt: Sequence[Path] = (),
) -> None:
    """Bracket the onset of each model, in k* and speed, and add linear theory and known errors.

    ``learnt`` are the models learnt from releases, whose onsets are added.
    """
    sections = read_dataset(equivalent)
    axis = float(sections["elastic_axis"][0])
    slope = moment_slope(read_dataset(polar_2d), resolution, incidence_deg, axis)
    linear = linear_onset(sections, slope)
    table = with_linear_theory(onset_table(pd.read_csv(summary)), linear, reduction)
    table = with_speeds(table, AsGiven(nominal_k_star(sections), speed))
    table = with_known_errors(table, known or {})
    if learnt:
        from equisection.analysis.learnt_dataset import onsets_of  # noqa: PLC0415

        found = [read_dataset(path) for path in learnt]
        over_incidence = INCIDENCE.name in table
        table = table.merge(onsets_of(found, over_incidence=over_incidence), how="outer")
    _write(table, output)


def known_errors(summary: Path, raw_config: dict[str, Any]) -> dict[tuple[str, str], KnownError]:
    """Return what is known of the error of each model's growth, by model and basis."""
    config = load_config(raw_config)
    solver = solver_from_config(config, config.run_resolution)
    models = [plan.model(name, config.reduction) for name in config.sweep.models]
    dimensions = {model.name: model.dimension for model in models}
    return known_errors_of(solver, dimensions, pd.read_csv(summary))


def speeds(
    summary: Path,
    equivalent: Path,
    raw_config: dict[str, Any],
    output: Path,
    *,
    known: KnownErrors | None = None,
    learnt: Sequence[Path] = (),
    stability: Path | None = None,
    modes: Path | None = None,
    table_of_derivatives: Path | None = None,
    forces_on_modes: Path | None = None,
) -> None:
    """Write the critical speed of each model with its known error, and tell it.

    ``stability`` is the table of the map of stability, of a run that has one.
    """
    config, data = load_config(raw_config), read_dataset(equivalent)
    flow, table = config.flow, pd.read_csv(summary)
    given = AsGiven(nominal_k_star(data), flow.speed)
    solver = solver_from_config(config, config.run_resolution)
    found = [
        critical_speeds.from_runs(
            table,
            given=given,
            chord=config.beam.chord,
            incidence_deg=flow.incidence_deg,
            bases={config.solver: config.solver_section.said_basis},
        )
    ]
    if learnt:
        found.append(
            critical_speeds.from_learnt(
                [read_dataset(path) for path in learnt], given=given, chord=config.beam.chord
            )
        )
    models = [plan.model(name, config.reduction) for name in config.sweep.models]
    sections = {
        model.name: section_from_dataset(data, model.reduction)
        for model in models
        if model.dimension == "2d"
        and not model.corrected
        and not section_refusal(data, model.reduction)
    }
    if stability is not None:
        found.append(critical_speeds.from_map(pd.read_csv(stability)))
    elif isinstance(solver, HasSectionLoads) and sections:
        values = config.sweep.values()
        if onset_axis(varied(config)) is not SPEED:
            values = tuple(map(given.speed_at, values))
        reach = config.sweep.onset_reach
        polar, lags = solver.section_loads
        found.append(
            critical_speeds.from_eigenvalues(
                sections,
                polar,
                lags,
                incidence_deg=sorted(varied(config).get(INCIDENCE, (flow.incidence_deg,))),
                speed=(min(values) / reach, max(values) * reach),
                density=flow.density,
            )
        )
    if table_of_derivatives is not None:
        from equisection.aerodynamics.derivatives import Derivatives  # noqa: PLC0415
        from equisection.aerodynamics.generalised_forces import GeneralisedForces  # noqa: PLC0415
        from equisection.analysis.derivative_speeds import from_derivatives  # noqa: PLC0415
        from equisection.motion.derivative_flutter import FlowingBody  # noqa: PLC0415

        bodies = {
            name: FlowingBody.of_section(section, flow.density)
            for name, section in sections.items()
        }
        if modes is not None and forces_on_modes is None:
            bodies |= _beam(config, modes)
        derivatives = Derivatives.read(table_of_derivatives)
        by_table, remarks = from_derivatives(
            bodies,
            derivatives,
            given=given,
            incidence_deg=flow.incidence_deg,
            equilibrium=_equilibrium(config, solver, sections),
        )
        found.append(by_table)
        if modes is not None and forces_on_modes is not None:
            from equisection.analysis.derivative_speeds import from_moved_beam  # noqa: PLC0415

            forces = GeneralisedForces.read(forces_on_modes)
            moved = _moved_beam(config, modes, forces)
            of_beam, more = from_moved_beam("3d", moved, forces, given=given)
            found.append(of_beam)
            remarks += more
        for remark in remarks:
            logging.getLogger(__name__).warning("%s", remark)
    critical = critical_speeds.with_margin(found, flow.design_speed)
    for line in critical_speeds.in_words(critical) + errors_in_words(known or {}):
        logging.getLogger(__name__).info("%s", line)
    _write(with_known_errors(critical, known or {}, list(critical["basis"])), output)


def _equilibrium(
    config: Config, solver: Solver, sections: Mapping[str, Section]
) -> "Equilibrium | None":
    """Return the incidence of static equilibrium by the solver's polar, if it has equations."""
    if not isinstance(solver, HasSectionLoads):
        return None
    from equisection.motion.stability import stability  # noqa: PLC0415

    polar, lags = solver.section_loads
    flow = config.flow

    def incidence(model: str, speed: float) -> float:
        if model not in sections:
            return math.nan
        there = stability(
            sections[model],
            polar,
            incidence_deg=flow.incidence_deg,
            speed=speed,
            density=flow.density,
            lags=lags,
        )
        return flow.incidence_deg + math.degrees(float(there["equilibrium_twist"]))

    return incidence


def _beam(config: Config, modes: Path) -> dict[str, "FlowingBody"]:
    """Return the beam on the modes of its structure."""
    from equisection.motion.derivative_flutter import FlowingBody  # noqa: PLC0415

    beam, structure = config.beam, config.structure
    matrices = _matrices(config, modes, structure.bending_modes, structure.torsion_modes)
    body = FlowingBody.of_beam(matrices, beam.chord, beam.elastic_axis, config.flow.density)
    return {"3d": body}


def _moved_beam(config: Config, modes: Path, forces: "GeneralisedForces") -> "FlowingBody":
    """Return the beam on the modes that were moved."""
    from equisection.motion.derivative_flutter import FlowingBody  # noqa: PLC0415

    beam, torsion = config.beam, len(forces.modes) - forces.bending
    matrices = _matrices(config, modes, forces.bending, torsion)
    return FlowingBody.of_moved_beam(matrices, beam.chord, beam.elastic_axis, config.flow.density)


def _matrices(config: Config, modes: Path, bending: int, torsion: int) -> "ModalMatrices":
    from equisection.results.modes_dataset import modes_from_dataset  # noqa: PLC0415
    from equisection.structure.modal_matrices import modal_matrices  # noqa: PLC0415

    found = modes_from_dataset(read_dataset(modes))
    return modal_matrices(config.beam, found, bending, torsion)


def growth_by_linear_theory(
    equivalent: Path, values: Sequence[float], along: str, speed: float, output: Path
) -> None:
    """Write growth and frequency of both motions of both reductions at each k*, or speed."""
    sections = read_dataset(equivalent)
    given = AsGiven(nominal_k_star(sections), speed)
    k_star = [given.k_star_at(one) for one in values] if along == SPEED.name else values
    _write(linear_theory(sections, k_star, speed), output)


def sections_against_beam(summary: Path, output: Path) -> None:
    """Write the deviation of each section from the beam at each k*."""
    _write(deviations(pd.read_csv(summary)), output)


def _write(table: pd.DataFrame, output: Path) -> None:
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        summary, equivalent = Path(snakemake.input.summary), Path(snakemake.input.equivalent)
        known = known_errors(summary, snakemake.params.config)
        learnt = [Path(path) for path in snakemake.input.learnt]
        main(
            summary,
            equivalent,
            Path(snakemake.input.polar_2d),
            resolution=snakemake.params.resolution,
            incidence_deg=snakemake.params.incidence_deg,
            speed=snakemake.params.speed,
            reduction=snakemake.params.reduction,
            output=Path(snakemake.output.onset),
            known=known,
            learnt=learnt,
        )
        growth_by_linear_theory(
            equivalent,
            list(snakemake.params.values),
            snakemake.params.along,
            snakemake.params.speed,
            Path(snakemake.output.linear_theory),
        )
        speeds(
            summary,
            equivalent,
            snakemake.params.config,
            Path(snakemake.output.critical_speed),
            learnt=learnt,
            known=known,
            stability=next(map(Path, snakemake.input.stability), None),
            modes=next(map(Path, snakemake.input.modes), None),
            table_of_derivatives=next(map(Path, snakemake.input.derivatives), None),
            forces_on_modes=next(map(Path, snakemake.input.forces), None),
        )
        for table in snakemake.output.section_and_beam:
            sections_against_beam(summary, Path(table))
