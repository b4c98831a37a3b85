"""Map of stability in Python, of sections and of beams on any supports."""

from __future__ import annotations

import numpy as np
import pytest

import equisection as eq
from equisection.aerodynamics.separation import SeparationLags
from equisection.errors import ArgumentError, ModesError

THIN = eq.Polar.flat_plate(0.3)
NONE = SeparationLags.none()
BETWEEN_WALLS = (10.0, 0.0)
SPEEDS = (5.0, 60.0, 120.0)


SECTION = {
    "bending_rigidity": 1.1e4,
    "torsional_rigidity": 1.4e4,
    "mass_per_length": 15.0,
    "inertia_per_length": 1.3,
}
#: Rigidities with which ten times the length has the same frequencies.
LONGER = {"bending_rigidity": 1.1e8, "torsional_rigidity": 1.4e6}


def panel(**more) -> eq.Beam:
    return eq.Beam(
        **{
            "chord": 1.0,
            "length": 6.0,
            "thickness": 0.04,
            "boundary": "pinned-pinned",
            "cross_section": SECTION,
            **more,
        }
    )


def onset_of(body, angles=(0.0,), **more) -> np.ndarray:
    found = eq.stability_map(
        body, THIN, incidence_deg=list(angles), speed=SPEEDS, lags=NONE, **more
    )
    return found["critical_speed"].values


def beam_onset(beam: eq.Beam, modes=(1, 1), angles=(0.0,), **more) -> np.ndarray:
    given = {"channel": BETWEEN_WALLS, "strips": 8, **more}
    return onset_of(beam, angles, method="beam", elements=(1, 24, 1), modes=modes, **given)


def test_slender_beam_between_walls_goes_unstable_with_its_section():
    """Both first shapes are a half sine, whose load trails the less the longer the beam is."""
    section = onset_of(eq.reduce(panel(), method="beam"))
    long = panel(length=60.0, cross_section={**SECTION, **LONGER})
    differences = [float(beam_onset(beam)[0] / section[0] - 1.0) for beam in (panel(), long)]
    assert differences[0] == pytest.approx(0.022, abs=0.004)
    assert abs(differences[1]) < 1e-3  # of eight strips


def test_supports_at_the_ends_are_the_boundary_of_that_name():
    ends = [{"at": at, "deflection": "fixed", "twist": "fixed"} for at in (0.0, 1.0)]
    listed = panel(boundary="supports", supports=ends)
    found = [beam_onset(beam, angles=(2.0,)) for beam in (listed, panel())]
    assert found[0] == pytest.approx(found[1], rel=1e-6)


@pytest.mark.parametrize(
    ("more", "error", "words"),
    [
        ({"modes": (0, 1)}, ArgumentError, "modes is"),
        ({"modes": 3}, ArgumentError, "modes is 3"),
        ({"strips": 2}, ArgumentError, "strips is 2"),
        ({"strips": 12.5}, ArgumentError, "strips is 12.5"),
        ({"density": float("inf")}, ArgumentError, "density is inf"),
        ({"channel": (0.5, 0.0)}, ArgumentError, "channel is"),
        ({"method": "solid"}, ModesError, "method='beam'"),
    ],
)
def test_arguments_that_make_no_sense_are_named(more, error, words):
    given = {"method": "beam", **more}
    with pytest.raises(error, match=words):
        onset_of(panel(), **given)


def test_beam_without_an_equilibrium_at_one_incidence_has_the_others():
    found = eq.stability_map(
        panel(),
        THIN,
        incidence_deg=[0.0, 25.0],
        speed=SPEEDS,
        lags=NONE,
        method="beam",
        modes=(1, 1),
        strips=4,
    )
    assert np.isfinite(found["critical_speed"].values[0])
    assert "25 deg is outside polar" in str(found["note"].values[1])


def test_a_single_incidence_leaves_no_dimension():
    """As of ``stability`` and ``critical_speed``: one number in, one number out."""
    section = eq.reduce(panel(), method="beam")
    one, listed = (
        eq.stability_map(section, THIN, incidence_deg=angle, speed=SPEEDS, lags=NONE)
        for angle in (0.0, [0.0])
    )
    assert np.isfinite(one["critical_speed"])
    assert float(one["critical_speed"]) == float(listed["critical_speed"].values[0])
    assert "incidence_deg" not in one.sizes
    assert one["incidence_deg"].item() == 0.0
