"""Polars of other programs and wind tunnels: read where the meaning is certain, else refused."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT

import equisection as eq
from equisection.aerodynamics.polar import Polar
from equisection.config import load_config
from equisection.errors import ConfigError, PolarFileError
from equisection.io.polar_text import MOST_LINES
from equisection.run.command_line import main
from equisection.study.given_polars import check_polars, polar_notices

ANGLES = (-4.0, -2.0, 0.0, 2.0, 4.0)
#: A thin cambered airfoil: c_l = 2 pi (alpha + 2 deg), c_m = -0.05 about the quarter chord.
LIFT = tuple(round(2 * math.pi * math.radians(angle + 2), 4) for angle in ANGLES)
DRAG = (0.011, 0.0105, 0.01, 0.0105, 0.011)
MOMENT = -0.05
POINTS = tuple(zip(ANGLES, LIFT, DRAG, strict=True))

BLANKS = "\n".join(f"{a:8.3f} {cl:8.4f} {cd:9.5f} 0.00400 {MOMENT} 0.9 0.2" for a, cl, cd in POINTS)
COMMAS = "\n".join(f"{a:.3f},{cl},{cd},0.004,{MOMENT},0.9,0.2" for a, cl, cd in POINTS)
FOUR = "\n".join(f"{a:8.3f} {cl} {cd} {MOMENT}" for a, cl, cd in POINTS)
TOP = """ Calculated polar for: MADE UP

 1 1 Reynolds number fixed          Mach number fixed

 xtrf =   1.000 (top)        1.000 (bottom)
 Mach =   0.000     Re =     0.250 e 6     Ncrit =   9.000

