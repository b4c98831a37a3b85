"""One line for each run of each model."""

from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.summary import summary_of, with_both, with_oscillations
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.results.section_dataset import nominal_k_star, oscillation_factors
from equisection.run.script import logged
from equisection.study.axes import AsGiven


def main(
    indices: Sequence[Path], output: Path, equivalent: Path, speed: float, reduction: str
) -> None:
    """Summarise the verdicts; the folder of an index is named after its model."""
    sections = read_dataset(equivalent)
    recovered = with_oscillations(summary_of(indices), oscillation_factors(sections), reduction)
    summary = with_both(recovered, AsGiven(nominal_k_star(sections), speed))
    with written_whole(output) as aside:
        summary.to_csv(aside, index=False)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.indices],
            Path(snakemake.output[0]),
            Path(snakemake.input.equivalent),
            snakemake.params.speed,
            snakemake.params.reduction,
        )
