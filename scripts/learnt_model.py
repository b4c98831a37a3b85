"""Learn the model of the loads of a section from its releases, and what it predicts."""

import logging
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.analysis.learning import Lessons, dataset_of
from equisection.config import load_config
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.run.script import logged


def main(
    raw_config: dict[str, Any],
    model: str,
    files: Mapping[str, Path],
    releases: Sequence[Path],
    confirming: Sequence[Path],
    output: Path,
) -> None:
    """Write the model; ``files`` has ``equivalent``, ``polar_2d``, ``correction``."""
    config = load_config(raw_config)
    data = {name: read_dataset(path) for name, path in files.items()}
    lessons = Lessons(config, model, data, releases, confirming)
    course = lessons.course()
    log = logging.getLogger(__name__)
    (log.warning if course.at_odds else log.info)(
        "%s, %s: %s", model, course.model.words, course.confirmation
    )
    write_dataset(output, dataset_of(course, model, lessons.axis))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        names = {"equivalent", "polar_2d", "correction"} & set(snakemake.input.keys())
        main(
            snakemake.params.config,
            snakemake.wildcards.model,
            {name: Path(snakemake.input[name]) for name in names},
            [Path(path) for path in snakemake.input.releases],
            [Path(path) for path in snakemake.input.confirming],
            Path(snakemake.output[0]),
        )
