"""Map of stability of a run: its models, its tables, its releases and its figures."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.figure import Figure
from tests.conftest import ROOT

import equisection as eq
from equisection.aerodynamics.polar import Polar
from equisection.analysis.coarser_bodies import coarser_bodies
from equisection.analysis.critical_speeds import COLUMNS, from_map, with_margin
from equisection.analysis.loads_in_use import reactions
from equisection.analysis.mapped_models import (
    MappedModel,
    map_dataset,
    mapped_models,
    speeds_of_map,
    stability_table,
)
from equisection.analysis.onset_intervals import sensitivity_table, with_intervals
from equisection.analysis.releases_of_map import (
    ASIDE,
    SMALL_DEG,
    MapRelease,
    checked_in_time,
    in_use,
    released,
)
from equisection.config import Config, load_config
from equisection.config.groups import Beam, Flow, Structure
from equisection.errors import ConfigError
from equisection.figures import catalogue
from equisection.figures.style import drawing_style
from equisection.motion.critical import critical_of
from equisection.motion.map_dataset import maps_of_models
from equisection.motion.stability import critical_speed
from equisection.motion.stability_map import map_lines
from equisection.motion.steady_states import least_stable
from equisection.reduction.correction import CorrectionFactors
from equisection.results.correction_dataset import factors_to_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_dataset import nominal_k_star, section_from_dataset
from equisection.solvers.registry import solver_from_config
from equisection.study.axes import INCIDENCE, SPEED, AsGiven, sweep_points, varied

LoadScript = Callable[[str], ModuleType]
POLAR = ROOT / "config" / "polars" / "plate_2d_11136.csv"
RAW: dict[str, Any] = {
    "structure": {
        "method": "beam",
        "elements": {"chord": 4, "span": 15, "thickness": 1},
        "bending_modes": 1,
        "torsion_modes": 1,
    },
    "flow": {"design_speed": 22.0},
    "embedded": {"polars": {"coarse": str(POLAR)}, "strips": 4},
    "sweep": {
        "speed": [15.0, 25.0, 35.0],
        "incidence_deg": [5.0, 2.5],
        "models": ["2d", "2d-corrected", "3d"],
    },
    "unsteady": {"duration": 150.0},
}
#: The finite beam in these tests: its loads are a part of those of the section.
PART = 0.8


@pytest.fixture(scope="module")
def config() -> Config:
    return load_config(RAW)


@pytest.fixture(scope="module")
def data(
    load_script: LoadScript, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, xr.Dataset]:
    """Modes, section and correction of the plate, its beam with a part of the section's loads."""
    folder = tmp_path_factory.mktemp("structure")
    load_script("modes").main(
        Beam(), Structure(**RAW["structure"]), folder / "modes.nc", folder / "mesh_study.nc"
    )
    load_script("equivalent_section").main(
        Beam(), Flow(), folder / "modes.nc", folder / "equivalent.nc"
    )
    polar = Polar.read(POLAR)
    beam = Polar(polar.incidence, polar.drag, PART * polar.lift, PART * polar.moment, "part")
    return {
        **{name: read_dataset(folder / f"{name}.nc") for name in ("modes", "equivalent")},
        "correction": factors_to_dataset(CorrectionFactors(polar, beam)),
    }


@pytest.fixture(scope="module")
def models(config: Config, data: dict[str, xr.Dataset]) -> list[MappedModel]:
    return mapped_models(config, data, solver_from_config(config, "coarse"))


@pytest.fixture(scope="module")
def table(models: list[MappedModel]) -> pd.DataFrame:
    return stability_table(models, 22.0)


def test_incidences_are_an_axis_of_the_sweep(config: Config) -> None:
    assert varied(config) == {INCIDENCE: (2.5, 5.0), SPEED: (15.0, 25.0, 35.0)}
    names = [point.name for point in sweep_points(config)]
    assert names[0] == "a2.5_v15"
    assert len(names) == 6


