"""Results that a crash, a full disk or a person has spoilt."""

import shutil
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pandas as pd
import pytest
import xarray as xr

from equisection.errors import ResultFileError
from tests.workflow.project import Project, has_nothing_to_do, jobs_run

SUMMARY = "comparison/summary.csv"


def values(path: Path) -> xr.Dataset:
    """Return a result without cost and command, which differ from one computation to the next."""
    with xr.open_dataset(path) as opened:
        data = opened.load()
    for name in ("wall_seconds", "cpu_seconds", "batch_cases", "command"):
        del data.attrs[name]
    return data


def cut_in_half(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def fill_with_garbage(path: Path) -> None:
    path.write_bytes(b"no NetCDF at all\n" * 1000)


def flip_a_bit(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 16
    path.write_bytes(content)


NOT_WHOLE = "truncated or not NetCDF-4"
#: How each result of the sweep is spoilt, and what is said of it.
SPOILT: dict[str, tuple[Callable[[Path], None], str]] = {
    "k6": (cut_in_half, NOT_WHOLE),
    "k10": (fill_with_garbage, NOT_WHOLE),
    "k21": (flip_a_bit, "not as it was written: its content does not have its digest"),
}


def test_spoilt_results_are_computed_again_to_the_same_values(section: Project) -> None:
    folder = section.results / "unsteady" / "2d"
    targets = (section.target(SUMMARY), section.target("unsteady/2d/sweep.json"))
    before = {name: values(folder / f"{name}.nc") for name in SPOILT}
    for name, (spoil, _) in SPOILT.items():
        spoil(folder / f"{name}.nc")  # it is the store's file too
    spoilt = {name: (folder / f"{name}.nc").read_bytes() for name in SPOILT}

    said = section.run("--dry-run", *targets)
    for name, (_, fault) in SPOILT.items():
        assert f"unsteady/2d/{name}.nc: {fault}; a run" in said
        assert (folder / f"{name}.nc").read_bytes() == spoilt[name]

    said = section.run(*targets)
    for name, (_, fault) in SPOILT.items():
        assert f"unsteady/2d/{name}.nc: {fault}; kept as {name}.nc.broken, made again" in said
        xr.testing.assert_identical(values(folder / f"{name}.nc"), before[name])
        assert (folder / f"{name}.nc.broken").exists()
    assert jobs_run(said)["unsteady_batch"] == 1
    assert has_nothing_to_do(section.run(*targets))


def test_a_lost_result_is_published_again_from_the_store(section: Project) -> None:
    path = section.results / "unsteady" / "2d" / "k10.nc"
    before = path.read_bytes()
    path.unlink()
    targets = (section.target(SUMMARY), section.target("unsteady/2d/sweep.json"))
    assert jobs_run(section.run(*targets))["unsteady_batch"] == 1
    assert path.read_bytes() == before
    assert has_nothing_to_do(section.run(*targets))


def test_a_foreign_result_is_set_aside_and_made_anew(section: Project) -> None:
    folder = section.results / "unsteady" / "2d"
    targets = (section.target(SUMMARY), section.target("unsteady/2d/sweep.json"))
    before = values(folder / "k10.nc")
    table = pd.read_csv(section.results / SUMMARY)
    shutil.copyfile(folder / "k6.nc", folder / "k10.nc")  # it is the store's file too

    said = section.run(*targets)

    assert "unsteady/2d/k10.nc: not the result of its case; kept as k10.nc.broken" in said
    xr.testing.assert_identical(values(folder / "k10.nc"), before)
    without_cost = ["cpu_seconds", "wall_seconds"]
    pd.testing.assert_frame_equal(
        pd.read_csv(section.results / SUMMARY).drop(columns=without_cost),
        table.drop(columns=without_cost),
    )
    assert has_nothing_to_do(section.run(*targets))


def test_a_steady_result_exchanged_during_the_run_is_refused_by_name(
    section: Project, load_script: Callable[[str], ModuleType], tmp_path: Path
) -> None:
    section.run(section.target("steady/2d/polar.json"))
    folder = section.results / "steady" / "2d"
    shutil.copyfile(folder / "coarse_a5.nc", folder / "coarse_a10.nc")
    with pytest.raises(ResultFileError, match=r"coarse_a10\.nc: foreign: .* run again"):
        load_script("polar").main(folder / "polar.json", ["coarse_a10"], tmp_path / "polar.nc")
    assert not (tmp_path / "polar.nc").exists()


def test_every_result_that_is_lost_is_asked_for_again(finished: Project, tmp_path: Path) -> None:
    project = finished.copy(tmp_path / "project")
    for lost in ("steady/3d/coarse_a5.nc", "unsteady/3d/k6.nc"):
        (project.results / lost).unlink()
    said = project.run("--dry-run")
    for index in ("steady/3d/polar.json", "unsteady/3d/sweep.json"):
        assert (project.results / index).exists()
        why = "names results that are not there; they are made again; a run would make it again"
        assert f"{index}: {why}" in said
    (project.results / "structure" / "mesh_study.nc").unlink()
    assert ": modes of the beam\n" in project.run("--dry-run")


def test_a_case_file_that_was_spoilt_is_made_again(section: Project) -> None:
    cases = section.results / "cases" / "unsteady" / "2d" / "sweep.json"
    before = cases.read_text()
    cases.write_text(before[:200])
    said = section.run(section.target("unsteady/2d/sweep.json"))
    assert "sweep.json: edited since its job made it; kept as sweep.json.broken, made again" in said
    assert cases.read_text() == before


def test_a_table_that_was_edited_by_hand_is_made_again(section: Project) -> None:
    section.run(section.target(SUMMARY))
    table = section.results / SUMMARY
    before = table.read_text()
    table.write_text(before.replace("2d,", "3d,"))
    said = section.run(section.target(SUMMARY))
    assert "summary.csv: edited since its job made it; kept as summary.csv.broken" in said
    assert table.read_text() == before


def test_a_dry_run_leaves_what_a_run_is_writing_alone(section: Project) -> None:
    writing = section.results / "unsteady" / "2d" / ".tmp-abc.nc"
    writing.write_bytes(b"half of a re")
    said = section.run("--dry-run", section.target(SUMMARY))
    assert "Nothing to be done" in said
    assert writing.exists()
