"""Write the case file of a batch for a model, or for each of several, or of one case."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equisection.cases import write_cases
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.assemble import case_at
from equisection.study.axes import Point


def main(
    raw_config: dict[str, Any],
    model_name: str,
    structure_files: dict[str, Path],
    names: Sequence[str],
    output: Path,
) -> None:
    """Write the cases, named by their point of the study.

    ``structure_files`` holds ``equivalent``, with ``modes`` in 3D, ``correction`` for corrected
    models, and ``polar_2d`` or ``polar_3d`` for a start from equilibrium; further ones are not
    used.
    """
    config = load_config(raw_config)
    model = plan.model(model_name, config.reduction)
    solver = solver_from_config(config, config.run_resolution)
    data = {name: read_dataset(path) for name, path in structure_files.items()}
    cases = {name: case_at(config, model, Point.named(name), data, solver) for name in names}
    write_cases(output, cases)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        files = {"modes", "equivalent", "correction", "polar_2d", "polar_3d"}
        made_from = files & set(snakemake.input.keys())
        for output in map(Path, snakemake.output):
            of_sweep = snakemake.params.cases
            if isinstance(of_sweep, dict):
                of_sweep = of_sweep[output.parent.name]
            main(
                snakemake.params.config,
                output.parent.name,
                {name: Path(snakemake.input[name]) for name in made_from},
                plan.read_refinement(Path(snakemake.input.chosen))
                if "chosen" in set(snakemake.input.keys())
                else list(of_sweep),
                output,
            )
