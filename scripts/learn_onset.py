"""Choose the releases that a model of the loads is learnt from, and the runs that confirm it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.analysis.learning import Lessons
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.study import plan


def main(
    raw_config: dict[str, Any],
    model: str,
    batch: str,
    files: Mapping[str, Path],
    releases: Sequence[Path],
    confirming: Sequence[Path],
    output: Path,
) -> None:
    """Write the points of a round; ``files`` has ``equivalent``, ``polar_2d``, ``correction``."""
    config = load_config(raw_config)
    data = {name: read_dataset(path) for name, path in files.items()}
    lessons = Lessons(config, model, data, releases, confirming)
    plan.write_refinement(output, lessons.next_points(batch))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        names = {"equivalent", "polar_2d", "correction"} & set(snakemake.input.keys())
        main(
            snakemake.params.config,
            snakemake.wildcards.model,
            snakemake.wildcards.batch,
            {name: Path(snakemake.input[name]) for name in names},
            [Path(path) for path in snakemake.input.releases],
            [Path(path) for path in snakemake.input.confirming],
            Path(snakemake.output[0]),
        )
