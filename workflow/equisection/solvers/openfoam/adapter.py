"""OpenFOAM behind the solver protocol: one case at a time, on one core.

What runs a case is imported where it is called: writing a case file takes this module too, and
none of that.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from equisection.cases import SteadyCase, UnsteadyCase
from equisection.config import Config
from equisection.errors import SolverError
from equisection.results.section_mesh import SectionMesh
from equisection.results.steady import SteadyResult
from equisection.results.unsteady import UnsteadyResult
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.protocol import Capability, Progress

if TYPE_CHECKING:
    from equisection.solvers.openfoam.rigid import RigidLoads

logger = logging.getLogger(__name__)


class Adapter:
    """OpenFOAM on meshes of one refinement; fulfils the solver protocol."""

    name = "openfoam"
    version = "3"
    provides = frozenset({Capability.MESH, Capability.SURFACE})

    def __init__(self, mesh: str, outer_correctors: int, velocity_relaxation: float = 1.0) -> None:
        self._mesh = mesh
        self._outer_correctors = outer_correctors
        self._velocity_relaxation = velocity_relaxation

    @classmethod
    def from_config(cls, config: Config, resolution: str) -> Adapter:
        """Return the solver on the mesh of a resolution."""
        section = config.openfoam
        return cls(
            section.meshes[resolution], section.outer_correctors, section.velocity_relaxation
        )

    @classmethod
    def from_settings(cls, settings: dict[str, Any]) -> Adapter:
        """Return the solver of a case."""
        return cls(
            settings["mesh"],
            settings["outer_correctors"],
            settings.get("velocity_relaxation", 1.0),
        )

    def settings(self) -> dict[str, Any]:
        """Return mesh and coupling; no path and no version of OpenFOAM, which decide nothing.

        Without a relaxation there is no word of it, as in the cases from before there was one.
        """
        settings = {"mesh": self._mesh, "outer_correctors": self._outer_correctors}
        if self._velocity_relaxation == 1.0:
            return settings
        return {**settings, "velocity_relaxation": self._velocity_relaxation}

    def describe(self) -> str:
        """Return solver and resolution in words."""
        from equisection.solvers.openfoam.presets import PRESETS  # noqa: PLC0415

        cells = PRESETS[self._mesh].cells
        return f"OpenFOAM {find().version()}, k-omega SST, {cells} cells ({self._mesh})"

    @property
    def similar_cells(self) -> int | None:
        """Number of cells; none of a mesh that is not similar to the others."""
        from equisection.solvers.openfoam.presets import PRESETS  # noqa: PLC0415

        preset = PRESETS[self._mesh]
        return preset.cells if preset.is_similar else None

    def section_mesh(self, case: SteadyCase, time_step: float, work: Path) -> SectionMesh:
        """Return the mesh of a rigid section, with its Courant number at a time step (c/V)."""
        from equisection.solvers.openfoam.presets import PRESETS  # noqa: PLC0415
        from equisection.solvers.openfoam.rigid import mesh_of  # noqa: PLC0415
        from equisection.solvers.openfoam.section_mesh import section_mesh  # noqa: PLC0415

        preset = PRESETS[self._mesh]
        mesh = mesh_of(case, preset.refinement, preset.spacing)
        return section_mesh(find(), case, mesh, time_step, work)

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Run rigid sections, each in a folder of its own."""
        from equisection.solvers.openfoam.presets import PRESETS  # noqa: PLC0415
        from equisection.solvers.openfoam.rigid import mesh_of, rigid_loads  # noqa: PLC0415

        installation, preset = find(), PRESETS[self._mesh]
        logger.info("OpenFOAM %s (%s)", installation.version(), installation.found)
        results = []
        for number, case in enumerate(cases):

            def tell(done: float, total: float, before: int = number) -> None:
                progress(before + done / total, len(cases))

            _require_section(case)
            mesh = mesh_of(case, preset.refinement, preset.spacing)
            try:
                place = work / f"case{number}"
                loads = rigid_loads(
                    installation, case, mesh, place, tell, outer_correctors=self._outer_correctors
                )
                results.append(_result(loads))
            except BlowUpError as error:
                results.append(_no_value(str(error)))
        return results

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Release sections one after the other, each until its verdict is in."""
        from equisection.solvers.openfoam.free import SectionRun  # noqa: PLC0415
        from equisection.solvers.openfoam.presets import PRESETS  # noqa: PLC0415
        from equisection.solvers.openfoam.rigid import mesh_of  # noqa: PLC0415

        installation, preset = find(), PRESETS[self._mesh]
        logger.info("OpenFOAM %s (%s)", installation.version(), installation.found)
        total = sum(case.duration for case in cases)
        results = []
        done = 0.0
        for number, case in enumerate(cases):

            def tell(now: float, end: float, before: float = done) -> None:
                progress(before + now, total)

            _require_section(case)
            mesh = mesh_of(case, preset.refinement, preset.spacing)
            place = work / f"case{number}"
            run = SectionRun(
                installation,
                case,
                mesh,
                self._outer_correctors,
                place,
                self._velocity_relaxation,
            )
            results.append(run.run(tell))
            done += case.duration
        return results


_NOTHING = np.empty(0)


def _require_section(case: SteadyCase | UnsteadyCase) -> None:
    if case.dimension != "2d":
        raise SolverError(
            f"solver 'openfoam' has no {case.dimension} cases; allowed are models of dimension 2d"
        )


def _result(loads: RigidLoads) -> SteadyResult:
    return SteadyResult(
        loads.drag,
        loads.lift,
        loads.moment,
        _NOTHING,
        _NOTHING,
        _NOTHING,
        loads.method,
        surface=loads.surface,
    )


def _no_value(reason: str) -> SteadyResult:
    return SteadyResult(
        math.nan, math.nan, math.nan, _NOTHING, _NOTHING, _NOTHING, "none", failure=reason
    )
