"""The lags of the bubble: found again, recovered from synthetic data, judged on unseen releases.

``pytest -s tests/physics/test_identification.py`` prints what docs/embedded.md says of them.
"""

from __future__ import annotations

import math
from dataclasses import fields, replace
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from scipy.optimize import brentq
from tests.sample_cases import sections

from equisection.aerodynamics.identification import LoadMisfit, identify_lags, load_misfit
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory, unexplained_damping
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.config.groups import Embedded
from equisection.errors import ResultFileError
from equisection.motion.release_judgement import (
    ReleaseJudgement,
    ReleaseNumbers,
    judge_release,
    release_numbers,
)
from equisection.motion.sections import (
    release_sections,
    section_system,
)
from equisection.motion.steady_states import least_stable_eigenvalue
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.recorded_history import read_reference_history

ROOT = Path(__file__).parents[2]
CONFIGURED = Embedded()
FITTED_TO = CONFIGURED.identification.fitted_to
JUDGED_ON = CONFIGURED.identification.judged_on
POLAR = Polar.read(ROOT / CONFIGURED.polars["coarse"])
LOADS = UnsteadyLoads.from_polar(POLAR)
INDEPENDENCE = "results/reference/independence-{}/unsteady/2d/k{}.nc"


@cache
def release(path: str) -> ReferenceHistory:
    return read_reference_history(ROOT / path)


@pytest.fixture
def some_release() -> ReferenceHistory:
    return release(FITTED_TO[-1])


def fitted() -> list[ReferenceHistory]:
    return [release(path) for path in FITTED_TO]


def test_identification_finds_the_default_lags_again():
    found = identify_lags(POLAR, fitted())
    print(found)
    assert found.lags.relaxation == pytest.approx(IDENTIFIED_LAGS.relaxation, abs=0.02)
    assert found.lags.delay == pytest.approx(IDENTIFIED_LAGS.delay, abs=0.02)
    assert found.lags.lift_lag == pytest.approx(IDENTIFIED_LAGS.lift_lag, abs=0.02)


def test_lags_are_judged_on_releases_that_they_were_not_fitted_to():
    assert len(FITTED_TO) == 2
    assert len(JUDGED_ON) == 18
    assert not set(FITTED_TO) & set(JUDGED_ON)


@pytest.mark.parametrize("path", JUDGED_ON)
def test_loads_of_the_releases_that_were_not_seen(path):
    """What is left unexplained, of the standard deviation; most at the largest amplitudes."""
    misfit = load_misfit(release(path), LOADS)
    print(path, misfit)
    assert misfit.moment_residual < 0.22
    assert misfit.lift_residual < 0.42


@pytest.mark.parametrize("path", JUDGED_ON)
def test_motion_of_the_releases_that_were_not_seen(path):
    """Growth, frequency and means; the amplitude is honestly low (docs/embedded.md)."""
    judged = judge_release(release(path), LOADS)
    print(path, judged)
    recorded, modelled = judged.recorded, judged.modelled
    assert modelled.growth_rate == pytest.approx(recorded.growth_rate, abs=0.008)
    assert modelled.frequency == pytest.approx(recorded.frequency, rel=0.015)
    assert modelled.mean_twist_deg == pytest.approx(recorded.mean_twist_deg, rel=0.16)
    assert modelled.mean_deflection_chords == pytest.approx(
        recorded.mean_deflection_chords, rel=0.03
    )
    if abs(recorded.growth_rate) > 0.005:  # nearer to zero the side is not told
        assert judged.same_side_of_onset


@pytest.mark.parametrize(
    ("recorded", "modelled", "same"),
    [
        (0.02, 0.01, True),
        (-0.02, -0.01, True),
        (0.02, -0.01, False),
        (-0.02, math.nan, False),
        (math.nan, -0.01, False),
        (math.nan, math.nan, False),
    ],
)
def test_a_release_without_a_growth_rate_is_on_no_side(recorded, modelled, same):
    one, other = (ReleaseNumbers(rate, *[0.0] * 4) for rate in (recorded, modelled))
    misfit = LoadMisfit(*[0.0] * len(fields(LoadMisfit)))
    assert ReleaseJudgement("made up", 5.0, one, other, misfit).same_side_of_onset is same


