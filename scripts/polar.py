"""Gather the steady results of a dimension into its polar."""

from pathlib import Path

from equisection import plan
from equisection.results.index import read_index, result_file
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.polar import gather_polar
from equisection.script import logged


def main(index: Path, output: Path) -> None:
    """Gather the results, each checked to be that of its case."""
    gathered = {
        plan.angle_of(name): read_dataset(result_file(index, name), str(attributes["case_hash"]))
        for name, attributes in read_index(index).items()
    }
    write_dataset(output, gather_polar(gathered))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(Path(snakemake.input.index), Path(snakemake.output[0]))
