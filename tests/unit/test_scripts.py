"""The scripts' `main` functions as a library calls them, without Snakemake."""

import inspect
import json
import logging
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd
import pytest
import yaml
from rich.console import Console
from tests.conftest import ROOT
from tests.sample_cases import STEADY, STEADY_PLATE

from equisection.analysis import known_growth_error
from equisection.analysis.critical_speeds import COLUMNS
from equisection.analysis.onset import onset_table
from equisection.analysis.summary import summary_of
from equisection.cases import SteadyCase, case_hash, read_cases, write_cases
from equisection.config import load_config, resolve_config
from equisection.config.groups import Beam, Flow, Structure
from equisection.errors import EquisectionError, ModesError, ResultFileError
from equisection.figures import lift_correction
from equisection.figures.response import draw, read_response
from equisection.figures.style import drawing_style
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.plate_grid import PlateGrid
from equisection.results.section_dataset import nominal_k_star
from equisection.results.section_mesh import SectionMesh
from equisection.run.listing import cases_of_run
from equisection.run.script import logged
from equisection.run.status import run_status
from equisection.run.status_text import print_status
from equisection.store.index import read_index, write_index
from equisection.store.kept import kept_results
from equisection.structure.mode_set import ModeSet
from equisection.study import plan
from equisection.study.axes import Point, onset_axis

SCRIPTS = sorted(path.stem for path in (ROOT / "scripts").glob("*.py"))
LoadScript = Callable[[str], ModuleType]
RAW: dict[str, Any] = {
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "bending_modes": 2,
        "torsion_modes": 2,
    },
    "steady": {"incidence_deg": [0, 2.5, 5, 10], "resolution": "thin"},
    "embedded": {"polars": {"thin": "flat-plate"}, "strips": 6},
    "unsteady": {"duration": 30.0},
}


@pytest.mark.parametrize("name", SCRIPTS)
def test_main_of_a_script_is_typed_and_says_what_it_does(
    name: str, load_script: LoadScript
) -> None:
    main = load_script(name).main
    signature = inspect.signature(main)
    assert all(
        parameter.annotation is not inspect.Parameter.empty
        for parameter in signature.parameters.values()
    )
    assert signature.return_annotation is None
    assert inspect.getdoc(main)


