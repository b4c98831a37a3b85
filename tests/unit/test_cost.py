"""Memory and time that a job asks for, and what they are fitted to."""

import json
from pathlib import Path

import pytest
import yaml
from tests.conftest import ROOT
from tests.sample_cases import UNSTEADY

from equisection.cases import FORCED, FREE, STEADY, SolverBlock, canonical, case_hash
from equisection.config import load_config
from equisection.errors import ConfigError
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.run import cost
from equisection.run.command_line import main
from equisection.run.cost import CellCost, megabytes, minutes, read_cost_model, seconds
from equisection.run.cost_fit import fits, fitted
from equisection.run.jobs import batch_work, solver_jobs
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.job_work import steady_work, unsteady_work
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import TURNS
from equisection.solvers.openfoam.work_done import work_done
from equisection.solvers.registry import solver_from_config
from equisection.solvers.work import Work
from equisection.study.forced_cases import forced_case
from equisection.study.plan import forced_names

COSTS = ROOT / "workflow" / "profiles" / "cost.yaml"
KEPT = ROOT / "results" / "reference"
CELL = CellCost(iteration=1e-6, step=4e-6, memory_kb=2.0)
OPENFOAM = {
    "solver": "openfoam",
    "unsteady": {"duration": 100.0, "time_step": 0.02},
    "openfoam": {"outer_correctors": 3},
}


def openfoam_work(dimension: str, **changes: object) -> Work:
    raw = {**OPENFOAM, "openfoam": {"outer_correctors": 3, **changes}}
    return cost.work_of(load_config(raw), FREE, dimension, "coarse")


def test_work_of_a_section_is_that_of_its_mesh_and_steps() -> None:
    work = openfoam_work("2d")
    assert work.cells == 11_136
    assert work.steps == pytest.approx(100.0 / 0.02 * 3)


def test_work_grows_with_mesh_steps_and_iterations() -> None:
    section, plate = openfoam_work("2d"), openfoam_work("3d")
    assert plate.cells == 85_284
    assert openfoam_work("2d", meshes={"coarse": "fine"}).cells > 5 * section.cells
    once, twice = (openfoam_work("2d", outer_correctors=number) for number in (1, 2))
    assert twice.steps == pytest.approx(2 * once.steps)
    # more than are needed are not done
    assert openfoam_work("2d", outer_correctors=50) == openfoam_work("2d", outer_correctors=8)
    assert openfoam_work("2d", mesh_motion="overset").steps > section.steps
    assert openfoam_work("3d", mesh_motion="overset").steps == plate.steps


def test_work_of_a_beam_of_an_outline_counts_its_layers() -> None:
    """NACA 0012 of 3.7 c by gmsh: 80,600 cells in the channel, 371,802 in free air of 30 c."""
    wing = {**OPENFOAM, "steady": {"study": []}, "openfoam": {"mesher": "outline"}}
    section = {"bending_rigidity": 1.0, "torsional_rigidity": 1.0, "mass_per_length": 1.0}
    wing["beam"] = {
        **{"chord": 1.0, "length": 3.7, "thickness": 0.12, "outline": {"naca": "0012"}},
        "cross_section": {**section, "inertia_per_length": 1.0},
    }
    wing["structure"] = {"method": "beam"}
    in_channel, free = (
        cost.work_of(load_config({**wing, "flow": flow}), FREE, "3d", "coarse").cells
        for flow in ({}, {"channel": None})
    )
    assert 80_686 < in_channel < 1.25 * 80_686
    assert 371_802 < free < 1.25 * 371_802


@pytest.mark.parametrize(("dimension", "longest"), [("2d", 110.0), ("3d", 70.0)])
def test_rigid_case_may_go_on_as_long_as_its_record_can_be(dimension: str, longest: float) -> None:
    """The plate's is shorter, for what it costs (openfoam-sweep.md, plate-sweep.md)."""
    work = cost.work_of(load_config(OPENFOAM), STEADY, dimension, "coarse")
    assert work.steps == pytest.approx(longest / 0.02 * 3)


