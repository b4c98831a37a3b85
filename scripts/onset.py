"""The bracket of the onset of each model."""

from pathlib import Path

import pandas as pd

from equisection.analysis.linear_theory import (
    linear_onset,
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
    """Bracket the onset of each model, in k* and speed, and put linear theory's beside."""
    sections = read_dataset(equivalent)
    axis = float(sections["elastic_axis"][0])
    slope = moment_slope(read_dataset(polar_2d), resolution, incidence_deg, axis)
    linear = linear_onset(sections, slope)
    table = with_linear_theory(onset_table(pd.read_csv(summary)), linear, reduction)
    table = with_speeds(table, nominal_k_star(sections), speed)
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.summary),
            Path(snakemake.input.equivalent),
            Path(snakemake.input.polar_2d),
            resolution=snakemake.params.resolution,
            incidence_deg=snakemake.params.incidence_deg,
            speed=snakemake.params.speed,
            reduction=snakemake.params.reduction,
            output=Path(snakemake.output[0]),
        )
