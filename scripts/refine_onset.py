"""Choose the next points inside the bracket of a model's onset, or beyond the sweep's ends."""

import math
from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.onset import next_points
from equisection.analysis.summary import summary_of
from equisection.run.script import logged
from equisection.study import plan


def main(
    indices: Sequence[Path],
    tolerance: float,
    points: int,
    output: Path,
    *,
    given: tuple[float, float] = (math.nan, math.nan),
    reach: float = 1.0,
    highest: float = math.inf,
) -> None:
    """Write the points that narrow the bracket, or look for one; none when none is left."""
    chosen = next_points(
        summary_of(indices), tolerance, points, given=given, reach=reach, highest=highest
    )
    plan.write_refinement(output, chosen)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.indices],
            snakemake.params.tolerance,
            snakemake.params.points,
            Path(snakemake.output[0]),
            given=snakemake.params.given,
            reach=snakemake.params.reach,
            highest=snakemake.params.highest,
        )
