"""Loads of a beam's strips learnt from one release: of known loads, in limits, and of CFD."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from tests.workflow.project import ROOT

from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.analysis.recorded_beam import on_strips, read_recorded_beam
from equisection.analysis.reduced_beam import (
    growth_of_pitch,
    learnt_beam,
    predicted_beams,
)
from equisection.analysis.reduced_model import predicted_onset
from equisection.cases import BeamModes
from equisection.errors import ResultFileError
from equisection.motion.beam_lesson import BeamRelease, learn_strips
from equisection.motion.beams import BeamParameters
from equisection.motion.learnt_beams import LearntBeams
from equisection.results.netcdf import read_dataset
from equisection.verdict.growth import growth_of

#: k* of kept releases of the plate by OpenFOAM.
PLATES = (5.0, 6.44, 8.0, 10.0)
REFERENCE = ROOT / "results" / "reference"
SECTION = Polar.read(ROOT / "config" / "polars" / "plate_2d_11136.csv").continued
STRIPS = cosine_strips(8)
# the loads fall towards the tip
SHARE = np.sqrt(1.0 - STRIPS.stations**2)
POLARS = StripPolars(
    SECTION.incidence,
    STRIPS.stations,
    np.outer(SECTION.lift, SHARE),
    np.outer(SECTION.moment, SHARE),
    "known",
)
KNOWN = LearntStrips(
    polars=POLARS,
    incidence_rad=math.radians(2.5),
    rate=0.6,
    moment=np.array([-0.6, -5.0, 0.7, 15.0, 0.0]),
    lift=np.array([-1.0, -30.0, -2.0, 40.0, 0.0]),
    residual_moment=0.0,
    residual_lift=0.0,
    seen=(-1.0, 1.0),
    learnt_until=50.0,
)


def beams(k_star: list[float], shapes: str = "cantilever", **changes) -> BeamParameters:
    """Return beams with two torsion and two bending modes, much as the paper's plate."""
    span = np.linspace(0.0, 1.0, 101)
    torsion = np.array([np.sin(0.5 * np.pi * span), np.sin(1.5 * np.pi * span)])
    bending = np.array([1.0 - np.cos(0.5 * np.pi * span), span**2 * (1.0 - 1.4 * span) / 0.4])
    if shapes == "rigid":
        torsion = bending = np.ones((1, span.size))
    scale = np.sqrt(np.array(k_star) / 6.44)[:, None]
    modes = torsion.shape[0]
    given = {
        "torsion_frequencies": scale * np.array([1.01, 3.1])[:modes],
        "inertia": np.full(len(k_star), 6.67),
        "bending_frequencies": scale * np.array([0.14, 0.87])[:modes],
        "mass": np.full(len(k_star), 80.0),
        "stations": STRIPS.stations,
        "weights": STRIPS.weights,
    }
    return BeamParameters.from_modes(
        span=span, torsion_shapes=torsion, bending_shapes=bending, **{**given, **changes}
    )


def recorded(
    parameters: BeamParameters, loads: LearntStrips = KNOWN, duration: float = 52.0
) -> BeamRelease:
    """Return the release of a beam under known loads, as a solver records it."""
    fine = 5
    swings = LearntBeams(parameters, loads).released(duration, 0.1 / fine)
    return BeamRelease(
        swings.time[::fine],
        swings.torsion[::fine, 0].T,
        swings.bending[::fine, 0].T,
        parameters,
        loads.incidence_rad,
        k_star=6.44,
        name="known",
        source="a known model",
    )


@pytest.fixture(scope="module")
def release() -> BeamRelease:
    """Return the release of a beam at k* 6.44 under the known loads."""
    return replace(recorded(beams([6.44])), name="3d/k6.44")


