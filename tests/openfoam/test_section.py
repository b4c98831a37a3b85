"""The real solver on coarse meshes: symmetry, known loads, free vibration, resumption.

What is compared with numbers was measured with OpenFOAM v1912.
"""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import minimize_scalar
from tests.free_vibration import exact_poles, fitted_poles
from tests.sample_cases import STEADY, UNSTEADY
from tests.watching import interrupt_after, nothing

from equisection.beam.section import Section
from equisection.cases import UnsteadyCase
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.reading.histories import read_history
from equisection.solvers.openfoam.rigid_flow import RigidFlowRecord
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.overset_section import OversetRun
from equisection.solvers.openfoam.section.rigid_section import (
    RigidLoads,
    mesh_of,
    rigid_loads,
    run_steady,
    unsteady_mean,
)
from equisection.solvers.openfoam.section.section_history import SectionHistory

#: Coarser than any preset, some 2,000 cells: for what does not depend on the mesh.
VERY_COARSE = 0.4


def rigid(
    installation: Installation, work: Path, incidence_deg: float, refinement: float
) -> RigidLoads:
    case = STEADY.model_copy(update={"incidence_deg": incidence_deg})
    mesh = mesh_of(case, refinement)
    return rigid_loads(installation, case, mesh, work, nothing, coupling=Coupling())


def free(duration: float, mass: float = 1.0) -> UnsteadyCase:
    """Return a case at k* = 10 with the paper's ratios, all of the structure scaled."""
    section = Section(
        torsional_stiffness=10.0 * mass,
        flexural_stiffness=1.83 * mass,
        inertia=8.8 * mass,
        mass=80.0 * mass,
        twist_recovery=1.0,
        deflection_recovery=1.0,
    )
    return UNSTEADY.model_copy(
        update={
            "section": section,
            "duration": duration,
            "time_step": 0.02,
            "output_interval": 0.02,
        }
    )


def run_of(installation: Installation, case: UnsteadyCase, work: Path) -> SectionRun:
    return SectionRun(installation, case, mesh_of(case, VERY_COARSE), Coupling(), work)


def test_no_lift_and_no_moment_at_zero_incidence(
    installation: Installation, tmp_path: Path
) -> None:
    loads = rigid(installation, tmp_path, 0.0, 1.0)
    assert loads.method.startswith("steady")
    assert abs(loads.lift) < 1e-3
    assert abs(loads.moment) < 5e-4
    assert loads.drag > 0.03


def test_loads_at_the_papers_incidence(installation: Installation, tmp_path: Path) -> None:
    """On 11,136 cells c_l 0.380, c_m 0.0756, c_d 0.0575; on 56,980 cells 0.365, 0.0782, 0.0568."""
    loads = rigid(installation, tmp_path, 2.5, 1.0)
    assert loads.method.startswith("steady")
    assert loads.lift == pytest.approx(0.380, rel=0.01)
    assert loads.moment == pytest.approx(0.0756, rel=0.01)
    assert loads.drag == pytest.approx(0.0575, rel=0.01)


@pytest.mark.parametrize("incidence_deg", [2.5, -2.5])
def test_pressure_and_friction_add_up_to_the_loads(
    installation: Installation, tmp_path: Path, incidence_deg: float
) -> None:
    loads = rigid(installation, tmp_path, incidence_deg, VERY_COARSE)
    drag, lift, moment = loads.surface.loads(incidence_deg)
    assert drag == pytest.approx(loads.drag, rel=0.005)
    assert lift == pytest.approx(loads.lift, rel=0.005)
    assert moment == pytest.approx(loads.moment, rel=0.005)
    assert loads.surface.length.sum() == pytest.approx(2 * (1 + 0.04))


