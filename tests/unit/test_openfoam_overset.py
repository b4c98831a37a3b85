"""The two meshes that lie above each other, what moves one of them, and its motion in the log."""

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.sample_cases import UNSTEADY
from tests.sample_outlines import SHAPES

from equisection.config import load_config
from equisection.errors import ConfigError, SolverError
from equisection.results.plane_mesh import cell_areas
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_overset_mesh import OutlineOversetMesh
from equisection.solvers.openfoam.mesh.overset_mesh import OVERSET, OversetMesh
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.reading.meshed_section import read_cells
from equisection.solvers.openfoam.section.overset_section import OversetRun, read_motion
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from equisection.solvers.openfoam.section.section_history import SectionHistory
from equisection.solvers.registry import solver_from_config

CHANNEL = ChannelBox(thickness=0.04, height=4.0, upstream=5.0, downstream=15.0)


def meshes(incidence_deg: float = 2.5, refinement: float = 1.0) -> OversetMesh:
    return OversetMesh(CHANNEL, math.radians(incidence_deg), refinement)


def run_in(folder: Path) -> OversetRun:
    return OversetRun(Installation(), UNSTEADY, mesh_of(UNSTEADY, 1.0), Coupling(), folder)


def vertices(text: str) -> np.ndarray:
    block = text[text.index("vertices") : text.index("blocks")]
    found = re.findall(r"\((\S+) (\S+) -0\.5\)", block)
    return np.array(found, dtype=float)


@pytest.mark.parametrize("refinement", [0.6, 1.0, math.sqrt(2.0)])
def test_blocks_hold_the_cells_that_are_counted_background_first(refinement: float) -> None:
    wanted = meshes(refinement=refinement)
    counts = re.findall(r"hex \([\d ]+\) \((\d+) (\d+) 1\)", wanted.block_mesh_dict())
    cells = [int(nx) * int(ny) for nx, ny in counts]
    assert len(cells) == 17
    assert sum(cells[:9]) == wanted.background_cells
    assert sum(cells[9:]) == wanted.component_cells


def test_refinement_divides_the_cells_of_both_alike() -> None:
    coarse, fine = meshes(), meshes(refinement=2.0)
    assert fine.background_cells == 4 * coarse.background_cells
    assert fine.component_cells == 4 * coarse.component_cells


def test_background_fills_the_channel_and_the_component_is_turned_with_the_plate() -> None:
    points = vertices(meshes(10.0).block_mesh_dict())
    background, component = points[:16], points[16:]
    assert (background[:, 0].min(), background[:, 0].max()) == (-5.0, 15.0)
    assert (background[:, 1].min(), background[:, 1].max()) == (-2.0, 2.0)
    level = vertices(meshes(0.0).block_mesh_dict())[16:]
    angle = math.radians(10.0)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    np.testing.assert_allclose(component, level @ turn, atol=1e-9)


def test_reach_is_that_of_the_corner_of_the_component() -> None:
    assert meshes(0.0).reach(0.0, 0.3) == pytest.approx(0.75)
    turned = 1.2 * math.sin(0.2) + 0.45 * math.cos(0.2)
    assert meshes(0.0).reach(0.2, 0.0) == pytest.approx(turned)
    # nose up the trailing end is down, and a deflection upwards takes it away from the floor
    assert meshes(0.0).reach(0.2, -0.5) == pytest.approx(turned + 0.5)


def test_short_channel_is_refused() -> None:
    short = OversetMesh(ChannelBox(0.04, 4.0, 1.0, 15.0), 0.0, 1.0)
    with pytest.raises(SolverError, match=r"flow\.channel: .* from -1\.2 c to 2\.4 c"):
        short.block_mesh_dict()


def test_moving_section_is_that_of_the_morphing_mesh(tmp_path: Path) -> None:
    run = run_in(tmp_path)
    run.write_motion(tmp_path)
    run.write_system(tmp_path)
    text = (tmp_path / "constant" / "dynamicMeshDict").read_text()
    for line in ("mass 40;", "momentOfInertia (1 1 3.35);", "stiffness 0.45;", "stiffness 3.22;"):
        assert line in text
    # the motion is read from the log, to which it is written only if asked for
    assert "report yes;" in text
    assert "nOuterCorrectors 8;" in (tmp_path / "system" / "fvSolution").read_text()
    # GAMG ends with a fault on meshes that overlap
    assert "GAMG" not in (tmp_path / "system" / "fvSolution").read_text()


