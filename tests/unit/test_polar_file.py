"""Polar files: what is read, and that every refusal names file, line and remedy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from equisection.errors import PolarFileError
from equisection.io.polar_file import read_polar

POLARS = Path(__file__).parents[2] / "config" / "polars"
HEADER = "incidence_deg,cl,cm,cd\n"
POINTS = "0,0,0,0.04\n1,0.17,0.03,0.05\n2,0.34,0.06,0.06\n4,0.6,0.06,0.08\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "section.csv"
    path.write_text(text)
    return path


def test_reads_comments_other_columns_any_order_and_mirrors(tmp_path: Path) -> None:
    text = "# made by hand\n\ncd, CL ,note,cm,incidence_deg\n"
    text += "0.04,0,a,0,0\n# half way\n0.05,.17,,.03,1\n.06,.34,b,.06,2\n.08,.6,c,.06,4\n"
    polar = read_polar(write(tmp_path, text))
    assert polar.label == "section"
    assert np.degrees(polar.incidence) == pytest.approx([-4, -2, -1, 0, 1, 2, 4])
    assert polar.lift[-1] == 0.6
    assert polar.moment[0] == -0.06
    assert polar.drag[3] == 0.04


def test_whole_polar_is_taken_as_it_is(tmp_path: Path) -> None:
    text = HEADER + "-2,-.1,0,.05\n0,.1,.01,.04\n2,.3,.02,.05\n3,.4,.02,.06\n"
    polar = read_polar(write(tmp_path, text), symmetric=False)
    assert np.degrees(polar.incidence) == pytest.approx([-2, 0, 2, 3])
    assert float(polar.lift_coefficient(0.0)) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"line 1: the file is empty"),
        ("# only this\n\n", r"line 1: the file is empty"),
        ("# c\nincidence_deg,cl,Cd\n", r"line 2: no column cm; found incidence_deg, cl, cd"),
        ("alpha,lift\n", r"line 1: no column incidence_deg, cl, cm, cd; found alpha, lift"),
        ("incidence_deg;cl;cm;cd\n0;0,1;0;0\n", r"line 1: .*separated by commas, with a point"),
        (HEADER, r"0 points; 4 or more"),
        (HEADER + "0,0,0,0\n1,1,1,1\n2,1,1,1\n", r"line 4: .* 3 points; 4 or more"),
        (HEADER + "#\n" + POINTS + "3,.6,.1,.1\n", r"line 7: .* 3 is below the 4 of line 6"),
        (HEADER + POINTS + "4,.6,.1,.1\n", r"line 6: .* 4 repeats the 4 of line 5"),
        (HEADER + POINTS + "5,nan,.1,.1\n", r"line 6: cl is 'nan'; wanted a finite number"),
        (HEADER + POINTS + "5,.6,inf,.1\n", r"line 6: cm is 'inf'"),
        (HEADER + POINTS + "5,.6,.1,high\n", r"line 6: cd is 'high'"),
        (HEADER + POINTS + "5,.6,.1,\n", r"line 6: cd is ''"),
        (HEADER + POINTS + "5,.6,.1\n", r"line 6: 3 values under 4 column names"),
        (HEADER + "-1,-.1,0,0\n" + POINTS, r"line 2: incidence_deg -1 .* symmetric"),
        (HEADER + POINTS[len("0,0,0,0.04\n") :] + "5,.7,.1,.1\n", r"line 2: .* starts at .* 1"),
        (HEADER + "0,.02" + POINTS[3:], r"line 2: cl is 0.02 at 0 deg"),
        (HEADER + "0,0,-.02" + POINTS[5:], r"line 2: cm is -0.02 at 0 deg"),
    ],
)
def test_refusal_names_file_and_line(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(PolarFileError, match=r"section\.csv.*" + words):
        read_polar(write(tmp_path, text))


def test_missing_file_and_folder_are_named(tmp_path: Path) -> None:
    with pytest.raises(PolarFileError, match=r"none\.csv: no such polar file"):
        read_polar(tmp_path / "none.csv")
    with pytest.raises(PolarFileError, match="cannot be read"):
        read_polar(tmp_path)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(PolarFileError, match="cannot be read"):
        read_polar(tmp_path / "binary.csv")


def test_polars_of_the_plate_are_read() -> None:
    section = read_polar(POLARS / "plate_2d_11136.csv")
    assert np.degrees(section.incidence_range) == pytest.approx((-12, 12))
    assert float(section.lift_coefficient(np.radians(3))) == pytest.approx(0.45675, abs=1e-6)
    beam = read_polar(POLARS / "paper_plate_3d.csv")
    assert float(beam.moment_coefficient(np.radians(2.5))) == pytest.approx(0.0602, abs=1e-6)