@pytest.mark.parametrize("motion", ["multi-sine", "harmonic"])
@pytest.mark.parametrize("velocities", [[3, 4, 6, 24], [4, 5, 8, 8.3]])
def test_job_of_a_forced_motion_asks_for_its_longest_record(
    motion: str, velocities: list[float]
) -> None:
    """Two close frequencies take longer to be told apart than the periods of the slowest."""
    forced = {"run": True, "motion": motion, "reduced_velocity": velocities}
    for solver in ("openfoam", "embedded"):
        config = load_config({**OPENFOAM, "solver": solver, "forced": forced})
        adapter = solver_from_config(config, "coarse")
        cases = [forced_case(config, name, adapter) for name in forced_names(config)]
        longest = max(case.duration for case in cases)
        work = cost.work_of(config, FORCED, "2d", "coarse")
        steps = longest / config.unsteady.time_step
        if solver == "openfoam":
            assert work.steps == pytest.approx(3 * steps, rel=5e-3)
        else:
            assert work.steps >= 0.995 * steps


def test_job_that_looks_up_what_is_kept_asks_for_no_solver() -> None:
    raw = yaml.safe_load(
        (ROOT / "config" / "paper" / "resolution.yaml").read_text(encoding="utf-8")
    )
    computes, looks_up = (load_config({**raw, "compute": compute}) for compute in (True, False))
    assert batch_work(computes, STEADY, "3d").cells > 1e6
    for work in (batch_work(looks_up, kind, "3d") for kind in (STEADY, FREE)):
        assert megabytes(work, CELL, 1) <= 2000
        assert minutes(work, CELL, 1) <= 60


def test_batch_of_the_embedded_solver_has_the_work_of_its_cases() -> None:
    config = load_config({"embedded": {"strips": 10}})
    one, many = (cost.work_of(config, FREE, "3d", "coarse", cases) for cases in (1, 7))
    assert one.cells == 10
    assert many.cells == 70
    assert many.steps == one.steps == pytest.approx(400.0 / 0.05)


def test_time_and_memory_by_hand() -> None:
    work = Work(cells=1e6, iterations=1000, steps=2000)
    assert seconds(work, CELL) == pytest.approx(1e6 * (1000 * 1e-6 + 2000 * 4e-6))
    # 9000 s of the processors, on seven ranks 21.4 min, of which three times is asked for; 1.9 GB
    assert minutes(work, CELL, 7) == 10 + 65
    assert megabytes(work, CELL, 7) == 400 + 700 + 2930


def test_every_kept_result_would_have_ended_in_the_time_that_is_asked_for() -> None:
    model, counted = read_cost_model(COSTS), 0
    for path in KEPT.rglob("*.nc"):
        attributes = read_dataset(path).attrs
        if "case" not in attributes:  # a mesh
            continue
        case = json.loads(attributes["case"])
        work = work_done(case, attributes)
        if work is not None:
            counted += 1
            expected = seconds(work, model.of("openfoam", case["dimension"]))
            assert attributes["cpu_seconds"] < cost.SAFETY * expected, path
    assert counted >= 12


def test_model_is_what_the_kept_results_say() -> None:
    model = read_cost_model(COSTS)
    found = fits([KEPT])
    assert {(fit.dimension, fit.term) for fit in found} >= {("2d", "iteration"), ("2d", "step")}
    for fit in found:
        per_cell = model.of(fit.solver, fit.dimension)
        assert getattr(per_cell, fit.term) == pytest.approx(fit.value, rel=0.2)


def test_beam_released_from_equilibrium_is_no_measure_of_a_step() -> None:
    """Its time has the way of its mesh to the equilibrium, too."""
    assert fits([KEPT / "plate-equilibrium"]) == []
    assert [fit.term for fit in fits([KEPT / "plate-equilibrium-medium"])] == ["iteration"]


