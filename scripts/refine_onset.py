"""Choose the next points inside the bracket of a model's onset."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.onset import next_points
from equisection.analysis.summary import summary_of
from equisection.run.script import logged
from equisection.study import plan


def main(indices: Sequence[Path], tolerance: float, points: int, output: Path) -> None:
    """Write the points that narrow the bracket; none when it is open or narrow enough."""
    plan.write_refinement(output, next_points(summary_of(indices), tolerance, points))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.indices],
            snakemake.params.tolerance,
            snakemake.params.points,
            Path(snakemake.output[0]),
        )
