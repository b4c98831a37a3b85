"""A run from kept results alone, and one that takes a model from another run."""

import shutil
from pathlib import Path

import pandas as pd
import pytest

from equisection.run.status import run_status
from tests.workflow.project import Project, has_nothing_to_do, small

TARGETS = (
    "results/shown/comparison/missing.csv",
    "results/shown/comparison/onset.csv",
    "results/shown/figures/fig16-response.png",
    "results/shown/figures/modal-contributions.png",
)


@pytest.fixture(scope="module")
def shown(finished: Project, tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The finished run's results, kept but for four, and a run that has nothing else."""
    project = finished.copy(tmp_path_factory.mktemp("kept") / "project")
    kept = project.results.rename(project.folder / "kept") / "unsteady"
    for path in (kept / "2d" / "k6.nc", *(kept / "2d-corrected").glob("*.nc")):
        path.unlink()
    project.config = small(
        run="shown",
        compute=False,
        reuse="kept",
        sweep={"models": ["2d", "2d-corrected"], "taken": {"3d": "kept/unsteady/3d/sweep.json"}},
    )
    project.run(*TARGETS)
    return project


def test_what_is_not_kept_is_named_and_left_out(shown: Project) -> None:
    missing = pd.read_csv(shown.results / "comparison" / "missing.csv")
    names = set(missing[["model", "case"]].itertuples(index=False, name=None))
    corrected = {("2d-corrected", name) for name in ("k6", "k10", "k21")}
    assert names == {("2d", "k6"), *corrected}
    assert missing["reason"].str.contains("kept").all()
    said = {
        (one.model, one.case): one.text for one in run_status(shown.results).entries if one.text
    }
    of_missing = missing.set_index(["model", "case"])["reason"].to_dict()
    assert of_missing.items() <= said.items(), "status and report say why, too"


def test_everything_else_is_there_with_the_model_that_is_taken(shown: Project) -> None:
    summary = pd.read_csv(shown.results / "comparison" / "summary.csv")
    runs = summary.groupby("model")["k_star"].apply(list).to_dict()
    assert runs == {"2d": [10, 21], "3d": [6, 10, 21]}
    onset = pd.read_csv(shown.results / "comparison" / "onset.csv")
    assert onset["model"].tolist() == ["2d", "3d"]


def test_nothing_was_computed_or_put_into_the_store(shown: Project, finished: Project) -> None:
    def stored(project: Project) -> set[str]:
        return {path.name for path in (project.folder / "results" / ".store").iterdir()}

    assert stored(shown) == stored(finished)
    assert not list((shown.results / "logs").glob("*.progress.json"))


def test_there_is_nothing_to_do_until_more_is_kept(
    shown: Project, finished: Project, tmp_path: Path
) -> None:
    assert has_nothing_to_do(shown.run(*TARGETS))
    project = shown.copy(tmp_path / "project")
    later = finished.results / "unsteady" / "2d" / "k6.nc"
    shutil.copy(later, project.folder / "kept" / "unsteady" / "2d")
    project.run(TARGETS[0])
    missing = pd.read_csv(project.results / "comparison" / "missing.csv")
    assert set(missing["model"]) == {"2d-corrected"}
