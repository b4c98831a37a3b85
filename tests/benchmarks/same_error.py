"""Cost of the rectangle's loads for the same error, by blocks and by the mesh of outlines.

    python -m tests.benchmarks same-error

The kept steady loads at 2.5 deg on the meshes coarse, medium and fine of either mesher, with their
processor seconds. The error is that against the limit at vanishing cell size of the same mesher
(:mod:`equisection.analysis.grid_limit`), which has an interval of its own. Nothing is computed
anew; the seconds are those of the machine and the hour of the run.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from equisection.analysis.grid_limit import GridLimit, grid_limit
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.mesh.presets import PRESETS
from tests.benchmarks.measure import Row
from tests.workflow.project import ROOT

#: Folder of the kept results of each mesher and mesh.
KEPT = {
    "blocks": {
        "coarse": "paper-plate-openfoam",
        "medium": "paper-plate-openfoam-grid",
        "fine": "paper-plate-openfoam-grid",
    },
    "outline": dict.fromkeys(("coarse", "medium", "fine"), "outline-grid"),
}
#: Coefficients, and their error (%) that a mesh is looked for with.
COEFFICIENTS, WITHIN = ("cl", "cm"), 1.0


@dataclass(frozen=True)
class Loads:
    """Loads on one mesh, and the processor seconds that they took."""

    values: dict[str, float]
    seconds: float


def kept_loads(mesher: str) -> dict[str, Loads]:
    """Return the kept loads at 2.5 deg of a mesher, coarsest mesh first."""
    found = {}
    for mesh, run in KEPT[mesher].items():
        data = read_dataset(ROOT / f"results/reference/{run}/steady/2d/{mesh}_a2.5.nc")
        values = {name: float(data[name]) for name in COEFFICIENTS}
        found[mesh] = Loads(values, float(data.attrs["cpu_seconds"]))
    return found


def limits_of(loads: dict[str, Loads]) -> dict[str, GridLimit]:
    """Return the limit of each coefficient at vanishing cell size."""
    sizes = [1.0 / PRESETS[mesh].refinement for mesh in loads]
    return {
        name: grid_limit([own.values[name] for own in loads.values()], sizes)
        for name in COEFFICIENTS
    }


def rows() -> Iterator[Row]:
    """Yield errors and cost of each mesh, and the cheapest mesh within one error."""
    for mesher in KEPT:
        loads = kept_loads(mesher)
        limits = limits_of(loads)
        for name, limit in limits.items():
            yield Row(
                f"{mesher}: limit of {name}",
                f"{limit.value:.4f} +- {limit.half_width:.4f}; {limit.basis}",
            )
        cheapest = None
        for mesh, own in loads.items():
            errors = {
                name: 100.0 * (own.values[name] / limit.value - 1.0)
                for name, limit in limits.items()
            }
            said = ", ".join(f"{name} {error:+.2f} %" for name, error in errors.items())
            yield Row(f"{mesher}, {mesh}", f"{said}; {own.seconds:.0f} processor s")
            if cheapest is None and max(map(abs, errors.values())) <= WITHIN:
                cheapest = f"{mesh}, {own.seconds:.0f} processor s"
        yield Row(f"{mesher}: both within {WITHIN:g} % of their limits", cheapest or "no mesh")
