"""A model learnt from one release: of a known model, in its limits, and of kept releases by CFD."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.workflow.project import ROOT

from equisection.aerodynamics.filled_polar import filled, missing_angles
from equisection.aerodynamics.learnt_loads import LearntLoads, lagged, learn
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.analysis.reduced_model import (
    ENDS,
    ends_of_records,
    learnt_model,
    limit_cycles,
    next_release,
    onset_of,
    predicted,
    predicted_onset,
)
from equisection.beam.section import Section
from equisection.errors import ResultFileError
from equisection.motion.learnt_motion import LearntSections
from equisection.results.recorded_history import read_reference_history

REFERENCE = ROOT / "results" / "reference"
POLAR = Polar.read(ROOT / "config" / "polars" / "plate_2d_11136.csv").continued
SECTION = Section(torsional_stiffness=6.84, flexural_stiffness=1.557, inertia=6.667, mass=80.0)
KNOWN = LearntLoads(
    polar=POLAR,
    incidence_rad=math.radians(2.5),
    rate=0.35,
    moment=np.array([-0.3, 1.0, -0.6, 2.0, -5.0, 10.0, -20.0, 5.0]),
    lift=np.array([1.0, -2.0, -2.0, 5.0, 3.0, -10.0, 10.0, 20.0]),
    residual_moment=0.0,
    residual_lift=0.0,
    seen=(-1.0, 1.0),
    learnt_until=50.0,
)


def released(section: Section, loads: LearntLoads, duration: float = 50.0) -> ReferenceHistory:
    """Release a section with known loads, and write down motion and loads as CFD would."""
    step = 0.1
    moved = LearntSections([section], loads)
    fine = 10
    histories = moved.released(duration, step / fine)
    time = histories.time
    w, theta = histories.deflection[:, 0], histories.twist[:, 0]
    rates = [np.gradient(x, time, edge_order=2) for x in (w, theta)]
    accelerations = [np.gradient(x, time, edge_order=2) for x in rates]
    # the loads that this motion follows from, by the section's own equations
    forces = section.mass_matrix @ accelerations + section.damping_matrix @ rates
    forces += section.stiffness_matrix @ np.array([w, theta])
    lift, about_axis = forces
    keep = slice(None, None, fine)
    return ReferenceHistory(
        time[keep],
        theta[keep],
        w[keep],
        lift[keep],
        about_axis[keep],
        loads.incidence_rad,
        k_star=section.torsional_stiffness,
        section=section,
        name="known",
        source="a known model",
    )


def test_a_known_model_is_found_from_its_own_release():
    found = learn(released(SECTION, KNOWN), POLAR, 45.0)
    assert found.rate == pytest.approx(KNOWN.rate, rel=0.1)
    assert found.residual_moment < 0.01
    assert found.residual_lift < 0.02


def test_a_known_model_predicts_the_releases_of_others():
    model = learnt_model(released(SECTION, KNOWN), POLAR)
    k_star = np.array([5.0, 8.0, 11.0])
    sections = [SECTION.scaled(k / 6.44) for k in k_star]
    itself = replace(model, loads=KNOWN, refits=())
    found, true = predicted(model, k_star, sections), predicted(itself, k_star, sections)
    np.testing.assert_allclose(found["growth_rate"], true["growth_rate"], atol=0.001)
    np.testing.assert_allclose(found["frequency_strouhal"], true["frequency_strouhal"], rtol=0.005)


def test_axis_off_mid_chord_and_imbalance_are_the_same_in_another_place():
    """The loads are the section's, wherever its axis is: learnt about one, used about another."""
    off = SECTION.model_copy(update={"elastic_axis": 0.45, "static_imbalance": 2.0})
    moved = LearntSections([off], KNOWN)
    history = moved.released(50.0, 0.01)
    time, w, theta = history.time, history.deflection[:, 0], history.twist[:, 0]
    accelerations = [np.gradient(np.gradient(x, time), time) for x in (w, theta)]
    lift, about_axis = off.mass_matrix @ accelerations + off.stiffness_matrix @ [w, theta]
    heave_rate = np.gradient(w - 0.05 * theta, time)
    alpha = KNOWN.incidence_rad + theta - heave_rate
    # the force normal to the chord is lift and what the polar adds
    moment = about_axis + 0.05 * (lift + POLAR.normal_rise(alpha))
    keep = slice(None, None, 10)
    found = learn(
        ReferenceHistory(
            time[keep],
            theta[keep],
            w[keep],
            lift[keep],
            moment[keep],
            KNOWN.incidence_rad,
            k_star=6.84,
            section=off,
            name="off",
            source="a known model",
        ),
        POLAR,
        45.0,
    )
    assert found.residual_moment < 0.02
    assert found.residual_lift < 0.02


