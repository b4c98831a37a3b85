"""Solver 'given': kept OpenFOAM releases in another program's layout have the kept verdicts."""

from __future__ import annotations

import importlib.util
import logging
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
import yaml
from tests.conftest import ROOT

import equisection as eq
from equisection.cases import EndCriteria, SolverBlock, UnsteadyCase, write_cases
from equisection.config import Config, load_config
from equisection.errors import ArgumentError, ConfigError
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.protocol import HAS_VORTICES, HasRecords, Solver
from equisection.solvers.registry import (
    check_provided,
    missing_records,
    solver_from_case,
    solver_from_config,
)
from equisection.solvers.verdicts import Judge, TipMotion, decided_at, judge
from equisection.store.index import read_index, read_missing

RUN: dict[str, Any] = yaml.safe_load((ROOT / "docs/examples/other_program.yaml").read_text())
KEPT = ROOT / "results/reference/paper-plate-openfoam/unsteady"
RELEASES = sorted(KEPT.glob("2d*/*.nc"))


def config_of(**given: Any) -> Config:
    """Return the configuration of the example with some keys of ``given`` changed."""
    return load_config({**RUN, "given": {**RUN["given"], **given}})


@pytest.fixture(scope="module")
def example() -> ModuleType:
    """The script that writes the histories."""
    path = ROOT / "docs/examples/other_program.py"
    spec = importlib.util.spec_from_file_location("other_program", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def folder(example: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The histories of the example."""
    place = tmp_path_factory.mktemp("other-program")
    example.main(place)
    return place


def kept_case(release: Path) -> UnsteadyCase:
    """Return the case of a kept release, to be judged by today's rules."""
    case = UnsteadyCase.model_validate_json(read_dataset(release).attrs["case"])
    rules = EndCriteria.model_fields["rules"].default
    return case.model_copy(update={"criteria": case.criteria.model_copy(update={"rules": rules})})


def given_case(release: Path, config: Config) -> UnsteadyCase:
    """Return the same case with its history from a file."""
    solver = solver_from_config(config, "coarse")
    assert isinstance(solver, HasRecords)
    case = kept_case(release)
    settings = solver.record_of(release.parent.name, release.stem, {"k_star": case.k_star})
    block = SolverBlock(name="given", version="1", settings=settings)
    return case.model_copy(update={"solver": block})


def result_of(case: UnsteadyCase, work: Path) -> UnsteadyResult:
    solver: Solver = solver_from_case(case.solver)
    (result,) = solver.run_unsteady([case], work, lambda done, total: None)
    return result


def in_folder(folder: Path, **given: Any) -> Config:
    return config_of(histories=f"{folder}/{{model}}/{{case}}.csv", **given)


@pytest.mark.parametrize(
    "release",
    [path for path in RELEASES if path.stem != "k4"],
    ids=lambda path: f"{path.parent.name}-{path.stem}",
)
def test_verdict_and_history_are_those_of_the_kept_release(release: Path, folder: Path) -> None:
    kept, case = read_dataset(release), kept_case(release)
    tip = TipMotion(
        kept["time"].values, kept["tip_twist"].values, kept["tip_deflection"].values / 0.1
    )
    wanted = judge(case, tip.until(min(decided_at(case, tip), case.duration)))
    found = result_of(given_case(release, in_folder(folder)), folder)
    assert found.verdict["regime"] == wanted["regime"] != "failed"
    names = ["growth_rate", "frequency_strouhal", "twist_amplitude_deg"]
    if found.verdict["mean_known"] == wanted["mean_known"]:  # at k* 21 1e-12 of the twist decides
        names.append("mean_twist_deg")
    for name in names:
        assert found.verdict[name] == pytest.approx(wanted[name], rel=1e-5, abs=1e-8), name
    until = slice(0, found.time.size)
    assert found.time == pytest.approx(kept["time"].values[until], abs=1e-6)
    assert found.lift == pytest.approx(kept["cl"].values[until], abs=1e-6)
    assert found.moment == pytest.approx(kept["cm"].values[until], abs=1e-6)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"units": {**RUN["given"]["units"], "twist": "rad"}}, "units.twist"),
        ({"signs": {}}, "signs.twist: -1"),
        ({"moment_axis": 0.5}, "moment_axis: 0.25"),
        ({"span": 1.0}, "a lift 10 and a moment 10 times as large"),
        ({"units": {**RUN["given"]["units"], "time": "c/V"}}, "unit of the time"),
        ({"columns": {**RUN["given"]["columns"], "lift": "Lift"}}, r"no column for lift"),
    ],
    ids=str,
)
def test_a_wrong_mapping_fails_by_name(folder: Path, given: dict[str, Any], words: str) -> None:
    result = result_of(given_case(KEPT / "2d/k6.44.nc", in_folder(folder, **given)), folder)
    assert result.verdict["regime"] == "failed"
    assert words in str(result.verdict["reason"])