@pytest.mark.parametrize("name", SCRIPTS)
def test_importing_a_script_does_nothing(
    name: str, load_script: LoadScript, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    load_script(name)
    assert list(tmp_path.iterdir()) == []


@pytest.fixture(scope="module")
def chain(load_script: LoadScript, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every step of Fig. 1, one script after the other, in a folder."""
    folder = tmp_path_factory.mktemp("chain")
    config = load_config(RAW)
    raw = resolve_config(config)
    beam, flow, structure = Beam(), Flow(), Structure(**RAW["structure"])
    load_script("config_resolved").main(raw, folder / "config.resolved.yaml")
    load_script("modes").main(beam, structure, folder / "modes.nc", folder / "mesh_study.nc")
    load_script("equivalent_section").main(
        beam, flow, folder / "modes.nc", folder / "equivalent.nc"
    )
    run = load_script("run_cases")
    for dimension in ("2d", "3d"):
        cases = folder / f"steady_cases_{dimension}.json"
        load_script("steady_cases").main(raw, dimension, plan.steady_cases(config), cases)
        index = folder / "steady" / dimension / "polar.json"
        run.main(cases, index, folder / "store", folder / "progress.json")
        load_script("polar").main(
            index, plan.steady_cases(config), folder / f"polar_{dimension}.nc"
        )
    load_script("correction_factors").main(
        folder / "polar_2d.nc", folder / "polar_3d.nc", "thin", folder / "correction.nc"
    )
    load_script("correction_factors").main(
        folder / "polar_2d.nc",
        folder / "polar_3d.nc",
        "thin",
        folder / "correction_modal.nc",
        modes=folder / "modes.nc",
    )
    made_from = {name: folder / f"{name}.nc" for name in ("modes", "equivalent", "correction")}
    for model in ("2d-corrected", "3d"):
        cases = folder / f"cases_{model}.json"
        load_script("unsteady_cases").main(raw, model, made_from, ["k9", "k21"], cases)
        index = folder / "unsteady" / model / "sweep.json"
        run.main(cases, index, folder / "store", folder / "progress.json")
    indices = [folder / "unsteady" / model / "sweep.json" for model in ("2d-corrected", "3d")]
    load_script("summary").main(
        indices,
        folder / "summary.csv",
        folder / "equivalent.nc",
        config.flow.speed,
        config.reduction,
    )
    load_script("onset").growth_by_linear_theory(
        folder / "equivalent.nc", [9.0, 21.0], "k_star", 20.0, folder / "linear_theory.csv"
    )
    load_script("onset").speeds(
        folder / "summary.csv", folder / "equivalent.nc", raw, folder / "critical_speed.csv"
    )
    load_script("onset").main(
        folder / "summary.csv",
        folder / "equivalent.nc",
        folder / "polar_2d.nc",
        resolution="thin",
        incidence_deg=2.5,
        speed=20.0,
        reduction="consistent",
        output=folder / "onset.csv",
    )
    return folder


def test_correction_that_no_model_needs_may_have_no_polar(
    load_script: LoadScript, chain: Path, tmp_path: Path
) -> None:
    """A run from kept results alone goes on to its figures, which say what is missing."""
    correction, of = tmp_path / "correction.nc", load_script("correction_factors").main
    polars = chain / "polar_2d.nc", chain / "polar_3d.nc"
    with pytest.raises(ResultFileError, match="no resolution 'thick'"):
        of(*polars, "thick", correction)
    of(*polars, "thick", correction, may_lack=True)
    assert read_dataset(correction)["lift_factor"].size == 0
    figure = lift_correction.from_files(*polars, correction, "thick")
    assert "No rigid section was run" in figure.axes[0].texts[0].get_text().replace("\n", " ")


def test_correction_keeps_the_ratio_of_a_section_to_its_beam(
    load_script: LoadScript, chain: Path, tmp_path: Path
) -> None:
    """The section of the beam's polar is divided by it, whatever the run's own section has."""
    section = tmp_path / "section.csv"
    rows = ("incidence_deg,cl,cm,cd", "0,0,0,0.04", "2,0.3,0.06,0.05", "4,0.5,0.08,0.08")
    section.write_text("\n".join((*rows, "8,0.6,0.06,0.14\n")))
    load_script("correction_factors").main(
        chain / "polar_2d.nc",
        chain / "polar_3d.nc",
        "thin",
        tmp_path / "correction.nc",
        section_of_beam=section,
    )
    found = read_dataset(tmp_path / "correction.nc")
    beam = read_dataset(chain / "polar_3d.nc")
    for name, factor, value in (("cl", "lift_factor", 0.3), ("cm", "moment_factor", 0.06)):
        divided = float(beam[name].sel(resolution="thin").interp(incidence_deg=2.0))
        got = float(found[factor].sel(incidence_deg=2.0, method="nearest", tolerance=1e-6))
        assert got == pytest.approx(value / divided, rel=0.02)


def test_beam_without_a_section_runs_alone(load_script: LoadScript, tmp_path: Path) -> None:
    """Both modes alternate over two equal spans: no uniform load moves either, F = G = 0."""
    config = load_config({**RAW, "sweep": {"models": ["3d"]}})
    span = np.linspace(0.0, 1.0, 41)
    wave = np.sin(2.0 * np.pi * span)
    modes = ModeSet(
        np.array([20.0, 60.0]), ("bending", "torsion"), span, np.stack([wave, wave]), "beam", "2"
    )
    files = {name: tmp_path / f"{name}.nc" for name in ("modes", "equivalent")}
    write_dataset(files["modes"], modes_to_dataset(modes, [0.0, 0.0]))
    load_script("equivalent_section").main(
        config.beam, config.flow, files["modes"], files["equivalent"]
    )
    sections = read_dataset(files["equivalent"])
    assert float(sections["k_star"].sel(reduction="paper")) > 0.0
    assert "a uniform load does not move this mode" in sections.attrs["warnings"]
    raw = resolve_config(
        config.model_copy(
            update={
                "structure": config.structure.model_copy(
                    update={"bending_modes": 1, "torsion_modes": 1}
                )
            }
        )
    )
    found = {}
    for model in ("2d", "3d"):
        cases = tmp_path / f"{model}.json"
        index = tmp_path / "unsteady" / model / "sweep.json"
        load_script("unsteady_cases").main(raw, model, files, ["k9"], cases)
        load_script("run_cases").main(cases, index, tmp_path / "store", tmp_path / "progress.json")
        (found[model],) = read_index(index).values()
    assert found["2d"]["regime"] == "failed"
    assert "run the beam (sweep.models: [3d])" in found["2d"]["reason"]
    assert found["3d"]["regime"] != "failed"


def test_chain_of_scripts_ends_in_a_line_for_each_run(chain: Path) -> None:
    summary = pd.read_csv(chain / "summary.csv")
    assert list(zip(summary["model"], summary["k_star"], strict=True)) == [
        ("2d-corrected", 9.0),
        ("2d-corrected", 21.0),
        ("3d", 9.0),
        ("3d", 21.0),
    ]
    assert pd.read_csv(chain / "onset.csv")["model"].tolist() == ["2d-corrected", "3d"]
    critical = pd.read_csv(chain / "critical_speed.csv")
    assert tuple(critical.columns) == COLUMNS + known_growth_error.COLUMNS
    assert set(critical["errs"]) == {"unknown"}
    by_basis = {basis: list(rows["model"]) for basis, rows in critical.groupby("basis")}
    assert by_basis == {"eigenvalue": ["2d", "2d-paper"], "time": ["2d-corrected", "3d"]}
    pd.testing.assert_series_equal(
        summary["speed"] ** 2 * summary["k_star"],
        pd.Series([20.0**2 * nominal_k_star(read_dataset(chain / "equivalent.nc"))] * 4),
        check_names=False,
    )


def test_linear_theory_over_speed_is_that_at_their_k_star(
    chain: Path, load_script: LoadScript, tmp_path: Path
) -> None:
    growth = load_script("onset").growth_by_linear_theory
    over_k = pd.read_csv(chain / "linear_theory.csv")
    speeds = sorted(set(over_k["speed"]))
    growth(chain / "equivalent.nc", speeds, "speed", 20.0, tmp_path / "linear_theory.csv")
    over_speed = pd.read_csv(tmp_path / "linear_theory.csv")
    pd.testing.assert_frame_equal(over_k, over_speed, rtol=2e-5, check_dtype=False)


def test_modes_feel_less_of_the_beams_lift_than_its_mean(chain: Path) -> None:
    """The tip, where they are largest, loses most; so the factor of Eq. 20 is larger."""
    mean, modal = (
        read_dataset(chain / f"{name}.nc") for name in ("correction", "correction_modal")
    )
    assert (mean.attrs["correction"], modal.attrs["correction"]) == ("mean", "modal")
    for factor in ("lift_factor", "moment_factor"):
        assert (modal[factor] > 1.02 * mean[factor]).all()
        assert (modal[factor] < 1.5 * mean[factor]).all()


@pytest.mark.parametrize(
    "names",
    [["a1_k0.5", "a1_k21", "a2.5_k0.5", "a2.5_k21"], ["v20", "v100"]],
    ids=["incidence and k*", "speed"],
)
def test_study_over_other_axes_runs_by_the_names_of_its_cases(
    chain: Path, load_script: LoadScript, tmp_path: Path, names: list[str]
) -> None:
    """A thin plate diverges below k* = pi/2, which the beam as given has at 72 m/s."""
    raw = resolve_config(load_config(RAW))
    cases, index = tmp_path / "cases/unsteady/2d/sweep.json", tmp_path / "unsteady/2d/sweep.json"
    made_from = {"equivalent": chain / "equivalent.nc"}
    load_script("unsteady_cases").main(raw, "2d", made_from, names, cases)
    load_script("run_cases").main(cases, index, tmp_path / ".store", tmp_path / "progress.json")
    assert [listed.name for listed in cases_of_run(tmp_path)] == names
    points = [Point.named(name) for name in names]
    axes, along = points[0].axes, onset_axis(points[0].axes)
    load_script("summary").main(
        [index],
        tmp_path / "summary.csv",
        chain / "equivalent.nc",
        raw["flow"]["speed"],
        "consistent",
    )
    summary = pd.read_csv(tmp_path / "summary.csv")
    columns = [axis.name for axis in axes]
    assert list(summary.columns[: len(columns) + 1]) == ["model", *columns]
    assert summary[columns].to_dict("records") == [point.columns for point in points]
    table = onset_table(summary)
    for side, chosen in (("stable", max), ("unstable", min)):
        expected = chosen((point[along] for point in points), key=along.stability)
        assert set(table[f"{along.name}_{side}"]) == {expected}
    assert len(table) == len({point.columns.get("incidence_deg") for point in points})
    printed = Console(record=True, width=120)
    print_status(printed, run_status(tmp_path))
    assert ", ".join(axis.heading for axis in axes) in printed.export_text()


def test_response_over_speed_is_drawn_over_speed(chain: Path, load_script: LoadScript) -> None:
    raw, made_from = resolve_config(load_config(RAW)), {"equivalent": chain / "equivalent.nc"}
    cases, index = chain / "speeds.json", chain / "speeds" / "2d" / "sweep.json"
    load_script("unsteady_cases").main(raw, "2d", made_from, ["v20", "v100"], cases)
    load_script("run_cases").main(cases, index, chain / "store", chain / "progress.json")
    summary = summary_of([index])
    results = [index.parent / f"{name}.nc" for name in ("v20", "v100")]
    response = read_response(summary, onset_table(summary), results, 6.7)
    assert [case.value for case in response.cases["2d"]] == [100.0, 20.0]
    with drawing_style(ROOT / "envs/equisection.mplstyle"):
        figure = draw(response)
    assert figure.axes[0].get_xlabel() == "$V$ (m/s)"
    assert "$V$ = 100 m/s" in figure.axes[2].get_title(loc="left")


@pytest.mark.parametrize("kind", ["steady", "unsteady"])
def test_results_of_the_chain_are_those_of_its_cases(chain: Path, kind: str) -> None:
    cases = read_cases(chain / ("steady_cases_3d.json" if kind == "steady" else "cases_3d.json"))
    assert len(cases) == (4 if kind == "steady" else 2)
    for name, case in cases.items():
        result = chain / kind / "3d" / f"{name}.nc"
        assert read_dataset(result, case_hash(case)).attrs["solver"] == "embedded"


@pytest.mark.parametrize(
    ("tolerance", "chosen"), [(0.05, ["k12", "k15", "k18"]), (1.5, [])], ids=["wide", "narrow"]
)
def test_refinement_divides_the_bracket_of_all_that_has_run(
    chain: Path, load_script: LoadScript, tmp_path: Path, tolerance: float, chosen: list[str]
) -> None:
    """A plate that grew at 9 and settled at 21, in the sweep, and at 30 in an earlier round."""
    attributes = read_index(chain / "unsteady" / "3d" / "sweep.json")
    sweep, earlier = tmp_path / "3d" / "sweep.json", tmp_path / "3d" / "round1.json"
    grown, settled = ({**attributes["k9"], "regime": told} for told in ("growing", "settled"))
    write_index(sweep, {"k9": grown, "k21": {**settled, "k_star": 21.0}})
    write_index(earlier, {"k30": {**settled, "k_star": 30.0}})
    chooses = load_script("refine_onset").main
    chooses([sweep, earlier], tolerance, 3, tmp_path / "round2.json")
    assert plan.read_refinement(tmp_path / "round2.json") == chosen


def test_resolved_configuration_is_yaml_of_every_key(chain: Path) -> None:
    assert yaml.safe_load((chain / "config.resolved.yaml").read_text()) == resolve_config(
        load_config(RAW)
    )


def test_results_that_ran_one_by_one_are_indexed_as_a_batch_is(
    chain: Path, load_script: LoadScript
) -> None:
    folder = chain / "unsteady" / "3d"
    (chain / "single").mkdir()
    cases = []
    for name, case in read_cases(chain / "cases_3d.json").items():
        path = chain / "single" / f"{name}.json"
        load_script("unsteady_cases").write_cases(path, {name: case})
        cases.append(path)
    results = [folder / f"{path.stem}.nc" for path in cases]
    load_script("index_results").main(cases, results, chain / "single" / "index.json")
    batch, single = (
        json.loads(path.read_text())
        for path in (folder / "sweep.json", chain / "single/index.json")
    )
    assert single == batch


def test_more_modes_than_there_are_is_an_error_that_leaves_no_file(
    load_script: LoadScript, tmp_path: Path
) -> None:
    few = Structure(
        **{**RAW["structure"], "elements": {"chord": 1, "span": 2, "thickness": 1}},
    ).model_copy(update={"bending_modes": 12, "torsion_modes": 12})
    with pytest.raises(ModesError, match="12"):
        load_script("modes").main(Beam(), few, tmp_path / "modes.nc", tmp_path / "study.nc")
    assert list(tmp_path.iterdir()) == []


def test_mesh_of_a_case_is_not_taken_for_its_result(
    load_script: LoadScript, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Kept results are found by the hash of their case."""

    class Meshing:
        name, version = "made up", "1"

        def describe(self, dimension: str) -> str:
            return "made up"

        def section_mesh(self, case: SteadyCase, time_step: float, work: Path) -> SectionMesh:
            del work
            points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
            one = np.ones(1)
            corners = np.arange(4)[None]
            return SectionMesh(
                points, corners, case.incidence_deg, {}, courant=one, time_step=time_step, flow=""
            )

    script = load_script("section_mesh")
    monkeypatch.setattr(script, "solver_from_case", lambda block: Meshing())
    write_cases(tmp_path / "case.json", {"coarse_a2.5": STEADY})
    script.main(tmp_path / "case.json", 0.02, tmp_path, tmp_path / "kept" / "section_mesh.nc")
    assert read_dataset(tmp_path / "kept" / "section_mesh.nc").attrs["resolution"] == "coarse"
    assert not kept_results(tmp_path / "kept")


def test_mesh_of_the_plate_is_written_without_the_hash_of_its_case(
    load_script: LoadScript, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Meshing:
        name, version = "made up", "1"

        def describe(self, dimension: str) -> str:
            return f"made up in {dimension}"

        def plate_grid(self, case: SteadyCase, work: Path) -> PlateGrid:
            assert work == tmp_path / case_hash(case) / "mesh"
            points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
            corners, levels = np.arange(4)[None], np.array([0.0, 1.0])
            return PlateGrid(
                points,
                corners,
                case.incidence_deg,
                {},
                levels=levels,
                span=1.0,
                thickness=0.1,
                cells=1,
            )

    script = load_script("plate_mesh")
    monkeypatch.setattr(script, "solver_from_case", lambda block: Meshing())
    write_cases(tmp_path / "case.json", {"coarse_a2.5": STEADY_PLATE})
    script.main(tmp_path / "case.json", tmp_path, tmp_path / "kept" / "plate_mesh.nc")
    attributes = read_dataset(tmp_path / "kept" / "plate_mesh.nc").attrs
    assert attributes["solver_description"] == "made up in 3d"
    assert not kept_results(tmp_path / "kept")


@pytest.mark.parametrize("beam", [True, False])
def test_figures_of_results_from_before_there_were_fields_say_so(
    chain: Path, load_script: LoadScript, tmp_path: Path, beam: bool
) -> None:
    """The embedded solver's results have none either."""
    polar = chain / "steady" / "3d" / "polar.json"
    sweep = [chain / "unsteady" / "3d" / "sweep.json"] if beam else []
    load_script("figure").main(
        {"surface-of-beam": "", "flow-at-tip": "fig12"},
        {"index_of_rigid": polar, "index_of_beam": sweep, "references": []},
        {"resolution": "thin", "incidence_deg": 3.0},
        style=ROOT / "envs" / "equisection.mplstyle",
        outputs=[tmp_path / "surface-of-beam.svg", tmp_path / "flow-at-tip.svg"],
    )
    surface, flow = (
        (tmp_path / f"{name}.svg").read_text() for name in ("surface-of-beam", "fig12")
    )
    assert "no surface data at 0, 2.5, 5, 10 deg" in surface
    assert "has no flow near" in flow
    assert ("is not among the" in flow) == (not beam)
    assert ("= 9" in flow) == beam


def test_missing_input_is_named(load_script: LoadScript, tmp_path: Path) -> None:
    with pytest.raises(ResultFileError, match=r"modes\.nc: missing"):
        load_script("equivalent_section").main(
            Beam(), Flow(), tmp_path / "modes.nc", tmp_path / "equivalent.nc"
        )


def test_script_ends_with_the_message_of_an_error_that_a_user_can_mend(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "logs" / "a.log"

    def work() -> None:
        with logged(str(log)):
            logging.info("working")
            raise EquisectionError("file.csv: line 3: wrong")

    with pytest.raises(SystemExit) as ended:
        work()
    assert ended.value.code == 1
    assert capsys.readouterr().err == "error: file.csv: line 3: wrong\n"
    assert "INFO working" in log.read_text()
    assert "ERROR file.csv: line 3: wrong" in log.read_text()
    assert "Traceback" not in log.read_text()


def test_fault_of_the_program_keeps_its_traceback(tmp_path: Path) -> None:
    log = tmp_path / "a.log"
    with pytest.raises(ZeroDivisionError), logged(str(log)):
        1 / 0  # noqa: B018
    assert "Traceback" in log.read_text()


def test_the_tip_of_a_plate_without_a_result_is_drawn_with_the_reason(
    load_script: LoadScript, tmp_path: Path
) -> None:
    """As with ``compute: false`` and nothing kept."""
    write_index(tmp_path / "polar.json", {}, {"coarse_a2.5": "not kept"})
    load_script("figure").main(
        {"flow-at-tip": ""},
        {"index_of_rigid": tmp_path / "polar.json", "index_of_beam": [], "references": []},
        {"resolution": "coarse", "incidence_deg": 2.5},
        style=ROOT / "envs" / "equisection.mplstyle",
        outputs=[tmp_path / "flow-at-tip.svg"],
    )
    assert "rigid beam has no result" in (tmp_path / "flow-at-tip.svg").read_text()
