"""The block mesh around the section: symmetry, size, similarity, and what does not fit."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from equisection.errors import SolverError
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox, Mesh, expansion
from equisection.solvers.openfoam.mesh.presets import PRESETS

CHANNEL = ChannelBox(thickness=0.04, height=4.0, upstream=5.0, downstream=15.0)


def mesh(incidence_deg: float = 2.5, refinement: float = 1.0) -> Mesh:
    return Mesh(CHANNEL, math.radians(incidence_deg), refinement)


def test_mesh_at_zero_incidence_is_symmetric() -> None:
    points = mesh(0.0).points()
    np.testing.assert_allclose(points[:, :, 0], points[:, ::-1, 0])
    np.testing.assert_allclose(points[:, :, 1], -points[:, ::-1, 1])


@pytest.mark.parametrize("angle", [2.5, 12.0])
def test_opposite_incidences_are_mirror_images(angle: float) -> None:
    up, down = mesh(angle).points(), mesh(-angle).points()
    np.testing.assert_allclose(up[:, :, 0], down[:, ::-1, 0], atol=1e-12)
    np.testing.assert_allclose(up[:, :, 1], -down[:, ::-1, 1], atol=1e-12)


def test_plate_has_chord_thickness_and_a_leading_edge_that_is_up() -> None:
    points = mesh(10.0).points()
    leading, trailing = points[2, 2:4].mean(axis=0), points[3, 2:4].mean(axis=0)
    np.testing.assert_allclose(np.linalg.norm(trailing - leading), 1.0)
    np.testing.assert_allclose(np.linalg.norm(points[2, 3] - points[2, 2]), 0.04)
    assert leading[1] == pytest.approx(0.5 * math.sin(math.radians(10.0)))
    np.testing.assert_allclose(leading + trailing, 0.0, atol=1e-12)


def test_mesh_fills_the_channel() -> None:
    points = mesh().points()
    assert (points[..., 0].min(), points[..., 0].max()) == (-5.0, 15.0)
    assert (points[..., 1].min(), points[..., 1].max()) == (-2.0, 2.0)


@pytest.mark.parametrize(
    ("preset", "low", "high"),
    [
        ("coarse", 9e3, 1.3e4),
        ("medium", 1.8e4, 2.5e4),
        ("fine", 4.5e4, 6e4),
        ("extra-fine", 1.0e5, 1.2e5),
        ("finest", 7e4, 9e4),
        ("five-layers", 4.8e4, 5.4e4),  # 5.1e4 in the paper
    ],
)
def test_presets_have_the_cells_that_they_promise(preset: str, low: float, high: float) -> None:
    assert low <= PRESETS[preset].cells <= high


def test_blocks_hold_the_cells_that_are_counted() -> None:
    text = mesh().block_mesh_dict()
    counts = re.findall(r"hex \([\d ]+\) \((\d+) (\d+) 1\)", text)
    assert len(counts) == 24
    assert sum(int(nx) * int(ny) for nx, ny in counts) == mesh().cells


def test_meshes_of_a_grid_study_are_similar() -> None:
    coarse, fine = (mesh(refinement=r).block_mesh_dict() for r in (1.0, 2.0))
    gradings = [re.findall(r"edgeGrading.*", text) for text in (coarse, fine)]
    assert gradings[0] == gradings[1]
    assert mesh(refinement=2.0).cells == 4 * mesh().cells


def test_meshes_of_a_grid_study_have_the_papers_ratios_of_refinement() -> None:
    """Of counts rounded to even numbers, within 1 %."""
    sizes = [PRESETS[name].cells ** -0.5 for name in ("coarse", "medium", "fine")]
    assert all(PRESETS[name].is_similar for name in ("coarse", "medium", "fine"))
    assert sizes[0] / sizes[1] == pytest.approx(math.sqrt(2.0), rel=0.01)
    assert sizes[1] / sizes[2] == pytest.approx(math.sqrt(2.5), rel=0.01)


@pytest.mark.parametrize(("length", "cells", "first"), [(1.0, 10, 0.01), (0.7, 32, 3e-4)])
def test_expansion_fills_the_length(length: float, cells: int, first: float) -> None:
    growth = expansion(length, cells, first) ** (1 / (cells - 1))
    assert first * sum(growth**n for n in range(cells)) == pytest.approx(length)


def test_incidence_that_does_not_fit_is_refused() -> None:
    with pytest.raises(SolverError, match=r"turned to 60 deg, does not fit into a channel of 4 c"):
        mesh(60.0).points()


def test_section_that_is_too_low_is_said_to_be_below() -> None:
    low = ChannelBox(thickness=0.04, height=4.0, upstream=5.0, downstream=15.0, section_height=-1.4)
    with pytest.raises(SolverError, match=r"to 15 c with the section 1\.4 c below its middle; "):
        Mesh(low, math.radians(60.0), 1.0).points()
    assert "0.3 c above its middle" in replace(low, section_height=0.3).words
    assert not CHANNEL.words
