"""One line for each run of each model."""

from collections.abc import Sequence
from pathlib import Path

from equisection.comparison.summary import summarise
from equisection.files import written_whole
from equisection.results.of_case import attributes_of_case
from equisection.script import logged


def main(cases: Sequence[Path], results: Sequence[Path], output: Path) -> None:
    """Summarise the verdicts, each checked to be that of its case."""
    rows = [
        (result.parent.name, attributes_of_case(case, result))
        for case, result in zip(cases, results, strict=True)
    ]
    with written_whole(output) as aside:
        summarise(rows).to_csv(aside, index=False)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            [Path(path) for path in snakemake.input.cases],
            [Path(path) for path in snakemake.input.results],
            Path(snakemake.output[0]),
        )
