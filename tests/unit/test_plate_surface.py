"""Surface data of the plate: loads that they add up to, bubble along the span, the way to file."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from equisection.analysis.bubble import plate_bubble_table
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.plate_surface import PlateSurface, joined, plate_surface_from_dataset
from equisection.results.steady_result import SteadyResult
from equisection.results.surface import surface_from_dataset

SPAN, THICKNESS = 2.0, 0.04
ALONG, LAYERS = 20, 8


def plate() -> PlateSurface:
    """Return the surface of a plate without loads: uniform faces, all of it but the root."""
    x, z = _middles(ALONG, 1.0), _middles(LAYERS, SPAN)
    y = _middles(4, THICKNESS) - THICKNESS / 2
    half = [THICKNESS / 2]
    return joined(
        [
            _side("upper", x, half, z),
            _side("lower", x, [-THICKNESS / 2], z),
            _side("leading edge", [0.0], y, z),
            _side("trailing edge", [1.0], y, z),
            _side("tip", x, y, [SPAN]),
        ]
    )


def _middles(count: int, end: float) -> np.ndarray:
    return (np.arange(count) + 0.5) * end / count


def _side(name: str, *places: list[float] | np.ndarray) -> PlateSurface:
    x, y, z = (np.ravel(part) for part in np.meshgrid(*places, indexing="ij"))
    sizes = [
        end / len(part)
        for part, end in zip(places, (1.0, THICKNESS, SPAN), strict=True)
        if len(part) > 1
    ]
    zero = np.zeros(x.size)
    return PlateSurface(
        x, y, z, zero + math.prod(sizes), np.full(x.size, name), zero, zero, zero, zero + 1.0
    )


def loaded(**values: np.ndarray) -> PlateSurface:
    return dataclasses.replace(plate(), **values)


@pytest.mark.parametrize("incidence_deg", [0.0, 2.5, -7.0])
def test_uniform_pressure_has_no_loads(incidence_deg: float) -> None:
    loads = loaded(pressure=np.full(plate().x.size, 3.0)).loads(incidence_deg)
    assert loads == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_suction_of_a_part_of_the_span_lifts_as_much_as_the_part_is() -> None:
    """Over a quarter of the span, on the front half: a lift of 0.8/8, a quarter chord ahead."""
    whole = plate()
    part = (whole.side == "upper") & (whole.z > 0.75 * SPAN) & (whole.x < 0.5)
    drag, lift, moment = loaded(pressure=np.where(part, -0.8, 0.0)).loads(10.0)
    assert math.hypot(drag, lift) == pytest.approx(0.1)
    assert drag / lift == pytest.approx(math.tan(math.radians(10.0)))
    assert moment == pytest.approx(0.1 * 0.25)


def test_pressure_on_the_tip_has_no_loads_in_the_plane() -> None:
    loads = loaded(pressure=np.where(plate().side == "tip", 5.0, 0.0)).loads(3.0)
    assert loads == pytest.approx((0.0, 0.0, 0.0), abs=1e-15)


def test_buoyancy_in_a_pressure_that_falls_along_the_stream_is_drag() -> None:
    """Gauss: c_p = -g x pushes with g times the volume, over the area of the plan."""
    whole = plate()
    cosine, sine = math.cos(math.radians(5.0)), math.sin(math.radians(5.0))
    drag, lift, _ = loaded(pressure=-0.3 * (whole.x * cosine + whole.y * sine)).loads(5.0)
    assert drag == pytest.approx(0.3 * THICKNESS)
    assert lift == pytest.approx(0.0, abs=1e-12)


def test_friction_along_the_chord_drags_and_that_along_the_span_does_not() -> None:
    upper, tip = plate().side == "upper", plate().side == "tip"
    drag, lift, moment = loaded(friction=np.where(upper, 0.01, 0.0)).loads(0.0)
    assert (drag, lift) == pytest.approx((0.01, 0.0), abs=1e-15)
    assert moment == pytest.approx(0.01 * THICKNESS / 2)
    assert loaded(spanwise_friction=np.where(upper, 0.01, 0.0)).loads(0.0) == (0.0, 0.0, 0.0)
    # on the tip the other direction is upwards
    upwards = loaded(spanwise_friction=np.where(tip, 0.01, 0.0)).loads(0.0)
    assert upwards == pytest.approx((0.0, 0.01 * THICKNESS / SPAN, 0.0), abs=1e-15)


def test_bubble_of_each_layer_ends_where_the_friction_changes_its_sign() -> None:
    whole = plate()
    end = 0.8 - 0.3 * whole.z / SPAN
    surface = loaded(friction=np.where(whole.side == "lower", whole.x - end, 1.0))
    z, bubble = surface.reattachment("lower")
    np.testing.assert_allclose(z, _middles(LAYERS, SPAN))
    np.testing.assert_allclose(bubble, 0.8 - 0.3 * z / SPAN)
    assert (surface.reattachment("upper")[1] == 0.0).all()


def test_faces_of_the_ranks_come_in_one_order_however_they_are_divided() -> None:
    whole = plate()
    rounding = 1e-13 * np.arange(whole.x.size)
    far = whole.x > 0.5
    moved = dataclasses.replace(whole, z=whole.z + rounding)
    parts = [moved.taken(far), moved.taken(~far), moved.taken(whole.x > 2.0)]
    again = joined(parts)
    for name in ("x", "y", "side"):
        np.testing.assert_array_equal(getattr(again, name), getattr(whole, name))


def result(surface: PlateSurface | None) -> xr.Dataset:
    span = np.linspace(0.1, 0.9, 3)
    return SteadyResult(0.1, 0.2, 0.3, span, span, span, "steady", surface=surface).to_dataset()


def test_surface_is_read_back_in_single_precision(tmp_path: Path) -> None:
    faces = plate().x.size
    surface = loaded(
        pressure=np.linspace(-1, 1, faces), spanwise_friction=np.linspace(0, 1e-3, faces)
    )
    write_dataset(tmp_path / "a1.nc", result(surface))
    again = plate_surface_from_dataset(read_dataset(tmp_path / "a1.nc"))
    assert again is not None
    np.testing.assert_array_equal(again.side, surface.side)
    for name in ("x", "z", "area", "pressure", "spanwise_friction"):
        np.testing.assert_allclose(getattr(again, name), getattr(surface, name), rtol=1e-7)
    assert again.loads(2.5) == pytest.approx(surface.loads(2.5), rel=1e-5, abs=1e-7)


def test_result_without_surface_data_of_the_plate_has_none() -> None:
    assert plate_surface_from_dataset(result(None)) is None
    assert surface_from_dataset(result(None)) is None


def test_unknown_side_is_refused() -> None:
    dataset = result(plate()).assign(side=("face", ["root"] * plate().x.size))
    with pytest.raises(ResultFileError, match=r"root; allowed are upper, lower, .*, tip"):
        plate_surface_from_dataset(dataset)


def test_table_has_the_ends_of_the_bubble_on_the_suction_side_by_incidence() -> None:
    whole = plate()
    end = 0.4 - 0.2 * whole.z / SPAN  # of the bubble; 0.3 on the lower side
    friction = np.where(whole.side == "upper", whole.x - end, whole.x - 0.3)
    made = {"solver_description": "a solver", "resolution": "coarse"}
    results = [
        result(surface).assign_attrs(made, incidence_deg=angle)
        for angle, surface in (
            (4.0, loaded(friction=friction)),
            (-2.0, loaded(friction=friction)),
            (0.0, loaded(friction=friction)),
            (5.0, None),
        )
    ]
    table = plate_bubble_table(results)
    assert table["incidence_deg"].tolist() == [-2.0, 4.0]
    half_a_face = 0.5 / ALONG
    assert table["root"].tolist() == pytest.approx([0.3, 0.4], abs=half_a_face)
    assert table["tip"].tolist() == pytest.approx([0.3, 0.2], abs=half_a_face)