"""
NAMES = "  alpha     CL        CD       CDp       Cm    Top Xtr Bot Xtr\n"
DASHES = " ------- -------- --------- --------- -------- ------- -------\n"

PROGRAMS = {
    "XFOIL": f"\n       XFOIL         Version 6.99\n\n{TOP}{NAMES}{DASHES}{BLANKS}\n",
    "XFLR5": f"xflr5 v6.47\n\n{TOP}{NAMES}{DASHES}{BLANKS}\n",
    "XFLR5 with commas": f"xflr5 v6.47\n\n{TOP}alpha,CL,CD,CDp,Cm,Top Xtr,Bot Xtr\n{COMMAS}\n",
    "QBlade": f"QBlade v0.96 export\n\n{TOP}{NAMES}{DASHES}{BLANKS}\n",
    "QBlade polar file": "------ QBlade CE ------\nMADE_UP POLARNAME - name\nMADE_UP.afl FOILNAME\n"
    f"12 THICKNESS\n0 ISDECOMPOSED\n250000 REYNOLDS\n\nAOA CL CD CM\n{FOUR}\n",
    "airfoiltools.com": "Xfoil polar. Reynolds number fixed.\nPolar key,xf-made-up-il-250000\n"
    "Airfoil,made-up-il\nReynolds number,250000\nNcrit,9\nMach,0\nMax Cl/Cd,80\n"
    f"Max Cl/Cd alpha,4\n\nAlpha,Cl,Cd,Cdp,Cm,Top_Xtr,Bot_Xtr\n{COMMAS}\n",
    "AeroDyn": "! --- AirfoilInfo Input File ---\n1 NumTabs ! tables\n0.25 Re ! millions\n"
    "False InclUAdata ! no\n5 NumAlf ! rows\n! Alpha Cl Cd Cm\n! (deg) (-) (-) (-)\n"
    f"{FOUR}\n! ---------\n",
}


def save(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "polar.txt"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize("program", PROGRAMS)
def test_moment_of_a_program_is_moved_from_the_quarter_chord(tmp_path: Path, program: str) -> None:
    """About mid-chord c_m = c_m,1/4 + (c_l cos alpha + c_d sin alpha)/4, whatever wrote it."""
    polar = Polar.read(save(tmp_path, PROGRAMS[program]))
    alpha = np.radians(ANGLES)
    normal = np.array(LIFT) * np.cos(alpha) + np.array(DRAG) * np.sin(alpha)
    np.testing.assert_allclose(polar.incidence, alpha, rtol=1e-12)
    np.testing.assert_allclose(polar.lift, LIFT, rtol=1e-12)
    np.testing.assert_allclose(polar.drag, DRAG, rtol=1e-12)
    np.testing.assert_allclose(polar.moment, MOMENT + normal / 4, rtol=1e-12)
    assert polar.reynolds_number == pytest.approx(250_000)
    with pytest.raises(PolarFileError, match=r"is 0\.5, but moments of .* are about 0\.25"):
        Polar.read(tmp_path / "polar.txt", moment_axis=0.5)


@pytest.mark.parametrize("program", PROGRAMS)
def test_moments_that_contradict_their_program_are_refused(tmp_path: Path, program: str) -> None:
    """A moment that rises by a quarter of the lift is one about mid-chord; then both are taken."""
    text = PROGRAMS[program]
    for angle, lift, _ in POINTS:
        row = next(line for line in text.splitlines() if re.match(rf" *{angle:.3f}[ ,]", line))
        text = text.replace(row, row.replace(str(MOMENT), f"{lift / 4:.4f}"))
    path = save(tmp_path, text)
    with pytest.raises(PolarFileError, match=r"as about mid-chord, but moments .* moment_axis"):
        Polar.read(path)
    assert Polar.read(path, moment_axis=0.5).moment == pytest.approx(np.array(LIFT) / 4, abs=1e-4)


@pytest.mark.parametrize(
    ("program", "old", "new", "words"),
    [
        ("XFLR5", " 0.9 0.2\n", " 0.9\n", r"line 12: 6 values under 7 column names"),
        ("QBlade polar file", "250000 R", "1e5 2e5 R", r"line 6: 2 Reynolds numbers; .* one"),
        ("QBlade polar file", "0 ISD", "1 ISD", r"line 5: the polar is decomposed"),
        ("QBlade polar file", "-2.000 0.0", "-2.000 nan", r"line 10: no row of alpha, Cl, Cd"),
        ("airfoiltools.com", ",Cm,", ",Cn,", r"line 10: no column cm; found Alpha, Cl"),
        ("airfoiltools.com", "Cdp,", "C_D,", r"line 10: more than one column is cd"),
        ("AeroDyn", "1 NumTabs", "2 NumTabs", r"line 5: 1 tables \(NumTabs 2\); wanted the one"),
        ("AeroDyn", "5 NumAlf", "4 NumAlf", r"line 5: NumAlf is 4, and 5 rows follow"),
        ("AeroDyn", "Cl Cd Cm", "Cd Cl Cm", r"line 6: the columns are incidence_deg, cd, cl"),
        ("AeroDyn", f" {MOMENT}\n", "\n", r"line 8: 3 values; wanted alpha, Cl, Cd and Cm"),
    ],
)
def test_what_is_open_in_a_program_file_is_refused(
    tmp_path: Path, program: str, old: str, new: str, words: str
) -> None:
    assert old in PROGRAMS[program]
    path = save(tmp_path, PROGRAMS[program].replace(old, new, 1))
    with pytest.raises(PolarFileError, match=r"polar\.txt, " + words):
        Polar.read(path)


#: c_m about mid-chord is a fifth of c_l.
ROWS = [[-4.0, -0.4, 0.02, -0.08], [-2.0, -0.2, 0.02, -0.04], [0.0, 0.01, 0.02, 0.0]]
ROWS += [[2.0, 0.21, 0.02, 0.04], [4.0, 0.4, 0.03, 0.08]]
PLAIN = "alpha,cl,cd,cm\n" + "".join(f"{a:g},{cl},{cd},{cm}\n" for a, cl, cd, cm in ROWS)
GERMAN = "# Messung\nAlpha [°];CL [-];CD [-];CM [-]\n" + "".join(
    ";".join(map(str, row)).replace(".", ",") + "\n" for row in ROWS
)


def fortran(text: str) -> str:
    return re.sub(r"0\.(\d+)", lambda found: f"{found[1]}.D-{len(found[1]):02}", text)


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        (PLAIN, "utf-8"),
        (PLAIN, "utf-8-sig"),
        (PLAIN, "utf-16"),
        (PLAIN.replace("\n", "\r\n"), "utf-8"),
        (PLAIN.replace("\n", "\r"), "utf-8"),
        ("# Winkel in °\n" + PLAIN, "latin-1"),
        (GERMAN, "utf-8-sig"),
        (GERMAN, "latin-1"),
        (PLAIN.replace(",", "\t"), "utf-8"),
        (PLAIN.replace(",", "   "), "utf-8"),
        ("# " + PLAIN.replace(",", " "), "utf-8"),
        ("% tunnel\n! more\n// and more\n" + PLAIN, "utf-8"),
        ("Tunnel of 1998\nrun 7, 12 m/s\n\n" + PLAIN, "utf-8"),
        (PLAIN.replace("\n", "\ndeg,-,-,-\n", 1), "utf-8"),
        (PLAIN.replace("alpha,cl,cd,cm", "AoA (deg),C_L,C_D,C_M [-]"), "utf-8"),
        (PLAIN.replace("alpha,cl,cd,cm", '"Incidence","C L","C D","C M"'), "utf-8"),
        (fortran(PLAIN), "utf-8"),
        (PLAIN + "4,0.4,0.03,0.08\n", "utf-8"),
    ],
)
def test_the_same_points_in_any_writing_are_the_same_polar(
    tmp_path: Path, text: str, encoding: str
) -> None:
    polar = Polar.read(save(tmp_path, text, encoding))
    read = [np.degrees(polar.incidence), polar.lift, polar.drag, polar.moment]
    np.testing.assert_allclose(np.transpose(read), ROWS, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("order", [[4, 3, 2, 1, 0], [2, 3, 4, 1, 0], [1, 0, 2, 3, 4]])
def test_angles_that_fall_are_sorted(tmp_path: Path, order: list[int]) -> None:
    header, *rows = PLAIN.splitlines()
    polar = Polar.read(save(tmp_path, "\n".join([header, *(rows[i] for i in order)])))
    np.testing.assert_allclose(polar.lift, [row[1] for row in ROWS])


def test_branches_of_a_loop_are_not_mixed(tmp_path: Path) -> None:
    path = save(tmp_path, PLAIN + "3,0.5,0.02,0.1\n1,0.3,0.02,0.06\n")
    with pytest.raises(PolarFileError, match=r"line 7: incidence_deg 3 goes back after the angles"):
        Polar.read(path)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("alpha,", "alpha [rad],", r"line 1: the unit of incidence_deg is 'rad'; wanted degrees"),
        ("alpha,", "alpha_rad,", r"line 1: the unit of incidence_deg is 'rad'"),
        ("cm\n", "cm [%]\n", r"line 1: the unit of cm is '%'; wanted no unit"),
        ("cm\n", "cm\nrad,-,-,-\n", r"line 2: the unit of incidence_deg is 'rad'"),
        ("alpha,", "incidence_deg,", ""),
        ("cd,", "incidence_deg,", r"line 1: more than one column is incidence_deg"),
        ("cd,", "C_L,", r"line 1: more than one column is cl"),
        ("cm\n", "c_mle\n", r"line 1: no column cm; found alpha, cl, cd, c_mle; wanted .*columns"),
        ("-0.4,", "-0.4_0,", r"line 2: cl is '-0\.4_0'; wanted a finite number"),
        ("-0.4,", "-٠.٤,", r"line 2: cl is '-٠\.٤'"),
        ("-0.4,", "−0.4,", r"line 2: cl is '−0\.4'"),
        ("-0.4,", "-40,", r"line 2: cl is -40; allowed is -20 to 20"),
        ("0.02,", "-0.02,", r"line 2: cd is -0\.02; a drag is not negative"),
        ("-4,", "-184,", r"line 2: incidence_deg is -184; allowed is -180 to 180"),
        ("\n2,0.21", "\n1e-7,0.21", r"line 5: incidence_deg is 1e-07, less than 1e-06 deg from"),
        ("\n2,0.21", "\n0,0.21", r"line 5: incidence_deg 0 repeats that of line 4 with other"),
        ("-0.4,", "-0,4,", r"line 2: 5 values under 4 column names"),
    ],
)
def test_slips_are_refused_by_line(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert old in PLAIN
    path = save(tmp_path, PLAIN.replace(old, new, 1))
    if not words:
        assert Polar.read(path).incidence.size == len(ROWS)
        return
    with pytest.raises(PolarFileError, match=r"polar\.txt, " + words):
        Polar.read(path)


def test_decimal_commas_and_points_are_not_mixed(tmp_path: Path) -> None:
    path = save(tmp_path, GERMAN.replace("-0,4;", "-0.4;"))
    with pytest.raises(PolarFileError, match=r"a decimal comma, and in line 3 a decimal point"):
        Polar.read(path)


def test_a_polar_of_zeros_is_refused(tmp_path: Path) -> None:
    path = save(tmp_path, "alpha,cl,cm,cd\n" + "".join(f"{a},0,0,0\n" for a in range(-4, 5)))
    with pytest.raises(PolarFileError, match=r"line 2: every cl, cm and cd is 0"):
        Polar.read(path)


@pytest.mark.parametrize(
    "text",
    [
        "root:x:0:0:secret:/root\n" * 9,
        "{'secret': 1}\n",
        "1,2,3,4\n" * 9,
    ],
)
def test_a_file_that_is_no_polar_is_not_quoted(tmp_path: Path, text: str) -> None:
    with pytest.raises(PolarFileError, match=r"line 1: no line names the columns") as caught:
        Polar.read(save(tmp_path, text))
    assert "secret" not in str(caught.value)


@pytest.mark.parametrize("mark", ["\x1b[31m", "\x07", "\x00", "\x9b", "\u202e", "\u200b"])
def test_invisible_characters_reach_no_message(
    tmp_path: Path, mark: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = save(tmp_path, PLAIN.replace("-0.2,", f"-0.2{mark},"))
    config = tmp_path / "c.yaml"
    config.write_text(f"embedded: {{polars: {{coarse: {path}}}}}\n")
    assert main(["check", str(config)]) == 1
    said = capsys.readouterr().err
    assert "line 3: an invisible character (U+" in said
    assert mark not in said


def test_a_file_far_too_long_is_refused_unread(tmp_path: Path) -> None:
    path = save(tmp_path, PLAIN + "5,0.4,0.03,0.08\n" * MOST_LINES)
    with pytest.raises(PolarFileError, match=r"100,006 lines; a polar has 100,000 at most"):
        Polar.read(path)


def test_table_of_the_page_is_read(tmp_path: Path) -> None:
    page = (ROOT / "docs" / "polar-formats.md").read_text("utf-8")
    table = page.partition("## Tables of your own")[2].split("```")[1].strip()
    polar = Polar.read(save(tmp_path, table), symmetric=False)
    assert np.degrees(polar.incidence) == pytest.approx([-4, -2, 0, 2])
    assert polar.lift == pytest.approx([-0.4, -0.21, 0.0, 0.21])


def test_polar_of_a_program_is_not_one_of_a_beam_about_mid_chord(tmp_path: Path) -> None:
    path = save(tmp_path, PROGRAMS["AeroDyn"])
    raw = {"solver": "openfoam", "unsteady": {"time_step": 0.02}, "sweep": {"models": ["2d"]}}
    raw |= {"steady": {"beam_polar": str(path)}}
    with pytest.raises(ConfigError, match=r"steady\.beam_polar: .* AeroDyn are about 0\.25"):
        check_polars(load_config(raw))


def test_a_line_far_too_long_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PolarFileError, match=r"line 7: 20,000 characters; a polar has one point"):
        Polar.read(save(tmp_path, PLAIN + "1," * 10_000))


def test_a_polar_of_another_reynolds_number_is_told(tmp_path: Path) -> None:
    """Re = rho V c/mu is 1.27e5 in the default flow."""
    path = save(tmp_path, PLAIN)
    raw = {"embedded": {"polars": {"coarse": str(path)}, "symmetric": False}}
    config = load_config(raw | {"steady": {"incidence_deg": [-4, -2, 0, 2, 2.5, 4]}})
    assert not list(polar_notices(config))
    for reynolds, told in (("1e5", False), ("2.4e5", False), ("1e6", True), ("6e4", True)):
        save(tmp_path, f"# Valid for: Reynolds number {reynolds}\n" + PLAIN)
        lines = list(polar_notices(config))
        assert len(lines) == told
        assert "this flow has 126900" in "".join(lines) or not told


def test_a_full_turn_is_kept_and_does_not_change_what_is_near_zero(tmp_path: Path) -> None:
    """Beyond 20 deg the loads are those of a plate, c_n = 2 sin alpha: far from any motion here."""
    alpha = np.arange(-180.0, 181.0, 2.0)
    radians = np.radians(alpha)
    near = np.abs(alpha) <= 20
    lift = np.where(near, 5.7 * np.sin(radians), 2 * np.sin(radians) * np.cos(radians))
    drag = np.where(near, 0.01, 2 * np.sin(radians) ** 2)
    moment = np.where(near, 0.24 * lift, 0.1 * np.sin(radians))
    table = np.transpose([alpha, lift, drag, moment])
    polars = []
    for rows in (table, table[near]):
        body = "".join(",".join(f"{value:.9f}" for value in row) + "\n" for row in rows)
        polars.append(Polar.read(save(tmp_path, "alpha,cl,cd,cm\n" + body)))
    whole, cut = polars
    assert np.degrees(whole.incidence_range) == pytest.approx((-180, 180))
    beam = eq.Beam(length=0.37, chord=0.1, thickness=0.004, youngs_modulus=3e8, density=1200.0)
    section = eq.reduce(beam)
    speeds = [
        eq.critical_speed(section, polar, incidence_deg=2.0, speed=(2.0, 60.0)).speed_low.item()
        for polar in (whole, cut)
    ]
    assert 2.0 < speeds[0] < 59.0
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-6)


NAMED = PLAIN.replace("alpha,cl,cd,cm", "Winkel,CA,CW,CM")


def test_columns_of_any_name(tmp_path: Path) -> None:
    path = save(tmp_path, NAMED)
    columns = {"incidence_deg": "Winkel", "cl": "CA", "cd": "CW"}
    np.testing.assert_array_equal(
        Polar.read(path, columns=columns).lift, Polar.read(save(tmp_path, PLAIN)).lift
    )
    path = save(tmp_path, NAMED)
    raw = {"embedded": {"polars": {"own": str(path)}, "symmetric": False, "columns": columns}}
    raw |= {"steady": {"resolution": "own", "incidence_deg": [-4, -2, 0, 2, 2.5, 4]}}
    check_polars(load_config(raw))
    raw["embedded"]["columns"] = {"cl": "Auftrieb"}
    with pytest.raises(ConfigError, match=r"no column incidence_deg, cl \('Auftrieb'\), cd; found"):
        check_polars(load_config(raw))


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"lift": "CA"}, r"columns names 'lift'; allowed are incidence_deg, cl, cm, cd"),
        ({"cl": "CA", "cd": "CA"}, r"columns gives one name to two quantities"),
    ],
)
def test_columns_that_mean_nothing_are_refused(
    tmp_path: Path, columns: dict[str, str], words: str
) -> None:
    with pytest.raises(PolarFileError, match=words):
        Polar.read(save(tmp_path, NAMED), columns=columns)


def test_a_name_that_is_given_goes_before_the_usual_one(tmp_path: Path) -> None:
    """A file may have the lift of two runs: the given column is read, the other is not."""
    text = PLAIN.replace("alpha,cl,cd,cm", "alpha,cl,cd,cm,cl_run_2")
    header, *rows = text.splitlines()
    path = save(tmp_path, "\n".join([header, *(f"{row},{i}" for i, row in enumerate(rows))]))
    polar = Polar.read(path, columns={"cl": "cl_run_2"}, moment_axis=0.5)
    np.testing.assert_array_equal(polar.lift, [0, 1, 2, 3, 4])


def test_reynolds_number_of_a_csv_file_is_in_its_comment(tmp_path: Path) -> None:
    polar = Polar.read(save(tmp_path, "# Valid for: h/c 0.04, Reynolds number 1e5\n" + PLAIN))
    assert polar.reynolds_number == 1e5
    assert math.isnan(Polar.read(save(tmp_path, PLAIN)).reynolds_number)
