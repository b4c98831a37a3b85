"""Learn the model of the loads of a section or beam from its releases, and what it predicts."""

import logging
from pathlib import Path

from equisection.analysis.learning import Lessons, dataset_of
from equisection.analysis.learnt_cycles import with_cycles
from equisection.config import load_config
from equisection.results.netcdf import write_dataset
from equisection.run.script import logged


def main(lessons: Lessons, output: Path) -> None:
    """Write the model, and tell whether runs bear it out."""
    course = lessons.course()
    log = logging.getLogger(__name__)
    (log.warning if course.at_odds else log.info)(
        "%s, %s: %s", lessons.name, course.model.words, course.confirmation
    )
    dataset, cycles = dataset_of(course, lessons.name, lessons.axis), lessons.limit_cycles()
    if cycles is not None:
        dataset = with_cycles(dataset, cycles, lessons.axis)
    write_dataset(output, dataset)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Lessons.read(
                load_config(snakemake.params.config),
                snakemake.wildcards.model,
                dict(snakemake.input.items()),
            ),
            Path(snakemake.output[0]),
        )
