"""Outlines on the real mesher and solver: sound meshes, symmetry, known loads, and a verdict."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import GEOMETRY, STEADY, UNSTEADY
from tests.sample_outlines import EXAMPLES, SHAPES
from tests.watching import nothing

from equisection.beam.outline import Outline
from equisection.beam.section import Section
from equisection.cases import SteadyCase
from equisection.results.plane_mesh import cell_areas, edges
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.mesh_quality import MorphingMesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.reading.loads import read_loads
from equisection.solvers.openfoam.reading.meshed_section import quality, read_cells
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.overset_section import OversetRun
from equisection.solvers.openfoam.section.rigid_section import (
    RigidLoads,
    check_mesh,
    outline_mesh_of,
    rigid_loads,
)

#: Some 4,000 cells: for what does not depend on the mesh.
VERY_COARSE = 0.6


def case_of(outline: Outline, incidence_deg: float) -> SteadyCase:
    geometry = GEOMETRY.model_copy(update={"outline": outline.as_pairs()})
    return STEADY.model_copy(update={"incidence_deg": incidence_deg, "geometry": geometry})


def made(installation: Installation, mesh: OutlineMesh, folder: Path) -> Path:
    """Return the folder with a mesh that ``checkMesh`` finds sound."""
    mesh.write(folder)
    entries = control("simpleFoam", 1, 1, 1)
    write_system(folder, entries, flow.schemes(steady=True), flow.steady_solution())
    check_mesh(installation, folder)
    return folder


@pytest.mark.parametrize("name", SHAPES)
def test_meshes_are_sound(installation: Installation, tmp_path: Path, name: str) -> None:
    case = case_of(SHAPES[name], 5.0)
    if name == "naca 4412":  # thinner cells at the wall, those of a Reynolds number of 1e7
        case = case.model_copy(update={"medium": case.medium.model_copy(update={"speed": 1600.0})})
    mesh = outline_mesh_of(case, 1.0)
    folder = made(installation, mesh, tmp_path)
    found = quality(folder / "log.checkMesh")
    assert found["max_non_orthogonality_deg"] < 80.0
    points, corners = read_cells(folder)
    areas = cell_areas(points, corners)
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(4.0 * 20.0 - SHAPES[name].area, rel=1e-4)
    # Euler: corners - edges + cells = 0 for a plane region with one hole; an edge has two ends
    lines = edges(corners)
    real = int((lines[:, 0] != lines[:, 1]).sum())
    assert len(points) - real + len(corners) == 0


def test_disc_is_the_same_at_every_incidence(tmp_path: Path) -> None:
    """Cells at the section, turned back, are one and the same."""
    corners = []
    for angle in (0.0, 8.0):
        mesh = outline_mesh_of(case_of(SHAPES["naca 0012"], angle), VERY_COARSE)
        folder = tmp_path / f"{angle:g}"
        mesh.write(folder)
        points, _ = read_cells(folder)
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        own = points @ np.array([[cosine, sine], [-sine, cosine]])
        inside = own[np.hypot(*own.T) < 0.99]
        corners.append(inside[np.lexsort(inside.T.round(9))])
    assert corners[0].shape == corners[1].shape
    assert np.abs(corners[0] - corners[1]).max() < 1e-9


@pytest.mark.parametrize("name", EXAMPLES)
def test_meshes_are_sound_where_the_section_has_moved(
    installation: Installation, tmp_path: Path, name: str
) -> None:
    """At 10 deg and half a chord up, by OpenFOAM's own motion of the mesh."""
    folder = made(installation, outline_mesh_of(case_of(SHAPES[name], 0.0), 1.0), tmp_path / "rest")
    moving = MorphingMesh(installation, folder, 4.0)
    found = moving.along(math.radians(10.0), 0.5, 1, tmp_path / "moved")[-1]
    assert found.faults == ""
    assert found.non_orthogonality_deg < 85.0


def rigid(
    installation: Installation, work: Path, name: str, incidence_deg: float, refinement: float
) -> RigidLoads:
    case = case_of(SHAPES[name], incidence_deg)
    mesh = outline_mesh_of(case, refinement)
    return rigid_loads(installation, case, mesh, work, nothing, coupling=Coupling())


