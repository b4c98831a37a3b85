"""Make the mesh of the section, and its Courant number in the steady flow."""

from pathlib import Path
from typing import cast

from equisection.cases import SteadyCase, case_hash, read_cases
from equisection.results.netcdf import write_dataset
from equisection.script import logged
from equisection.solvers.ownership import claimed
from equisection.solvers.protocol import MeshingSolver
from equisection.solvers.registry import solver_from_case


def main(cases: Path, time_step: float, store: Path, output: Path) -> None:
    """Have the solver mesh the one case of ``cases``; ``time_step`` is in c/V.

    The file does not name the case's hash, by which the result of the case is known.
    """
    ((_, case),) = read_cases(cases).items()
    solver = cast(MeshingSolver, solver_from_case(case.solver))
    work = store / case_hash(case) / "mesh"
    with claimed(work):
        mesh = solver.section_mesh(cast(SteadyCase, case), time_step, work)
    dataset = mesh.to_dataset().assign_attrs(
        solver=solver.name,
        solver_version=solver.version,
        solver_description=solver.describe("2d"),
        resolution=case.resolution,
    )
    write_dataset(output, dataset)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.case),
            snakemake.params.time_step,
            Path(snakemake.params.store),
            Path(snakemake.output[0]),
        )
