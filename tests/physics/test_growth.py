"""Growth of a motion with its standard error."""

import json
import math

import numpy as np
import pytest
from tests.workflow.project import ROOT

from equisection.results.netcdf import read_dataset
from equisection.verdict.growth import growth_of, growth_window, growths_of

TIME = np.arange(0.0, 60.0, 0.1)


def wave(rate: float, frequency: float, phase: float = 0.0) -> np.ndarray:
    return np.exp(rate * TIME) * np.cos(2.0 * math.pi * frequency * TIME + phase)


def coupled(pitch_rate: float, heave_rate: float = -0.03) -> list[np.ndarray]:
    """Twist and deflection of a pitch at 0.15 and a heave at 0.04, each in both."""
    pitch, heave = wave(pitch_rate, 0.15), wave(heave_rate, 0.04, 1.0)
    return [0.1 + pitch + 0.4 * heave, 2.0 + 0.3 * pitch - 2.0 * heave]


@pytest.mark.parametrize("rate", [-0.02, 0.0, 0.03])
def test_two_coupled_motions_are_told_apart(rate):
    found = growth_of(TIME, coupled(rate), [0.16, 0.045])
    # records are read linearly between samples, which rounds their tops by 1e-4
    assert found.rate == pytest.approx(rate, abs=1e-5)
    assert found.frequency == pytest.approx(0.15, abs=1e-5)
    assert found.standard_error < 1e-5
    assert not found.note


def test_growth_has_no_unit_and_no_sign():
    """Twist in degrees, deflection downwards: the same growth."""
    twist, deflection = coupled(0.01)
    turned = growth_of(TIME, [-57.3 * twist, -4.0 * deflection], [0.16, 0.045])
    assert turned.rate == pytest.approx(growth_of(TIME, coupled(0.01), [0.16, 0.045]).rate)


def test_standard_error_covers_the_error_with_noise():
    """The mean square of errors over standard errors of 40 noisy records is near 1."""
    random = np.random.default_rng(0)
    records = np.array([coupled(0.01)] * 40)  # (N, C, n)
    noisy = records + 0.05 * random.standard_normal(records.shape)
    found = growths_of(TIME, np.swapaxes(noisy, 0, 1), [[0.16, 0.045]] * 40, [(10.0, 59.0)] * 40)
    ratios = np.array([(one.rate - 0.01) / one.standard_error for one in found])
    assert 0.3 < np.mean(ratios**2) < 3.0


def test_a_third_motion_leaves_beats_which_the_fit_tells():
    beating = [wave(0.0, 0.15) + 0.9 * wave(0.0, 0.19), wave(-0.03, 0.04)]
    assert "beats" in growth_of(TIME, beating, [0.16, 0.045]).note
    three = growth_of(TIME, beating, [0.16, 0.045, 0.2])
    assert three.rate == pytest.approx(0.0, abs=1e-5)
    assert not three.note


def test_motions_that_beat_slower_than_the_window_are_said_to():
    close = [wave(0.0, 0.15) + 0.4 * wave(-0.02, 0.16), wave(0.0, 0.15) - wave(-0.02, 0.16)]
    assert "shorter than a beat" in growth_of(TIME, close, [0.15, 0.16]).note


def test_record_too_short_has_no_growth():
    assert math.isnan(growth_of(TIME[:200], np.array(coupled(0.0))[:, :200], [0.16, 0.04]).rate)
    assert math.isnan(growth_of([], np.empty((2, 0)), [0.16, 0.04]).rate)


def test_window_leaves_out_the_release_and_the_far_past():
    assert growth_window(30.0, 0.2) == (10.0, 30.0)
    assert growth_window(200.0, 0.2) == (160.0, 200.0)


def test_growth_of_the_beam_by_openfoam_falls_with_k_star():
    """No zigzag: the second bending mode swings near the pitch, and is fitted with it."""
    folder = ROOT / "results" / "reference"
    rates = {}
    for run, cases in (("", ("k5", "k6.44", "k8", "k10")), ("-long", ("k12", "k14"))):
        for case in cases:
            data = read_dataset(folder / f"paper-plate-openfoam-3d{run}/unsteady/3d/{case}.nc")
            beam = json.loads(data.attrs["case"])["beam"]
            natural = [beam["torsion_frequency"][0], *beam["bending_frequency"][:2]]
            records = [data["torsion_amplitude"].values[0], *data["bending_amplitude"].values[:2]]
            found = growth_of(data["time"].values, records, np.array(natural) / (2 * math.pi))
            rates[case] = found.rate
    values = np.array(list(rates.values()))
    assert (np.diff(values) < 0.0).all(), rates
    # convex like the growth of the section: no step that is larger than the one before
    slopes = -np.diff(values) / np.diff([5.0, 6.44, 8.0, 10.0, 12.0, 14.0])
    assert slopes.max() < 4.0 * slopes.min(), rates
    assert rates["k12"] < 0.0 < rates["k8"]
