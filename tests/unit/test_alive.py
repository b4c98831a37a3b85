"""A run that is alive keeps its lock; one that is gone, or on another machine, does not."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from equisection.run import alive
from equisection.store.progress import Process

UNLOCK = ["--unlock", "--cores", "1"]


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def note(process: Process) -> Path:
    """Write what a run leaves that is killed."""
    alive.FOLDER.mkdir(parents=True, exist_ok=True)
    path = alive.FOLDER / f"{process.host}-{process.pid}.json"
    path.write_text(json.dumps({**vars(process), "since": 1.0e9}))
    return path


def ended() -> Process:
    with subprocess.Popen([sys.executable, "-c", ""]) as child:
        pass
    return Process(Process.this().host, child.pid, "1")


def test_living_run_keeps_its_lock() -> None:
    alive.announce(["--cores", "2"])
    refusal = alive.refusal_to_unlock(UNLOCK)
    assert refusal.startswith(f"error: process {os.getpid()} runs the workflow here since ")
    assert f"'kill {os.getpid()}'" in refusal
    assert alive.refusal_to_unlock(["--cores", "2"]) == ""


def test_run_that_was_killed_has_none_and_is_forgotten_by_the_next() -> None:
    left = note(ended())
    assert alive.refusal_to_unlock(UNLOCK) == ""
    assert left.exists()
    alive.announce([])
    assert [path.name.endswith(f"-{os.getpid()}.json") for path in alive.FOLDER.iterdir()] == [True]


def test_run_on_another_machine_is_said_once() -> None:
    note(Process("another-machine", 7, ""))
    assert alive.refusal_to_unlock(UNLOCK) == ""
    (line,) = alive.elsewhere(UNLOCK)
    assert line.startswith("warning: process 7 on another-machine has run the workflow here since")
    assert list(alive.elsewhere(UNLOCK)) == []


def test_process_says_no_more_when_it_has_ended() -> None:
    code = "from equisection.run import alive; alive.announce([]); print(*alive.FOLDER.iterdir())"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ".json" in said.stdout
    assert list(alive.FOLDER.iterdir()) == []


@pytest.mark.parametrize("look", ["-n", "--dry-run", "--unlock", "--unlo", "--lint"])
def test_command_that_only_looks_leaves_nothing(look: str, here: Path) -> None:
    alive.announce([look])
    assert list(here.iterdir()) == []


def test_what_is_no_note_is_passed_over() -> None:
    alive.FOLDER.mkdir(parents=True)
    (alive.FOLDER / "a.json").write_text("{")
    (alive.FOLDER / "b.json").write_text("[1]")
    assert alive.refusal_to_unlock(UNLOCK) == ""
