"""Linear theory of the equivalent section beside the runs: on the axis of k*."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from equisection.analysis.linear_theory import (
    COLUMNS,
    ONSET_COLUMNS,
    linear_onset,
    linear_theory,
    moment_slope,
    with_linear_theory,
)
from equisection.beam.section import Section
from equisection.motion.linear_flutter import (
    FlutterIterationError,
    growth_and_frequency,
)

#: The paper's plate, with the consistent section 6 % stiffer and lighter.
EQUIVALENT = xr.Dataset(
    {
        "m_star": ("reduction", [60.8, 80.0]),
        "i_star": ("reduction", [6.67, 6.67]),
        "k_w_star": ("reduction", [3.9, 5.1]),
        "k_star": ("reduction", [21.3, 22.6]),
        **dict.fromkeys(("s_star", "c_w_star", "c_theta_star"), ("reduction", [0.0, 0.0])),
        "elastic_axis": ("reduction", [0.5, 0.5]),
        **dict.fromkeys(("twist_recovery", "deflection_recovery"), ("reduction", [1.0, 1.0])),
    },
    {"reduction": ["paper", "consistent"]},
)


def polar(angles: tuple[float, ...], slope: float = 1.0) -> xr.Dataset:
    """Return a polar whose c_m grows evenly with the incidence."""
    moment = slope * np.radians(angles)[None]
    names = dict.fromkeys(("cd", "cl", "cm"), (("resolution", "incidence_deg"), moment))
    return xr.Dataset(
        names, {"resolution": ["coarse"], "incidence_deg": list(angles)}, {"solver_coarse": "made"}
    )


def test_both_sections_are_at_the_k_star_of_the_axis() -> None:
    """Divergence is where the section's own k* is the slope of the moment."""
    found = linear_onset(EQUIVALENT, 1.3)
    for reduction, own in (("paper", 21.3), ("consistent", 22.6)):
        expected = [math.pi / 2 * 21.3 / own, 1.3 * 21.3 / own]
        assert [found[reduction][name] for name in ONSET_COLUMNS[1:]] == pytest.approx(expected)


def test_growth_vanishes_at_the_k_star_of_flutter() -> None:
    k_star = linear_onset(EQUIVALENT, 1.3)["consistent"]["linear_flutter"]
    table = linear_theory(EQUIVALENT, [k_star, 21.0])
    assert tuple(table.columns) == COLUMNS
    here = table[(table["reduction"] == "consistent") & (table["k_star"] == k_star)]
    assert here["growth_rate"].max() == pytest.approx(0.0, abs=1e-8)
    assert here["growth_rate_exact"].max() == pytest.approx(0.0, abs=1e-8)


def test_stiff_sections_move_at_their_natural_frequencies() -> None:
    table = linear_theory(EQUIVALENT, [21.3e4]).set_index(["reduction", "motion"])
    natural = math.sqrt(21.3e4 / 6.67) / (2 * math.pi)
    assert table.loc[("paper", "pitch"), "frequency_strouhal"] == pytest.approx(natural, rel=0.01)


def test_k_star_at_which_the_iteration_finds_nothing_is_missing_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    index = ["reduction", "motion", "k_star"]
    known = linear_theory(EQUIVALENT, [4.0, 8.0, 21.0]).set_index(index)

    def settles_above(section: Section, scales: np.ndarray) -> np.ndarray:
        if np.any(scales < 0.3):
            raise FlutterIterationError("did not settle")
        return growth_and_frequency(section, scales)

    monkeypatch.setattr("equisection.analysis.linear_theory.growth_and_frequency", settles_above)
    found = linear_theory(EQUIVALENT, [4.0, 8.0, 21.0]).set_index(index)
    is_lost = found.index.get_level_values("k_star") == 4.0
    by_p_k = ["growth_rate", "frequency_strouhal"]
    assert found.loc[is_lost, by_p_k].isna().all(axis=None)
    pd.testing.assert_frame_equal(found[~is_lost], known[~is_lost])


def test_slope_of_a_polar_that_is_not_there_is_unknown() -> None:
    assert moment_slope(polar((0.0, 2.0, 4.0, 6.0)), "coarse", 2.5) == pytest.approx(1.0)
    assert math.isnan(moment_slope(polar((0.0, 2.0, 4.0)), "coarse", 2.5))
    assert math.isnan(moment_slope(polar((0.0, 2.0, 4.0, 6.0)), "coarse", 7.0))


def test_slope_of_a_polar_is_that_about_the_elastic_axis() -> None:
    """c_m' + x (c_l' + c_d) at zero incidence; lift, drag and moment here are all alpha."""
    found = moment_slope(polar((-4.0, -2.0, 0.0, 2.0, 4.0)), "coarse", 0.0, 0.3)
    assert found == pytest.approx(1.0 - 0.2 * 1.0)


def test_flutter_of_the_beam_is_beside_that_of_its_sections() -> None:
    linear = linear_onset(EQUIVALENT.assign(beam_flutter_k_star=1.7), 1.3)
    table = with_linear_theory(pd.DataFrame({"model": ["2d", "3d"]}), linear, "consistent")
    assert table["linear_flutter"][1] == 1.7
    assert math.isnan(table["linear_divergence"][1])
    assert math.isnan(linear_onset(EQUIVALENT, 1.3)["beam"]["linear_flutter"])


def test_only_uncorrected_sections_have_it_in_the_table_of_the_onset() -> None:
    models = ["2d", "2d-corrected", "3d", "2d-paper"]
    linear = linear_onset(EQUIVALENT, 1.3)
    table = with_linear_theory(pd.DataFrame({"model": models}), linear, "consistent")
    divergence = table.set_index("model")["linear_divergence"]
    assert divergence["2d"] == pytest.approx(linear["consistent"]["linear_divergence"])
    assert divergence["2d-paper"] == pytest.approx(linear["paper"]["linear_divergence"])
    assert divergence[["2d-corrected", "3d"]].isna().all()
