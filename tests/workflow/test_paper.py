"""The paper's figures, tables and claims from kept results alone, as `make paper` has them."""

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from matplotlib.image import imread

from equisection.paper.claims_page.__main__ import main
from equisection.paper.mesh_convergence.__main__ import main as over_meshes
from tests.workflow.project import ROOT, Project, jobs_planned


def commands(origin: str) -> list[list[str]]:
    """Return the arguments of Snakemake in `make paper FROM=<origin>`, targets first.

    Figures have one format of the three.
    """
    text = (ROOT / "Makefile").read_text().replace("\\\n", " ")
    variables = dict(re.findall(r"^(PAPER_\w+) := (.*)$", text, flags=re.MULTILINE))
    recipe = text[text.index("\npaper-plate:") : text.index("\npaper-meshes:")]
    chosen = f"{variables[f'PAPER_FROM_{origin}']} figure_formats=[png]"
    recipe = recipe.replace("$(PAPER_FROM_$(FROM))", chosen)
    for run in ("PAPER_PLATE", "PAPER_REDUCTIONS"):
        recipe = recipe.replace(f"$({run})", variables[run])
    found = []
    for line in re.findall(r"\$\(SNAKEMAKE\) (.*)", recipe):
        words = [*shlex.split(line), "--"]
        place = words.index("--")
        found.append([*words[place + 1 : -1], *words[:place]])
    return found


@pytest.mark.parametrize("part", ["paper-figures", "paper-reductions"])
def test_part_that_takes_the_plate_runs_after_it(part: str) -> None:
    """Also where make runs its parts side by side."""
    make = ["make", "--dry-run", "--jobs", "3", "--no-print-directory", part]
    said = subprocess.run(make, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    lines = [line for line in said.splitlines() if "--configfile" in line]
    assert "config/paper/plate.yaml" in lines[0]
    for line in lines[1:]:
        configs = re.findall(r"config/paper/\w+(?:-\w+)?\.yaml", line)
        taken = [yaml.safe_load((ROOT / one).read_text())["sweep"] for one in configs[:1]]
        assert "results/paper-plate-figures/" in taken[0]["taken"]["3d"]
    assert len(lines) > 1


@pytest.fixture(scope="module")
def paper(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The runs of `make paper` in a fresh clone."""
    project = Project.fresh(tmp_path_factory.mktemp("paper") / "project")
    shutil.copytree(ROOT / "results" / "reference", project.folder / "results" / "reference")
    for arguments in commands("kept"):
        project.run(*arguments)
    return project


def test_pages_of_the_claims_and_the_meshes_are_up_to_date(
    paper: Project, capsys: pytest.CaptureFixture[str]
) -> None:
    results = paper.folder / "results"
    reference, table = str(ROOT / "results" / "reference"), str(results / "convergence.csv")
    of_meshes = ["--reference", reference, "--table", table]
    of_meshes += ["--page", str(ROOT / "docs" / "mesh-convergence.md"), "--check"]
    assert over_meshes(of_meshes) == 0, capsys.readouterr().err
    arguments = ["--figures", str(results / "paper-figures")]
    arguments += ["--plate", str(results / "paper-plate-figures")]
    arguments += ["--reductions", str(results / "paper-reductions")]
    arguments += ["--reference", reference, "--convergence", table]
    ended = main([*arguments, "--page", str(ROOT / "docs" / "side-by-side.md"), "--check"])
    assert ended == 0, capsys.readouterr().err


def test_picture_of_the_readme_is_up_to_date(paper: Project) -> None:
    """But for what another version of FreeType makes of the letters."""
    drawn = imread(paper.folder / "results/paper-figures/figures/fig16-response.png")
    shown = imread(ROOT / "docs" / "fig16-response.png")
    assert drawn.shape == shown.shape, "make paper"
    differ = np.abs(drawn - shown).max(axis=-1) > 0.1
    assert differ.mean() < 2e-3, "make paper"


def test_every_figure_is_drawn_and_nothing_is_computed(paper: Project) -> None:
    results = paper.folder / "results"
    drawn = {path.stem[:5] for path in results.glob("paper-*/figures/*.png")}
    numbers = (1, 3, *range(5, 18))  # Figs. 2 and 4 are sketches
    assert {f"fig{number:02}" for number in numbers} <= drawn
    for run in ("paper-reductions", "paper-reductions-modal"):
        table = pd.read_csv(results / run / "comparison" / "section_and_beam.csv")
        # at each k* of the six that section and beam both have a verdict of
        summary = pd.read_csv(results / run / "comparison" / "summary.csv")
        judged = summary[summary["regime"] != "undecided"]
        of_beam = judged.loc[judged["model"] == "3d", "k_star"]
        wanted = judged[(judged["model"] != "3d") & judged["k_star"].isin(of_beam)]
        assert len(summary[summary["model"] != "3d"]) == 6 * table["model"].nunique() > 0
        assert sorted(zip(table["model"], table["k_star"], strict=True)) == sorted(
            zip(wanted["model"], wanted["k_star"], strict=True)
        )
        assert (results / run / "figures" / "section-and-beam.png").exists()
    assert not (results / ".store").exists()


@pytest.mark.parametrize("name", ["table1", "table2", "bubble", "grid_study"])
def test_every_table_is_there(name: str, paper: Project) -> None:
    assert list((paper.folder / "results").glob(f"paper-*/tables/{name}.csv"))


def test_from_scratch_every_case_is_to_be_computed(paper: Project) -> None:
    planned = [jobs_planned(paper.run(*words, "-n")) for words in commands("scratch")]
    plate, section, both, modal = planned
    assert plate["steady_case"] >= 4
    assert plate["unsteady_case"] >= 6
    assert section["unsteady_case"] >= 20
    assert both["unsteady_case"] >= 24
    assert modal["unsteady_case"] >= 12
    assert section["steady_batch"] == section["unsteady_batch"] == 0


def test_what_is_missing_is_named(paper: Project) -> None:
    missing = Path(paper.folder / "results/paper-figures/comparison/missing.csv").read_text()
    for line in missing.splitlines()[1:]:
        assert "results/reference" in line
