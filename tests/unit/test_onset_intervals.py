"""Intervals of the critical speeds of a map: what is in them, and how the effects add up."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
import pytest
from tests.conftest import ROOT

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.analysis.mapped_models import MappedModel, stability_table
from equisection.analysis.onset_intervals import (
    COLUMNS,
    SpeedInterval,
    half_range,
    sensitivity_table,
    with_intervals,
)
from equisection.beam.section import Section
from equisection.config import Config, load_config
from equisection.config.groups import Uncertainty
from equisection.errors import ConfigError
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.stability_map import map_lines
from equisection.solvers.embedded.known_spreads import known_spread
from equisection.solvers.registry import solver_from_config

POLAR = ROOT / "config" / "polars" / "plate_2d_11136.csv"
OF_THE_STRUCTURE = ["mass", "inertia", "k_w", "k_theta"]
KNOWN = [*OF_THE_STRUCTURE, "tau_1", "tau_2", "tau_3", "lift", "moment", "growth"]
NOTHING = dict.fromkeys(Uncertainty.model_fields, 0)


def config_with(uncertainty: dict[str, Any], **embedded: Any) -> Config:
    polars = {"coarse": str(POLAR)}
    return load_config(
        {
            "sweep": {"speed": [10.0, 80.0], "incidence_deg": [2.5]},
            "embedded": {"polars": polars, **embedded},
            "uncertainty": uncertainty,
        }
    )


def tables(config: Config) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Sensitivities and stability of the plate's section at 2.5 deg, damped by 0.5 %."""
    section = Section(
        torsional_stiffness=47.0, flexural_stiffness=1161.0, inertia=3.93e-4, mass=0.472, chord=0.1
    )
    section = section.model_copy(
        update={
            "torsional_damping": 0.01 * math.sqrt(47.0 * 3.93e-4),
            "flexural_damping": 0.01 * math.sqrt(1161.0 * 0.472),
        }
    )
    loads = UnsteadyLoads.from_polar(Polar.read(POLAR))
    body = BodyInFlow.of_section(section, loads, config.flow.density)
    models = [
        MappedModel(
            "2d", tuple(map_lines(body, [math.radians(2.5)], np.array([10.0, 40.0, 80.0])))
        ),
        MappedModel("2d-paper", (), "no section stands for it"),
    ]
    found = sensitivity_table(models, config, solver_from_config(config, "coarse"))
    return found, with_intervals(stability_table(models, 22.0), found)


def test_effects_add_up_as_the_root_of_the_sum_of_squares():
    found = SpeedInterval.of(20.0, [(17.0, 24.0), (23.0, 16.0)])
    assert (found.low, found.high) == pytest.approx((15.0, 25.0))
    assert found.worst == pytest.approx(13.0)


def test_an_end_that_is_higher_than_the_speed_lowers_nothing():
    found = SpeedInterval.of(20.0, [(21.0, 22.0)])
    assert (found.low, found.high, found.worst) == pytest.approx((20.0, 22.0, 20.0))


def test_open_ends_open_the_interval():
    assert SpeedInterval.of(20.0, [(19.0, math.inf)]).high == math.inf
    assert SpeedInterval.of(20.0, [(0.0, 21.0)]).low == 0.0
    assert math.isnan(SpeedInterval.of(20.0, [(math.nan, 21.0)]).low)


def test_every_known_input_of_the_default_plate_is_in_its_interval():
    found, stability = tables(config_with({}))
    assert tuple(found.columns) == COLUMNS
    varied = found[found["half_range"].notna()]
    assert list(varied["parameter"]) == KNOWN
    assert varied["source"].str.len().gt(0).all()
    row = stability.iloc[0]
    assert row["interval_of"] == " + ".join(KNOWN)
    # each part in its row: their squares add up, and the largest is named
    assert varied["share"].sum() == pytest.approx(1.0)
    below = row["speed"] - row["speed_from"]
    assert np.linalg.norm(varied["lowers"]) == pytest.approx(below, rel=1e-9)
    assert np.linalg.norm(varied["raises"]) == pytest.approx(row["speed_to"] - row["speed"])
    most = varied.loc[varied["share"].idxmax()]
    assert row["largest_part"] == f"{most['parameter']} {100 * most['share']:.0f} %"
    assert most["lowers"] == varied["lowers"].max()
    assert found["note"].eq("").all()
    # a usual half-range is so small that the sensitivity tells what it does
    for name in ("mass", "inertia", "k_w", "k_theta"):
        one = varied.set_index("parameter").loc[name]
        linear = abs(one["sensitivity"]) * one["half_range"] * row["speed"]
        assert one["lowers"] == pytest.approx(linear, rel=0.1)
        assert one["raises"] == pytest.approx(linear, rel=0.1)
    assert row["speed_worst"] < row["speed_from"] < row["speed"] < row["speed_to"]
    refused = stability.iloc[1]
    assert math.isnan(refused["speed_from"])
    assert refused["interval_of"] == refused["largest_part"] == ""


def test_nothing_known_is_no_interval():
    found, stability = tables(config_with(NOTHING))
    assert found["half_range"].isna().all()
    assert math.isnan(stability["speed_from"][0])
    assert stability["interval_of"][0] == ""


