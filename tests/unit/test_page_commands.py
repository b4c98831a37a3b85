"""Commands of the benchmarks on the pages: they are there, can run, and say what they lack."""

import re
import runpy
import sys
from pathlib import Path

import pytest
from tests.benchmarks.__main__ import BENCHMARKS

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").glob("*.md"))
#: Commands that read results that are not there, with the words of what is.
LACKING = (
    ("courant", "none.nc"),
    ("kicks", "none"),
    ("coefficients", "none.nc"),
    ("judged", "none.nc"),
    ("energy", "none.nc"),
    ("energy", "--surplus", "none.nc"),
    ("independence", "--of", "none.nc"),
    ("sections_for_plate",),
)


def ran(monkeypatch: pytest.MonkeyPatch, *words: str) -> None:
    monkeypatch.setattr(sys, "argv", list(words))
    runpy.run_module(f"tests.benchmarks.{words[0]}", run_name="__main__")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_benchmarks_of_a_page_are_there(page: Path) -> None:
    text = page.read_text()
    modules = re.findall(r"python -m tests\.benchmarks\.(\w+)", text)
    assert [one for one in modules if not (ROOT / f"tests/benchmarks/{one}.py").is_file()] == []
    assert set(re.findall(r"python -m tests\.benchmarks ([\w-]+)", text)) <= set(BENCHMARKS)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_modules_of_the_project_are_run_in_its_folder(page: Path) -> None:
    blocks = re.findall(r"^```\n(.*?)^```", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    assert [one for one in blocks if re.search(r"^cd .*python -m tests", one, re.M | re.S)] == []


@pytest.mark.parametrize("words", LACKING, ids=" ".join)
def test_what_is_not_there_is_said_in_a_line(
    words: tuple[str, ...], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        ran(monkeypatch, *words)
    said = str(ended.value)
    assert said.startswith("error: ")
    assert "; first: " in said
    assert "\n" not in said


def test_derivatives_of_the_thin_plate_are_those_of_the_page(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ran(monkeypatch, "thin_plate")
    said = capsys.readouterr().out
    page = (ROOT / "docs" / "derivatives.md").read_text()
    rows = re.findall(r"^\| (\w+ by \w+), [HA]\d, [HA]\d \|(.*)\|$", page, flags=re.MULTILINE)
    assert len(rows) == 4
    for load, cells in rows:
        numbers = " ".join(cells.replace("|", " ").split())
        assert f"{load}, off by % of its size: {numbers}\n" in said


def test_fields_of_the_kept_plate_are_read_without_a_run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    ran(monkeypatch, "plate_fields")
    assert "x/c 0.50: k 0.047 V^2, across the stream 0.27 V" in capsys.readouterr().out
