"""Choose the next k* inside the bracket of a model's onset."""

from collections.abc import Sequence
from pathlib import Path

from equisection import plan
from equisection.comparison.onset import bracket_of, refinement_points
from equisection.comparison.summary import summarise
from equisection.results.of_case import attributes_of_case
from equisection.script import logged


def main(
    cases: Sequence[Path], results: Sequence[Path], tolerance: float, points: int, output: Path
) -> None:
    """Write the k* that narrow the bracket; none when it is open or narrow enough."""
    rows = [
        (result.parent.name, attributes_of_case(case, result))
        for case, result in zip(cases, results, strict=True)
    ]
    bracket = bracket_of(summarise(rows))
    plan.write_refinement(output, refinement_points(bracket, tolerance, points))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            [Path(path) for path in snakemake.input.cases],
            [Path(path) for path in snakemake.input.results],
            snakemake.params.tolerance,
            snakemake.params.points,
            Path(snakemake.output[0]),
        )
