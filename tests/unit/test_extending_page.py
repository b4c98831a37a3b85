"""Examples of extensions: their edits fit the project, and the page shows them as they are."""

import subprocess

import pytest
from tests.conftest import ROOT
from tests.extending.changes import CHANGES, FOLDER, Change
from tests.extending.page import IN_FULL, MOST, PAGE, with_files

each = pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.name)


@each
def test_edits_fit_the_project(change: Change) -> None:
    command = ("git", "apply", "--check", str(change.patch))
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    assert [name for name in change.new if (ROOT / name).exists()] == []


@each
def test_a_change_has_a_test_and_few_files(change: Change) -> None:
    assert [name for name in change.new if name.startswith("tests/")]
    assert len(change.new) + len(change.edited) <= MOST


def test_a_figure_takes_at_most_four_files() -> None:
    (figure,) = (change for change in CHANGES if change.name == "figure")
    assert len(figure.new) + len(figure.edited) <= 4


def test_every_example_is_a_change() -> None:
    assert {path.name for path in FOLDER.iterdir()} == {change.name for change in CHANGES}


@pytest.mark.parametrize("name", IN_FULL)
def test_page_in_full_shows_every_file_of_its_change(name: str) -> None:
    page = IN_FULL[name].read_text(encoding="utf-8")
    assert page == with_files(page), "python -m tests.extending --write"
    (change,) = (change for change in CHANGES if change.name == name)
    for file in (*change.new, "edits.patch"):
        assert f"<!-- {name}/{file} -->" in page


def test_page_names_the_files_of_the_others() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for change in CHANGES:
        if change.name in IN_FULL:
            continue
        section = page.partition(f"`examples/extending/{change.name}`")[2].partition("\n## ")[0]
        rows = [line.split("`")[1] for line in section.splitlines() if line.startswith("| `")]
        files = [*change.new, *change.edited]
        assert len(rows) == len(files)
        assert all(any(name.endswith(row) for name in files) for row in rows)
