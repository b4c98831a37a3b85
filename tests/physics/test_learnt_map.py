"""Map of stability of a learnt model: modes, mechanisms and onsets of a model that is known."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from tests.conftest import ROOT

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.polar import Polar
from equisection.analysis.learnt_course import Course
from equisection.analysis.learnt_dataset import dataset_of
from equisection.analysis.learnt_file import as_table, export, model_of, model_of_json
from equisection.analysis.learnt_lines import LearntLine
from equisection.analysis.learnt_map import map_of_learnt, stability_of_learnt
from equisection.analysis.reduced_model import (
    PredictedOnset,
    ReducedModel,
    predicted,
    predicted_onset,
)
from equisection.beam.section import Section
from equisection.errors import ArgumentError, ResultFileError
from equisection.motion.learnt_motion import LearntSections
from equisection.motion.static_branch import StaticBranch
from equisection.results.netcdf import write_dataset
from equisection.study.axes import SPEED, AsGiven

PLATE = Polar.read(ROOT / "config" / "polars" / "plate_2d_11136.csv").continued
ANGLES = np.linspace(-0.4, 0.4, 41)
#: Loads without a bend, so that a release goes as small motions do.
POLAR = Polar(ANGLES, 0.0 * ANGLES, 7.0 * ANGLES, 1.7 * ANGLES, "straight")
GIVEN = AsGiven(k_star=6.44, speed=30.0)
SECTION = Section(
    torsional_stiffness=6.84, flexural_stiffness=1.557, inertia=6.667, mass=80.0, twist_recovery=0.5
)
CHORD = 0.1
SPEEDS = np.linspace(20.0, 40.0, 9)


def known(incidence_deg: float = 2.5, **changes: Any) -> LearntLoads:
    given = {
        "polar": POLAR,
        "incidence_rad": math.radians(incidence_deg),
        "rate": 0.35,
        "moment": np.array([-0.3, 0.0, 0.3, 0.0, 0.0, 1.0, 0.0, 1.0]),
        "lift": np.array([1.0, 0.0, -2.0, 0.0, 0.0, -1.0, 0.0, 1.0]),
        "residual_moment": 0.01,
        "residual_lift": 0.02,
        "seen": (-0.2, 0.2),
        "learnt_until": 45.0,
    }
    return LearntLoads(**{**given, **changes})


def model(loads: LearntLoads) -> ReducedModel:
    refits = [replace(loads, moment=factor * loads.moment) for factor in (0.98, 1.03)]
    return ReducedModel(loads, tuple(refits), "2d/a2.5_v30", 6.44, "a known model")


def sections_at(speeds: Any) -> list[Section]:
    return [SECTION.scaled(float(GIVEN.k_star_at(speed)) / GIVEN.k_star) for speed in speeds]


class KnownSections:
    """Stand-in of lessons: a study over the speed, of the section above."""

    name, axis, polar = "2d", SPEED, POLAR
    config = SimpleNamespace(beam=SimpleNamespace(chord=CHORD))

    def cases_at(self, values: Any) -> list[SimpleNamespace]:
        return [SimpleNamespace(section=one, diverges=False) for one in sections_at(values)]


def file_of(loads: LearntLoads, onset: PredictedOnset | None = None) -> xr.Dataset:
    learnt = model(loads)
    speeds = np.linspace(19.0, 43.0, 9)
    table = predicted(learnt, GIVEN.k_star_at(speeds), sections_at(speeds))
    table.insert(0, "speed", speeds)
    table = table.sort_values("k_star", ignore_index=True)
    found = predicted_onset(table) if onset is None else onset
    return dataset_of(Course(learnt, table, found, 2, contradicted=False, at_odds=""), "2d", SPEED)


@pytest.fixture(scope="module")
def line() -> LearntLine:
    return LearntLine(KnownSections(), file_of(known()), GIVEN, SPEEDS)


@pytest.fixture(scope="module")
def table(line: LearntLine) -> pd.DataFrame:
    return stability_of_learnt([line], chord=CHORD, design_speed=20.0)


def test_loads_of_small_motions_are_those_of_the_eigenvalues() -> None:
    """det(p^2 M + p C + K - Q(p)) vanishes at each p, with an axis off mid-chord, dampers too."""
    off = SECTION.model_copy(
        update={
            "elastic_axis": 0.4,
            "static_imbalance": 1.5,
            "torsional_damping": 0.2,
            "flexural_damping": 0.5,
        }
    )
    moved = LearntSections([off], known())
    twist = moved.equilibria()[0]
    values = moved.eigenvalues()[0]
    with_air = np.linalg.inv(moved._inverse[0])
    for p in values[np.abs(values.imag) > 0.0]:
        loads = moved.influence(twist)(np.array([p]))[0]
        left = p**2 * with_air + p * off.damping_matrix + off.stiffness_matrix - loads
        assert abs(np.linalg.det(left)) < 1e-9 * np.prod(
            np.abs(np.diag(left)) + np.abs(loads).max()
        )


def test_equilibrium_is_on_the_branch_from_rest_and_ends_at_its_fold() -> None:
    """Where k* is the slope of the moment the branch ends: no other branch is taken for it."""
    rigid = math.radians(0.5)
    fold = StaticBranch.from_rest(PLATE, rigid).k_star_end
    stiffnesses = [0.99 * fold, 1.5 * fold]
    sections = [SECTION.model_copy(update={"torsional_stiffness": k}) for k in stiffnesses]
    twist = LearntSections(sections, known(0.5, polar=PLATE)).equilibria()[0]
    assert math.isnan(twist[0])
    carried = stiffnesses[1] * twist[1]
    assert carried == pytest.approx(float(PLATE.moment_cubic(rigid + twist[1])), rel=1e-9)


def test_growth_of_the_map_is_that_of_the_eigenvalues(line: LearntLine) -> None:
    growth = np.nanmax(LearntSections(sections_at(SPEEDS), known()).eigenvalues().real, axis=1)
    there = np.isin(line.modes.spectrum.speed, SPEEDS)
    np.testing.assert_allclose(line.modes.spectrum.least_stable.real[there], growth, atol=1e-10)
    assert line.modes.names == ("bending 1", "torsion 1")


def test_small_motions_neither_grow_nor_decay_at_their_onset(line: LearntLine) -> None:
    speed, low, high = line.small
    assert low < speed < high
    values = LearntSections(sections_at([speed]), known()).eigenvalues()[0]
    assert abs(values.real.max()) < 2e-5


def test_mechanism_is_that_of_the_work_of_the_air(line: LearntLine) -> None:
    """Air that drives the twist alone, against attached flow that damps it: stall flutter."""
    spectrum = line.spectrum(np.array([0.9, 1.1]) * line.small[0])
    p, told = spectrum.least_stable, line.mechanisms(spectrum)
    assert p.real[0] < 0.0 < p.real[1]
    assert told.mechanism[0] == "none"
    driven = known(moment=np.array([3.0, *np.zeros(7)]), lift=np.zeros(8))
    of_driven = LearntLine(KnownSections(), file_of(driven), GIVEN, SPEEDS)
    told = of_driven.mechanisms(of_driven.spectrum(np.array([30.0])))
    assert told.mechanism[0] == "stall-flutter"
    assert told.twist_share[0] > 0.5  # more than heave and coupling together


def test_table_has_the_onset_of_the_releases_and_that_of_small_motions(
    line: LearntLine, table: pd.DataFrame
) -> None:
    row = table.iloc[0]
    onset = float(line.data.attrs["onset_k_star"])
    assert row["speed"] == pytest.approx(float(GIVEN.speed_at(onset)))
    assert row["speed_low"] < row["speed"] < row["speed_high"]
    assert row["speed_small"] == pytest.approx(line.small[0])
    assert row["basis"] == "model"
    assert row["learnt"] == "model learnt from a known model at k* = 6.44, incidence 2.5 deg"
    assert row["in_time"] == "not contradicted by 2 runs"
    assert row["margin"] == pytest.approx(row["speed_low"] / 20.0)
    # of the tip: the section turns by half of it
    (section,) = sections_at([row["speed"]])
    twist = LearntSections([section], known()).equilibria()[0, 0]
    assert row["twist_deg"] == pytest.approx(math.degrees(twist) / 0.5)


def test_incidence_without_a_model_says_why_and_the_others_go_on(
    line: LearntLine, table: pd.DataFrame, tmp_path: Path
) -> None:
    unknown = dict.fromkeys((f"onset_k_star{end}" for end in ("", "_low", "_high")), math.nan)
    refused = xr.Dataset(
        attrs={
            "model": "2d",
            "incidence_deg": 5.0,
            "words": "no model: too short",
            "refusal": "too short",
            "confirmation": "",
            "reservations": "",
            **unknown,
        }
    )
    lines = [line, LearntLine(KnownSections(), refused, GIVEN, SPEEDS)]
    both = stability_of_learnt(lines, chord=CHORD, design_speed=None)
    assert both["note"].tolist() == [table["note"].iloc[0], "too short"]
    assert both["mechanism"].tolist()[1] == "unknown"
    found = map_of_learnt(lines, both, chord=CHORD)
    write_dataset(tmp_path / "map.nc", found)  # every variable has units
    assert found.attrs["basis"] == "model"
    growth = found["growth_rate"].sel(model="2d")
    assert np.isnan(growth.sel(incidence_deg=5.0)).all()
    rate = growth.sel(incidence_deg=2.5).values
    assert (np.sign(rate) == np.sign(SPEEDS - line.small[0])).all()
    released = found["release_growth_rate"].sel(model="2d", incidence_deg=2.5).values
    assert (np.sign(released) == np.sign(SPEEDS - table["speed"].iloc[0])).all()


def test_refit_without_an_equilibrium_is_unstable_and_the_others_still_count(
    line: LearntLine, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The slope of a refit of a beam may end its branch at a lower speed than the model's."""
    small, low, high = line.small
    below = LearntLine.spectrum

    def ends(at: float) -> tuple[float, float, float]:
        def spectrum(of: LearntLine, speeds: Any, fit: int = 0) -> Any:
            found = below(of, speeds, fit)
            if fit == 1:
                found.values[speeds > at] = np.nan
            return found

        monkeypatch.setattr(LearntLine, "spectrum", spectrum)
        return LearntLine(line.lessons, line.data, line.given, line.speeds).small

    early = 0.5 * (SPEEDS[0] + low)
    assert ends(early)[0] == small
    assert 0.95 * early < ends(early)[1] <= early
    assert ends(0.5 * (small + high))[:2] == (small, low)