def test_small_releases_go_as_the_eigenvalues():
    """A small motion about the equilibrium grows as the eigenvalue says."""
    moved = LearntSections([SECTION.scaled(1.4)], KNOWN)
    eigenvalues = moved.eigenvalues()[0]
    theta, w = moved.equilibria()[:, 0]
    state = np.array([[w], [theta + 1e-6], [0.0], [0.0], [theta]])
    rest = np.array([[w], [theta], [0.0], [0.0], [theta]])
    # rows of the states are (w, theta, w', theta', x); the last is the lag
    np.testing.assert_allclose(moved.rates(rest), 0.0, atol=1e-6)
    slope = (moved.rates(state) - moved.rates(rest))[:, 0] / 1e-6
    np.testing.assert_allclose(slope, moved._matrix(0, theta)[:, 1], rtol=1e-2, atol=1e-3)
    pitch = eigenvalues[np.argmax(eigenvalues.imag)]
    assert pitch.imag == pytest.approx(
        math.sqrt(SECTION.scaled(1.4).torsional_stiffness / 6.7), 0.2
    )


def test_without_terms_a_section_in_still_loads_keeps_its_energy():
    """Polar without loads and no terms: springs and apparent mass alone, nothing grows."""
    nothing = Polar(POLAR.incidence, *np.zeros((3, POLAR.incidence.size)), "no loads")
    none = replace(KNOWN, polar=nothing, moment=np.zeros(8), lift=np.zeros(8))
    eigenvalues = LearntSections([SECTION], none).eigenvalues()[0]
    # theta' still lifts through the apparent mass, which couples but does not feed the pitch
    assert np.abs(eigenvalues.real[np.abs(eigenvalues.imag) > 0]).max() < 1e-10


def test_lag_is_exact_for_a_ramp():
    time = np.linspace(0.0, 10.0, 101)
    expected = time - (1.0 - np.exp(-0.4 * time)) / 0.4
    np.testing.assert_allclose(lagged(time, 0.1, 0.4), expected, atol=1e-12)
    np.testing.assert_allclose(lagged(np.full(20, 3.0), 0.1, 0.4), 3.0, atol=1e-13)


def test_onset_is_the_last_zero_of_the_growth():
    assert onset_of([1, 2, 3, 4], [1.0, -1.0, 1.0, -3.0]) == pytest.approx(3.25)
    assert math.isnan(onset_of([1, 2], [1.0, 0.5]))
    assert math.isnan(onset_of([1, 2], [-1.0, -0.5]))
    assert onset_of([1, 2], [math.inf, -1.0]) == 1.5
    assert math.isnan(onset_of([1, 2, 3], [1.0, math.nan, -1.0]))


@pytest.fixture(scope="module")
def sweep() -> dict[str, dict[float, ReferenceHistory]]:
    """Kept releases by OpenFOAM: section and corrected section, coarse mesh."""
    return {
        model: {
            k: read_reference_history(
                REFERENCE / "paper-plate-openfoam" / "unsteady" / model / f"k{k:g}.nc"
            )
            for k in (5.5, 6.44, 7.5, 8.5, 10.0, 14.0)
        }
        for model in ("2d", "2d-corrected")
    }


#: Onsets of the kept sweeps, interpolated between fitted growth rates (`make bench`, learnt).
ONSETS = {"2d": 8.40, "2d-corrected": 7.36}


@pytest.mark.parametrize("model", ["2d", "2d-corrected"])
def test_one_release_by_openfoam_predicts_the_sweep(sweep, model):
    """Onset within 3 % from 45 c/V at k* 6.44, with and without correction."""
    learnt = learnt_model(sweep["2d"][6.44], POLAR)
    k_star = sorted(sweep[model])
    found = predicted(learnt, k_star, [sweep[model][k].section for k in k_star])
    onset = predicted_onset(found)
    assert onset.k_star == pytest.approx(ONSETS[model], rel=0.03)
    assert onset.low < ONSETS[model] < onset.high


def test_release_far_from_the_onset_asks_for_another(sweep):
    learnt = learnt_model(sweep["2d"][10.0], POLAR)
    k_star = np.geomspace(5.0, 14.0, 12)
    sections = [sweep["2d"][10.0].section.scaled(k / 10.0) for k in k_star]
    wanted = next_release(learnt.k_star, predicted_onset(predicted(learnt, k_star, sections)))
    assert wanted is not None
    assert 6.44 < wanted < 8.0
    near = learnt_model(sweep["2d"][6.44], POLAR)
    assert next_release(near.k_star, predicted_onset(predicted(near, k_star, sections))) is None


def test_growing_release_by_openfoam_predicts_the_limit_cycle_of_another():
    """Amplitude at k* 6.44 within 5 % of the kept run of 370 c/V, from 130 c/V at 5.5."""
    kept = read_reference_history(
        REFERENCE / "paper-plate-openfoam-cycle" / "unsteady" / "2d" / "k6.44.nc"
    )
    path = REFERENCE / "paper-plate-openfoam" / "unsteady" / "2d" / "k5.5.nc"
    found = limit_cycles(learn(read_reference_history(path), POLAR), [kept.section]).iloc[0]
    late = kept.time > kept.time[-1] - 14.0  # two periods
    recorded = 0.5 * math.degrees(float(np.ptp(kept.twist[late])))
    assert found["twist_amplitude_deg"] == pytest.approx(recorded, rel=0.05)
    assert not found["extrapolated"]


