"""Onset of each model, classical linear theory, and the sections against the beam."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.analysis.deviations import deviations
from equisection.analysis.linear_theory import (
    linear_onset,
    linear_theory,
    moment_slope,
    with_linear_theory,
)
from equisection.analysis.onset import onset_table, with_speeds
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.results.section_dataset import nominal_k_star
from equisection.run.script import logged


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
) -> None:
    """Bracket the onset of each model, in k* and speed, and add that of linear theory."""
    sections = read_dataset(equivalent)
    axis = float(sections["elastic_axis"][0])
    slope = moment_slope(read_dataset(polar_2d), resolution, incidence_deg, axis)
    linear = linear_onset(sections, slope)
    table = with_linear_theory(onset_table(pd.read_csv(summary)), linear, reduction)
    _write(with_speeds(table, nominal_k_star(sections), speed), output)


def growth_by_linear_theory(equivalent: Path, k_star: Sequence[float], output: Path) -> None:
    """Write growth and frequency of both motions of both reductions at each k*."""
    _write(linear_theory(read_dataset(equivalent), k_star), output)


def sections_against_beam(summary: Path, output: Path) -> None:
    """Write the deviation of each section from the beam at each k*."""
    _write(deviations(pd.read_csv(summary)), output)


def _write(table: pd.DataFrame, output: Path) -> None:
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        summary, equivalent = Path(snakemake.input.summary), Path(snakemake.input.equivalent)
        main(
            summary,
            equivalent,
            Path(snakemake.input.polar_2d),
            resolution=snakemake.params.resolution,
            incidence_deg=snakemake.params.incidence_deg,
            speed=snakemake.params.speed,
            reduction=snakemake.params.reduction,
            output=Path(snakemake.output.onset),
        )
        growth_by_linear_theory(
            equivalent, list(snakemake.params.k_star), Path(snakemake.output.linear_theory)
        )
        for table in snakemake.output.section_and_beam:
            sections_against_beam(summary, Path(table))
