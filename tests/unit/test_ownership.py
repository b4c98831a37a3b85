"""One job at a time in a working directory, whatever becomes of the one before."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from tests.processes import LONG

from equisection.errors import SolverError
from equisection.store import lock as ownership
from equisection.store.lock import FOLDER, HeldLock, Owner, claimed
from equisection.store.progress import Process

#: A job that owns the directory until it is told to end, or killed.
HOLDER = """
import sys
from pathlib import Path
from equisection.store.lock import claimed
with claimed(Path(sys.argv[1])):
    print("has it", flush=True)
    sys.stdin.read()
"""
#: Jobs that each add 1 to a number in a file, which goes wrong if two are in the block.
ADDER = """
import sys, time
from pathlib import Path
from equisection.store import lock as ownership
ownership.LOOK = 0.01
work = Path(sys.argv[1])
for _ in range(5):
    with ownership.claimed(work):
        number = work / "number"
        before = int(number.read_text()) if number.exists() else 0
        time.sleep(0.01)
        number.write_text(str(before + 1))
"""
#: A job of a machine that cannot be asked.
ELSEWHERE = Owner(Process("another-machine", 1, ""), since=1.0e9, job="17")


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SLURM_JOB_ID", raising=False)
    for name, value in {"BEAT": 0.05, "LOOK": 0.02, "SILENCE": 0.6}.items():
        monkeypatch.setattr(ownership, name, value)


def start(work: Path) -> subprocess.Popen[str]:
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(work)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert holder.stdout is not None
    assert holder.stdout.readline() == "has it\n"
    return holder


def clock(monkeypatch: pytest.MonkeyPatch, look: Callable[[float], None]) -> None:
    """Let the clock of a job that waits go on by its looks alone, and do something at each."""
    now = 0.0

    def sleep(seconds: float) -> None:
        nonlocal now
        now += seconds
        look(now)

    told = SimpleNamespace(sleep=sleep, monotonic=lambda: now, time=time.time)
    monkeypatch.setattr(ownership, "time", told)


def written(work: Path, owner: Owner) -> Path:
    folder = work / FOLDER
    folder.mkdir()
    path = folder / "1.json"
    path.write_text(json.dumps(asdict(owner)))
    return path


def names(work: Path) -> set[str]:
    return {path.name for path in (work / FOLDER).iterdir()}


def test_owners_stand_in_a_row_and_say_who_ran_when(tmp_path: Path) -> None:
    for _ in range(2):
        with claimed(tmp_path):
            pass
    assert names(tmp_path) == {"1.json", "2.json"}
    said = json.loads((tmp_path / FOLDER / "2.json").read_text())
    assert said["process"]["pid"] == os.getpid()
    assert said["since"] <= said["ended"] <= time.time()


def test_second_job_waits_for_the_first_and_says_for_whom(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    holder = start(tmp_path)
    looks = 0

    def look(now: float) -> None:
        nonlocal looks
        looks += 1
        if looks == 3:
            holder.communicate()  # closes what it reads, so that it ends

    clock(monkeypatch, look)
    with claimed(tmp_path):
        assert looks == 3
    said = capsys.readouterr().err
    assert said.count("waiting") == 1
    assert f"process {holder.pid} on " in said
    assert str(tmp_path) in said


def test_killed_owner_is_succeeded_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ownership, "SILENCE", 1e9)
    holder = start(tmp_path)
    holder.send_signal(signal.SIGKILL)
    holder.communicate()
    with claimed(tmp_path) as claim:
        assert claim.number == 2


def test_number_of_a_process_that_another_has_now_is_not_its_life(tmp_path: Path) -> None:
    """The process number of the owner was given again after a restart of the machine."""
    other = replace(ELSEWHERE, process=replace(Process.this(), birth="1"))
    written(tmp_path, other)
    with claimed(tmp_path) as claim:
        assert claim.number == 2


def test_owner_on_another_machine_is_succeeded_once_it_is_silent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another job beats for five times as long as it may be silent, by this job's clock."""
    monkeypatch.setattr(ownership, "SILENCE", 2.0)
    path = written(tmp_path, ELSEWHERE)
    looked = [0.0]

    def look(now: float) -> None:
        looked.append(now)
        if now < 10.0:
            os.utime(path, ns=(0, len(looked)))

    clock(monkeypatch, look)
    with claimed(tmp_path) as claim:
        assert claim.number == 2
    assert looked[-1] == pytest.approx(12.0, abs=0.1)


def test_clock_of_the_other_machine_does_not_matter(tmp_path: Path) -> None:
    path = written(tmp_path, ELSEWHERE)
    os.utime(path, (4e9, 4e9))  # in the year 2096
    with claimed(tmp_path) as claim:
        assert claim.number == 2


def test_job_that_slurm_started_again_elsewhere_does_not_wait_for_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ownership, "SILENCE", 1e9)
    written(tmp_path, ELSEWHERE)
    monkeypatch.setenv("SLURM_JOB_ID", ELSEWHERE.job)
    with claimed(tmp_path) as claim:
        assert claim.number == 2


@pytest.mark.parametrize(
    "text",
    [
        "",
        json.dumps({**asdict(ELSEWHERE), "since": "noon"}),
        json.dumps({**asdict(ELSEWHERE), "ended": 1e300}),
        json.dumps({**asdict(ELSEWHERE), "job": 17}),
        json.dumps({**asdict(ELSEWHERE), "process": {"host": "a", "pid": -1, "birth": ""}}),
    ],
)
def test_owner_that_was_killed_before_it_could_say_who_it_is(tmp_path: Path, text: str) -> None:
    path = written(tmp_path, ELSEWHERE)
    path.write_text(text)
    path.with_name("1 (copy).json").write_text(text)
    with claimed(tmp_path) as claim:
        assert claim.number == 2


def sleep_while_another_takes_over(work: Path) -> None:
    with claimed(work) as claim:
        other = HeldLock(claim.folder, claim.number + 1, ELSEWHERE)
        other.file.write_text(json.dumps(asdict(ELSEWHERE)))
        time.sleep(LONG)  # is interrupted


def test_job_that_was_taken_for_gone_stops(tmp_path: Path) -> None:
    """The machine slept; another one runs the case now."""
    with pytest.raises(SolverError, match=r"SLURM job 17, process 1 on another-machine"):
        sleep_while_another_takes_over(tmp_path)


def test_many_jobs_are_in_the_directory_one_after_the_other(tmp_path: Path) -> None:
    jobs = [subprocess.Popen([sys.executable, "-c", ADDER, str(tmp_path)]) for _ in range(4)]
    assert [job.wait() for job in jobs] == [0] * 4
    assert (tmp_path / "number").read_text() == "20"
    assert names(tmp_path) == {f"{number}.json" for number in range(1, 21)}
