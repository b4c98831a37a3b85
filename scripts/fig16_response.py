"""Fig. 16: mean deformation over k*, and histories of the twist."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.beam.beam import FREE_TIP
from equisection.figures.response import AT_THE_TIP, WHERE_LARGEST, draw, read_response
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
    boundary: str,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the means of all models, and the histories of the chosen cases."""
    i_star = float(read_dataset(equivalent)["i_star"].sel(reduction=reduction))
    place = AT_THE_TIP if boundary in FREE_TIP else WHERE_LARGEST
    response = read_response(
        pd.read_csv(summary),
        pd.read_csv(onset),
        result_files(indices),
        i_star,
        place=place,
        reduction=reduction,
    )
    with drawing_style(style):
        save_figure(draw(response), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.summary),
            Path(snakemake.input.onset),
            [Path(path) for path in snakemake.input.indices],
            Path(snakemake.input.equivalent),
            snakemake.params.reduction,
            boundary=snakemake.params.boundary,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
