"""Onset of the paper's section by OpenFOAM: from forced motion, and from releases."""

import pytest
from tests.benchmarks.moved_section import KEPT, MOVED, RELEASED, SPEEDS, moved, section

import equisection as eq
from equisection.results.netcdf import read_dataset


@pytest.fixture(scope="module")
def onsets() -> list[tuple[float, float, float]]:
    """Onset and interval over the speed at k* = 8, moved about equilibrium and rigid incidence."""
    body, k_star = section()
    assert k_star == 8.0
    found = [eq.critical_speed(body, moved(folder), speed=SPEEDS, density=2.0) for folder in MOVED]
    return [
        (float(one.critical_speed), float(one.speed_low), float(one.speed_high)) for one in found
    ]


def test_onset_of_the_releases_is_in_the_interval_of_the_table(
    onsets: list[tuple[float, float, float]],
) -> None:
    """At k* = 8 the release from equilibrium keeps its amplitude: that is the onset, speed 1."""
    (_, low, high), _ = onsets
    folder = KEPT / RELEASED[0]
    growth = [float(read_dataset(folder / f"{k}.nc").attrs["growth_rate"]) for k in ("k6.44", "k8")]
    assert growth[0] > 100 * abs(growth[1])
    assert low < 1.0 < high


def test_table_at_the_rigid_incidence_has_a_later_onset(
    onsets: list[tuple[float, float, float]],
) -> None:
    """The twist of the equilibrium counts: the speed is 9 % off without it."""
    about, rigid = onsets
    assert rigid[0] > 1.05 * about[0]
