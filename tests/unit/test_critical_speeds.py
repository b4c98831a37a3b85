"""Table of critical speeds: brackets in m/s, their mechanism, and the margin on the safe side."""

import math

import pandas as pd
import pytest
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.analysis.critical_speeds import (
    COLUMNS,
    from_eigenvalues,
    from_learnt,
    from_runs,
    in_words,
    with_margin,
)
from equisection.beam.section import Section
from equisection.motion.stability import critical_speed
from equisection.study.axes import AsGiven

RUN = {"twist_amplitude_deg": 3.0, "frequency_strouhal": 0.14, "solver": "embedded"}
AS_GIVEN = {"given": AsGiven(8.0, 20.0), "chord": 0.1, "incidence_deg": 2.5}


def runs(*rows: tuple[str, float, str], axis: str = "k_star", **more: object) -> pd.DataFrame:
    """Return a summary of runs: model, value, regime."""
    return pd.DataFrame([{"model": m, axis: v, "regime": r, **RUN, **more} for m, v, r in rows])


def test_bracket_over_k_star_in_metres_per_second() -> None:
    """k* of 8 at 20 m/s is 2 at 40 m/s."""
    summary = runs(("2d", 2.0, "growing"), ("2d", 8.0, "settled"), solver="openfoam")
    (row,) = from_runs(summary, **AS_GIVEN).to_dict("records")
    assert (row["speed_low"], row["speed_high"], row["speed"]) == pytest.approx((20.0, 40.0, 30.0))
    assert row["k_star"] == pytest.approx(8.0 * (20.0 / 30.0) ** 2)
    assert row["frequency_hz"] == pytest.approx(0.14 * 40.0 / 0.1)
    assert (row["mechanism"], row["basis"], row["incidence_deg"]) == ("flutter", "cfd", 2.5)


def test_bracket_over_speed_is_the_same() -> None:
    over_k = runs(("2d", 2.0, "growing"), ("2d", 8.0, "settled"))
    over_speed = runs(("2d", 40.0, "growing"), ("2d", 20.0, "settled"), axis="speed")
    one, other = (from_runs(s, **AS_GIVEN) for s in (over_k, over_speed))
    pd.testing.assert_frame_equal(one, other)


def test_basis_is_that_of_the_runs_of_each_model() -> None:
    """A model that is taken from another run has that run's solver."""
    here = runs(("2d", 2.0, "growing"), ("2d", 8.0, "settled"), solver="openfoam")
    taken = runs(("3d", 2.0, "growing"), ("3d", 8.0, "settled"), solver="embedded")
    found = from_runs(pd.concat([here, taken], ignore_index=True), **AS_GIVEN)
    assert dict(zip(found["model"], found["basis"], strict=True)) == {"2d": "cfd", "3d": "time"}


@pytest.mark.parametrize(
    ("turns", "mechanism", "said"),
    [
        ({"twist_turns": 0}, "divergence", "divergence between 20 and 40 m/s"),
        ({"twist_turns": 2}, "unknown", "an instability of unknown mechanism between 20 and 40"),
        ({"twist_turns": math.nan}, "unknown", "an instability of unknown mechanism between 20"),
        ({}, "unknown", "an instability of unknown mechanism between 20"),
    ],
)
def test_growth_without_an_oscillation_is_divergence_if_it_never_turned(
    turns: dict[str, float], mechanism: str, said: str
) -> None:
    """A deck that swung by 8 and then by 17 deg before a period was counted flutters."""
    summary = runs(
        ("2d", 2.0, "growing"), ("2d", 8.0, "settled"), frequency_strouhal=math.nan, **turns
    )
    found = from_runs(summary, **AS_GIVEN)
    assert found.loc[0, "mechanism"] == mechanism
    assert math.isnan(found.loc[0, "frequency_hz"])
    assert said in in_words(with_margin([found], None))[0]


def test_heave_that_grows_alone_is_galloping() -> None:
    """Its twist has no frequency, or one that only follows."""
    for frequency in (math.nan, 0.02):
        summary = runs(
            ("2d", 2.0, "growing"),
            ("2d", 8.0, "settled"),
            frequency_strouhal=frequency,
            heave_grows=1,
        )
        (row,) = from_runs(summary, **AS_GIVEN).to_dict("records")
        assert row["mechanism"] == "galloping"


