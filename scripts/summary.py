"""One line for each run of each model."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.summary import summary_of
from equisection.files import written_whole
from equisection.run.script import logged


def main(indices: Sequence[Path], output: Path) -> None:
    """Summarise the verdicts; the folder of an index is named after its model."""
    with written_whole(output) as aside:
        summary_of(indices).to_csv(aside, index=False)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main([Path(path) for path in snakemake.input.indices], Path(snakemake.output[0]))
