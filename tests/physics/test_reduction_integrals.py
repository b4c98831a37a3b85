"""Integrals over the shapes against closed forms, and the warnings drawn from them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tests.sample_cases import PAPER, beam_with

from equisection.beam.beam import BOUNDARIES
from equisection.reduction.integrals import Integrals, span_integrals
from equisection.reduction.reduce import validity_warnings
from equisection.structure.modes import compute_modes

STATIONS = (1, 89, 1)
HELD = BOUNDARIES[:-1]


@cache
def analytic_integrals(boundary: str) -> Integrals:
    plate = beam_with(boundary)
    return span_integrals(plate, compute_modes(plate, "analytic", STATIONS, 16))


def test_cantilever_integrals_in_closed_form():
    integrals = analytic_integrals("clamped-free")
    # f = sin(pi z/2L) and g of unit tip: A = 1/2 and 1/4; F_n = +-2/(n pi), n odd.
    assert integrals.a_theta_theta[0, 0] == pytest.approx(0.5, rel=1e-7)
    assert np.diag(integrals.a_w_w) == pytest.approx(np.full(4, 0.25), rel=1e-5)
    n = np.array([1, -3, 5, -7])  # the sign makes the tip positive
    assert integrals.f_mean == pytest.approx(2 / (n * np.pi), abs=1e-6)
    assert integrals.g_mean[0] == pytest.approx(0.734095514 / 1.87510407, rel=1e-6)  # Blevins
    # of a uniform load's work the first modes take 8/pi^2, and 61 %
    assert integrals.twist_participation == pytest.approx(8 / np.pi**2, rel=1e-6)
    share = (0.734095514 / 1.87510407) ** 2 / 0.25
    assert integrals.deflection_participation == pytest.approx(share, rel=1e-5)
    assert integrals.stiffness_theta[0, 0] == pytest.approx(np.pi**2 / 8)
    assert integrals.stiffness_w[0, 0] == pytest.approx(1.87510407**4 / 4, rel=1e-6)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_stiffness_by_frequency_is_that_by_slope_for_a_beam(boundary):
    # Eq. 7 (with the spring's energy) against M omega^2, four modes, off the diagonal too.
    integrals = analytic_integrals(boundary)
    scale = integrals.strain_theta[3, 3]
    assert integrals.stiffness_theta == pytest.approx(integrals.strain_theta, abs=1e-5 * scale)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_torsion_and_bending_are_not_orthogonal_to_each_other(boundary):
    integrals = analytic_integrals(boundary)
    off = integrals.a_w_w - np.diag(np.diag(integrals.a_w_w))
    assert np.abs(off).max() < 1e-6
    cross = np.abs(integrals.a_theta_w)
    bound = np.sqrt(np.outer(np.diag(integrals.a_theta_theta), np.diag(integrals.a_w_w)))
    assert (cross <= bound + 1e-9).all()  # Cauchy and Schwarz
    assert integrals.a_theta_w[0, 0] > 0.5 * bound[0, 0]


def test_shares_of_a_uniform_load_add_up():
    # F_n^2/A_nn = 8/(n pi)^2, n odd, whose sum is 1 (Parseval for the function 1).
    integrals = analytic_integrals("clamped-free")
    share = integrals.f_mean**2 / np.diag(integrals.a_theta_theta)
    assert share == pytest.approx(8 / (np.array([1, 3, 5, 7]) * np.pi) ** 2, rel=1e-5)
    assert integrals.twist_participation == pytest.approx(share[0])


@pytest.mark.parametrize(
    ("boundary", "cos_phi"), list(zip(HELD, (0.959, 0.986, 1.0, 0.976, 0.849), strict=True))
)
def test_likeness_of_the_first_shapes(boundary, cos_phi):
    assert analytic_integrals(boundary).cos_phi == pytest.approx(cos_phi, abs=5e-4)


def test_the_solid_plate_is_more_alike_than_the_beam():
    # A clamp that holds warping bends the start of the torsion shape as it does the deflection's.
    modes = compute_modes(PAPER, "solid", (12, 44, 1), 12)
    integrals = span_integrals(PAPER, modes)
    assert integrals.cos_phi == pytest.approx(0.970, abs=1e-3)
    # Slope and frequency part company by the strain energy of restrained warping, 6 %.
    ratio = integrals.stiffness_theta[0, 0] / integrals.strain_theta[0, 0]
    assert 1.05 < ratio < 1.08


def test_warnings_speak_only_where_there_is_something_to_say():
    assert validity_warnings(analytic_integrals("clamped-free")) == ()
    assert validity_warnings(analytic_integrals("one-fork")) == ()  # its bias speaks, not cos(phi)
    odd = replace(analytic_integrals("clamped-free"), f_mean=np.zeros(4), g_mean=np.zeros(4))
    moment, lift = validity_warnings(odd)
    assert "moment" in moment
    assert "lift" in lift
