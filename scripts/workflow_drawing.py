"""Block diagram of the workflow: the drawing that is kept, put among a run's figures."""

import shutil
from collections.abc import Sequence
from pathlib import Path

from equisection.files import written_whole
from equisection.run.script import logged


def main(drawings: Sequence[Path], outputs: Sequence[Path]) -> None:
    """Copy the drawing in each format that is asked for."""
    kept = {path.suffix: path for path in drawings}
    for output in outputs:
        with written_whole(output) as aside:
            shutil.copyfile(kept[output.suffix], aside)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input],
            [Path(path) for path in snakemake.output],
        )
