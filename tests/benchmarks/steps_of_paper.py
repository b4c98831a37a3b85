"""Core hours of a coupled plate on the paper's cells, by both readings of its time step.

python -m tests.benchmarks.steps_of_paper
"""

from pathlib import Path

from equisection.cases import FREE
from equisection.config import load_config
from equisection.run import cost

if __name__ == "__main__":
    model = cost.read_cost_model(Path("workflow/profiles/cost.yaml"))
    for step in (0.02, 1e-4):
        unsteady = {"duration": 100.0, "time_step": step}
        plate = {"solver": "openfoam", "openfoam": {"meshes": {"coarse": "finest"}}}
        work = cost.work_of(load_config({**plate, "unsteady": unsteady}), FREE, "3d", "coarse")
        hours = cost.seconds(work, model.of("openfoam", "3d")) / 3600
        print(f"{step:g} c/V: {hours:,.0f} core hours")
