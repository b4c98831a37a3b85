"""Write the case file of the forced motion of section or beam, or of one of its cases."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection.cases import write_cases
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.solvers.registry import solver_from_config
from equisection.study.forced_cases import forced_case


def main(
    raw_config: dict[str, Any], names: Sequence[str], output: Path, modes: Path | None = None
) -> None:
    """Write the cases, named by component or mode and reduced velocity.

    ``modes`` are those of the beam, for its cases.
    """
    config = load_config(raw_config)
    solver = solver_from_config(config, config.steady.resolution)
    of_beam = None if modes is None else read_dataset(modes)
    write_cases(output, {name: forced_case(config, name, solver, of_beam) for name in names})


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            snakemake.params.config,
            list(snakemake.params.cases),
            Path(snakemake.output[0]),
            next(map(Path, snakemake.input.modes), None),
        )
