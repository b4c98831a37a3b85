"""Beams of an outline on the real mesher and solver: sound meshes, loads and coupling.

Meshes are coarser than any preset, and flows are followed for as long as shows what is asked.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from foamlib import FoamFile
from tests.sample_cases import GEOMETRY, STEADY_PLATE, UNSTEADY_PLATE, beam_modes
from tests.sample_outlines import SHAPES
from tests.watching import nothing

from equisection.cases import SteadyCase
from equisection.results.plane_mesh import cell_areas
from equisection.results.plate_surface import PlateSurface
from equisection.solvers.openfoam.beam import deformed_mesh, rigid_beam
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.lumped_points import LumpedPoints
from equisection.solvers.openfoam.beam.rigid_beam import (
    BeamCells,
    PlateFlow,
    outline_beam_mesh_of,
    plate_mesh_of,
)
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.reading.beam_grid import plate_grid
from equisection.solvers.openfoam.reading.loads import read_loads
from equisection.solvers.openfoam.rigid_flow import RigidFlowRecord

#: Some 9,700 cells of the rectangle, and 22,500.
VERY_COARSE, COARSE = 0.2, 0.3
#: The mesh of blocks with as many cells as the very coarse one of the rectangle: 9,416.
BLOCKS = 0.25
COUPLING = Coupling(2, 0.98)
#: Steady iterations, and those at their end that loads are the mean of.
ITERATIONS, LAST = 150, 60


def case_of(name: str, incidence_deg: float) -> SteadyCase:
    geometry = GEOMETRY.model_copy(update={"outline": SHAPES[name].as_pairs()})
    return STEADY_PLATE.model_copy(update={"incidence_deg": incidence_deg, "geometry": geometry})


def flow_of(
    installation: Installation, case: SteadyCase, mesh: BeamCells, work: Path, ranks: int = 1
) -> PlateFlow:
    return PlateFlow(installation, case, mesh, COUPLING, ranks, work)


@pytest.fixture(scope="module", autouse=True)
def short() -> pytest.MonkeyPatch:
    """Steady iterations that are few, and a record of the unsteady flow behind them."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(rigid_beam, "RECORD", RigidFlowRecord(0.1, 0.4, 0.4))
        patched.setattr(rigid_beam, "MOST", ITERATIONS)
        yield patched


@pytest.mark.parametrize(("name", "gap"), [("h", 0.3), ("naca 4412", 0.0)])
def test_mesh_is_sound_and_closed(
    installation: Installation, tmp_path: Path, name: str, gap: float
) -> None:
    """Fluid fills the channel but for the body, which ends at a tip or goes from wall to wall."""
    case = case_of(name, 5.0)
    mesh = replace(outline_beam_mesh_of(case, COARSE), gap=gap)
    flow = flow_of(installation, case, mesh, tmp_path)
    grid = plate_grid(flow)
    area = float(cell_areas(grid.points, grid.corners).sum())
    assert area == pytest.approx(4.0 * 20.0 - SHAPES[name].area, rel=1e-4)
    said = (tmp_path / "steady" / "log.checkMesh").read_text()
    volume = float(re.search(r"Total volume = ([\d.]+)\.", said)[1])
    assert volume == pytest.approx(area * mesh.span + 80.0 * gap, rel=1e-6)
    np.testing.assert_allclose(grid.levels, mesh.levels(), atol=1e-9)
    assert grid.quality["max_non_orthogonality_deg"] < 75.0


@pytest.fixture(scope="module")
def rectangle(
    installation: Installation, tmp_path_factory: pytest.TempPathFactory
) -> tuple[PlateFlow, np.ndarray]:
    """The rectangle at 2.5 deg around its outline, and its drag, lift and moment."""
    case = STEADY_PLATE
    mesh = outline_beam_mesh_of(case, VERY_COARSE)
    flow = flow_of(installation, case, mesh, tmp_path_factory.mktemp("rectangle"))
    return flow, last_loads(flow)


def last_loads(flow: PlateFlow) -> np.ndarray:
    _, loads, _ = flow.steady(nothing)
    return np.array(loads.last(LAST).means())


def test_rectangle_has_the_loads_that_it_has_on_blocks(
    installation: Installation, rectangle: tuple[PlateFlow, np.ndarray], tmp_path: Path
) -> None:
    """Within what the meshes are off: the blocks' own lift falls by 8 % from coarse to fine."""
    blocks = flow_of(installation, STEADY_PLATE, plate_mesh_of(STEADY_PLATE, BLOCKS), tmp_path)
    np.testing.assert_allclose(rectangle[1], last_loads(blocks), rtol=0.15)