def test_a_run_without_incidences_has_no_map() -> None:
    names = {entry.name for entry in catalogue.figures(load_config({}))}
    assert not names & {entry.name for entry in catalogue.CATALOGUE if entry.job() == MAP}


def test_figures_of_one_incidence_are_left_out_of_a_run_over_several() -> None:
    """Their lines over k* or speed would join incidences."""
    of_one = {"response", "hysteresis", "growth-rate", "section-and-beam"}
    over = {
        count: {entry.name for entry in catalogue.figures(load_config(raw))}
        for count, raw in (
            (0, {}),
            (1, {"sweep": {"incidence_deg": [2.5]}}),
            (2, {"sweep": {"incidence_deg": [2.5, 5]}}),
        )
    }
    assert of_one <= over[0]
    assert of_one <= over[1]
    assert not of_one & over[2]


MAP = "figures_of_map"


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (
            {"sweep": {"incidence_deg": [2.5, 2.5]}},
            "sweep.incidence_deg.1: 2.5: allowed is each incidence once",
        ),
        (
            {"sweep": {"incidence_deg": [0, 2.5]}},
            "sweep.incidence_deg.0: 0: allowed is 0 with unsteady.start.twist_deg",
        ),
        ({"sweep": {"incidence_deg": [95]}}, "sweep.incidence_deg.0"),
    ],
)
def test_incidences_that_make_no_sense_are_refused(raw: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigError, match=words):
        load_config(raw)


def test_zero_incidence_is_allowed_with_a_start() -> None:
    raw = {"sweep": {"incidence_deg": [0, 2.5]}, "unsteady": {"start": {"twist_deg": 0.1}}}
    assert load_config(raw).sweep.incidence_deg == (0.0, 2.5)


def test_section_of_a_run_has_the_onset_of_the_section(
    config: Config, data: dict[str, xr.Dataset], table: pd.DataFrame
) -> None:
    section = section_from_dataset(data["equivalent"], "consistent")
    found = critical_speed(
        section,
        Polar.read(POLAR),
        incidence_deg=[2.5, 5.0],
        speed=(10.0, 60.0),
        density=config.flow.density,
    )
    rows = table[table["model"] == "2d"]
    np.testing.assert_allclose(rows["speed"], found["critical_speed"], rtol=1e-5)
    np.testing.assert_allclose(rows["margin"], found["critical_speed"] / 22.0, rtol=1e-5)


@pytest.mark.filterwarnings("ignore:structure.method 'beam' leaves out:UserWarning")
def test_beam_of_a_run_is_that_of_python(config: Config, table: pd.DataFrame) -> None:
    structure, channel = config.structure, config.flow.channel
    assert channel is not None
    found = eq.stability_map(
        config.beam,
        Polar.read(POLAR),
        incidence_deg=[2.5, 5.0],
        speed=config.sweep.speed,
        density=config.flow.density,
        method="beam",
        elements=(1, structure.elements.span, 1),
        modes=(structure.bending_modes, structure.torsion_modes),
        strips=config.embedded.strips,
        channel=(channel.height_chords, channel.tip_gap_chords),
    )
    rows = table[table["model"] == "3d"]
    known = rows["speed"] <= config.sweep.speed[-1]
    assert known.any()
    for one, other in (("speed", "critical_speed"), ("k_star", "critical_k_star")):
        np.testing.assert_allclose(rows[one][known], found[other][known.to_numpy()], rtol=2e-6)


def test_k_star_of_a_run_is_that_of_the_beam_as_given(
    config: Config, data: dict[str, xr.Dataset], table: pd.DataFrame
) -> None:
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    np.testing.assert_allclose(table["k_star"], given.k_star_at(table["speed"]), rtol=1e-6)


