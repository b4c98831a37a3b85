"""Write the case files of the sweep over k* for a model."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection import plan
from equisection.assemble import unsteady_case
from equisection.cases.store import write_case
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.script import logged
from equisection.solvers.registry import solver_from_config


def main(
    raw_config: dict[str, Any],
    model_name: str,
    structure_files: dict[str, Path],
    outputs: Sequence[Path],
) -> None:
    """Write one case file for each output, whose name says k*.

    ``structure_files`` holds ``modes``, or ``equivalent`` and for corrected models
    ``correction``.
    """
    config = load_config(raw_config)
    model = plan.model(model_name, config.reduction)
    solver = solver_from_config(config, config.steady.resolution)
    data = {name: read_dataset(path) for name, path in structure_files.items()}
    for output in outputs:
        write_case(output, unsteady_case(config, model, plan.k_star_of(output.stem), data, solver))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            snakemake.params.config,
            snakemake.params.model,
            {
                name: Path(path)
                for name, path in snakemake.input.items()
                if name in ("modes", "equivalent", "correction")
            },
            [Path(path) for path in snakemake.output],
        )
