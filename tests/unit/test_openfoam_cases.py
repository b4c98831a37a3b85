"""What is written into an OpenFOAM case, and what a kill may leave of one."""

import hashlib
import math
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sample_cases import GEOMETRY, MEDIUM, STEADY, UNSTEADY, UNSTEADY_PLATE
from tests.sample_outlines import SHAPES
from tests.watching import nothing

from equisection.beam.section import Section
from equisection.cases import Start
from equisection.config import Config, load_config
from equisection.errors import ConfigError, SolverError
from equisection.figures.catalogue import figures
from equisection.solvers.openfoam import adapter
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.case_folder import (
    copy_flow,
    drop_broken_states,
    drop_histories_after,
)
from equisection.solvers.openfoam.dictionaries import control, dictionary
from equisection.solvers.openfoam.flow_setup import (
    Coupling,
    reynolds_number,
    unsteady_solution,
    write_flow,
)
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh import outline_mesh
from equisection.solvers.openfoam.section.body_axes import BodyAxes
from equisection.solvers.openfoam.section.rigid_section import mesh_of, require_sound_mesh
from equisection.solvers.openfoam.section.section_history import read_section
from equisection.solvers.openfoam.section.section_motion import write_motion
from equisection.solvers.openfoam.settings import Settings
from equisection.solvers.openfoam.stream_turbulence import (
    DISSIPATION_OF_K,
    DISSIPATION_OF_OMEGA,
    StreamTurbulence,
)
from equisection.solvers.registry import SOLVERS, check_provided, solver_from_config
from equisection.study import plan

END = "// ************ //\n"


def openfoam(**changes: Any) -> dict[str, Any]:
    return {
        "solver": "openfoam",
        "sweep": {"models": ["2d"]},
        "unsteady": {"time_step": 0.01},
        **changes,
    }


