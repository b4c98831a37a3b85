"""Whether steady solver and unsteady mean agree on the rigid section, where both can be had.

    python -m tests.benchmarks.rigid [mesh] [incidence in deg] [--outer-correctors N]
        [--velocity-relaxation R]

The section of `config/openfoam.yaml` runs steadily, and goes on unsteadily from there as it does
where the steady solver does not converge, or with other outer correctors. Beside the coefficients
stand those that pressure and friction add up to. The files stay in `results/rigid-<mesh>`.
"""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

from equisection.cases import SteadyCase
from equisection.config import load_config
from equisection.results.surface import suction_side
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.section.rigid_section import (
    RigidLoads,
    mesh_of,
    run_steady,
    steady_mean,
    unsteady_mean,
)
from equisection.solvers.registry import solver_from_config
from equisection.study.assemble import steady_case
from tests.watching import nothing

CONFIG = Path("config/openfoam.yaml")


def section(incidence_deg: float) -> SteadyCase:
    """Return the configured section at an incidence (deg)."""
    config = load_config(yaml.safe_load(CONFIG.read_text(encoding="utf-8")))
    resolution = config.steady.resolution
    solver = solver_from_config(config, resolution)
    return steady_case(config, "2d", incidence_deg, resolution, solver)


def table(loads: dict[str, RigidLoads], incidence_deg: float) -> pd.DataFrame:
    """Return coefficients, their sums over the surface with the bubble, and differences (%).

    Differences are those from the first line.
    """
    names, side = ["cl", "cm", "cd"], suction_side(incidence_deg)
    rows = {}
    for name, this in loads.items():
        drag, lift, moment = this.surface.loads(incidence_deg)
        rows[name] = [this.lift, this.moment, this.drag, np.nan]
        bubble = this.surface.reattachment(side)
        rows[f"{name}, summed over the surface"] = [lift, moment, drag, bubble]
    found = pd.DataFrame.from_dict(rows, orient="index", columns=[*names, "bubble"])
    first = found.iloc[0]
    for name in names:
        found[f"{name} off by %"] = 100 * (found[name] / first[name] - 1)
    return found


def main(mesh_name: str, incidence_deg: float, coupling: Coupling) -> None:
    """Run the section both ways and print the table."""
    case, preset = section(incidence_deg), PRESETS[mesh_name]
    mesh = mesh_of(case, preset.refinement, preset.spacing)
    work = Path("results") / f"rigid-{mesh_name}"
    folder, history, converged = run_steady(find(), case, mesh, work, nothing)
    if not converged:
        raise SystemExit(f"the steady solver does not converge at {incidence_deg:g} deg")
    loads = {
        "steady": steady_mean(find(), folder, history, mesh),
        "unsteady": unsteady_mean(find(), folder, mesh, work, nothing, coupling=coupling),
    }
    print(f"{mesh_name}, {mesh.cells} cells, {incidence_deg:g} deg, {coupling}")
    print("; ".join(this.method for this in loads.values()))
    print(table(loads, incidence_deg).to_string(float_format="%.4g", na_rep=""))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.rigid")
    parser.add_argument("mesh", nargs="?", default="medium", choices=sorted(PRESETS))
    parser.add_argument("incidence_deg", nargs="?", type=float, default=2.5)
    parser.add_argument("--outer-correctors", type=int, default=8)
    parser.add_argument("--velocity-relaxation", type=float, default=0.95)
    chosen = parser.parse_args()
    main(
        chosen.mesh,
        chosen.incidence_deg,
        Coupling(chosen.outer_correctors, chosen.velocity_relaxation),
    )
