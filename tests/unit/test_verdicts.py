"""Attributes of a verdict, for every solver alike."""

import math

import numpy as np
import pytest
from tests.sample_cases import UNSTEADY, UNSTEADY_PLATE
from tests.workflow.project import ROOT

from equisection.cases import UnsteadyCase
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import VERDICT_ATTRIBUTES, VERDICT_UNITS
from equisection.solvers.verdicts import (
    Judge,
    TipMotion,
    growths_of_tips,
    judge,
    pitch_frequency,
    refused,
)
from equisection.store.judged_again import tip_motion

REFERENCE = ROOT / "results" / "reference"
TIME = np.arange(0.0, 60.0, 0.05)
LEFT = "an incidence of 25.1 deg left the section polar"


def moved(turns_deg: list[float], end: float) -> TipMotion:
    """Return a twist that goes from turn to turn, in equal times."""
    time = TIME[end >= TIME]
    twist = np.radians(np.interp(time, np.linspace(0.0, end, len(turns_deg)), turns_deg))
    return TipMotion(time, twist, 0.1 * twist)


@pytest.mark.parametrize(
    ("turns_deg", "regime"),
    [
        ([0.0, 15.4, -13.0, 32.2, -55.8], "growing"),
        ([0.0, 15.4], "failed"),  # may be the first swing of a release that is stable
    ],
)
def test_what_leaves_the_polar_by_ever_larger_swings_has_grown(
    turns_deg: list[float], regime: str
) -> None:
    verdict = judge(UNSTEADY, moved(turns_deg, 30.0), LEFT)
    assert verdict["regime"] == regime
    assert LEFT in verdict["reason"]


def test_frequency_in_vacuum_is_that_of_the_section_or_of_the_first_torsion_mode() -> None:
    """f c/V = sqrt(k*/I*)/(2 pi), of the plate's mode omega c/V over 2 pi."""
    assert pitch_frequency(UNSTEADY) == pytest.approx(math.sqrt(6.44 / 6.7) / 6.2831853)
    assert UNSTEADY_PLATE.beam is not None
    omega = UNSTEADY_PLATE.beam.torsion_frequency[0]
    assert pitch_frequency(UNSTEADY_PLATE) == pytest.approx(omega / 6.2831853)


def test_frequency_is_that_of_an_oscillation_or_not_known() -> None:
    """Not the structure's in vacuum, which stands in for a period where there is none."""
    ringing = np.radians(np.exp(-0.01 * TIME) * np.cos(1.1 * TIME))
    found = judge(UNSTEADY, TipMotion(TIME, ringing, 0.1 * ringing))
    assert found["frequency_strouhal"] == pytest.approx(1.1 / (2 * math.pi), rel=1e-3)
    creeping = np.radians(1.0 - np.exp(-0.1 * TIME))
    found = judge(UNSTEADY, TipMotion(TIME, creeping, 0.1 * creeping))
    assert math.isnan(found["frequency_strouhal"])


def test_turns_tell_divergence_from_an_oscillation_that_left_too_soon() -> None:
    """A twist without restoring stiffness, theta'' = (theta + theta_0)/16, never turns.

    The kept release of the deck at 10.5 m/s turned three times before 30 c/V.
    """
    leaving = np.radians(np.cosh(0.25 * TIME[TIME <= 15.0]) - 1.0)
    found = judge(UNSTEADY, TipMotion(TIME[: leaving.size], leaving, 0.1 * leaving))
    assert (found["regime"], found["twist_turns"]) == ("growing", 0)
    kept = read_dataset(REFERENCE / "openfoam-deck/unsteady/2d/v10.5.nc")
    case = UnsteadyCase.model_validate_json(kept.attrs["case"])
    found = judge(case, tip_motion(kept))
    assert (found["regime"], found["twist_turns"]) == ("growing", 3)
    assert math.isnan(found["frequency_strouhal"])


def ringing(rate: float, end: float) -> TipMotion:
    """Return a pitch near its natural frequency that grows at a rate, with a damped heave."""
    time = TIME[end >= TIME]
    pitch = np.radians(np.exp(rate * time) * np.cos(0.95 * time))
    heave = np.exp(-0.05 * time) * np.cos(0.11 * time)
    return TipMotion(time, pitch + 0.01 * heave, 0.1 * pitch - 0.2 * heave)


def test_growth_of_motions_of_unlike_length_is_that_of_each_alone() -> None:
    judged = Judge.of(UNSTEADY)
    tips = [ringing(0.02, 59.0), ringing(-0.01, 45.0), ringing(0.0, 12.0), ringing(0.01, 59.0)]
    together = growths_of_tips([judged] * 4, tips)
    for tip, found, rate in zip(tips, together, (0.02, -0.01, math.nan, 0.01), strict=True):
        (alone,) = growths_of_tips([judged], [tip])
        assert found.rate == pytest.approx(rate, abs=2e-4, nan_ok=True)
        assert found.rate == pytest.approx(alone.rate, abs=1e-6, nan_ok=True)
        assert found.end == pytest.approx(alone.end, nan_ok=True)
    broken = TipMotion(TIME, np.full_like(TIME, np.nan), TIME)
    assert math.isnan(growths_of_tips([judged], [broken])[0].rate)


def test_growth_in_a_result_has_its_error_and_window_or_none() -> None:
    found = judge(UNSTEADY, ringing(-0.01, 45.0))
    assert found.keys() == VERDICT_ATTRIBUTES.keys() == VERDICT_UNITS.keys()
    assert found["regime"] == "decaying"
    assert found["growth_low"] < found["growth_rate"] < found["growth_high"] < 0.0
    assert found["growth_low"] <= -0.01 <= found["growth_high"]
    assert (found["growth_start"], found["growth_end"]) == (10.0, pytest.approx(45.0))
    assert found["growth_note"] == ""
    # of a case that is not run there is no growth at all
    never = refused(UNSTEADY.model_copy(update={"refusal": "none", "section": None})).verdict
    assert never.keys() == found.keys()
    for name in ("rate", "standard_error", "low", "high", "start", "end"):
        assert math.isnan(float(never[f"growth_{name}"]))