def test_mean_pressure_and_friction_add_up_to_the_mean_loads(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The start of an unsteady run, which drifts: means over the same time are needed."""
    record = RigidFlowRecord(0.5, 5.0, 5.0)
    monkeypatch.setattr("equisection.solvers.openfoam.section.rigid_section.RECORD", record)
    case = STEADY.model_copy(update={"incidence_deg": 10.0})
    mesh = mesh_of(case, VERY_COARSE)
    monkeypatch.setattr("equisection.solvers.openfoam.section.rigid_section.MOST", 200)
    source, _, converged = run_steady(installation, case, mesh, tmp_path, nothing)
    assert not converged
    loads = unsteady_mean(installation, source, mesh, tmp_path, nothing, coupling=Coupling())
    drag, lift, moment = loads.surface.loads(10.0)
    assert drag == pytest.approx(loads.drag, rel=0.005)
    assert lift == pytest.approx(loads.lift, rel=0.005)
    assert moment == pytest.approx(loads.moment, rel=0.01)


def test_heavy_section_swings_at_its_natural_frequency(
    installation: Installation, tmp_path: Path
) -> None:
    """Ten thousand times the mass: the air drives, but does not change what the springs do.

    From rest under a moment c_m the twist is the integral of c_m(r) sin(omega (s - r)) over r, by
    I* omega. Fitted are omega, the size, and a shift in time (the loads are those of the last
    iteration but one).
    """
    natural = math.sqrt(10.0 / 8.8)
    period, mass = 2 * math.pi / natural, 1e4
    run = run_of(installation, free(round(1.25 * period, 1), mass=mass), tmp_path)
    run.run(nothing)
    history = run.history()

    def responses(omega: float) -> np.ndarray:
        """Return response and rate under the recorded moment."""
        phase = np.exp(1j * omega * history.time)
        response = phase * np.cumsum(history.moment / phase) * run.case.time_step
        return np.stack([response.imag / omega, response.real], axis=1) / (8.8 * mass)

    def misfit(ratio: float) -> float:
        return float(np.linalg.lstsq(responses(ratio * natural), history.twist, rcond=None)[1][0])

    found = minimize_scalar(misfit, bounds=(0.98, 1.02), method="bounded", options={"xatol": 1e-7})
    assert found.x == pytest.approx(1.0, abs=5e-4)
    size, shift = np.linalg.lstsq(responses(natural), history.twist, rcond=None)[0]
    assert size == pytest.approx(1.0, abs=1e-3)
    assert abs(shift) < run.case.time_step


def offset(stiffness: float, mass: float = 1.0) -> Section:
    """Return a section with dampers, its axis at a third of the chord and its mass behind it.

    S^2 = 0.16 m I; 3 and 5 % of critical damping of heave and pitch alone.
    """
    one, two = 400.0 * stiffness * mass, 90.0 * stiffness * mass
    return Section(
        torsional_stiffness=two,
        flexural_stiffness=one,
        inertia=8.8 * mass,
        mass=80.0 * mass,
        static_imbalance=0.4 * math.sqrt(80.0 * 8.8) * mass,
        flexural_damping=2 * 0.03 * math.sqrt(one * 80.0 * mass),
        torsional_damping=2 * 0.05 * math.sqrt(two * 8.8 * mass),
        elastic_axis=0.33,
    )


def moving(section: Section, duration: float) -> UnsteadyCase:
    return free(duration).model_copy(update={"section": section})


def test_heavy_section_with_offset_and_dampers_has_its_coupled_modes(
    installation: Installation, tmp_path: Path
) -> None:
    """Both frequencies and decay rates are those of M, C and K, which are not used in the fit.

    A hundred times the mass, 130,000 times that of the air. A heavier one twists by so little that
    OpenFOAM's spring, which takes the angle from its cosine, does not see it.
    """
    section = offset(stiffness=1.0, mass=100.0)
    run = run_of(installation, moving(section, 8.0), tmp_path)
    run.run(nothing)
    history = run.history()
    exact = exact_poles(section.mass_matrix, section.damping_matrix, section.stiffness_matrix)
    assert np.abs(exact.imag / np.sqrt([400 / 80, 90 / 8.8]) - 1).min() > 0.05  # coupled
    found = fitted_poles(
        history.time,
        np.stack([history.deflection, history.twist], axis=1),
        np.stack([history.lift, history.axis_moment], axis=1),
        exact,
    )
    np.testing.assert_allclose(found.imag, exact.imag, rtol=0.002)
    np.testing.assert_allclose(found.real, exact.real, rtol=0.01)


@pytest.fixture(scope="module")
def offset_run(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> SectionRun:
    """A run of 5 c/V of a light section with offset and dampers."""
    case = moving(offset(stiffness=0.1), 5.0)
    run = run_of(installation, case, tmp_path_factory.mktemp("offset"))
    run.run(nothing)
    return run


def test_section_with_offset_and_dampers_obeys_its_equations(offset_run: SectionRun) -> None:
    """M q'' + C q' + K q = loads about the axis, by the trapezoidal rule from rest."""
    assert offset_run.case.section is not None
    assert_obeys(offset_run.case.section, offset_run.history(), offset_run.case.time_step)


def assert_obeys(section: Section, history: SectionHistory, step: float) -> None:
    motion = np.stack([history.deflection, history.twist])
    rates = np.gradient(motion, step, axis=1, edge_order=2)
    loads = np.stack([history.lift, history.axis_moment])
    resisted = section.damping_matrix @ rates + section.stiffness_matrix @ motion
    accelerations = np.linalg.solve(section.mass_matrix, loads - resisted)
    expected = accelerations  # before the release there is none
    for _ in range(2):
        expected = cumulative_trapezoid(np.insert(expected, 0, 0.0, axis=1), dx=step)
    size = np.abs(motion).max(axis=1)
    assert (np.abs(expected - motion).max(axis=1) < 0.005 * size).all()


def test_work_of_the_air_on_a_damped_section_is_what_it_gains_and_what_its_dampers_take(
    offset_run: SectionRun,
) -> None:
    assert offset_run.case.section is not None
    section, history = offset_run.case.section, offset_run.history()
    step, late = offset_run.case.time_step, history.time > 1.0
    motion = np.stack([history.deflection, history.twist])
    rates = np.gradient(motion, step, axis=1, edge_order=2)
    loads = np.stack([history.lift, history.axis_moment])

    def form(matrix: np.ndarray, columns: np.ndarray) -> np.ndarray:
        return np.asarray((columns * (matrix @ columns)).sum(axis=0)[late])

    def integral(power: np.ndarray) -> float:
        return float((power[1:] + power[:-1]).sum() / 2) * step

    total = (form(section.mass_matrix, rates) + form(section.stiffness_matrix, motion)) / 2
    work, lost = (
        integral((loads * rates).sum(axis=0)[late]),
        integral(form(section.damping_matrix, rates)),
    )
    assert lost > 0.05 * abs(work)
    assert total[-1] - total[0] == pytest.approx(work - lost, abs=0.02 * max(abs(work), lost))


def test_section_with_offset_that_was_killed_goes_on_without_a_jump(
    installation: Installation, offset_run: SectionRun, tmp_path: Path
) -> None:
    """Its centre of mass is off mid-chord, in the state that is read again as in the mesh."""
    interrupted = run_of(installation, offset_run.case, tmp_path)
    shutil.copytree(offset_run.work, tmp_path, dirs_exist_ok=True)
    for path in [*interrupted.folder.glob("[1-9]*"), interrupted.folder / "postProcessing"]:
        shutil.rmtree(path)
    with pytest.raises(KeyboardInterrupt):
        interrupted.run(interrupt_after(3.3))
    interrupted.run(nothing)
    one, other = offset_run.history(), interrupted.history()
    np.testing.assert_allclose(one.time, other.time, atol=1e-9)
    for name in ("twist", "deflection"):
        expected = getattr(one, name)
        size = np.abs(expected).max()
        np.testing.assert_allclose(getattr(other, name), expected, atol=2e-4 * size)


def test_overset_section_with_offset_and_dampers_obeys_its_equations(
    installation: Installation, tmp_path: Path
) -> None:
    case = moving(offset(stiffness=0.1), 2.0)
    run = OversetRun(installation, case, mesh_of(case, VERY_COARSE), Coupling(), tmp_path)
    run.run(nothing)
    assert_obeys(offset(stiffness=0.1), run.history(), case.time_step)


@pytest.fixture(scope="module")
def whole(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> SectionRun:
    """A run of 5 c/V without interruption."""
    run = run_of(installation, free(5.0), tmp_path_factory.mktemp("whole"))
    run.run(nothing)
    return run


def test_run_that_was_killed_goes_on_without_a_jump(
    installation: Installation, whole: SectionRun, tmp_path: Path
) -> None:
    """From the same steady flow; a kill after 3.3 c/V goes back to the state at 2 c/V."""
    interrupted = run_of(installation, whole.case, tmp_path)
    shutil.copytree(whole.work, tmp_path, dirs_exist_ok=True)
    for path in [*interrupted.folder.glob("[1-9]*"), interrupted.folder / "postProcessing"]:
        shutil.rmtree(path)

    with pytest.raises(KeyboardInterrupt):
        interrupted.run(interrupt_after(3.3))
    assert not (interrupted.folder / "4").exists()
    interrupted.run(nothing)

    assert len(list((interrupted.folder / "postProcessing" / "loads").iterdir())) == 2
    one, other = whole.history(), interrupted.history()
    np.testing.assert_allclose(one.time, other.time, atol=1e-9)
    assert other.twist == pytest.approx(one.twist, abs=2e-4 * np.abs(one.twist).max())
    assert other.lift[5:] == pytest.approx(one.lift[5:], abs=2e-3 * np.abs(one.lift).max())
    assert other.moment[5:] == pytest.approx(one.moment[5:], abs=2e-3 * np.abs(one.moment).max())


def test_section_obeys_its_equation_of_motion(whole: SectionRun) -> None:
    """I* theta'' + k* theta = c_m and m* w'' + k_w* w = c_l, integrated twice from rest."""
    assert whole.case.section is not None
    section, history = whole.case.section, whole.history()
    for motion, inertia, stiffness, load in (
        (history.twist, section.inertia, section.torsional_stiffness, history.moment),
        (history.deflection, section.mass, section.flexural_stiffness, history.lift),
    ):
        acceleration = (load - stiffness * motion) / inertia
        step = whole.case.time_step
        expected = np.cumsum(np.cumsum(acceleration)) * step**2
        assert expected == pytest.approx(motion, abs=0.02 * np.abs(motion).max())


def test_work_of_the_air_is_the_change_of_energy(whole: SectionRun) -> None:
    """From the first c/V on, of the release's own transient, to the end."""
    assert whole.case.section is not None
    section, history = whole.case.section, whole.history()
    step, late = whole.case.time_step, history.time > 1.0
    energy = work = 0.0
    for motion, inertia, stiffness, load in (
        (history.twist, section.inertia, section.torsional_stiffness, history.moment),
        (history.deflection, section.mass, section.flexural_stiffness, history.lift),
    ):
        rate = np.gradient(motion, step, edge_order=2)
        total = (inertia * rate**2 + stiffness * motion**2)[late] / 2
        energy += total[-1] - total[0]
        power = (load * rate)[late]
        work += float((power[1:] + power[:-1]).sum() / 2) * step
    assert work > 0.0
    assert energy == pytest.approx(work, rel=0.02)


def test_output_of_the_motion_has_the_expected_columns(whole: SectionRun) -> None:
    motion = read_history(
        whole.folder / "postProcessing" / "motion", "sixDoFRigidBodyState.dat", ["omega"]
    )
    assert motion["omega"].shape == (250, 3)
    assert np.abs(motion["omega"][:, :2]).max() == 0.0