def test_known_loads_are_found_from_the_motion_that_they_make(release):
    found = learn_strips(release, POLARS, 45.0)
    assert found.rate == pytest.approx(KNOWN.rate, rel=0.03)
    np.testing.assert_allclose(found.moment[:3], KNOWN.moment[:3], rtol=0.15)
    assert found.residual_moment < 0.01
    assert found.residual_lift < 0.03
    # a slope of the steady loads that is right needs no correction
    free = learn_strips(release, POLARS, 45.0, free_slope=True)
    assert abs(free.moment[4]) < 0.02 * SECTION.moment_slope()
    wrong = replace(POLARS, moment=1.2 * POLARS.moment)
    steep = learn_strips(release, wrong, 45.0, free_slope=True)
    assert steep.moment[4] < -0.05 * SECTION.moment_slope()


def test_known_loads_predict_the_releases_of_other_beams(release):
    k_star = [5.0, 8.0, 12.0]
    model = learnt_beam(release, POLARS)
    true = predicted_beams(replace(model, loads=KNOWN, refits=()), k_star, beams(k_star))
    found = predicted_beams(model, k_star, beams(k_star))
    np.testing.assert_allclose(found["growth_rate"], true["growth_rate"], atol=0.001)
    np.testing.assert_allclose(found["frequency_strouhal"], true["frequency_strouhal"], rtol=0.005)
    assert (found["growth_high"] - found["growth_low"] >= 0.01 - 1e-12).all()
    assert model.words == "model learnt from a known model at k* = 6.44, on strips"


def test_small_motions_go_as_the_eigenvalues():
    """At rest nothing moves, and the matrix has the slopes of the rates there."""
    moved = LearntBeams(beams([12.0, 16.0], imbalance=np.full(2, 0.3)), KNOWN)
    rest = moved.equilibria()
    angles = rest[:, :2] @ moved.parameters.structure.torsion_shapes.T
    state = np.concatenate([rest, np.zeros_like(rest), angles], axis=1)
    np.testing.assert_allclose(moved.rates(state), 0.0, atol=2e-6)
    step = 1e-5
    for place in range(state.shape[1]):
        change = step * np.eye(state.shape[1])[place]
        slope = (moved.rates(state + change) - moved.rates(state - change)) / (2.0 * step)
        expected = moved.linearised(rest)[0, :, place]
        np.testing.assert_allclose(slope[0], expected, rtol=0.02, atol=0.01)
    small = growth_of_pitch(moved)
    assert small[1] < small[0]  # the stiffer beam is the more stable one


def test_without_loads_a_beam_keeps_its_energy():
    still = replace(POLARS, lift=0.0 * POLARS.lift, moment=0.0 * POLARS.moment)
    none = replace(KNOWN, polars=still, moment=np.zeros(5), lift=np.zeros(5))
    values = LearntBeams(beams([6.44]), none).eigenvalues()[0]
    assert np.abs(values.real[values.imag != 0.0]).max() < 1e-10


def test_strips_of_a_beam_that_moves_as_a_whole_are_all_alike():
    """Shapes of 1 and one polar all along: any number of strips is one section."""
    found = []
    for count in (2, 8):
        strips = cosine_strips(count)
        one = np.ones(count)
        polars = StripPolars(
            SECTION.incidence,
            strips.stations,
            np.outer(SECTION.lift, one),
            np.outer(SECTION.moment, one),
            "alike",
        )
        parameters = beams([9.0], "rigid", stations=strips.stations, weights=strips.weights)
        swings = LearntBeams(parameters, replace(KNOWN, polars=polars)).released(20.0)
        found.append(np.concatenate([swings.torsion, swings.bending], axis=2))
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9, atol=1e-12)


def test_motion_converges_in_the_second_order_of_its_step():
    moved = LearntBeams(beams([9.0]), KNOWN)
    at_end = [moved.released(20.0, step).torsion[-1, 0, 0] for step in (0.2, 0.1, 0.05, 0.025)]
    errors = np.abs(np.diff(at_end))
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0