def test_a_short_record_is_judged_as_far_as_it_goes_and_says_so(
    folder: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    lines = (folder / "2d/k6.44.csv").read_text().splitlines()
    (tmp_path / "2d").mkdir()
    for count, regime in ((1 + 1200, "growing"), (1 + 250, "failed")):
        (tmp_path / "2d/k6.44.csv").write_text("\n".join(lines[:count]) + "\n")
        with caplog.at_level(logging.WARNING):
            found = result_of(given_case(KEPT / "2d/k6.44.nc", in_folder(tmp_path)), tmp_path)
        assert found.verdict["regime"] == regime
    assert "ends at 119.9 of 200 c/V and is judged as far as it goes" in caplog.text
    assert "ends at 24.9 c/V without a verdict" in str(found.verdict["reason"])


def test_a_case_changes_with_its_file(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "2d").mkdir()
    copy = tmp_path / "2d/k5.csv"
    digests = []
    for text in ("2d/k5.csv", "2d/k5.5.csv"):
        copy.write_bytes((folder / text).read_bytes())
        case = given_case(KEPT / "2d/k5.nc", in_folder(tmp_path))
        digests.append(case.solver.settings["digest"])
    assert digests[0] != digests[1]
    found = result_of(case, tmp_path)  # the history of another k* is that of another beam
    assert found.verdict["regime"] == "failed"


def test_histories_of_a_computation_in_time_have_no_vortices_to_beat_with(folder: Path) -> None:
    release = KEPT / "2d/k6.44.nc"
    cases = {
        basis: given_case(release, in_folder(folder, basis=basis))
        for basis in ("cfd", "experiment", "time")
    }
    assert {basis: Judge.of(case).has_vortices for basis, case in cases.items()} == {
        "cfd": True,
        "experiment": True,
        "time": False,
    }
    # releases that were judged before keep their settings
    assert HAS_VORTICES not in cases["cfd"].solver.settings


def test_a_folder_in_the_place_of_a_record_is_named(tmp_path: Path) -> None:
    (tmp_path / "2d/k5.csv").mkdir(parents=True)
    case = given_case(KEPT / "2d/k5.nc", in_folder(tmp_path))
    assert missing_records({"k5": case}) == {
        "k5": f"a file that cannot be read is {tmp_path}/2d/k5.csv, which given.histories names "
        "for it"
    }


def test_missing_records_are_named_and_the_others_go_on(
    folder: Path, tmp_path: Path, load_script: Any
) -> None:
    cases = {name: given_case(KEPT / f"2d/{name}.nc", in_folder(folder)) for name in ("k4", "k5")}
    asked, index = tmp_path / "cases.json", tmp_path / "unsteady/2d/sweep.json"
    write_cases(asked, cases)
    index.parent.mkdir(parents=True)
    (index.parent / "k4.nc").write_text("of an earlier run")
    load_script("run_cases").main(asked, index, tmp_path / "store", tmp_path / "progress.json")
    assert list(read_index(index)) == ["k5"]
    assert f"no file {folder}/2d/k4.csv" in read_missing(index)["k4"]
    assert not (index.parent / "k4.nc").exists()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"given": {**RUN["given"], "histories": ""}}, r"given\.histories: '': allowed"),
        ({"given": {**RUN["given"], "histories": "{run}.csv"}}, r"given\.histories"),
        (
            {"given": {**RUN["given"], "histories": "{model}.csv"}},
            r"given\.histories: '\{model\}\.csv': .* \{k_star\} in it",
        ),
        (
            {
                "given": {**RUN["given"], "histories": "{k_star}.csv"},
                "sweep": {**RUN["sweep"], "models": ["2d", "2d-paper"], "incidence_deg": [1, 3]},
            },
            r"allowed is a path with \{model\}, \{incidence_deg\} in it",
        ),
        ({"given": {**RUN["given"], "polars": {}}}, r"steady\.resolution: 'coarse'"),
        ({"given": {**RUN["given"], "signs": {"twist": 0}}}, r"given\.signs\.twist: 0"),
        ({"sweep": {**RUN["sweep"], "onset": "refine"}}, r"sweep\.onset: 'refine'.* no file has"),
        ({"forced": {"run": True}}, r"given\.forced: ''.* derivatives\.table"),
    ],
    ids=str,
)
def test_keys_that_do_not_fit_are_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigError, match=words):
        load_config({**RUN, **changes})


def test_beams_are_refused() -> None:
    config = load_config({**RUN, "sweep": {**RUN["sweep"], "models": ["3d"]}})
    with pytest.raises(ConfigError, match="solver 'given' are models of dimension 2d"):
        check_provided(config)


def test_a_history_is_read_in_python(folder: Path) -> None:
    """The same file, section and numbers by the public door."""
    release = KEPT / "2d/k6.44.nc"
    case, keys = kept_case(release), RUN["given"]
    assert case.section is not None
    flowing = case.section
    pressure, chord = 0.5 * 1.18 * 20.0**2, 0.1
    section = eq.Section(
        torsional_stiffness=flowing.torsional_stiffness * pressure * chord**2,
        flexural_stiffness=flowing.flexural_stiffness * pressure,
        inertia=flowing.inertia * 0.5 * 1.18 * chord**4,
        mass=flowing.mass * 0.5 * 1.18 * chord**2,
        chord=chord,
    )
    read = {
        "speed": 20.0,
        "density": 1.18,
        "columns": keys["columns"],
        "incidence_deg": 2.5,
        "span": 0.1,
        "moment_axis": 0.25,
        "release": 2.0,
    }
    path = folder / "2d/k6.44.csv"
    found = eq.read_history(path, section, units=keys["units"], signs={"twist": -1}, **read)
    assert found.attrs["is_explained"] == 1
    assert found["cm"].values == pytest.approx(read_dataset(release)["cm"].values, abs=1e-6)
    wrong = eq.read_history(path, section, units=keys["units"], **read)
    assert wrong.attrs["is_explained"] == 0
    assert "signs.twist: -1" in wrong.attrs["balance"]
    with pytest.raises(ArgumentError, match="lift is in 'kN'"):
        eq.read_history(path, section, units={"lift": "kN"}, **read)
