"""Write the case files of the steady polar of a dimension."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection import plan
from equisection.assemble import steady_case
from equisection.cases.store import write_case
from equisection.config import load_config
from equisection.script import logged
from equisection.solvers.registry import solver_from_config


def main(raw_config: dict[str, Any], dimension: str, outputs: Sequence[Path]) -> None:
    """Write one case file for each output, whose name says resolution and incidence."""
    config = load_config(raw_config)
    solvers = {name: solver_from_config(config, name) for name in plan.resolutions(config)}
    for output in outputs:
        resolution, incidence_deg = plan.angle_of(output.stem)
        case = steady_case(config, dimension, incidence_deg, resolution, solvers[resolution])
        write_case(output, case)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            snakemake.params.config,
            snakemake.wildcards.dimension,
            [Path(path) for path in snakemake.output],
        )
