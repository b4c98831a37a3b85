"""The rigid section: steady loads, or the mean of an unsteady run where there are none.

``rigid_flow`` defines when a flow has converged and when a mean is known.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from equisection.beam.outline import outline_of, rectangle
from equisection.cases import ForcedCase, SteadyCase, UnsteadyCase
from equisection.errors import SolverError
from equisection.results.fluctuation import Fluctuation
from equisection.results.surface import SectionSurface
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import copy_flow, emptied
from equisection.solvers.openfoam.dictionaries import (
    control,
    write_mesh_dictionary,
    write_system,
)
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.block_mesh import SIMILAR, ChannelBox, Mesh, Spacing
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.process import BlowUpError, Watch, run_program
from equisection.solvers.openfoam.reading.loads import Loads
from equisection.solvers.openfoam.reading.section_surface import (
    averaging,
    surface_of_mean,
    surface_of_steady,
)
from equisection.solvers.openfoam.rigid_flow import (
    MOST,
    STEP,
    WINDOW,
    RigidFlowRecord,
    Tell,
    follow_iterations,
    follow_until_even,
    has_converged,
    has_converged_around_outline,
    of_outline,
    write_at_rest,
)
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence

#: Mesh of a section, of either mesher.
SectionCells = Mesh | OutlineMesh

logger = logging.getLogger(__name__)

#: Sizes of the cells around the outline of a section.
SIZES = OutlineSizes()

#: Time left out, shortest and longest record of a rigid unsteady run (c/V).
RECORD = RigidFlowRecord(10.0, 40.0, 100.0)
#: Steps of a rigid unsteady run from one sample of the surface data to the next.
SAMPLED = 5


@dataclass(frozen=True)
class RigidLoads:
    """Loads of the rigid section, their origin, and the surface data that they are the sum of.

    The means of an unsteady flow have its fluctuation with them.
    """

    drag: float
    lift: float
    moment: float
    method: str
    surface: SectionSurface
    fluctuation: Fluctuation | None = None


def mesh_of(
    case: SteadyCase | UnsteadyCase | ForcedCase, refinement: float, spacing: Spacing = SIMILAR
) -> Mesh:
    """Return the mesh of a case, of a free section turned to its twist at the release.

    Raises
    ------
    SolverError
        The case has no channel, which the mesh fills.
    """
    return Mesh(_channel(case), _incidence(case), refinement, spacing)


def outline_mesh_of(
    case: SteadyCase | UnsteadyCase | ForcedCase,
    refinement: float,
    far_field: float = 0.0,
    sizes: OutlineSizes | None = None,
) -> OutlineMesh:
    """Return the mesh of a case around its outline, or around the rectangle of its thickness.

    That of a free section is turned to its twist at the release.

    Parameters
    ----------
    case
        The case.
    refinement
        Refinement of each direction.
    far_field
        Distance of the far field (chords) in free air.
    sizes
        Sizes of the cells, which are refined. By default those of a section at the Reynolds number
        of the case.

    Raises
    ------
    SolverError
        The case has neither a channel nor a far field.
    """
    geometry = case.geometry
    outline = geometry.outline or outline_of(rectangle(geometry.thickness)).as_pairs()
    if geometry.channel_height is None and far_field:
        channel = ChannelBox(geometry.thickness, 2 * far_field, far_field, far_field)
    else:
        channel = _channel(case)
    if sizes is None:
        sizes = SIZES.resolving(flow.reynolds_number(geometry, case.medium))
    return OutlineMesh(outline, channel, _incidence(case), refinement, sizes)


def _channel(case: SteadyCase | UnsteadyCase | ForcedCase) -> ChannelBox:
    """Return the channel of a case, of a free section about its place at the release."""
    geometry = case.geometry
    if None in (geometry.channel_height, geometry.upstream, geometry.downstream):
        raise SolverError("flow.channel: null: the mesh of OpenFOAM fills a channel; give one")
    assert geometry.channel_height is not None
    assert geometry.upstream is not None
    assert geometry.downstream is not None
    return ChannelBox(
        geometry.thickness,
        geometry.channel_height,
        geometry.upstream,
        geometry.downstream,
        _height(case),
    )


def _height(case: SteadyCase | UnsteadyCase | ForcedCase) -> float:
    """Return the height of mid-chord at the release (chords), that of the undeformed section 0."""
    if not isinstance(case, UnsteadyCase) or case.section is None or not case.start.equilibrium:
        return 0.0
    ahead, rigid = case.section.axis_behind_mid_chord, math.radians(case.incidence_deg)
    turned = math.sin(_incidence(case)) - math.sin(rigid)
    return case.section_equilibrium[1] + ahead * turned


def _incidence(case: SteadyCase | UnsteadyCase | ForcedCase) -> float:
    """Return the incidence of the mesh (rad), of a free section with its twist at the release."""
    released = case.section_start_twist if isinstance(case, UnsteadyCase) else 0.0
    return math.radians(case.incidence_deg) + released


def run_steady(
    installation: Installation,
    case: SteadyCase | UnsteadyCase | ForcedCase,
    mesh: SectionCells,
    work: Path,
    tell: Tell,
    *,
    turbulence: StreamTurbulence = STREAM,
) -> tuple[Path, Loads, bool]:
    """Make the mesh and run the steady solver until it has converged, or for long enough.

    Returns
    -------
    tuple
        Folder of the run, its loads over the iterations, and whether it has converged.

    Raises
    ------
    SolverError
        A program failed, or the mesh is not sound.
    """
    folder = emptied(work / "steady")
    reynolds = flow.reynolds_number(case.geometry, case.medium)
    flow.write_flow(folder, reynolds, turbulence=turbulence)
    write_system(
        folder,
        control("simpleFoam", MOST, 1, MOST),
        flow.schemes(steady=True),
        flow.steady_solution(),
    )
    return mesh_and_iterate(installation, mesh, folder, tell)


def mesh_and_iterate(
    installation: Installation, mesh: SectionCells, folder: Path, tell: Tell
) -> tuple[Path, Loads, bool]:
    """Make the mesh of a folder with its dictionaries and run it; see :func:`run_steady`."""
    if isinstance(mesh, OutlineMesh):
        mesh.write(folder)
        check_mesh(installation, folder)
        return iterate(installation, "simpleFoam", folder, tell, has_converged_around_outline)
    write_mesh_dictionary(folder, mesh)
    make_mesh(installation, folder)
    return iterate(installation, "simpleFoam", folder, tell)


def iterate(
    installation: Installation,
    program: str,
    folder: Path,
    tell: Tell,
    is_converged: Callable[[Loads], bool] = has_converged,
) -> tuple[Path, Loads, bool]:
    """Run a steady solver until it has converged, or for long enough; see :func:`run_steady`."""
    loads, converged = follow_iterations(
        folder, is_converged, tell, lambda watch: run_program(installation, program, folder, watch)
    )
    return folder, loads, converged


def make_mesh(installation: Installation, folder: Path) -> None:
    """Make the mesh of a folder with its dictionaries, and have it checked.

    Raises
    ------
    SolverError
        A program failed, or the mesh is not sound.
    """
    run_program(installation, "blockMesh", folder)
    check_mesh(installation, folder)


def check_mesh(installation: Installation, folder: Path) -> None:
    """Have the mesh of a folder checked.

    Raises
    ------
    SolverError
        The program failed, or the mesh is not sound.
    """
    run_program(installation, "checkMesh", folder)
    require_sound_mesh(folder / "log.checkMesh")


def require_sound_mesh(log: Path) -> None:
    """Refuse a mesh that ``checkMesh`` finds fault with.

    Raises
    ------
    BlowUpError
        It found faults: this section at this incidence has no mesh.
    SolverError
        Its log has no verdict.
    """
    said = log.read_text(encoding="utf-8", errors="replace")
    if "Mesh OK." in said:
        return
    faults = [line.strip(" *") for line in said.splitlines() if "***" in line]
    if not faults:
        raise SolverError(f"checkMesh has no verdict on the mesh; see {log}")
    raise BlowUpError(f"the mesh is not sound: {'; '.join(faults)}; see {log}")


def rigid_loads(
    installation: Installation,
    case: SteadyCase,
    mesh: SectionCells,
    work: Path,
    tell: Tell,
    *,
    coupling: flow.Coupling,
    turbulence: StreamTurbulence = STREAM,
) -> RigidLoads:
    """Return the loads of a rigid section.

    Parameters
    ----------
    installation
        OpenFOAM.
    case
        The case.
    mesh
        Its mesh.
    work
        Folder that holds its folders.
    tell
        Called with the progress.
    coupling
        Coupling in a time step, where the flow goes on unsteadily.
    turbulence
        Turbulence of the stream, with its model.

    Raises
    ------
    SolverError
        A program failed.
    """
    folder, steady, converged = run_steady(
        installation, case, mesh, work, tell, turbulence=turbulence
    )
    if converged:
        return steady_mean(installation, folder, steady, mesh)
    logger.info("%g deg: the steady solver does not converge", case.incidence_deg)
    return unsteady_mean(installation, folder, mesh, work, tell, coupling=coupling)


def steady_mean(
    installation: Installation, folder: Path, loads: Loads, mesh: SectionCells
) -> RigidLoads:
    """Return the loads of a converged steady run, the means of its last iterations.

    Raises
    ------
    SolverError
        A program failed.
    """
    drag, lift, moment = loads.last(WINDOW // 3).means()
    surface = surface_of_steady(installation, folder, mesh)
    method = f"steady, {loads.time.size} iterations"
    return RigidLoads(drag, lift, moment, method, surface)


def unsteady_mean(
    installation: Installation,
    source: Path,
    mesh: SectionCells,
    work: Path,
    tell: Tell,
    *,
    coupling: flow.Coupling,
) -> RigidLoads:
    """Return the mean loads of the flow that goes on unsteadily from a steady run.

    With too few outer correctors pressure and velocity do not agree, and vortices are shed that
    the flow does not have.

    Raises
    ------
    SolverError
        A program failed.
    """
    wanted = of_outline(RECORD) if isinstance(mesh, OutlineMesh) else RECORD

    def run(before: Path, folder: Path, watch: Watch) -> None:
        copy_flow(before, folder)
        write_at_rest(folder)
        entries = control("pimpleFoam", wanted.end, STEP, wanted.end)
        entries["functions"] |= averaging(wanted.discarded, SAMPLED)
        write_system(folder, entries, flow.schemes(steady=False), flow.unsteady_solution(coupling))
        run_program(installation, "pimpleFoam", folder, watch)

    folder, record, method = follow_until_even(source, work, wanted, tell, run)
    drag, lift, moment = record.means()
    surface = surface_of_mean(folder, mesh)
    found = Fluctuation.of(record.time, record.drag, record.lift, record.moment)
    return RigidLoads(drag, lift, moment, method, surface, found)
