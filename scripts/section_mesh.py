"""Make the mesh of the section, and its Courant number in the steady flow."""

import shutil
from pathlib import Path
from typing import cast

from equisection.cases import SteadyCase, canonical, case_hash, read_cases
from equisection.files import written_whole
from equisection.results.netcdf import write_dataset
from equisection.results.section_mesh import no_mesh
from equisection.run.script import logged
from equisection.solvers.protocol import MeshingSolver
from equisection.solvers.registry import solver_from_case
from equisection.store.kept import SECTION_MESH, kept_mesh
from equisection.store.lock import claimed


def main(cases: Path, time_step: float, store: Path, output: Path) -> None:
    """Let the solver mesh the one case of ``cases``; ``time_step`` is in c/V.

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
        mesh_of=canonical(case),
    )
    write_dataset(output, dataset)


def take_kept(cases: Path, time_step: float, reuse: Path, output: Path) -> None:
    """Take the mesh that is kept of the one case of ``cases``, or one without cells."""
    ((_, case),) = read_cases(cases).items()
    kept = kept_mesh(reuse, SECTION_MESH, case, time_step=time_step)
    if kept is None:
        write_dataset(output, no_mesh(case.incidence_deg, time_step).to_dataset())
        return
    with written_whole(output) as aside:
        shutil.copyfile(kept, aside)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        case, step = Path(snakemake.input.case), snakemake.params.time_step
        if snakemake.params.compute:
            main(case, step, Path(snakemake.params.store), Path(snakemake.output[0]))
        else:
            take_kept(case, step, Path(snakemake.params.reuse), Path(snakemake.output[0]))
