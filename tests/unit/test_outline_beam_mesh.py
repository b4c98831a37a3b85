"""Beams of an outline without OpenFOAM: extruded cells, places along the contour, surface data."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose
from tests.sample_cases import GEOMETRY, STEADY_PLATE
from tests.unit.test_outline_mesh import SHAPES, ring

from equisection.beam.outline import outline_of, placed
from equisection.errors import SolverError
from equisection.figures.mesh_of_beam import _on_upper_side
from equisection.figures.surface_of_beam import on_grid
from equisection.results.plate_surface import PlateSurface, joined, plate_surface_from_dataset
from equisection.solvers.openfoam.beam.rigid_beam import outline_beam_mesh_of, plate_mesh_of
from equisection.solvers.openfoam.mesh.beam_mesh import SIDE_WALLS, planes_beyond
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.extruded_cells import Extrusion
from equisection.solvers.openfoam.mesh.outline_mesher import PATCHES, patches_of
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.reading import contour_places
from equisection.solvers.openfoam.reading.contour_places import Contour, cut_at

#: A panel of 0.02 c on a tube of 0.07 c that it touches.
TRACKER = outline_of(
    placed(
        np.array(
            [
                [0, 0],
                [0.47, 0],
                *(
                    [0.5 - 0.035 * math.cos(t), -0.03 - 0.035 * math.sin(t)]
                    for t in np.linspace(-0.55, math.pi + 0.55, 40)
                ),
                [0.53, 0],
                [1, 0],
                [1, 0.02],
                [0, 0.02],
            ]
        )
    )
)
LEVELS = np.array([0.0, 1.0, 1.5, 2.5])


def extruded(folder: Path, tip: int) -> int:
    """Write the cells around a square of 1 c up to level 3, with those inside it beyond the tip."""
    around = ring()
    corners = np.array([[5, 6, 10, 9]])  # of the square, counter-clockwise
    inside = PlaneCells(around.points, np.concatenate([around.corners, corners]))
    box = ChannelBox(1.0, 3.0, 1.5, 1.5)
    cells = Extrusion(around, inside if tip < 3 else None, LEVELS, tip)
    patches = {**PATCHES, **SIDE_WALLS}
    return cells.write(folder, patches, lambda a, b: patches_of(box, a, b), "plate")


@pytest.mark.parametrize(("tip", "cells", "on_body"), [(2, 28, 9), (3, 27, 12)])
def test_extruded_mesh_is_closed(tmp_path: Path, tip: int, cells: int, on_body: int) -> None:
    """Each cell's faces add up to nothing, and all cells to the channel without the body."""
    assert extruded(tmp_path, tip) == cells
    mesh = read_poly_mesh(tmp_path)
    sizes = {name: part.stop - part.start for name, part in mesh.patches.items()}
    assert sizes["plate"] == on_body
    assert (sizes["root_wall"], sizes["far_wall"]) == (9, 10 if tip < 3 else 9)
    corners = mesh.points[mesh.faces]
    normal = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    text = (tmp_path / "constant/polyMesh/neighbour").read_text().split("(")[1].split(")")[0]
    neighbour = np.array(text.split(), dtype=int)
    inside = neighbour.size
    assert (neighbour > mesh.owner[:inside]).all()
    # OpenFOAM's order: by the lower cell, and then by the higher one
    pairs = list(zip(mesh.owner[:inside].tolist(), neighbour.tolist(), strict=True))
    assert pairs == sorted(pairs)
    total, volume = np.zeros((cells, 3)), np.zeros(cells)
    flux = (normal * corners.mean(axis=1)).sum(axis=1) / 3  # Gauss, of the place itself
    for of_cell, values in ((total, normal), (volume, flux)):
        np.add.at(of_cell, mesh.owner, values)
        np.subtract.at(of_cell, neighbour, values[:inside])
    assert_allclose(total, 0.0, atol=1e-12)
    assert volume.min() > 0
    assert volume.sum() == pytest.approx(9.0 * LEVELS[-1] - 1.0 * LEVELS[tip])
    # out of the fluid: at the root towards -z, and into the body at its tip
    assert (normal[mesh.patches["root_wall"], 2] < 0).all()
    ends = normal[mesh.patches["plate"], 2]
    assert ends.min() == pytest.approx(-1.0 if tip < 3 else 0.0, abs=1e-12)


