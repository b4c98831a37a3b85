"""The smallest sweeps that a configuration allows run to their last figure."""

import pandas as pd
import pytest

from tests.workflow.project import Project, small


@pytest.mark.parametrize("model", ["2d", "3d"])
def test_one_k_star_of_one_model_with_a_name_of_its_own(model: str, project: Project) -> None:
    project.config = small(sweep={"models": ["2d", "2d-corrected", "3d"]})
    # the command line has the last word over the file
    override = ("--config", "run=panel-2_b.1", f"sweep={{models: [{model}], k_star: [21.0]}}")
    project.run(*override)
    project.config["run"] = "panel-2_b.1"
    summary = pd.read_csv(project.results / "comparison" / "summary.csv")
    assert summary[["model", "k_star"]].values.tolist() == [[model, 21.0]]
    onset = pd.read_csv(project.results / "comparison" / "onset.csv")
    assert pd.isna(onset.loc[0, "k_star_unstable"])
    figures = {path.stem for path in (project.results / "figures").glob("*.png")}
    assert "fig16-response" in figures
    assert ("fig15-modal-contributions" in figures) == (model == "3d")
    assert ("fig17-hysteresis" in figures) == (model == "2d")
