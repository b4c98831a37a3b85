"""Fig. 15: contribution of each mode to the deformation."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.fig15_modal_contributions import draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.index import result_file
from equisection.results.netcdf import read_dataset
from equisection.script import logged


def main(modes: Path, run: Path, style: Path, outputs: Sequence[Path]) -> None:
    """Draw what each mode adds to the deformation of the beam."""
    with drawing_style(style):
        save_figure(draw(read_dataset(modes), read_dataset(run)), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.modes),
            result_file(Path(snakemake.input.index), snakemake.params.case),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