def test_small_half_range_moves_the_speed_by_its_sensitivity():
    part = 0.002
    found, stability = tables(config_with({**NOTHING, "moment": part}))
    row = found.set_index("parameter").loc["moment"]
    expected = part * row["sensitivity"] * stability["speed"][0]
    assert row["speed_at_more"] - row["speed_at_less"] == pytest.approx(2 * expected, rel=1e-2)
    width = stability["speed_to"][0] - stability["speed_from"][0]
    assert width == pytest.approx(2 * abs(expected), rel=1e-2)


def test_damping_goes_no_lower_than_none():
    """Of 0.5 % of critical, 1 % less is no damping at all: less and more are not alike."""
    wide, _ = tables(config_with({**NOTHING, "damping": 0.01}))
    all_of_it, _ = tables(config_with({**NOTHING, "damping": 0.005}))
    less = [one.set_index("parameter").loc["damping_torsion"] for one in (wide, all_of_it)]
    assert less[0]["speed_at_less"] == pytest.approx(less[1]["speed_at_less"], rel=1e-6)
    assert less[0]["speed_at_more"] > less[1]["speed_at_more"] > less[1]["speed_at_less"]


def test_own_spread_of_each_property_and_of_the_mesh_is_in_the_interval():
    """Axes lie to either side of mid-chord, where they are, and the mesh is a part of the speed."""
    own = {"mass_axis": 0.01, "elastic_axis": 0.01, "density": 0.05, "drag": 0.1, "mesh": 0.02}
    found, stability = tables(config_with({**NOTHING, **own}))
    varied = found[found["half_range"].notna()].set_index("parameter")
    speed = stability["speed"][0]
    assert set(varied.index) == set(own)
    assert set(varied["source"]) == {"configuration"}
    for name in ("mass_axis", "elastic_axis"):
        row = varied.loc[name]
        ends = np.array([row["speed_at_less"], row["speed_at_more"]]) - speed
        assert ends[0] * ends[1] < 0.0
        assert ends[1] - ends[0] == pytest.approx(0.02 * row["sensitivity"], rel=0.1)
    assert varied.loc["mesh", "lowers"] == pytest.approx(0.02 * speed)


def test_slope_at_an_onset_that_the_growth_leaves_open_is_said_to_say_little():
    found, stability = tables(config_with({**NOTHING, "growth": 0.2}))
    assert math.isinf(stability["speed_to"][0])
    assert found["note"].str.contains("0.2 V/c").all()
    assert found["note"].str.contains("says little").all()


def test_of_other_lags_and_polars_nothing_is_known():
    other = SeparationLags(2.0, 0.46, 0.59)
    assert known_spread("tau_1", 2.5, "plate_2d_11136", other) is None
    assert known_spread("lift", 2.5, "plate_2d_11136", other) is not None
    assert known_spread("lift", 2.5, "own", IDENTIFIED_LAGS) is None
    config = config_with({}, separation={"relaxation": 2.0})
    solver = solver_from_config(config, "coarse")
    assert half_range(config, solver, "2d", "tau_1", 2.5).size == 0.0
    assert half_range(config, solver, "2d", "growth", 2.5).size == 0.0


def test_half_range_of_the_moment_goes_from_one_incidence_of_the_grid_study_to_the_next():
    sizes = []
    for angle in (0.0, 2.5, 3.75, -5.0, 8.0):
        known = known_spread("moment", angle, "plate_2d_11136", IDENTIFIED_LAGS)
        assert known is not None
        sizes.append(known.half_range)
    assert sizes == pytest.approx([0.035, 0.035, 0.0825, 0.13, 0.13])


def test_half_ranges_of_the_lags_are_those_of_the_releases_in_the_docs():
    """Lags from other releases (docs/embedded.md), half the difference of the extremes."""
    extremes = {
        "tau_1": (2.06, 2.55, 2.37),
        "tau_2": (0.40, 0.63, 0.46),
        "tau_3": (0.52, 0.60, 0.59),
    }
    for name, (least, most, value) in extremes.items():
        known = known_spread(name, 2.5, "plate_2d_11136", IDENTIFIED_LAGS)
        assert known is not None
        assert known.half_range == pytest.approx(0.5 * (most - least) / value, abs=0.005)


def test_a_given_number_takes_the_place_of_what_is_known():
    config = config_with({"lags": 0.2, "growth": 0.001})
    solver = solver_from_config(config, "coarse")
    assert half_range(config, solver, "2d", "tau_2", 2.5).size == 0.2
    assert half_range(config, solver, "2d", "growth", 2.5).source == "configuration"


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"lags": "unknown"}, "uncertainty.lags"),
        ({"moment": 1.5}, "uncertainty.moment"),
        ({"damping": -0.01}, "uncertainty.damping"),
        ({"growth": -1.0}, "uncertainty.growth"),
        ({"mass": "known"}, "uncertainty.mass"),
        ({"elastic_axis": 0.6}, "uncertainty.elastic_axis"),
    ],
)
def test_a_value_that_is_none_is_told_by_its_key(given: dict[str, Any], named: str):
    with pytest.raises(ConfigError, match=named):
        config_with(given)


def test_a_run_without_a_map_has_no_interval_to_ask_for():
    with pytest.raises(ConfigError, match=r"uncertainty\.damping"):
        load_config({"uncertainty": {"damping": 0.01}})