def test_moving_cases_run_in_turn_in_folders_of_their_own(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A section is released by the run of sections and a plate by that of plates."""
    told: list[tuple[float, float]] = []

    def run(name: str) -> Any:
        def one(_self: Adapter, _found: Any, case: Any, place: Path, tell: Any) -> tuple[Any, ...]:
            tell(case.duration / 2, case.duration)
            return name, case.duration, place.relative_to(tmp_path).as_posix()

        return one

    found = type("Found", (), {"version": lambda self: "v0", "found": "nowhere"})()
    monkeypatch.setattr(adapter, "find", lambda launcher="": found)
    for name in ("_free_section", "_free_plate", "_forced_section"):
        monkeypatch.setattr(Adapter, name, run(name))
    section = UNSTEADY.model_copy(update={"duration": 10.0})
    plate = UNSTEADY_PLATE.model_copy(update={"duration": 30.0})
    solver = Adapter(Settings("coarse", 2))
    results: list[Any] = solver.run_unsteady(
        [section, plate], tmp_path, lambda *now: told.append(now)
    )
    assert results == [("_free_section", 10.0, "case0"), ("_free_plate", 30.0, "case1")]
    assert told == [(5.0, 40.0), (25.0, 40.0)]
    forced: list[Any] = [section]
    results = solver.run_forced(forced, tmp_path, nothing)
    assert results == [("_forced_section", 10.0, "case0")]


def test_dictionary_is_written_in_openfoams_words() -> None:
    text = dictionary("x", {"a": {"b": True, "c": (1, 2.5, 0)}, "list": ['"lib.so"']})
    assert text.splitlines()[7:] == [
        "",
        "a",
        "{",
        "    b yes;",
        "    c (1 2.5 0);",
        "}",
        'list ("lib.so");',
    ]


def test_reynolds_number_is_that_of_the_paper() -> None:
    assert reynolds_number(GEOMETRY, MEDIUM) == pytest.approx(1.27e5, rel=2e-3)


def test_flow_has_the_viscosity_of_its_reynolds_number(tmp_path: Path) -> None:
    write_flow(tmp_path, 1e5)
    assert "nu 1e-05;" in (tmp_path / "constant" / "transportProperties").read_text()
    assert {path.name for path in (tmp_path / "0").iterdir()} == {"U", "p", "k", "omega", "nut"}


def test_laminar_flow_has_no_model_of_the_turbulence(tmp_path: Path) -> None:
    write_flow(tmp_path, 100.0, turbulence=StreamTurbulence("laminar"))
    said = (tmp_path / "constant" / "turbulenceProperties").read_text()
    assert "simulationType laminar;" in said
    assert "kOmegaSST" not in said
    assert {path.name for path in (tmp_path / "0").iterdir()} == {"U", "p"}


def test_unsteady_run_starts_from_the_fields_of_its_flow(tmp_path: Path) -> None:
    """A laminar flow has no fields of the turbulence; of a turbulent one none may be missing."""
    for turbulence in ("laminar", "k-omega-sst"):
        source = tmp_path / turbulence
        write_flow(source, 100.0, turbulence=StreamTurbulence(turbulence))
        shutil.copytree(source / "0", source / "300")
        (source / "300" / "phi").write_text("")
        copy_flow(source, tmp_path / "target")
    (source / "300" / "k").unlink()
    with pytest.raises(FileNotFoundError):
        copy_flow(source, tmp_path / "target")


def test_stream_has_one_per_cent_of_turbulence_and_ten_times_the_viscosity(tmp_path: Path) -> None:
    """k = 3/2 (I V)^2, nu_t = 10 nu, omega = k/nu_t; V = c = 1."""
    write_flow(tmp_path, 1e5)
    for name, value in {"k": "0.00015", "nut": "0.0001", "omega": "1.5"}.items():
        assert f"internalField uniform {value};" in (tmp_path / "0" / name).read_text()


def test_turbulence_of_the_stream_decays_as_the_model_has_it() -> None:
    """k' = -beta* omega k, omega' = -beta omega^2, integrated; nothing is lost at the inlet."""
    inlet, viscosity = StreamTurbulence(intensity=0.05, viscosity_ratio=10.0), 1e-5

    def rates(_x: float, y: np.ndarray) -> tuple[float, float]:
        return (
            -DISSIPATION_OF_K * y[1] * y[0],
            -DISSIPATION_OF_OMEGA * y[1] ** 2,
        )

    start = (inlet.energy, inlet.frequency(viscosity))
    energy, omega = solve_ivp(rates, (0.0, 4.5), start, rtol=1e-10, atol=1e-14).y[:, -1]
    found = inlet.after(4.5, viscosity)
    assert found.energy == pytest.approx(energy, rel=1e-6)
    assert found.viscosity_ratio == pytest.approx(energy / omega / viscosity, rel=1e-6)
    assert found.intensity < 0.25 * inlet.intensity
    same = inlet.after(0.0, viscosity)
    assert (same.intensity, same.viscosity_ratio) == pytest.approx((0.05, 10.0))


def test_turbulence_at_the_inlet_is_a_part_of_a_turbulent_case_alone(tmp_path: Path) -> None:
    plain = solver_from_config(load_config(openfoam()), "coarse").settings("2d")
    keys = {"turbulence_intensity": 0.05, "viscosity_ratio": 100.0}
    for dimension in ("2d", "3d"):
        changed = solver_from_config(load_config(openfoam(openfoam=keys)), "coarse")
        assert changed.settings(dimension) == {**plain, **keys}
    laminar = load_config(
        openfoam(
            openfoam={"turbulence": "laminar", **keys}, steady={"beam_polar": "of-the-beam.csv"}
        )
    )
    assert solver_from_config(laminar, "coarse").settings("2d") == {
        **plain,
        "turbulence": "laminar",
    }
    write_flow(tmp_path, 1e5, turbulence=StreamTurbulence("k-omega-sst", 0.05, 100.0))
    said = {name: (tmp_path / "0" / name).read_text() for name in ("k", "nut", "omega")}
    assert "internalField uniform 0.00375;" in said["k"]
    assert "internalField uniform 0.001;" in said["nut"]
    assert "internalField uniform 3.75;" in said["omega"]


def test_wall_velocity_follows_the_mesh_from_the_steady_run_on(tmp_path: Path) -> None:
    write_flow(tmp_path, 1e5)
    velocity = (tmp_path / "0" / "U").read_text()
    assert "movingWallVelocity" in velocity
    assert "noSlip" not in velocity


def body_of(section: Section, folder: Path, incidence: float = 0.0) -> dict[str, str]:
    """Return what is written of a section, by the last words of its lines."""
    write_motion(folder, section, BodyAxes.of(section, incidence), 4.0)
    text = (folder / "constant" / "dynamicMeshDict").read_text()
    return dict(re.findall(r"(\w+) (.+);", text[text.index("mass ") :]))


def numbers(written: str) -> list[float]:
    return [float(word) for word in written.strip("()").split()]


def test_section_has_half_of_each_reduced_quantity(tmp_path: Path) -> None:
    assert UNSTEADY.section is not None
    write_motion(tmp_path, UNSTEADY.section, BodyAxes.of(UNSTEADY.section, 0.1), 4.0)
    text = (tmp_path / "constant" / "dynamicMeshDict").read_text()
    for line in ("mass 40;", "momentOfInertia (1 1 3.35);", "stiffness 0.45;", "stiffness 3.22;"):
        assert line in text


def test_section_without_dampers_and_offset_is_written_as_it_always_was(tmp_path: Path) -> None:
    """So that a run that was begun before goes on, whatever its incidence."""
    assert UNSTEADY.section is not None
    axes = BodyAxes.of(UNSTEADY.section, math.radians(2.5))
    write_motion(tmp_path, UNSTEADY.section, axes, 4.0)
    text = (tmp_path / "constant" / "dynamicMeshDict").read_bytes()
    assert hashlib.sha256(text).hexdigest()[:16] == "1f399325f7e89ea1"


def test_section_has_half_of_each_reduced_damping(tmp_path: Path) -> None:
    damped = Section(
        **{**dict(UNSTEADY.section or {}), "flexural_damping": 0.6, "torsional_damping": 0.2}
    )
    write_motion(tmp_path, damped, BodyAxes.of(damped, 0.1), 4.0)
    text = (tmp_path / "constant" / "dynamicMeshDict").read_text()
    assert [float(found) for found in re.findall(r"damping (.+);", text)] == [0.3, 0.1]


def test_body_turns_about_its_centre_of_mass_and_hangs_on_its_elastic_axis(tmp_path: Path) -> None:
    """m = 80, S = 8: the centre of mass is 0.1 c behind the axis, and I_cg = 6.7 - 64/80."""
    incidence = math.radians(10.0)
    offset = Section(
        **{**dict(UNSTEADY.section or {}), "static_imbalance": 8.0, "elastic_axis": 0.3}
    )
    written = body_of(offset, tmp_path, incidence)
    axis = np.array([-0.2 * math.cos(incidence), 0.2 * math.sin(incidence), 0.0])
    np.testing.assert_allclose(numbers(written["refAttachmentPt"]), axis, atol=1e-8)
    centre = axis + np.array([0.1, 0.0, 0.0])
    np.testing.assert_allclose(numbers(written["centreOfMass"]), centre, atol=1e-12)
    assert written["centreOfRotation"] == written["centreOfMass"]
    np.testing.assert_allclose(numbers(written["momentOfInertia"]), [1, 1, 5.9 / 2])


def test_spring_of_the_bending_is_slack_and_upright_where_it_is_long(tmp_path: Path) -> None:
    """Slack to the last digit: of a heavy section a stretch by 1e-9 c would be a load."""
    for axis in (0.0, 0.3, 0.9999):
        offset = Section(**{**dict(UNSTEADY.section or {}), "elastic_axis": axis})
        written = body_of(offset, tmp_path, math.radians(7.3))
        top, foot = (numbers(written[name]) for name in ("refAttachmentPt", "anchor"))
        assert top[0] == foot[0]
        assert top[1] - foot[1] == pytest.approx(float(written["restLength"]), abs=1e-12)


@pytest.mark.parametrize("factors", [(1.2, 1.0), (1.0, 0.9)])
def test_section_whose_loads_have_factors_is_refused_before_its_flow_is_made(
    tmp_path: Path, factors: tuple[float, float]
) -> None:
    lift, moment = factors
    case = UNSTEADY.model_copy(update={"lift_factor": lift, "moment_factor": moment})
    solver = solver_from_config(load_config(openfoam()), "coarse")
    assert isinstance(solver, Adapter)
    with pytest.raises(SolverError, match=r"have the factors .* solver 'embedded'"):
        solver._free_section(cast(Installation, None), case, tmp_path, nothing)
    assert not list(tmp_path.iterdir())


def test_loads_are_written_at_each_step_in_time_and_iterations() -> None:
    for application in ("simpleFoam", "pimpleFoam"):
        loads = control(application, 100.0, 0.01, 2.0)["functions"]["loads"]
        assert (loads["writeControl"], loads["writeInterval"]) == ("timeStep", 1)


def write_histories(folder: Path, loads: str, motion: str) -> None:
    """Write rows of time, c_d, c_l, c_m, and of time, centre and rotation."""
    for name, text in (
        ("loads/0/coefficient.dat", f"# Time Cd Cl CmPitch\n{loads}"),
        ("motion/0/sixDoFRigidBodyState.dat", f"# Time centreOfRotation rotation\n{motion}"),
    ):
        path = folder / "postProcessing" / name
        path.parent.mkdir(parents=True)
        path.write_text(text)


def test_moment_is_about_the_moving_centre(tmp_path: Path) -> None:
    write_histories(tmp_path, "1 0.1 0.4 0.07\n2 0.1 0.4 0.07\n", "1 (0 0.3 0) (0 0 -0.01)\n")
    history = read_section(tmp_path, BodyAxes(0.0))
    # drag above the centre at rest turns the nose up about it, by 0.3 x 0.1
    np.testing.assert_allclose(history.moment, [0.04])
    np.testing.assert_allclose(history.axis_moment, [0.04])
    np.testing.assert_allclose(history.twist, [0.01])
    np.testing.assert_allclose(history.deflection, [0.3])


def test_moments_of_a_section_with_offset_are_about_where_its_axes_have_moved(
    tmp_path: Path,
) -> None:
    """The body turns about its centre of mass, 0.1 c behind an axis at a quarter of the chord."""
    axes, twist, deflection = BodyAxes(math.radians(5.0), -0.25, 0.1), 0.2, 0.3
    force = np.array([0.1, 0.4])  # drag and lift
    turned = np.array([[math.cos(twist), math.sin(twist)], [-math.sin(twist), math.cos(twist)]])
    centre = np.array(axes.centre_of_mass)
    axis = centre + turned @ (np.array(axes.elastic_axis) - centre)
    centre[1] += deflection - (axis - axes.elastic_axis)[1]
    axis = centre + turned @ (np.array(axes.elastic_axis) - axes.centre_of_mass)
    middle = centre + turned @ -np.array(axes.centre_of_mass)
    write_histories(
        tmp_path,
        f"1 {force[0]} {force[1]} 0.07\n2 0.1 0.4 0.07\n",
        f"1 ({centre[0]} {centre[1]} 0) (0 0 {-twist})\n",
    )
    history = read_section(tmp_path, axes)
    np.testing.assert_allclose(history.deflection, [deflection])
    np.testing.assert_allclose(history.moment, [0.07 + middle[0] * 0.4 - middle[1] * 0.1])
    np.testing.assert_allclose(history.axis_moment, [0.07 + axis[0] * 0.4 - axis[1] * 0.1])
    # from mid-chord to the axis: the relative wind is that of the tunnel, alpha = theta_0 + theta
    alpha = axes.incidence + twist
    transferred = history.moment - 0.25 * (0.4 * math.cos(alpha) + 0.1 * math.sin(alpha))
    np.testing.assert_allclose(history.axis_moment, transferred)


def test_section_that_is_held_until_its_release_is_meshed_there(tmp_path: Path) -> None:
    """Mid-chord, axis and centre of mass are where the section has turned them to about its axis.

    Held at w = 0, the axis is where it is at rest, so the spring of the bending is slack; that of
    the torsion is not.
    """
    twist, rigid = math.radians(2.0), math.radians(5.0)
    held = BodyAxes(rigid, -0.25, 0.1, twist)
    axis, centre = np.array(held.elastic_axis), np.array(held.centre_of_mass)
    assert axis == pytest.approx([-0.25 * math.cos(rigid + twist), 0.25 * math.sin(rigid + twist)])
    assert centre - axis == pytest.approx([0.1 * math.cos(twist), -0.1 * math.sin(twist)])
    assert held.deflection(centre[1], np.array(twist)) == pytest.approx(0.0)
    np.testing.assert_allclose(held.mid_chord_places(twist, 0.0), 0.0, atol=1e-15)
    # untwisted, the section is as it is without a start, but for the place of its mesh
    free = BodyAxes(rigid, -0.25, 0.1)
    shift = np.subtract(held.axis_places(twist, 0.0), free.axis_places(twist, 0.0))
    moved = np.array(held.mid_chord_places(-0.1, 0.3)) - free.mid_chord_places(-0.1, 0.3)
    np.testing.assert_allclose(moved, shift)

    write_histories(tmp_path, "1 0.1 0.4 0.07\n2 0.1 0.4 0.07\n", f"1 (0 {centre[1]} 0) (0 0 0)\n")
    history = read_section(tmp_path, held)
    assert (history.twist[0], history.deflection[0]) == pytest.approx((twist, 0.0))
    assert history.moment[0] == pytest.approx(0.07)


def test_body_of_a_start_has_its_rate_and_the_moment_of_its_spring(tmp_path: Path) -> None:
    assert UNSTEADY.section is not None
    twist = math.radians(2.0)
    axes = BodyAxes.of(UNSTEADY.section, 0.0, twist)
    write_motion(tmp_path, UNSTEADY.section, axes, 4.0, heave_rate=-0.01)
    text = (tmp_path / "constant" / "dynamicMeshDict").read_text()
    assert "velocity (0 -0.01 0);" in text
    # nose down, which is about +z
    assert numbers(re.findall(r"torque (.+);", text)[0])[2] == pytest.approx(3.22 * twist)
    slack = numbers(re.findall(r"referenceOrientation (.+);", text)[0])
    assert math.atan2(slack[3], slack[0]) == pytest.approx(twist)


def test_start_of_a_section_is_that_of_the_tip_by_its_recovery() -> None:
    started = UNSTEADY.model_copy(update={"start": Start(twist_deg=-0.5, heave_rate=0.02)})
    assert started.section_start_twist == pytest.approx(math.radians(-0.5 * 0.6))
    assert started.section_heave_rate == pytest.approx(0.02 * 0.4)
    assert mesh_of(started, 1.0).incidence == pytest.approx(math.radians(2.5 - 0.3))


@pytest.mark.parametrize("start", [{"twist_deg": -0.5}, {"heave_rate": 0.01}])
def test_symmetric_section_starts_at_zero_incidence(start: dict[str, float]) -> None:
    config = load_config(
        openfoam(flow={"incidence_deg": 0.0}, unsteady={"time_step": 0.01, "start": start})
    )
    assert config.unsteady.start.is_given


def test_settings_decide_results_and_know_no_machine() -> None:
    there = openfoam(openfoam={"prefix": "openfoam2312", "outer_correctors": 4})
    solver = solver_from_config(load_config(there), "coarse")
    assert solver.settings("2d") == {"mesh": "coarse", "outer_correctors": 4}
    assert Adapter.from_settings(solver.settings("2d")).settings("2d") == solver.settings("2d")


def test_relaxation_is_in_the_case_where_there_is_one() -> None:
    relaxed = openfoam(openfoam={"velocity_relaxation": 0.9})
    settings = solver_from_config(load_config(relaxed), "coarse").settings("2d")
    assert settings == {"mesh": "coarse", "outer_correctors": 8, "velocity_relaxation": 0.9}
    assert Adapter.from_settings(settings).settings("2d") == settings
    factors = unsteady_solution(Coupling(8, 0.9))["relaxationFactors"]
    assert factors == {"equations": {'"U.*"': 0.9, '"(k|omega).*"': 1}}


def test_registry_says_what_the_adapter_provides() -> None:
    assert SOLVERS["openfoam"].provides == Adapter.provides


def test_prefix_reaches_the_jobs_as_a_variable() -> None:
    config = load_config(openfoam(openfoam={"prefix": "openfoam2312"}))
    assert config.solver_section.environment() == {"EQUISECTION_OPENFOAM": "openfoam2312"}


def test_writing_a_case_imports_nothing_that_reads_results_of_openfoam() -> None:
    """Importing foamlib takes longer than writing a case."""
    code = "import sys, equisection.solvers.openfoam.adapter; sys.exit('foamlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    "steep",
    [
        {"steady": {"incidence_deg": [0.0, 2.0, 4.0, 60.0]}},
        {"forced": {"incidence_deg": 60.0}},
    ],
)
def test_channel_has_room_at_every_incidence(steep: dict[str, Any]) -> None:
    check_provided(load_config(openfoam()))
    with pytest.raises(ConfigError, match=r"turned to 6[0-9.]* deg, does not fit into a channel"):
        check_provided(load_config(openfoam(**steep)))


@pytest.fixture
def sections_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """A solver without cases of the beam."""
    entry = replace(SOLVERS["openfoam"], dimensions=("2d",))
    monkeypatch.setitem(SOLVERS, "openfoam", entry)


@pytest.mark.usefixtures("sections_only")
def test_models_that_need_three_dimensions_are_refused() -> None:
    config = load_config(openfoam(sweep={"models": ["2d", "2d-corrected", "3d"]}))
    with pytest.raises(ConfigError) as raised:
        check_provided(config)
    lines = str(raised.value).splitlines()
    assert [line.split(": ")[1] for line in lines] == ["sweep.models.1", "sweep.models.2"]
    assert "without correction" in lines[0]
    assert "steady.beam_polar" in lines[0]


def names_of_figures(config: Config) -> list[str]:
    return [entry.name for entry in figures(config)]


def test_given_beam_polar_allows_the_correction_and_its_figures_alone() -> None:
    steady = {"beam_polar": "config/polars/paper_plate_3d.csv"}
    config = load_config(openfoam(steady=steady, sweep={"models": ["2d", "2d-corrected"]}))
    check_provided(config)
    drawn = names_of_figures(config)
    assert {"lift-correction", "moment-correction"} <= set(drawn)
    assert "spanwise-loads" not in drawn
    assert plan.steady_dimensions(config) == ("2d",)


@pytest.mark.usefixtures("sections_only")
def test_given_beam_polar_does_not_make_cases_of_the_beam() -> None:
    steady = {"beam_polar": "config/polars/paper_plate_3d.csv"}
    with_beam = load_config(openfoam(steady=steady, sweep={"models": ["2d-corrected", "3d"]}))
    with pytest.raises(ConfigError, match=r"sweep\.models\.1: '3d'.*has no 3D cases"):
        check_provided(with_beam)


def test_plate_runs_on_its_ranks_and_the_section_on_one() -> None:
    section = load_config(openfoam(openfoam={"ranks": 4})).solver_section
    assert (section.threads("2d"), section.threads("3d")) == (1, 4)


def test_ranks_are_no_part_of_a_case() -> None:
    one, four = (
        solver_from_config(load_config(openfoam(openfoam={"ranks": ranks})), "coarse")
        for ranks in (1, 4)
    )
    assert one.settings("2d") == four.settings("2d")


def test_choices_of_the_section_alone_are_no_part_of_a_case_of_the_plate() -> None:
    """A plate is run once, whichever cells the section beside it has."""
    on_its_cells = {"meshes": {"coarse": "plate-coarse"}}
    plain, section_alike, overset = (
        solver_from_config(load_config(openfoam(openfoam=chosen)), "coarse")
        for chosen in ({}, on_its_cells, {"mesh_motion": "overset"})
    )
    assert section_alike.settings("3d") == overset.settings("3d") == plain.settings("3d")
    assert plain.settings("3d") == {"mesh": "coarse", "outer_correctors": 8}
    assert section_alike.settings("2d")["mesh"] == "plate-coarse"


def test_run_with_the_plate_has_its_figures_and_table() -> None:
    config = load_config(openfoam(sweep={"models": ["2d-corrected", "3d"]}))
    check_provided(config)
    assert plan.steady_dimensions(config) == ("2d", "3d")
    assert {"spanwise-loads", "modal-contributions"} <= set(names_of_figures(config))


@pytest.mark.usefixtures("sections_only")
def test_run_without_three_dimensions_has_no_figure_of_the_beam() -> None:
    config = load_config(openfoam())
    assert names_of_figures(config) == [
        "mode-shapes",
        "mesh-of-section",
        "section-polar",
        "surface-loads",
        "courant-number",
        "response",
        "hysteresis",
        "growth-rate",
    ]


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"unsteady": {"time_step": 0.05}}, "unsteady.time_step: 0.05"),
        ({"flow": {"channel": None}}, "flow.channel: null"),
        ({"steady": {"resolution": "finest"}}, "steady.resolution: 'finest'"),
        ({"openfoam": {"meshes": {"a": "huge"}}}, "openfoam.meshes.a: 'huge'"),
        ({"openfoam": {"outer_correctors": 0}}, "openfoam.outer_correctors: 0"),
        ({"openfoam": {"velocity_relaxation": 0}}, "openfoam.velocity_relaxation: 0"),
    ],
)
def test_what_the_solver_cannot_do_is_refused(changes: dict[str, Any], key: str) -> None:
    with pytest.raises(ConfigError) as raised:
        load_config(openfoam(**changes))
    assert str(raised.value).startswith(f"config: {key}: ")


@pytest.mark.parametrize(
    ("channel", "motion", "reason"),
    [
        ({"height_chords": 1.5}, "morph", "turned to 10 deg, does not fit into a channel of 1.5 c"),
        ({"downstream_chords": 3.0}, "morph", "a channel of 4 c from -5 c to 3 c"),
        ({"upstream_chords": 1.5}, "overset", "a channel of 4 c from -1.5 c to 15 c"),
        ({"height_chords": 2.4}, "overset", "the overset mesh around the plate does not fit"),
    ],
)
def test_channel_without_room_for_the_mesh_is_refused(
    channel: dict[str, float], motion: str, reason: str
) -> None:
    raw = openfoam(flow={"channel": channel}, openfoam={"mesh_motion": motion})
    with pytest.raises(ConfigError) as raised:
        check_provided(load_config(raw))
    (line,) = str(raised.value).splitlines()
    assert line.startswith("config: flow.channel: {height_chords: ")
    assert reason in line


@pytest.mark.parametrize(
    ("motion", "outline", "height"),
    [
        ("morph", False, 1.9),
        ("overset", False, 0.8),
        ("overset", False, 2.1),
        ("overset", True, 1.2),
    ],
)
def test_mesh_without_room_at_the_equilibrium_is_a_result(
    motion: str, outline: bool, height: float, tmp_path: Path
) -> None:
    """Its height is known with the case alone, and other cases of the sweep may have the room."""
    start = Start(state="equilibrium", twist_deg=0.3, equilibrium=(0.01, height))
    case, mesher = UNSTEADY.model_copy(update={"start": start}), ""
    if outline:
        pairs = SHAPES["naca 0012"].as_pairs()
        geometry = case.geometry.model_copy(update={"outline": pairs})
        case = case.model_copy(update={"geometry": geometry})
        mesher = outline_mesh.mesher(reynolds_number(case.geometry, case.medium))
    solver = Adapter(Settings("coarse", 2, mesh_motion=motion, mesher=mesher))
    found = solver._free_section(cast(Installation, None), case, tmp_path, nothing)
    assert found.verdict["regime"] == "failed"
    assert f"with the section {height:g} c above its middle" in found.verdict["reason"]


def test_wide_channel_in_the_place_of_free_air_has_room() -> None:
    wide = {"height_chords": 20, "tip_gap_chords": 10}
    check_provided(load_config(openfoam(flow={"channel": wide})))


def test_case_without_a_channel_or_of_the_beam_is_refused(tmp_path: Path) -> None:
    free = STEADY.model_copy(update={"geometry": GEOMETRY.model_copy(update={"upstream": None})})
    with pytest.raises(SolverError, match=r"flow\.channel: null"):
        mesh_of(free, 1.0)
    assert mesh_of(STEADY, 1.0).incidence == pytest.approx(math.radians(2.5))


def test_mesh_with_faults_is_refused(tmp_path: Path) -> None:
    log = tmp_path / "log.checkMesh"
    log.write_text(" ***Max skewness = 9, 3 highly skew faces\nFailed 1 mesh checks.\n")
    with pytest.raises(SolverError, match="Max skewness = 9"):
        require_sound_mesh(log)


def state(folder: Path, time: str, *, cut: str = "") -> None:
    for name in ("U", "p", "k", "omega", "nut", "phi", "uniform/time"):
        path = folder / time / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("values" if name == cut else f"values\n{END}")


def test_states_cut_short_are_removed(tmp_path: Path) -> None:
    state(tmp_path, "0")
    state(tmp_path, "2")
    state(tmp_path, "4")
    (tmp_path / "4" / "uniform" / "time").unlink()
    state(tmp_path, "10", cut="U")
    assert drop_broken_states(tmp_path) == 2.0
    assert not (tmp_path / "4").exists()
    assert not (tmp_path / "10").exists()


def test_histories_of_later_starts_are_removed(tmp_path: Path) -> None:
    for start in ("0", "2", "4"):
        (tmp_path / "postProcessing" / "loads" / start).mkdir(parents=True)
    drop_histories_after(tmp_path, 2.0)
    there = sorted(path.name for path in (tmp_path / "postProcessing" / "loads").iterdir())
    assert there == ["0", "2"]
