"""The plate's mesh: the section's over the span, finest at the tip, closed beyond it."""

import math
import re

import numpy as np
import pytest
from tests.sample_cases import GEOMETRY, STEADY_PLATE

from equisection.config import load_config
from equisection.errors import ConfigError, SolverError
from equisection.solvers.openfoam.beam.rigid_beam import plate_mesh_of
from equisection.solvers.openfoam.mesh.beam_mesh import PlateMesh
from equisection.solvers.openfoam.mesh.block_mesh import SIMILAR, ChannelBox, Mesh, Spacing
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.ranks import divisions

CHANNEL = ChannelBox(thickness=0.04, height=4.0, upstream=5.0, downstream=15.0)


def plate_mesh(refinement: float = 0.55, gap: float = 0.3, spacing: Spacing = SIMILAR) -> PlateMesh:
    return PlateMesh(Mesh(CHANNEL, math.radians(2.5), refinement, spacing), 3.7, gap)


@pytest.mark.parametrize(
    ("name", "cells"),
    [
        ("coarse", 8e4),
        ("medium", 3e5),
        ("fine", 1e6),
        ("extra-fine", 3.2e6),
        ("finest", 5e6),
        ("five-layers", 5e6),
    ],
)
def test_presets_have_about_as_many_cells_as_they_are_to_have(name: str, cells: float) -> None:
    preset = PRESETS[name]
    assert preset.plate_cells == pytest.approx(cells, rel=0.07)
    assert plate_mesh(preset.plate, spacing=preset.plate_spacing).cells == preset.plate_cells


@pytest.mark.parametrize(
    ("plane", "span"),
    [("coarse", "medium"), ("coarse", "fine"), ("medium", "coarse"), ("fine", "coarse")],
)
def test_mesh_by_direction_is_one_in_the_plane_and_another_along_the_span(
    plane: str, span: str
) -> None:
    of_plane, of_span, both = (
        plate_mesh(PRESETS[name].plate, spacing=PRESETS[name].plate_spacing)
        for name in (plane, span, f"{plane}-{span}-span")
    )
    assert both.section.cells == of_plane.section.cells
    np.testing.assert_allclose(both.edges(), of_span.edges(), rtol=1e-9)
    assert both.layers == of_span.layers != of_plane.layers
    assert both.layers == PRESETS[f"{plane}-{span}-span"].plate_layers
    assert not PRESETS[f"{plane}-{span}-span"].is_similar  # to the others


def test_sparse_span_has_half_of_the_layers_of_coarse() -> None:
    sparse, coarse = PRESETS["coarse-sparse-span"], PRESETS["coarse"]
    assert sparse.plate_layers == pytest.approx(coarse.plate_layers / 2, abs=1)
    per_layer = coarse.plate_cells / coarse.plate_layers
    assert sparse.plate_cells / sparse.plate_layers == pytest.approx(per_layer, rel=0.01)


def test_layers_along_the_plate_grow_evenly_from_the_tip_to_the_root() -> None:
    edges = plate_mesh().edges()
    sizes = np.diff(edges)
    assert (edges[0], edges[-1]) == (0.0, pytest.approx(3.7))
    even = (sizes[0] / sizes[-1]) ** (1 / (sizes.size - 1))
    np.testing.assert_allclose(sizes[:-1] / sizes[1:], even)
    assert sizes[-1] < 0.12
    assert sizes[0] > 0.2
    # across the gap the layers go on in the size of those at the tip
    assert sizes[-1] == pytest.approx(0.3 / 4, rel=0.6)


def test_refined_mesh_is_similar() -> None:
    coarse, fine = plate_mesh(1.0).edges(), plate_mesh(2.0).edges()
    np.testing.assert_allclose(fine[::2], coarse, atol=0.01)


def test_dictionary_has_the_blocks_of_the_plate_and_of_the_gap() -> None:
    text = plate_mesh().block_mesh_dict()
    blocks = re.findall(r"hex \([\d ]+\) \((\d+) (\d+) (\d+)\)", text)
    assert len(blocks) == 24 + 25
    cells = sum(math.prod(map(int, block)) for block in blocks)
    assert cells == plate_mesh().cells
    assert text.count("symmetryPlane") == 4
    assert "empty" not in text


def test_plate_is_closed_at_its_tip() -> None:
    def faces_of_plate(text: str) -> int:
        match = re.search(r"plate\s*\{\s*type wall;\s*faces \((.*)\);", text)
        assert match
        return match[1].count("(")

    assert faces_of_plate(plate_mesh().block_mesh_dict()) == 5
    assert faces_of_plate(plate_mesh(gap=0.0).block_mesh_dict()) == 4


def test_plate_from_wall_to_wall_has_no_cells_beyond() -> None:
    mesh = plate_mesh(gap=0.0)
    assert mesh.cells == mesh.section.cells * (mesh.edges().size - 1)
    assert mesh.block_mesh_dict().count("hex") == 24


def test_root_off_the_wall_is_refused() -> None:
    free = GEOMETRY.model_copy(update={"root_on_wall": False})
    with pytest.raises(SolverError, match=r"flow\.root_on_wall"):
        plate_mesh_of(STEADY_PLATE.model_copy(update={"geometry": free}), 1.0)
    raw = {
        "solver": "openfoam",
        "flow": {"root_on_wall": False},
        "unsteady": {"time_step": 0.02},
    }
    with pytest.raises(ConfigError, match=r"flow\.root_on_wall: false: allowed is true"):
        load_config(raw)
    polar = {"beam_polar": "measured.csv"}
    load_config({**raw, "steady": polar, "sweep": {"models": ["2d"]}})


@pytest.mark.parametrize(
    ("ranks", "parts"),
    [(1, (1, 1, 1)), (2, (1, 1, 2)), (5, (1, 1, 5)), (8, (2, 1, 4)), (64, (8, 2, 4))],
)
def test_ranks_share_the_span_before_the_chord(ranks: int, parts: tuple[int, int, int]) -> None:
    assert divisions(ranks, layers=23) == parts
    assert math.prod(parts) == ranks
