"""Cycles, trend and mean of signals whose answers are known exactly."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equisection.verdict.cycles import find_cycles, noise_level
from equisection.verdict.superposition import bin_averages, mean_of, superposition
from equisection.verdict.trend import exponential_trend

PERIOD = 6.0
OMEGA = 2.0 * np.pi / PERIOD


def times(end=120.0, step=0.1):
    return np.arange(0.0, end, step)


@given(
    amplitude=st.floats(1e-6, 10.0),
    period=st.floats(3.0, 12.0),
    phase=st.floats(0.0, 6.28),
    mean=st.floats(-1.0, 1.0),
)
@settings(max_examples=40, deadline=None)
def test_amplitude_and_period_of_a_sine(amplitude, period, phase, mean):
    s = times()
    cycles = find_cycles(s, mean + amplitude * np.sin(2.0 * np.pi * s / period + phase))
    assert cycles.amplitude == pytest.approx(amplitude, rel=1e-3)
    assert cycles.period(10) == pytest.approx(period, rel=1e-3)


@pytest.mark.parametrize("step", [0.05, 0.1, 0.2, 0.5])
def test_sampling_does_not_matter_down_to_twelve_samples_a_period(step):
    s = times(step=step)
    cycles = find_cycles(s, np.sin(OMEGA * s + 0.3))
    assert cycles.amplitude == pytest.approx(1.0, rel=5e-3)
    assert cycles.period(10) == pytest.approx(PERIOD, rel=2e-3)


@pytest.mark.parametrize("rate", [-0.1, -0.03, -0.001, 0.001, 0.03, 0.1])
def test_growth_rate_of_an_exponential(rate):
    s = times()
    cycles = find_cycles(s, 0.2 + np.exp(rate * s) * np.cos(OMEGA * s))
    trend = exponential_trend(cycles.amplitude_time, cycles.amplitude)
    assert trend.growth_rate == pytest.approx(rate, rel=1e-2, abs=1e-6)


def test_a_slow_wave_and_a_drift_beneath_leave_the_amplitude_alone():
    s = times()
    slow = 0.5 * np.sin(OMEGA * s / 7.0) + 0.01 * s + 1e-4 * s**2
    cycles = find_cycles(s, np.sin(OMEGA * s) + slow)
    assert cycles.amplitude == pytest.approx(1.0, rel=5e-3)


def test_harmonics_do_not_make_cycles():
    s = times()
    signal = np.sin(OMEGA * s) + 0.2 * np.sin(3.0 * OMEGA * s) + 0.1 * np.cos(2.0 * OMEGA * s)
    cycles = find_cycles(s, signal)
    assert cycles.period(10) == pytest.approx(PERIOD, rel=1e-3)
    assert cycles.amplitude == pytest.approx(0.5 * np.ptp(signal), rel=1e-3)


@pytest.mark.parametrize("deviation", [0.0, 1e-3, 1e-2, 5e-2])
def test_noise_level(deviation):
    s = times(400.0)
    noise = deviation * np.random.default_rng(1).standard_normal(s.size)
    assert noise_level(np.sin(OMEGA * s) + noise) == pytest.approx(deviation, rel=0.1, abs=1e-6)


def test_noise_makes_no_cycles():
    s = times(400.0)
    noise = 0.02 * np.random.default_rng(2).standard_normal(s.size)
    cycles = find_cycles(s, np.sin(OMEGA * s) + noise)
    assert cycles.time.size == pytest.approx(2.0 * 400.0 / PERIOD, abs=1.0)
    assert np.mean(cycles.amplitude) == pytest.approx(1.0, rel=0.01)
    assert cycles.period(20) == pytest.approx(PERIOD, rel=5e-3)


@pytest.mark.parametrize("signal", [np.zeros(200), np.full(200, 0.3), np.linspace(0.0, 1.0, 200)])
def test_what_does_not_oscillate_has_no_cycles(signal):
    cycles = find_cycles(np.arange(200.0), signal)
    assert cycles.amplitude.size == 0
    assert np.isnan(cycles.period(10))


def test_trend_of_a_steady_amplitude_is_not_clear():
    s = np.arange(0.0, 30.0, 3.0)
    amplitude = 1.0 + 0.002 * np.random.default_rng(3).standard_normal(s.size)
    assert not exponential_trend(s, amplitude).clear(0.0)
    assert exponential_trend(s, np.exp(0.01 * s)).clear(0.02)
    assert not exponential_trend(s, np.exp(0.0001 * s)).clear(0.02)


def test_bin_averages_are_exact_for_a_straight_line():
    s = np.sort(np.random.default_rng(4).uniform(0.0, 10.0, 200))
    centre, average = bin_averages(s, np.stack((s, 2.0 - s)), 0.7, 9)
    assert average[0] == pytest.approx(centre)
    assert average[1] == pytest.approx(2.0 - centre)


def test_mean_over_whole_periods():
    s = times()
    assert mean_of(s, 0.3 + np.sin(OMEGA * s), 11.03, 11.03 + 5 * PERIOD) == pytest.approx(
        0.3, abs=1e-3
    )


@pytest.mark.parametrize("noise", [0.0, 1e-3])
def test_constant_under_two_decaying_waves(noise):
    s = times(70.0)
    random = np.random.default_rng(5)
    pitch = np.exp(-0.02 * s) * np.cos(OMEGA * s)
    heave = np.exp(-0.03 * s) * np.cos(2.0 * np.pi * s / 40.0 + 0.5)
    twist = 0.7 + pitch + 0.3 * heave + noise * random.standard_normal(s.size)
    deflection = 0.2 + 0.02 * pitch - 0.3 * heave + noise * random.standard_normal(s.size)
    fit = superposition(s, np.stack((twist, deflection)), 10.0, PERIOD)
    assert fit.constant == pytest.approx([0.7, 0.2], abs=1e-4 if noise == 0.0 else 5e-3)
    frequency = np.abs(fit.rates.imag) / (2.0 * np.pi)
    for expected in (1.0 / PERIOD, 1.0 / 40.0):
        assert np.min(np.abs(frequency - expected)) < 0.02 * expected