def around_airfoil(incidence_deg: float = 0.0, refinement: float = 1.0) -> OutlineOversetMesh:
    outline = SHAPES["naca 0012"].as_pairs()
    return OutlineOversetMesh(
        OutlineMesh(outline, CHANNEL, math.radians(incidence_deg), refinement)
    )


@pytest.mark.parametrize("height", [4.0, 60.0])
def test_background_of_an_outline_is_even_where_its_disc_comes(height: float) -> None:
    box = ChannelBox(0.12, height, height, height)
    mesh = OutlineOversetMesh(OutlineMesh(SHAPES["deck"].as_pairs(), box, 0.0, 1.0))
    radius = mesh.section.disc_radius
    for lines, ends in zip(
        mesh.background_lines(), ((-height, height), (-height / 2, height / 2)), strict=True
    ):
        assert (lines[0], lines[-1]) == pytest.approx(ends)
        sizes, middle = np.diff(lines), (lines[1:] + lines[:-1]) / 2
        assert sizes[np.abs(middle) < radius] == pytest.approx(0.06, rel=0.02)
        ratio = sizes[1:] / sizes[:-1]
        assert 1 / 1.25 < ratio.min() < ratio.max() < 1.25


def test_background_of_an_outline_ends_with_a_short_channel() -> None:
    """Its disc has the room, its even cells would reach beyond the outlet."""
    box = ChannelBox(0.12, 4.0, 2.1, 2.2)
    mesh = OutlineOversetMesh(OutlineMesh(SHAPES["naca 0012"].as_pairs(), box, 0.0, 1.0))
    mesh.section.require_room()
    along, _ = mesh.background_lines()
    assert (along[0], along[-1]) == pytest.approx((-2.1, 2.2))
    assert np.diff(along).min() > 0.04


def test_refinement_divides_the_background_of_an_outline() -> None:
    cells = around_airfoil().background_cells
    assert around_airfoil(refinement=2.0).background_cells == pytest.approx(4 * cells, rel=0.03)


def test_both_meshes_of_an_outline_are_whole_and_the_background_is_first(tmp_path: Path) -> None:
    mesh = around_airfoil(10.0, 0.5)
    cells = mesh.write(tmp_path)
    points, corners = read_cells(tmp_path)
    assert len(corners) == cells
    areas = cell_areas(points, corners)
    background = areas[: mesh.background_cells]
    assert areas.min() > 0
    assert background.sum() == pytest.approx(4.0 * 20.0, rel=1e-9)
    # the disc is a polygon of many sides
    around = math.pi * mesh.section.disc_radius**2 - SHAPES["naca 0012"].area
    assert areas[mesh.background_cells :].sum() == pytest.approx(around, rel=2e-3)
    found = read_poly_mesh(tmp_path)
    assert next(iter(found.patches)) == OVERSET  # as the library wants it
    ends = found.points[found.faces[found.patches[OVERSET]]][:, :, :2]
    assert np.hypot(*np.moveaxis(ends, -1, 0)) == pytest.approx(mesh.section.disc_radius, rel=1e-5)


def test_section_whose_mesh_has_left_the_channel_is_refused(tmp_path: Path) -> None:
    run = run_in(tmp_path)
    rows = np.array([[0.0, 0.02, 0.04], [0.0, 0.1, 0.0], [0.0, 1.6, 0.0]])
    nothing = np.zeros(3)
    history = SectionHistory(rows[0], rows[1], 0.5 * rows[2], nothing, nothing, nothing)
    run.require_room(history)
    out = replace(history, deflection=rows[2])
    with pytest.raises(BlowUpError, match=r"^at 0\.02 c/V the section's mesh reaches 2\.\d+ c off"):
        run.require_room(out)
    # neither at its largest twist nor at its largest deflection, and again inside at the end
    turned = replace(
        history, twist=np.array([0.0, 0.7, 1.0]), deflection=np.array([-1.3, -1.1, 0.1])
    )
    with pytest.raises(BlowUpError, match=r"^at 0\.02 c/V"):
        run.require_room(turned)
    assert run.within_room(turned).time.tolist() == [0.0]
    assert run.within_room(history).time.size == 3
    # a disc reaches as far at any twist
    assert around_airfoil().reach(0.3, 0.5) == pytest.approx(1.5, abs=0.02)


