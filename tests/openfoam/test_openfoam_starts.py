"""Starts from a twist and with a heave rate: free vibration, resumption, the embedded solver.

The structures whose free vibration is exact are so heavy that the air hardly moves them.
"""

import math
from pathlib import Path

import numpy as np
import pytest
from foamlib import FoamFile
from scipy.linalg import expm
from tests.openfoam.test_plate import COUPLING, matrices_of
from tests.openfoam.test_plate import offset as offset_modes
from tests.openfoam.test_section import VERY_COARSE, free, moving, offset
from tests.sample_cases import UNSTEADY_PLATE
from tests.watching import interrupt_after, nothing

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.cases import Start
from equisection.motion.sections import release_sections
from equisection.solvers.openfoam.beam import coupled_run, rigid_beam
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.rigid_beam import plate_mesh_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.overset_section import OversetRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of

POLAR = Path(__file__).parents[2] / "config" / "polars" / "plate_2d_11136.csv"


def free_vibration(
    mass: np.ndarray,
    damping: np.ndarray,
    stiffness: np.ndarray,
    start: np.ndarray,
    time: np.ndarray,
) -> np.ndarray:
    """Return q of M q'' + C q' + K q = 0 from a start (q, q'), shape (times, coordinates)."""
    count = len(mass)
    inverse = np.linalg.inv(mass)
    rates = np.block(
        [[np.zeros((count, count)), np.eye(count)], [-inverse @ stiffness, -inverse @ damping]]
    )
    return np.array([(expm(rates * instant) @ start)[:count] for instant in time])


@pytest.mark.parametrize(
    ("kind", "twist_deg", "duration"), [(SectionRun, 1.0, 2.6), (OversetRun, -1.0, 0.6)]
)
def test_heavy_section_vibrates_from_its_start(
    installation: Installation,
    tmp_path: Path,
    kind: type[SectionRun],
    twist_deg: float,
    duration: float,
) -> None:
    """Offset axes and dampers; the longer run is killed after the state at 2 c/V, and goes on."""
    section = offset(stiffness=1.0, mass=100.0)
    start = Start(twist_deg=twist_deg, heave_rate=0.01)
    case = moving(section, duration).model_copy(update={"incidence_deg": 0.0, "start": start})
    run = kind(installation, case, mesh_of(case, VERY_COARSE), Coupling(), tmp_path)
    if duration > 2.2:
        with pytest.raises(KeyboardInterrupt):
            run.run(interrupt_after(2.2))
    result = run.run(nothing)
    assert (result.time[0], result.deflection[0]) == (0.0, 0.0)
    assert np.degrees(result.twist[0]) == pytest.approx(twist_deg)
    exact = free_vibration(
        section.mass_matrix,
        section.damping_matrix,
        section.stiffness_matrix,
        np.array([0.0, math.radians(twist_deg), 0.01, 0.0]),
        result.time,
    )
    for motion, expected in zip((result.deflection, result.twist), exact.T, strict=True):
        np.testing.assert_allclose(motion, expected, atol=0.003 * np.abs(expected).max())


@pytest.mark.parametrize("kind", [SectionRun, OversetRun])
def test_heavy_section_vibrates_from_a_deflected_place(
    installation: Installation, tmp_path: Path, kind: type[SectionRun]
) -> None:
    """From a twist and a deflection that are said to be its equilibrium, and a push beyond.

    The channel keeps its height about the undeformed section, so the mesh is off its middle. The
    flow around so heavy a body carries nothing of the springs' load, which the solver takes for
    carried at the release: the first step has half of it, as if the body came with a rate.
    """
    section = offset(stiffness=1.0, mass=100.0)
    start = Start(state="equilibrium", twist_deg=0.5, equilibrium=(math.radians(1.0), 0.2))
    case = moving(section, 0.6).model_copy(update={"incidence_deg": 0.0, "start": start})
    mesh = mesh_of(case, VERY_COARSE)
    turned = section.axis_behind_mid_chord * math.sin(math.radians(1.5))
    assert mesh.channel.section_height == pytest.approx(0.2 + turned)
    assert mesh.channel.ceiling - mesh.channel.floor == pytest.approx(mesh.channel.height)
    result = kind(installation, case, mesh, Coupling(), tmp_path).run(nothing)
    carried = np.array([0.2, math.radians(1.0)])
    lost = np.linalg.solve(section.mass_matrix, section.stiffness_matrix @ carried)
    exact = free_vibration(
        section.mass_matrix,
        section.damping_matrix,
        section.stiffness_matrix,
        np.array([0.2, math.radians(1.5), *(0.5 * case.time_step * lost)]),
        result.time,
    )
    for motion, expected in zip((result.deflection, result.twist), exact.T, strict=True):
        np.testing.assert_allclose(motion, expected, atol=0.003 * np.abs(expected).max())