def test_small_release_at_zero_incidence_goes_as_the_eigenvalue() -> None:
    """A symmetric section moves from a start alone, and then as small motions do."""
    loads, speeds = known(0.0), np.array([28.0, 38.0])
    sections = sections_at(speeds)
    alone = replace(model(loads), refits=())
    still = LearntSections(sections, loads).released(10.0)
    assert not still.twist.any()
    start = (math.radians(0.1), 0.0)
    found = predicted(alone, GIVEN.k_star_at(speeds), sections, start=start)
    growth = LearntSections(sections, loads).eigenvalues()
    pitch = growth.real[np.arange(2), growth.imag.argmax(axis=1)]
    np.testing.assert_allclose(found["growth_rate"], pitch, atol=3e-4)


def test_model_comes_back_from_its_file_and_from_json(line: LearntLine, tmp_path: Path) -> None:
    data = line.data
    export(data, POLAR, tmp_path / "model.json")
    content = json.loads((tmp_path / "model.json").read_text())
    expected = LearntSections(sections_at(SPEEDS), known()).eigenvalues()
    for found in (model_of(data, POLAR), model_of_json(content)):
        assert (found.words, len(found.refits)) == (model(known()).words, 2)
        values = LearntSections(sections_at(SPEEDS), found.loads).eigenvalues()
        np.testing.assert_allclose(values, expected, rtol=1e-9)
    assert len(content["terms"]) == len(content["fits"][0]["moment"]) == 8
    assert content["onset_k_star"]["low"] < content["onset_k_star"]["value"]
    export(data, POLAR, tmp_path / "growth.csv")
    written = pd.read_csv(tmp_path / "growth.csv", comment="#")
    np.testing.assert_allclose(written["growth_rate"], as_table(data)["growth_rate"], rtol=1e-5)
    assert "model learnt from" in (tmp_path / "growth.csv").read_text().splitlines()[0]
    with pytest.raises(ArgumentError, match=r"\.json or \.csv"):
        export(data, POLAR, tmp_path / "model.txt")
    strips = data.isel(term=slice(5)).assign_attrs(model="3d")
    with pytest.raises(ResultFileError, match="3d: a model of the strips of a beam, of 5 terms"):
        export(strips, POLAR, tmp_path / "model.json")


class DivergingSections(KnownSections):
    """The same, of which none has an equilibrium from 25 m/s on."""

    def cases_at(self, values: Any) -> list[SimpleNamespace]:
        speeds = list(values)
        gone = SimpleNamespace(section=None, diverges=True)
        cases = zip(super().cases_at(speeds), speeds, strict=True)
        return [gone if speed >= 25.0 else case for case, speed in cases]


def test_onset_beyond_which_there_is_no_equilibrium_is_divergence() -> None:
    """Growth is infinite there, which the file does not know."""
    data = file_of(known(), PredictedOnset(float(GIVEN.k_star_at(24.5)), math.nan, math.nan))
    data["growth_rate"] = data["growth_rate"].where(data["speed"] < 25.0)
    lost = LearntLine(DivergingSections(), data, GIVEN, SPEEDS)
    (row,) = stability_of_learnt([lost], chord=CHORD, design_speed=None).to_dict("records")
    assert (row["mechanism"], row["speed"]) == ("divergence", pytest.approx(24.5))
    unknown = LearntLine(KnownSections(), data, GIVEN, SPEEDS[:3])
    (row,) = stability_of_learnt([unknown], chord=CHORD, design_speed=None).to_dict("records")
    assert row["mechanism"] == "unknown"
