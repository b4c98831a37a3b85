"""Outlines: shapes with known areas, files either way round, and what cannot be a contour."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from equisection.beam import outline as shapes
from equisection.beam.beam import Beam
from equisection.beam.outline import Outline, outline_of, placed, turning_deg
from equisection.beam.outline_keys import OutlineKeys
from equisection.config import load_config
from equisection.errors import ConfigError, OutlineError
from equisection.io.outline_file import read_outline
from equisection.study.given_outline import check_outline

SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
CROSS_SECTION = {
    "bending_rigidity": 60.0,
    "torsional_rigidity": 25.0,
    "mass_per_length": 1.2,
    "inertia_per_length": 0.006,
}


def airfoil(digits: str) -> Outline:
    return outline_of(placed(shapes.naca(digits), 1.0), is_airfoil=True)


@pytest.mark.parametrize("digits", ["0012", "0006", "4412", "2415", "0024"])
def test_area_of_a_naca_section_is_that_of_its_polynomial(digits: str) -> None:
    """The integral of twice the half thickness over x; camber shears it, to first order."""
    powers = (1.5, 2.0, 3.0, 4.0, 5.0)
    coefficients = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)
    total = sum(a / p for a, p in zip(coefficients, powers, strict=True))
    expected = 10.0 * int(digits[2:]) / 100 * total
    assert airfoil(digits).area == pytest.approx(expected, rel=6e-3 if digits[0] != "0" else 6e-4)


def test_symmetric_section_is_symmetric() -> None:
    points = airfoil("0012").points
    mirrored = (points * (1.0, -1.0))[::-1]
    away = [np.hypot(*(points - point).T).min() for point in mirrored]
    assert max(away) < 1e-6


def test_published_ordinates_of_naca_4412() -> None:
    """Upper side at x/c 0.30 to 0.40 of NACA Report 460 (1933), Table I: 9.76 and 9.80 % c."""
    points = airfoil("4412").points
    upper = points[points[:, 1] > 0.05]
    upper = upper[np.argsort(upper[:, 0])]
    found = np.interp([-0.2, -0.1], upper[:, 0], upper[:, 1])
    assert_allclose(found, [0.0976, 0.0980], atol=2e-4)


@pytest.mark.parametrize("radius", [0.0, 0.01, 0.02])
def test_area_of_a_rounded_rectangle(radius: float) -> None:
    outline = outline_of(shapes.rectangle(0.04, radius))
    # the arcs' polygons are inside of their circles
    assert outline.area == pytest.approx(0.04 - (4 - math.pi) * radius**2, rel=2e-5)
    assert outline.perimeter == pytest.approx(2.08 - (8 - 2 * math.pi) * radius, rel=1e-4)


@pytest.mark.parametrize("shape", [airfoil("0012"), outline_of(shapes.rectangle(0.1, 0.03))])
def test_contour_turns_once_and_finely(shape: Outline) -> None:
    turns = turning_deg(shape.points)
    assert turns.sum() == pytest.approx(360.0)
    assert np.sum(turns > shapes.FINEST_TURN_DEG + 0.05) <= 1  # the trailing edge


@pytest.mark.parametrize(
    "points",
    [
        SQUARE,
        SQUARE[::-1],
        np.roll(SQUARE, 2, axis=0),
        SQUARE[[0, 1, 2, 3, 0]],
        SQUARE[[0, 0, 1, 1, 2, 3, 3, 0]],
    ],
)
def test_either_way_round_open_or_closed_with_doubles(points: np.ndarray) -> None:
    outline = outline_of(points)
    assert len(outline.points) == 4
    assert outline.area == pytest.approx(1.0)


def refused(points: np.ndarray | list[list[float]], *, is_airfoil: bool = False) -> str:
    with pytest.raises(OutlineError) as caught:
        outline_of(np.asarray(points, dtype=float), is_airfoil=is_airfoil)
    return str(caught.value)


def test_refusals_have_the_place() -> None:
    eight = [[-0.5, -0.1], [0.5, 0.1], [0.5, -0.1], [-0.5, 0.1]]
    assert "crosses itself at x/c = 0.5, y/c = 0" in refused(eight)
    assert "3 points; allowed are 4 or more" in refused(SQUARE[:3])
    assert "2 different points" in refused(SQUARE[[0, 1, 1, 0]])
    assert "not a finite number" in refused([[0, 0], [1, math.nan], [1, 1], [0, 1]])
    assert "0.001 c thick" in refused(SQUARE * (1.0, 0.001))
    assert "c high; allowed is up to 2 c" in refused(SQUARE * (1.0, 3.0))
    angle = np.linspace(0, 2 * np.pi, 1001)[:-1]
    noise = np.stack([np.cos(angle), np.sin(angle)], axis=-1) / 2
    noise[::2] *= 1.01
    assert "1000 vertices turn by more than 3.5 deg" in refused(noise)
    cusp = [[0.5, 0.0], [-0.4, 0.01], [-0.5, 0.0], [-0.4, -0.01]]
    assert "an edge of 1.3 deg at x/c = 1, y/c = 0" in refused(cusp)
    two = [[-0.5, -0.1], [0, -0.1], [0, 0.1], [-0.5, -0.1], [0.1, 0.1], [0.5, 0.2]]
    assert "itself at" in refused(two)


def test_triangle_is_closed_by_its_first_point() -> None:
    assert outline_of(SQUARE[[0, 1, 2, 0]]).area == pytest.approx(0.5)


def test_open_airfoil_is_refused() -> None:
    points = placed(shapes.naca("0024"), 1.0)
    half = points[: len(points) // 2]
    assert "open by" in refused(half, is_airfoil=True)


def test_units_of_the_chord() -> None:
    millimetres = SQUARE * (250.0, 30.0)
    assert_allclose(placed(millimetres)[:, 0], SQUARE[:, 0])
    with pytest.raises(OutlineError, match=r"250 long along x, which is 1000 of the chord given"):
        placed(millimetres, 0.25)


@pytest.mark.parametrize("size", [1e-320, 1e-12, 1e12, 1e308])
def test_extent_of_no_drawing_is_refused(size: float) -> None:
    """Beyond these limits a coordinate loses digits, and the shape is not the one drawn."""
    with pytest.raises(OutlineError, match=r"long along x; allowed is from 1e-09 to 1e\+09"):
        placed(SQUARE * size)


def test_axis_far_away_is_refused() -> None:
    """As that of a drawing in metres given in millimetres, or of one drawn far above y = 0."""
    panel = np.array([[0, 0], [2, 0], [2, 0.04], [0, 0.04]])
    with pytest.raises(OutlineError, match="it is 20 c away from its axis at 1, -40; allowed"):
        placed(panel, None, (1.0, -40.0, 0.5))
    with pytest.raises(OutlineError, match="it is 500 c away from y = 0, where its axis is"):
        placed(panel + np.array([0.0, 1000.0]))
    assert_allclose(placed(panel + np.array([0.0, 9.0]))[0], [-0.5, 4.5])


def test_axis_below_the_panel_is_the_origin() -> None:
    """A place 40 mm below a panel of 2 m becomes y = 0 at the axis of the chord."""
    panel = np.array([[0, 0], [2000, 0], [2000, 40], [0, 40]], dtype=float)
    points = placed(panel, None, (1000.0, -40.0, 0.5))
    assert_allclose(points[:, 0], [-0.5, 0.5, 0.5, -0.5])
    assert_allclose(points[:, 1], [0.02, 0.02, 0.04, 0.04])


def test_narrow_notch_is_filled(caplog: pytest.LogCaptureFixture) -> None:
    notch = [
        [-0.5, -0.1],
        [0.5, -0.1],
        [0.5, 0.1],
        [0.02, 0.1],
        [0, 0.0],
        [-0.02, 0.1],
        [-0.5, 0.1],
    ]
    outline = outline_of(np.array(notch))
    assert "notch of 23 deg at x/c = 0.5, y/c = 0" in caplog.text
    assert 180.0 + turning_deg(outline.points).min() > shapes.NARROWEST_NOTCH_DEG
    assert 0.198 < outline.area < 0.2


def written(folder: Path, name: str, lines: list[str]) -> Path:
    path = folder / name
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_selig_and_lednicer_are_one_outline(tmp_path: Path) -> None:
    points = shapes.naca("2412")[::8]
    nose = int(np.argmin(points[:, 0]))
    selig = written(tmp_path, "selig.dat", ["NACA 2412", *(f"{x:.6f} {y:.6f}" for x, y in points)])
    sides = [points[: nose + 1][::-1], points[nose:]]
    rows = [[f" {x:.6f}  {y:.6f}" for x, y in side] for side in sides]
    counts = f"  {len(rows[0])}.   {len(rows[1])}."
    lednicer = written(tmp_path, "lednicer.dat", ["NACA 2412", counts, "", *rows[0], "", *rows[1]])
    one, other = read_outline(selig), read_outline(lednicer)
    assert one.is_airfoil
    assert other.is_airfoil
    outlines = [outline_of(placed(f.points), is_airfoil=True).points for f in (one, other)]
    assert_allclose(outlines[0], outlines[1], atol=1e-9)


def test_spline_through_few_points_is_the_section(tmp_path: Path) -> None:
    """A file of 51 points leaves the section by less than 0.1 % of the chord."""
    coarse = outline_of(placed(shapes.naca("0012")[::8]), is_airfoil=True)
    exact = airfoil("0012").points
    assert coarse.area == pytest.approx(airfoil("0012").area, rel=2e-3)
    away = [np.hypot(*(exact - point).T).min() for point in coarse.points]
    assert max(away) < 0.011  # half the distance of the points, across which nothing is seen


@pytest.mark.parametrize(
    ("name", "lines", "said"),
    [
        ("a.csv", ["x,y", "0,0", "1,zero"], "line 3: '1 zero': allowed are two numbers"),
        ("a.csv", ["0,0", "1,nan", "1,1", "0,1"], "line 2"),
        ("a.csv", ["x,y"], "no points"),
        ("a.dat", ["title", "10. 10.", "0 0", "1 0"], "10 and 10 points are announced and 2"),
        ("a.dat", ["title", "0 0 0"], "3 numbers; allowed are two"),
        ("a.txt", ["0 0"], "name the file so"),
    ],
)
def test_files_that_are_no_outline(tmp_path: Path, name: str, lines: list[str], said: str) -> None:
    with pytest.raises(OutlineError, match="a\\.") as caught:
        read_outline(written(tmp_path, name, lines))
    assert said in str(caught.value)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_title_in_any_usual_encoding(tmp_path: Path, encoding: str) -> None:
    rows = [f"{x:.6f} {y:.6f}" for x, y in shapes.naca("0012")[::8]]
    path = tmp_path / "goe.dat"
    path.write_text("\n".join(["GÖTTINGEN 0012", *rows]), encoding=encoding)
    assert read_outline(path).points.shape == (len(rows), 2)


def test_polygon_keeps_its_corners(tmp_path: Path) -> None:
    path = written(tmp_path, "box.csv", ["# a box", "x, y", "0,0", "2,0", "2,1", "0,1", "0,0"])
    found = read_outline(path)
    assert not found.is_airfoil
    assert outline_of(placed(found.points)).area == pytest.approx(0.5)


def test_beam_has_its_outline() -> None:
    assert Beam().outline_in_flow() is None
    rectangle = Beam(outline=OutlineKeys.model_validate({"rectangle": {}})).outline_in_flow()
    assert rectangle is not None
    assert rectangle.area == pytest.approx(0.04)


@pytest.mark.parametrize(
    ("outline", "said"),
    [
        ({"naca": 12}, "put it in quotes"),
        ({"naca": "00x2"}, "allowed are four digits in quotes"),
        ({"naca": "4012"}, "a camber needs its place"),
        ({}, "allowed is one of rectangle, naca and file"),
        ({"naca": "0012", "file": "a.dat"}, "allowed is one of rectangle, naca and file"),
        ({"rectangle": {"edge_radius": 0.01}}, "up to half the thickness"),
        ({"naca": "0012", "chord": 3}, "beam.outline.chord: 3: allowed is null without"),
        ({"naca": "0012", "colour": "red"}, "beam.outline.colour"),
    ],
)
def test_keys_that_are_no_outline(outline: dict[str, object], said: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load_config({"beam": {"outline": outline, "cross_section": CROSS_SECTION}})
    assert said in str(caught.value)


def test_structure_of_an_airfoil_is_not_that_of_a_rectangle() -> None:
    with pytest.raises(ConfigError, match=r"beam\.cross_section: null: allowed with beam\.outline"):
        load_config({"beam": {"outline": {"naca": "0012"}}})


@pytest.mark.parametrize(
    ("beam", "said"),
    [
        ({"outline": {"rectangle": {"thickness": 3.0}}}, "beam.outline.rectangle.thickness: 3: "),
        ({"outline": {"rectangle": {}}, "thickness": 1e-5}, "beam.thickness: 1e-05: "),
    ],
)
def test_size_of_a_shape_is_refused_by_its_key(beam: dict[str, object], said: str) -> None:
    beam = {**beam, "cross_section": CROSS_SECTION}
    config = load_config({"beam": beam, "structure": {"method": "beam"}})
    with pytest.raises(ConfigError) as caught:
        check_outline(config)
    assert f"config: {said}" in str(caught.value)


def test_bad_file_is_refused_before_any_job(tmp_path: Path) -> None:
    written(tmp_path, "eight.csv", ["0,0", "1,1", "1,0", "0,1"])
    beam = {"outline": {"file": "eight.csv"}, "cross_section": CROSS_SECTION}
    structure = {"method": "beam"}
    config = load_config({"beam": beam, "structure": structure})
    with pytest.raises(ConfigError, match=r"beam\.outline\.file: 'eight\.csv': it crosses itself"):
        check_outline(config, tmp_path)
    (tmp_path / "eight.csv").unlink()
    with pytest.raises(ConfigError, match=r"'eight\.csv': there is no such file"):
        check_outline(config, tmp_path)
