"""Polar files: what is read, and that every refusal names file, line and remedy."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from equisection.aerodynamics.polar import Polar
from equisection.errors import PolarFileError

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
    polar = Polar.read(write(tmp_path, text))
    assert polar.label == "section"
    assert np.degrees(polar.incidence) == pytest.approx([-4, -2, -1, 0, 1, 2, 4])
    assert polar.lift[-1] == 0.6
    assert polar.moment[0] == -0.06
    assert polar.drag[3] == 0.04


def test_whole_polar_is_taken_as_it_is(tmp_path: Path) -> None:
    text = HEADER + "-2,-.1,0,.05\n0,.1,.01,.04\n2,.3,.02,.05\n3,.4,.02,.06\n"
    polar = Polar.read(write(tmp_path, text), symmetric=False)
    assert np.degrees(polar.incidence) == pytest.approx([-2, 0, 2, 3])
    assert float(polar.lift_coefficient(0.0)) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"line 1: the file is empty"),
        ("# only this\n\n", r"line 1: the file is empty"),
        ("# c\nincidence_deg,cl,Cd\n", r"line 2: no column cm; found incidence_deg, cl, Cd"),
        ("alpha,lift\n", r"line 1: no column cl, cm, cd; found alpha, lift"),
        ("incidence_deg;cl;cm;cd\n0;0,1;0;0\n", r"line 2: .* 1 points; 4 or more"),
        ("incidence_deg,cl,C_L,cm,cd\n" + POINTS, r"line 1: more than one column is cl; found "),
        ("incidence_deg,cl,cm,cd,CD,cm\n" + POINTS, r"line 1: more than one column is cm, cd;"),
        (HEADER, r"0 points; 4 or more"),
        (HEADER + "0,0,0,0\n1,1,1,1\n2,1,1,1\n", r"line 4: .* 3 points; 4 or more"),
        (
            HEADER + "#\n" + POINTS + "3,.6,.1,.1\n",
            r"line 7: .* 3 goes back after the angles from 0 to 4",
        ),
        (HEADER + POINTS + "4,.6,.1,.1\n", r"line 6: .* 4 repeats that of line 5 with"),
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
        Polar.read(write(tmp_path, text), symmetric=True)


@pytest.mark.parametrize(
    ("points", "mirrored"),
    [
        (POINTS, True),
        ("-2,-.1,0,.05\n" + POINTS, False),
        ("-2,-.1,0,.05\n-1,-.1,0,.05\n1,.1,0,.05\n2,.3,0,.05\n", False),
    ],
)
def test_the_file_tells_a_half_polar_by_its_first_angle(
    tmp_path: Path, points: str, mirrored: bool
) -> None:
    path = write(tmp_path, HEADER + points)
    polar = Polar.read(path, moment_axis=0.5)
    said = Polar.read(path, symmetric=mirrored, moment_axis=0.5)
    np.testing.assert_array_equal(polar.incidence, said.incidence)
    np.testing.assert_array_equal(polar.moment, said.moment)
    assert (polar.incidence[0] == -polar.incidence[-1] and polar.lift[0] == -0.6) == mirrored


@pytest.mark.parametrize(
    ("first", "words"),
    [("0,.1,.01,.04", "cl 0.1, cm 0.01"), (".5,.1,0,.04", r"incidence_deg 0\.5")],
)
def test_a_polar_that_may_be_half_or_whole_is_refused(
    tmp_path: Path, first: str, words: str
) -> None:
    path = write(tmp_path, HEADER + first + POINTS[len("0,0,0,0.04") :])
    with pytest.raises(PolarFileError, match=f"line 2: no negative incidence.*{words}.*=False"):
        Polar.read(path)
    assert Polar.read(path, symmetric=False).incidence.size == 4


def test_moment_about_the_quarter_chord_of_a_thin_plate_is_none(tmp_path: Path) -> None:
    """The lift acts there, so about mid-chord c_m is a quarter of what is normal to the chord."""
    angles = np.arange(-8.0, 9.0, 2.0)
    alpha = np.radians(angles)
    normal = 2 * np.pi * np.sin(alpha)
    columns = np.transpose([angles, normal * np.cos(alpha), 0 * alpha, normal * np.sin(alpha)])
    rows = "".join(",".join(f"{value:.17g}" for value in row) + "\n" for row in columns)
    path = write(tmp_path, HEADER + rows)
    np.testing.assert_allclose(Polar.read(path, moment_axis=0.25).moment, normal / 4, atol=1e-15)
    np.testing.assert_allclose(Polar.read(path, moment_axis=1.0).moment, -normal / 2, atol=1e-15)
    assert not Polar.read(path, moment_axis=0.5).moment.any()
    with pytest.raises(PolarFileError, match=r"section\.csv: its lift rises by 6.* moment_axis"):
        Polar.read(path)


def test_moment_that_rises_with_the_lift_is_about_mid_chord(tmp_path: Path) -> None:
    """And a section that does not lift, such as a square prism, may have none at all."""
    for slope, moment in ((6.0, 0.06), (6.0, 0.31), (6.0, -0.31), (1.9, 0.0), (-4.7, 0.0)):
        rows = "".join(
            f"{a},{slope * np.radians(a):.9g},{moment * slope * np.radians(a):.9g},0.1\n"
            for a in range(-4, 5, 2)
        )
        polar = Polar.read(write(tmp_path, HEADER + rows))
        assert polar.moment_slope() == pytest.approx(moment * slope, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("slope", [2 * np.pi, 3.0, -4.7, 10.0])
def test_radians_in_the_place_of_degrees_are_refused(tmp_path: Path, slope: float) -> None:
    alpha = np.linspace(-0.2, 0.2, 9)
    rows = "".join(f"{a:.9g},{slope * a:.9g},{slope * a / 4:.9g},0.01\n" for a in alpha)
    with pytest.raises(PolarFileError, match=r"line 10: .* ends at 0\.2, .* look like radians"):
        Polar.read(write(tmp_path, HEADER + rows))
    rows = "".join(f"{np.degrees(a):.9g},{slope * a:.9g},{slope * a / 4:.9g},0.01\n" for a in alpha)
    assert Polar.read(write(tmp_path, HEADER + rows)).lift_slope() == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("axis", [25, -0.25, float("nan")])
def test_a_moment_axis_off_the_chord_is_refused(tmp_path: Path, axis: float) -> None:
    with pytest.raises(PolarFileError, match=r"section\.csv: moment_axis is .* from 0 to 1"):
        Polar.read(write(tmp_path, HEADER + POINTS), moment_axis=axis)


XFOIL = """
       XFOIL         Version 6.99

 Calculated polar for: NACA 2412

 xtrf =   1.000 (top)        1.000 (bottom)
 Mach =   0.000     Re =     1.000 e 6     Ncrit =   9.000

   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr
  ------ -------- --------- --------- -------- -------- --------
  -2.000   0.0220   0.00659   0.00062  -0.0540   0.7828   0.2959
   0.000   0.2371   0.00564   0.00049  -0.0520   0.6516   0.6796
   2.000   0.4496   0.00578   0.00079  -0.0481   0.5256   0.9675
   4.000   0.6635   0.00683   0.00121  -0.0459   0.4368   0.9924
