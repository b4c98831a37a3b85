"""Write the case file of the steady polar of each dimension, or of one of its cases."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection.cases import write_cases
from equisection.config import load_config
from equisection.run.script import logged
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.assemble import steady_case


def main(raw_config: dict[str, Any], dimension: str, names: Sequence[str], output: Path) -> None:
    """Write the cases, named by resolution and incidence."""
    config = load_config(raw_config)
    solvers = {name: solver_from_config(config, name) for name in plan.resolutions(config)}
    cases = {}
    for name in names:
        resolution, incidence_deg = plan.rigid_point(name)
        cases[name] = steady_case(config, dimension, incidence_deg, resolution, solvers[resolution])
    write_cases(output, cases)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        for output in map(Path, snakemake.output):
            main(snakemake.params.config, output.parent.name, list(snakemake.params.cases), output)