def test_corrected_section_twists_by_the_loads_of_the_beam(models: list[MappedModel]) -> None:
    """k* theta = C_M(theta_0 + theta), and w by C_L: those are a part of the section's here."""
    plain, corrected = (
        next(model.lines[0] for model in models if model.name == name)
        for name in ("2d", "2d-corrected")
    )
    speed = np.array([20.0])
    _, states, _ = corrected.path.system(speed)
    polar = Polar.read(POLAR)
    alpha = corrected.incidence_rad + float(states[0, 0])
    k_star = float(plain.body.structure.torsion_stiffness[0, 0] * (plain.body.speed / 20.0) ** 2)
    assert k_star * states[0, 0] == pytest.approx(PART * float(polar.moment_cubic(alpha)), rel=1e-9)
    k_w = float(plain.body.structure.bending_stiffness[0, 0] * (plain.body.speed / 20.0) ** 2)
    assert k_w * states[0, 2] == pytest.approx(
        PART * float(polar.lift_coefficient(alpha)), rel=1e-9
    )


def test_map_is_over_model_incidence_and_speed_and_is_read_again(
    config: Config, data: dict[str, xr.Dataset], models: list[MappedModel], tmp_path: Path
) -> None:
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    write_dataset(tmp_path / "map.nc", map_dataset(models, speeds_of_map(config, given)))
    read = read_dataset(tmp_path / "map.nc")
    assert dict(read["growth_rate"].sizes) == {"model": 3, "incidence_deg": 2, "speed": 3}
    assert list(read["model"].values) == ["2d", "2d-corrected", "3d"]
    assert set(read["mode"].values) == {"bending 1", "torsion 1"}
    assert float(read["equilibrium_twist"].sel(model="2d", incidence_deg=2.5, speed=15.0)) > 0.0


def test_a_model_that_is_refused_is_named_and_the_others_go_on(models: list[MappedModel]) -> None:
    both = [MappedModel("2d-paper", (), "no section stands for it"), models[0]]
    found = stability_table(both, None)
    assert found["note"][0] == "no section stands for it"
    assert found["mechanism"][0] == "unknown"
    assert np.isfinite(found["speed"][1:]).all()
    assert len(from_map(found)) == 2


def test_speeds_of_the_map_go_into_the_table_of_critical_speeds(table: pd.DataFrame) -> None:
    critical = with_margin([from_map(table)], 22.0)
    assert tuple(critical.columns) == COLUMNS
    assert set(critical["basis"]) == {"eigenvalue"}
    np.testing.assert_allclose(critical["margin"], critical["speed_low"] / 22.0)


def test_coarser_beam_tells_how_well_the_strips_are_known(
    config: Config, data: dict[str, xr.Dataset], models: list[MappedModel], table: pd.DataFrame
) -> None:
    """With half of the strips the onset is that of a map of its own; a last mode stays."""
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    coarser = coarser_bodies(models, config, data, given)
    assert set(coarser) == {"3d"}
    assert [(one.parameter, one.number, one.less) for one in coarser["3d"]] == [("strips", 4, 2)]
    beam = [model for model in models if model.name == "3d"]
    found = sensitivity_table(beam, config, solver_from_config(config, "coarse"), coarser)
    rows = found[found["parameter"] == "strips"]
    body = coarser["3d"][0].body
    lines = map_lines(body, [line.incidence_rad for line in beam[0].lines], np.array([15.0, 80.0]))
    own = [critical_of(line).critical_speed for line in lines]
    np.testing.assert_allclose(rows["speed_at_less"], own, rtol=1e-5)
    speed = table[table["model"] == "3d"]["speed"].to_numpy()
    np.testing.assert_allclose(rows["speed_at_more"], 2.0 * speed - own, rtol=1e-5)
    assert (rows["lowers"] > 0.0).all()


def test_last_modes_of_each_kind_are_left_out(
    config: Config, data: dict[str, xr.Dataset], models: list[MappedModel]
) -> None:
    structure = config.structure.model_copy(update={"bending_modes": 3, "torsion_modes": 2})
    more = config.model_copy(update={"structure": structure})
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    found = coarser_bodies(models, more, data, given)["3d"]
    modes = next(one for one in found if one.parameter == "modes")
    assert (modes.number, modes.less) == (5, 2)
    assert modes.body.structure.bending_shapes.shape[1] == 2
    assert modes.body.structure.torsion_shapes.shape[1] == 1


