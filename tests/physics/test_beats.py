"""A beat with vortices near the twist's frequency is no decay, and a decay is no beat."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.benchmarks.early_verdict import case_of
from tests.workflow.project import ROOT

from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import LOOKS_EVERY, Judge, TipMotion, growths_of_tips
from equisection.store.judged_again import tip_motion
from equisection.verdict import Criteria, assess
from equisection.verdict.growth import AFTER_RELEASE, growths_of

TWIST, HEAVE = 0.6, 0.25  # f c/V
STABLE = {"settled", "decaying"}


def judge_of(shift: float = 0.03) -> Judge:
    """Return the judge of a section whose loads raise its frequency by a part of it."""
    return Judge(Criteria(periods=4), TWIST * (1.0 - shift), (HEAVE,))


def line(s, frequency, phase, rate=0.0):
    return np.exp((rate + 2j * math.pi * frequency) * s + 1j * phase)


def tip(s, motion, noise=0.0, seed=0):
    """Return twist (1 deg at the release), and a heave that follows it while its own dies out."""
    random = np.random.default_rng(seed)
    twist = np.radians(motion.real + noise * random.standard_normal(s.size))
    own = np.exp(-0.05 * s) * np.cos(2.0 * math.pi * HEAVE * s)
    heave = 0.002 * own + 3e-4 * (np.exp(1j) * motion).real
    return TipMotion(s, twist, heave + 3e-4 * noise * random.standard_normal(s.size))


def ended(judge: Judge, motion: TipMotion) -> dict[str, object]:
    """Return the verdict of a run that is looked at as it goes on, and its end."""
    for look in np.arange(LOOKS_EVERY, motion.time[-1] + 1e-9, LOOKS_EVERY):
        part = motion.until(float(look))
        if judge.is_decided(part):
            return {**judge.attributes(part), "end": float(look)}
    return {**judge.attributes(motion), "end": math.inf}


def drifting(s, motion):
    """Return the growth of a complex motion from 10 to 30 c/V, with its drift."""
    records = np.array([motion.real, motion.imag])[:, None]
    return growths_of(s, records, [[TWIST]], [(10.0, 30.0)], drifts=True)


def beating(random, beats, length, ratio, *, rate=0.0, noise=0.0):
    """Return a twist of growth ``rate`` with vortices of ``ratio``, over so many beats."""
    s = np.arange(0.0, length + 0.02, 0.04)
    near = TWIST + random.choice([-1, 1]) * beats / (length - AFTER_RELEASE)
    twist, vortices = (
        line(s, one, random.uniform(0.0, 2.0 * math.pi), growth)
        for one, growth in ((TWIST, rate), (near, 0.0))
    )
    return tip(s, twist + ratio * vortices, noise, int(random.integers(1000)))


@pytest.mark.parametrize("beats", [0.25, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("length", [30.0, 100.0])
def test_two_lasting_motions_are_no_decay_at_any_part_of_their_beat(beats, length):
    """Neither as the run goes on nor at its end."""
    random = np.random.default_rng(int(10 * beats + length))
    for ratio in (0.3, 0.6, 0.95):
        for _ in range(2):
            found = ended(judge_of(), beating(random, beats, length, ratio))
            assert found["regime"] not in STABLE, (ratio, found["reason"])


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_false_verdicts_over_random_phases(noise):
    """Amplitudes, phases and beats at random: one record of 20 at most."""
    random = np.random.default_rng(5)
    stable = sum(
        ended(
            judge_of(random.uniform(0.0, 0.03)),
            beating(random, random.uniform(0.25, 2.0), 40.0, random.uniform(0.1, 1.0), noise=noise),
        )["regime"]
        in STABLE
        for _ in range(20)
    )
    assert stable <= 1


@pytest.mark.parametrize("rate", [0.002, 0.005])
def test_slow_growth_in_the_falling_half_of_a_beat_is_not_stable(rate):
    random = np.random.default_rng(2)
    for _ in range(8):
        found = ended(judge_of(), beating(random, 0.6, 30.0, 0.5, rate=rate))
        assert found["regime"] not in STABLE, found["reason"]


def test_whole_beats_make_a_limit_cycle():
    random = np.random.default_rng(3)
    for _ in range(4):
        found = ended(judge_of(), beating(random, 4.0, 100.0, 0.4))
        assert found["regime"] == "limit-cycle", found["reason"]
        assert found["end"] == math.inf
        assert "after a whole beat" in str(found["reason"])


def test_rise_in_a_beat_is_no_growth_of_a_motion_that_was_as_large_before():
    """The H section at 1 m/s, whose vortices keep its twist at some 0.3 deg."""
    known = read_dataset(ROOT / "results/reference/openfoam-h-section/unsteady/2d/v1.nc")
    judge, motion = Judge.of(case_of(known)), tip_motion(known)
    (growth,) = growths_of_tips([judge], [motion])
    assert growth.sign == 1
    found = judge.attributes(motion)
    assert found["regime"] == "undecided"
    assert "was as large in each of 3 windows before" in str(found["reason"])


@pytest.mark.parametrize("rate", [0.005, 0.01, 0.02])
def test_growth_in_beats_is_no_limit_cycle(rate):
    random = np.random.default_rng(4)
    for _ in range(4):
        found = judge_of().attributes(beating(random, 6.0, 100.0, 0.3, rate=rate))
        assert found["regime"] in {"growing", "undecided"}, found["reason"]
        if rate == 0.02:
            assert found["regime"] == "growing"


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.02])
@pytest.mark.parametrize("rate", [-0.02, -0.05])
def test_decay_is_decided_as_early_as_by_its_amplitude_alone(rate, noise):
    s, judge = np.arange(0.0, 50.0, 0.04), judge_of()
    for seed in range(3):
        motion = tip(s, line(s, TWIST, seed, rate), noise, seed)
        for look in np.arange(LOOKS_EVERY, 50.0, LOOKS_EVERY):
            part = motion.until(float(look))
            alone = assess(part.time, part.twist, part.deflection, judge.criteria)
            assert judge.is_decided(part) == alone.decided, look
        (growth,) = growths_of_tips([judge], [motion])
        assert growth.sign == -1
        assert growth.rate == pytest.approx(rate, rel=0.2 if noise else 0.01)


@pytest.mark.parametrize("far", [1.02, 1.4, 1.8])
def test_vortices_far_from_the_twist_leave_a_decay_as_it_is(far):
    s = np.arange(0.0, 50.0, 0.04)
    for phase in range(4):
        motion = tip(s, line(s, TWIST, 0.0, -0.02) + 0.05 * line(s, far, phase))
        (growth,) = growths_of_tips([judge_of()], [motion])
        assert growth.stays
        assert growth.sign == -1
        assert growth.drift_of_all.change < 0.3 * abs(growth.rate)


def test_drift_of_a_beat_is_that_of_theory():
    """|lambda'| = omega r |lambda|/|z|, in the middle of the falling half; none of a decay."""
    s, ratio, beat = np.arange(0.0, 30.0, 0.02), 0.3, 2.0 * math.pi / 120.0
    z = line(s, TWIST, 0.0) * (1.0 + ratio * np.exp(1j * (beat * (s - 20.0) + 0.5 * math.pi)))
    (found,) = drifting(s, z)
    middle = 1.0 + 1j * ratio
    rate = 1j * beat * 1j * ratio / middle
    assert found.rate == pytest.approx(rate.real, rel=0.05)
    assert found.drift.change == pytest.approx(20.0 * beat * abs(rate / middle), rel=0.1)
    assert found.beats
    assert found.interval[1] > 0.0
    assert "no sign by a beat" in found.note
    decay = line(s, TWIST, 0.0, rate.real)
    (found,) = drifting(s, decay)
    assert found.drift.change < 0.1 * abs(found.rate)
    assert found.sign == -1


def test_h_section_whose_vortices_beat_with_its_twist_is_undecided():
    """Four periods fall by 30 %, and rise again later."""
    known = read_dataset(ROOT / "results/reference/openfoam-h-section/unsteady/2d/v1.nc")
    motion, judge = tip_motion(known, 30.0), Judge.of(case_of(known))
    assert not judge.is_decided(motion)
    found = judge.attributes(motion)
    assert found["regime"] == "undecided"
    assert "vortices beat with the motion" in found["reason"]
    assert found["growth_low"] < found["growth_rate"] < 0.0 < found["growth_high"]


def test_motion_in_a_flow_without_vortices_does_not_beat():
    """Next to an onset a rate is little, and drifts as it goes with the amplitude."""
    motion = beating(np.random.default_rng(1), 0.5, 100.0, 0.6)
    judge = judge_of()
    alone = replace(judge, has_vortices=False)
    assert growths_of_tips([judge], [motion])[0].may_beat
    (growth,) = growths_of_tips([alone], [motion])
    assert not growth.may_beat
    assert growth.stays
