"""Polars that a configuration names are looked into before any job starts."""

import math
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from equisection.config import load_config
from equisection.errors import ConfigError
from equisection.solvers.embedded.adapter import read_section_polar
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
    """Each of its cases would fail."""
    text = re.sub(r"^[248],", lambda degrees: f"{int(degrees[0][0]) / 4:g},", GOOD, flags=re.M)
    (tmp_path / "own.csv").write_text(text)
    raw: dict[str, Any] = {"embedded": {"polars": {"coarse": "own.csv"}, "symmetric": symmetric}}
    (line,) = lines_of(raw, tmp_path)
    first = -2 if symmetric else 0
    assert line == (
        f"config: flow.incidence_deg: 2.5: allowed is {first:g} to 2 deg, what own.csv covers "
        "(is it in degrees?)"
    )


def test_a_polar_in_radians_is_refused(tmp_path: Path) -> None:
    text = re.sub(
        r"^[248],", lambda degrees: f"{math.radians(int(degrees[0][0])):.3f},", GOOD, flags=re.M
    )
    (tmp_path / "own.csv").write_text(text)
    (line,) = lines_of({"embedded": {"polars": {"coarse": "own.csv"}}}, tmp_path)
    assert line.startswith("config: embedded.polars.coarse: 'own.csv': line 5: incidence_deg ends")
    assert line.endswith("the angles look like radians: give them in degrees")


def test_polars_of_another_solver_are_left_alone(tmp_path: Path) -> None:
    check_polars(load_config({"solver": "openfoam", "unsteady": STEP}), tmp_path)
    check_polars(load_config({}), ROOT)


CFD = {"solver": "openfoam", "unsteady": STEP, "sweep": {"models": ["2d"]}}
OF_THE_PLATE = "config/polars/paper_plate_3d.csv"


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"beam": {"length": 0.6}}, "of L/c 3.7 and not 6"),
        ({"beam": {"thickness": 0.006}}, "of h/c 0.04 and not 0.06"),
        ({"flow": {"speed": 30}}, "of Reynolds number 126900 and not 190300"),
        ({"flow": {"root_on_wall": False}}, "of flow.root_on_wall true and not false"),
        ({"flow": {"channel": {"height_chords": 8}}}, "of flow.channel.height_chords 4 and not 8"),
        ({"flow": {"channel": {"tip_gap_chords": 9}}}, "and not 9"),
    ],
)
def test_a_polar_of_one_beam_is_refused_for_another(change: dict[str, Any], reason: str) -> None:
    (line,) = lines_of({**CFD, **change, "steady": {"beam_polar": OF_THE_PLATE}}, ROOT)
    assert line.startswith(f"config: steady.beam_polar: '{OF_THE_PLATE}': allowed")
    assert line.endswith(reason)


@pytest.mark.parametrize(
    "change",
    [
        {"beam": {"youngs_modulus": 70e9, "density": 2700, "boundary": "pinned-pinned"}},
        {"beam": {"chord": 0.2, "length": 0.74, "thickness": 0.008}, "flow": {"speed": 10}},
        {},
    ],
)
def test_a_rigid_polar_is_of_any_material_and_size(change: dict[str, Any]) -> None:
    check_polars(load_config({**CFD, **change, "steady": {"beam_polar": OF_THE_PLATE}}), ROOT)


def test_a_copy_of_a_polar_is_of_the_same_beam(tmp_path: Path) -> None:
    (tmp_path / "mine.csv").write_text((ROOT / OF_THE_PLATE).read_text())
    raw = {**CFD, "beam": {"length": 0.6}, "steady": {"beam_polar": "mine.csv"}}
    (line,) = lines_of(raw, tmp_path)
    assert line.endswith("not 6")


def test_a_polar_that_says_nothing_of_its_beam_is_for_any(tmp_path: Path) -> None:
    (tmp_path / "own.csv").write_text(GOOD)
    raw = {**CFD, "beam": {"length": 0.6}, "steady": {"beam_polar": "own.csv"}}
    check_polars(load_config(raw), tmp_path)


def test_the_polar_of_a_thin_section_is_refused_for_a_thick_one() -> None:
    (line,) = lines_of({"beam": {"thickness": 0.02}}, ROOT)
    assert line.startswith(
        "config: embedded.polars.coarse: 'config/polars/plate_2d_11136.csv': allowed is the polar "
        "of this section, of h/c 0.2, or flat-plate"
    )
    assert line.endswith("h/c 0.04")
    check_polars(load_config({"beam": {"thickness": 0.0045}}), ROOT)


def test_what_cannot_be_read_of_a_polars_beam_is_named(tmp_path: Path) -> None:
    (tmp_path / "own.csv").write_text(f"# Valid for: h/c thin\n{GOOD}")
    (line,) = lines_of({"embedded": {"polars": {"coarse": "own.csv"}}}, tmp_path)
    assert line.startswith("config: embedded.polars.coarse: 'own.csv': line 1: 'h/c thin' behind")


