"""Airfoil tables of AeroDyn are read like every other polar."""

from pathlib import Path

import numpy as np
import pytest

import equisection as eq
from equisection.config import load_config
from equisection.errors import ConfigError, PolarFileError
from equisection.study.given_polars import check_polars

#: A thin plate: c_l = 2 pi alpha, and no moment about the quarter chord.
TABLE = """! ------------ AirfoilInfo Input File ----------------------------------
"DEFAULT"     InterpOrd         ! Interpolation order
          1   NumTabs           ! Number of airfoil tables
       0.05   Re                ! Reynolds number in millions
False         InclUAdata        ! Is unsteady aerodynamics data included
          5   NumAlf            ! Number of data lines in the following table
!    Alpha      Cl      Cd        Cm
!    (deg)      (-)     (-)       (-)
  -10.000   -1.0966   0.0000   0.0000
   -5.000   -0.5483   0.0000   0.0000
    0.000    0.0000   0.0000   0.0000
    5.000    0.5483   0.0000   0.0000
   10.000    1.0966   0.0000   0.0000
        0.1   Re                ! the table of another Reynolds number
"""


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "plate.dat"
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
    with pytest.raises(ConfigError, match=r"embedded\.polars\.plate: .*: line 12: Cl is 'high'"):
        check_polars(load_config(raw))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("5   NumAlf", "9   NumAlf", r"line 6: NumAlf is 9, and 6 rows follow"),
        ("5   NumAlf", "x   NumAlf", r"line 6: NumAlf is 'x'"),
        ("0.5483   0.0000   0.0000", "0.5483", r"line 10: 2 values; wanted alpha, Cl, Cd and Cm"),
    ],
)
def test_refusal_names_file_and_line(table: Path, old: str, new: str, words: str) -> None:
    table.write_text(TABLE.replace(old, new, 1))
    with pytest.raises(PolarFileError, match=rf"plate\.dat, {words}"):
        eq.Polar.read(table)
