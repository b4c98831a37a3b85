"""``equisection export``: each kind reads back as what the run has."""

from __future__ import annotations

import io
import json
import math
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from tests.conftest import ROOT

from equisection.aerodynamics.polar import Polar
from equisection.analysis import exported
from equisection.beam.section import QUANTITIES, Section
from equisection.io.polar_columns import COLUMNS
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.run.command_line import EXPORTS, main
from equisection.structure.mode_set import ModeSet

SECTION = Section(
    torsional_stiffness=40.0,
    flexural_stiffness=900.0,
    inertia=0.2,
    mass=3.0,
    chord=0.8,
    twist_recovery=0.6,
    deflection_recovery=0.4,
)
ANGLES = np.array([-2.0, 0.0, 2.0, 4.0, 6.0])
LIFT, MOMENT, DRAG = 0.1 * ANGLES, 0.02 * ANGLES, 0.01 + 0.0 * ANGLES
CONFIGURATION: dict[str, Any] = {
    "run": "made-up",
    "beam": {"chord": 0.8},
    "flow": {
        "incidence_deg": 2.5,
        "speed": 10.0,
        "density": 1.2,
        "dynamic_viscosity": 1.8e-5,
        "sound_speed": 340.0,
    },
    "steady": {"resolution": "fine"},
    "unsteady": {
        "duration": 400.0,
        "time_step": 0.05,
        "start": {"state": "rigid", "twist_deg": 1.0, "heave_rate": 0.02},
    },
}


