"""Examples of extensions: their edits fit the project, and the page shows them as they are."""

import subprocess

import pytest
from tests.conftest import ROOT
from tests.extending.changes import CHANGES, FOLDER, Change
from tests.extending.page import MOST, PAGE, with_files

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


def test_every_example_is_a_change() -> None:
    assert {path.name for path in FOLDER.iterdir()} == {change.name for change in CHANGES}


def test_page_shows_the_files_of_both_examples_in_full() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert page == with_files(page), "python -m tests.extending --write"
    for change in CHANGES[:2]:
        for name in (*change.new, "edits.patch"):
            assert f"<!-- {change.name}/{name} -->" in page


def test_page_names_the_files_of_the_others() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for change in CHANGES[2:]:
        section = page.partition(f"`examples/extending/{change.name}`")[2].partition("\n## ")[0]
        rows = [line.split("`")[1] for line in section.splitlines() if line.startswith("| `")]
        files = [*change.new, *change.edited]
        assert len(rows) == len(files)
        assert all(any(name.endswith(row) for name in files) for row in rows)