def test_the_lag_of_the_lift_pays_where_it_was_not_identified():
    """Why there is a tau_3: less misfit of c_l up to k* = 10; beyond it is worth little."""
    without = UnsteadyLoads.from_polar(POLAR, replace(IDENTIFIED_LAGS, lift_lag=0.0))
    for path in JUDGED_ON:
        history = release(path)
        old, new = load_misfit(history, without), load_misfit(history, LOADS)
        print(path, "c_l residual", old.lift_residual, "->", new.lift_residual)
        assert new.lift_residual < (0.8 if history.k_star <= 10.0 else 1.12) * old.lift_residual
        assert new.moment_residual == pytest.approx(old.moment_residual)


@pytest.mark.parametrize("start", [3.0, 5.0, 10.0, 20.0])
def test_lags_and_onset_depend_little_on_where_the_record_starts(start, some_release):
    lags = identify_lags(POLAR, fitted(), start).lags
    onset = onset_like(some_release, lags)
    print(start, lags, "onset", onset)
    assert lags.relaxation == pytest.approx(IDENTIFIED_LAGS.relaxation, rel=0.1)
    assert lags.delay == pytest.approx(IDENTIFIED_LAGS.delay, rel=0.1)
    assert lags.lift_lag == pytest.approx(IDENTIFIED_LAGS.lift_lag, rel=0.1)
    assert onset == pytest.approx(onset_like(some_release, IDENTIFIED_LAGS), rel=0.1)


@pytest.mark.parametrize(
    ("k_star", "onset"),
    [(("5",), 8.11), (("10",), 9.53), (("6.44", "14"), 8.95), (("5.5", "8.5"), 8.65)],
)
def test_onset_from_other_releases(k_star, onset, some_release):
    """How far the onset hangs on the choice of releases: docs/embedded.md."""
    runs = [release(FITTED_TO[0].replace("k5", f"k{each}")) for each in k_star]
    lags = identify_lags(POLAR, runs).lags
    found = onset_like(some_release, lags)
    print(k_star, lags, "onset", found)
    assert found == pytest.approx(onset, rel=0.02)


def onset_like(history: ReferenceHistory, lags: SeparationLags) -> float:
    """Return the k* of no growth of the section of a release, stiffened as a whole."""
    loads = UnsteadyLoads.from_polar(POLAR, lags)

    def growth(k_star: float) -> float:
        scale = k_star / history.k_star
        system = section_system([history.section.scaled(scale)], loads, history.incidence_rad)
        return float(least_stable_eigenvalue(system)[0].real)

    return float(brentq(growth, 4.0, 20.0, xtol=1e-3))


@pytest.mark.parametrize("variant", ["step0.01-outer8", "step0.04-outer8", "step0.02-outer16"])
def test_lags_depend_little_on_time_step_and_correctors_of_the_flow_solver(variant):
    """Against those of the same first 45 c/V of the releases that they are fitted to."""
    others = [release(INDEPENDENCE.format(variant, k_star)) for k_star in ("5", "10")]
    end = others[0].time[-1]
    beginnings = [first_part(history, end) for history in fitted()]
    here, there = (identify_lags(POLAR, runs).lags for runs in (beginnings, others))
    print(variant, here, there)
    assert there.relaxation == pytest.approx(here.relaxation, rel=0.03)
    assert there.delay == pytest.approx(here.delay, rel=0.03)
    assert there.lift_lag == pytest.approx(here.lift_lag, rel=0.03)