def test_polars_along_the_span_are_odd_and_end_at_their_last_angles():
    half = SECTION.incidence >= 0.0
    rows = {name: getattr(POLARS, name)[half] for name in ("incidence", "lift", "moment")}
    whole = replace(POLARS, **rows).continued
    alpha = np.radians(np.linspace(-9.0, 9.0, 8))
    lift, moment = whole.loads(alpha)
    np.testing.assert_allclose(lift, SECTION.lift_coefficient(alpha) * SHARE, rtol=1e-4, atol=1e-6)
    mirrored = whole.loads(-alpha)
    np.testing.assert_allclose(mirrored, (-lift, -moment), atol=1e-4)
    beyond = np.full(8, 1.0001 * whole.incidence_range[1])
    assert np.isnan(whole.loads(beyond)).all()
    slope = whole.slopes(alpha)[0]
    step = 2e-3
    rise = (whole.loads(alpha + step)[0] - whole.loads(alpha - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(slope, rise, rtol=0.05, atol=0.02)


def test_beams_that_cannot_be_learnt_are_refused_by_name(release):
    short = replace(
        release,
        time=release.time[:200],
        torsion=release.torsion[:, :200],
        bending=release.bending[:, :200],
    )
    with pytest.raises(ResultFileError, match=r"3d/k6.44: a record of 20 c/V is too short"):
        learn_strips(short, POLARS)


def test_beam_that_has_settled_says_nothing():
    """Heavy dampers end the motion within a few periods: what is left are rounding errors."""
    damped = beams([60.0], damping_ratios=(0.5, 0.5))
    with pytest.raises(ResultFileError, match="known: the motion has settled: the incidence"):
        learn_strips(recorded(damped), POLARS)


def test_one_release_of_the_plate_by_openfoam_predicts_its_growth():
    """From 45 c/V at k* 6.44, as fitted with the second bending mode: rms 0.002 V/c at 5 to 10."""
    points = []
    for path in (REFERENCE / "paper-plate-openfoam-3d" / "steady" / "3d").glob("coarse_a*.nc"):
        data = read_dataset(path)
        columns = [data[name].values for name in ("span", "cl_section", "cm_section")]
        points.append((math.radians(data.attrs["incidence_deg"]), *columns))
    points.sort(key=lambda point: point[0])
    incidence, span, lift, moment = (np.array(column) for column in zip(*points, strict=True))
    polars = StripPolars(incidence, span[0], lift, moment, "plate")
    folder = REFERENCE / "paper-plate-openfoam-3d" / "unsteady" / "3d"
    kept = [read_recorded_beam(folder / f"k{k:g}.nc", polars.strips) for k in PLATES]
    model = learnt_beam(kept[1], polars)
    cases = [json.loads(read_dataset(folder / f"k{k:g}.nc").attrs["case"]) for k in PLATES]
    parameters = on_strips([BeamModes(**case["beam"]) for case in cases], polars.strips)
    natural = LearntBeams(parameters, model.loads).natural_frequencies
    assert natural.shape == (4, 3)  # pitch, first and second bending
    windows = [(max(10.0, 59.8 - 8.0 / pitch), 59.8) for pitch in natural[:, 0]]
    recorded = [
        growth_of(one.time, [one.torsion[0], *one.bending[:2]], frequencies, window).rate
        for one, frequencies, window in zip(kept, natural, windows, strict=True)
    ]
    found = predicted_beams(model, [one.k_star for one in kept], parameters, windows)
    errors = found["growth_rate"] - recorded
    assert math.sqrt(float(np.mean(errors**2))) < 0.002
    # growth of the last, at k* 10, is nearly nothing: the band of the model holds it
    assert (found["growth_low"] < recorded).all()
    assert found["growth_low"].iloc[-1] < 0.0 < found["growth_high"].iloc[-1]
    assert math.isnan(predicted_onset(found).k_star)  # above k* 10
