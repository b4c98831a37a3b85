"""Name the cases that no kept result, or no file of a record, answers."""

import sys
from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.missing import missing_table
from equisection.files import written_whole
from equisection.run.script import logged


def main(indices: Sequence[Path], output: Path) -> None:
    """Write kind, model, case and reason of each; name them on the terminal."""
    table = missing_table(indices)
    with written_whole(output) as aside:
        table.to_csv(aside, index=False)
    if len(table):
        names = ", ".join(table["kind"] + "/" + table["model"] + "/" + table["case"])
        print(f"no result of {names}; {output} says why", file=sys.stderr)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in (*snakemake.input.steady, *snakemake.input.indices)],
            Path(snakemake.output[0]),
        )
