"""Mesh of an outline up to gmsh's part, and what happens where gmsh does not do its own."""

from __future__ import annotations

import math
import resource
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from tests.sample_cases import GEOMETRY, STEADY

from equisection.beam import outline as shapes
from equisection.beam.outline import Outline, outline_of, placed
from equisection.cases import SteadyCase, case_hash
from equisection.config import load_config
from equisection.errors import ConfigError, SolverError
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.mesh import gmsh_fill, outline_mesh
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_layers import layers_of
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh, require_mesher
from equisection.solvers.openfoam.mesh.outline_mesher import patches_of
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.mesh.outline_wall import wall_of
from equisection.solvers.openfoam.mesh.plane_cells import (
    PlaneCells,
    corner_areas,
    write_layer,
)
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.reading.section_surface import contour_of_outline
from equisection.solvers.openfoam.section.rigid_section import outline_mesh_of
from equisection.solvers.openfoam.settings import Settings
from equisection.study.given_outline import check_outline
from equisection.study.plan import steady_dimensions

SIZES = OutlineSizes()
CHANNEL = ChannelBox(0.12, 4.0, 5.0, 15.0)
H_SECTION = [
    [0, 0], [0.1, 0], [0.1, 0.45], [0.9, 0.45], [0.9, 0], [1, 0],
    [1, 1], [0.9, 1], [0.9, 0.55], [0.1, 0.55], [0.1, 1], [0, 1],
]  # fmt: skip
SHAPES = {
    "rectangle": outline_of(shapes.rectangle(0.04)),
    "rounded": outline_of(shapes.rectangle(0.04, 0.02)),
    "airfoil": outline_of(placed(shapes.naca("0012"), 1.0), is_airfoil=True),
    "cambered": outline_of(placed(shapes.naca("4412"), 1.0), is_airfoil=True),
    "h": outline_of(placed(np.array(H_SECTION))),
}


def area(cells: PlaneCells) -> float:
    x, y = np.moveaxis(cells.points[cells.corners], -1, 0)
    return 0.5 * float((x * np.roll(y, -1, 1) - np.roll(x, -1, 1) * y).sum())


@pytest.mark.parametrize("name", SHAPES)
def test_wall_is_on_the_outline(name: str) -> None:
    """Vertices on a contour enclose no more than it, and nearly as much."""
    outline = SHAPES[name]
    found = Outline(wall_of(outline.points, SIZES, 1.0).points)
    assert found.area == pytest.approx(outline.area, rel=2e-3)
    assert found.perimeter <= outline.perimeter * (1 + 1e-9)


def test_wall_is_fine_where_it_curves_and_at_corners() -> None:
    wall = wall_of(SHAPES["airfoil"].points, SIZES, 1.0)
    spacing = np.hypot(*(np.roll(wall.points, -1, axis=0) - wall.points).T)
    nose, tail = np.argmin(wall.points[:, 0]), np.argmax(wall.points[:, 0])
    radius = 1.1019 * 0.12**2  # of the leading edge (NACA Report 460)
    assert spacing[nose] == pytest.approx(math.radians(SIZES.turn_deg) * radius, rel=0.25)
    assert spacing[tail] == pytest.approx(SIZES.at_corner, rel=0.2)
    assert spacing.max() <= SIZES.wall * 1.05
    assert wall.is_corner.sum() == 1


@pytest.mark.parametrize("refinement", [0.5, 1.0, math.sqrt(2.0), math.sqrt(5.0)])
@pytest.mark.parametrize("name", SHAPES)
def test_layers_do_not_fold(name: str, refinement: float) -> None:
    outline = SHAPES[name]
    layers = layers_of(wall_of(outline.points, SIZES, refinement), SIZES, refinement)
    assert corner_areas(layers.cells).min() > 0
    assert len(layers.front) % 2 == 0
    around = Outline(layers.cells.points[layers.front]).area
    wall = wall_of(outline.points, SIZES, refinement).points
    assert area(layers.cells) == pytest.approx(around - Outline(wall).area, rel=1e-9)