@pytest.mark.parametrize("incidence_deg", [3.0, -3.0])
def test_pressure_and_friction_along_the_contour_add_up_to_the_loads(
    installation: Installation, tmp_path: Path, incidence_deg: float
) -> None:
    loads = rigid(installation, tmp_path, "naca 0012", incidence_deg, VERY_COARSE)
    drag, lift, moment = loads.surface.loads(incidence_deg)
    assert drag == pytest.approx(loads.drag, rel=0.005)
    assert lift == pytest.approx(loads.lift, rel=0.005)
    assert moment == pytest.approx(loads.moment, rel=0.005)
    assert loads.surface.length.sum() == pytest.approx(SHAPES["naca 0012"].perimeter, rel=1e-3)
    # the stagnation point is on the pressure side, with c_p of 1 and a little of the channel's loss
    stagnation = int(np.argmax(loads.surface.pressure))
    assert loads.surface.side[stagnation] == ("lower" if incidence_deg > 0 else "upper")
    assert loads.surface.pressure[stagnation] == pytest.approx(1.0, abs=0.1)


def test_airfoil_on_overset_has_the_loads_of_the_one_mesh_and_obeys_its_equation(
    installation: Installation, tmp_path: Path
) -> None:
    """On the one mesh of as fine cells c_l 0.3117, c_m 0.0819, c_d 0.0167 (v1912)."""
    shape = SHAPES["naca 0012"]
    section = Section(
        torsional_stiffness=0.3,
        flexural_stiffness=0.1,
        inertia=2.0,
        mass=8.0,
        twist_recovery=1.0,
        deflection_recovery=1.0,
    )
    step = 0.04
    given = {
        "incidence_deg": 3.0,
        "geometry": case_of(shape, 3.0).geometry,
        "section": section,
        "duration": 0.4,
        "time_step": step,
        "output_interval": step,
    }
    case = UNSTEADY.model_copy(update=given)
    mesh = outline_mesh_of(case, VERY_COARSE)
    run = OversetRun(installation, case, mesh, Coupling(), tmp_path)
    run.run(nothing)
    drag, lift, moment = read_loads(tmp_path / "steady").last(50).means()
    assert lift == pytest.approx(0.3117, rel=0.02)
    assert moment == pytest.approx(0.0819, rel=0.02)
    assert drag == pytest.approx(0.0167, rel=0.03)
    history = run.history()
    for motion, inertia, stiffness, load in (
        (history.twist, section.inertia, section.torsional_stiffness, history.moment),
        (history.deflection, section.mass, section.flexural_stiffness, history.lift),
    ):
        # Newmark's rule (gamma 1/2, beta 1/4), let go without an acceleration
        acceleration = np.concatenate([[0.0], (load - stiffness * motion) / inertia])
        mean = (acceleration[1:] + acceleration[:-1]) / 2
        rate = np.concatenate([[0.0], np.cumsum(mean)[:-1] * step])
        expected = np.cumsum(step * rate + step**2 / 2 * mean)
        assert expected == pytest.approx(motion, abs=1e-3 * motion.max())


def test_symmetric_airfoil_has_no_lift_at_zero(installation: Installation, tmp_path: Path) -> None:
    loads = rigid(installation, tmp_path, "naca 0012", 0.0, VERY_COARSE)
    assert loads.method.startswith("steady")
    assert abs(loads.lift) < 2e-3
    assert abs(loads.moment) < 5e-4


def test_airfoil_from_digits_to_verdict(installation: Installation, tmp_path: Path) -> None:
    """A soft section diverges: its spring is weaker than dc_m/dalpha = 2 pi/4 about mid-chord."""
    section = Section(
        torsional_stiffness=0.4,
        flexural_stiffness=1.0,
        inertia=2.0,
        mass=20.0,
        twist_recovery=1.0,
        deflection_recovery=1.0,
    )
    geometry = GEOMETRY.model_copy(update={"outline": SHAPES["naca 0012"].as_pairs()})
    case = UNSTEADY.model_copy(
        update={
            "incidence_deg": 2.0,
            "geometry": geometry,
            "section": section,
            "k_star": 0.4,
            "duration": 30.0,
            "time_step": 0.04,
            "output_interval": 0.04,
        }
    )
    mesh = outline_mesh_of(case, 0.5)
    result = SectionRun(installation, case, mesh, Coupling(), tmp_path).run(nothing)
    assert result.verdict["regime"] == "growing"
    assert result.incidence[-1] > math.radians(8.0)
