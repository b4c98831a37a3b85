"""Cases whose solver goes wrong: what is of the case is a result, what is of the machine is none.

OpenFOAM is a stand-in here, whose faults come on demand.
"""

import os
import random
import re
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.conftest import ROOT
from tests.processes import wait_until
from tests.sample_cases import STEADY, UNSTEADY

from equisection.cases import SolverBlock, history_hash, write_cases
from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from equisection.errors import SolverError
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.section.body_axes import BodyAxes
from equisection.solvers.openfoam.section.section_history import read_section
from equisection.store.job import run_cases
from equisection.verdict.zigzag import LARGEST_ZIGZAG

STAND_IN = f"{sys.executable} {ROOT / 'tests' / 'openfoam_stand_in.py'}"
SOLVER = SolverBlock(
    name=Adapter.name,
    version=Adapter.version,
    settings={"mesh": "coarse", "outer_correctors": 8},
)
CASE = UNSTEADY.model_copy(
    update={"solver": SOLVER, "duration": 20.0, "time_step": 0.02, "output_interval": 0.1}
)
RIGID = STEADY.model_copy(update={"solver": SOLVER})


@pytest.fixture(autouse=True)
def stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PREFIX_VARIABLE, STAND_IN)


def run(folder: Path, case: Any = CASE) -> dict[str, Any]:
    found = run_cases({"k": case}, folder, folder / "store", folder / "progress.json")
    return found["k"]


def free_folder(folder: Path) -> Path:
    return folder / "store" / history_hash(CASE) / "case0" / "free"


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    folder = tmp_path_factory.mktemp("undisturbed")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(PREFIX_VARIABLE, STAND_IN)
        run(folder)
    return read_dataset(folder / "k.nc")


def assert_same_history(folder: Path, undisturbed: xr.Dataset) -> None:
    found = read_dataset(folder / "k.nc")
    for name in ("time", "twist", "deflection", "cl", "cm"):
        np.testing.assert_allclose(found[name], undisturbed[name], atol=1e-12)
    for name in ("regime", "end_time", "twist_amplitude_deg"):
        assert found.attrs[name] == undisturbed.attrs[name]


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("fatal", "pimpleFoam: FOAM FATAL ERROR: / Maximum number of iterations exceeded"),
        ("fpe", "pimpleFoam: floating-point exception"),
        ("start", "pimpleFoam: floating-point exception"),
        ("nan", "the loads are beyond reason from time 7 on"),
        ("mesh", "the mesh is not sound: Max skewness = 9"),
    ],
)
def test_case_that_cannot_be_computed_is_failed_with_its_reason(
    fault: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", fault)
    found = run(tmp_path)
    assert found["regime"] == "failed"
    assert words in found["reason"]
    assert str(tmp_path / "store") in found["reason"]
    assert read_dataset(tmp_path / "k.nc").attrs["reason"] == found["reason"]


def test_loads_that_zigzag_are_told_while_the_run_goes_on_and_in_its_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Seen in every step, whatever is recorded: of each second step, which hides it, here."""
    monkeypatch.setenv("STAND_IN_FAULT", "zigzag")
    held = tmp_path / "held"  # behind 800 steps of four pieces, at 16 c/V
    monkeypatch.setenv("STAND_IN_HOLD", f"pimpleFoam:3200:{held}")
    caplog.handler.addFilter(lambda _: held.with_name("held.go").touch() or True)
    found = run(tmp_path, CASE.model_copy(update={"output_interval": 0.04}))
    assert found["loads_zigzag"] > LARGEST_ZIGZAG
    recorded = read_dataset(tmp_path / "k.nc")["cl"].values[200:]
    assert np.abs(np.diff(recorded, 4)).max() < 0.001  # of 0.8, if it were seen
    (told,) = (r.getMessage() for r in caplog.records if "zigzag" in r.getMessage())
    assert re.match(
        r"at 1[0-6]\S* c/V of the run that goes on: not converged in its time step", told
    )
    assert "openfoam.outer_correctors" in told


def test_loads_that_are_converged_are_not_warned_of(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    assert run(tmp_path)["loads_zigzag"] < LARGEST_ZIGZAG / 20
    assert "zigzag" not in caplog.text


def test_loads_that_blow_up_just_before_the_end_are_no_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After the last look at the history, and with floating-point exceptions switched off."""
    monkeypatch.setenv("STAND_IN_FAULT", "nan")
    assert run(tmp_path, CASE.model_copy(update={"duration": 7.1}))["regime"] == "failed"


def test_angle_without_a_mesh_has_no_value(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", "mesh")
    assert "the mesh is not sound" in run(tmp_path, RIGID)["failure"]
    assert np.isnan(read_dataset(tmp_path / "k.nc")["cl"])


def test_failed_case_is_tried_again_and_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, undisturbed: xr.Dataset
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", "fatal")
    assert run(tmp_path)["regime"] == "failed"
    monkeypatch.delenv("STAND_IN_FAULT")
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)
    starts = free_folder(tmp_path) / "postProcessing" / "loads"
    assert {path.name for path in starts.iterdir()} == {"0", "6"}


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("set-up", "FOAM FATAL ERROR: / Unknown solver type GAMMG"),
        ("file", "FOAM FATAL IO ERROR: / error in IOstream"),
        ("kill", "pimpleFoam ended with signal 9"),
    ],
)
def test_fault_of_the_machine_leaves_no_result_and_is_tried_again(
    fault: str,
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    undisturbed: xr.Dataset,
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", fault)
    with pytest.raises(SolverError, match=words) as raised:
        run(tmp_path)
    assert str(free_folder(tmp_path) / "log.pimpleFoam") in str(raised.value)
    assert list(tmp_path.rglob("*.nc")) == []
    monkeypatch.delenv("STAND_IN_FAULT")
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)


