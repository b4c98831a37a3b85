"""Loads of the rigid beam and those of the paper (Table 1)."""

from pathlib import Path

from equisection.files import written_whole
from equisection.paper.tables import table_1
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(polar_3d: Path, output: Path) -> None:
    """Write Table 1."""
    table = table_1(read_dataset(polar_3d))
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(Path(snakemake.input.polar_3d), Path(snakemake.output[0]))
