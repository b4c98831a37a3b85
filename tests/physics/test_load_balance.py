"""Balance of a recorded motion against its loads: exact motions, kept releases, and mistakes."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT

from equisection.aerodynamics.load_balance import MOST_UNEXPLAINED, load_balance
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
from equisection.errors import ArgumentError
from equisection.results.recorded_history import read_reference_history

KEPT = ROOT / "results/reference/paper-plate-openfoam/unsteady"
SECTION = Section(
    torsional_stiffness=6.0,
    flexural_stiffness=2.0,
    inertia=6.0,
    mass=60.0,
    static_imbalance=1.5,
    torsional_damping=0.3,
    flexural_damping=0.8,
    elastic_axis=0.4,
)


def exact(section: Section, interval: float = 0.1, end: float = 80.0) -> ReferenceHistory:
    """Return a growing motion of two frequencies, with the loads that it takes by the equations."""
    time = np.arange(0.0, end, interval)
    rates = np.array([0.01 + 0.9j, -0.02 + 0.25j])
    waves = np.exp(np.outer(rates, time))
    amplitudes = np.array([[0.01, 0.05j], [0.03 + 0.01j, 0.004]])  # of w and theta
    place, speed, push = (((amplitudes * rates**order) @ waves).real for order in range(3))
    lift, moment = (
        section.mass_matrix @ push
        + section.damping_matrix @ speed
        + section.stiffness_matrix @ place
    )
    arm = section.axis_behind_mid_chord * np.cos(place[1])
    return ReferenceHistory(
        time,
        place[1],
        place[0],
        lift,
        moment - arm * lift,
        0.0,
        k_star=6.0,
        section=section,
        name="exact",
        source="equations",
    )


@pytest.fixture(scope="module")
def release() -> ReferenceHistory:
    return read_reference_history(KEPT / "2d/k6.44.nc")


def test_exact_motion_of_any_section_is_explained() -> None:
    """With dampers, an imbalance, and the axis off mid-chord."""
    found = load_balance(exact(SECTION))
    assert max(found.lift, found.moment) < 1e-8
    assert abs(found.growth) < 1e-6
    assert found.is_explained


def test_rest_falls_faster_than_the_fourth_power_of_the_interval() -> None:
    """The window is smooth, so that its sums are integrals to a high order."""
    coarse, fine = (load_balance(exact(SECTION, interval)).moment for interval in (0.4, 0.2))
    assert fine < coarse / 2**8  # of the square of the rest


def test_growth_without_a_load_is_that_of_the_damper_left_out() -> None:
    """A free motion that a damper c slows loses c/(2 I) of its growth (V/c)."""
    damped = Section(
        torsional_stiffness=6.0,
        flexural_stiffness=2.0,
        inertia=6.0,
        mass=60.0,
        torsional_damping=0.24,
    )
    without = damped.model_copy(update={"torsional_damping": 0.0})
    found = load_balance(replace(exact(damped), section=without))
    assert found.growth == pytest.approx(-0.24 / (2 * 6.0), rel=1e-3)


def test_noise_of_the_motion_is_not_amplified() -> None:
    """Second differences would multiply it by some (interval)^-2."""
    noise = np.random.default_rng(3)
    clean = exact(SECTION)
    noisy = replace(clean, twist=clean.twist + noise.normal(0.0, 1e-3 * clean.twist.std(), 800))
    by_differences = SECTION.inertia * np.gradient(np.gradient(noisy.twist - clean.twist, 0.1), 0.1)
    share = float(np.var(by_differences) / np.var(clean.moment_coefficient))
    assert load_balance(noisy).moment < 0.01 * share


@pytest.mark.parametrize("path", sorted(KEPT.glob("2d*/*.nc")), ids=lambda path: path.stem)
def test_kept_releases_are_explained(path: Path) -> None:
    """Flow and motion of OpenFOAM are coupled within a hundredth of what is allowed."""
    found = load_balance(read_reference_history(path))
    assert max(found.lift, found.moment) < 5e-4 < 0.01 * MOST_UNEXPLAINED + 1e-12
    assert abs(found.growth) < 3e-4


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"twist": 180 / math.pi}, "degrees taken for radians): units.twist"),
        ({"twist": math.pi / 180}, "radians taken for degrees): units.twist"),
        ({"twist": -1.0}, "signs.twist: -1"),
        ({"deflection": -1.0}, "signs.deflection: -1"),
        ({"deflection": 2.0}, "semi-chords taken for chords): units.deflection"),
        ({"deflection": 1e3}, "millimetres taken for metres): units.deflection"),
        ({"deflection": 1e-3}, "metres taken for millimetres): units.deflection"),
        ({"deflection": 0.5}, "chords taken for semi-chords): units.deflection"),
        ({"time": 2.0}, "semi-chords taken for chords): units.time"),
        ({"time": 0.5}, "chords taken for semi-chords): units.time"),
        ({"moment_coefficient": 4.0}, "units.moment"),
        ({"lift_coefficient": 0.5}, "a lift 2 times as large"),
        ({"lift_coefficient": 1.7}, "a lift 0.589 or a deflection 1.7 times as large"),
        ({"moment_coefficient": -1.0}, "signs.moment: -1"),
        (
            {"lift_coefficient": 23.6, "moment_coefficient": 2.36},
            "a lift 0.0424 and a moment 0.424 times as large",
        ),
    ],
    ids=str,
)
def test_a_mistake_is_called_by_its_name(
    release: ReferenceHistory, changed: dict[str, float], words: str
) -> None:
    values = {name: factor * getattr(release, name) for name, factor in changed.items()}
    found = load_balance(replace(release, **values))
    assert not found.is_explained
    assert words in found.text


@pytest.mark.parametrize("place", [0.0, 0.25, 0.35])
def test_another_axis_of_the_moment_is_found(release: ReferenceHistory, place: float) -> None:
    arm = place - 0.5
    moved = release.moment_coefficient + arm * release.lift_coefficient
    found = load_balance(replace(release, moment_coefficient=moved))
    assert f"moment_axis: {place:.2f}" in found.text


def test_another_beam_is_no_unit(release: ReferenceHistory) -> None:
    """Stiffness a tenth off is no mistake of the columns, and is said to be the beam's."""
    found = load_balance(replace(release, section=release.section.scaled(1.1)))
    assert not found.is_explained
    assert "compare the beam of the configuration" in found.text


def test_too_short_and_too_seldom_are_refused(release: ReferenceHistory) -> None:
    for part, words in ((slice(0, 80), "two natural periods"), (slice(0, None, 8), "more often")):
        values = {
            name: getattr(release, name)[part]
            for name in ("time", "twist", "deflection", "lift_coefficient", "moment_coefficient")
        }
        with pytest.raises(ArgumentError, match=words):
            load_balance(replace(release, **values))
