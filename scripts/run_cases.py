"""Run the cases of one job with the solver that they name."""

from pathlib import Path

from equisection.script import logged
from equisection.solvers.job import run_cases


def main(cases: list[Path], outputs: list[Path], store: Path, progress: Path) -> None:
    """Run each case and write its result; see :func:`equisection.solvers.job.run_cases`."""
    run_cases(cases, outputs, store, progress)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            [Path(path) for path in snakemake.input],
            [Path(path) for path in snakemake.output],
            Path(snakemake.params.store),
            Path(snakemake.log[0]).with_suffix(".progress.json"),
        )