def first_part(history: ReferenceHistory, end: float) -> ReferenceHistory:
    """Return a release until a time (c/V)."""
    part = slice(0, int(np.searchsorted(history.time, end, "right")))
    return replace(
        history,
        time=history.time[part],
        twist=history.twist[part],
        deflection=history.deflection[part],
        lift_coefficient=history.lift_coefficient[part],
        moment_coefficient=history.moment_coefficient[part],
    )


def of_the_model(loads: UnsteadyLoads, k_star: float, like: ReferenceHistory) -> ReferenceHistory:
    """Return a release of the model as if it had been recorded."""
    (section,) = sections(k_star, 6.67, 12.0, 0.23)
    run = release_sections(
        [section], loads, math.radians(2.5), 80.0, time_step=0.025, output_interval=0.05
    )
    return replace(
        like,
        time=run.time,
        twist=run.twist[:, 0],
        deflection=run.deflection[:, 0],
        lift_coefficient=run.lift_coefficient[:, 0],
        moment_coefficient=run.moment_coefficient[:, 0],
        section=section,
    )


def test_known_lags_are_recovered_from_a_release_of_the_model(some_release):
    truth = SeparationLags(relaxation=1.7, delay=0.6, lift_lag=0.4)
    run = of_the_model(UnsteadyLoads.from_polar(POLAR, truth), 8.0, some_release)
    history = replace(  # offsets must not matter
        run,
        lift_coefficient=run.lift_coefficient - 0.01,
        moment_coefficient=run.moment_coefficient + 0.01,
    )
    found = identify_lags(POLAR, [history])
    assert found.lags.relaxation == pytest.approx(truth.relaxation, rel=0.01)
    assert found.lags.delay == pytest.approx(truth.delay, rel=0.01)
    assert found.lags.lift_lag == pytest.approx(truth.lift_lag, rel=0.01)
    assert found.misfits[0].moment_offset == pytest.approx(0.01, abs=1e-4)
    assert found.misfits[0].lift_offset == pytest.approx(-0.01, abs=1e-3)


@pytest.mark.parametrize("path", [*FITTED_TO, *JUDGED_ON])
def test_recorded_motion_is_what_the_recorded_moment_does(path):
    """No damping from the coupling of flow and section: below 0.0008 V/c of growth."""
    history = release(path)
    growth = unexplained_damping(history, 20.0) / (2 * history.section.inertia)
    print(path, "growth from unexplained damping", growth)
    assert abs(growth) < 8e-4


def test_lags_that_a_history_does_not_tell_are_named(some_release):
    """A section that stays attached has no bubble whose lag could be found."""
    attached = Polar.flat_plate(5.0)
    loads = UnsteadyLoads.from_polar(attached, SeparationLags.none())
    history = of_the_model(loads, 21.0, some_release)
    assert identify_lags(attached, [history]).untold == ("relaxation", "delay", "lift_lag")
    own = of_the_model(LOADS, 8.0, some_release)
    assert not identify_lags(POLAR, [own]).untold


@pytest.mark.parametrize("damping", [0.3, -0.2])
def test_damping_that_the_moment_does_not_have_is_found(damping):
    """I* theta'' + k* theta - c_m = d theta' solved in closed form, with a constant c_m."""
    inertia, stiffness, moment = 6.7, 10.0, 0.05
    growth = damping / (2 * inertia)
    omega = math.sqrt(stiffness / inertia - growth**2)
    time = np.arange(0.0, 60.0, 0.02)
    twist = moment / stiffness + 0.01 * np.exp(growth * time) * np.cos(omega * time)
    still = np.zeros(time.size)
    history = ReferenceHistory(
        time=time,
        twist=twist,
        deflection=still,
        lift_coefficient=still,
        moment_coefficient=np.full(time.size, moment),
        incidence_rad=0.0,
        k_star=stiffness,
        section=Section(
            torsional_stiffness=stiffness, flexural_stiffness=1.0, inertia=inertia, mass=80.0
        ),
        name="made up",
        source="made up",
    )
    assert unexplained_damping(history, 20.0) == pytest.approx(damping, rel=5e-3)


