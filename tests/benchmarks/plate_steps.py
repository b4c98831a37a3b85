"""Time step and coupling of the plate, studied on its mesh in the plane: a section on that mesh.

    python -m tests.benchmarks.plate_steps [k* that is kept]

The free section of `config/openfoam.yaml` on the mesh that the plate of `config/openfoam3d.yaml`
has in the plane of the section: a small part of the plate's cost, with the same cells at the edges.
"""

import argparse
import math
import tempfile
from pathlib import Path

import pandas as pd

from equisection.cases import UnsteadyCase
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from tests.benchmarks.early_verdict import KEPT, case_of
from tests.benchmarks.independence import oscillation

DURATION = 45.0  # c/V
#: Time step (c/V) and coupling; the first is what the others are compared with.
VARIANTS = (
    (0.02, Coupling()),
    (0.04, Coupling()),
    (0.04, Coupling(3, 0.95)),
    (0.04, Coupling(2, 0.98)),
    (0.04, Coupling(2, 0.95)),
    (0.02, Coupling(1, 1.0)),
    (0.04, Coupling(1, 1.0)),
)


def row(case: UnsteadyCase, coupling: Coupling, work: Path) -> dict[str, float]:
    """Return what a release with a time step and a coupling comes to."""
    preset = PRESETS["plate-coarse"]
    mesh = mesh_of(case, preset.refinement, preset.spacing)
    result = SectionRun(find(), case, mesh, coupling, work).run(lambda done, total: None)
    history = result.to_dataset(case.geometry.chord)
    growth_rate, frequency = oscillation(history)
    log = (work / "free" / "log.pimpleFoam").read_text(encoding="utf-8")
    steps = case.duration / case.time_step
    assert result.spent is not None
    return {
        "time_step": case.time_step,
        "at most": coupling.outer_correctors,
        "relaxation": coupling.velocity_relaxation,
        "iterations": log.count("Solving for Ux") / steps,
        "growth_rate": growth_rate,
        "frequency": frequency,
        "tip_twist_deg": math.degrees(result.tip_twist[-1]),
        "cpu_seconds": result.spent.cpu_seconds,
    }


def main(k_star: str) -> None:
    """Run all variants and print the table."""
    kept = case_of(read_dataset(KEPT / "2d" / f"k{k_star}.nc"))
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for number, (time_step, coupling) in enumerate(VARIANTS):
            changes = {"duration": DURATION, "time_step": time_step, "output_interval": 0.2}
            case = kept.model_copy(update=changes)
            rows.append(row(case, coupling, Path(work) / f"{number}"))
    print(f"k* = {k_star}, {DURATION:g} c/V")
    print(pd.DataFrame(rows).to_string(index=False, float_format="%.4g"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.plate_steps")
    parser.add_argument("k_star", nargs="?", default="5")
    main(parser.parse_args().k_star)
