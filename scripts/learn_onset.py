"""Choose the releases that a model of the loads is learnt from, and the runs that confirm it."""

from pathlib import Path

from equisection.analysis.learning import Lessons, points_of_round
from equisection.config import load_config
from equisection.run.script import logged
from equisection.study import plan


def main(lessons: Lessons, batch: str, output: Path) -> None:
    """Write the points of a round of learning."""
    plan.write_refinement(output, points_of_round(lessons, batch))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Lessons.read(
                load_config(snakemake.params.config),
                snakemake.wildcards.model,
                dict(snakemake.input.items()),
            ),
            snakemake.wildcards.batch,
            Path(snakemake.output[0]),
        )
