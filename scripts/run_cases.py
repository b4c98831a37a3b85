"""Run the cases of one job with the solver that they name, or take their kept results."""

import logging
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.cases import Case, read_cases
from equisection.results.failures import warning_of
from equisection.results.loads_zigzag import with_zigzag
from equisection.run.script import logged
from equisection.solvers.protocol import MPIRUN, ONE_THREAD, Allocation
from equisection.solvers.registry import missing_records
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
    asked = read_cases(cases)
    missing = missing_records(asked)
    _remove(output.parent, missing)
    attributes = run_cases(
        _others(asked, missing), output.parent, store, progress, reuse, allocation=allocation
    )
    if output.suffix == ".json":
        write_index(output, attributes, missing)
    warn(attributes, output)


def run_together(
    cases: Sequence[Path],
    indices: Sequence[Path],
    store: Path,
    progress: Path,
    reuse: Path | None = None,
) -> None:
    """Run several case files as one; the results of each go to the folder of its index."""
    of_index = dict(zip(indices, map(read_cases, cases), strict=True))
    missing = {index: missing_records(batch) for index, batch in of_index.items()}
    for index in indices:
        _remove(index.parent, missing[index])
    run = {
        f"{index.parent.name}/{name}": case
        for index, batch in of_index.items()
        for name, case in _others(batch, missing[index]).items()
    }
    attributes = run_cases(run, indices[0].parents[1], store, progress, reuse)
    for index, batch in of_index.items():
        found = {
            name: attributes[f"{index.parent.name}/{name}"]
            for name in _others(batch, missing[index])
        }
        write_index(index, found, missing[index])
        warn(found, index)


def _remove(folder: Path, names: Iterable[str]) -> None:
    """Remove results that an earlier run left of cases that have none now."""
    for name in names:
        (folder / f"{name}.nc").unlink(missing_ok=True)


def _others(cases: Mapping[str, Case], missing: Mapping[str, str]) -> dict[str, Case]:
    """Return the cases that are not missing."""
    return {name: case for name, case in cases.items() if name not in missing}


def warn(attributes: Mapping[str, Mapping[str, Any]], output: Path) -> None:
    """Tell, in the log and on the terminal, of cases without a result."""
    warning = warning_of(attributes, output)
    if warning:
        logging.getLogger(__name__).warning("%s", warning)
        print(f"warning: {warning}", file=sys.stderr)


def take_kept(cases: Path, output: Path, store: Path, reuse: Path) -> None:
    """Index the kept results of the cases; those that have none are named in the index."""
    answers = answer_from_kept(read_cases(cases), output.parent, store, reuse)
    found = {
        name: with_zigzag(output.parent / f"{name}.nc", attributes)
        for name, attributes in answers.found.items()
    }
    write_index(output, found, answers.missing)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        outputs = [Path(path) for path in snakemake.output]
        cases = [Path(path) for path in snakemake.input[: len(outputs)]]
        store = Path(snakemake.params.store)
        reuse = Path(snakemake.params.reuse) if snakemake.params.reuse else None
        if reuse is not None and not snakemake.params.compute:
            for case_file, index in zip(cases, outputs, strict=True):
                take_kept(case_file, index, store, reuse)
        else:
            progress = Path(snakemake.log[0]).with_suffix(".progress.json")
            if len(outputs) > 1:
                run_together(cases, outputs, store, progress, reuse)
            else:
                allocation = Allocation(snakemake.threads, snakemake.resources.get("mpi") or MPIRUN)
                main(cases[0], outputs[0], store, progress, reuse, allocation=allocation)