def result(folder: Path, name: str, cpu_seconds: float, **attributes: object) -> None:
    """Write a result of 20 c/V on the coarse mesh that took some time."""
    settings = {"mesh": "coarse", "outer_correctors": 2}
    block = SolverBlock(name="openfoam", version=Adapter.version, settings=settings)
    changes = {"solver": block, "time_step": 0.02, "k_star": float(ord(name[0]))}
    case = UNSTEADY.model_copy(update=changes)
    data = read_dataset(next(KEPT.rglob("2d/k10.nc")))
    data.attrs |= {
        "case": canonical(case),
        "case_hash": case_hash(case),
        "cpu_seconds": cpu_seconds,
        "end_time": 20.0,
        **attributes,
    }
    write_dataset(folder / f"{name}.nc", data)


def test_coefficient_is_the_median_of_what_results_took(tmp_path: Path) -> None:
    amount = 11_136 * 20.0 / 0.02 * 2
    for name, per_cell in {"a": 2e-6, "b": 3e-6, "c": 9e-6}.items():
        result(tmp_path, name, per_cell * amount)
    result(tmp_path / "again", "a", 2e-6 * amount)  # the same case, kept elsewhere too
    result(tmp_path, "d", 1e-9, regime="failed", reason="it blew up")
    (tmp_path / "broken.nc").write_text("no NetCDF")
    (fit,) = fits([tmp_path])
    assert fit.value == pytest.approx(3e-6)
    assert len(fit.values) == 3
    model = fitted(read_cost_model(COSTS), [fit])
    assert model.of("openfoam", "2d").step == fit.value
    assert model.of("openfoam", "3d") == read_cost_model(COSTS).of("openfoam", "3d")