def test_limit_cycle_beyond_what_a_release_has_seen_is_marked(sweep):
    """A release that decays knows nothing of large amplitudes."""
    small = learn(sweep["2d"][8.5], POLAR, 45.0)
    assert limit_cycles(small, [sweep["2d"][5.5].section], 150.0).iloc[0]["extrapolated"]


def test_limit_cycle_of_a_symmetric_section_needs_the_start_of_its_run():
    """At 0 deg a section at rest stays there, however unstable: c_m = 1.7 alpha - 40 alpha^3."""
    angles = np.linspace(-0.4, 0.4, 81)
    polar = Polar(angles, 0.0 * angles, 7.0 * angles, 1.7 * angles - 40.0 * angles**3, "even")
    driven = np.array([0.4, 0.0, 0.3, 0.0, 0.0, -60.0, 0.0, 0.0])
    loads = replace(KNOWN, polar=polar, incidence_rad=0.0, moment=driven, lift=0.0 * driven)
    at_rest, moved = (
        limit_cycles(loads, [SECTION], 60.0, start=start).iloc[0]["twist_amplitude_deg"]
        for start in ((0.0, 0.0), (0.01, 0.0))
    )
    assert at_rest == 0.0
    assert moved > 0.3


def cut(history: ReferenceHistory, kept: slice | np.ndarray) -> ReferenceHistory:
    names = ("time", "twist", "deflection", "lift_coefficient", "moment_coefficient")
    return replace(history, **{name: getattr(history, name)[kept] for name in names})


def test_records_that_say_nothing_are_refused_by_name(sweep):
    history = sweep["2d"][6.44]
    with pytest.raises(ResultFileError, match=r"2d/k6.44: a record of 20.1 c/V is too short"):
        learn(cut(history, history.time <= 20.0), POLAR)
    with pytest.raises(ResultFileError, match=r"34.9 c/V is too short .* 35 c/V or more"):
        learn(cut(history, history.time < 34.85), POLAR)
    # a sample stands for its interval: none has to be at the end of 35 c/V
    learn(cut(history, history.time < 34.95), POLAR)
    assert ends_of_records(np.arange(0.0, 49.9, 0.2)) == ENDS
    assert ends_of_records(np.arange(0.0, 49.7, 0.2))[1] == pytest.approx(49.6)
    gap = cut(history, (history.time < 20.0) | (history.time > 22.0))
    with pytest.raises(ResultFileError, match=r"samples are 2.2 c/V apart at s = 19.9"):
        learn(gap, POLAR)
    with pytest.raises(ResultFileError, match=r"samples are 0\.5 c/V apart; at most 0\.25"):
        learn(cut(history, slice(None, None, 5)), POLAR)


def test_moment_and_twist_that_contradict_the_section_are_refused(sweep):
    history = sweep["2d"][6.44]
    about_quarter = history.moment_coefficient - 0.25 * history.lift_coefficient
    for changed, mistake in (
        ({"twist": np.degrees(history.twist)}, "degrees taken for radians"),
        ({"moment_coefficient": about_quarter}, r"moment_axis: 0\.25"),
    ):
        with pytest.raises(ResultFileError, match=f"does not follow .*{mistake}"):
            learn(replace(history, **changed), POLAR)


def test_motion_that_has_settled_says_nothing():
    """Heavy dampers end the motion within a few periods: nothing is left to learn from."""
    damped = SECTION.scaled(20.0).model_copy(
        update={"torsional_damping": 30.0, "flexural_damping": 60.0}
    )
    history = released(damped, KNOWN)
    with pytest.raises(ResultFileError, match="known: the motion has settled"):
        learn(history, POLAR)


def test_thin_polar_names_the_angles_that_are_missing():
    few = Polar(*(x[::4] for x in (POLAR.incidence, POLAR.drag, POLAR.lift, POLAR.moment)), "few")
    seen = (math.radians(1.0), math.radians(6.0))
    missing = missing_angles(few, seen)
    assert missing
    assert not set(missing) & set(np.round(np.degrees(few.incidence), 6))
    assert missing_angles(POLAR, seen) == []


def test_filled_polar_is_itself_at_its_angles_and_the_denser_in_shape():
    sparse = (0.0, 2.5, 5.0, 10.0)
    angles = np.radians(sparse)
    values = [1.1 * read(angles) for read in (POLAR.lift_coefficient, POLAR.moment_coefficient)]
    thin = Polar(angles, np.zeros(4), *values, "thin")
    found = filled(thin, POLAR)
    inside = np.radians(np.linspace(2.5, 10.0, 20))
    np.testing.assert_allclose(
        found.moment_coefficient(inside), 1.1 * POLAR.moment_coefficient(inside), rtol=1e-6
    )
