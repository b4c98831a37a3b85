"""How far each section is from the beam: a table, and the figure of it."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.analysis.section_and_beam import deviations
from equisection.figures.save import save_figure
from equisection.figures.section_against_beam import draw
from equisection.figures.style import drawing_style
from equisection.files import written_whole
from equisection.run.script import logged


def main(summary: Path, *, style: Path, output: Path, figures: Sequence[Path]) -> None:
    """Write the table and draw the figure."""
    runs = pd.read_csv(summary)
    table = deviations(runs)
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")
    with drawing_style(style):
        save_figure(draw(table, runs), figures)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.summary),
            style=Path(snakemake.input.style),
            output=Path(snakemake.output.table),
            figures=[Path(snakemake.output[kind]) for kind in ("png", "svg", "pdf")],
        )
