"""Write the case file of the static section."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection.cases import write_cases
from equisection.cases.kinds import StaticCase
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.assemble import case_at
from equisection.study.axes import Point


def main(raw_config: dict[str, Any], equivalent: Path, names: Sequence[str], output: Path) -> None:
    """Write the cases, named by their point of the study."""
    config = load_config(raw_config)
    model = plan.model("2d", config.reduction)
    solver = solver_from_config(config, config.steady.resolution)
    data = {"equivalent": read_dataset(equivalent)}
    cases = {}
    for name in names:
        free = case_at(config, model, Point.named(name), data, solver).model_dump()
        shared = {key: free[key] for key in StaticCase.model_fields if key != "kind"}
        cases[name] = StaticCase(**shared)
    write_cases(output, cases)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            snakemake.params.config,
            Path(snakemake.input.equivalent),
            list(snakemake.params.cases),
            Path(snakemake.output[0]),
        )
