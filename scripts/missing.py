"""Name the cases that no kept result answers."""

import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.files import written_whole
from equisection.results.index import read_missing
from equisection.script import logged


def main(indices: Sequence[Path], output: Path) -> None:
    """Write kind, model or dimension, case and reason of each; say on the terminal how many."""
    rows = [
        (index.parent.parent.name, index.parent.name, case, reason)
        for index in indices
        for case, reason in read_missing(index).items()
    ]
    table = pd.DataFrame(rows, columns=["kind", "model", "case", "reason"])
    with written_whole(output) as aside:
        table.to_csv(aside, index=False)
    if rows:
        names = ", ".join(f"{kind}/{model}/{case}" for kind, model, case, _ in rows)
        print(f"no kept result of {names}; {output} says why", file=sys.stderr)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            [Path(path) for path in (*snakemake.input.steady, *snakemake.input.indices)],
            Path(snakemake.output[0]),
        )
