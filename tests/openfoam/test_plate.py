"""The real solver around the plate on very coarse meshes: loads, coupling, resumption, faults.

What is compared with numbers was measured with OpenFOAM v1912.
"""

import os
import pickle
import re
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.free_vibration import exact_poles, fitted_poles
from tests.processes import wait_until
from tests.sample_cases import STEADY_PLATE, UNSTEADY_PLATE, beam_modes
from tests.watching import nothing

from equisection.cases import BeamModes, UnsteadyCase
from equisection.errors import SolverError
from equisection.results.plane_mesh import cell_areas
from equisection.results.plate_surface import PlateSurface
from equisection.results.steady_result import SteadyResult
from equisection.results.tip_flow import TipFlow
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.openfoam.beam import coupled_run
from equisection.solvers.openfoam.beam import rigid_beam as plate_rigid
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.lumped_points import LumpedPoints
from equisection.solvers.openfoam.beam.rigid_beam import PlateFlow, plate_mesh_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.beam_mesh import PlateMesh
from equisection.solvers.openfoam.reading.beam_grid import plate_grid
from equisection.solvers.openfoam.reading.loads import read_loads
from equisection.solvers.openfoam.reading.sampled_tip_flow import sample_tip_flow
from equisection.solvers.openfoam.rigid_flow import RigidFlowRecord

#: Coarser than any preset, 15,128 cells.
VERY_COARSE = 0.3
COUPLING = Coupling(2, 0.98)


def rigid(
    installation: Installation, work: Path, incidence_deg: float = 2.5, ranks: int = 1
) -> PlateFlow:
    case = STEADY_PLATE.model_copy(update={"incidence_deg": incidence_deg})
    return PlateFlow(installation, case, plate_mesh_of(case, VERY_COARSE), COUPLING, ranks, work)


