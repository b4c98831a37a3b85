"""The page on Python says what its example prints and draws."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import equisection as eq

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/python.md").read_text(encoding="utf-8")
EXAMPLE = ROOT / "docs/examples/critical_speed.py"


def test_the_example_runs_and_the_page_has_its_output(tmp_path: Path) -> None:
    (tmp_path / "config").symlink_to(ROOT / "config")
    ran = subprocess.run(
        [sys.executable, EXAMPLE],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    shown = re.search(r"\$ python docs/examples/critical_speed\.py\n(.*?)```", PAGE, flags=re.S)
    assert shown is not None
    assert ran.stdout == shown[1]
    assert (tmp_path / "critical-speed.png").stat().st_size > 10_000


def test_code_of_the_page_is_that_of_the_example() -> None:
    code = re.search(r"```python\n(import equisection.*?)```", PAGE, flags=re.S)
    assert code is not None
    example = EXAMPLE.read_text(encoding="utf-8")
    for line in filter(None, code[1].splitlines()):
        assert line in example


def test_the_parameter_study_prints_what_the_page_says(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    part = PAGE.split("## A parameter study")[1]
    code, printed = re.findall(r"```(?:python)?\n(.*?)```", part, flags=re.S)[:2]
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(ROOT)
    exec(code, {"eq": eq})
    assert capsys.readouterr().out == printed
