"""Make the mesh of the plate."""

import shutil
from pathlib import Path
from typing import cast

from equisection.cases import SteadyCase, canonical, case_hash, read_cases
from equisection.files import written_whole
from equisection.results.netcdf import write_dataset
from equisection.results.plate_grid import no_grid
from equisection.run.script import logged
from equisection.solvers.protocol import MeshingSolver
from equisection.solvers.registry import solver_from_case
from equisection.store.kept import PLATE_MESH, kept_mesh
from equisection.store.lock import claimed


def main(cases: Path, store: Path, output: Path) -> None:
    """Let the solver mesh the one case of ``cases``.

    The file does not name the case's hash, by which the result of the case is known.
    """
    ((_, case),) = read_cases(cases).items()
    solver = cast(MeshingSolver, solver_from_case(case.solver))
    work = store / case_hash(case) / "mesh"
    with claimed(work):
        grid = solver.plate_grid(cast(SteadyCase, case), work)
    dataset = grid.to_dataset().assign_attrs(
        solver=solver.name,
        solver_version=solver.version,
        solver_description=solver.describe("3d"),
        resolution=case.resolution,
        mesh_of=canonical(case),
    )
    write_dataset(output, dataset)


def take_kept(cases: Path, reuse: Path, output: Path) -> None:
    """Take the mesh that is kept of the one case of ``cases``, or one without cells."""
    ((_, case),) = read_cases(cases).items()
    kept = kept_mesh(reuse, PLATE_MESH, case)
    if kept is None:
        span, thickness = case.geometry.span, case.geometry.thickness
        write_dataset(output, no_grid(case.incidence_deg, span, thickness).to_dataset())
        return
    with written_whole(output) as aside:
        shutil.copyfile(kept, aside)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        case = Path(snakemake.input.case)
        if snakemake.params.compute:
            main(case, Path(snakemake.params.store), Path(snakemake.output[0]))
        else:
            take_kept(case, Path(snakemake.params.reuse), Path(snakemake.output[0]))
