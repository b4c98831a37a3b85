"""Observed order and grid convergence index of the section's polar."""

from pathlib import Path
from typing import Any, cast

from equisection.analysis.grid_study import grid_study
from equisection.config import load_config
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.solvers.protocol import MeshingSolver
from equisection.solvers.registry import solver_from_config
from equisection.study import plan


def main(raw_config: dict[str, Any], polar_2d: Path, output: Path) -> None:
    """Compare the polars of the resolutions whose meshes are similar."""
    config = load_config(raw_config)
    cells = {
        name: cast(MeshingSolver, solver_from_config(config, name)).similar_cells
        for name in plan.resolutions(config)
    }
    with written_whole(output) as aside:
        table = grid_study(read_dataset(polar_2d), cells)
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            dict(snakemake.params.config),
            Path(snakemake.input.polar_2d),
            Path(snakemake.output[0]),
        )
