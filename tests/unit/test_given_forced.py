"""Solver 'given': forced motions in another program's layout have the derivatives of their run."""

from __future__ import annotations

import importlib.util
import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd
import pytest
import yaml
from tests.conftest import ROOT

from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.forced_derivatives import derivatives_of
from equisection.cases import ForcedCase, read_cases
from equisection.config import load_config
from equisection.errors import ConfigError, ResultFileError
from equisection.results.forced_result import ForcedResult
from equisection.solvers.registry import solver_from_case, solver_from_config
from equisection.store.index import write_index
from equisection.store.job import run_cases
from equisection.study.forced_cases import forced_case
from equisection.validation.outline_values import derivatives_of_moved_plate

RUN: dict[str, Any] = yaml.safe_load((ROOT / "docs/examples/other_program_forced.yaml").read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The files of the example."""
    spec = importlib.util.spec_from_file_location(
        "other_program_forced", ROOT / "docs/examples/other_program_forced.py"
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    place = tmp_path_factory.mktemp("forced")
    module.main(place)
    return place


def changed(folder: Path, forced: dict[str, Any] | None = None, **given: Any) -> dict[str, Any]:
    """Return the configuration of the example with some keys changed."""
    of_files = {**RUN["given"], "forced": f"{folder}/{{case}}.dat", **given}
    return {**RUN, "given": of_files, "forced": {**RUN["forced"], **(forced or {})}}


def result_of(raw: dict[str, Any], name: str) -> tuple[ForcedCase, ForcedResult]:
    config = load_config(raw)
    case = forced_case(config, name, solver_from_config(config, config.steady.resolution))
    solver: Any = solver_from_case(case.solver)
    (result,) = solver.run_forced([case], Path(), lambda done, total: None)
    return case, result


def table_of(raw: dict[str, Any]) -> Derivatives:
    found = {}
    for name in ("pitch", "heave"):
        case, result = result_of(raw, name)
        assert result.failure == ""
        found[name] = case, result.of_case(case)
    return derivatives_of(found).derivatives


def test_derivatives_are_those_of_the_solver_that_wrote_the_files(folder: Path) -> None:
    """Units, signs, span and both axes go back; the pitch is about another point than mid-chord."""
    table, kept = table_of(changed(folder)), derivatives_of_moved_plate()
    assert table.reduced_velocity == pytest.approx(kept.reduced_velocity)
    assert np.abs(table.loads / kept.loads - 1.0).max() < 1e-4
    assert table.label == f"forced motion, {RUN['given']['source']}"
    _, pitch = result_of(changed(folder), "pitch")
    assert np.abs(pitch.deflection).max() < 1e-9  # of mid-chord


def test_a_pitch_about_another_point_has_the_same_derivatives(folder: Path) -> None:
    """A pitch about mid-chord and a heave, added up, are a pitch about x/c = 0.4: X is inverted."""
    results = {}
    for name in ("pitch", "heave"):
        case, result = result_of(changed(folder), name)
        results[name] = case, result.of_case(case)
    (of_pitch, pitch), (_, heave) = results["pitch"], results["heave"]
    both = pitch.copy()
    for load in ("twist", "deflection", "cl", "cm"):
        both[load] = pitch[load] + 0.4 * heave[load].to_numpy()
    kept = derivatives_of(results).derivatives
    mixed = derivatives_of({**results, "pitch": (of_pitch, both)}).derivatives
    assert mixed.values == pytest.approx(kept.values, rel=1e-6, abs=1e-9)
    with pytest.raises(ResultFileError, match="are the same motion"):
        derivatives_of({**results, "pitch": (of_pitch, heave)})


UNITS = RUN["given"]["units"]


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        ("pitch", {"units": {**UNITS, "twist": "rad"}}, "degrees taken for radians): units.twist"),
        ("heave", {"units": {**UNITS, "deflection": "m"}}, "units.deflection"),
        ("pitch", {"signs": {"deflection": -1}}, "signs.twist: -1 explains it"),
        ("heave", {"signs": {"twist": -1}}, "signs.deflection: -1 explains it"),
        ("pitch", {"moment_axis": 0.5}, "moment_axis: 0.26"),
        ("heave", {"span": 10.0}, "lift and moment some "),
        ("heave", {"units": {**UNITS, "time": "s"}}, "forced.reduced_velocity"),
        ("pitch", {"units": {**UNITS, "time": "c/V"}}, "allowed is 0.25 c/V, 12 samples"),
        ("pitch", {"forced": "{folder}/heave.dat"}, "given.columns.twist or given.forced"),
        ("pitch", {"columns": {**RUN["given"]["columns"], "lift": "L"}}, "no column for lift"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_wrong_mapping_is_refused_by_name(
    folder: Path, name: str, change: dict[str, Any], words: str
) -> None:
    if "forced" in change:
        raw = changed(folder)
        raw["given"]["forced"] = change["forced"].format(folder=folder)
    else:
        raw = changed(folder, **change)
    _, result = result_of(raw, name)
    assert words in result.failure
    assert result.time.size == 0


@pytest.mark.parametrize(
    ("forced", "words"),
    [
        ({"amplitude_deg": 0.25}, "forced.amplitude_deg: 0.5 is that of the record"),
        ({"reduced_velocity": [1.5, 2.25, 3.5, 6]}, r"a time 0\.5 times as long.*units.time"),
        ({"reduced_velocity": [2.2, 3, 4.5, 7, 12]}, r"no pitch at V/\(f c\) = 2\.2"),
        ({"periods": 8}, r"ends at 1244 ms \(68 c/V\) after its begin; allowed is 2121 ms or more"),
    ],
    ids=str,
)
def test_another_motion_than_the_record_is_refused(
    folder: Path, forced: dict[str, Any], words: str
) -> None:
    _, result = result_of(changed(folder, forced), "pitch")
    assert re.search(words, result.failure), result.failure


def test_a_twist_from_the_stream_is_refused(folder: Path, tmp_path: Path) -> None:
    rows = pd.read_csv(folder / "pitch.dat", sep=" ", skiprows=1, names=RUN["given"]["columns"])
    rows["twist"] -= 2.0  # nose down
    text = f"# {' '.join(RUN['given']['columns'].values())}\n"
    (tmp_path / "pitch.dat").write_text(text + rows.to_csv(sep=" ", index=False, header=False))
    _, result = result_of(changed(tmp_path), "pitch")
    assert "the mean twist is 1.99 deg; wanted is 0" in result.failure


def test_a_wrong_deflection_axis_moves_the_loads_of_the_pitch_alone(folder: Path) -> None:
    """The documentation says by how much: nothing in a record tells about which point it turned."""
    table, kept = table_of(changed(folder, deflection_axis=0.5)), derivatives_of_moved_plate()
    heave, pitch = np.abs(table.loads / kept.loads - 1.0).max(axis=(0, 1))
    assert heave < 1e-4
    assert pitch == pytest.approx(0.40, abs=0.005)


def test_path_of_a_harmonic_names_component_and_reduced_velocity(folder: Path) -> None:
    raw = changed(folder, {"motion": "harmonic"})
    raw["given"]["forced"] = "x/{component}-{reduced_velocity}-{incidence_deg}.csv"
    config = load_config(raw)
    case = forced_case(config, "heave_v4.5", solver_from_config(config, "thin"))
    assert case.solver.settings["file"] == "x/heave-4.5-0.csv"
    assert case.solver.settings["moment_axis"] == 0.25
    raw["given"]["moment_axis"] = None  # then it is the elastic axis
    config = load_config(raw)
    case = forced_case(config, "heave_v4.5", solver_from_config(config, "thin"))
    assert case.solver.settings["moment_axis"] == 0.33


def test_scripts_leave_the_table_and_name_a_missing_file(
    folder: Path, tmp_path: Path, load_script: Callable[[str], ModuleType]
) -> None:
    case_file, index = tmp_path / "forced.json", tmp_path / "forced" / "forced.json"
    load_script("forced_cases").main(changed(folder), ["pitch", "heave"], case_file)
    attributes = run_cases(
        read_cases(case_file), index.parent, tmp_path / "store", tmp_path / "progress.json"
    )
    write_index(index, attributes)
    table = tmp_path / "2d.csv"
    load_script("forced_derivatives").main([case_file], index, table, tmp_path / "2d-fit.csv")
    kept = derivatives_of_moved_plate()
    assert np.abs(Derivatives.read(table).loads / kept.loads - 1.0).max() < 1e-4

    elsewhere = tmp_path / "none"
    load_script("forced_cases").main(changed(elsewhere), ["pitch", "heave"], case_file)
    load_script("run_cases").main(case_file, index, tmp_path / "store", tmp_path / "progress.json")
    with pytest.raises(ResultFileError, match=r"pitch: no file .*pitch\.dat, which given\.forced"):
        load_script("forced_derivatives").main([case_file], index, table, tmp_path / "2d-fit.csv")


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        ({"given": {**RUN["given"], "forced": "{model}.csv"}}, r"given\.forced: .*\{component\}"),
        ({"forced": {**RUN["forced"], "beam_modes": 1}}, r"forced\.beam_modes: 1: allowed .* is 0"),
    ],
    ids=str,
)
def test_keys_that_do_not_fit_are_refused(raw: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigError, match=words):
        load_config({**RUN, **raw})
