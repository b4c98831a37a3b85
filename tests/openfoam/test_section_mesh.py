"""Meshes that the real generator makes: sound, of the sizes that are promised, and read whole."""

from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import GEOMETRY, STEADY

from equisection.results.plane_mesh import cell_areas, edges
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import (
    control,
    write_mesh_dictionary,
    write_system,
)
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.block_mesh import Mesh
from equisection.solvers.openfoam.mesh.near_wall_spacing import (
    DOMAIN,
    FIRST_LAYER,
    LAYERS,
    LAYERS_THICK,
    NEAR_FIELD,
    OFF_WALL,
    WAKE,
    WALL,
)
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.reading.meshed_section import quality, read_cells, section_mesh
from equisection.solvers.openfoam.section.rigid_section import make_mesh, mesh_of


def made(installation: Installation, mesh: Mesh, folder: Path) -> Path:
    write_mesh_dictionary(folder, mesh)
    write_system(
        folder,
        control("simpleFoam", 1, 1, 1),
        flow.schemes(steady=True),
        flow.steady_solution(),
    )
    make_mesh(installation, folder)
    return folder


def mesh(preset: str, incidence_deg: float, thickness: float = GEOMETRY.thickness) -> Mesh:
    geometry = GEOMETRY.model_copy(update={"thickness": thickness})
    case = STEADY.model_copy(update={"incidence_deg": incidence_deg, "geometry": geometry})
    return mesh_of(case, PRESETS[preset].refinement, PRESETS[preset].spacing)


#: Incidence (deg) and thickness (chords); thinner plates the section's own meshes alone are for.
SHAPES = [(0.0, 0.04), (2.5, 0.04), (10.0, 0.04), (-5.0, 0.1)]
THIN = [(2.5, 0.01)]


@pytest.mark.parametrize(
    ("preset", "incidence_deg", "thickness"),
    [
        (preset, *shape)
        for preset in sorted(PRESETS)
        if not preset.endswith("-span")  # in the plane another one
        for shape in (SHAPES if preset.startswith("plate-") else SHAPES + THIN)
    ],
)
def test_meshes_are_sound_over_incidence_and_thickness(
    installation: Installation, tmp_path: Path, preset: str, incidence_deg: float, thickness: float
) -> None:
    """``make_mesh`` refuses what ``checkMesh`` finds fault with."""
    wanted = mesh(preset, incidence_deg, thickness)
    found = quality(made(installation, wanted, tmp_path) / "log.checkMesh")
    assert found["max_non_orthogonality_deg"] < 70.0
    assert found["max_skewness"] < 1.0


def test_cells_fill_the_channel_but_for_the_plate(
    installation: Installation, tmp_path: Path
) -> None:
    wanted = mesh("coarse", 5.0)
    points, corners = read_cells(made(installation, wanted, tmp_path))
    assert corners.shape == (wanted.cells, 4)
    areas = cell_areas(points, corners)
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(4.0 * 20.0 - 0.04)
    # Euler: corners - edges + cells = 0 for a plane region with one hole
    assert len(points) - len(edges(corners)) + len(corners) == 0


def test_finest_has_the_papers_sizes(installation: Installation, tmp_path: Path) -> None:
    """Along the plate, off it, in the near field above mid-chord, behind it, and far from it."""
    points, corners = read_cells(made(installation, mesh("finest", 0.0), tmp_path))
    lines = points[edges(corners)]
    middle, length = lines.mean(axis=1), np.abs(np.diff(lines, axis=1))[:, 0]
    level = length[:, 1] < 1e-6 * length[:, 0]
    upright = length[:, 0] < 1e-6 * length[:, 1]

    on_plate = level & np.isclose(middle[:, 1], 0.02) & (np.abs(middle[:, 0]) < 0.45)
    assert length[on_plate, 0] == pytest.approx(WALL, rel=0.05)
    above = upright & (np.abs(middle[:, 0]) < 0.45) & (middle[:, 1] > 0.02)
    assert length[above, 1].min() == pytest.approx(OFF_WALL, rel=0.01)
    near = above & (middle[:, 1] > 0.2) & (middle[:, 1] < 0.7)
    assert length[near, 1] == pytest.approx(NEAR_FIELD, rel=0.05)
    behind = level & (middle[:, 0] > 1.6) & (middle[:, 0] < 2.1)
    assert length[behind, 0] == pytest.approx(WAKE, rel=0.15)
    at_inlet = np.isclose(middle[:, 0], -5.0)
    assert np.mean(length[at_inlet, 1] < 0.02) > 0.7
    at_walls = np.isclose(np.abs(middle[:, 1]), 2.0) & (np.abs(middle[:, 0]) > 4.0)
    assert length[at_walls, 0].max() == pytest.approx(DOMAIN, rel=0.05)
    assert length.max() == pytest.approx(DOMAIN, rel=0.15)


def test_five_layers_are_the_papers(installation: Installation, tmp_path: Path) -> None:
    """Five on each side of the plate, 0.075 c in all, and one size along the walls to the edges."""
    points, _ = read_cells(made(installation, mesh("five-layers", 0.0), tmp_path))
    off = np.unique(points[np.isclose(points[:, 0], 0.0) & (points[:, 1] > 0.01), 1]) - 0.02
    assert off[:2] == pytest.approx([0.0, FIRST_LAYER], abs=1e-6)
    assert off[LAYERS] == pytest.approx(LAYERS_THICK, abs=1e-6)
    assert np.diff(off)[LAYERS : LAYERS + 20] == pytest.approx(NEAR_FIELD, rel=0.05)
    ahead = -0.5 - np.unique(points[np.isclose(points[:, 1], 0.02), 0])
    assert np.isclose(ahead, LAYERS_THICK, atol=1e-6).sum() == 1
    on_top = np.unique(points[np.isclose(points[:, 1], 0.02), 0].round(9))
    on_top = on_top[np.abs(on_top) <= 0.5 + 1e-9]
    assert np.diff(on_top) == pytest.approx(WALL, rel=1e-6)


def test_courant_number_is_that_of_the_stream_far_ahead(
    installation: Installation, tmp_path: Path
) -> None:
    """Co = dt/2 sum |phi|/A, with the flux |dy| through each side at the inlet, where u = 1."""
    found = section_mesh(installation, STEADY, mesh_of(STEADY, 0.6), 0.02, tmp_path)
    assert found.flow.startswith("rigid, steady, converged")
    cells = found.points[found.corners]
    fluxes = np.abs(cells[:, :, 1] - np.roll(cells[:, :, 1], -1, axis=1)).sum(axis=1)
    expected = 0.02 / 2 * fluxes / cell_areas(found.points, found.corners)
    inlet = np.isclose(cells[:, :, 0].min(axis=1), -5.0)
    assert inlet.sum() > 40
    assert found.courant[inlet] == pytest.approx(expected[inlet], rel=0.1)
