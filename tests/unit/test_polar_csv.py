"""The command `equisection polar`: a polar file from steady results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT

from equisection.aerodynamics.polar_file import read_polar
from equisection.command_line import main
from equisection.errors import ResultFileError
from equisection.results.modes import modes_to_dataset
from equisection.results.netcdf import write_dataset
from equisection.results.polar_csv import polar_csv
from equisection.results.steady import SteadyResult
from equisection.structure.mode_set import ModeSet

NOTHING = np.empty(0)


def result(
    folder: Path, incidence_deg: float, name: str = "", failure: str = "", mesh: str = "coarse"
) -> Path:
    """Write a steady result with a lift of a tenth of the incidence (deg)."""
    value = np.nan if failure else incidence_deg / 10
    made = SteadyResult(0.04, value, value / 8, NOTHING, NOTHING, NOTHING, "steady, 7", failure)
    path = folder / f"{name or f'coarse_a{incidence_deg:g}'}.nc"
    dataset = made.to_dataset().assign_attrs(
        incidence_deg=incidence_deg, solver_description=f"made up ({mesh})"
    )
    write_dataset(path, dataset)
    return path


@pytest.mark.parametrize(
    ("name", "results", "angles"),
    [
        ("plate_2d_11136", "paper-plate-openfoam/steady/2d", (0, 1, 2, 2.5, *range(3, 11), 12)),
        ("plate_3d_85284", "paper-plate-openfoam-3d/steady/3d", (0, 1, 2.5, 4)),
    ],
)
def test_polar_that_is_shipped_is_that_of_the_results_that_are_kept(
    name: str, results: str, angles: tuple[float, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    kept = [ROOT / "results/reference" / results / f"coarse_a{angle:g}.nc" for angle in angles]
    assert main(["polar", *map(str, kept)]) == 0
    written = (ROOT / f"config/polars/{name}.csv").read_text(encoding="utf-8")
    assert capsys.readouterr().out == written


def test_polar_is_read_back_in_order_without_what_failed(tmp_path: Path) -> None:
    angles = (10.0, 0.0, 2.5, 5.0)
    paths = [result(tmp_path, angle) for angle in angles]
    text = polar_csv([*paths, result(tmp_path, 12.0, failure="the flow blew up")])
    assert "# Left out: 12 deg, the flow blew up" in text
    file = tmp_path / "polar.csv"
    file.write_text(text, encoding="utf-8")
    polar = read_polar(file, symmetric=False)
    assert np.degrees(polar.incidence) == pytest.approx([0, 2.5, 5, 10])
    assert polar.lift == pytest.approx([0, 0.25, 0.5, 1.0])
    assert polar.moment == pytest.approx(polar.lift / 8)


def test_results_that_make_no_polar_are_refused_by_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one = result(tmp_path, 1.0)
    fine = result(tmp_path, 2.0, "fine_a2", mesh="fine")
    again = result(tmp_path, 1.0, "again")
    unsteady = ROOT / "results/reference/paper-plate-openfoam/unsteady/2d/k5.nc"
    for other, words in (
        (fine, r"fine_a2\.nc.*made up \(fine\).*one mesh"),
        (again, "of the same incidence"),
        (unsteady, r"k5\.nc: no result of a steady case"),
        (tmp_path / "none.nc", r"none\.nc: missing"),
    ):
        with pytest.raises(ResultFileError, match=words):
            polar_csv([one, other])
    assert main(["polar", str(one), str(fine)]) == 1
    assert capsys.readouterr().err.startswith("error: ")


def modes_file(folder: Path, kinds: tuple[str, ...] = ("bending", "torsion")) -> Path:
    span = np.linspace(0.0, 1.0, 21)
    shapes = {"bending": span**2, "torsion": span}
    modes = ModeSet(
        frequency=np.arange(1.0, len(kinds) + 1),
        kind=kinds,
        span=span,
        shape=np.array([shapes[kind] for kind in kinds]),
        method="made up",
        elements="none",
    )
    write_dataset(folder / "modes.nc", modes_to_dataset(modes, [1.0] * len(kinds)))
    return folder / "modes.nc"


def beam_result(folder: Path, incidence_deg: float) -> Path:
    """Write a steady result of a beam whose lift and moment fall linearly to nothing at the tip."""
    middles = (np.arange(200) + 0.5) / 200
    load = incidence_deg / 10 * 2 * (1 - middles)
    whole = SteadyResult(0.04, load.mean(), load.mean() / 8, middles, load, load / 8, "steady, 7")
    path = folder / f"coarse_a{incidence_deg:g}.nc"
    made = {"incidence_deg": incidence_deg, "solver_description": "made up (coarse)"}
    write_dataset(path, whole.to_dataset().assign_attrs(made))
    return path


def test_loads_of_a_beam_are_those_that_its_modes_feel(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of 2 (1 - z): a half under z^2, two thirds under z."""
    results = [str(beam_result(tmp_path, angle)) for angle in (0.0, 2.0, 4.0, 6.0)]
    assert main(["polar", "--modes", str(modes_file(tmp_path)), *results]) == 0
    file = tmp_path / "polar.csv"
    file.write_text(capsys.readouterr().out, encoding="utf-8")
    polar = read_polar(file, symmetric=False)
    assert polar.lift == pytest.approx(np.array([0.0, 0.2, 0.4, 0.6]) / 2, abs=1e-4)
    assert polar.moment == pytest.approx(np.array([0.0, 0.2, 0.4, 0.6]) / 8 * 2 / 3, abs=1e-4)
    assert polar.drag == pytest.approx(0.04)


def test_beam_that_failed_at_an_incidence_is_left_out_with_modes_too(tmp_path: Path) -> None:
    results = [beam_result(tmp_path, 2.0), result(tmp_path, 4.0, failure="the flow blew up")]
    text = polar_csv(results, modes_file(tmp_path))
    assert "# Left out: 4 deg, the flow blew up" in text
    assert text.splitlines()[-1].startswith("2,0.1")


def test_section_has_no_loads_that_modes_could_feel(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["polar", "--modes", str(modes_file(tmp_path)), str(result(tmp_path, 2.0))]) == 1
    assert "no loads along the span" in capsys.readouterr().err


def test_modes_without_torsion_are_refused(tmp_path: Path) -> None:
    modes = modes_file(tmp_path, kinds=("bending",))
    with pytest.raises(ResultFileError, match=r"modes\.nc: no torsion mode among bending"):
        polar_csv([beam_result(tmp_path, 2.0)], modes)