def test_small_releases_agree_with_the_eigenvalues(
    config: Config, models: list[MappedModel]
) -> None:
    checked = checked_in_time(stability_table(models[:1], None), models[:1], config)
    assert set(checked["below_small"]) <= {"settled", "decaying"}
    assert set(checked["above_small"]) == {"growing"}
    assert checked["in_time"].str.len().gt(0).all()


@pytest.mark.parametrize("name", ["2d", "3d"])
def test_growth_of_a_small_release_is_that_of_the_eigenvalue(
    config: Config, models: list[MappedModel], name: str
) -> None:
    """Fitted to pitch and heaves together, and with its error, 5 % below the onset."""
    line = next(one for one in models if one.name == name).lines[-1]
    assert line.onset is not None
    speed = (1.0 - ASIDE) * line.onset.speed
    (verdict,) = released([MapRelease(line, speed, SMALL_DEG)], config)
    system, states, deficits = line.path.system(np.array([speed]))
    exact = least_stable(system, states, deficits)[0].real
    assert exact < 0.0
    assert verdict["growth_rate"] == pytest.approx(exact, abs=5e-4)
    assert 0.0 < verdict["growth_standard_error"] < 1e-3


def test_design_speed_has_the_loads_of_statics(config: Config, models: list[MappedModel]) -> None:
    """Of a section, uniform along a cantilever, the moment is c_l q c L^2/2."""
    use = in_use(models[:1], config)
    row = use[use["incidence_deg"] == 2.5].iloc[0]
    polar, q, beam = Polar.read(POLAR), 0.5 * config.flow.density * 22.0**2, config.beam
    recovery = models[0].lines[0].body.twist_of_tip[0]
    alpha = math.radians(2.5 + row["tip_twist_deg"] / recovery)
    lift = float(polar.lift_coefficient(alpha))
    assert row["root_bending_moment_nm"] == pytest.approx(
        0.5 * lift * q * beam.chord * beam.length**2, rel=1e-6
    )
    assert row["root_torque_nm"] == pytest.approx(
        float(polar.moment_coefficient(alpha)) * q * beam.chord**2 * beam.length, rel=1e-6
    )
    assert row["regime"] == "settled"
    assert row["damping_ratio"] > 0.0
    root = reactions(models[:1], config).query("incidence_deg == 2.5").iloc[0]
    assert (root["support"], root["place_m"]) == ("root", 0.0)
    assert root["force_n"] == pytest.approx(lift * q * beam.chord * beam.length, rel=1e-6)
    assert root["bending_moment_nm"] == row["root_bending_moment_nm"]
    assert root["torque_nm"] == row["root_torque_nm"]


def test_reactions_of_every_boundary_carry_the_load_of_the_air(
    config: Config, models: list[MappedModel]
) -> None:
    """The same loads on other supports: their sums stay, and each support is named."""
    supports = [{"at": 0.5, "deflection": "fixed"}]
    other = Beam(boundary="one-fork", supports=supports)
    propped = config.model_copy(update={"beam": other})
    for held, names in ((config, ["root"]), (propped, ["root", "supports.0", "tip"])):
        found = reactions(models, held)
        assert list(found["support"].unique()) == names
        sums = found.groupby(["model", "incidence_deg"])[["force_n", "torque_nm"]].sum()
        if held is config:
            expected = sums
    np.testing.assert_allclose(sums, expected, rtol=1e-9)
    assert set(found["model"]) == {"2d", "2d-corrected", "3d"}