def test_layers_are_similar_and_thicker_than_a_bubble() -> None:
    """0.1 c thick above mid-chord on every mesh; the first cell is finer by the refinement."""
    for refinement in (1.0, math.sqrt(5.0)):
        wall = wall_of(SHAPES["rectangle"].points, SIZES, refinement)
        layers = layers_of(wall, SIZES, refinement)
        above = np.argmin(np.hypot(*(wall.points - (0.0, 0.02)).T))
        column = layers.cells.points[
            np.abs(layers.cells.points[:, 0] - wall.points[above, 0]) < 1e-6
        ]
        heights = np.sort(column[column[:, 1] > 0.0199][:, 1]) - 0.02
        assert heights[1] == pytest.approx(SIZES.first / refinement, rel=1e-6)
        assert 0.1 < heights[-1] < 0.125


def test_first_cell_has_no_larger_y_plus_at_a_higher_reynolds_number() -> None:
    """By c_f = 0.058 Re^(-1/5) of a turbulent flat plate; the layers stay as thick."""

    def y_plus(reynolds: float) -> float:
        middle = SIZES.resolving(reynolds).first / 2
        return middle * reynolds * math.sqrt(0.029 * reynolds**-0.2)

    assert SIZES.resolving(3.4e5) is SIZES
    assert y_plus(4e5) == pytest.approx(2.8, abs=0.05)
    assert y_plus(8e6) == pytest.approx(y_plus(4e5), rel=1e-9)
    assert SIZES.resolving(1e8) == SIZES.resolving(1e7)  # beyond, checkMesh finds them too long
    assert SIZES.wall / SIZES.resolving(1e8).first < 1000.0
    heights = []
    for sizes in (SIZES, SIZES.resolving(1e7)):
        layers = layers_of(wall_of(SHAPES["rectangle"].points, sizes, 1.0), sizes, 1.0)
        heights.append(layers.cells.points[layers.front][:, 1].max())
    assert heights[0] == pytest.approx(heights[1], rel=0.02)
    case = STEADY.model_copy(update={"medium": STEADY.medium.model_copy(update={"speed": 2000.0})})
    assert outline_mesh_of(case, 1.0).sizes.first < SIZES.first / 10


def test_outline_without_room_for_layers_is_refused() -> None:
    """A slit that is narrower than the first cells of both of its walls."""
    slit = [[-0.5, -0.1], [0.5, -0.1], [0.5, 0.1], [1e-4, 0.1], [1e-4, 0.0], [-1e-4, 0.0],
            [-1e-4, 0.1], [-0.5, 0.1]]  # fmt: skip
    with pytest.raises(BlowUpError, match=r"no layers of cells fit around the outline at x/c"):
        layers_of(wall_of(np.array(slit), SIZES, 1.0), SIZES, 1.0)


def test_cells_are_turned_and_joined() -> None:
    square = PlaneCells(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), np.array([[0, 1, 2, 3]]))
    beside = PlaneCells(square.points + np.array([1.0, 0.0]), square.corners)
    both = square.joined(beside, np.array([0, 3]), np.array([1, 2]))
    assert both.points.shape == (6, 2)
    assert area(both) == pytest.approx(2.0)
    assert_allclose(square.turned(math.pi / 2).points[1], [0.0, 1.0], atol=1e-15)


@pytest.mark.parametrize(
    ("corners", "sound"),
    [([0, 1, 2, 3], True), ([0, 1, 2, 2], True), ([0, 0, 1, 2], True), ([0, 2, 1, 3], False),
     ([0, 3, 2, 1], False), ([0, 1, 4, 3], False)],
)  # fmt: skip
def test_folded_cells_are_found(corners: list[int], sound: bool) -> None:
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0], [0.2, 0.2]])
    assert (corner_areas(PlaneCells(points, np.array([corners])))[0] > 0) == sound


def ring() -> PlaneCells:
    """Return eight cells, one a pair of triangles, around a square of 1 c in one of 3 c."""
    x, y = np.meshgrid(np.arange(4) - 1.5, np.arange(4) - 1.5)
    points = np.stack([x.ravel(), y.ravel()], axis=-1)
    cells = [[4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4]
             for j in range(3) for i in range(3) if (i, j) != (1, 1)]  # fmt: skip
    a, b, c, d = cells.pop(0)
    return PlaneCells(points, np.array([[a, b, c, c], [a, c, d, d], *cells]))


def written(folder: Path) -> None:
    box = ChannelBox(1.0, 3.0, 1.5, 1.5)
    kinds = dict.fromkeys(("inlet", "outlet", "floor", "ceiling"), "patch") | {"plate": "wall"}
    write_layer(folder, [ring()], kinds, lambda a, b: patches_of(box, a, b))


