"""Fig. 11: pressure and wall shear stress on both sides of the rigid plate."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.incidences import nearest_incidences
from equisection.figures.origin import solver_of
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.figures.surface_of_beam import WANTED_DEG, ShownSurface, draw
from equisection.results.netcdf import read_dataset
from equisection.results.plate_surface import plate_surface_from_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(index: Path, resolution: str, style: Path, outputs: Sequence[Path]) -> None:
    """Draw what the results at a resolution have, of the incidences nearest to those wanted."""
    names = {plan.rigid_point(name): name for name in read_index(index)}
    found, without, source = {}, [], ""
    for (_, angle), name in sorted(item for item in names.items() if item[0][0] == resolution):
        result = read_dataset(result_file(index, name))
        source = solver_of(str(result.attrs["solver_description"]), resolution)
        surface = plate_surface_from_dataset(result)
        if surface is None:
            without.append(f"{angle:g}")
        else:
            found[angle] = ShownSurface(surface, str(result.attrs["method"]))
    shown = {angle: found[angle] for angle in nearest_incidences(list(found), WANTED_DEG)}
    missing = [f"no surface data at {', '.join(without)} deg"] if without else []
    with drawing_style(style):
        save_figure(draw(shown, missing, source), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.index),
            snakemake.params.resolution,
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
