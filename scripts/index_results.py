"""Index the results of cases that ran one by one."""

from collections.abc import Sequence
from pathlib import Path

from equisection.cases import case_hash, point_of, read_cases
from equisection.results.loads_zigzag import with_zigzag
from equisection.results.netcdf import read_attributes
from equisection.run.script import logged
from equisection.store.index import write_index


def main(cases: Sequence[Path], results: Sequence[Path], output: Path) -> None:
    """Write the index, each result checked to be that of its case."""
    attributes = {}
    for case_file, result in zip(cases, results, strict=True):
        (case,) = read_cases(case_file).values()
        found = read_attributes(result, case_hash(case))
        attributes[result.stem] = point_of(case) | with_zigzag(result, found)
    write_index(output, attributes)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.get("cases", [])],
            [Path(path) for path in snakemake.input.get("results", [])],
            Path(snakemake.output[0]),
        )
