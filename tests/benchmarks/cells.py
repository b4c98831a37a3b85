"""What a cell takes, where results do not say it: memory, and the time of the embedded solver.

    python -m tests.benchmarks.cells openfoam     # free section and plate on some meshes
    python -m tests.benchmarks.cells sections     # the embedded solver's sweeps, each kind in a
    python -m tests.benchmarks.cells beams        # process of its own, whose memory is to be seen

The numbers in `workflow/profiles/cost.yaml` that `make cost-model` does not fit are from here.
"""

import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from equisection.cases import UnsteadyCase
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.openfoam.beam import rigid_beam as plate_rigid
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.rigid_beam import plate_mesh_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.section import rigid_section as section_rigid
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from tests.benchmarks.many_cases import cases_of_section
from tests.sample_cases import STEADY_PLATE, UNSTEADY, UNSTEADY_PLATE
from tests.watching import nothing

#: Memory is full grown after a few iterations of the steady flow and steps of the free run.
FEW = {"duration": 0.4, "time_step": 0.02, "output_interval": 0.02}
MOST = 20


def openfoam() -> Iterator[str]:
    """Say what the largest program of a case takes, from the smallest mesh to the largest."""
    section_rigid.MOST = plate_rigid.MOST = MOST
    section, plate = (case.model_copy(update=FEW) for case in (UNSTEADY, UNSTEADY_PLATE))
    for name in ("coarse", "medium", "fine"):
        mesh = mesh_of(section, PRESETS[name].refinement)
        with tempfile.TemporaryDirectory() as folder:
            SectionRun(find(), section, mesh, Coupling(1), Path(folder)).run(nothing)
        yield f"section, {name}, {mesh.cells} cells: {_memory(resource.RUSAGE_CHILDREN):.0f} kB"
    preset = PRESETS["coarse"]
    with tempfile.TemporaryDirectory() as folder:
        PlateRun(
            find(), plate, plate_mesh_of(plate, preset.plate), Coupling(1), Path(folder), 1
        ).run(nothing)
    yield f"plate, coarse, {preset.plate_cells} cells: {_memory(resource.RUSAGE_CHILDREN):.0f} kB"


def sections() -> Iterator[str]:
    """Say what a sweep of free sections takes by its cases."""
    for number in (100, 1000):
        yield _sweep("section", cases_of_section(number), 1)


def beams() -> Iterator[str]:
    """Say what rigid beams and a sweep of free ones take by their strips."""
    free_beams = [
        UNSTEADY_PLATE.model_copy(
            update={"solver": case.solver, "k_star": case.k_star, "time_step": 0.05}
        )
        for case in cases_of_section(100)
    ]
    strips = free_beams[0].solver.settings["strips"]
    solver = Adapter.from_settings(free_beams[0].solver.settings)
    rigid_beams = [
        STEADY_PLATE.model_copy(update={"incidence_deg": incidence})
        for incidence in np.linspace(0.0, 10.0, 21)
    ]
    start = time.process_time()
    solver.run_steady(rigid_beams, Path(), nothing)
    took = time.process_time() - start
    yield f"{len(rigid_beams)} rigid beams: {took / len(rigid_beams) / strips:.2e} s a section"
    yield _sweep("beam", free_beams, strips)


def _sweep(what: str, cases: list[UnsteadyCase], strips: int) -> str:
    solver = Adapter.from_settings(cases[0].solver.settings)
    before, start = _memory(resource.RUSAGE_SELF), time.process_time()
    results = solver.run_unsteady(cases, Path(), nothing)
    took = time.process_time() - start
    longest = max(float(result.time[-1]) for result in results)
    work = len(cases) * strips * longest / cases[0].time_step
    memory = (_memory(resource.RUSAGE_SELF) - before) / len(cases) / strips
    return (
        f"{len(cases)} cases of the {what}, up to {longest:.0f} c/V: {took / work:.2e} s a section "
        f"and step, {memory:.0f} kB a section"
    )


def _memory(who: int) -> float:
    """Return the largest memory so far, of this process or of its largest child (kB)."""
    return float(resource.getrusage(who).ru_maxrss)


if __name__ == "__main__":
    kinds = {"openfoam": openfoam, "sections": sections, "beams": beams}
    for line in kinds[sys.argv[1]]():
        print(line, flush=True)