def test_ends_of_the_section_s_mesh_turn_with_it_about_its_axis() -> None:
    """A corner comes forward as it turns; a disc stays, but where its axis takes mid-chord."""
    turned = math.atan2(0.45, 0.9)
    front, rear = meshes(0.0).ends(np.array([0.0, turned]), 0.0)
    assert front == pytest.approx([-0.9, -math.hypot(0.9, 0.45)])
    assert rear[0] == pytest.approx(1.2)
    for twist in (0.0, 0.3):
        ends = np.array(around_airfoil().ends(twist, 0.5)) - 0.5
        assert ends == pytest.approx([-1.0, 1.0], abs=0.02)


@pytest.mark.parametrize(
    ("upstream", "downstream", "said"),
    [
        (0.95, 15.0, r"reaches -0\.983 c, the inlet is at -0\.95 c"),
        (5.0, 1.25, r"reaches 1\.27 c, the outlet is at 1\.25 c"),
    ],
)
def test_section_whose_mesh_has_reached_an_end_of_the_channel_is_refused(
    tmp_path: Path, upstream: float, downstream: float, said: str
) -> None:
    run = run_in(tmp_path)
    run = replace(run, mesh=replace(run.mesh, channel=ChannelBox(0.04, 4.0, upstream, downstream)))
    level = -run.mesh.incidence
    turn = 0.25 if downstream == 15.0 else -0.2
    twist = np.array([level, level + turn])
    history = SectionHistory(np.array([0.0, 0.02]), twist, *np.zeros((4, 2)))
    with pytest.raises(BlowUpError, match=rf"^at 0\.02 c/V the section's mesh {said}"):
        run.require_room(history)
    assert run.within_room(history).time.tolist() == [0.0]


STEP = """
Time = {time}

6-DoF rigid body motion
    Centre of rotation: (0 {early} 0)
    Orientation: (1 0 0 -0 1 0 0 0 1)
PIMPLE: iteration 2
6-DoF rigid body motion
    Centre of rotation: (0 {late} 0)
    Centre of mass: (0 9 0)
    Orientation: (0.8 0.6 0 -0.6 0.8 0 0 0 1)
"""


def log(folder: Path, *steps: tuple[float, float]) -> None:
    text = "".join(STEP.format(time=time, early=late / 2, late=late) for time, late in steps)
    (folder / "log.pimpleFoam").write_text(text)


def test_motion_is_that_of_the_last_iteration_of_a_step(tmp_path: Path) -> None:
    log(tmp_path, (0.02, 0.1), (0.04, 0.2))
    motion = read_motion(tmp_path)
    np.testing.assert_allclose(motion.time, [0.02, 0.04])
    np.testing.assert_allclose(motion.height, [0.1, 0.2])
    # turned by asin(0.6) about -z, which is nose up
    np.testing.assert_allclose(motion.rotation, math.asin(0.6))


def test_steps_that_a_resumption_repeats_count_once(tmp_path: Path) -> None:
    log(tmp_path, (1.98, 0.1), (2.0, 0.2), (2.02, 0.3), (2.04, 0.4), (2.02, 0.31))
    motion = read_motion(tmp_path)
    np.testing.assert_allclose(motion.time, [1.98, 2.0, 2.02])
    np.testing.assert_allclose(motion.height, [0.1, 0.2, 0.31])


def test_log_that_is_missing_or_without_motion_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"log\.pimpleFoam: no motion"):
        read_motion(tmp_path)
    (tmp_path / "log.pimpleFoam").write_text("Time = 0.02\n")
    with pytest.raises(SolverError, match=r"log\.pimpleFoam: no motion"):
        read_motion(tmp_path)


def openfoam(**section: Any) -> dict[str, Any]:
    return {
        "solver": "openfoam",
        "sweep": {"models": ["2d"]},
        "unsteady": {"time_step": 0.01},
        "openfoam": section,
    }


def test_mesh_motion_is_part_of_a_case_only_where_it_is_not_morph() -> None:
    """Kept results stand under the hashes of settings without it."""
    morph, overset = (
        solver_from_config(load_config(openfoam(mesh_motion=motion)), "coarse").settings("2d")
        for motion in ("morph", "overset")
    )
    assert morph == {"mesh": "coarse", "outer_correctors": 8}
    assert overset == {**morph, "mesh_motion": "overset"}
    assert Adapter.from_settings(overset).settings("2d") == overset


def test_papers_mesh_has_no_overset() -> None:
    with pytest.raises(ConfigError, match=r"openfoam\.meshes\.a: 'finest': allowed are coarse"):
        load_config(openfoam(meshes={"coarse": "coarse", "a": "finest"}, mesh_motion="overset"))