def test_written_mesh_is_read_again(tmp_path: Path) -> None:
    """Faces inside by owner; every cell is closed: its faces' areas add up to nothing."""
    written(tmp_path)
    mesh = read_poly_mesh(tmp_path)
    sizes = {name: part.stop - part.start for name, part in mesh.patches.items()}
    assert sizes == {"inlet": 3, "outlet": 3, "floor": 3, "ceiling": 3, "plate": 4, "sides": 18}
    inside = mesh.patches["inlet"].start
    assert (np.diff(mesh.owner[:inside]) >= 0).all()
    corners = mesh.points[mesh.faces]
    normal = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    total = np.zeros((9, 3))
    np.add.at(total, mesh.owner, normal)
    text = (tmp_path / "constant/polyMesh/neighbour").read_text().split("(")[1].split(")")[0]
    neighbour = np.array(text.split(), dtype=int)
    assert (neighbour > mesh.owner[:inside]).all()
    np.subtract.at(total, neighbour, normal[:inside])
    assert_allclose(total, 0.0, atol=1e-12)
    # out of the cells at the boundary: those of the inlet point upstream
    assert (normal[mesh.patches["inlet"], 0] < 0).all()


def test_contour_goes_from_nose_to_tail_on_either_side(tmp_path: Path) -> None:
    written(tmp_path)
    mesh = read_poly_mesh(tmp_path)
    order, side, first, last = contour_of_outline(mesh, 0.0)
    assert sorted(order) == [0, 1, 2, 3]
    edge = last - first
    middle = (first + last) / 2
    outward = (edge[:, 1] * middle[:, 0] - edge[:, 0] * middle[:, 1]) > 0
    assert outward.all()
    upper, lower = side == "upper", side == "lower"
    assert_allclose(first[upper][:-1], last[upper][1:])
    assert_allclose(last[lower][:-1], first[lower][1:])
    nose, tail = first[lower][0], last[lower][-1]
    assert_allclose([last[upper][0], first[upper][-1]], [nose, tail])
    assert (nose[0], tail[0]) == (-0.5, 0.5)


def test_sides_are_the_same_at_every_incidence(tmp_path: Path) -> None:
    """Both front corners of a square are as far forward, whatever rounding leaves of it."""
    written(tmp_path)
    mesh = read_poly_mesh(tmp_path)
    order, side, _, _ = contour_of_outline(mesh, 0.0)
    for angle in np.radians(np.arange(-30, 31)):
        turned = PlaneCells(mesh.points[:, :2], np.empty((0, 4), dtype=int)).turned(-angle).points
        points = np.column_stack([turned, mesh.points[:, 2]])
        found = contour_of_outline(replace(mesh, points=points), float(angle))
        assert list(found[0]) == list(order)
        assert list(found[1]) == list(side)


def test_mesh_with_a_gap_is_refused(tmp_path: Path) -> None:
    kinds = {"inlet": "patch"}
    with pytest.raises(SolverError, match="the mesh has a gap at"):
        write_layer(tmp_path, [ring()], kinds, lambda a, b: np.full(len(a), "plate"))


def airfoil_mesh(incidence_deg: float = 0.0, channel: ChannelBox = CHANNEL) -> OutlineMesh:
    outline = SHAPES["airfoil"].as_pairs()
    return OutlineMesh(outline, channel, math.radians(incidence_deg), 0.5)


def test_narrow_channel_is_refused() -> None:
    airfoil_mesh(10.0).require_room()
    with pytest.raises(SolverError, match=r"of radius 1 c, does not fit into a channel of 2 c"):
        airfoil_mesh(0.0, ChannelBox(0.12, 2.0, 5.0, 15.0)).require_room()


def test_hung_gmsh_is_ended(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"gmsh did not end the mesh .* within 0\.06 s and"):
        airfoil_mesh().write(tmp_path, time_limit=0.005)


