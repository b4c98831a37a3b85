"""Figures of one job, each in every format, under its name and any other that it goes by."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.figures.catalogue import draw, entry_of
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.files import second_name
from equisection.run.script import logged


def main(
    names: Mapping[str, str],
    files: Mapping[str, Path | Sequence[Path]],
    values: Mapping[str, Any],
    *,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw figures; ``names`` has the further name of each, or an empty one."""
    for name, further in names.items():
        pictures = [path for path in outputs if path.stem == name]
        with drawing_style(style):
            save_figure(draw(entry_of(name), files, values), pictures)
        for picture in pictures if further else ():
            second_name(picture, picture.with_stem(further))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        given = {
            name: Path(value) if isinstance(value, str) else [Path(path) for path in value]
            for name, value in snakemake.input.items()
        }
        main(
            snakemake.params.names,
            given,
            snakemake.params["values"],
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
