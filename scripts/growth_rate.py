"""Growth rate and frequency over k* of every model, beside those of linear theory."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.figures.growth_rate import draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.run.script import logged


def main(
    summary: Path,
    linear_theory: Path,
    *,
    is_paper_case: bool,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the growth rates of the runs and of linear theory."""
    tables = pd.read_csv(summary), pd.read_csv(linear_theory)
    with drawing_style(style):
        save_figure(draw(*tables, is_paper_case=is_paper_case), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.summary),
            Path(snakemake.input.linear_theory),
            is_paper_case=snakemake.params.is_paper_case,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
