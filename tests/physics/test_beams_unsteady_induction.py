"""Beams with unsteady induction: limits, and growth against the kept releases in CFD."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.identification import identify_lags
from equisection.aerodynamics.indicial import LAG_RATES
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_induction import INDUCTION_RATES, induction_states
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.motion.beams import BeamParameters, beam_system, release_beams
from equisection.motion.release_judgement import release_numbers
from equisection.motion.steady_states import rigid_state
from equisection.results.netcdf import read_dataset
from equisection.results.recorded_history import read_reference_history

ROOT = Path(__file__).parents[2]
INCIDENCE = math.radians(2.5)
KEPT = ROOT / "results/reference/paper-plate-openfoam-3d/unsteady/3d"
REDUCTIONS = ROOT / "results/reference/paper-reductions/unsteady/2d-consistent"
#: Polar of the cells of the plate, as the flow solver's plate has them.
POLAR = Polar.read(ROOT / "config/polars/plate_2d_3132.csv")
STRIPS = cosine_strips(12)


def beam(case: dict, length: float) -> BeamParameters:
    """Return the modes of a case as a plate of some length in the channel."""
    modes = case["beam"]
    return BeamParameters.from_modes(
        span=np.array(modes["span"]),
        torsion_shapes=np.array(modes["torsion_shape"]),
        torsion_frequencies=np.array([modes["torsion_frequency"]]),
        inertia=np.array([modes["inertia"]]),
        bending_shapes=np.array(modes["bending_shape"]),
        bending_frequencies=np.array([modes["bending_frequency"]]),
        mass=np.array([modes["mass"]]),
        stations=STRIPS.stations,
        weights=STRIPS.weights,
        finite_span=FiniteSpan.of(SpanGeometry.of(STRIPS, 1.0, length, 4.0, 4.0)),
    )


def kept(k_star: str) -> tuple[xr.Dataset, dict]:
    dataset = read_dataset(KEPT / f"k{k_star}.nc")
    return dataset, json.loads(dataset.attrs["case"])


@cache
def loads() -> UnsteadyLoads:
    """Return the loads of that polar with the lags of two releases of a section on its cells."""
    runs = [read_reference_history(REDUCTIONS / f"k{k_star}.nc") for k_star in ("5", "10")]
    return UnsteadyLoads.from_polar(POLAR, identify_lags(POLAR, runs).lags)


def test_held_between_walls_every_strip_has_the_loads_of_the_polar() -> None:
    system = beam_system(beam(kept("8")[1], 4.0), loads(), INCIDENCE)
    states, deficits = rigid_state(system)
    columns = np.concatenate([states[0], deficits[0], [1.0]])
    bubble = system.probe[0, : STRIPS.stations.size] @ columns
    lift = states[0, system.layout.lag(3)]
    assert bubble == pytest.approx(INCIDENCE, abs=1e-8)
    assert lift == pytest.approx(float(POLAR.lift_coefficient(INCIDENCE)), abs=1e-7)


def test_between_walls_a_beam_that_moves_as_one_has_the_loads_of_its_section() -> None:
    """Nothing trails, at any frequency; its air is that of the section."""
    shape = np.ones((1, 201))
    values = {
        "span": np.linspace(0.0, 1.0, 201),
        "torsion_shapes": shape,
        "torsion_frequencies": np.array([[0.9]]),
        "inertia": np.array([6.7]),
        "bending_shapes": shape,
        "bending_frequencies": np.array([[0.12]]),
        "mass": np.array([80.0]),
        "stations": STRIPS.stations,
        "weights": STRIPS.weights,
    }
    walls = FiniteSpan.of(SpanGeometry.of(STRIPS, 1.0, 4.0, 4.0, 4.0))
    closed, alone = (
        release_beams(BeamParameters.from_modes(**values, finite_span=span), loads(), INCIDENCE, 40)
        for span in (walls, None)
    )
    np.testing.assert_allclose(closed.tip_twist, alone.tip_twist, atol=1e-7)
    np.testing.assert_allclose(closed.lift_coefficient, alone.lift_coefficient, atol=1e-6)


def test_incidence_of_the_assembled_states_is_that_of_the_induction() -> None:
    """alpha_i of the assembled system over its circulatory lift is T(omega) of the geometry."""
    geometry = SpanGeometry.of(STRIPS, 1.0, 3.7, 4.0, 4.0)
    system = beam_system(beam(kept("8")[1], 3.7), loads(), 0.0)
    layout = system.layout
    induction = induction_states(geometry)
    states = np.concatenate([np.arange(layout.size)[layout.lag(n)] for n in (4, 5, 6)])
    # z_1' = 2 b_1 (alpha_34 - z_1): its row has alpha_i in it
    seen = -system.rates[0, layout.lag(0)][:, states] / LAG_RATES[0]
    rates = np.repeat(INDUCTION_RATES, layout.strips)
    for omega in (0.0, 0.8, 1.6):
        found = seen @ (rates / (1j * omega + rates))
        np.testing.assert_allclose(found, induction.matrix(omega).sum(axis=1), atol=1e-12)


@pytest.mark.parametrize("k_star", ["5", "5.5", "6.44", "8", "21"])
def test_growth_has_the_sign_of_the_flow_solvers(k_star: str) -> None:
    """On the same cells. At 10 it has not: the flow solver's plate grows with 0.005 V/c."""
    dataset, case = kept(k_star)
    chord = case["geometry"]["chord"]
    recorded = release_numbers(
        dataset["time"].values,
        dataset["tip_twist"].values,
        dataset["tip_deflection"].values / chord,
    )
    run = release_beams(beam(case, 3.7), loads(), INCIDENCE, float(dataset["time"][-1]))
    part = slice(0, int(run.samples[0]))
    found = release_numbers(run.time[part], run.tip_twist[part, 0], run.tip_deflection[part, 0])
    assert (found.growth_rate > 0.0) == (recorded.growth_rate > 0.0)
    assert found.growth_rate == pytest.approx(recorded.growth_rate, abs=0.01)
    assert found.frequency == pytest.approx(recorded.frequency, rel=0.02)
    assert found.mean_deflection_chords == pytest.approx(recorded.mean_deflection_chords, rel=0.12)