def test_looking_at_polars_loads_no_numerics() -> None:
    code = "import sys, equisection.study.given_polars; print('scipy' in sys.modules)"
    said = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    assert said.strip() == "False"


LEVEL = "incidence_deg,cl,cm,cd\n0,0,0,0.01\n4,0.42,-0.004,0.01\n8,0.8,-0.01,0.02\n12,1,-0.03,0.1\n"


def test_moments_that_may_be_about_the_quarter_chord_are_not_taken_silently(tmp_path: Path) -> None:
    (tmp_path / "airfoil.csv").write_text(LEVEL)
    raw: dict[str, Any] = {"embedded": {"polars": {"coarse": "airfoil.csv"}}}
    (line,) = lines_of(raw, tmp_path)
    assert line.startswith("config: embedded.polars.coarse: 'airfoil.csv': its lift rises by 6")
    assert "its lift rises by 6 per rad and its moment by -0.057 only" in line
    for axis in (0.25, 0.5):
        raw["embedded"]["moment_axis"] = axis
        check_polars(load_config(raw), tmp_path)


def test_polar_of_the_beam_has_its_moments_about_mid_chord(tmp_path: Path) -> None:
    raw: dict[str, Any] = {**CFD, "steady": {"beam_polar": "beam.csv"}}
    refusals = {
        "": "config: steady.beam_polar: 'beam.csv': allowed are moments about mid-chord: its lift",
        "# Valid for: moment_axis 0.25\n": "mid-chord: it says 0.25; write them",
    }
    for said, words in refusals.items():
        (tmp_path / "beam.csv").write_text(said + LEVEL)
        (line,) = lines_of(raw, tmp_path)
        assert words in line
    (tmp_path / "beam.csv").write_text("# Valid for: moment_axis 0.5\n" + LEVEL)
    check_polars(load_config(raw), tmp_path)


def test_moment_axis_is_that_of_the_polar_that_the_solver_reads(tmp_path: Path) -> None:
    """About mid-chord c_m = c_m,1/4 + (c_l cos alpha + c_d sin alpha)/4."""
    (tmp_path / "airfoil.csv").write_text(LEVEL)
    path = str(tmp_path / "airfoil.csv")
    raw = {"embedded": {"polars": {"coarse": path}, "moment_axis": 0.25}}
    polar = read_section_polar(load_config(raw).embedded, "coarse")
    angle = math.radians(8)
    normal = 0.8 * math.cos(angle) + 0.02 * math.sin(angle)
    assert float(polar.moment_cubic(angle)) == pytest.approx(-0.01 + normal / 4)


def test_moment_axis_that_a_format_has_elsewhere_is_refused(tmp_path: Path) -> None:
    points = "".join(f"  {a} {0.1 * a} 0.01 0.005 {-0.001 * a}\n" for a in range(0, 10, 2))
    (tmp_path / "a.pol").write_text(f"XFOIL\n alpha CL CD CDp CM\n ------\n{points}")
    raw: dict[str, Any] = {"embedded": {"polars": {"coarse": "a.pol"}}}
    check_polars(load_config(raw), tmp_path)
    raw["embedded"]["moment_axis"] = 0.5
    (line,) = lines_of(raw, tmp_path)
    assert "moment_axis is 0.5, but moments of XFOIL are about 0.25" in line


def test_section_of_the_beams_polar_is_looked_into_as_well(tmp_path: Path) -> None:
    shutil.copy(ROOT / OF_THE_PLATE, tmp_path / "beam.csv")
    raw: dict[str, Any] = {
        **CFD,
        "steady": {"beam_polar": "beam.csv", "beam_polar_section": "own.csv"},
    }
    key = "config: steady.beam_polar_section: 'own.csv': "
    (tmp_path / "own.csv").write_text(GOOD.replace("0.3,", "much,"))
    (line,) = lines_of(raw, tmp_path)
    assert line.startswith(f"{key}line 3: cl is 'much'")
    (tmp_path / "own.csv").write_text(f"# Valid for: h/c 0.2\n{GOOD}")
    (line,) = lines_of(raw, tmp_path)
    assert line == (
        f"{key}allowed is the polar of this beam's section; this one is of a section of h/c 0.2 "
        "and not 0.04"
    )
    (tmp_path / "own.csv").write_text(f"# Valid for: h/c 0.04\n{GOOD}")
    check_polars(load_config(raw), tmp_path)
    with pytest.raises(ConfigError, match=r"own\.csv.*: allowed with steady\.beam_polar"):
        load_config({**CFD, "steady": {"beam_polar_section": "own.csv"}})
