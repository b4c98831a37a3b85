"""Length of the bubble, and y+, at each resolution and incidence."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.bubble import bubble_table
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(index: Path, cases: Sequence[str], output: Path) -> None:
    """Read the surface data of the section's cases, in their order."""
    found = read_index(index)
    results = {
        plan.rigid_point(name): read_dataset(
            result_file(index, name), str(found[name]["case_hash"])
        )
        for name in cases
        if name in found
    }
    with written_whole(output) as aside:
        bubble_table(results).to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(Path(snakemake.input.index), snakemake.params.cases, Path(snakemake.output[0]))
