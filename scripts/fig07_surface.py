"""Fig. 7: y+, pressure and friction along the section, and the length of its bubble."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.figures.surface_loads import draw, incidences_shown
from equisection.paper.printed_values import BUBBLE_2D
from equisection.results.netcdf import read_dataset
from equisection.results.surface import surface_from_dataset
from equisection.run.script import logged
from equisection.store.index import result_file
from equisection.study import plan


def main(
    index: Path,
    bubble: Path,
    resolution: str,
    incidence_deg: float,
    *,
    is_paper_case: bool,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw what the results at a resolution have of the incidence of the run (deg) and others."""
    table = pd.read_csv(bubble)
    there = table[(table["resolution"] == resolution) & table["bubble"].notna()]
    surfaces = {}
    for angle in incidences_shown(there["incidence_deg"].tolist(), incidence_deg):
        result = read_dataset(result_file(index, plan.rigid_case(resolution, angle)))
        surface = surface_from_dataset(result)
        if surface is not None:
            surfaces[angle] = surface
    stated = BUBBLE_2D if is_paper_case else {}
    with drawing_style(style):
        save_figure(draw(surfaces, table, resolution, stated), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.index),
            Path(snakemake.input.bubble),
            snakemake.params.resolution,
            snakemake.params.incidence_deg,
            is_paper_case=snakemake.params.is_paper_case,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
