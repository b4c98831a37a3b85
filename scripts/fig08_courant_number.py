"""Fig. 8: the Courant number on the mesh of the section."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.courant_number import draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(section_mesh: Path, style: Path, outputs: Sequence[Path]) -> None:
    """Draw the Courant number."""
    with drawing_style(style):
        save_figure(draw(read_dataset(section_mesh)), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.section_mesh),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
