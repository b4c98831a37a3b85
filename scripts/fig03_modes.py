"""Fig. 3: deformation modes along the span."""

from collections.abc import Sequence
from pathlib import Path

from equisection.beam.beam import Beam
from equisection.figures.mode_shapes import analytic_shapes, draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(modes: Path, beam: Beam, style: Path, outputs: Sequence[Path]) -> None:
    """Draw the modes beside those of the analytic beam."""
    with drawing_style(style):
        save_figure(draw(read_dataset(modes), analytic_shapes(beam)), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.modes),
            Beam(**snakemake.params.beam),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