def test_airfoil_at_zero_has_no_lift_and_its_faces_add_up(
    installation: Installation, tmp_path: Path
) -> None:
    """On two ranks, whose faces come in one order along the contour; and by the mean of a flow."""
    case = case_of("naca 0012", 0.0)
    mesh = outline_beam_mesh_of(case, VERY_COARSE)
    result = flow_of(installation, case, mesh, tmp_path, ranks=2).result(nothing)
    assert abs(result.lift) < 5e-3
    assert abs(result.moment) < 2e-3
    assert result.drag > 0.01
    sizes = np.diff(mesh.edges()) / mesh.span
    assert result.section_lift @ sizes == pytest.approx(result.lift, abs=1e-3)
    surface = result.surface
    assert isinstance(surface, PlateSurface)
    assert surface.span == pytest.approx(mesh.span, rel=1e-6)
    assert surface.loads(0.0) == pytest.approx(
        (result.drag, result.lift, result.moment), rel=0.02, abs=1e-3
    )
    # the tip closes the body, and its sides have the length of the contour
    section = SHAPES["naca 0012"]
    assert surface.on("tip").area.sum() == pytest.approx(section.area, rel=0.01)
    sides = surface.taken(surface.side != "tip").area.sum()
    assert sides == pytest.approx(section.perimeter * mesh.span, rel=0.01)
    # stagnation at the nose of the root, as far along either side
    for side in ("upper", "lower"):
        root = surface.on(side).taken(surface.on(side).z < mesh.edges()[1])
        assert (np.diff(root.arc) > 0).all()
        assert root.pressure[0] == root.pressure.max() == pytest.approx(1.0, abs=0.15)
    flow = result.tip_flow
    assert flow is not None
    assert flow.thickness == pytest.approx(0.1057, rel=0.01)  # at mid-chord
    inside = np.abs(flow.y) < 0.05
    assert np.isnan(flow.turbulence[0][inside][:, flow.z < 3.65]).all()
    assert np.isfinite(flow.turbulence[0][:, flow.z > 3.75]).all()
    assert np.isfinite(flow.turbulence[1:]).all()


def test_coupled_beam_of_an_outline_obeys_its_equations(
    installation: Installation, rectangle: tuple[PlateFlow, np.ndarray], tmp_path: Path
) -> None:
    """From the steady flow around the rectangle, about an axis at a third of the chord."""
    source, _ = rectangle
    modes = beam_modes(6.44 / 19.91).model_copy(update={"elastic_axis": 0.33})
    case = UNSTEADY_PLATE.model_copy(
        update={"beam": modes, "duration": 0.4, "output_interval": 0.02}
    )
    run = PlateRun(installation, case, source.mesh, COUPLING, tmp_path, 1)
    run.start_from(source.work / "steady")
    result = run.run(nothing)
    history, loads, step = run.history(), read_loads(run.folder), case.time_step
    # what is handed over is what OpenFOAM sums up, but for friction
    assert history.lift[1:] == pytest.approx(loads.lift[:-1], rel=5e-3)
    assert history.moment[1:] == pytest.approx(loads.moment[:-1], rel=1e-2)
    # q'' + omega^2 q = p, with loads that go linearly in a step
    acceleration = np.diff(history.position, 2, axis=0) / step**2
    expected = history.load - run.points.frequency**2 * history.position
    expected = (expected[:-2] + 4 * expected[1:-1] + expected[2:]) / 6
    scale = np.abs(expected).max(axis=0)
    assert (np.abs(acceleration - expected) < 2e-3 * scale).all()
    assert result.tip_deflection[-1] > 0
    assert result.tip_flow is not None


def test_mesh_of_an_outline_follows_a_beam_held_in_its_first_mode(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At 6 deg of the tip the mesh around an airfoil is sound, and its wall where the mode is."""
    mesh = outline_beam_mesh_of(case_of("naca 0012", 0.0), VERY_COARSE)
    folder = flow_of(installation, case_of("naca 0012", 0.0), mesh, tmp_path).set_up()
    points = LumpedPoints.of(beam_modes(), mesh.edges())
    twist = math.radians(6.0)
    position, _ = points.release(twist, 0.0)
    monkeypatch.setattr(deformed_mesh, "_STEPS", 6)
    monkeypatch.setattr(deformed_mesh, "_FOLLOWING", 6)
    deformed_mesh.deform_mesh(
        installation, folder, points, position, tmp_path / "held", of_outline=True
    )
    poly = read_poly_mesh(folder)
    on_wall = np.unique(poly.faces[poly.patches["plate"]])
    rest = poly.points[on_wall]
    moved = np.asarray(FoamFile(folder / "0" / "polyMesh" / "points")[None])[on_wall]
    root, tip = rest[:, 2] < 1e-9, rest[:, 2] > mesh.span - 1e-9
    np.testing.assert_allclose(moved[root], rest[root], atol=1e-3)
    # nose up about mid-chord; the last layer has no slope, and the tip the twist of its inner edge
    turned = np.arctan2(-moved[tip, 1] @ rest[tip, 0], moved[tip, 0] @ rest[tip, 0])
    assert turned == pytest.approx(twist, rel=0.03)
    lengths = [np.hypot(*part[tip][:, :2].T) for part in (rest, moved)]
    np.testing.assert_allclose(*lengths, atol=1e-4)


def test_free_air_is_as_far_beyond_the_tip_and_its_cells_are_sound(
    installation: Installation, tmp_path: Path
) -> None:
    free = {"channel_height": None, "tip_gap": None, "upstream": None, "downstream": None}
    geometry = case_of("naca 0012", 2.0).geometry.model_copy(update=free)
    case = case_of("naca 0012", 2.0).model_copy(update={"geometry": geometry})
    mesh = outline_beam_mesh_of(case, COARSE, 10.0)
    grid = plate_grid(flow_of(installation, case, mesh, tmp_path))
    assert grid.levels[-1] == pytest.approx(13.7)
    assert grid.quality["max_aspect_ratio"] < 1000.0
