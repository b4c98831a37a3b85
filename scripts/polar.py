"""Gather the steady results of a dimension into its polar."""

from collections.abc import Sequence
from pathlib import Path

from equisection import plan
from equisection.results.netcdf import write_dataset
from equisection.results.of_case import dataset_of_case
from equisection.results.polar import gather_polar
from equisection.script import logged


def main(cases: Sequence[Path], results: Sequence[Path], output: Path) -> None:
    """Gather the results, each checked to be that of its case."""
    gathered = {
        plan.angle_of(result.stem): dataset_of_case(case, result)
        for case, result in zip(cases, results, strict=True)
    }
    write_dataset(output, gather_polar(gathered))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            [Path(path) for path in snakemake.input.cases],
            [Path(path) for path in snakemake.input.results],
            Path(snakemake.output[0]),
        )
