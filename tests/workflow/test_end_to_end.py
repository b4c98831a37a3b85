import base64
import hashlib
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml

import equisection
from equisection.cases import case_hash, read_cases
from equisection.config import load_config
from equisection.results.netcdf import read_attributes
from equisection.run.answer import answer_of
from equisection.run.verify import verify_run
from equisection.store.index import read_index
from equisection.store.lock import FOLDER as OWNERS
from tests.workflow.project import ROOT, Project, has_nothing_to_do, jobs_run, small

MODELS = ("2d", "2d-corrected", "3d")
K_STAR = ("k6", "k10", "k21")
ANGLES = tuple(f"coarse_a{angle}" for angle in ("0", "2.5", "5", "7.5", "10"))
NUMBERED = {
    "mode-shapes": "fig03-modes",
    "section-polar": "fig06-section-polar",
    "spanwise-loads": "fig10-spanwise-loads",
    "lift-correction": "fig13-lift-correction",
    "moment-correction": "fig14-moment-correction",
    "modal-contributions": "fig15-modal-contributions",
    "response": "fig16-response",
    "hysteresis": "fig17-hysteresis",
}
UNNUMBERED = ("growth-rate", "section-and-beam")
FIGURES = ("fig01-workflow", *NUMBERED, *NUMBERED.values(), *UNNUMBERED)
GATHERED = {
    "structure/modes.nc": {"frequency", "kind", "shape", "frequency_constant"},
    "structure/mesh_study.nc": {"frequency", "analytic_frequency", "mesh", "kind"},
    "structure/equivalent.nc": {
        "torsional_stiffness",
        "flexural_stiffness",
        "inertia",
        "mass",
        "k_star",
        "i_star",
        "twist_recovery",
        "deflection_recovery",
        "cos_phi",
        "oscillation_ratio",
        "mass_theta",
        "a_theta_w",
    },
    "steady/polar_2d.nc": {"cd", "cl", "cm"},
    "steady/polar_3d.nc": {"cd", "cl", "cm", "cl_section", "cm_section"},
    "steady/correction.nc": {"lift_factor", "moment_factor"},
}
REPORTED_TABLES = (
    "table1",
    "table2",
    "paper",
    "summary",
    "onset",
    "critical_speed",
    "linear_theory",
    "section_and_beam",
)
COLUMNS = {
    "comparison/summary.csv": "model,k_star,regime,mean_twist_deg,mean_deflection_chords,"
    "twist_amplitude_deg,frequency_strouhal,growth_rate,cpu_seconds,wall_seconds",
    "comparison/onset.csv": "model,k_star_stable,k_star_unstable",
    "comparison/critical_speed.csv": "model,incidence_deg,speed,speed_low,speed_high,mechanism,"
    "frequency_hz,k_star,margin,basis,energy_share",
    "comparison/linear_theory.csv": "reduction,motion,k_star,growth_rate,frequency_strouhal",
    "comparison/section_and_beam.csv": "model,k_star,twist,deflection,frequency,growth",
    "comparison/paper.csv": "quantity,paper,here,relative_difference",
}
RESULTS_OF_CASES = [
    *(f"steady/{dimension}/{angle}" for dimension in ("2d", "3d") for angle in ANGLES),
    *(f"unsteady/{model}/{name}" for model in MODELS for name in K_STAR),
]
#: A job of cases has a case file and an index of results of this name.
BATCHES = ("steady/2d/polar", "steady/3d/polar", *(f"unsteady/{model}/sweep" for model in MODELS))


def batch_of(name: str) -> str:
    """Return the batch that a case was run in."""
    folder = name.rpartition("/")[0]
    return next(batch for batch in BATCHES if batch.startswith(f"{folder}/"))


def wanted_files(run: Path) -> set[str]:
    config = hashlib.sha256((run / "config.resolved.yaml").read_bytes()).hexdigest()
    return {
        "config.resolved.yaml",
        f"configs/{config}.yaml",
        *(f"provenance/{log.stem}.json" for log in (run / "logs").glob("*.log")),
        *GATHERED,
        *COLUMNS,
        "tables/table1.csv",
        "tables/table2.csv",
        *(f"figures/{name}.{suffix}" for name in FIGURES for suffix in ("png", "svg", "pdf")),
        *(f"{name}.nc" for name in RESULTS_OF_CASES),
        *(f"{batch}.json" for batch in BATCHES),
        *(f"cases/{batch}.json" for batch in BATCHES),
    }


def test_a_run_leaves_the_files_of_the_contract_and_nothing_else(finished: Project) -> None:
    assert set(finished.files()) == wanted_files(finished.results)


