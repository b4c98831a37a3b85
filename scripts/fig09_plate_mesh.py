"""Fig. 9: meshes of the plate, of the solid and of the flow."""

from collections.abc import Sequence
from pathlib import Path

from equisection.config.groups import Structure
from equisection.figures.mesh_of_beam import draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(plate_mesh: Path, structure: Structure, style: Path, outputs: Sequence[Path]) -> None:
    """Draw the mesh of the flow, and that of the solid that the configuration asks for."""
    elements = structure.elements
    counts = (elements.chord, elements.span, elements.thickness)
    with drawing_style(style):
        save_figure(draw(read_dataset(plate_mesh), structure.method, counts), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.plate_mesh),
            Structure(**snakemake.params.structure),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
