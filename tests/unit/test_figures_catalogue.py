"""The catalogue of figures: what stands in it is there, and no more than that is loaded."""

import importlib
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from equisection.config import Config, load_config, resolve_config
from equisection.figures import catalogue
from equisection.figures.__main__ import COMMAND, PAGE, main, page_text
from equisection.figures.catalogue import CATALOGUE, Entry, RunFiles

REPORT = Path(__file__).parents[2] / "workflow" / "report"
MODULES = Path(catalogue.__file__).parent

each = pytest.mark.parametrize("entry", CATALOGUE, ids=lambda entry: entry.name)


def names(raw: dict[str, Any]) -> set[str]:
    return {entry.name for entry in catalogue.figures(load_config(raw))}


@each
def test_figure_is_drawn_from_what_its_entry_gives(entry: Entry) -> None:
    module = importlib.import_module(f"equisection.figures.{entry.module}")
    given = list(inspect.signature(module.from_files).parameters)
    assert sorted(given) == sorted([*entry.inputs, *entry.keys])


@each
def test_figure_has_a_caption_without_a_number(entry: Entry) -> None:
    caption = (REPORT / "figures" / f"{entry.name}.rst").read_text()
    assert "Fig." not in caption
    assert "paper" not in caption
    assert "Eq." not in caption
    assert "three-dimensional plate" not in caption


@each
def test_keys_of_a_figure_are_keys_of_the_configuration(entry: Entry) -> None:
    values = entry.values(resolve_config(Config()))
    assert set(values) == set(entry.keys)


def test_list_of_figures_in_the_documentation_is_that_of_the_catalogue(
    capsys: pytest.CaptureFixture[str],
) -> None:
    status = main(["--check"])
    assert status == 0, capsys.readouterr().out + f"\nto mend it: {COMMAND}"


def test_page_without_the_marks_of_the_list_is_refused() -> None:
    with pytest.raises(ValueError, match=f"{PAGE}: one of the lines"):
        page_text("# A page\n")


def test_module_that_draws_from_files_is_in_the_catalogue() -> None:
    drawing = {
        path.stem for path in MODULES.glob("*.py") if "\ndef from_files(" in path.read_text()
    }
    assert drawing == {entry.module for entry in CATALOGUE}


def test_captions_are_those_of_figures() -> None:
    captions = {path.stem for path in (REPORT / "figures").glob("*.rst")}
    assert captions == {entry.name for entry in CATALOGUE}


def test_figures_of_a_job_mean_the_same_by_a_name() -> None:
    for entries in catalogue.figures_by_job(Config()).values():
        for entry in entries:
            for other in entries:
                assert all(
                    other.inputs.get(name, source) == source
                    for name, source in entry.inputs.items()
                )
                assert all(other.keys.get(name, key) == key for name, key in entry.keys.items())


def test_a_family_is_drawn_in_one_job_where_the_solver_takes_many_cases() -> None:
    """Elsewhere each figure waits for its own files alone: those of the beam take days."""
    raw = {"solver": "openfoam", "sweep": {"models": ["2d"]}, "unsteady": {"time_step": 0.02}}
    together = catalogue.figures_by_job(Config())
    alone = catalogue.figures_by_job(load_config(raw))
    of_loads = [entry.name for entry in together["figures_of_loads"]]
    assert {"section-polar", "spanwise-loads", "lift-correction"} <= set(of_loads)
    assert not {"mode_shapes", "section_polar", "spanwise_loads"} & set(together)
    assert [entry.name for entry in alone["section_polar"]] == ["section-polar"]
    assert not {entry.family for entry in CATALOGUE} & set(alone) - {""}


def test_files_are_those_of_the_run_and_of_the_runs_that_it_takes() -> None:
    taken = "results/other/unsteady/3d/sweep.json"
    config = load_config({"sweep": {"models": ["2d"], "taken": {"3d": taken}}})
    files = catalogue.entry_of("response").files(RunFiles(config, "somewhere"))
    assert files["summary"] == "somewhere/comparison/summary.csv"
    assert files["indices"] == ["somewhere/unsteady/2d/sweep.json", taken]


def test_references_go_to_the_figures_that_draw_them() -> None:
    files = catalogue.entry_of("growth-rate").files(RunFiles(Config(), "somewhere", ["stated.csv"]))
    assert files["references"] == ["stated.csv"]


@pytest.mark.parametrize(
    ("models", "wanted", "unwanted"),
    [
        (["3d"], "modal-contributions", "hysteresis"),
        (["2d-paper"], "hysteresis", "modal-contributions"),
    ],
)
def test_figures_of_a_dimension_are_drawn_only_with_a_model_of_it(
    models: list[str], wanted: str, unwanted: str
) -> None:
    drawn = names({"sweep": {"models": models}})
    assert wanted in drawn
    assert unwanted not in drawn


def test_surface_is_shown_where_the_solver_has_it() -> None:
    assert "surface-loads" not in names({})
    raw = {"solver": "openfoam", "sweep": {"models": ["2d"]}, "unsteady": {"time_step": 0.02}}
    assert "surface-loads" in names(raw)


def test_mesh_surface_and_flow_of_the_beam_are_shown_where_the_solver_runs_it() -> None:
    of_beam = {"mesh-of-beam", "surface-of-beam", "flow-at-tip"}
    assert not of_beam & names({})
    raw: dict[str, Any] = {"solver": "openfoam", "unsteady": {"time_step": 0.02}}
    raw["sweep"] = {"models": ["2d"]}
    assert of_beam <= names(raw)
    raw["steady"] = {"beam_polar": "polar.csv"}
    assert not of_beam & names(raw)


def test_catalogue_loads_no_figure() -> None:
    """It is read at every start of Snakemake."""
    asks = (
        "import sys; from equisection.figures.catalogue import CATALOGUE;"
        "print(sorted(name for name in sys.modules if name.startswith('matplotlib')))"
    )
    said = subprocess.run([sys.executable, "-c", asks], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "[]"