@pytest.fixture(scope="module")
def steady(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A rigid plate at 2.5 deg that has converged, with what is stored of it."""
    work = tmp_path_factory.mktemp("steady")
    flow = rigid(installation, work)
    result = flow.result(nothing)
    assert result.method.startswith("steady")
    sizes = np.diff(flow.mesh.edges()) / flow.mesh.span
    # the sections' loads add up to the whole, and fall off to the tip as lift does
    assert result.section_lift @ sizes == pytest.approx(result.lift, rel=1e-3)
    assert result.section_moment @ sizes == pytest.approx(result.moment, rel=1e-3)
    assert result.section_lift[0] > result.lift > result.section_lift[-1]
    surface = assert_surface_sums_up(result, flow.mesh)
    assert_bubble_is_shorter_at_the_tip(surface, flow.mesh.edges())
    assert_flow_turns_around_the_tip(result.tip_flow)
    return work


def assert_surface_sums_up(result: SteadyResult, mesh: PlateMesh) -> PlateSurface:
    """Pressure and friction of the faces give the coefficients again, on a plate that is closed."""
    surface = result.surface
    assert isinstance(surface, PlateSurface)
    incidence_deg = np.degrees(mesh.section.incidence)
    assert surface.loads(incidence_deg) == pytest.approx(
        (result.drag, result.lift, result.moment), rel=5e-3, abs=1e-4
    )
    areas = {str(side): surface.on(side).area.sum() for side in np.unique(surface.side)}
    sides, thickness = mesh.span, mesh.section.channel.thickness
    assert areas == pytest.approx(
        {
            "upper": sides,
            "lower": sides,
            "leading edge": sides * thickness,
            "trailing edge": sides * thickness,
            "tip": thickness,
        }
    )
    return surface


def assert_bubble_is_shorter_at_the_tip(surface: PlateSurface, edges: np.ndarray) -> None:
    z, bubble = surface.reattachment("upper")
    np.testing.assert_allclose(z, 0.5 * (edges[1:] + edges[:-1]), rtol=1e-7)
    assert bubble[0] > bubble[-1] > 0


def assert_flow_turns_around_the_tip(flow: TipFlow | None) -> None:
    """From the pressure side outwards, up beyond the tip, inwards above it; none in the plate."""
    assert flow is not None
    up, out = np.meshgrid(flow.y, flow.z, indexing="ij")
    inside = (np.abs(up) < 0.019) & (out < 3.699)
    assert (np.isnan(flow.turbulence[0]) == inside).all()
    assert np.isfinite(flow.turbulence[1:]).all()
    around = np.abs(out - 3.7) < 0.15
    velocity = flow.velocity[0]
    below, above = (around & (sign * up > 0.05) & (sign * up < 0.3) for sign in (-1, 1))
    beyond = (out > 3.75) & (np.abs(up) < 0.2)
    assert velocity[below, 2].mean() > 0.02
    assert velocity[above, 2].mean() < -0.02
    assert velocity[beyond, 1].mean() > 0.02
    # next to the stream's own turbulence, that of the bubble is large
    assert 0.005 < np.nanmax(flow.turbulence) < 0.1
    np.testing.assert_allclose(flow.chord_line[0, flow.z < 3.7], 0.0, atol=1e-12)
    assert np.isnan(flow.chord_line[1:]).all()


def test_plate_from_wall_to_wall_has_no_flow_near_a_tip(
    installation: Installation, tmp_path: Path
) -> None:
    mesh = replace(rigid(installation, tmp_path).mesh, gap=0.0)
    assert sample_tip_flow(installation, tmp_path, mesh, state="") is None


def test_grid_of_the_plate_is_the_mesh_that_was_made(
    installation: Installation, tmp_path: Path
) -> None:
    flow = rigid(installation, tmp_path)
    grid = plate_grid(flow)
    assert grid.cells == flow.mesh.cells
    np.testing.assert_allclose(grid.levels[: flow.mesh.edges().size], flow.mesh.edges())
    assert (grid.levels[-1], grid.levels.size) == (pytest.approx(4.0), flow.mesh.layers + 1)
    assert grid.corners.shape == (flow.mesh.section.cells, 4)
    areas = cell_areas(grid.points, grid.corners)
    assert areas.sum() == pytest.approx(4.0 * 20.0 - 0.04)


def test_no_lift_and_no_moment_at_zero_incidence_on_two_ranks(
    installation: Installation, tmp_path: Path
) -> None:
    flow = rigid(installation, tmp_path, 0.0, ranks=2)
    result = flow.result(nothing)
    assert result.method.startswith("steady")
    assert abs(result.lift) < 1e-3
    assert abs(result.moment) < 5e-4
    assert result.drag > 0.03
    # faces and points of both ranks, in one order: as much above as below
    surface = assert_surface_sums_up(result, flow.mesh)
    upper, lower = surface.on("upper"), surface.on("lower")
    np.testing.assert_allclose(upper.z, lower.z, atol=1e-9)
    np.testing.assert_allclose(upper.pressure, lower.pressure, atol=2e-3)
    assert result.tip_flow is not None
    velocity = result.tip_flow.velocity
    assert np.isnan(velocity[0]).any()
    mirrored = velocity[:, ::-1] * [1.0, -1.0, 1.0]
    # between cells OpenFOAM interpolates in tetrahedra, which are no mirror images
    assert np.nanmean(np.abs(velocity - mirrored)) < 1e-3 < np.nanmean(np.abs(velocity[..., 1:]))


def test_mean_of_an_unsteady_flow_has_loads_along_the_span(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Steady iterations that are too few, and a record that is short."""
    monkeypatch.setattr(plate_rigid, "MOST", 60)
    monkeypatch.setattr(plate_rigid, "RECORD", RigidFlowRecord(0.1, 0.4, 0.4))
    flow = rigid(installation, tmp_path)
    result = flow.result(nothing)
    assert result.method.startswith("mean of unsteady")
    sizes = np.diff(flow.mesh.edges()) / flow.mesh.span
    assert result.section_lift @ sizes == pytest.approx(result.lift, rel=0.01)
    assert result.section_moment @ sizes == pytest.approx(result.moment, rel=0.01)
    surface, tip_flow = result.surface, result.tip_flow
    assert isinstance(surface, PlateSurface)
    assert surface.loads(2.5)[1] == pytest.approx(result.lift, rel=0.02)
    assert tip_flow is not None
    assert tip_flow.state == f"2.5 deg, {result.method}"


def free(duration: float, k_star: float = 6.44, mass: float = 1.0) -> UnsteadyCase:
    """Return a case with all of the structure scaled by a mass."""
    modes = beam_modes(k_star / 19.91 * mass, mass)
    return UNSTEADY_PLATE.model_copy(
        update={"beam": modes, "duration": duration, "output_interval": 0.02}
    )


def run_of(installation: Installation, case: UnsteadyCase, work: Path, steady: Path) -> PlateRun:
    """Return a run that starts from the rigid steady flow, which is the same for all."""
    run = PlateRun(installation, case, plate_mesh_of(case, VERY_COARSE), COUPLING, work, 1)
    run.start_from(steady / "steady")
    return run


@pytest.fixture
def short_interval(monkeypatch: pytest.MonkeyPatch) -> None:
    """States are written often enough for a short run to be resumed."""
    monkeypatch.setattr(coupled_run, "STATE_INTERVAL", 0.2)


@pytest.fixture(scope="module")
def released(
    installation: Installation, steady: Path, tmp_path_factory: pytest.TempPathFactory
) -> tuple[PlateRun, UnsteadyResult]:
    """A run of 0.6 c/V without interruption."""
    run = run_of(installation, free(0.6), tmp_path_factory.mktemp("whole"), steady)
    return run, run.run(nothing)


@pytest.fixture(scope="module")
def whole(released: tuple[PlateRun, UnsteadyResult]) -> PlateRun:
    """The run alone."""
    return released[0]


def test_loads_handed_over_are_those_that_openfoam_sums_up(whole: PlateRun) -> None:
    """But for friction, which has little lift; c_m about the moving centre but little drag."""
    history, loads = whole.history(), read_loads(whole.folder)
    np.testing.assert_allclose(history.time[1:], loads.time[:-1], atol=1e-9)
    assert history.lift[1:] == pytest.approx(loads.lift[:-1], rel=2e-3)
    assert history.moment[1:] == pytest.approx(loads.moment[:-1], rel=5e-3)


def test_modes_obey_their_equations_of_motion(whole: PlateRun) -> None:
    """q'' + omega^2 q = p, by second differences of what goes linearly in a step, from rest."""
    history, step = whole.history(), whole.case.time_step
    acceleration = np.diff(history.position, 2, axis=0) / step**2
    expected = history.load - whole.points.frequency**2 * history.position
    expected = (expected[:-2] + 4 * expected[1:-1] + expected[2:]) / 6
    scale = np.abs(expected).max(axis=0)
    assert (np.abs(acceleration - expected) < 2e-3 * scale).all()
    np.testing.assert_array_equal(history.position[0], 0.0)


def test_result_holds_the_tip_and_its_modes(released: tuple[PlateRun, UnsteadyResult]) -> None:
    run, result = released
    tip = result.bending_amplitudes.T @ run.points.bending_at_tip
    np.testing.assert_allclose(result.tip_deflection, tip)
    np.testing.assert_allclose(result.incidence[0], np.radians(2.5))
    assert result.tip_twist[-1] > 0 < result.tip_deflection[-1]


@pytest.mark.usefixtures("short_interval")
def test_flow_near_the_tip_is_around_the_plate_where_it_has_moved_to(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    """A light plate, which the lift carries away: there is none of the flow where it then is."""
    run = run_of(installation, free(1.0, k_star=0.5, mass=0.05), tmp_path, steady)
    result = run.run(nothing)
    flow = result.tip_flow
    assert flow is not None
    assert flow.state.startswith("1 c/V after the release")
    there = flow.z < 3.7
    middle = flow.chord_line[0, there]
    assert middle[-1] > 0.005 < result.tip_deflection[-1]
    # the places of points beside the surface at rest and now differ by more than what is let pass
    distance = np.abs(flow.y[:, None] - middle)
    within = np.isnan(flow.turbulence[0][:, there])
    assert within[distance < 0.0185].all()
    assert not within[distance > 0.0215].any()


@pytest.mark.usefixtures("short_interval")
def test_run_that_was_killed_goes_on_without_a_jump(
    installation: Installation, whole: PlateRun, steady: Path, tmp_path: Path
) -> None:
    """A kill after 0.5 c/V goes back to the state at 0.4 c/V, of flow and structure."""
    interrupted = run_of(installation, whole.case, tmp_path, steady)

    def stop_at(done: float, total: float) -> None:
        del total
        if done >= 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted.run(stop_at)
    assert (interrupted.folder / "0.4").exists()
    interrupted.run(nothing)

    assert "Time = 0.42\n" in (interrupted.folder / "log.pimpleFoam").read_text()
    one, other = whole.history(), interrupted.history()
    np.testing.assert_allclose(one.time, other.time, atol=1e-9)
    for name in ("position", "velocity", "lift", "moment"):
        expected = getattr(one, name)
        size = np.abs(expected).max(axis=0)
        assert (np.abs(getattr(other, name) - expected) <= 5e-3 * size).all(), name


def test_heavy_plate_swings_at_its_natural_frequency(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    """A hundred times the mass: the air drives, but hardly changes what the structure does."""
    modes = beam_modes(150.0 / 19.91 * 100.0, 100.0)
    period = 2 * np.pi / modes.torsion_frequency[0]
    case = free(round(1.2 * period, 1), 150.0, 100.0)
    run = run_of(installation, case, tmp_path, steady)
    run.run(nothing)
    history = run.history()
    # from rest the first torsion mode is A (1 - cos(omega s)) under a constant load
    twist = history.position[:, 0]
    late = history.time > 0.2 * period
    rate = history.velocity[late, 0]
    before = np.flatnonzero(np.diff(np.sign(rate)) != 0)
    part = rate[before] / (rate[before] - rate[before + 1])
    turning = history.time[late][before] + part * case.time_step
    assert turning[:2] == pytest.approx([period / 2, period], rel=0.01)
    static = history.load[late, 0].mean() / modes.torsion_frequency[0] ** 2
    assert twist.max() == pytest.approx(2 * static, rel=0.05)


def offset(k_star: float, mass: float = 1.0) -> BeamModes:
    """Return modes with dampers, an axis at a third of the chord and mass behind it.

    S^2 = 0.16 m I; 2 and 3 % of critical damping of each bending and torsion mode.
    """
    modes = beam_modes(k_star / 19.91 * mass, mass)
    return modes.model_copy(
        update={
            "imbalance": 0.4 * np.sqrt(modes.mass * modes.inertia),
            "bending_damping": 0.02,
            "torsion_damping": 0.03,
            "elastic_axis": 0.33,
        }
    )


def matrices_of(modes: BeamModes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return M, C and K of the beam's modes, torsion first, over L, by sums along the span."""
    shapes = np.array([*modes.torsion_shape, *modes.bending_shape])
    per_length = np.full((4, 4), -modes.imbalance)
    per_length[:2, :2], per_length[2:, 2:] = modes.inertia, modes.mass
    products = shapes[:, None] * shapes[None, :]
    mass = per_length * np.trapezoid(products, np.array(modes.span), axis=-1)
    own = np.diag(mass)
    omega = np.array([*modes.torsion_frequency, *modes.bending_frequency])
    ratio = np.repeat([modes.torsion_damping, modes.bending_damping], 2)
    return mass, np.diag(2 * ratio * omega * own), np.diag(omega**2 * own)


def test_heavy_plate_with_offset_and_dampers_has_its_coupled_modes(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    """Two bending and two torsion modes; the second of bending is close to the first of torsion."""
    modes = offset(5000.0, 100.0)
    case = UNSTEADY_PLATE.model_copy(
        update={"beam": modes, "duration": 4.0, "output_interval": 0.02}
    )
    run = run_of(installation, case, tmp_path, steady)
    run.run(nothing)
    history, exact = run.history(), exact_poles(*matrices_of(modes))
    loads = np.stack([history.lift, history.axis_moment], axis=1)
    found = fitted_poles(history.time, history.position, loads, exact)
    np.testing.assert_allclose(found.imag, exact.imag, rtol=0.002)
    np.testing.assert_allclose(found.real, exact.real, rtol=0.01)


def test_plate_with_its_axis_off_mid_chord_turns_about_it(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    """Loads about the axis are those that OpenFOAM sums up about mid-chord at rest, taken there.

    And they do the work that structure and dampers have.
    """
    modes = offset(6.44)
    case = UNSTEADY_PLATE.model_copy(
        update={"beam": modes, "duration": 1.0, "output_interval": 0.02}
    )
    run = run_of(installation, case, tmp_path, steady)
    result = run.run(nothing)
    history, loads = run.history(), read_loads(run.folder)
    along, up = run.points.axes.elastic_axis
    about = loads.moment + along * loads.lift - up * loads.drag
    # but for the shift of the axis, which is that of a light deflection still
    assert history.axis_moment[1:] == pytest.approx(about[:-1], abs=2e-3 * history.lift.max())
    np.testing.assert_array_equal(result.axis_moment, history.axis_moment)
    mass, damping, stiffness = matrices_of(modes)
    inertia = np.diag(mass)
    applied = history.load * inertia

    def energy(row: int) -> float:
        rate, place = history.velocity[row], history.position[row]
        return float(rate @ mass @ rate + place @ stiffness @ place) / 2

    power = (applied * history.velocity).sum(axis=1)
    power -= ((history.velocity @ damping) * history.velocity).sum(axis=1)
    gained = float((power[1:] + power[:-1]).sum() / 2) * case.time_step
    assert energy(-1) - energy(0) == pytest.approx(gained, rel=0.01)


def test_solver_that_is_killed_is_told_with_its_signal(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    run = run_of(installation, free(2.0), tmp_path, steady)

    def kill(done: float, total: float) -> None:
        del total
        if done >= 0.06:
            os.kill(solver_of(run.folder), signal.SIGKILL)

    with pytest.raises(SolverError, match="pimpleFoam ended with signal 9"):
        run.run(kill)


STRUCTURE = """
import pickle, sys
from pathlib import Path
run = pickle.loads(Path(sys.argv[1]).read_bytes())
run.run(lambda done, total: print(done, flush=True))
"""


@pytest.mark.parametrize("ranks", [1, 2])
def test_solver_ends_with_the_structure_that_is_killed(
    installation: Installation, tmp_path: Path, ranks: int
) -> None:
    case = free(2.0)
    mesh = plate_mesh_of(case, 0.2)
    (tmp_path / "run").write_bytes(
        pickle.dumps(PlateRun(installation, case, mesh, COUPLING, tmp_path, ranks))
    )
    structure = subprocess.Popen(
        [sys.executable, "-c", STRUCTURE, str(tmp_path / "run")], stdout=subprocess.PIPE, text=True
    )
    assert structure.stdout is not None
    assert any(float(line) > 0.04 for line in structure.stdout)
    solver = solver_of(tmp_path / "free")
    assert Path(f"/proc/{solver}").exists()
    structure.kill()
    structure.wait()
    wait_until(lambda: not Path(f"/proc/{solver}").exists())


def test_plate_that_diverges_ends_before_it_meets_the_wall(
    installation: Installation, steady: Path, tmp_path: Path
) -> None:
    """A twentieth of the mass and hardly any stiffness: the lift carries it to the ceiling."""
    run = run_of(installation, free(20.0, k_star=0.5, mass=0.05), tmp_path, steady)
    result = run.run(nothing)
    assert result.verdict["regime"] in {"growing", "failed"}
    assert re.search(r"c/V the tip's twist was .* deg, its deflection", result.verdict["reason"])


class AnotherVersion(Installation):
    """Says that it is another version than it is."""

    said = "v2312"

    def version(self) -> str:
        return self.said


def test_later_version_is_tried_by_its_first_step(
    installation: Installation, steady: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The trial passes where both sides understand each other, and tells where they do not."""
    later = AnotherVersion(installation.prefix, installation.environment)
    (tmp_path / "steady").symlink_to(steady / "steady")
    run = run_of(later, free(0.04), tmp_path, steady)
    assert run.run(nothing).time[-1] == pytest.approx(0.02)
    assert not (tmp_path / "trial").exists()

    monkeypatch.setattr(LumpedPoints, "message", lambda points, position: upside_down(points))
    again = run_of(later, free(0.04), tmp_path, steady)
    with pytest.raises(
        SolverError, match=r"OpenFOAM v2312, .*: points of the mesh on the beam are up"
    ):
        again.run(nothing)


def upside_down(points: LumpedPoints) -> str:
    """Return a message that has the twist nose down."""
    angle = np.radians(0.1) * points.twist(points.release(1.0, 0.0)[0])
    rows = [f"0 0 {z} {a} 0 0" for z, a in zip(points.locations, angle, strict=True)]
    return "\n".join([str(len(rows)), *rows, ""])


def test_versions_of_which_nothing_is_known_are_refused(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(AnotherVersion, "said", "v2112")
    other = AnotherVersion(installation.prefix, installation.environment)
    run = PlateRun(other, free(1.0), plate_mesh_of(free(1.0), VERY_COARSE), COUPLING, tmp_path, 1)
    with pytest.raises(SolverError, match=r"OpenFOAM v2112: .* v1912 .* v2306 to v2606"):
        run.run(nothing)


def solver_of(folder: Path) -> int:
    """Return the process of the solver, as it says itself."""
    said = (folder / "log.pimpleFoam").read_text()
    return int(re.findall(r"^PID\s*: (\d+)", said, re.MULTILINE)[-1])