def test_cells_beyond_the_tip_grow_where_the_gap_is_wide() -> None:
    assert_allclose(np.diff(planes_beyond(0.3, 1.0)), 0.3 / 8)
    for longest in (math.inf, 0.5):
        wide = np.diff(planes_beyond(30.0, 1.0, longest))
        assert wide.sum() == pytest.approx(30.0)
        assert 0.8 / 16 < wide[0] <= 1 / 16
        assert 1.0 < (wide[1:] / wide[:-1]).max() <= 1.25 + 1e-9
        assert wide.max() <= longest


def test_long_beam_has_layers_as_long_as_a_short_one() -> None:
    case = STEADY_PLATE.model_copy(update={"geometry": GEOMETRY.model_copy(update={"span": 12.0})})
    short, long = (outline_beam_mesh_of(one, 0.52) for one in (STEADY_PLATE, case))
    assert np.diff(long.edges()).max() < 1.2 * np.diff(short.edges()).max()
    for mesh in (short, long):
        assert mesh.edges()[-1] == pytest.approx(mesh.span)
        assert mesh.levels()[-1] == pytest.approx(mesh.span + 0.3)
        assert mesh.layers == mesh.levels().size - 1


def test_mesh_finer_in_the_plane_alone_has_the_layers_of_the_coarse_one() -> None:
    """Around the outline as on blocks, by the same preset."""
    finer, coarse = PRESETS["medium-coarse-span"], PRESETS["coarse"]
    assert finer.plate == PRESETS["medium"].plate > coarse.plate
    meshes = [
        outline_beam_mesh_of(STEADY_PLATE, one.plate, along_span=one.plate_spacing.along_span)
        for one in (coarse, finer)
    ]
    blocks = [plate_mesh_of(STEADY_PLATE, one.plate, one.plate_spacing) for one in (coarse, finer)]
    for mesh in (*meshes, *blocks):
        assert_allclose(mesh.edges(), meshes[0].edges())
    assert_allclose(meshes[1].levels(), meshes[0].levels())
    assert finer.outline_beam_cells / coarse.outline_beam_cells == pytest.approx(
        (finer.plate / coarse.plate) ** 2, rel=1e-4
    )


def test_beam_with_a_fine_detail_has_more_layers() -> None:
    """A tube under a panel, whose notches have thin cells: no cell is too slender for checkMesh."""
    geometry = GEOMETRY.model_copy(update={"outline": TRACKER.as_pairs()})
    case = STEADY_PLATE.model_copy(update={"geometry": geometry})
    fine, plain = (outline_beam_mesh_of(one, 0.52).edges() for one in (case, STEADY_PLATE))
    assert fine.size > plain.size
    assert np.diff(fine).max() < np.diff(plain).max()


def test_root_away_from_a_wall_is_refused() -> None:
    geometry = GEOMETRY.model_copy(update={"root_on_wall": False})
    case = STEADY_PLATE.model_copy(update={"geometry": geometry})
    with pytest.raises(SolverError, match=r"flow\.root_on_wall: false"):
        outline_beam_mesh_of(case, 0.52)