@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="no limit of processor time here")
def test_gmsh_that_computes_for_ever_is_ended_by_its_processor_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A busy machine ends no mesh: here the clock may go on for 600 times as long."""
    monkeypatch.setattr(outline_mesh, "BY_THE_CLOCK", 600.0)
    (tmp_path / "gmsh.py").write_text("while True: pass")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    with pytest.raises(SolverError, match="within 1 s of processor and was ended"):
        airfoil_mesh().write(tmp_path / "case", time_limit=1.0)


@pytest.mark.parametrize(
    ("fake", "said"),
    [
        ("import os\nos.abort()", r"signal 6\)"),
        ("raise OSError('libGLU.so.1: cannot open shared object file')",
         r"gmsh does not load \(libGLU\.so\.1: .*apt-get install libglu1-mesa"),
        ("raise ModuleNotFoundError('no gmsh')", r"need gmsh: make openfoam"),
    ],
)  # fmt: skip
def test_gmsh_that_crashes_or_does_not_load(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fake: str, said: str
) -> None:
    (tmp_path / "gmsh.py").write_text(fake)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    with pytest.raises(SolverError, match=said):
        airfoil_mesh().write(tmp_path / "case")


def test_missing_gmsh_in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gmsh", None)
    with pytest.raises(SolverError, match="need gmsh: make openfoam"):
        gmsh_fill.loaded()


def test_make_installs_the_libraries_that_the_message_names() -> None:
    makefile = (Path(__file__).parents[2] / "Makefile").read_text(encoding="utf-8")
    assert f"\nGMSH_NEEDS := {gmsh_fill.LIBRARIES}\n" in makefile


def test_start_without_an_outline_loads_no_splines() -> None:
    """Every start with OpenFOAM looks at the room of the mesh; splines take most of a second."""
    code = "import sys, equisection.solvers.openfoam.mesh.room; print(*sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"scipy.interpolate", "shapely", "gmsh"} & set(said.stdout.split())


def test_case_of_another_mesher_is_refused() -> None:
    with pytest.raises(SolverError, match=r"'outline 0, gmsh 1', installed is 'outline"):
        require_mesher("outline 0, gmsh 1", 3.4e5)


CROSS_SECTION = {
    "bending_rigidity": 60.0, "torsional_rigidity": 25.0,
    "mass_per_length": 1.2, "inertia_per_length": 0.006,
}  # fmt: skip
WING = {
    "solver": "openfoam",
    "beam": {"outline": {"naca": "0012"}, "cross_section": CROSS_SECTION},
    "structure": {"method": "beam"},
    "sweep": {"models": ["2d"]},
    "steady": {"resolution": "coarse"},
    "unsteady": {"time_step": 0.02},
}


def test_outline_decides_the_mesher() -> None:
    config = load_config(WING)
    settings = Adapter.from_config(config, "coarse").settings("2d")
    assert settings["mesher"].startswith("outline 1, gmsh ")
    fast = load_config({**WING, "flow": {"speed": 80.0}})  # 5.1e5: another mesh, another case
    mesher = Adapter.from_config(fast, "coarse").settings("2d")["mesher"]
    assert mesher.startswith("outline 2, gmsh ")
    assert steady_dimensions(config) == ("2d",)
    plate = load_config({**WING, "beam": {}, "structure": {}})
    assert "mesher" not in Adapter.from_config(plate, "coarse").settings("2d")
    plate = load_config({**WING, "beam": {}, "structure": {}, "openfoam": {"mesher": "outline"}})
    assert "mesher" in Adapter.from_config(plate, "coarse").settings("2d")
    assert "mesher" in Adapter.from_config(plate, "coarse").settings("3d")
    blocks = load_config({**WING, "beam": {}, "structure": {}})
    assert "mesher" not in Adapter.from_config(blocks, "coarse").settings("3d")


def test_rigid_beam_of_an_outline_is_run_where_a_model_needs_it() -> None:
    for models in (["3d"], ["2d", "2d-corrected"]):
        assert steady_dimensions(load_config({**WING, "sweep": {"models": models}})) == ("2d", "3d")
    polar = {"steady": {**WING["steady"], "beam_polar": "config/polars/paper_plate_3d.csv"}}
    config = load_config({**WING, **polar, "sweep": {"models": ["2d", "3d"]}})
    assert steady_dimensions(config) == ("2d",)
    free = load_config({**WING, "flow": {"channel": None}, "sweep": {"models": ["3d"]}})
    assert Adapter.from_config(free, "coarse").settings("3d")["far_field"] == 30.0


def test_cambered_outline_is_let_go_at_zero_and_a_symmetric_one_is_not() -> None:
    """It has a lift there; a symmetric one would stay where it is."""
    at_zero = {**WING, "flow": {"incidence_deg": 0.0}}
    cambered = {**at_zero, "beam": {**WING["beam"], "outline": {"naca": "4412"}}}
    assert load_config(cambered).flow.incidence_deg == 0.0
    with pytest.raises(ConfigError, match=r"flow\.incidence_deg: 0: .* nothing sets it in motion"):
        load_config(at_zero)
    started = {"unsteady": {**WING["unsteady"], "start": {"twist_deg": 1.0}}}
    assert load_config({**at_zero, **started}).unsteady.start.twist_deg == 1.0


def test_symmetry_of_a_file_is_seen_in_its_points(tmp_path: Path) -> None:
    at_zero = {**WING, "flow": {"incidence_deg": 0.0}}
    for camber, is_refused in ((0.0, True), (0.05, False)):
        corners = [(0, 0), (0.5, -0.1 + camber), (1, 0), (0.5, 0.1 + camber)]
        path = tmp_path / f"{camber}.csv"
        path.write_text("\n".join(f"{x},{y}" for x, y in corners))
        config = load_config({**at_zero, "beam": {**WING["beam"], "outline": {"file": path.name}}})
        if not is_refused:
            check_outline(config, tmp_path)
            continue
        with pytest.raises(ConfigError, match=r"flow\.incidence_deg: 0: .* nothing sets it in"):
            check_outline(config, tmp_path)


def test_laminar_flow_is_another_case_of_the_section() -> None:
    plain = Adapter.from_config(load_config(WING), "coarse").settings("2d")
    laminar = load_config({**WING, "openfoam": {"turbulence": "laminar"}})
    solver = Adapter.from_config(laminar, "coarse")
    assert solver.settings("2d") == {**plain, "turbulence": "laminar"}
    assert "turbulence" not in solver.settings("3d")


def test_beam_of_an_outline_is_not_taken_for_a_rectangle(tmp_path: Path) -> None:
    geometry = GEOMETRY.model_copy(update={"outline": SHAPES["airfoil"].as_pairs()})
    case = STEADY.model_copy(update={"geometry": geometry, "dimension": "3d"})
    solver = Adapter(Settings("coarse", 2))
    with pytest.raises(SolverError, match="the case has an outline and no mesher of outlines"):
        solver.plate_grid(case, tmp_path)


def test_case_keeps_its_outline_and_its_hash() -> None:
    """An outline makes another case; without one the case is written as before."""
    assert "outline" not in STEADY.model_dump()["geometry"]
    geometry = GEOMETRY.model_copy(update={"outline": SHAPES["airfoil"].as_pairs()})
    case = STEADY.model_copy(update={"geometry": geometry})
    assert case_hash(case) != case_hash(STEADY)
    assert SteadyCase.model_validate_json(case.model_dump_json()) == case


def test_far_field_takes_the_place_of_the_channel() -> None:
    free = {"channel_height": None, "tip_gap": None, "upstream": None, "downstream": None}
    case = STEADY.model_copy(update={"geometry": GEOMETRY.model_copy(update=free)})
    assert outline_mesh_of(case, 1.0, 30.0).channel == ChannelBox(0.04, 60.0, 30.0, 30.0)
    with pytest.raises(SolverError, match=r"flow\.channel: null"):
        outline_mesh_of(case, 1.0)
    flow = {"channel": None}
    settings = Adapter.from_config(load_config({**WING, "flow": flow}), "coarse").settings("2d")
    assert settings["far_field"] == 30.0
    assert "far_field" not in Adapter.from_config(load_config(WING), "coarse").settings("2d")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            {"sweep": {"models": ["2d", "3d"]}, "flow": {"root_on_wall": False}},
            "flow.root_on_wall: false: allowed is true",
        ),
        (
            {"sweep": {"models": ["2d-corrected"]}, "flow": {"root_on_wall": False}},
            "flow.root_on_wall: false: allowed is true",
        ),
        ({"openfoam": {"meshes": {"coarse": "finest"}}}, "allowed are coarse, medium, fine"),
    ],
)
def test_what_outlines_do_not_have_is_refused_by_name(change: dict[str, object], said: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load_config({**WING, **change})
    assert said in str(caught.value)
