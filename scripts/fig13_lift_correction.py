"""Fig. 13: lift of section, root and beam, and its correction factor."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.lift_correction import draw
from equisection.figures.load_correction import SteadyData
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(
    polar_2d: Path,
    polar_3d: Path,
    correction: Path,
    resolution: str,
    *,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the lift and its correction factor at a resolution."""
    data = SteadyData(
        read_dataset(polar_2d), read_dataset(polar_3d), read_dataset(correction), resolution
    )
    with drawing_style(style):
        save_figure(draw(data), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.polar_2d),
            Path(snakemake.input.polar_3d),
            Path(snakemake.input.correction),
            snakemake.params.resolution,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
