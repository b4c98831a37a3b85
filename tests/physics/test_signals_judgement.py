"""Verdicts on signals whose fate is known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equisection.errors import ResultFileError
from equisection.verdict import Criteria, assess, swings_grow
from equisection.verdict.growth import growth_of

PERIOD = 6.0
OMEGA = 2.0 * np.pi / PERIOD
S = np.arange(0.0, 300.0, 0.1)
REST = np.zeros_like(S)


def early(s, twist, deflection, step=20.0, **options):
    """First verdict of a run that is asked every ``step`` c/V, and when; else the last."""
    verdict = None
    for end in np.arange(step, s[-1] + step, step):
        upto = s <= end
        verdict = assess(s[upto], twist[upto], deflection[upto], **options)
        if verdict.decided:
            break
    return verdict


def release(rate, heave_rate=0.02, heave_period=40.0, mean=0.5, amplitude=1.0):
    """Twist (rad) and deflection (chords) of a released section: pitch and slow heave."""
    heave = np.exp(-heave_rate * S) * np.cos(2.0 * np.pi * S / heave_period)
    pitch = np.exp(rate * S) * np.cos(OMEGA * S)
    twist = np.radians(mean - amplitude * pitch - 0.3 * heave)
    return twist, 0.3 - 0.1 * heave - 0.002 * pitch


def test_sine_is_a_limit_cycle():
    verdict = early(S, 0.01 + 0.03 * np.sin(OMEGA * S), 0.2 + 0.005 * np.cos(OMEGA * S))
    assert verdict.regime == "limit-cycle"
    assert verdict.periods_used == 5
    assert verdict.end_time - verdict.start_time == pytest.approx(5 * PERIOD, rel=1e-3)
    assert verdict.twist_amplitude == pytest.approx(0.03, rel=1e-3)
    assert verdict.deflection_amplitude == pytest.approx(0.005, rel=1e-2)
    assert verdict.frequency == pytest.approx(1.0 / PERIOD, rel=1e-3)
    assert verdict.mean_twist == pytest.approx(0.01, abs=1e-5)
    assert verdict.mean_deflection == pytest.approx(0.2, abs=1e-5)
    assert abs(verdict.growth_rate) < 1e-5


@pytest.mark.parametrize("rate", [-0.03, -0.02, -0.01])
def test_means_of_a_release_are_right_before_it_has_come_to_rest(rate):
    verdict = early(S, *release(rate))
    assert verdict.regime == ("settled" if rate == -0.03 else "decaying")
    assert verdict.end_time < 200.0
    assert math.degrees(verdict.mean_twist) == pytest.approx(0.5, abs=0.02)
    assert verdict.mean_deflection == pytest.approx(0.3, abs=0.002)
    assert verdict.growth_rate == pytest.approx(rate, rel=0.01)


@pytest.mark.parametrize("rate", [-0.006, -0.01])
def test_fall_that_does_not_slow_ends_a_run_long_before_it_is_over(rate):
    """Two windows after the transient are 70 c/V; a fifth of it is left after 160 or more."""
    twist, deflection = release(rate, heave_rate=0.05)
    verdict = early(S, twist, deflection, step=5.0)
    assert verdict.regime == "decaying"
    assert "does not slow" in verdict.reason
    assert verdict.end_time < 100.0
    assert verdict.growth_rate == pytest.approx(rate, rel=0.02)


def test_heave_that_rings_under_a_twist_at_rest():
    heave = np.exp(-0.01 * S) * np.cos(2.0 * np.pi * S / 40.0)
    verdict = early(S, REST + 0.01, 0.3 - 0.1 * heave, natural_frequency=1.0 / PERIOD)
    assert verdict.regime == "settled"
    assert verdict.end_time < 100.0
    assert verdict.mean_deflection == pytest.approx(0.3, abs=0.002)


def test_heave_that_grows_beneath_a_twist_at_rest_is_growth():
    """Galloping: the deflection grows at its own frequency, while the twist dies out or stays."""
    for pitch_rate, regime in ((-0.03, "settled"), (0.0, "limit-cycle")):
        twist = np.radians(0.5 - 0.4 * np.exp(pitch_rate * S) * np.cos(OMEGA * S))
        _, growing = release(pitch_rate, heave_rate=-0.008, amplitude=0.4)
        assert early(S, twist, growing).regime == "undecided"
        verdict = assess(S, twist, growing, final=True)
        assert verdict.regime == "growing"
        assert "heave grows" in verdict.reason
        _, decaying = release(pitch_rate, heave_rate=0.008, amplitude=0.4)
        assert early(S, twist, decaying).regime == regime


def test_limit_cycle_waits_for_the_mean():
    twist, deflection = release(0.0)
    drifting = deflection + 1e-3 * S
    assert early(S, twist, drifting).regime == "undecided"
    final = assess(S, twist, drifting, final=True)
    assert final.regime == "limit-cycle"
    assert "mean still drifted" in final.reason
    assert not final.mean_known
    verdict = early(S, twist, deflection)
    assert verdict.mean_known
    assert verdict.regime == "limit-cycle"
    assert verdict.mean_deflection == pytest.approx(0.3, abs=0.002)


def test_growth_is_called_only_beyond_the_bound():
    twist, deflection = release(0.02)
    bound = S[np.argmax(np.abs(twist) > np.radians(6.5))]
    verdict = early(S, twist, deflection, step=2.0)
    assert verdict.regime == "growing"
    assert bound - PERIOD < verdict.end_time < bound + 3 * PERIOD
    assert verdict.growth_rate == pytest.approx(0.02, rel=0.01)
    upto = bound - 2 * PERIOD > S
    assert assess(S[upto], twist[upto], deflection[upto]).regime == "undecided"
    final = assess(S[upto], twist[upto], deflection[upto], final=True)
    assert final.regime == "growing"
    assert "at the end of the run" in final.reason


@pytest.mark.parametrize(
    ("rate", "regime"),
    [(-2e-3, "decaying"), (-5e-4, "decaying"), (0.0, "limit-cycle"), (5e-4, "growing")],
)
def test_slow_trends_are_left_to_the_end(rate, regime):
    twist, deflection = np.radians(np.exp(rate * S) * np.cos(OMEGA * S)), REST
    if rate != 0.0:
        assert early(S, twist, deflection).regime == "undecided"
    assert assess(S, twist, deflection, final=True).regime == regime


@pytest.mark.parametrize("final", [False, True])
def test_body_that_has_not_moved_is_undecided_and_one_at_rest_settled(final):
    """Rounding is no motion; a pitch that has died out is, though nothing of it is left."""
    rounding = 1e-16 * np.cos(OMEGA * S)
    for twist, deflection in ((REST + 0.01, REST + 0.2), (0.01 + rounding, 0.2 + rounding)):
        verdict = assess(S, twist, deflection, final=final, natural_frequency=0.16)
        assert verdict.regime == "undecided"
        assert "nothing has moved" in verdict.reason
        assert math.isnan(verdict.growth_rate)
    died = np.exp(-0.5 * S)
    verdict = assess(S, 0.01 - 0.01 * died, 0.2 + REST, final=final, natural_frequency=0.16)
    assert verdict.regime == "settled"
    assert verdict.mean_twist == pytest.approx(0.01)
    assert verdict.mean_deflection == pytest.approx(0.2)
    assert verdict.frequency == 0.16
    assert verdict.twist_amplitude == pytest.approx(0.0, abs=1e-6)


def test_growth_from_rounding_is_not_settled():
    twist = 1e-8 * np.exp(0.03 * S) * np.sin(OMEGA * S)
    assert early(S, twist, REST).regime == "undecided"
    assert assess(S, twist, REST, final=True).regime == "growing"


def test_divergence_without_oscillation():
    assert early(S, 1e-3 * np.exp(S / 40.0), REST).regime == "growing"
    assert early(S, 0.3 * (1.0 - np.exp(-S / 40.0)), REST).regime != "growing"


@pytest.mark.parametrize("mean", [0.5, 5.0, 9.0, 20.0])
def test_first_swing_of_a_stable_release_is_no_divergence(mean):
    """It goes from rest to twice the equilibrium, which may be beyond the bound."""
    twist = np.radians(mean) * (1.0 - np.exp(-0.05 * S) * np.cos(OMEGA * S))
    verdict = early(S, twist, REST, step=0.5)
    assert verdict.regime == "settled"
    assert verdict.end_time > 30.0


@pytest.mark.parametrize("rate", [0.05, 0.3, 2.0])
def test_departure_from_rest_below_divergence_is_growing(rate):
    """Without damping theta'' = rate^2 (theta + 1 deg)."""
    twist = np.radians(np.cosh(np.minimum(rate * S, 6.0)) - 1.0)
    upto = rate * S <= 5.0
    verdict = early(S[upto], twist[upto], REST[upto], step=0.5)
    assert verdict.regime == "growing"
    assert math.degrees(twist[np.searchsorted(S, verdict.end_time)]) < 30.0


def test_slow_divergence_is_seen_at_the_end():
    twist = np.radians(0.05 * np.exp(0.0135 * S))
    assert assess(S, twist, REST, final=True).regime == "growing"
    creeping = np.radians(20.0 * (1.0 - np.exp(-0.005 * S)))
    assert assess(S, creeping, REST, final=True).regime == "decaying"
    # what may be the first quarter of a swing is no creep
    assert assess(S, creeping, REST, final=True, natural_frequency=1e-3).regime == "undecided"


def test_swings_that_grow_until_the_polar_ends_are_growing():
    """Turns at 2.6 and -13.4 deg, then gone: k* = 1.2 of the flat plate in one of its runs."""
    twist = np.radians(np.interp(S, [0.0, 4.0, 10.0, 16.0], [0.0, 2.6, -13.4, 43.9]))
    upto = S <= 16.0
    verdict = assess(S[upto], twist[upto], REST[upto], final=True)
    assert verdict.regime == "growing"
    assert early(S[upto], twist[upto], REST[upto], step=1.0).regime == "growing"


def test_growth_out_of_the_ringing_of_the_release_is_seen_at_the_end():
    """The release rings at a hundred times the amplitude from which another motion grows."""
    s = np.linspace(0.0, 400.0, 8001)
    envelope = 2.0 * np.exp(-0.03 * s) + 0.02 * np.exp(0.005 * s)
    twist = np.radians(1.3 - envelope * np.cos(2.0 * np.pi * 0.054 * s))
    verdict = assess(s, twist, np.zeros_like(s), Criteria(periods=10), final=True)
    assert verdict.regime == "growing"
    assert verdict.growth_rate == pytest.approx(0.005, rel=0.1)


def test_growth_that_its_modulation_hides_is_none_of_a_limit_cycle():
    """Four periods after the transient, the last far beyond all before: k* = 5 of a short run.

    Three amplitudes in a row are free of the transient, too few to judge by alone.
    """
    s = np.linspace(0.0, 45.0, 901)
    at = [0.0, 13.0, 17.0, 21.0, 25.0, 30.0, 34.0, 38.0, 45.0]
    envelope = np.interp(s, at, [1.5, 1.29, 1.22, 1.2, 1.23, 1.36, 1.57, 1.8, 2.0])
    twist = np.radians(envelope * np.cos(0.75 * s))
    assert assess(s, twist, 0.0 * s, final=True).regime == "undecided"
    growth = growth_of(s, [twist, -0.3 * twist], [0.12, 0.05])
    assert growth.decides
    assert assess(s, twist, 0.0 * s, final=True, growth=growth).regime == "growing"


@pytest.mark.parametrize(
    ("turns", "grow"),
    [
        ([0.0, 15.4, -13.0, 32.2, -55.8], True),
        ([0.0, 15.4, -40.0], False),  # no more than a first swing and one back
        ([0.0, 15.4, 5.0, 11.0, 7.0], False),
    ],
)
def test_swings_that_grow_are_told_from_a_release(turns, grow):
    s = np.linspace(0.0, 20.0, 401)
    twist = np.radians(np.interp(s, np.linspace(0.0, 20.0, len(turns)), turns))
    assert swings_grow(s, twist, math.radians(6.0)) is grow


def test_beating_is_not_steady_until_it_has_died():
    beat = np.cos(2.0 * np.pi * S / 60.0)
    dying = np.radians(2.0 * (1.0 + 0.3 * np.exp(-0.02 * S) * beat) * np.sin(OMEGA * S))
    verdict = early(S, dying, REST, step=5.0)
    assert verdict.regime == "limit-cycle"
    assert verdict.end_time > 100.0
    assert math.degrees(verdict.twist_amplitude) == pytest.approx(2.0, rel=0.05)
    lasting = np.radians(2.0 * (1.0 + 0.3 * beat) * np.sin(OMEGA * S))
    assert early(S, lasting, REST, step=5.0).regime == "undecided"
    for end in np.arange(150.0, 300.0, 7.0):
        upto = end > S
        verdict = assess(S[upto], lasting[upto], REST[upto], final=True)
        assert verdict.regime == "limit-cycle", end


@pytest.mark.parametrize("noise", [0.005, 0.02])
@pytest.mark.parametrize(
    ("rate", "regime", "at_last"),
    [
        (-0.02, "decaying", "settled"),
        (0.0, "limit-cycle", "limit-cycle"),
        (0.02, "growing", "growing"),
    ],
)
def test_noise_changes_no_verdict(noise, rate, regime, at_last):
    random = np.random.default_rng(6)
    twist = np.exp(rate * S) * np.cos(OMEGA * S) + noise * random.standard_normal(S.size)
    deflection = 0.2 + 1e-3 * random.standard_normal(S.size)
    assert early(S, np.radians(twist), deflection).regime == regime
    assert assess(S, np.radians(twist), deflection, final=True).regime == at_last


@pytest.mark.parametrize("final", [False, True])
@pytest.mark.parametrize("end", [1.0, 5.0, 12.0, 20.0, 33.0])
def test_short_record_is_undecided_whatever_it_shows(end, final):
    """33 c/V have three periods after the transient."""
    upto = end > S
    for rate in (-0.01, 0.0, 0.01):
        twist, deflection = release(rate)
        verdict = assess(S[upto], twist[upto], deflection[upto], final=final)
        assert verdict.regime == "undecided", verdict.reason
        assert not final or "raise the duration" in verdict.reason


def test_growth_of_twist_and_deflection_decides_where_the_amplitude_beats():
    """A heave near the pitch makes the twist's amplitude rise and fall, the motion decays slowly.

    Without the fit nobody knows; of white noise as large as the motion the fit knows nothing.
    """
    upto = S < 60.0
    s, slow = S[upto], 2.0 * np.pi / 7.5
    pitch = np.exp(-0.004 * s) * np.cos(OMEGA * s)
    heave = np.exp(-0.01 * s) * np.cos(slow * s + 1.0)
    twist, deflection = np.radians(0.5 - pitch - 0.3 * heave), 0.1 * (3.0 - heave + 0.05 * pitch)
    growth = growth_of(s, [twist, deflection], [1.0 / PERIOD, 1.0 / 7.5])
    verdict = assess(s, twist, deflection, final=True, growth=growth)
    assert verdict.regime == "decaying"
    assert verdict.growth_rate == pytest.approx(-0.004, abs=1e-4)
    assert "growth -0.0040 +- 0.0000 V/c" in verdict.reason
    random = np.random.default_rng(1)
    noisy = twist + np.radians(0.5) * random.standard_normal(s.size)
    growth = growth_of(s, [noisy, deflection], [1.0 / PERIOD, 1.0 / 7.5])
    assert growth.sign == 0 or not growth.decides


@pytest.mark.parametrize("name", ["time", "twist", "deflection"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_not_finite_is_named_with_its_place(name, value):
    histories = {"time": S.copy(), "twist": REST.copy(), "deflection": REST.copy()}
    histories[name][70] = value
    with pytest.raises(ResultFileError, match=rf"{name} is (nan|inf) at sample 70"):
        assess(**histories)


def test_malformed_histories():
    repeated = S.copy()
    repeated[100] = repeated[99]
    with pytest.raises(ResultFileError, match="does not increase at sample 100"):
        assess(repeated, REST, REST)
    with pytest.raises(ValueError, match="equal length"):
        assess(S, REST[:-1], REST)
    with pytest.raises(ResultFileError, match="3 samples"):
        assess(S[:3], REST[:3], REST[:3], final=True)
    assert assess(S[:3], REST[:3], REST[:3]).regime == "undecided"
    assert assess([], [], []).regime == "undecided"


@pytest.mark.parametrize(
    "wrong", [{"periods": 1}, {"steadiness": 0.0}, {"decay_factor": 1.0},
              {"growing_amplitude_deg": 0.01}]
)  # fmt: skip
def test_impossible_criteria(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Criteria(**wrong)


rates = st.one_of(st.floats(-0.05, -0.008), st.floats(0.008, 0.05))


@given(rate=rates, period=st.floats(4.0, 9.0), slow=st.floats(20.0, 60.0))
@settings(max_examples=25, deadline=None)
def test_early_verdict_is_the_final_one(rate, period, slow):
    heave = np.exp(-0.05 * S) * np.cos(2.0 * np.pi * S / slow)
    pitch = np.exp(rate * S) * np.cos(2.0 * np.pi * S / period)
    twist, deflection = np.radians(0.4 - pitch - 0.1 * heave), 0.3 * (1.0 - heave)
    final = assess(S, twist, deflection, final=True)
    verdict = early(S, twist, deflection)
    assert (verdict.regime == "growing") == (final.regime == "growing") == (rate > 0.0)
    if rate < 0.0:
        assert {verdict.regime, final.regime} <= {"settled", "decaying"}
        assert verdict.mean_deflection == pytest.approx(0.3, abs=0.004)
        assert math.degrees(verdict.mean_twist) == pytest.approx(0.4, abs=0.03)


@given(rate=st.floats(-0.03, 0.03), shift=st.floats(-1e3, 1e3))
@settings(max_examples=20, deadline=None)
def test_invariant_under_time_shift_and_sign(rate, shift):
    twist, deflection = release(rate)
    upto = S < 100.0
    s, twist, deflection = S[upto], twist[upto], deflection[upto]
    reference = assess(s, twist, deflection, final=True)
    shifted = assess(s + shift, twist, deflection, final=True)
    flipped = assess(s, -twist, -deflection, final=True)
    assert reference.regime == shifted.regime == flipped.regime
    assert shifted.start_time - shift == pytest.approx(reference.start_time, abs=1e-6)
    for other, sign in ((shifted, 1.0), (flipped, -1.0)):
        assert other.twist_amplitude == pytest.approx(reference.twist_amplitude, rel=1e-6)
        assert other.frequency == pytest.approx(reference.frequency, rel=1e-6)
        assert other.growth_rate == pytest.approx(reference.growth_rate, rel=1e-4, abs=1e-8)
        assert sign * other.mean_twist == pytest.approx(reference.mean_twist, rel=1e-6)


@pytest.mark.parametrize("rate", [-0.02, 0.0, 0.008])
def test_invariant_under_scale_and_subsampling(rate):
    twist, deflection = release(rate)
    reference = assess(S, twist, deflection, final=True)
    scaled = assess(
        S,
        3.0 * twist,
        3.0 * deflection,
        Criteria(
            settled_amplitude_deg=0.15,
            growing_amplitude_deg=18.0,
            mean_tolerance_deg=0.06,
            mean_tolerance_chords=0.006,
        ),
        final=True,
    )
    coarse = assess(S[::3], twist[::3], deflection[::3], final=True)
    assert reference.regime == scaled.regime == coarse.regime
    for other, factor, relative in ((scaled, 3.0, 1e-6), (coarse, 1.0, 5e-3)):
        assert other.twist_amplitude / factor == pytest.approx(
            reference.twist_amplitude, rel=relative
        )
        assert other.mean_twist / factor == pytest.approx(reference.mean_twist, rel=relative)
        assert other.frequency == pytest.approx(reference.frequency, rel=relative)


def test_uneven_sampling():
    random = np.random.default_rng(7)
    s = np.cumsum(0.1 * (1.0 + 0.2 * np.sin(np.arange(3000) / 300.0)))
    s += 0.002 * random.uniform(-1.0, 1.0, s.size)
    verdict = assess(s, 0.02 * np.sin(OMEGA * s), np.zeros_like(s))
    assert verdict.regime == "limit-cycle"
    assert verdict.twist_amplitude == pytest.approx(0.02, rel=2e-3)
    assert verdict.frequency == pytest.approx(1.0 / PERIOD, rel=2e-3)
