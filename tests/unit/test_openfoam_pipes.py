"""The exchange with lumpedPointMovement, played by a small program that does what v1912 does."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.processes import LONG

from equisection.errors import SolverError
from equisection.solvers.openfoam.beam.pipes import FOLDER, LOADS, PLACES, Pipes

#: Writes loads, removes the first lock that is there, wants another, and reads places.
OTHER_SIDE = """
import os, sys, time
steps, end = int(sys.argv[1]), sys.argv[2]
locks = ["comms/OpenFOAM.lock", "comms/OpenFOAM.lock.gz"]
for step in range(steps):
    if end == "before-writing" and step == steps - 1:
        sys.exit(3)
    with open("comms/loads.out", "w") as stream:
        stream.write(f"loads {step}\\n" + "x" * 100_000)
    os.remove(next(lock for lock in locks if os.path.exists(lock)))
    if not any(map(os.path.exists, locks)):
        sys.exit("it would wait for a lock")
    if end == "before-reading" and step == steps - 1:
        sys.exit(3)
    if end == "hangs" and step == steps - 1:
        time.sleep(float(sys.argv[3]))
    with open("comms/places.in") as stream:
        assert stream.readline() == f"places {step}\\n"
"""


class OtherSide:
    def __init__(self, folder: Path, steps: int, end: str = "") -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", OTHER_SIDE, str(steps), end, str(2 * LONG)], cwd=folder
        )

    def alive(self) -> bool:
        return self._process.poll() is None

    def end(self) -> int:
        return self._process.wait(LONG)

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()


@pytest.fixture
def pipes(tmp_path: Path) -> Iterator[Pipes]:
    made = Pipes(tmp_path, silence=LONG)
    yield made
    made.close()


def exchange(pipes: Pipes, other: OtherSide) -> int:
    """Serve the other side until it has ended; return how many steps it took."""
    step = 0
    while (message := pipes.receive(other.alive)) is not None:
        assert message.splitlines()[0] == f"loads {step}"
        assert len(message) > 100_000
        if not pipes.send(f"places {step}\n", other.alive):
            break
        step += 1
    return step


def test_many_steps_without_ever_missing_a_lock(pipes: Pipes, tmp_path: Path) -> None:
    other = OtherSide(tmp_path, steps=300)
    assert exchange(pipes, other) == 300
    assert other.end() == 0


@pytest.mark.parametrize("end", ["before-writing", "before-reading"])
def test_other_side_that_ends_is_noticed(pipes: Pipes, tmp_path: Path, end: str) -> None:
    other = OtherSide(tmp_path, steps=3, end=end)
    assert exchange(pipes, other) == 2
    assert other.end() == 3


def test_other_side_that_is_killed_is_noticed(pipes: Pipes, tmp_path: Path) -> None:
    other = OtherSide(tmp_path, steps=3, end="hangs")
    for step in range(2):
        assert pipes.receive(other.alive) is not None
        assert pipes.send(f"places {step}\n", other.alive)
    assert pipes.receive(other.alive) is not None
    other.kill()
    assert not pipes.send("places 2\n", other.alive)
    assert pipes.receive(other.alive) is None


def test_other_side_that_hangs_is_an_error(pipes: Pipes, tmp_path: Path) -> None:
    other = OtherSide(tmp_path, steps=1, end="hangs")
    assert pipes.receive(other.alive) is not None
    pipes.silence = 0.5  # its start may take longer
    with pytest.raises(SolverError, match=r"exchanged nothing with the structure for 0\.5 s"):
        pipes.send("places 0\n", other.alive)
    other.kill()


def test_what_an_earlier_run_left_is_removed(tmp_path: Path) -> None:
    """A file in the place of a pipe, of a run that exchanged files, and a pipe that is full."""
    place = tmp_path / FOLDER
    place.mkdir()
    (place / LOADS).write_text("loads of another run\n")
    (place / PLACES).write_text("places of another run\n")
    (place / "OpenFOAM.lock").write_text("status=done")
    pipes = Pipes(tmp_path, silence=LONG)
    assert (place / LOADS).is_fifo()
    assert (place / "OpenFOAM.lock").read_text() == ""
    other = OtherSide(tmp_path, steps=2)
    assert exchange(pipes, other) == 2
    pipes.close()


def test_the_next_reader_waits_for_places_that_are_not_there_yet(
    pipes: Pipes, tmp_path: Path
) -> None:
    """OpenFOAM may come again before this side has gone on: it finds no end of the last message."""
    other = OtherSide(tmp_path, steps=1)
    assert exchange(pipes, other) == 1
    assert other.end() == 0
    again = os.open(tmp_path / FOLDER / PLACES, os.O_RDONLY | os.O_NONBLOCK)
    try:
        with pytest.raises(BlockingIOError):
            os.read(again, 100)
    finally:
        os.close(again)