def test_release_at_zero_incidence_is_that_of_the_embedded_solver(
    installation: Installation, tmp_path: Path
) -> None:
    """Over two thirds of the first period; the moment at the release is the polar's at a degree."""
    case = free(4.0).model_copy(update={"incidence_deg": 0.0, "start": Start(twist_deg=1.0)})
    run = SectionRun(installation, case, mesh_of(case, 0.6), Coupling(), tmp_path)
    result = run.run(nothing)
    polar = Polar.read(POLAR)
    assert case.section is not None
    assert result.moment[0] == pytest.approx(polar.moment[polar.incidence > 0][0], rel=0.1)
    embedded = release_sections(
        [case.section],
        UnsteadyLoads.from_polar(polar),
        0.0,
        case.duration,
        time_step=case.time_step,
        output_interval=case.output_interval,
        twist=math.radians(1.0),
    )
    expected = np.interp(result.time, embedded.time, embedded.twist[:, 0])
    np.testing.assert_allclose(result.twist, expected, atol=0.06 * math.radians(1.0))


def test_heavy_plate_vibrates_from_its_start(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On two ranks, killed after the state at 0.4 c/V: all four modes, in a sound mesh.

    From a position of all modes that is said to be its equilibrium, and a push beyond it. From the
    release on no point of the mesh moves by more than the plate does: the mesh that the plate is
    held in is the one that the run goes on from.
    """
    monkeypatch.setattr(coupled_run, "STATE_INTERVAL", 0.2)
    monkeypatch.setattr(rigid_beam, "MOST", 20)  # so heavy a plate does not feel the flow
    modes = offset_modes(100.0, 100.0)
    case = UNSTEADY_PLATE.model_copy(
        update={
            "beam": modes,
            "duration": 0.6,
            "output_interval": 0.02,
            "incidence_deg": 0.0,
            "start": Start(
                state="equilibrium",
                twist_deg=1.5,
                heave_rate=0.01,
                equilibrium=(*np.radians([0.5, 0.1]), 0.05, -0.01),
            ),
        }
    )
    run = PlateRun(installation, case, plate_mesh_of(case, 0.2), COUPLING, tmp_path, 2)
    with pytest.raises(KeyboardInterrupt):
        run.run(interrupt_after(0.5))
    assert_mesh_follows(run, "0.4")
    result = run.run(nothing)
    first = result.tip_twist[0], result.tip_deflection[0]
    assert first == pytest.approx(list(map(float, run.points.tip(run.first_position))))
    assert abs(first[1]) > 0.03
    history = run.history()
    np.testing.assert_allclose(np.diff(history.time), case.time_step)
    exact = free_vibration(*matrices_of(modes), np.concatenate(run.release), history.time)
    for motion, expected in zip(history.position.T, exact.T, strict=True):
        np.testing.assert_allclose(motion, expected, atol=0.005 * np.abs(expected).max())


def assert_mesh_follows(run: PlateRun, time: str) -> None:
    """Compare the mesh at a time with that of the release, and that with the mesh at rest."""
    held, moved, on_plate = [], [], []
    for part in parts(run.folder):
        mesh = read_poly_mesh(part)
        before, now = (_points_at(part, name) for name in ("0", time))
        held.append(np.linalg.norm(before - mesh.points, axis=1))
        moved.append(np.linalg.norm(now - before, axis=1))
        on_plate.append(moved[-1][np.unique(mesh.faces[mesh.patches["plate"]])])
    twist, up = (of(run.first_position) for of in (run.points.twist, run.points.deflection))
    ends = [  # of the chord, ahead of the axis and behind it
        np.hypot(behind * (np.cos(twist) - 1.0), up - behind * np.sin(twist))
        for behind in (-0.33, 0.67)
    ]
    assert np.concatenate(held).max() == pytest.approx(np.max(ends), rel=0.02)
    most = np.concatenate(on_plate).max()
    assert most > 0.001
    assert np.concatenate(moved).max() < 1.02 * most


def _points_at(part: Path, time: str) -> np.ndarray:
    return np.asarray(FoamFile(part / time / "polyMesh" / "points")[None], dtype=float)
