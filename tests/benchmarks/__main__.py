"""`make bench`: what the workflow costs, beside what is wanted of it, in one table.

    python -m tests.benchmarks [name ...]

A missed target is said in the table and does not make the command fail.
"""

import argparse
import os
import sys
from collections.abc import Callable, Iterator

from rich.console import Console
from rich.table import Table

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

from tests.benchmarks import (  # noqa: E402
    beam_growth,
    busy,
    campaign,
    checking,
    default_run,
    early_verdict,
    examples,
    flips,
    from_clone,
    growth_rates,
    large_sweep,
    learnt,
    malformed,
    many_cases,
    modes,
    openfoam,
    outline_beams,
    outlines,
    plate,
    same_error,
    stability_map,
    starts,
)
from tests.benchmarks.measure import Row  # noqa: E402

BENCHMARKS: dict[str, Callable[[], Iterator[Row]]] = {
    "modes": modes.rows,
    "many-cases": many_cases.rows,
    "large-sweep": large_sweep.rows,
    "campaign": campaign.rows,
    "checking": checking.rows,
    "beam-growth": beam_growth.rows,
    "busy": busy.rows,
    "default-run": default_run.rows,
    "early-verdict": early_verdict.rows,
    "examples": examples.rows,
    "flips": flips.rows,
    "from-clone": from_clone.rows,
    "growth-rates": growth_rates.rows,
    "learnt": learnt.rows,
    "malformed": malformed.rows,
    "openfoam": openfoam.rows,
    "outline-beams": outline_beams.rows,
    "outlines": outlines.rows,
    "plate": plate.rows,
    "same-error": same_error.rows,
    "stability-map": stability_map.rows,
    "starts": starts.rows,
}


def main(names: list[str]) -> None:
    """Run the benchmarks and print their rows as they come, then all of them as a table."""
    table = Table("benchmark", "what", "measured", "wanted", "ok?")
    for name in names:
        for row in BENCHMARKS[name]():
            print(f"{name}: {row.what}: {row.measured}", file=sys.stderr, flush=True)
            table.add_row(name, row.what, row.measured, row.wanted, row.verdict)
    Console(width=110).print(table)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="name", help=", ".join(BENCHMARKS))
    chosen = parser.parse_args().names or list(BENCHMARKS)
    unknown = sorted(set(chosen) - set(BENCHMARKS))
    if unknown:
        parser.error(f"{', '.join(unknown)}: allowed are {', '.join(BENCHMARKS)}")
    main(chosen)
