"""Polars that a configuration names are looked into before any job starts."""

import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from equisection.config import load_config
from equisection.errors import ConfigError
from equisection.study.given_polars import check_polars

ROOT = Path(__file__).parents[2]
#: A time step that OpenFOAM takes.
STEP = {"time_step": 0.02}
GOOD = "incidence_deg,cl,cm,cd\n0,0,0,0.04\n2,0.3,0.06,0.05\n4,0.5,0.08,0.08\n8,0.6,0.06,0.14\n"


def lines_of(raw: dict[str, Any], directory: Path) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        check_polars(load_config(raw), directory)
    return str(caught.value).splitlines()


def test_a_broken_polar_is_named_by_its_key_and_line(tmp_path: Path) -> None:
    (tmp_path / "own.csv").write_text(GOOD.replace("0.3,", "much,"))
    (line,) = lines_of({"embedded": {"polars": {"coarse": "own.csv"}}}, tmp_path)
    assert line.startswith("config: embedded.polars.coarse: 'own.csv': line 3: cl is 'much'")


def test_a_broken_polar_of_the_beam_is_named_whatever_the_solver(tmp_path: Path) -> None:
    (tmp_path / "beam.csv").write_text("# nothing\n")
    raw = {"solver": "openfoam", "unsteady": STEP, "steady": {"beam_polar": "beam.csv"}}
    (line,) = lines_of(raw, tmp_path)
    assert line.startswith("config: steady.beam_polar: 'beam.csv': line 1: the file is empty")


@pytest.mark.parametrize("symmetric", [True, False])
def test_a_polar_without_the_runs_incidence_is_refused(tmp_path: Path, symmetric: bool) -> None:
    """Such as one in radians: each of its cases would fail."""
    text = re.sub(
        r"^[248],", lambda degrees: f"{math.radians(int(degrees[0][0])):.3f},", GOOD, flags=re.M
    )
    (tmp_path / "own.csv").write_text(text)
    raw: dict[str, Any] = {"embedded": {"polars": {"coarse": "own.csv"}, "symmetric": symmetric}}
    (line,) = lines_of(raw, tmp_path)
    first = -0.14 if symmetric else 0
    assert line == (
        f"config: flow.incidence_deg: 2.5: allowed is {first:g} to 0.14 deg, what own.csv covers "
        "(is it in degrees?)"
    )


def test_polars_of_another_solver_are_left_alone(tmp_path: Path) -> None:
    check_polars(load_config({"solver": "openfoam", "unsteady": STEP}), tmp_path)
    check_polars(load_config({}), ROOT)


def test_looking_at_polars_loads_no_numerics() -> None:
    code = "import sys, equisection.study.given_polars; print('scipy' in sys.modules)"
    said = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    assert said.strip() == "False"
