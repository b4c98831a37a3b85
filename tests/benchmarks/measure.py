"""Time and memory of a command with all its children."""

import resource
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import psutil

POLL = 0.1  # seconds between two looks at the memory


@dataclass(frozen=True)
class Row:
    """One line of the table of benchmarks."""

    what: str
    measured: str
    wanted: str = ""
    ok: bool | None = None  # nothing is wanted of a row that only informs

    @property
    def verdict(self) -> str:
        """Return the last column."""
        return {None: "", True: "yes", False: "NO"}[self.ok]


@dataclass(frozen=True)
class Cost:
    """What a command took."""

    seconds: float
    processor_seconds: float  # of all children; does not grow on a busy machine as the other does
    peak_gigabytes: float  # resident, summed over the processes alive at one time
    output: str


def limit(what: str, value: float, most: float, unit: str) -> Row:
    """Return the row of a value that should not be above another."""
    return Row(what, f"{value:.3g} {unit}", f"<= {most:g} {unit}", value <= most)


def measured(
    command: Sequence[str], folder: Path, environment: Mapping[str, str] | None = None
) -> Cost:
    """Run a command to its end.

    Raises
    ------
    RuntimeError
        The command failed; with what it said.
    """
    said = folder / "benchmark.log"
    peak, start, before = 0, time.perf_counter(), processor_seconds()
    with said.open("w", encoding="utf-8") as log:
        process = psutil.Popen(
            command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT
        )
        while process.poll() is None:
            peak = max(peak, _resident(process))
            time.sleep(POLL)
    seconds = time.perf_counter() - start
    output = said.read_text(encoding="utf-8")
    if process.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} ended with {process.returncode}:\n{output}")
    return Cost(seconds, processor_seconds() - before, peak / 1e9, output)


def processor_seconds() -> float:
    """Return the processor time of all children that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def most_megabytes() -> float:
    """Return the memory of the largest child that has ended."""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


def _resident(process: psutil.Process) -> int:
    total = 0
    try:
        for member in (process, *process.children(recursive=True)):
            try:
                total += member.memory_info().rss
            except psutil.Error:
                continue
    except psutil.Error:
        return total
    return total
