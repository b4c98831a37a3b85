"""Growth and frequency of the equivalent section by classical linear theory."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.linear_theory import linear_theory
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged


def main(equivalent: Path, k_star: Sequence[float], output: Path) -> None:
    """Write both motions of both reductions at each k*."""
    with written_whole(output) as aside:
        linear_theory(read_dataset(equivalent), k_star).to_csv(
            aside, index=False, float_format="%.6g"
        )


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.equivalent),
            list(snakemake.params.k_star),
            Path(snakemake.output[0]),
        )
