"""The bracket of the onset of each model."""

from pathlib import Path

import pandas as pd

from equisection.comparison.onset import onset_table
from equisection.files import written_whole
from equisection.script import logged


def main(summary: Path, output: Path) -> None:
    """Bracket the onset of each model between a stable and an unstable k*."""
    with written_whole(output) as aside:
        onset_table(pd.read_csv(summary)).to_csv(aside, index=False)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(Path(snakemake.input.summary), Path(snakemake.output[0]))
