"""Learn the model of the loads of a section or beam from its releases, and what it predicts."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.learning import Lessons
from equisection.analysis.learnt_dataset import datasets_of
from equisection.config import load_config
from equisection.results.netcdf import write_dataset
from equisection.run.script import logged


def main(lessons: Lessons, outputs: Sequence[Path]) -> None:
    """Write the model at each incidence, and tell whether runs bear it out."""
    for output, data in zip(outputs, datasets_of(lessons), strict=True):
        write_dataset(output, data)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Lessons.read(
                load_config(snakemake.params.config),
                snakemake.wildcards.model,
                dict(snakemake.input.items()),
            ),
            [Path(path) for path in snakemake.output],
        )