@pytest.mark.parametrize(
    ("regimes", "mechanism", "said"),
    [
        (("settled", "settled"), "none", "stable up to 40 m/s; no onset was found"),
        (("growing", "growing"), "flutter", "unstable at 20 m/s and at all lower speeds"),
        (("failed", "failed"), "unknown", "nothing is known"),
        (("failed", "settled"), "unknown", "stable up to 20 m/s; what is beyond failed"),
        (("undecided", "decaying"), "unknown", "stable up to 20 m/s; what is beyond failed"),
        (("undecided", "undecided"), "unknown", "nothing is known"),
    ],
)
def test_open_brackets_say_what_is_known(
    regimes: tuple[str, str], mechanism: str, said: str
) -> None:
    summary = runs(("3d", 2.0, regimes[0]), ("3d", 8.0, regimes[1]))
    found = with_margin([from_runs(summary, **AS_GIVEN)], None)
    assert math.isnan(found.loc[0, "speed"])
    assert said in in_words(found)[0]
    assert found.loc[0, "mechanism"] == mechanism


@pytest.mark.parametrize(("beyond", "mechanism"), [(0.01, "flutter"), (math.nan, "unknown")])
def test_release_of_a_model_that_leaves_at_once_tells_no_mechanism(
    beyond: float, mechanism: str
) -> None:
    """Next to the onset at k* 7 its growth is infinite, which a file holds as not known."""
    values = {"growth_rate": [0.02, beyond, -0.01], "frequency_strouhal": [0.14, 0.15, 0.16]}
    data = xr.Dataset(
        {"k_star": ("speed", [5.0, 6.0, 8.0])} | {k: ("speed", v) for k, v in values.items()},
        {"speed": [3.0, 2.0, 1.0]},
        {"model": "2d", "incidence_deg": 2.5, "onset_k_star": 7.0}
        | {f"onset_k_star_{end}": math.nan for end in ("low", "high")},
    )
    table = from_learnt([data], given=AS_GIVEN["given"], chord=0.1)
    assert table.loc[0, "mechanism"] == mechanism


@pytest.mark.parametrize(
    ("low", "high", "said"),
    [
        (18.0, 22.0, "flutter between 18 and 22 m/s"),
        (18.0, math.nan, "flutter at 20 m/s, or from 18 m/s on: its interval has no upper end"),
        (math.nan, 22.0, "flutter at 20 m/s, or up to 22 m/s: its interval has no lower end"),
        (math.nan, math.nan, "flutter at 20 m/s, without an interval"),
    ],
)
def test_interval_of_a_model_may_be_open(low: float, high: float, said: str) -> None:
    row = dict.fromkeys(COLUMNS, math.nan) | {"model": "2d", "mechanism": "flutter"}
    row |= {"basis": "model", "speed": 20.0, "speed_low": low, "speed_high": high}
    assert in_words(pd.DataFrame([row]))[0].endswith(said)


def test_margin_is_that_of_the_highest_stable_speed() -> None:
    summary = runs(("2d", 2.0, "growing"), ("2d", 8.0, "settled"))
    found = with_margin([from_runs(summary, **AS_GIVEN)], 16.0)
    assert tuple(found.columns) == COLUMNS
    assert found.loc[0, "margin"] == pytest.approx(20.0 / 16.0)


def test_eigenvalues_are_those_of_the_public_function() -> None:
    """Of Goland's wing section, whose flutter in attached flow is near 134 m/s."""
    section = Section(
        chord=1.8288,
        mass=35.717,
        inertia=8.642,
        static_imbalance=0.1 * 1.8288 * 35.717,
        flexural_stiffness=35.717 * 49.4923**2,
        torsional_stiffness=8.642 * 87.1081**2,
        elastic_axis=0.33,
        twist_recovery=1.0,
        deflection_recovery=1.0,
    )
    polar, lags = Polar.flat_plate(math.radians(20)), SeparationLags.none()
    table = from_eigenvalues(
        {"2d": section}, polar, lags, incidence_deg=[0.5, 1.0], speed=(50.0, 200.0), density=1.225
    )
    known = critical_speed(
        section, polar, incidence_deg=[0.5, 1.0], speed=(50.0, 200.0), density=1.225, lags=lags
    )
    assert table["speed"].tolist() == pytest.approx(known["critical_speed"].values.tolist())
    assert table["speed"].tolist() == pytest.approx([133.0, 133.0], rel=0.01)
    assert set(table["mechanism"]) == {"flutter"}
    assert set(table["basis"]) == {"eigenvalue"}
    assert table["energy_share"].tolist() == pytest.approx(known["coupling_share"].values.tolist())
    assert table["energy_share"].min() > 0.5


def test_no_models_make_an_empty_table() -> None:
    assert tuple(with_margin([], 10.0).columns) == COLUMNS
