"""Fig. 10: lift and moment along the span."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.save import save_figure
from equisection.figures.spanwise_loads import draw
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(polar_3d: Path, resolution: str, style: Path, outputs: Sequence[Path]) -> None:
    """Draw the loads along the span at a resolution."""
    with drawing_style(style):
        save_figure(draw(read_dataset(polar_3d), resolution), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.polar_3d),
            snakemake.params.resolution,
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
