"""One section released without a configuration: the solver's motion, its verdict, SI times."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT
from tests.plate_section import ATTACHED, CHORD, DENSITY, PLATE, POLAR, THIN, speed_of

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.errors import ArgumentError, IncidenceOutOfRangeError
from equisection.motion.sections import release_sections
from equisection.motion.stability import critical_speed, stability
from equisection.solvers.embedded.map_of_any_body import stability_map
from equisection.solvers.embedded.section_release import release

ONSET = float(
    critical_speed(PLATE, POLAR, incidence_deg=2.5, speed=(10.0, 80.0), density=DENSITY)[
        "critical_speed"
    ]
)


def test_motion_is_that_of_the_solver_and_times_are_those_of_the_chord():
    speed = speed_of(PLATE, 8.0)
    found = release(PLATE, POLAR, incidence_deg=2.5, speed=speed, density=DENSITY, duration=60.0)
    history = release_sections(
        [PLATE.in_flow(DENSITY, speed)], UnsteadyLoads.from_polar(POLAR), math.radians(2.5), 60.0
    )
    np.testing.assert_array_equal(found["twist"], history.twist[:, 0])
    np.testing.assert_allclose(found["deflection"], history.deflection[:, 0] * CHORD)
    np.testing.assert_array_equal(found["cm"], history.moment_coefficient[:, 0])
    np.testing.assert_allclose(found["time"], history.time * CHORD / speed)
    np.testing.assert_allclose(found["convective_time"], history.time)
    np.testing.assert_allclose(found["incidence"], math.radians(2.5) + history.twist[:, 0])


@pytest.mark.parametrize(("part", "regime"), [(0.8, "decaying"), (1.2, "growing")])
def test_verdict_turns_where_the_eigenvalue_says(part, regime):
    found = release(PLATE, POLAR, incidence_deg=2.5, speed=part * ONSET, density=DENSITY)
    assert found.attrs["regime"] == regime
    assert found.attrs["k_star"] == pytest.approx(PLATE.k_star(DENSITY, part * ONSET))
    small = stability(PLATE, POLAR, incidence_deg=2.5, speed=part * ONSET, density=DENSITY)
    assert found.attrs["frequency_strouhal"] == pytest.approx(
        float(small["frequency_strouhal"]), rel=0.05
    )
    if regime == "decaying":
        assert found.attrs["mean_twist_deg"] == pytest.approx(
            math.degrees(float(small["equilibrium_twist"])), rel=0.01
        )


def test_tip_is_recovered_from_the_section():
    section = PLATE.model_copy(update={"twist_recovery": 0.8, "deflection_recovery": 0.6})
    found = release(section, POLAR, incidence_deg=2.5, speed=20.0, duration=40.0)
    np.testing.assert_allclose(found["tip_twist"], found["twist"] / 0.8)
    np.testing.assert_allclose(found["tip_deflection"], found["deflection"] / 0.6)


def test_fast_pitch_gets_a_shorter_step():
    found = release(PLATE, POLAR, incidence_deg=2.5, speed=2.0, density=DENSITY)
    flowing = PLATE.in_flow(DENSITY, 2.0)
    period = 2 * math.pi * math.sqrt(flowing.inertia / flowing.torsional_stiffness)
    assert found.attrs["time_step"] == pytest.approx(period / 40)
    assert found.attrs["regime"] == "settled"
    assert release(PLATE, POLAR, incidence_deg=2.5, speed=20.0).attrs["time_step"] == 0.05


def test_section_that_leaves_the_polar_fails_with_the_reason():
    polar = Polar.flat_plate(math.radians(4.0))
    found = release(
        PLATE, polar, incidence_deg=2.0, speed=55.0, density=DENSITY, lags=SeparationLags.none()
    )
    assert found.attrs["regime"] == "failed"
    assert "left the section polar" in found.attrs["reason"]


def test_everything_has_units_and_can_be_written(tmp_path: Path):
    found = release(PLATE, POLAR, incidence_deg=2.5, speed=20.0, duration=20.0)
    assert found["time"].attrs["units"] == "s"
    for name, variable in found.variables.items():
        assert {"units", "long_name"} <= variable.attrs.keys(), name
    found.to_netcdf(tmp_path / "release.nc")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed": 0.0}, r"speed is 0\.0; wanted a number above 0 \(m/s\)"),
        ({"speed": math.inf}, "speed is inf"),
        ({"density": -1.0}, "density is -1.0"),
        ({"incidence_deg": math.nan}, "incidence_deg is nan"),
        ({"duration": 0.5}, "duration is 0.5; wanted 1 c/V or more"),
        ({"speed": 1e-300}, "speed is 1e-300; wanted a number above 0"),
        ({"speed": 1e-17}, "duration is 400; wanted up to .*, 10,000,000 time steps"),
        ({"start_heave_rate": 1e300}, r"wanted a number \(over V\) from -1 to 1"),
        ({"speed": "20"}, "speed is '20'; wanted a number above 0"),
        ({"density": [1.2, 1.3]}, r"density is \[1\.2, 1\.3\]; wanted a number above 0"),
        ({"incidence_deg": None}, r"incidence_deg is None; wanted a number \(deg\)"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(changes, words):
    with pytest.raises(ArgumentError, match=words):
        release(PLATE, POLAR, **{"incidence_deg": 2.5, "speed": 20.0, **changes})


def test_derivatives_are_no_polar_for_a_release_or_a_map():
    """They have no static loads."""
    derivatives = Derivatives.read(ROOT / "config" / "derivatives" / "thin_plate.csv")
    calls = (
        lambda: release(PLATE, derivatives, incidence_deg=2.5, speed=20.0),
        lambda: stability_map(PLATE, derivatives, incidence_deg=2.5, speed=[10.0, 20.0]),
        lambda: stability(PLATE, None, incidence_deg=2.5, speed=20.0),
    )
    for call in calls:
        with pytest.raises(ArgumentError, match=r"polar is a \w+; wanted a Polar, as Polar\.read"):
            call()


def test_incidence_beyond_the_polar_is_refused():
    with pytest.raises(IncidenceOutOfRangeError, match="15 deg is outside polar"):
        release(PLATE, POLAR, incidence_deg=15.0, speed=20.0)


@pytest.mark.parametrize(
    ("k_star", "incidence_deg", "duration", "regime"),
    [
        (1.0, 0.5, 1.0, "undecided"),
        (1.0, 0.5, 30.0, "undecided"),  # less than two periods, at 35 c/V beyond the bound
        (1.0, 0.5, 40.0, "growing"),
        (4.0, 0.5, 10.0, "undecided"),  # the second half swing is larger, and it decays
        (4.0, 0.5, 60.0, "decaying"),
        (21.0, 0.0, 60.0, "undecided"),  # nothing moves it
    ],
)
def test_thin_plate_is_not_judged_before_it_has_shown_what_it_does(
    k_star, incidence_deg, duration, regime
):
    found = release(
        PLATE,
        THIN,
        incidence_deg=incidence_deg,
        speed=speed_of(PLATE, k_star),
        density=DENSITY,
        lags=ATTACHED,
        duration=duration,
    )
    assert found.attrs["regime"] == regime, found.attrs["reason"]
    if regime == "decaying":
        theory = stability(
            PLATE,
            THIN,
            incidence_deg=incidence_deg,
            speed=found.attrs["speed"],
            density=DENSITY,
            lags=ATTACHED,
        )
        exact = float(theory["growth_rate_convective"])
        assert found.attrs["growth_high"] < 0.0
        assert found.attrs["growth_rate"] == pytest.approx(exact, rel=0.05)
