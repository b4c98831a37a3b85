"""Run the cases of one job with the solver that they name, or take their kept results."""

import logging
import sys
from pathlib import Path

from equisection.cases import read_cases
from equisection.results.failures import warning_of
from equisection.results.loads_zigzag import loads_zigzag
from equisection.run.script import logged
from equisection.solvers.protocol import MPIRUN, ONE_THREAD, Allocation
from equisection.store.index import write_index
from equisection.store.job import run_cases
from equisection.store.kept_alone import answer_from_kept


def main(
    cases: Path,
    output: Path,
    store: Path,
    progress: Path,
    reuse: Path | None = None,
    *,
    allocation: Allocation = ONE_THREAD,
) -> None:
    """Run the cases; their results go to the folder of ``output``.

    ``output`` is the index of the results, or the result file of a single case.
    """
    attributes = run_cases(
        read_cases(cases), output.parent, store, progress, reuse, allocation=allocation
    )
    if output.suffix == ".json":
        write_index(output, attributes)
    warning = warning_of(attributes, output)
    if warning:
        logging.getLogger(__name__).warning("%s", warning)
        print(f"warning: {warning}", file=sys.stderr)


def take_kept(cases: Path, output: Path, store: Path, reuse: Path) -> None:
    """Index the kept results of the cases; those that have none are named in the index."""
    answers = answer_from_kept(read_cases(cases), output.parent, store, reuse)
    found = {
        name: attributes | loads_zigzag(output.parent / f"{name}.nc", attributes)
        for name, attributes in answers.found.items()
    }
    write_index(output, found, answers.missing)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        arguments = (
            Path(snakemake.input[0]),
            Path(snakemake.output[0]),
            Path(snakemake.params.store),
        )
        reuse = Path(snakemake.params.reuse) if snakemake.params.reuse else None
        if reuse is not None and not snakemake.params.compute:
            take_kept(*arguments, reuse)
        else:
            progress = Path(snakemake.log[0]).with_suffix(".progress.json")
            allocation = Allocation(snakemake.threads, snakemake.resources.get("mpi") or MPIRUN)
            main(*arguments, progress, reuse, allocation=allocation)
