"""Profile coefficients of HAWC2 are read like every other polar."""

from pathlib import Path

import numpy as np
import pytest

import equisection as eq
from equisection.config import load_config
from equisection.errors import ConfigError, PolarFileError
from equisection.study.given_polars import check_polars

#: A thin plate: c_l = 2 pi alpha, and no moment about the quarter chord.
TABLE = """1 set of a thin plate
1
1 5 0.5
  -10.000   -1.0966   0.0000   0.0000
   -5.000   -0.5483   0.0000   0.0000
    0.000    0.0000   0.0000   0.0000
    5.000    0.5483   0.0000   0.0000
   10.000    1.0966   0.0000   0.0000
"""


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "plate_pc.dat"
    path.write_text(TABLE)
    return path


def test_moment_is_moved_from_the_quarter_chord(table: Path) -> None:
    """Of a lift at a quarter of the chord c_m = c_n/4 about mid-chord (thin-airfoil theory)."""
    polar = eq.Polar.read(table)
    alpha = np.radians([-10.0, -5.0, 0.0, 5.0, 10.0])
    np.testing.assert_allclose(polar.lift, 2 * np.pi * alpha, atol=1e-4)
    np.testing.assert_allclose(polar.moment, 0.25 * polar.lift * np.cos(alpha), rtol=1e-12)


def test_configuration_names_it(table: Path) -> None:
    raw = {
        "embedded": {"polars": {"plate": str(table)}, "symmetric": False},
        "steady": {"resolution": "plate", "incidence_deg": [-5.0, 0.0, 2.5, 5.0]},
    }
    check_polars(load_config(raw))
    table.write_text(TABLE.replace("5.000    0.5483", "5.000    high"))
    with pytest.raises(ConfigError, match=r"embedded\.polars\.plate: .*: line 7: Cl is 'high'"):
        check_polars(load_config(raw))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("1 set", "2 set", r"line 1: 2 sets; wanted one"),
        ("1 5 0.5", "1 9 0.5", r"line 3: 9 rows are announced, and 5 follow"),
        ("1 5 0.5", "1 x 0.5", r"line 3: number of rows is 'x'"),
        ("0.5483   0.0000   0.0000", "0.5483", r"line 5: 2 values; wanted alpha, Cl, Cd and Cm"),
    ],
)
def test_refusal_names_file_and_line(table: Path, old: str, new: str, words: str) -> None:
    table.write_text(TABLE.replace(old, new, 1))
    with pytest.raises(PolarFileError, match=rf"plate_pc\.dat, {words}"):
        eq.Polar.read(table)
