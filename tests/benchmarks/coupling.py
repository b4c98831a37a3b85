"""How well the iterations of a time step bring pressure and velocity together, and what they cost.

    python -m tests.benchmarks.coupling [mesh] [incidence in deg]

The rigid section of `config/openfoam.yaml`, where its steady solver does not converge, goes on
unsteadily for a few c/V with one coupling after the other, all from the same state. The last has
more iterations than any run would take.
"""

import argparse
import re
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import copy_flow
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.process import BlowUpError, run_program
from equisection.solvers.openfoam.reading.loads import read_loads, require_reasonable
from equisection.solvers.openfoam.rigid_flow import STEP, write_at_rest
from equisection.solvers.openfoam.section.rigid_section import mesh_of, run_steady
from tests.benchmarks.rigid import section

#: c/V, and the part of it that is averaged.
DURATION, LATE = 6.0, 0.4
COUPLINGS = (
    Coupling(3, 1.0),
    Coupling(5, 1.0),
    Coupling(3, 0.95),
    Coupling(5, 0.9),
    Coupling(),
    Coupling(30, 0.95),
)


def row(source: Path, coupling: Coupling, folder: Path) -> dict[str, object]:
    """Return what a run with a coupling comes to."""
    copy_flow(source, folder)
    write_at_rest(folder)
    entries = control("pimpleFoam", DURATION, STEP, DURATION)
    write_system(folder, entries, flow.schemes(steady=False), flow.unsteady_solution(coupling))
    found: dict[str, object] = {
        "at most": coupling.outer_correctors,
        "relaxation": coupling.velocity_relaxation,
    }
    try:
        run_program(find(), "pimpleFoam", folder)
        loads = read_loads(folder)
        require_reasonable(loads, folder)
    except BlowUpError:
        return found | {"c_l": np.nan}
    log = (folder / "log.pimpleFoam").read_text(encoding="utf-8")
    steps = log.split("\nTime = ")[1:]
    pressure = [re.findall(r"Solving for p, Initial residual = (\S+),", step) for step in steps]
    late = loads.since((1 - LATE) * DURATION)
    drag, lift, moment = late.means()
    return found | {
        "iterations": np.mean([len(each) for each in pressure]),
        "first p residual": np.median([float(each[0]) for each in pressure]),
        "last": np.median([float(each[-1]) for each in pressure]),
        "c_l": lift,
        "+-": np.ptp(late.lift) / 2,
        "c_m": moment,
        "c_d": drag,
        "seconds a step": float(re.findall(r"ExecutionTime = (\S+)", log)[-1]) / len(steps),
    }


def main(mesh_name: str, incidence_deg: float) -> None:
    """Run all couplings and print the table."""
    case, preset = section(incidence_deg), PRESETS[mesh_name]
    mesh = mesh_of(case, preset.refinement, preset.spacing)
    with tempfile.TemporaryDirectory() as work:
        source, _, _ = run_steady(find(), case, mesh, Path(work), lambda done, total: None)
        rows = [
            row(source, coupling, Path(work) / f"{number}")
            for number, coupling in enumerate(COUPLINGS)
        ]
    print(f"{mesh_name}, {mesh.cells} cells, {incidence_deg:g} deg, {DURATION:g} c/V")
    print(pd.DataFrame(rows).to_string(index=False, float_format="%.4g"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.coupling")
    parser.add_argument("mesh", nargs="?", default="coarse", choices=sorted(PRESETS))
    parser.add_argument("incidence_deg", nargs="?", type=float, default=12.0)
    chosen = parser.parse_args()
    main(chosen.mesh, chosen.incidence_deg)