"""


def test_xfoils_polar_says_itself_where_its_moment_is(tmp_path: Path) -> None:
    path = tmp_path / "n2412.pol"
    path.write_text(XFOIL)
    polar = Polar.read(path)
    assert polar.label == "n2412"
    assert np.degrees(polar.incidence) == pytest.approx([-2, 0, 2, 4])
    assert polar.drag == pytest.approx([0.00659, 0.00564, 0.00578, 0.00683])
    assert polar.moment[1] == pytest.approx(-0.0520 + 0.2371 / 4)
    assert Polar.read(path, moment_axis=0.25).moment == pytest.approx(polar.moment)
    with pytest.raises(PolarFileError, match=r"is 0\.5, but moments of XFOIL are about 0\.25"):
        Polar.read(path, moment_axis=0.5)


@pytest.mark.parametrize(
    ("found", "instead", "words"),
    [
        ("0.2371   0.00564", "0.2371  *******", r"line 12: CD is '\*\*\*"),
        ("0.4496   0.00578", "0.4496", r"line 13: 6 values under 7 column names"),
        ("   CM  ", "   XX  ", r"line 9: no column cm; found alpha, CL"),
        ("alpha", "angle", r"no line of column names that begins with 'alpha'"),
        (
            "2.000   0.4496",
            "-9.000   0.4496",
            r"line 13: incidence_deg -9 goes back after the angles from -2",
        ),
    ],
)
def test_a_broken_polar_of_xfoil_is_refused_by_line(
    tmp_path: Path, found: str, instead: str, words: str
) -> None:
    assert found in XFOIL
    path = tmp_path / "any_name.txt"
    path.write_text(XFOIL.replace(f" {found}", f" {instead}"))
    with pytest.raises(PolarFileError, match=r"any_name\.txt.*" + words):
        Polar.read(path)


def test_formats_load_no_numerics() -> None:
    code = "import sys, equisection.io.formats; print({'numpy', 'scipy'} & set(sys.modules))"
    said = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    assert said.strip() == "set()"


def test_missing_file_and_folder_are_named(tmp_path: Path) -> None:
    with pytest.raises(PolarFileError, match=r"none\.csv: no such polar file"):
        Polar.read(tmp_path / "none.csv")
    with pytest.raises(PolarFileError, match="cannot be read"):
        Polar.read(tmp_path)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfd\x00\x81")
    with pytest.raises(PolarFileError, match="cannot be read"):
        Polar.read(tmp_path / "binary.csv")


def test_polars_of_the_plate_are_read() -> None:
    section = Polar.read(POLARS / "plate_2d_11136.csv")
    assert np.degrees(section.incidence_range) == pytest.approx((-12, 12))
    assert float(section.lift_coefficient(np.radians(3))) == pytest.approx(0.45675, abs=1e-6)
    beam = Polar.read(POLARS / "paper_plate_3d.csv")
    assert float(beam.moment_coefficient(np.radians(2.5))) == pytest.approx(0.0602, abs=1e-6)
