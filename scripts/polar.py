"""Gather the steady results of a dimension into its polar."""

from collections.abc import Sequence
from pathlib import Path

from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.polar_dataset import gather_polar
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(index: Path, cases: Sequence[str], output: Path) -> None:
    """Gather the results in the order of the cases, each checked to be of its case."""
    found = read_index(index)
    gathered = {
        plan.rigid_point(name): read_dataset(
            result_file(index, name), str(found[name]["case_hash"])
        )
        for name in cases
        if name in found
    }
    write_dataset(output, gather_polar(gathered))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        for index, output in zip(
            snakemake.input[: len(snakemake.output)], snakemake.output, strict=True
        ):
            main(Path(index), snakemake.params.cases, Path(output))