def says(name: str) -> dict[str, str]:
    return {"units": "1", "long_name": name, "missing_allowed": "1"}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with modes, a section of one reduction, a polar with a failed point, derivatives."""
    folder = tmp_path_factory.mktemp("exported") / "made-up"
    folder.mkdir()
    (folder / "config.resolved.yaml").write_text(yaml.safe_dump(CONFIGURATION))
    modes = ModeSet(
        frequency=np.array([2.0, 7.5]),
        kind=("bending", "torsion"),
        span=np.array([0.0, 0.5, 1.0]),
        shape=np.array([[0.0, 0.3, 1.0], [0.0, 0.7, 1.0]]),
        method="beam",
        elements="3",
    )
    write_dataset(folder / "structure" / "modes.nc", modes_to_dataset(modes, [0.16, float("nan")]))
    members = {
        name: ("reduction", [getattr(SECTION, name), np.nan], says(quantity.meaning))
        for name, quantity in QUANTITIES.items()
    }
    coordinate = ("reduction", ["consistent", "paper"], says("reduction"))
    attributes = {"no_section_consistent": "", "no_section_paper": "it has none"}
    equivalent = xr.Dataset(members, {"reduction": coordinate}, attributes)
    write_dataset(folder / "structure" / "equivalent.nc", equivalent)
    polar = xr.Dataset(
        {
            name: (("resolution", "incidence_deg"), [[*values, np.nan]], says(name))
            for name, values in zip(COLUMNS[1:], (LIFT, MOMENT, DRAG), strict=True)
        },
        {
            "resolution": ("resolution", ["fine"], says("resolution")),
            "incidence_deg": ("incidence_deg", [*ANGLES, 8.0], says("incidence")),
        },
        {"solver_fine": "a made-up solver"},
    )
    write_dataset(folder / "steady" / "polar_2d.nc", polar)
    (folder / "derivatives").mkdir()
    shutil.copy(ROOT / "config/derivatives/thin_plate.csv", folder / "derivatives" / "2d.csv")
    return folder


def test_every_kind_is_offered_by_the_command() -> None:
    assert tuple(exported.KINDS) == EXPORTS


def test_everything_is_written_and_reads_back(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(run), "--to", str(tmp_path)]) == 0
    to = tmp_path / "made-up"
    assert capsys.readouterr().out.split() == [
        str(to / name)
        for name in (
            *("polar_2d_fine.dat", "derivatives_2d.csv", "derivatives_2d.json"),
            *("modes.csv", "mode_shapes.csv", "modes.json", "section.csv", "section.json"),
            *("ua_airfoil.dat", "ua_consistent.dvr"),
        )
    ]
    polar = Polar.read(to / "polar_2d_fine.dat", symmetric=False)
    np.testing.assert_allclose(np.degrees(polar.incidence), ANGLES)
    np.testing.assert_allclose(polar.lift, LIFT, atol=1e-5)
    np.testing.assert_allclose(polar.moment, MOMENT, atol=2e-5)
    assert polar.reynolds_number == pytest.approx(1.2 * 10.0 * 0.8 / 1.8e-5, rel=1e-5)
    shapes = pd.read_csv(to / "mode_shapes.csv")
    modes = json.loads((to / "modes.json").read_text())
    for number, mode in enumerate(modes["modes"], start=1):
        np.testing.assert_allclose(shapes[f"mode_{number}"], mode["shape"])
    assert [mode["frequency_hz"] for mode in modes["modes"]] == [2.0, 7.5]
    assert modes["modes"][1]["frequency_constant"] is None
    sections = json.loads((to / "section.json").read_text())["reductions"]
    assert Section(**sections["consistent"]) == SECTION
    assert list(sections) == ["consistent"], "a reduction without a section is left out"
    table = pd.read_csv(to / "section.csv").set_index("quantity")
    assert table.loc["torsional_stiffness", ["unit", "consistent"]].tolist() == [
        "N m rad-1 m-1",
        40.0,
    ]
    derivatives = json.loads((to / "derivatives_2d.json").read_text())
    kept = pd.read_csv(run / "derivatives" / "2d.csv", comment="#")
    pd.testing.assert_frame_equal(pd.DataFrame(derivatives["columns"]), kept)
    assert "convention: Scanlan" in derivatives["convention"]


def test_half_polar_of_a_symmetric_section_gets_its_other_half(run: Path, tmp_path: Path) -> None:
    """OpenFAST looks for the attached flow on both sides of zero lift."""
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    half = read_dataset(copy / "steady" / "polar_2d.nc")
    angles = half["incidence_deg"]
    half = half.assign_coords(incidence_deg=angles.copy(data=angles.values + 2.0))
    half["cl"][0], half["cm"][0] = [0.0, 0.3, 0.5, 0.6, 0.65, np.nan], 0.0
    write_dataset(copy / "steady" / "polar_2d.nc", half)
    assert main(["export", str(copy), "--only", "openfast"]) == 0
    table = copy / "export" / "ua_airfoil.dat"
    assert "! Negative angles by symmetry." in table.read_text()
    whole = Polar.read(table, symmetric=False)
    np.testing.assert_allclose(np.degrees(whole.incidence), [-8, -6, -4, -2, 0, 2, 4, 6, 8])
    np.testing.assert_allclose(whole.lift, -whole.lift[::-1])


def test_polar_of_too_few_incidences_says_so(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    few = read_dataset(copy / "steady" / "polar_2d.nc").isel(incidence_deg=slice(3))
    write_dataset(copy / "steady" / "polar_2d.nc", few)
    assert main(["export", str(copy), "--only", "polars", "--only", "openfast"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 2
    assert all(
        line.startswith("left out") and "3 incidences with a result" in line for line in said
    )


def test_file_of_an_earlier_export_in_the_place_of_one_that_is_left_out_is_named(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    assert main(["export", str(copy), "--only", "polars"]) == 0
    before = Path(capsys.readouterr().out.strip())
    few = read_dataset(copy / "steady" / "polar_2d.nc").isel(incidence_deg=slice(3))
    write_dataset(copy / "steady" / "polar_2d.nc", few)
    assert main(["export", str(copy), "--only", "polars"]) == 0
    said = capsys.readouterr().out
    assert said.startswith(f"left out        {before}: ")
    assert said.rstrip().endswith("; the file that is there is of an earlier export")
    assert before.is_file()


def test_start_of_the_driver_is_that_of_the_section(run: Path, tmp_path: Path) -> None:
    """The configuration's start is of the tip; times are convective, c/V = 0.08 s."""
    assert main(["export", str(run), "--to", str(tmp_path), "--only", "openfast"]) == 0
    text = (tmp_path / "made-up" / "ua_consistent.dvr").read_text()
    values = {
        words[place]: words[:place]
        for words in (line.replace(",", " ").split() for line in text.splitlines())
        for place in (1, 3)
        if words[place : place + 1]
    }
    assert float(values["InitPos"][2]) == pytest.approx(-np.radians(1.0) * 0.6)
    assert float(values["InitVel"][0]) == pytest.approx(0.02 * 10.0 * 0.4)
    assert float(values["TMax"][0]) == pytest.approx(400.0 * 0.08)
    assert float(values["DT"][0]) == pytest.approx(0.05 * 0.08)


def test_start_from_equilibrium_has_the_springs_carry_the_loads(run: Path, tmp_path: Path) -> None:
    """Without the push K q is lift and moment of the polar, here about the elastic axis."""
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    start = {"state": "equilibrium", "twist_deg": 1.0, "heave_rate": 0.0}
    unsteady = {**CONFIGURATION["unsteady"], "start": start}
    flow = {**CONFIGURATION["flow"], "speed": 5.0}  # at 10 m/s it has none
    changed = {**CONFIGURATION, "flow": flow, "unsteady": unsteady}
    (copy / "config.resolved.yaml").write_text(yaml.safe_dump(changed))
    assert main(["export", str(copy), "--only", "openfast"]) == 0
    text = (copy / "export" / "ua_consistent.dvr").read_text()
    line = next(one for one in text.splitlines() if " InitPos " in one)
    deflection, _, nose_down = map(float, line.replace(",", " ").split()[:3])
    twist = -nose_down - np.radians(1.0) * SECTION.twist_recovery
    alpha = 2.5 + np.degrees(twist)
    pressure = 0.5 * 1.2 * 5.0**2 * SECTION.chord
    assert SECTION.flexural_stiffness * deflection == pytest.approx(pressure * 0.1 * alpha)
    moment = pressure * SECTION.chord * 0.02 * alpha
    assert SECTION.torsional_stiffness * twist == pytest.approx(moment)


