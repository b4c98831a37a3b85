"""Choose the next k* inside the bracket of a model's onset."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.onset import bracket_of, refinement_points
from equisection.analysis.summary import summarise
from equisection.run.script import logged
from equisection.store.index import read_index
from equisection.study import plan


def main(indices: Sequence[Path], tolerance: float, points: int, output: Path) -> None:
    """Write the k* that narrow the bracket; none when it is open or narrow enough."""
    rows = [
        (index.parent.name, attributes)
        for index in indices
        for attributes in read_index(index).values()
    ]
    bracket = bracket_of(summarise(rows))
    plan.write_refinement(output, refinement_points(bracket, tolerance, points))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.indices],
            snakemake.params.tolerance,
            snakemake.params.points,
            Path(snakemake.output[0]),
        )
