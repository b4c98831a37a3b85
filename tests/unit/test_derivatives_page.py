"""The page on derivatives says what its example prints, and its table is Theodorsen's."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from tests.conftest import ROOT

from equisection.aerodynamics.derivatives import Derivatives

PAGE = (ROOT / "docs/derivatives.md").read_text(encoding="utf-8")
EXAMPLE = "docs/examples/derivatives.py"
TABLE = "config/derivatives/thin_plate.csv"


def test_the_example_prints_what_the_page_has() -> None:
    ran = subprocess.run(
        [sys.executable, EXAMPLE], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    shown = re.search(rf"\$ python {EXAMPLE}\n(.*?)```", PAGE, flags=re.S)
    assert shown is not None
    assert ran.stdout == shown[1]


def test_table_of_the_thin_plate_is_theodorsens_and_on_the_page() -> None:
    table = Derivatives.read(ROOT / TABLE)
    exact = Derivatives.theodorsen(table.reduced_velocity)
    assert table.values == pytest.approx(exact.values, rel=1e-6, abs=1e-7)
    last = (ROOT / TABLE).read_text(encoding="utf-8").splitlines()[7]
    assert last in PAGE
