"""OpenFOAM behind the solver protocol: one case at a time, the plate on several ranks.

The modules that run a case are imported where they are called, since writing a case file needs this
module without them.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from equisection.cases import ForcedCase, SteadyCase, UnsteadyCase
from equisection.config import Config
from equisection.config.groups.openfoam_keys import BLOCKS, LAMINAR, MORPH
from equisection.errors import SolverError
from equisection.results.forced_result import ForcedResult
from equisection.results.plate_grid import PlateGrid
from equisection.results.section_mesh import SectionMesh
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.openfoam.installation import Installation, find
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.settings import Settings
from equisection.solvers.protocol import ONE_THREAD, Allocation, Capability, Progress
from equisection.solvers.verdicts import refused

if TYPE_CHECKING:
    from equisection.solvers.openfoam.beam.rigid_beam import BeamCells, PlateFlow
    from equisection.solvers.openfoam.section.rigid_section import RigidLoads, SectionCells

logger = logging.getLogger(__name__)

#: Case of a moving section or plate, and its result.
CaseT = TypeVar("CaseT", bound=UnsteadyCase | ForcedCase)
ResultT = TypeVar("ResultT")


class Adapter:
    """OpenFOAM on meshes of one refinement; fulfils the solver protocol."""

    name = "openfoam"
    version = "4"
    provides = frozenset({Capability.MESH, Capability.SURFACE, Capability.FIELDS})

    def __init__(self, settings: Settings, allocation: Allocation = ONE_THREAD) -> None:
        self._settings = settings
        self._ranks = allocation.threads
        self._launcher = allocation.launcher

    @classmethod
    def from_config(cls, config: Config, resolution: str) -> Adapter:
        """Return the solver on the mesh of a resolution."""
        section = config.openfoam
        inlet = section.turbulence_intensity, section.viscosity_ratio
        settings = Settings(
            section.meshes[resolution],
            section.outer_correctors,
            section.velocity_relaxation,
            section.mesh_motion,
            "" if config.beam.outline is None and section.mesher == BLOCKS else _mesher(config),
            section.far_field_chords if config.flow.channel is None else 0.0,
            section.turbulence,
            *(() if section.turbulence == LAMINAR else inlet),
        )
        return cls(settings, Allocation(section.ranks))

    @classmethod
    def from_settings(
        cls, settings: dict[str, Any], allocation: Allocation = ONE_THREAD
    ) -> Adapter:
        """Return the solver of a case, to run on as many ranks as there are threads."""
        return cls(Settings(**settings), allocation)

    def in_flow(self, config: Config) -> Adapter:
        """Return the solver in the flow of a configuration, whose speed a mesher may go by."""
        if not self._settings.mesher:
            return self
        settings = replace(self._settings, mesher=_mesher(config))
        return Adapter(settings, Allocation(self._ranks, self._launcher))

    def settings(self, dimension: str) -> dict[str, Any]:
        """Return the settings of a case that decide the results of a dimension."""
        return self._settings.of_dimension(dimension).of_case()

    def describe(self, dimension: str) -> str:
        """Return solver and resolution in words."""
        from equisection.solvers.openfoam.mesh.presets import PRESETS  # noqa: PLC0415

        settings = self._settings.of_dimension(dimension)
        preset = PRESETS[settings.mesh]
        is_section = dimension == "2d"
        cells = str(preset.cells if is_section else preset.plate_cells)
        if settings.mesher:
            about = preset.outline_cells if is_section else preset.outline_beam_cells
            # in free air the layers beyond the tip are as many as its far field asks for
            is_more = bool(settings.far_field) and not is_section
            cells = f"{'more than' if is_more else 'about'} {about}"
        mesh = f"{cells} cells ({settings.mesh})"
        if settings.mesher:
            mesh += f" around the outline ({settings.mesher})"
        if settings.mesh_motion != MORPH:
            mesh += ", the free section on overset meshes"
        model = "laminar" if settings.turbulence == LAMINAR else "k-omega SST"
        return f"OpenFOAM {find().version()}, {model}, {mesh}"

    @property
    def similar_cells(self) -> int | None:
        """Number of cells; None for a mesh that is not similar to the others."""
        from equisection.solvers.openfoam.mesh.presets import PRESETS  # noqa: PLC0415

        preset = PRESETS[self._settings.mesh]
        if self._settings.mesher:
            return preset.outline_cells
        return preset.cells if preset.is_similar else None

    def _mesh(self, case: SteadyCase | UnsteadyCase | ForcedCase) -> SectionCells:
        """Return the mesh of a section."""
        from equisection.solvers.openfoam.mesh.presets import PRESETS  # noqa: PLC0415
        from equisection.solvers.openfoam.section import rigid_section  # noqa: PLC0415

        preset = PRESETS[self._settings.mesh]
        if self._has_outline(case):
            return rigid_section.outline_mesh_of(case, preset.refinement, self._settings.far_field)
        return rigid_section.mesh_of(case, preset.refinement, preset.spacing)

    def section_mesh(self, case: SteadyCase, time_step: float, work: Path) -> SectionMesh:
        """Return the mesh of a rigid section, with its Courant number at a time step (c/V)."""
        from equisection.solvers.openfoam.reading.meshed_section import section_mesh  # noqa: PLC0415

        mesh = self._mesh(case)
        turbulence = self._settings.stream
        return section_mesh(find(), case, mesh, time_step, work, turbulence=turbulence)

    def plate_grid(self, case: SteadyCase, work: Path) -> PlateGrid:
        """Return the mesh of a rigid plate."""
        from equisection.solvers.openfoam.reading.beam_grid import plate_grid  # noqa: PLC0415

        return plate_grid(self._plate_flow(find(), case, work))

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Run rigid sections and plates, each in a folder of its own."""
        installation = find(launcher=self._launcher)
        logger.info("OpenFOAM %s (%s)", installation.version(), installation.found)
        results = []
        for number, case in enumerate(cases):

            def tell(done: float, total: float, before: int = number) -> None:
                progress(before + done / total, len(cases))

            run = self._rigid_section if case.dimension == "2d" else self._rigid_plate
            try:
                results.append(run(installation, case, work / f"case{number}", tell))
            except BlowUpError as error:
                results.append(SteadyResult.without_value(str(error)))
        return results

    def _rigid_section(
        self, installation: Installation, case: SteadyCase, place: Path, tell: Progress
    ) -> SteadyResult:
        from equisection.solvers.openfoam.section.rigid_section import rigid_loads  # noqa: PLC0415

        settings = self._settings
        loads = rigid_loads(
            installation,
            case,
            self._mesh(case),
            place,
            tell,
            coupling=settings.coupling,
            turbulence=settings.stream,
        )
        return _result(loads)

    def _rigid_plate(
        self, installation: Installation, case: SteadyCase, place: Path, tell: Progress
    ) -> SteadyResult:
        return self._plate_flow(installation, case, place).result(tell)

    def _plate_flow(self, installation: Installation, case: SteadyCase, place: Path) -> PlateFlow:
        from equisection.solvers.openfoam.beam.rigid_beam import PlateFlow  # noqa: PLC0415

        mesh, coupling = self._beam_mesh(case), self._settings.coupling
        stream = self._settings.of_dimension("3d").stream
        return PlateFlow(installation, case, mesh, coupling, self._ranks, place, stream)

    def _beam_mesh(self, case: SteadyCase | UnsteadyCase | ForcedCase) -> BeamCells:
        """Return the mesh of a beam."""
        from equisection.solvers.openfoam.beam import rigid_beam  # noqa: PLC0415
        from equisection.solvers.openfoam.mesh.presets import PRESETS  # noqa: PLC0415

        preset = PRESETS[self._settings.mesh]
        refinement = preset.plate
        if self._has_outline(case):
            far_field = self._settings.far_field
            along_span = preset.plate_spacing.along_span
            return rigid_beam.outline_beam_mesh_of(case, refinement, far_field, along_span)
        return rigid_beam.plate_mesh_of(case, refinement, preset.plate_spacing)

    def _has_outline(self, case: SteadyCase | UnsteadyCase | ForcedCase) -> bool:
        """Tell whether a case has the mesh of outlines.

        Raises
        ------
        SolverError
            It needs one and was written without, or for another mesher than the one installed.
        """
        from equisection.solvers.openfoam.flow_setup import reynolds_number  # noqa: PLC0415
        from equisection.solvers.openfoam.mesh.outline_mesh import require_mesher  # noqa: PLC0415

        if self._settings.mesher:
            require_mesher(self._settings.mesher, reynolds_number(case.geometry, case.medium))
        elif case.geometry.outline is not None:
            raise SolverError("the case has an outline and no mesher of outlines; write it anew")
        return bool(self._settings.mesher)

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Release sections and plates one after the other, each until its verdict is in."""
        return self._in_turn(cases, work, progress, self._released)

    def run_forced(
        self, cases: Sequence[ForcedCase], work: Path, progress: Progress
    ) -> list[ForcedResult]:
        """Move sections or plates one after the other, each in a folder of its own."""
        return self._in_turn(cases, work, progress, self._forced)

    def _in_turn(
        self,
        cases: Sequence[CaseT],
        work: Path,
        progress: Progress,
        run: Callable[[Installation, CaseT, Path, Progress], ResultT],
    ) -> list[ResultT]:
        """Run cases one after the other, each in a folder of its own; progress is in c/V."""
        installation = find(launcher=self._launcher)
        logger.info("OpenFOAM %s (%s)", installation.version(), installation.found)
        total = sum(case.duration for case in cases)
        results: list[ResultT] = []
        done = 0.0
        for number, case in enumerate(cases):

            def tell(now: float, end: float, before: float = done) -> None:
                progress(before + now, total)

            results.append(run(installation, case, work / f"case{number}", tell))
            done += case.duration
        return results

    def _forced(
        self, installation: Installation, case: ForcedCase, place: Path, tell: Progress
    ) -> ForcedResult:
        run = self._forced_section if case.dimension == "2d" else self._forced_plate
        return run(installation, case, place, tell)

    def _forced_plate(
        self, installation: Installation, case: ForcedCase, place: Path, tell: Progress
    ) -> ForcedResult:
        from equisection.solvers.openfoam.beam.forced_beam import ForcedPlateRun  # noqa: PLC0415

        mesh = self._beam_mesh(case)
        coupling, ranks = self._settings.coupling, self._ranks
        stream = self._settings.of_dimension("3d").stream
        run = ForcedPlateRun(installation, case, mesh, coupling, place, ranks, turbulence=stream)
        return run.run(tell)

    def _forced_section(
        self, installation: Installation, case: ForcedCase, place: Path, tell: Progress
    ) -> ForcedResult:
        from equisection.solvers.openfoam.section.forced_section import ForcedRun  # noqa: PLC0415

        mesh, settings = self._mesh(case), self._settings
        run = ForcedRun(
            installation, case, mesh, settings.coupling, place, turbulence=settings.stream
        )
        return run.run(tell)

    def _released(
        self, installation: Installation, case: UnsteadyCase, place: Path, tell: Progress
    ) -> UnsteadyResult:
        run = self._free_section if case.dimension == "2d" else self._free_plate
        return run(installation, case, place, tell)

    def _free_section(
        self, installation: Installation, case: UnsteadyCase, place: Path, tell: Progress
    ) -> UnsteadyResult:
        from equisection.solvers.openfoam.section.free_section import SectionRun  # noqa: PLC0415
        from equisection.solvers.openfoam.section.overset_section import OversetRun  # noqa: PLC0415

        _require_own_loads(case)  # before the steady flow, which takes long
        mesh = self._mesh(case)
        kind = SectionRun if self._settings.mesh_motion == MORPH else OversetRun
        settings = self._settings
        run = kind(installation, case, mesh, settings.coupling, place, turbulence=settings.stream)
        if case.start.equilibrium:
            # its height is known by now alone, and other cases of the sweep may have the room
            try:
                run.require_room_at_release()
            except SolverError as error:
                return refused(case.model_copy(update={"refusal": str(error)}))
        _ = run.axes  # refuses what it does not have, the same
        return run.run(tell)

    def _free_plate(
        self, installation: Installation, case: UnsteadyCase, place: Path, tell: Progress
    ) -> UnsteadyResult:
        from equisection.solvers.openfoam.beam.free_beam import PlateRun  # noqa: PLC0415

        mesh = self._beam_mesh(case)
        coupling, ranks = self._settings.coupling, self._ranks
        stream = self._settings.of_dimension("3d").stream
        run = PlateRun(installation, case, mesh, coupling, place, ranks, turbulence=stream)
        _ = run.points  # refuses what it does not have before the steady flow, which takes long
        return run.run(tell)


def _mesher(config: Config) -> str:
    """Return the mesher of outlines that is installed, at the Reynolds number of a run."""
    from equisection.solvers.openfoam.mesh.outline_mesh import mesher  # noqa: PLC0415

    return mesher(config.reynolds_number)


def _require_own_loads(case: UnsteadyCase) -> None:
    """Refuse a section whose loads are to be multiplied before they move it.

    Raises
    ------
    SolverError
        The loads of the case have factors.
    """
    if (case.lift_factor, case.moment_factor) != (1.0, 1.0):
        raise SolverError(
            f"the loads of this section have the factors {case.lift_factor:.4g} and "
            f"{case.moment_factor:.4g} (Eq. 20 of a section with offset axes), and the rigid body "
            "of OpenFOAM moves under the loads of its flow as they are; leave the corrected "
            "models out of sweep.models, or run them with solver 'embedded'"
        )


_NOTHING = np.empty(0)


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
        fluctuation=loads.fluctuation,
    )