def test_runs_of_one_name_are_not_written_over_each_other(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "elsewhere" / run.name
    shutil.copytree(run, other)
    to = tmp_path / "to"
    assert main(["export", str(run), str(other), "--to", str(to)]) == 1
    assert "two of the runs have one name" in capsys.readouterr().err
    assert not to.exists()
    assert main(["export", str(other), str(other), "--to", str(to)]) == 0


def test_for_machines(run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wanted = ["--only", "section", "--only", "modes", "--only", "modes", "--json"]
    assert main(["export", str(run), "--to", str(tmp_path), *wanted]) == 0
    files = json.load(io.StringIO(capsys.readouterr().out))
    assert [file["kind"] for file in files] == [*["section"] * 2, *["modes"] * 3]
    assert all(Path(file["path"]).is_file() and not file["left_out"] for file in files)


def test_a_model_without_coefficients_says_why(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    refused = xr.Dataset(attrs={"model": "2d", "refusal": "its release is too short"})
    write_dataset(copy / "rom" / "2d" / "model_a4.nc", refused)
    assert main(["export", str(copy), "--only", "models"]) == 0
    said = capsys.readouterr().out
    assert f"left out        {copy / 'export' / 'model_2d_a4.json'}: 2d: no model: its" in said


def test_a_model_of_a_beam_has_its_prediction_without_a_polar_of_the_section(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    (copy / "steady" / "polar_2d.nc").unlink()
    learnt = xr.Dataset(
        {
            "rate": ("fit", [0.2], says("rate")),
            "moment_terms": (("fit", "term"), np.zeros((1, 5)), says("terms")),
            "growth_rate": ("k_star", [0.1, -0.1], says("growth")),
        },
        {"k_star": ("k_star", [3.0, 4.0], says("k*"))},
        {"model": "3d", "words": "learnt", "confirmation": "none", "axis": "k_star"},
    )
    write_dataset(copy / "rom" / "3d" / "model.nc", learnt)
    assert main(["export", str(copy), "--only", "models"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert "model_3d.json: 3d: a model of the strips of a beam" in said[0]
    assert said[1] == str(copy / "export" / "model_3d.csv")
    growth = pd.read_csv(said[1], comment="#")
    assert growth["growth_rate"].tolist() == [0.1, -0.1]


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", ": no table"),
        (b'a,b\n1,2,3,4\n5\n"', ", line 1: the first column is 'a'"),
        (b"\x81", ": cannot be read"),
    ],
    ids=repr,
)
def test_a_broken_table_is_named(
    run: Path, content: bytes, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    (copy / "derivatives" / "2d.csv").write_bytes(content)
    assert main(["export", str(copy), "--only", "derivatives"]) == 1
    assert f"{copy / 'derivatives' / '2d.csv'}{why}" in capsys.readouterr().err


def test_a_configuration_without_a_key_that_is_needed_is_named(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    flow = {name: value for name, value in CONFIGURATION["flow"].items() if name != "sound_speed"}
    (copy / "config.resolved.yaml").write_text(yaml.safe_dump({**CONFIGURATION, "flow": flow}))
    assert main(["export", str(copy), "--only", "openfast"]) == 1
    assert "config.resolved.yaml: no key flow.sound_speed" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("value", "what"),
    [
        ("fast", "'fast' is no number"),
        (None, "null is no number"),
        ([9.5], "[9.5] is no number"),
        (math.nan, ".nan is no number"),
        (0.0, "0 is not above 0"),
    ],
    ids=repr,
)
def test_a_configuration_with_a_word_for_a_number_is_named(
    run: Path, value: Any, what: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "run"
    shutil.copytree(run, copy)
    flow = {**CONFIGURATION["flow"], "sound_speed": value}
    (copy / "config.resolved.yaml").write_text(yaml.safe_dump({**CONFIGURATION, "flow": flow}))
    assert main(["export", str(copy), "--only", "openfast"]) == 1
    assert f"config.resolved.yaml: flow.sound_speed: {what}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["none"], "none: no folder of a run, which has a config.resolved.yaml"),
        (["made-up", "--only", "models"], "nothing to export yet of models; 'equisection status"),
        (["made-up", "--to", "made-up/config.resolved.yaml"], "cannot be written to"),
    ],
)
def test_what_cannot_be_exported_says_what_to_do(
    run: Path,
    words: list[str],
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(run.parent)
    assert main(["export", *words]) == 1
    assert said in capsys.readouterr().err
