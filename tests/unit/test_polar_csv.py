"""The command `equisection polar`: a polar file from steady results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT

from equisection.aerodynamics.polar import Polar
from equisection.analysis.polar_of_results import polar_aerodyn, polar_csv
from equisection.config import load_config
from equisection.errors import ConfigError, ResultFileError
from equisection.results.netcdf import write_dataset
from equisection.results.steady_result import SteadyResult
from equisection.run.command_line import main
from equisection.study.given_polars import check_polars

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
    ("name", "kept"),
    [
        ("plate_2d_11136", ["paper-plate-openfoam/steady/2d/coarse_a*.nc"]),
        ("plate_2d_7112", ["plate-cells/steady/2d/medium_a*.nc"]),
        ("plate_3d_85284", ["paper-plate-openfoam-3d/steady/3d/coarse_a*.nc"]),
        (
            "plate_3d_300912",
            [
                "paper-plate-openfoam-3d-grid/steady/3d/medium_a*.nc",
                "plate-equilibrium-medium/steady/3d/medium_a*.nc",
            ],
        ),
    ],
)
def test_polar_that_is_shipped_is_that_of_the_results_that_are_kept(
    name: str, kept: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    paths = [str(path) for one in kept for path in (ROOT / "results/reference").glob(one)]
    assert main(["polar", *paths]) == 0
    written = (ROOT / "config" / "polars" / f"{name}.csv").read_text(encoding="utf-8")
    assert capsys.readouterr().out == written


def test_polar_of_a_beam_is_held_to_the_beam_and_the_channel_of_its_results(
    tmp_path: Path,
) -> None:
    """Written by the command, it is refused as ``steady.beam_polar`` of any other."""
    kept = ROOT / "results/reference/paper-plate-openfoam-3d/steady/3d"
    (tmp_path / "beam.csv").write_text(polar_csv(list(kept.glob("coarse_a*.nc"))))
    steady = {"beam_polar": "beam.csv"}
    cfd = {"solver": "openfoam", "sweep": {"models": ["2d"]}, "unsteady": {"time_step": 0.02}}
    check_polars(load_config({**cfd, "steady": steady}), tmp_path)
    for change, reason in (
        ({"beam": {"length": 0.6}}, "of L/c 3.7 and not 6"),
        ({"flow": {"root_on_wall": False}}, "of flow.root_on_wall true and not false"),
        ({"flow": {"channel": {"height_chords": 8}}}, "height_chords 4 and not 8"),
    ):
        with pytest.raises(ConfigError, match=reason):
            check_polars(load_config({**cfd, **change, "steady": steady}), tmp_path)


def test_polar_is_read_back_in_order_without_what_failed(tmp_path: Path) -> None:
    angles = (10.0, 0.0, 2.5, 5.0)
    paths = [result(tmp_path, angle) for angle in angles]
    text = polar_csv([*paths, result(tmp_path, 12.0, failure="the flow blew up")])
    assert "# Left out: 12 deg, the flow blew up" in text
    file = tmp_path / "polar.csv"
    file.write_text(text, encoding="utf-8")
    polar = Polar.read(file, symmetric=False)
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
        (ROOT / "config/polars/own_section.csv", r"csv: no NetCDF file; give files of results"),
    ):
        with pytest.raises(ResultFileError, match=words):
            polar_csv([one, other])
    assert main(["polar", str(one), str(fine)]) == 1
    assert capsys.readouterr().err.startswith("error: ")


def test_table_for_aerodyn_is_the_same_polar(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Written about the quarter chord and read back, it has the moment about mid-chord again."""
    kept = ROOT / "results/reference/paper-plate-openfoam/steady/2d"
    assert main(["polar", "--format", "aerodyn", *map(str, kept.glob("coarse_a*.nc"))]) == 0
    file = tmp_path / "plate.dat"
    file.write_text(capsys.readouterr().out, encoding="utf-8")
    table = Polar.read(file, symmetric=False)
    shipped = Polar.read(ROOT / "config/polars/plate_2d_11136.csv", symmetric=False)
    assert table.incidence == pytest.approx(shipped.incidence)
    assert table.moment == pytest.approx(shipped.moment, abs=1.5e-5)  # five digits each
    assert table.drag == pytest.approx(shipped.drag)
    assert table.reynolds_number == pytest.approx(126_882)


def test_table_for_aerodyn_makes_nothing_up(tmp_path: Path) -> None:
    text = polar_aerodyn([result(tmp_path, a) for a in (0.0, 2.0, 4.0, 6.0)])
    assert "NumAlf" in text
    assert "(not known: any)" in text
    rows = [line.split() for line in text.splitlines()[-4:]]
    assert [float(row[0]) for row in rows] == [0.0, 2.0, 4.0, 6.0]
