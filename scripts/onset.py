"""Onset and critical speed of each model, linear theory, and the sections against the beam."""

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from equisection.analysis import critical_speeds
from equisection.analysis.deviations import deviations
from equisection.analysis.learning import onsets_of
from equisection.analysis.linear_theory import (
    linear_onset,
    linear_theory,
    moment_slope,
    with_linear_theory,
)
from equisection.analysis.onset import onset_table, with_speeds
from equisection.config import load_config
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.results.section_dataset import nominal_k_star, section_from_dataset
from equisection.run.script import logged
from equisection.solvers.protocol import HasSectionLoads
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.axes import INCIDENCE, SPEED, AsGiven, onset_axis, varied


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
    learnt: Sequence[Path] = (),
) -> None:
    """Bracket the onset of each model, in k* and speed, and add that of linear theory.

    ``learnt`` are the models learnt from releases, whose onsets are added.
    """
    sections = read_dataset(equivalent)
    axis = float(sections["elastic_axis"][0])
    slope = moment_slope(read_dataset(polar_2d), resolution, incidence_deg, axis)
    linear = linear_onset(sections, slope)
    table = with_linear_theory(onset_table(pd.read_csv(summary)), linear, reduction)
    table = with_speeds(table, AsGiven(nominal_k_star(sections), speed))
    if learnt:
        table = table.merge(onsets_of([read_dataset(path) for path in learnt]), how="outer")
    _write(table, output)


def speeds(
    summary: Path,
    equivalent: Path,
    raw_config: dict[str, Any],
    output: Path,
    learnt: Sequence[Path] = (),
) -> None:
    """Write the critical speed of each model, and tell it."""
    config, data = load_config(raw_config), read_dataset(equivalent)
    flow, table = config.flow, pd.read_csv(summary)
    given = AsGiven(nominal_k_star(data), flow.speed)
    solver = solver_from_config(config, config.steady.resolution)
    found = [
        critical_speeds.from_runs(
            table,
            given=given,
            chord=config.beam.chord,
            incidence_deg=flow.incidence_deg,
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
        if model.dimension == "2d" and not model.corrected
    }
    if isinstance(solver, HasSectionLoads) and sections:
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
    critical = critical_speeds.with_margin(found, flow.design_speed)
    for line in critical_speeds.in_words(critical):
        logging.getLogger(__name__).info("%s", line)
    _write(critical, output)


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
            learnt,
        )
        for table in snakemake.output.section_and_beam:
            sections_against_beam(summary, Path(table))
