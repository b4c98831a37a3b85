"""The rigid plate in its channel: steady loads, or the mean of an unsteady run, and their span.

The criteria are those of the section (``rigid_flow``), but for coefficients near zero, which waver
more on the plate, and with means of shorter records: a step costs what eight of the section do.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from equisection.cases import ForcedCase, Geometry, SteadyCase, UnsteadyCase
from equisection.errors import SolverError
from equisection.files import write_text
from equisection.results.steady_result import SteadyResult
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import emptied, states
from equisection.solvers.openfoam.dictionaries import (
    LOADS,
    Entries,
    control,
    write_system,
)
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.beam_mesh import SIDE_WALLS, PlateMesh
from equisection.solvers.openfoam.mesh.block_mesh import OF_PLATE, Spacing
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OF_BEAM, OutlineBeamMesh
from equisection.solvers.openfoam.process import Watch, run_program
from equisection.solvers.openfoam.ranks import copy_flow_of_all, divide, parts
from equisection.solvers.openfoam.reading.beam_surface import plate_surface
from equisection.solvers.openfoam.reading.loads import Loads
from equisection.solvers.openfoam.reading.sampled_tip_flow import SAMPLED_FIELDS, sample_tip_flow
from equisection.solvers.openfoam.reading.section_surface import averaging, write_wall_fields
from equisection.solvers.openfoam.reading.span_loads import read_span_loads, surface_output
from equisection.solvers.openfoam.rigid_flow import (
    CONVERGED,
    FEWEST,
    MOST,
    STEP,
    WINDOW,
    RigidFlowRecord,
    Tell,
    follow_iterations,
    follow_until_even,
    has_converged_around_outline,
    may_start_motion,
    of_outline,
    write_at_rest,
)
from equisection.solvers.openfoam.section.rigid_section import (
    SAMPLED,
    check_mesh,
    make_mesh,
    mesh_of,
    outline_mesh_of,
)
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence
from equisection.solvers.openfoam.time_spent import spent

logger = logging.getLogger(__name__)

#: Mesh of a beam, of either mesher.
BeamCells = PlateMesh | OutlineBeamMesh

#: Half range of a coefficient that counts as converged however small it is.
CONVERGED_WITHIN = 1e-4
#: Time left out, shortest and longest record of a rigid unsteady run (c/V).
RECORD = RigidFlowRecord(10.0, 20.0, 60.0)


def plate_mesh_of(
    case: SteadyCase | UnsteadyCase | ForcedCase, refinement: float, spacing: Spacing = OF_PLATE
) -> PlateMesh:
    """Return the mesh of blocks of a case of the beam.

    Raises
    ------
    SolverError
        The case has no channel, or the root is not on its wall.
    """
    section, geometry = mesh_of(case, refinement, spacing), case.geometry
    _require_root_on_wall(geometry)
    return PlateMesh(section, geometry.span, geometry.tip_gap or 0.0)


def outline_beam_mesh_of(
    case: SteadyCase | UnsteadyCase | ForcedCase,
    refinement: float,
    far_field: float = 0.0,
    along_span: float = 1.0,
) -> OutlineBeamMesh:
    """Return the mesh of a case of the beam around its outline, or that of its rectangle.

    In free air the wall beyond the tip is as far as the others (``far_field``, chords). Along the
    span it has ``along_span`` as many layers as the refinement gives it.

    Raises
    ------
    SolverError
        The case has neither a channel nor a far field, or the root is not on a wall.
    """
    section, geometry = outline_mesh_of(case, refinement, far_field, OF_BEAM), case.geometry
    _require_root_on_wall(geometry)
    gap = far_field if geometry.channel_height is None else geometry.tip_gap or 0.0
    return OutlineBeamMesh(section, geometry.span, gap, along_span)


def _require_root_on_wall(geometry: Geometry) -> None:
    if not geometry.root_on_wall:
        raise SolverError(
            "flow.root_on_wall: false: OpenFOAM's mesh of the beam has its root on the wall"
        )


@dataclass(frozen=True)
class PlateFlow:
    """The rigid plate of a case.

    Attributes
    ----------
    installation
        OpenFOAM.
    case, mesh
        The case and its mesh.
    coupling
        Coupling in a time step, where the flow goes on unsteadily.
    ranks
        Ranks of MPI that a program runs on.
    work
        Folder that holds its folders.
    turbulence
        Turbulence of the stream, with its model.
    """

    installation: Installation
    case: SteadyCase | UnsteadyCase | ForcedCase
    mesh: BeamCells
    coupling: flow.Coupling
    ranks: int
    work: Path
    turbulence: StreamTurbulence = STREAM

    def set_up(self) -> Path:
        """Make the folder of the steady run with its mesh, not yet divided, and return it.

        Raises
        ------
        SolverError
            A program failed, or the mesh is not sound.
        """
        folder, case = emptied(self.work / "steady"), self.case
        reynolds = flow.reynolds_number(case.geometry, case.medium)
        flow.write_flow(folder, reynolds, SIDE_WALLS, self.turbulence)
        entries = plate_control("simpleFoam", MOST, 1, MOST, self.mesh.span)
        entries["functions"] |= surface_output({"executeControl": "onEnd", "writeControl": "onEnd"})
        write_system(folder, entries, flow.schemes(steady=True), flow.steady_solution())
        if isinstance(self.mesh, OutlineBeamMesh):
            self.mesh.write(folder)
            check_mesh(self.installation, folder)
            return folder
        write_text(folder / "system" / "blockMeshDict", self.mesh.block_mesh_dict())
        make_mesh(self.installation, folder)
        return folder

    def steady(
        self,
        tell: Tell,
        deform: Callable[[Path], None] | None = None,
        *,
        starts_motion: bool = False,
    ) -> tuple[Path, Loads, bool]:
        """Make the mesh and run the steady solver until it has converged, or for long enough.

        Parameters
        ----------
        tell
            Called with the progress.
        deform
            Moves the mesh of a folder, which is divided already, to that of a plate held deformed.
        starts_motion
            Whether a motion starts from the flow: one that hunts a little is then good enough.

        Returns
        -------
        tuple
            Folder of the run, its loads over the iterations, and whether it has converged.

        Raises
        ------
        SolverError
            A program failed, or the mesh is not sound.
        """
        folder = self.set_up()
        divide(self.installation, folder, self.ranks, self.mesh.layers)
        if deform is not None:
            deform(folder)
        has_converged = self._has_converged
        loads, _ = follow_iterations(
            folder,
            lambda loads: has_converged(loads) or (starts_motion and may_start_motion(loads)),
            tell,
            lambda watch: run_program(
                self.installation, "simpleFoam", folder, watch, ranks=self.ranks
            ),
        )
        return folder, loads, has_converged(loads)

    @property
    def _has_converged(self) -> Callable[[Loads], bool]:
        """Test that a steady run has converged, by the cells of its mesh."""
        is_of_outline = isinstance(self.mesh, OutlineBeamMesh)
        return has_converged_around_outline if is_of_outline else _has_converged

    @property
    def _record(self) -> RigidFlowRecord:
        """Record of the unsteady run, by the cells of its mesh."""
        is_of_outline = isinstance(self.mesh, OutlineBeamMesh)
        return of_outline(RECORD) if is_of_outline else RECORD

    def result(self, tell: Tell) -> SteadyResult:
        """Return the loads of the rigid plate.

        Raises
        ------
        SolverError
            A program failed.
        """
        folder, steady, converged = self.steady(tell)
        if converged:
            record, mean = steady.last(WINDOW // 3), False
            write_wall_fields(self.installation, folder, self.ranks)
            method = f"steady, {steady.time.size} iterations"
        else:
            logger.info("%g deg: the steady solver does not converge", self.case.incidence_deg)
            folder, record, method = self._unsteady(folder, tell)
            mean = True
        drag, lift, moment = record.means()
        last = states(parts(folder)[0])[-1].name
        span = read_span_loads(folder, last, self.mesh.edges(), mean=mean)
        state = f"{self.case.incidence_deg:g} deg, {method}"
        tip_flow = sample_tip_flow(self.installation, folder, self.mesh, state=state, mean=mean)
        return SteadyResult(
            drag,
            lift,
            moment,
            span.span,
            span.lift,
            span.moment,
            method,
            surface=plate_surface(folder, self.mesh.section, mean=mean),
            tip_flow=tip_flow,
            spent=spent(self.work),
        )

    def _unsteady(self, source: Path, tell: Tell) -> tuple[Path, Loads, str]:
        """Go on unsteadily from a steady run; return folder, record to be averaged, its origin."""
        wanted = self._record
        end = wanted.end

        def run(before: Path, folder: Path, watch: Watch) -> None:
            copy_flow_of_all(before, folder)
            write_at_rest(folder)
            entries = plate_control("pimpleFoam", end, STEP, end, self.mesh.span)
            entries["functions"] |= surface_output(
                {"executeControl": "timeStep", "writeControl": "onEnd"}
            )
            entries["functions"]["force_means"] = _force_means()
            entries["functions"] |= averaging(wanted.discarded, SAMPLED, ("p", *SAMPLED_FIELDS))
            solution = flow.unsteady_solution(self.coupling)
            write_system(folder, entries, flow.schemes(steady=False), solution)
            run_program(self.installation, "pimpleFoam", folder, watch, ranks=self.ranks)

        return follow_until_even(source, self.work, wanted, tell, run)


def _has_converged(loads: Loads) -> bool:
    """Tell whether a steady run has converged, also where the plate has no lift."""
    if loads.time.size < FEWEST:
        return False
    last = loads.last(WINDOW)
    return all(
        float(np.ptp(values)) / 2 <= max(CONVERGED * abs(float(values.mean())), CONVERGED_WITHIN)
        for values in (last.drag, last.lift, last.moment)
    )


def _force_means() -> Entries:
    """Return the function object that averages the force on each face over the record."""
    averaged = {"mean": True, "prime2Mean": False, "base": "time"}
    return {
        "type": "fieldAverage",
        "libs": ['"libfieldFunctionObjects.so"'],
        "timeStart": RECORD.discarded,
        "writeControl": "onEnd",
        "fields": f"( {' '.join(f'{name} {_inline(averaged)}' for name in _AVERAGED)} )",
    }


_AVERAGED = ('"surface:force"', '"surface:moment"')


def _inline(entries: Entries) -> str:
    words = " ".join(
        f"{key} {('on' if value else 'off') if isinstance(value, bool) else value};"
        for key, value in entries.items()
    )
    return f"{{ {words} }}"


def plate_control(
    application: str, end: float, step: float, write_every: float, span: float
) -> dict[str, Any]:
    """Return ``controlDict`` as for the section, with coefficients over the area L c (Eq. 22)."""
    entries = control(application, end, step, write_every)
    entries["functions"][LOADS]["Aref"] = span
    return entries
