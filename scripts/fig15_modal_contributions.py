"""Fig. 15: contribution of each mode to the deformation."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.modal_contributions import draw
from equisection.figures.panels import without_data
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(modes: Path, index: Path, style: Path, outputs: Sequence[Path]) -> None:
    """Draw what each mode adds to the deformation of the stiffest beam that was run."""
    case = plan.stiffest_case(read_index(index))
    with drawing_style(style):
        if case is None:
            figure = without_data("There is no run of the beam.")
        else:
            figure = draw(read_dataset(modes), read_dataset(result_file(index, case)))
        save_figure(figure, outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        (index,) = snakemake.input.index
        main(
            Path(snakemake.input.modes),
            Path(index),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