def test_fault_of_the_set_up_at_a_resumption_is_none_of_the_case(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, undisturbed: xr.Dataset
) -> None:
    monkeypatch.setenv("STAND_IN_FAULT", "kill")
    with pytest.raises(SolverError, match="ended with signal 9"):
        run(tmp_path)
    monkeypatch.setenv("STAND_IN_FAULT", "library")
    with pytest.raises(SolverError, match="could not load"):
        run(tmp_path)
    assert list(tmp_path.rglob("*.nc")) == []
    monkeypatch.delenv("STAND_IN_FAULT")
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)


def test_what_goes_wrong_after_the_verdict_is_not_in_the_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The program goes on until its end is noticed; a job that comes later does not start it."""
    case = CASE.model_copy(update={"duration": 200.0})
    undisturbed = run(tmp_path / "undisturbed", case)
    assert undisturbed["regime"] == "settled"
    verdict = undisturbed["end_time"]
    monkeypatch.setenv("STAND_IN_FAULT", "fpe")
    monkeypatch.setenv("STAND_IN_WRONG_FROM", f"{verdict + 0.1}")
    found = run(tmp_path / "late", case)
    assert (found["regime"], found["end_time"]) == ("settled", verdict)
    for result in (tmp_path / "undisturbed").rglob("*.nc"):
        result.unlink()
    monkeypatch.setenv("STAND_IN_FAULT", "library")
    found = run(tmp_path / "undisturbed", case)
    assert (found["regime"], found["end_time"]) == ("settled", verdict)


def test_steps_that_are_missing_in_a_history_are_not_passed_over(tmp_path: Path) -> None:
    run(tmp_path)
    folder = free_folder(tmp_path)
    loads = folder / "postProcessing" / "loads" / "0" / "coefficient.dat"
    rows = loads.read_text().splitlines(keepends=True)
    loads.write_text("".join(rows[:500] + rows[520:]))
    with pytest.raises(SolverError, match=r"steps are missing between 9\.96 and 10\.38 c/V"):
        read_section(folder, BodyAxes(0.0))


JOB = [sys.executable, str(ROOT / "tests" / "run_one_job.py")]


def held_job(folder: Path, program: str, piece: int) -> tuple[subprocess.Popen[str], int]:
    """Start a job and return it with its program, held behind a piece that it has written."""
    cases = folder / "cases.json"
    if not cases.exists():
        write_cases(cases, {"k": CASE})
    place = folder / f"held at {piece} of {program}"
    job = subprocess.Popen(
        [*JOB, str(folder)],
        env={**os.environ, "STAND_IN_HOLD": f"{program}:{piece}:{place}"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    wait_until(lambda: job.poll() is not None or is_written(place))
    assert job.poll() is None, job.communicate()[0]
    return job, int(place.read_text())


def is_written(place: Path) -> bool:
    return place.exists() and place.read_text().endswith("\n")


@pytest.mark.parametrize("seed", [1, 2])
def test_job_killed_at_random_moments_comes_to_the_undisturbed_result(
    seed: int, tmp_path: Path, undisturbed: xr.Dataset
) -> None:
    """Steady flow, free run, half a row and half a state: nothing of it is taken for whole.

    The steady flow is 800 pieces, and the free run four times 1,000.
    """
    moments = random.Random(seed)
    for program, most in (("simpleFoam", 800), *[("pimpleFoam", 1200)] * 3):
        job, _ = held_job(tmp_path, program, moments.randint(1, most))
        job.send_signal(signal.SIGKILL)
        job.communicate()
        assert job.returncode == -signal.SIGKILL
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)


def test_solver_killed_at_random_moments_comes_to_the_undisturbed_result(
    tmp_path: Path, undisturbed: xr.Dataset
) -> None:
    moments = random.Random(3)
    for _ in range(3):
        job, program = held_job(tmp_path, "pimpleFoam", moments.randint(1, 1200))
        os.kill(program, signal.SIGKILL)
        said, _ = job.communicate()
        assert job.returncode == 1
        assert "ended with signal 9" in said
        assert "Traceback" not in said
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)


ON_A_SMALL_DISK = ["unshare", "--user", "--mount", "--map-root-user", "sh", "-c"]


def _can_mount() -> bool:
    mount = "mount -t tmpfs tmpfs /mnt"
    return (
        sys.platform == "linux"
        and subprocess.run([*ON_A_SMALL_DISK, mount], capture_output=True, check=False).returncode
        == 0
    )


@pytest.mark.skipif(not _can_mount(), reason="needs a user's own mounts (Linux)")
@pytest.mark.parametrize("kilobytes", [30, 160, 240])
def test_full_disk_is_told_and_nothing_half_written_counts(
    kilobytes: int, tmp_path: Path, undisturbed: xr.Dataset
) -> None:
    """The disk fills at the set-up, between both runs, in the free run; then there is space."""
    disk, kept = tmp_path / "disk", tmp_path / "kept"
    disk.mkdir()
    write_cases(tmp_path / "cases.json", {"k": CASE})
    mount = f"mount -t tmpfs -o size={kilobytes}k tmpfs {disk} && cp {tmp_path}/cases.json {disk}"
    job = f"{' '.join(JOB)} {disk}; status=$?; cp -r {disk} {kept}; exit $status"
    ended = subprocess.run(
        [*ON_A_SMALL_DISK, f"{mount} && {job}"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert ended.returncode == 1, ended.stdout
    assert re.search("the disk .*full.*free some space and run again", ended.stdout)
    assert "Traceback" not in ended.stdout
    assert not list(kept.rglob("[!.]*.nc"))
    run(kept)
    assert_same_history(kept, undisturbed)


def test_file_that_may_not_grow_leaves_no_result(tmp_path: Path, undisturbed: xr.Dataset) -> None:
    """A limit on the size of files, as a quota: reached by the histories."""
    write_cases(tmp_path / "cases.json", {"k": CASE})
    ended = subprocess.run(
        [*JOB, str(tmp_path)],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000)),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert ended.returncode == 1
    assert "File too large" in ended.stdout
    assert not list(tmp_path.rglob("[!.]*.nc"))
    run(tmp_path)
    assert_same_history(tmp_path, undisturbed)
