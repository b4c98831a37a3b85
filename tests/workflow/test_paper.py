"""The paper's figures, tables and claims from kept results alone, as `make paper` has them."""

import re
import shutil
from pathlib import Path

import pytest

from equisection.comparison.side_by_side import main
from tests.workflow.project import ROOT, Project


@pytest.fixture(scope="module")
def paper(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The runs of `make paper` in a fresh clone that has no solver to start."""
    project = Project.fresh(tmp_path_factory.mktemp("paper") / "project")
    shutil.copytree(ROOT / "results" / "reference", project.folder / "results" / "reference")
    text = (ROOT / "Makefile").read_text().replace("\\\n", " ")
    recipe = text[text.index("\npaper:") :].split("\n\n")[0]
    plate = re.search(r"^PAPER_PLATE := (\S+)$", text, flags=re.MULTILINE)
    assert plate is not None
    commands = re.findall(r"\$\(SNAKEMAKE\) (.*)", recipe)
    assert len(commands) == 2
    for command in commands:
        words = command.replace("$(PAPER_PLATE)", plate[1]).replace("$(PAPER)", "compute=false")
        options, _, targets = " ".join(words.split()).partition(" -- ")
        project.run(*targets.split(), *options.split())
    return project


def test_page_of_the_claims_is_up_to_date(
    paper: Project, capsys: pytest.CaptureFixture[str]
) -> None:
    results = paper.folder / "results"
    arguments = ["--figures", str(results / "paper-figures")]
    arguments += ["--plate", str(results / "paper-plate-figures")]
    arguments += ["--reference", str(ROOT / "results" / "reference")]
    ended = main([*arguments, "--page", str(ROOT / "docs" / "side-by-side.md"), "--check"])
    assert ended == 0, capsys.readouterr().err


def test_every_figure_is_drawn_and_nothing_is_computed(paper: Project) -> None:
    results = paper.folder / "results"
    drawn = {path.stem[:5] for path in results.glob("paper-*/figures/*.png")}
    numbers = (1, 3, 5, 6, 7, 8, 10, 13, 14, 15, 16, 17)
    assert {f"fig{number:02}" for number in numbers} <= drawn
    assert not (results / ".store").exists()


@pytest.mark.parametrize("name", ["table1", "table2", "bubble", "grid_study"])
def test_every_table_is_there(name: str, paper: Project) -> None:
    assert list((paper.folder / "results").glob(f"paper-*/tables/{name}.csv"))


def test_what_is_missing_is_named(paper: Project) -> None:
    missing = Path(paper.folder / "results/paper-figures/comparison/missing.csv").read_text()
    for line in missing.splitlines()[1:]:
        assert "results/reference" in line