def test_it_is_sound_and_says_what_made_it(finished: Project) -> None:
    found = verify_run(finished.results)
    assert found.faults == {}
    assert found.unrecorded == []
    assert found.checked >= len(FIGURES) * 3 + len(RESULTS_OF_CASES) + len(GATHERED)
    config = hashlib.sha256((finished.results / "config.resolved.yaml").read_bytes()).hexdigest()
    for name in (*GATHERED, *(f"{case}.nc" for case in RESULTS_OF_CASES)):
        attributes = read_attributes(finished.results / name)
        assert attributes["config_hash"] == config
        assert attributes["command"].startswith("snakemake --cores 2")


def test_results_beside_the_run_are_the_store_alone(finished: Project) -> None:
    assert {path.name for path in (finished.folder / "results").iterdir()} == {"small", ".store"}
    store = finished.folder / "results" / ".store"
    files = [path for path in store.rglob("*") if path.is_file()]
    assert {path.name for path in files if path.parent.name != OWNERS} == {"result.nc"}
    hashes = {path.name for path in store.iterdir()}
    assert hashes == {
        case_hash(case)
        for path in finished.results.glob("cases/**/*.json")
        for case in read_cases(path).values()
    }


def test_logs_are_there_and_no_job_is_left_in_progress(finished: Project) -> None:
    logs = {path.name for path in (finished.results / "logs").iterdir()}
    assert {"modes.log", "steady_3d.log", "unsteady_sections_sweep.log", "summary.log"} <= logs
    assert {Path(name).suffix for name in logs} == {".log"}


def test_a_second_run_has_nothing_to_do(finished: Project) -> None:
    assert has_nothing_to_do(finished.run())


@pytest.mark.parametrize("name", [*GATHERED, *(f"{name}.nc" for name in RESULTS_OF_CASES)])
def test_every_variable_says_its_unit_and_meaning(name: str, finished: Project) -> None:
    with xr.open_dataset(finished.results / name) as data:
        for variable in data.variables.values():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]
        assert data.attrs["schema_version"] == 1
        assert data.attrs["equisection_version"] == equisection.__version__
        assert all(
            isinstance(value, str | int | float) or value.ndim == 0 for value in data.attrs.values()
        )


@pytest.mark.parametrize("name", GATHERED)
def test_gathered_files_hold_the_variables_of_the_contract(name: str, finished: Project) -> None:
    with xr.open_dataset(finished.results / name) as data:
        assert set(data.data_vars) >= GATHERED[name]


def test_polars_stand_over_resolution_and_incidence(finished: Project) -> None:
    with xr.open_dataset(finished.results / "steady" / "polar_3d.nc") as polar:
        assert polar["cl"].dims == ("resolution", "incidence_deg")
        assert polar["cl_section"].dims == ("resolution", "incidence_deg", "span")
        assert polar["incidence_deg"].values.tolist() == [0.0, 2.5, 5.0, 7.5, 10.0]


def test_equivalent_section_stands_in_both_reductions(finished: Project) -> None:
    with xr.open_dataset(finished.results / "structure" / "equivalent.nc") as section:
        assert set(section["reduction"].values) == {"paper", "consistent"}


@pytest.mark.parametrize("name", RESULTS_OF_CASES)
def test_results_say_their_case_and_what_made_them(name: str, finished: Project) -> None:
    cases = read_cases(finished.results / "cases" / f"{batch_of(name)}.json")
    case = cases[name.rpartition("/")[2]]
    with xr.open_dataset(finished.results / f"{name}.nc") as data:
        assert data.attrs["case_hash"] == case_hash(case)
        assert data.attrs["solver"] == "embedded"
        assert data.attrs["solver_version"] == case.solver.version
        assert data.attrs["resolution"] == "coarse"
        assert "embedded solver" in data.attrs["solver_description"]
        assert data.attrs["wall_seconds"] > 0


@pytest.mark.parametrize("name", RESULTS_OF_CASES)
def test_index_of_a_batch_says_what_its_results_say(name: str, finished: Project) -> None:
    index = read_index(finished.results / f"{batch_of(name)}.json")
    with xr.open_dataset(finished.results / f"{name}.nc") as data:
        here = index[name.rpartition("/")[2]]
        assert set(here) == set(data.attrs)
        for key, value in data.attrs.items():
            np.testing.assert_equal(here[key], value)  # NaN is NaN


@pytest.mark.parametrize("model", MODELS)
def test_histories_carry_their_verdict(model: str, finished: Project) -> None:
    with xr.open_dataset(finished.results / "unsteady" / model / "k21.nc") as run:
        assert set(run.data_vars) >= {"twist", "deflection", "cl", "cm", "tip_twist"}
        assert run["twist"].attrs["units"] == "rad"
        assert run["deflection"].attrs["units"] == "m"
        assert run["time"].values[0] == 0.0
        assert run.attrs["end_time"] == run["time"].values[-1]
        assert run.attrs["regime"] in ("settled", "decaying", "limit-cycle", "growing")
        assert run.attrs["reason"]
        assert run.attrs["k_star"] == 21.0


