"""Make the mesh of the plate."""

from pathlib import Path
from typing import cast

from equisection.cases import SteadyCase, case_hash, read_cases
from equisection.results.netcdf import write_dataset
from equisection.script import logged
from equisection.solvers.protocol import MeshingSolver
from equisection.solvers.registry import solver_from_case


def main(cases: Path, store: Path, output: Path) -> None:
    """Have the solver mesh the one case of ``cases``.

    The file does not name the case's hash, by which the result of the case is known.
    """
    ((_, case),) = read_cases(cases).items()
    solver = cast(MeshingSolver, solver_from_case(case.solver))
    grid = solver.plate_grid(cast(SteadyCase, case), store / case_hash(case) / "mesh")
    dataset = grid.to_dataset().assign_attrs(
        solver=solver.name,
        solver_version=solver.version,
        solver_description=solver.describe("3d"),
        resolution=case.resolution,
    )
    write_dataset(output, dataset)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        main(
            Path(snakemake.input.case),
            Path(snakemake.params.store),
            Path(snakemake.output[0]),
        )
