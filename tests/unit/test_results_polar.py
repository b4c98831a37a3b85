from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.polar_dataset import at_resolution, gather_polar, given_polar, polar_at
from equisection.results.steady_result import SteadyResult
from equisection.results.surface import SectionSurface
from equisection.structure.mode_set import ModeSet

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


@pytest.mark.parametrize("spanwise", [False, True], ids=["section", "beam"])
def test_a_resolution_may_be_run_at_some_incidences_only(spanwise: bool, tmp_path: Path) -> None:
    cases = [("coarse", angle) for angle in ANGLES] + [("fine", 2.0), ("fine", 8.0)]
    made = gather_polar({case: result(case[1], spanwise) for case in cases})
    write_dataset(tmp_path / "polar.nc", made)
    polar = read_dataset(tmp_path / "polar.nc")
    fine = polar.sel(resolution="fine")
    assert polar["is_run"].sel(resolution="coarse").values.tolist() == [1] * 5
    assert fine["is_run"].values.tolist() == [0, 1, 0, 0, 1]
    np.testing.assert_allclose(fine["cl"].values, [np.nan, 0.2, np.nan, np.nan, 0.8])
    assert polar.attrs["failures"] == ""
    assert ("cl_section" in polar) == spanwise


def test_a_polar_has_nothing_of_the_surface_data_of_its_cases() -> None:
    one = np.ones(3)
    surface = SectionSurface(one, one, one, np.array(["upper"] * 3), one, one, one)
    nothing = np.empty(0)
    made = SteadyResult(
        0.1, 0.2, 0.3, nothing, nothing, nothing, "made up", surface=surface
    ).to_dataset()
    assert made["cp"].sizes == {"face": 3}
    results = {
        ("coarse", 0.0): made.assign_attrs(solver_description="made-up solver"),
        ("coarse", 2.0): result(2.0, False),
    }
    assert dict(gather_polar(results).sizes) == {"resolution": 1, "incidence_deg": 2}


def test_polar_is_read_without_its_failed_angles() -> None:
    polar = polar_at(gathered(True, (8.0,)), "coarse")
    np.testing.assert_allclose(np.degrees(polar.incidence), ANGLES[:4])
    np.testing.assert_allclose(polar.lift, [0.0, 0.2, 0.4, 0.6])
    assert polar.label == "made-up solver"


def test_too_few_angles_are_refused_with_their_failures() -> None:
    with pytest.raises(ResultFileError, match=r"has 3 incidences .* at least 4 .* too far"):
        polar_at(gathered(False, (6.0, 8.0)), "fine")


def test_given_polar_is_read_back_as_it_was(tmp_path: Path) -> None:
    csv = tmp_path / "tunnel.csv"
    csv.write_text(
        "incidence_deg,CL,CM,CD\n-2.5,-.26,-.06,.054\n0,0,0,.044\n5,.48,.07,.086\n10,.57,.066,.15\n"
    )
    write_dataset(tmp_path / "polar.nc", given_polar(Polar.read(csv, symmetric=False), "fine"))
    dataset = read_dataset(tmp_path / "polar.nc")
    assert dataset["incidence_deg"].values.tolist() == [-2.5, 0.0, 5.0, 10.0]
    polar = polar_at(dataset, "fine")
    np.testing.assert_array_equal(polar.lift, [-0.26, 0.0, 0.48, 0.57])
    np.testing.assert_array_equal(polar.moment, [-0.06, 0.0, 0.07, 0.066])
    np.testing.assert_array_equal(polar.drag, [0.054, 0.044, 0.086, 0.15])
    assert polar.label == "given: tunnel"


def test_polar_of_no_case_is_written_and_read(tmp_path: Path) -> None:
    write_dataset(tmp_path / "polar.nc", gather_polar({}))
    polar = read_dataset(tmp_path / "polar.nc")
    assert polar.sizes["resolution"] == 0
    assert set(polar.data_vars) == {"cd", "cl", "cm", "is_run"}
    with pytest.raises(ResultFileError, match="no resolution 'coarse'"):
        polar_at(polar, "coarse")


SPAN = np.linspace(0.0, 1.0, 21)
#: The in-plane mode stands first and must not be taken for a bending mode.
MODES = ModeSet(
    frequency=np.array([1.0, 2.0, 3.0]),
    kind=("in-plane", "bending", "torsion"),
    span=SPAN,
    shape=np.array([SPAN**4, SPAN**2, SPAN]),
    method="made up",
    elements="none",
)


def beam_polar(spread: Callable[[np.ndarray], np.ndarray], **stations: int) -> xr.Dataset:
    """Return the polar of a beam with a lift of a tenth of the incidence (deg), spread over z/L.

    Each resolution has as many stations as it is given, and an incidence that failed.
    """
    results = {}
    for resolution, count in stations.items():
        middles = (np.arange(count) + 0.5) / count
        for angle in ANGLES:
            load = angle / 10 * spread(middles)
            made = SteadyResult(
                0.04, load.mean(), load.mean() / 8, middles, load, load / 8, "made up", ""
            )
            described = made.to_dataset().assign_attrs(solver_description="made-up solver")
            results[resolution, angle] = described
        results[resolution, 10.0] = result(10.0, spanwise=True, failure="too far")
    return gather_polar(results)


@pytest.mark.parametrize("resolution", ["coarse", "fine"])
def test_load_that_falls_to_the_tip_is_felt_less_than_its_mean(resolution: str) -> None:
    """Of 2 (1 - z) a half is felt under z^2, two thirds under z."""
    polar = beam_polar(lambda z: 2 * (1 - z), coarse=200, fine=331)
    mean, felt = polar_at(polar, resolution), polar_at(polar, resolution, MODES)
    np.testing.assert_allclose(felt.lift, mean.lift / 2, rtol=1e-4, atol=1e-12)
    np.testing.assert_allclose(felt.moment, mean.moment * 2 / 3, rtol=1e-4, atol=1e-12)
    np.testing.assert_array_equal(felt.drag, mean.drag)
    assert np.degrees(felt.incidence) == pytest.approx(ANGLES)  # without the one that failed


def test_uniform_load_is_felt_as_its_mean() -> None:
    polar = beam_polar(np.ones_like, coarse=23)
    mean, felt = polar_at(polar, "coarse"), polar_at(polar, "coarse", MODES)
    np.testing.assert_allclose(felt.lift, mean.lift, rtol=1e-12)
    np.testing.assert_allclose(felt.moment, mean.moment, rtol=1e-12)


def test_each_resolution_has_the_stations_of_its_mesh() -> None:
    polar = beam_polar(np.sqrt, coarse=23, fine=36)
    for resolution, count in (("coarse", 23), ("fine", 36)):
        of_mesh = at_resolution(polar, resolution)
        assert of_mesh["span"].values == pytest.approx((np.arange(count) + 0.5) / count)
        loads = of_mesh["cl_section"].sel(incidence_deg=list(ANGLES))
        np.testing.assert_allclose(loads, np.outer(np.array(ANGLES) / 10, np.sqrt(of_mesh["span"])))


def test_beam_without_loads_along_the_span_has_none_that_modes_feel() -> None:
    with pytest.raises(ResultFileError, match="correction: mean"):
        polar_at(gathered(spanwise=False), "coarse", MODES)
    everything_failed = gathered(spanwise=True, failed=ANGLES)
    with pytest.raises(ResultFileError, match="0 incidences with a result"):
        polar_at(everything_failed, "coarse", MODES)
