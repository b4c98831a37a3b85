"""Surface data of the section: loads that they add up to, bubble, table, and the way to file."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from equisection.analysis.bubble import bubble_table
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.steady_result import SteadyResult
from equisection.results.surface import SectionSurface, suction_side, surface_from_dataset

NOTHING = np.empty(0)
THICKNESS = 0.04


def section(faces: int = 50) -> SectionSurface:
    """Return the contour of a plate without loads, each side of as many faces."""
    along = (np.arange(faces) + 0.5) / faces
    across = THICKNESS * (along - 0.5)
    one = np.ones(faces)
    return SectionSurface(
        x=np.concatenate([along, along, 0 * one, one]),
        y=np.concatenate([THICKNESS / 2 * one, -THICKNESS / 2 * one, across, across]),
        length=np.repeat([1.0, 1.0, THICKNESS, THICKNESS], faces) / faces,
        side=np.repeat(["upper", "lower", "leading edge", "trailing edge"], faces),
        pressure=np.zeros(4 * faces),
        friction=np.zeros(4 * faces),
        y_plus=np.ones(4 * faces),
    )


def loaded(**values: np.ndarray) -> SectionSurface:
    whole = section()
    fields = {name: getattr(whole, name) for name in whole.__dataclass_fields__}
    return SectionSurface(**{**fields, **values})


@pytest.mark.parametrize("incidence_deg", [0.0, 2.5, -7.0])
def test_uniform_pressure_has_no_loads(incidence_deg: float) -> None:
    loads = loaded(pressure=np.full(200, 3.0)).loads(incidence_deg)
    assert loads == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_suction_of_the_upper_side_lifts_along_its_normal() -> None:
    upper = section().side == "upper"
    drag, lift, moment = loaded(pressure=np.where(upper, -0.8, 0.0)).loads(10.0)
    assert math.hypot(drag, lift) == pytest.approx(0.8)
    assert drag / lift == pytest.approx(math.tan(math.radians(10.0)))
    assert moment == pytest.approx(0.0, abs=1e-12)


def test_suction_of_the_front_half_turns_the_nose_up() -> None:
    """A half chord of c_p = -1 acts a quarter chord ahead of mid-chord."""
    whole = section()
    front = (whole.side == "upper") & (whole.x < 0.5)
    _, lift, moment = loaded(pressure=np.where(front, -1.0, 0.0)).loads(0.0)
    assert lift == pytest.approx(0.5)
    assert moment == pytest.approx(0.5 * 0.25)


def test_buoyancy_in_a_pressure_that_falls_along_the_stream_is_drag() -> None:
    """Gauss: the force of c_p = -g x on a body is g times its area, along the stream."""
    whole = section()
    cosine, sine = math.cos(math.radians(5.0)), math.sin(math.radians(5.0))
    along_stream = whole.x * cosine + whole.y * sine
    drag, lift, _ = loaded(pressure=-0.3 * along_stream).loads(5.0)
    assert drag == pytest.approx(0.3 * THICKNESS)
    assert lift == pytest.approx(0.0, abs=1e-12)


def test_friction_of_both_sides_drags_and_that_of_one_turns() -> None:
    whole = section()
    drag, lift, moment = loaded(friction=np.where(whole.side == "upper", 0.01, 0.0)).loads(0.0)
    assert (drag, lift) == pytest.approx((0.01, 0.0), abs=1e-15)
    assert moment == pytest.approx(0.01 * THICKNESS / 2)
    at_edge = loaded(friction=np.where(whole.side == "leading edge", 0.01, 0.0)).loads(0.0)
    assert at_edge == pytest.approx((0.0, 0.01 * THICKNESS, 0.01 * THICKNESS / 2))


def bubble(friction: np.ndarray, side: str = "upper") -> float:
    whole = section()
    values = np.where(whole.side == side, 0.0, 1.0)
    values[whole.side == side] = friction
    return loaded(friction=values).reattachment(side)


X = (np.arange(50) + 0.5) / 50


@pytest.mark.parametrize("side", ["upper", "lower"])
@pytest.mark.parametrize("end", [0.1, 0.355, 0.8])
def test_bubble_ends_where_the_friction_changes_its_sign(side: str, end: float) -> None:
    assert bubble(X - end, side) == pytest.approx(end)


def test_attached_flow_has_no_bubble_and_stalled_flow_one_of_the_whole_chord() -> None:
    assert bubble(1.0 + X) == 0.0
    assert bubble(-1.0 - X) == 1.0


def test_small_vortices_at_the_edges_are_not_the_end_of_the_bubble() -> None:
    """The corner of the leading edge has a reversed and a secondary vortex (seen in OpenFOAM)."""
    friction = X - 0.4
    friction[:3] = (5.0, -8.0, 0.1)
    assert bubble(friction) == pytest.approx(0.4)
    whole_chord = -1.0 - X
    whole_chord[-1] = 0.5
    assert bubble(whole_chord) == pytest.approx(0.99, abs=0.01)


def result(surface: SectionSurface | None, failure: str = "") -> xr.Dataset:
    value = math.nan if failure else 0.1
    made = SteadyResult(
        value, value, value, NOTHING, NOTHING, NOTHING, "steady", failure, surface=surface
    )
    return made.to_dataset().assign_attrs(solver_description="made up", case_hash="ab12")


def test_surface_is_read_back_as_it_was(tmp_path: Path) -> None:
    surface = loaded(pressure=np.linspace(-1, 1, 200), friction=np.linspace(0, 1e-3, 200))
    write_dataset(tmp_path / "a1.nc", result(surface))
    again = surface_from_dataset(read_dataset(tmp_path / "a1.nc"))
    assert again is not None
    for name in surface.__dataclass_fields__:
        np.testing.assert_array_equal(getattr(again, name), getattr(surface, name))


def test_result_without_surface_data_has_none() -> None:
    assert surface_from_dataset(result(None)) is None


def test_unknown_side_is_refused() -> None:
    dataset = result(section()).assign(side=("face", ["front"] * 200))
    with pytest.raises(ResultFileError, match="front; allowed are upper, lower"):
        surface_from_dataset(dataset)


def test_table_has_bubble_and_wall_distance_of_the_sides_without_the_edges() -> None:
    whole = section()
    on_edge = np.isin(whole.side, ["leading edge", "trailing edge"])
    y_plus = np.where(on_edge, 9.0, np.where(whole.x < 0.25, 2.0, 0.5))
    friction = np.where(whole.side == "upper", whole.x - 0.4, whole.x - 0.2)
    surface = loaded(y_plus=y_plus, friction=friction)
    results = {("coarse", 5.0): result(surface), ("coarse", -5.0): result(surface)}
    table = bubble_table(results).set_index("incidence_deg")
    assert table.loc[5.0, "bubble"] == pytest.approx(0.4)
    assert table.loc[-5.0, "bubble"] == pytest.approx(0.2)
    assert table["side"].to_dict() == {5.0: "upper", -5.0: "lower"}
    assert table.loc[5.0, "y_plus_largest"] == 2.0
    assert table.loc[5.0, "y_plus_below_1"] == pytest.approx(0.76)
    assert table.loc[5.0, "y_plus_mean"] == pytest.approx(0.24 * 2.0 + 0.76 * 0.5)


def test_table_goes_by_resolution_as_given_and_ascending_incidence() -> None:
    """A line of Fig. 7 joins neighbours; meshes are listed as the configuration has them."""
    cases = [("medium", 10.0), ("medium", 2.0), ("coarse", 0.0), ("coarse", 10.0), ("coarse", 5.0)]
    table = bubble_table({case: result(section()) for case in cases})
    found = list(zip(table["resolution"], table["incidence_deg"], strict=True))
    assert found == [
        ("medium", 2.0),
        ("medium", 10.0),
        ("coarse", 0.0),
        ("coarse", 5.0),
        ("coarse", 10.0),
    ]


def test_table_says_why_there_is_no_bubble() -> None:
    results = {
        ("coarse", 0.0): result(None),
        ("coarse", 9.0): result(None, failure="the loads are beyond reason"),
    }
    table = bubble_table(results)
    assert table["bubble"].isna().all()
    assert "delete results/.store/ab12" in table["note"][0]
    assert table["note"][1] == "the loads are beyond reason"


def test_upper_side_is_the_suction_side_from_zero_on() -> None:
    assert [suction_side(angle) for angle in (-1.0, 0.0, 1.0)] == ["lower", "upper", "upper"]