@pytest.mark.parametrize("name", SHAPES)
def test_places_along_a_contour_are_its_arc_length(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Middles of edges, a little off the contour: sides as long as it, each from nose to tail."""
    monkeypatch.setattr(contour_places, "_AT_ONCE", 3)
    outline = SHAPES[name]
    after = np.roll(outline.points, -1, axis=0)
    edges = after - outline.points
    length = np.hypot(*edges.T)
    normal = np.stack([edges[:, 1], -edges[:, 0]], axis=-1) / length[:, None]
    middle = (outline.points + after) / 2 - 1e-6 * normal
    contour = Contour.of(outline.points)
    side, arc = contour.place(middle, normal)
    assert contour.length == pytest.approx(outline.perimeter)
    for one in ("upper", "lower"):
        here = side == one
        order = np.argsort(arc[here])
        reach = np.cumsum(length[here][order]) - length[here][order] / 2
        assert_allclose(arc[here][order], reach, atol=1e-9)
    assert length[side == "upper"].sum() == pytest.approx(contour.upper)
    # a contour without overhang has one side above the other
    if name in {"airfoil", "cambered"}:
        assert (normal[side == "upper", 1] > 0).mean() > 0.9
        assert (normal[side == "lower", 1] < 0).mean() > 0.9


def test_cut_of_a_rectangle_across_the_stream_is_as_thick_as_it_is_turned() -> None:
    angles = np.radians([0.0, 10.0, 30.0])
    low, high = cut_at(SHAPES["rectangle"].points, 0.1, angles).T
    assert_allclose(high - low, 0.04 / np.cos(angles))
    assert_allclose((high + low) / 2, -0.1 * np.tan(angles), atol=1e-12)
    assert np.isnan(cut_at(SHAPES["rectangle"].points, 0.6, angles)).all()


SPAN, LAYERS, FACES = 2.0, 9, 200


def round_beam(pressure: Callable[[np.ndarray, np.ndarray], np.ndarray]) -> PlateSurface:
    """Return a cylinder of 0.4 c about mid-chord with layers that become finer, and no tip."""
    edges = SPAN * (1 - np.linspace(1.0, 0.0, LAYERS + 1) ** 1.5)
    angle = np.linspace(np.pi, 0.0, FACES + 1)
    pieces = []
    for side, sense in (("upper", 1.0), ("lower", -1.0)):
        points = 0.2 * np.stack([np.cos(angle), sense * np.sin(angle)], axis=-1)
        middle, edge = (points[1:] + points[:-1]) / 2, np.diff(points, axis=0)
        length = np.hypot(*edge.T)
        for low, high in itertools.pairwise(edges):
            zero = np.zeros(FACES)
            pieces.append(
                PlateSurface(
                    x=middle[:, 0] + 0.5,
                    y=middle[:, 1],
                    z=zero + (low + high) / 2,
                    area=length * (high - low),
                    side=np.full(FACES, side),
                    pressure=pressure(*middle.T),
                    friction=zero,
                    spanwise_friction=zero,
                    y_plus=zero + 1.0,
                    normal_x=-sense * edge[:, 1] / length,
                    normal_y=sense * edge[:, 0] / length,
                    arc=np.cumsum(length) - length / 2,
                )
            )
    return joined(pieces[::-1])


def test_beam_in_a_pressure_gradient_floats() -> None:
    """Gauss, per span: the force of a pressure along x or y is minus the area of the section."""
    area = 0.5 * 2 * FACES * 0.2**2 * np.sin(np.pi / FACES)
    beam = round_beam(lambda x, y: x)
    assert beam.span == pytest.approx(SPAN, rel=1e-12)
    assert beam.loads(0.0) == pytest.approx((-area, 0.0, 0.0), abs=1e-12)
    across = round_beam(lambda x, y: y).loads(0.0)
    assert across == pytest.approx((0.0, -area, 0.0), abs=1e-12)
    turned = round_beam(lambda x, y: y).loads(30.0)
    assert turned[:2] == pytest.approx((-area / 2, -area * math.sqrt(3) / 2), abs=1e-12)


def test_friction_of_a_beam_is_along_its_contour() -> None:
    """Towards the tail on both sides it drags by the height that faces the stream."""
    beam = round_beam(lambda x, y: 0.0 * x)
    beam = replace(beam, friction=np.ones_like(beam.x))
    assert beam.loads(0.0) == pytest.approx((0.8, 0.0, 0.0), abs=1e-12)
    separated = replace(beam, friction=np.where(beam.arc < 0.2, 1.0, -1.0))
    z, ends = replace(separated, friction=-separated.friction).reattachment("upper")
    assert z.size == LAYERS
    # the arc of 0.2 c is one radian from the nose
    assert_allclose(ends, 0.5 - 0.2 * np.cos(1.0), atol=0.003)


def test_surface_of_a_beam_is_read_as_it_was_written_and_drawn_along_its_arc() -> None:
    beam = round_beam(lambda x, y: x + y)
    found = plate_surface_from_dataset(xr.Dataset(beam.variables()))
    assert found is not None
    assert found.loads(2.0) == pytest.approx(beam.loads(2.0), abs=1e-5)
    assert (np.diff(found.on("upper").arc[:FACES]) > 0).all()
    drawn = on_grid(beam.on("upper"), beam.span)
    half = math.pi * 0.2
    assert drawn.x[-1] + drawn.x[0] == pytest.approx(half, abs=0.01)
    at = np.clip(drawn.x, beam.arc.min(), beam.arc.max()) / 0.2
    expected = 0.2 * (-np.cos(at) + np.sin(at))
    assert_allclose(drawn.pressure[:, 3], expected, atol=2e-3)


@pytest.mark.parametrize("clockwise", [False, True])
def test_lines_of_the_mesh_from_above_are_those_of_the_upper_side(clockwise: bool) -> None:
    """Of a square in its channel, of either sense of rotation of its cells."""
    cells = ring()
    corners = cells.corners[:, ::-1] if clockwise else cells.corners
    assert_allclose(_on_upper_side(cells.points, corners, 0.0), [0.0, 1.0])
