"""Programs of OpenFOAM: followed, stopped, their faults told, and never left behind."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest
from tests.processes import LONG, wait_until

from equisection.errors import SolverError
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.process import BlowUpError, run_program

FATAL = """Time = 3

--> FOAM FATAL ERROR:
Cannot find file "points" in directory "polyMesh"

    From function foo
FOAM exiting
"""


def program(folder: Path, script: str) -> Installation:
    """Return an installation whose one program is a shell script."""
    path = folder / "bin" / "solver"
    path.parent.mkdir()
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return Installation((str(path),))


def run(folder: Path, script: str, **options: object) -> None:
    case = folder / "case"
    case.mkdir()
    run_program(program(folder, script), "simpleFoam", case, **options)  # type: ignore[arg-type]


def test_output_goes_to_the_log_of_the_case(tmp_path: Path) -> None:
    run(tmp_path, "echo hello $1; pwd")
    assert (tmp_path / "case" / "log.simpleFoam").read_text() == (
        f"hello simpleFoam\n{tmp_path / 'case'}\n"
    )


def test_fatal_error_reaches_the_user_with_the_log(tmp_path: Path) -> None:
    with pytest.raises(SolverError) as raised:
        run(tmp_path, f"cat <<'END'\n{FATAL}END\nexit 1")
    assert 'Cannot find file "points" in directory "polyMesh"' in str(raised.value)
    assert str(tmp_path / "case" / "log.simpleFoam") in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("end", ["kill -FPE $$", "echo 'Foam::sigFpe::sigHandler(int)'; exit 136"])
def test_floating_point_exception_is_a_blow_up(tmp_path: Path, end: str) -> None:
    with pytest.raises(BlowUpError, match="floating-point exception"):
        run(tmp_path, end)


def test_killed_program_is_a_fault_of_the_machine(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"signal 9: last words; see") as raised:
        run(tmp_path, "echo last words; kill -KILL $$")
    assert not isinstance(raised.value, BlowUpError)


def test_program_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match="does not start"):
        run_program(Installation((str(tmp_path / "none"),)), "simpleFoam", tmp_path)


def test_silent_program_is_ended(tmp_path: Path) -> None:
    before = psutil.Process().children(recursive=True)
    with pytest.raises(SolverError, match=r"has said nothing for 2 s and was ended"):
        run(tmp_path, f"sleep {2 * LONG}", silence=2.0)
    assert psutil.Process().children(recursive=True) == before


def test_watch_sees_times_and_stops_the_run_at_the_end_of_a_step(tmp_path: Path) -> None:
    seen: list[float] = []

    def watch(now: float) -> bool:
        seen.append(now)
        return now >= 3

    step = "echo Time = $t; [ -e stop ] && exit 0; sleep 0.1"
    run(tmp_path, f"for t in $(seq {10 * LONG}); do {step}; done; exit 1", watch=watch)
    assert seen == sorted(seen)
    assert seen[-1] >= 3
    assert not (tmp_path / "case" / "stop").exists()


def test_error_in_the_watch_ends_the_program(tmp_path: Path) -> None:
    def watch(now: float) -> bool:
        raise SolverError(f"wrong at {now:g}")

    with pytest.raises(SolverError, match="wrong at 1"):
        run(tmp_path, f"echo $$ > pid; echo Time = 1; sleep {2 * LONG}", watch=watch)
    assert not psutil.pid_exists(int((tmp_path / "case" / "pid").read_text()))


@pytest.mark.skipif(sys.platform != "linux", reason="asks the system, which is Linux alone")
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_program_dies_with_the_job_that_is_killed(tmp_path: Path, how: signal.Signals) -> None:
    code = (
        "import sys; from pathlib import Path\n"
        "from equisection.solvers.openfoam.installation import Installation\n"
        "from equisection.solvers.openfoam.process import run_program\n"
        "run_program(Installation((sys.argv[1],)), 'x', Path(sys.argv[2]))\n"
    )
    installation = program(tmp_path, f"echo $$ > pid; exec sleep {2 * LONG}")
    job = subprocess.Popen([sys.executable, "-c", code, *installation.prefix, tmp_path])
    pid = tmp_path / "pid"
    wait_until(lambda: pid.exists() and pid.read_text().strip() != "")
    os.kill(job.pid, how)
    job.wait(LONG)
    wait_until(lambda: not _runs(int(pid.read_text())))


def _runs(pid: int) -> bool:
    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False
