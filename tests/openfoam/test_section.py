"""The real solver on coarse meshes: symmetry, known loads, free vibration, resumption.

What is compared with numbers was measured with OpenFOAM v1912.
"""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from tests.sample_cases import STEADY, UNSTEADY
from tests.watching import interrupt_after, nothing

from equisection.beam.section import Section
from equisection.cases import UnsteadyCase
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.reading.histories import read_history
from equisection.solvers.openfoam.rigid_flow import RigidFlowRecord
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import (
    RigidLoads,
    mesh_of,
    rigid_loads,
    run_steady,
    unsteady_mean,
)
from equisection.solvers.openfoam.section.section_history import read_section

#: Coarser than any preset, about 4,000 cells: for what does not depend on the mesh.
VERY_COARSE = 0.6


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
    history = read_section(run.folder)

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
    one, other = read_section(whole.folder), read_section(interrupted.folder)
    np.testing.assert_allclose(one.time, other.time, atol=1e-9)
    assert other.twist == pytest.approx(one.twist, abs=2e-4 * np.abs(one.twist).max())
    assert other.lift[5:] == pytest.approx(one.lift[5:], abs=2e-3 * np.abs(one.lift).max())
    assert other.moment[5:] == pytest.approx(one.moment[5:], abs=2e-3 * np.abs(one.moment).max())


def test_section_obeys_its_equation_of_motion(whole: SectionRun) -> None:
    """I* theta'' + k* theta = c_m and m* w'' + k_w* w = c_l, integrated twice from rest."""
    assert whole.case.section is not None
    section, history = whole.case.section, read_section(whole.folder)
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
    section, history = whole.case.section, read_section(whole.folder)
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