def test_incidences_that_a_polar_does_not_cover_are_named_in_every_table(
    config: Config, data: dict[str, xr.Dataset]
) -> None:
    """Beyond the polar, and where the equilibrium leaves it: the other incidence goes on."""
    sweep = config.sweep.model_copy(update={"incidence_deg": (2.5, 11.9, 20.0), "models": ("2d",)})
    asked = config.model_copy(update={"sweep": sweep})
    solver = solver_from_config(asked, "coarse")
    models = mapped_models(asked, data, solver)
    found = stability_table(models, 22.0)
    found = with_intervals(found, sensitivity_table(models, asked, solver))
    said, use = (table.set_index("incidence_deg") for table in (found, in_use(models, asked)))
    assert np.isfinite(said.loc[2.5, "speed_from"])
    for angle, words in ((11.9, "the equilibrium leaves the polar"), (20.0, "20 deg is outside")):
        row = said.loc[angle]
        assert row["mechanism"] == "unknown"
        assert math.isnan(row["speed"])
        assert row["interval_of"] == ""
        assert words in row["note"]
        assert words in use.loc[angle, "note"]
    assert set(reactions(models, asked)["incidence_deg"]) == {2.5}
    drawn = map_dataset(models, np.asarray(sweep.values()))
    assert list(drawn["incidence_deg"].values) == [2.5, 11.9, 20.0]


def test_design_speed_above_the_map_is_said(config: Config, models: list[MappedModel]) -> None:
    """The body has an equilibrium there, which nobody has looked at."""
    highest = models[0].lines[0].highest
    assert models[0].lines[0].path.end_speed > 1.001 * highest
    for speed, note in ((1.001 * highest, f"above {highest:.4g} m/s"), (highest, "")):
        flow = config.flow.model_copy(update={"design_speed": speed})
        row = in_use(models[:1], config.model_copy(update={"flow": flow})).iloc[0]
        assert row["note"].startswith(note)
        assert math.isnan(row["tip_twist_deg"]) == bool(note)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "entry", [one for one in catalogue.CATALOGUE if one.job() == MAP], ids=lambda one: one.name
)
@pytest.mark.parametrize("design_speed", [22.0, None])
def test_figures_of_a_map_are_drawn(  # noqa: PLR0917 - fixtures
    entry: catalogue.Entry,
    design_speed: float | None,
    config: Config,
    data: dict[str, xr.Dataset],
    models: list[MappedModel],
    table: pd.DataFrame,
    tmp_path: Path,
) -> None:
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    path = tmp_path / "map.nc"
    write_dataset(path, map_dataset(models, speeds_of_map(config, given)))
    with_interval = table.assign(
        speed_from=[20.0, np.nan, 0.0, 30.0, 25.0, 21.0], speed_to=[30, np.nan, 40, np.inf, 60, 50]
    )
    with_interval.to_csv(tmp_path / "stability.csv")
    files = {"stability_map": path, "stability": tmp_path / "stability.csv"}
    values = {"incidence_deg": 2.5, "design_speed": design_speed}
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        figure = catalogue.draw(entry, files, values)
        assert isinstance(figure, Figure)
        figure.draw_without_rendering()
    if entry.name != "critical-speed":
        return
    said = {text.get_text() for text in figure.legends[0].get_texts()}
    assert {"interval", "open above"} <= said
    assert ("interval below the design speed" in said) == (design_speed is not None)
    assert [bool(axes.collections) for axes in figure.axes] == [True, True, True]
    bars = figure.axes[0].collections[1].get_segments()  # of 2.5 deg; of 5 nothing is known
    assert [bar[:, 1].tolist() for bar in bars] == [[20.0, 30.0]]


def test_modes_of_maps_that_are_joined_stay_in_order() -> None:
    """A section has two modes and a beam many, the tenth of which comes after the second."""
    many = [f"bending {place}" for place in range(1, 13)] + ["torsion 1", "torsion 2"]

    def mapped(modes: list[str]) -> xr.Dataset:
        return xr.Dataset({"growth": ("mode", np.arange(len(modes)))}, {"mode": modes})

    found = maps_of_models({"2d": mapped(["bending 1", "torsion 1"]), "3d": mapped(many)})
    assert list(found["mode"].values) == many
    assert found["growth"].sel(model="2d", mode="torsion 1") == 1
    assert found["growth"].sel(model="3d").values.tolist() == list(range(14))
    assert maps_of_models({"2d": mapped([]), "3d": mapped([])}).sizes["mode"] == 0