def test_numbers_of_a_release_in_closed_form():
    """theta = 0.7 + 0.5 exp(0.01 s) cos(1.1 s) deg, w/c = 0.3."""
    time = np.arange(0.0, 100.0, 0.05)
    twist = np.radians(0.7 + 0.5 * np.exp(0.01 * time) * np.cos(1.1 * time))
    numbers = release_numbers(time, twist, np.full(time.size, 0.3))
    assert numbers.growth_rate == pytest.approx(0.01, rel=0.01)
    assert numbers.frequency == pytest.approx(1.1, rel=1e-3)
    assert numbers.mean_twist_deg == pytest.approx(0.7, abs=0.02)
    assert numbers.mean_deflection_chords == pytest.approx(0.3, rel=1e-12)
    end, period = float(time[-1]), 2 * math.pi / 1.1
    bounds = [0.5 * math.exp(0.01 * (end - back * period)) for back in (2.0, 0.0)]
    assert bounds[0] < numbers.last_amplitude_deg < bounds[1]


def test_unexplained_damping_of_the_embedded_solver_is_nil(some_release):
    own = of_the_model(LOADS, 8.0, some_release)
    assert abs(unexplained_damping(own, 20.0)) < 1e-3


def test_mean_loads_are_carried_by_the_springs(some_release):
    late = some_release.time > 40.0
    twist = some_release.section.torsional_stiffness * some_release.twist[late].mean()
    assert some_release.moment_coefficient[late].mean() == pytest.approx(twist, rel=0.02)
    deflection = some_release.section.flexural_stiffness * some_release.deflection[late].mean()
    assert some_release.lift_coefficient[late].mean() == pytest.approx(deflection, rel=0.02)


def test_script_writes_lags_judgement_and_picture(load_script, tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    identification = {"fitted_to": FITTED_TO, "judged_on": JUDGED_ON[-1:]}
    load_script("identification").main(
        Embedded(identification=identification),
        "coarse",
        style=ROOT / "envs" / "equisection.mplstyle",
        lags_file=tmp_path / "lags.yaml",
        judgement_file=tmp_path / "judgement.csv",
        figures=[tmp_path / "judgement.png"],
    )
    lags = yaml.safe_load((tmp_path / "lags.yaml").read_text())["embedded"]["separation"]
    configured = CONFIGURED.separation.model_dump()
    assert lags == pytest.approx(configured, abs=0.01)
    table = pd.read_csv(tmp_path / "judgement.csv")
    assert table["use"].tolist() == ["fitted to", "fitted to", "judged on"]
    assert table["release"].tolist() == ["2d/k5", "2d/k10", "2d-corrected/k21"]
    judged = judge_release(release(JUDGED_ON[-1]), LOADS)
    last = table.iloc[-1]
    assert last["growth_rate"] == pytest.approx(judged.recorded.growth_rate, rel=1e-3)
    assert last["growth_rate_modelled"] == pytest.approx(judged.modelled.growth_rate, rel=0.02)
    assert (tmp_path / "judgement.png").stat().st_size > 0


def test_what_is_no_release_of_a_section_is_refused_by_name(tmp_path):
    kept = ROOT / "results/reference/paper-plate-openfoam"
    with pytest.raises(ResultFileError, match=r"coarse_a5\.nc: .*no unsteady case of a section"):
        read_reference_history(kept / "steady/2d/coarse_a5.nc")
    without = read_dataset(kept / "unsteady/2d/k5.nc")
    del without.attrs["case"]
    write_dataset(tmp_path / "k5.nc", without)
    with pytest.raises(ResultFileError, match=r"k5\.nc: its attribute 'case'"):
        read_reference_history(tmp_path / "k5.nc")
    with pytest.raises(ResultFileError, match=r"none\.nc: missing"):
        read_reference_history(tmp_path / "none.nc")