@pytest.mark.parametrize("name", COLUMNS)
def test_tables_begin_with_the_columns_of_the_contract(name: str, finished: Project) -> None:
    head = (finished.results / name).read_text().splitlines()[0]
    assert head.startswith(COLUMNS[name])


def test_summary_has_a_line_for_each_run_as_its_file_says_it(finished: Project) -> None:
    summary = pd.read_csv(finished.results / "comparison" / "summary.csv")
    assert list(zip(summary["model"], summary["k_star"], strict=True)) == [
        (model, k_star) for model in MODELS for k_star in (6.0, 10.0, 21.0)
    ]
    for row in summary.itertuples():
        path = finished.results / "unsteady" / str(row.model) / f"k{row.k_star:g}.nc"
        with xr.open_dataset(path) as run:
            assert row.regime == run.attrs["regime"]
            assert row.mean_twist_deg == pytest.approx(run.attrs["mean_twist_deg"], rel=1e-12)


def test_onset_has_a_line_for_each_model(finished: Project) -> None:
    onset = pd.read_csv(finished.results / "comparison" / "onset.csv")
    assert onset["model"].tolist() == list(MODELS)


def test_resolved_config_is_the_run_again_with_every_default(finished: Project) -> None:
    text = (finished.results / "config.resolved.yaml").read_text()
    resolved = yaml.safe_load(text)
    assert load_config(resolved).model_dump(mode="json") == resolved
    assert resolved["steady"]["incidence_deg"] == small()["steady"]["incidence_deg"]
    assert resolved["beam"]["poisson_ratio"] == 0.35


@pytest.mark.parametrize("name", FIGURES)
def test_figures_are_pictures_of_their_format(name: str, finished: Project) -> None:
    folder = finished.results / "figures"
    assert (folder / f"{name}.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    assert (folder / f"{name}.pdf").read_bytes()[:5] == b"%PDF-"
    assert "<svg" in (folder / f"{name}.svg").read_text()[:2000]


@pytest.mark.parametrize("name", NUMBERED)
def test_figure_with_a_number_is_the_one_named_by_what_it_shows(
    name: str, finished: Project
) -> None:
    folder = finished.results / "figures"
    for suffix in ("png", "svg", "pdf"):
        drawn, numbered = (folder / f"{one}.{suffix}" for one in (name, NUMBERED[name]))
        assert drawn.samefile(numbered)


@pytest.fixture(scope="module")
def reported(finished: Project, tmp_path_factory: pytest.TempPathFactory) -> str:
    """Return the report of the run, which is no part of it but is made by name."""
    project = finished.copy(tmp_path_factory.mktemp("report") / "project")
    assert jobs_run(project.run("report_page")) == {"report_page": 1}
    return (project.results / "report.html").read_text()


def test_report_shows_every_figure_and_table_with_its_caption(reported: str) -> None:
    section = r'<(?:figure|section) id="(?:figure|table)-([^"]+)">(.*?)</(?:figure|section)>'
    captions = dict(re.findall(section, reported, re.DOTALL))
    report, paper = ROOT / "workflow/report", ROOT / "workflow/equisection/paper/captions"
    shown = {name: report / "figures" / f"{name}.rst" for name in UNNUMBERED}
    for name, numbered in {"fig01-workflow": "fig01-workflow", **NUMBERED}.items():
        shown[name] = paper / f"{numbered.partition('-')[0]}.rst"
    for name in REPORTED_TABLES:
        place = paper if (paper / f"{name}.rst").exists() else report
        shown[name] = place / f"{name}.rst"
    assert set(captions) == set(shown)
    for name, source in shown.items():
        text = source.read_text()
        words = re.search(r"[A-Za-z]+(?: [A-Za-z]+){2,}", text)
        assert words is not None, f"the caption of {name} has no words"
        assert words.group() in captions[name]


def test_report_begins_with_the_answer_of_the_run(reported: str, finished: Project) -> None:
    parts = dict(answer_of(finished.results).parts())
    for words in (parts["critical speed"], parts["mechanism"], parts["how sure"]):
        assert f"<dd>{words}</dd>" in reported
    assert "All " in reported  # cases have a result


def test_report_has_every_picture_and_table_in_itself(reported: str, finished: Project) -> None:
    pictures = re.findall(r'<img src="data:image/png;base64,([^"]+)"', reported)
    folder = finished.results / "figures"
    assert {base64.b64decode(one) for one in pictures} == {
        (folder / f"{name}.png").read_bytes() for name in FIGURES
    }
    assert not re.search(r'(?:src|href)="(?!data:|#)', reported)