def test_command_prints_the_fit_and_writes_it_when_asked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result(tmp_path, "a", 2e-6 * 11_136 * 20.0 / 0.02 * 2)
    model = tmp_path / "cost.yaml"
    model.write_text(COSTS.read_text())
    assert main(["cost-model", str(tmp_path)]) == 0
    assert "openfoam 2d step: 2e-06 s per cell, from 1 results" in capsys.readouterr().out
    assert model.read_text() == COSTS.read_text()
    assert main(["cost-model", str(tmp_path), "--write", str(model)]) == 0
    assert read_cost_model(model).of("openfoam", "2d").step == 2e-6
    assert model.read_text().startswith("#")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "cannot be read"),
        ("openfoam: [", "cannot be read"),
        ("openfoam: {2d: {iteration: -1, step: 1, memory_kb: 1}}", "openfoam.2d.iteration: -1"),
        ("openfoam: {2d: {iteration: 1, memory_kb: 1}}", "openfoam.2d.step"),
    ],
)
def test_broken_model_is_told_with_file_and_key(
    text: str | None, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "cost.yaml"
    if text is not None:
        path.write_text(text)
    with pytest.raises(ConfigError, match=str(path)) as raised:
        read_cost_model(path)
    assert words in str(raised.value)


def test_solver_without_an_entry_is_told(tmp_path: Path) -> None:
    path = tmp_path / "cost.yaml"
    path.write_text(yaml.safe_dump({"openfoam": {"2d": CELL.model_dump()}}))
    with pytest.raises(ConfigError, match=r"openfoam\.3d.*profiles/cost\.yaml"):
        read_cost_model(path).of("openfoam", "3d")


WORK = {"steady": steady_work, "free": unsteady_work}
REFINED = {"k_star": [5.0, 6.0, 8.0], "models": ["2d", "3d"], "onset": "refine", "onset_points": 3}


def test_jobs_of_a_solver_that_runs_one_case_each() -> None:
    raw = {**OPENFOAM, "steady": {"incidence_deg": [0.0, 2.5, 5.0, 10.0]}, "sweep": REFINED}
    raw["openfoam"] = {"outer_correctors": 3, "ranks": 4}
    config, model = load_config(raw), read_cost_model(COSTS)
    section, plate, free_section, free_plate = solver_jobs(config, model)
    assert (section.what, plate.what) == ("steady 2d, coarse", "steady 3d, coarse")
    assert section.number == plate.number == 4
    # a third of the bracket narrows to 0.02 in three rounds of three
    assert free_section.number == free_plate.number == 3 + 3 * 3
    assert (free_section.ranks, free_plate.ranks) == (1, 4)
    work, per_cell = cost.work_of(config, FREE, "3d", "coarse"), model.of("openfoam", "3d")
    assert free_plate.core_hours == pytest.approx(12 * seconds(work, per_cell) / 3600)
    assert free_plate.megabytes == megabytes(work, per_cell, 4)
    assert free_plate.minutes == minutes(work, per_cell, 4)


def test_batch_is_one_job_and_so_is_each_round() -> None:
    raw = {"steady": {"incidence_deg": [0.0, 2.5, 5.0, 10.0]}, "sweep": REFINED}
    section, _, free_section, _ = solver_jobs(load_config(raw), read_cost_model(COSTS))
    assert (section.number, section.cells) == (1, 4)
    assert (free_section.number, free_section.cells) == (1 + 3, 3)


def test_rigid_flow_around_an_outline_may_go_on_once_more_on_cells_of_its_own() -> None:
    raw = OPENFOAM | {"sweep": {"k_star": [5.0], "models": ["2d"]}}
    around = {**raw, "openfoam": {"mesher": "outline"}}
    on_blocks, of_outline = (
        {kind: work(load_config(one), "2d", "coarse", 1) for kind, work in WORK.items()}
        for one in (raw, around)
    )
    assert of_outline["steady"].cells == PRESETS["coarse"].outline_cells
    assert of_outline["steady"].cells != on_blocks["steady"].cells == PRESETS["coarse"].cells
    dearer = {kind: of_outline[kind].steps / on_blocks[kind].steps for kind in WORK}
    assert dearer["steady"] == pytest.approx(TURNS * dearer["free"])


def test_command_tells_what_jobs_ask_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    own = tmp_path / "own.yaml"
    own.write_text(yaml.safe_dump(OPENFOAM | {"sweep": {"k_star": [5.0], "models": ["2d"]}}))
    assert main(["cost", str(own)]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    (free,) = (line for line in lines if line[:1] == ["2d"])
    assert free[1:4] == ["1", "11,136", "1"]
    (total,) = (line for line in lines if line[:1] == ["all"])
    rows = [line for line in lines if line[:1] in (["steady"], ["2d"])]
    assert float(total[-1]) == pytest.approx(sum(float(line[-1]) for line in rows), rel=0.01)

    own.write_text("compute: false\n")
    assert main(["cost", str(own)]) == 0
    assert "no job runs a solver" in capsys.readouterr().out
    own.write_text("solver: nothing\n")
    assert main(["cost", str(own)]) == 1
    assert "solver" in capsys.readouterr().err
    own.write_text(
        yaml.safe_dump(
            {"beam": {"length": 0.6}, "steady": {"beam_polar": "config/polars/paper_plate_3d.csv"}}
        )
    )
    assert main(["cost", str(own)]) == 1
    assert "steady.beam_polar" in capsys.readouterr().err
    own.unlink()
    assert main(["cost", str(own)]) == 1
    assert f"{own}: no such file" in capsys.readouterr().err


def test_command_tells_it_from_another_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    assert main(["cost"]) == 0
    here = capsys.readouterr().out
    monkeypatch.chdir(tmp_path)
    assert main(["cost"]) == 0
    assert capsys.readouterr().out == here


def test_sections_are_one_job_where_the_solver_marches_them_together() -> None:
    sweep = {**REFINED, "models": ["2d", "2d-corrected", "3d"]}
    jobs = solver_jobs(load_config({"sweep": sweep}), read_cost_model(COSTS))
    of_sweep = {job.what: (job.number, job.cells) for job in jobs if "steady" not in job.what}
    strips = load_config({}).embedded.strips
    assert of_sweep == {
        "2d": (3, 3),  # rounds of its refinement
        "2d-corrected": (3, 3),
        "3d": (1 + 3, 3 * strips),
        "2d, 2d-corrected": (1, 6),
    }
