"""Fig. 6: section polars at each resolution."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.figures.save import save_figure
from equisection.figures.section_polar import draw
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(polar_2d: Path, grid_study: Sequence[Path], style: Path, outputs: Sequence[Path]) -> None:
    """Draw the section's polars; ``grid_study`` is one table, or none."""
    tables = [pd.read_csv(path) for path in grid_study]
    with drawing_style(style):
        save_figure(draw(read_dataset(polar_2d), *tables), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.polar_2d),
            [Path(path) for path in snakemake.input.grid_study],
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
