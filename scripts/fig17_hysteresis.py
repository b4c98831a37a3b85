"""Fig. 17: hysteresis loops and phase portraits."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.figures.hysteresis import draw, read_loops
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import result_files


def main(
    summary: Path,
    onset: Path,
    indices: Sequence[Path],
    equivalent: Path,
    reduction: str,
    *,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the loops of cases A and B."""
    i_star = float(read_dataset(equivalent)["i_star"].sel(reduction=reduction))
    loops = read_loops(pd.read_csv(summary), pd.read_csv(onset), result_files(indices), i_star)
    with drawing_style(style):
        save_figure(draw(loops), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.summary),
            Path(snakemake.input.onset),
            [Path(path) for path in snakemake.input.indices],
            Path(snakemake.input.equivalent),
            snakemake.params.reduction,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
