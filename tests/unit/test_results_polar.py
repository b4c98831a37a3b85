import numpy as np
import pytest
import xarray as xr

from equisection.errors import ResultFileError
from equisection.results.polar import gather_polar, polar_at
from equisection.results.steady import SteadyResult

ANGLES = (0.0, 2.0, 4.0, 6.0, 8.0)
STATIONS = np.array([0.25, 0.75])


def result(angle: float, spanwise: bool, failure: str = "") -> xr.Dataset:
    stations = STATIONS if spanwise and not failure else np.empty(0)
    lift = np.nan if failure else 0.1 * angle
    made = SteadyResult(
        lift, lift, lift, stations, lift + stations, lift - stations, "made up", failure
    )
    return made.to_dataset().assign_attrs(solver_description="made-up solver")


def gathered(spanwise: bool, failed: tuple[float, ...] = ()) -> xr.Dataset:
    return gather_polar(
        {
            (resolution, angle): result(angle, spanwise, "too far" if angle in failed else "")
            for resolution in ("fine", "coarse")
            for angle in reversed(ANGLES)
        }
    )


@pytest.mark.parametrize("spanwise", [False, True], ids=["section", "beam"])
@pytest.mark.parametrize("failed", [(), (0.0,), (8.0,), (6.0, 8.0), ANGLES], ids=str)
def test_each_angle_has_its_value_and_a_failed_one_none(
    spanwise: bool, failed: tuple[float, ...]
) -> None:
    polar = gathered(spanwise, failed)
    assert polar["incidence_deg"].values.tolist() == list(ANGLES)
    assert polar["resolution"].values.tolist() == ["fine", "coarse"]
    for angle in ANGLES:
        there = polar["cl"].sel(resolution="coarse", incidence_deg=angle)
        expected = np.nan if angle in failed else 0.1 * angle
        np.testing.assert_equal(float(there), expected)
        assert f"coarse {angle:g} deg: too far" in polar.attrs["failures"] or angle not in failed


@pytest.mark.parametrize("failed", [(), (0.0,), (8.0,)], ids=str)
def test_spanwise_loads_keep_their_stations_beside_failed_angles(
    failed: tuple[float, ...],
) -> None:
    polar = gathered(True, failed)
    assert polar["span"].values.tolist() == STATIONS.tolist()
    values = polar["cl_section"].sel(resolution="fine", incidence_deg=4.0).values
    np.testing.assert_allclose(values, 0.4 + STATIONS)
    for angle in failed:
        missing = polar["cl_section"].sel(resolution="fine", incidence_deg=angle).values
        assert np.isnan(missing).all()


def test_polar_is_read_without_its_failed_angles() -> None:
    polar = polar_at(gathered(True, (8.0,)), "coarse")
    np.testing.assert_allclose(np.degrees(polar.incidence), ANGLES[:4])
    np.testing.assert_allclose(polar.lift, [0.0, 0.2, 0.4, 0.6])
    assert polar.label == "made-up solver"


def test_too_few_angles_are_refused_with_their_failures() -> None:
    with pytest.raises(ResultFileError, match=r"has 3 incidences .* at least 4 .* too far"):
        polar_at(gathered(False, (6.0, 8.0)), "fine")
