"""Start the workflow by ``snakemake``, with a bar of its progress on a terminal."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from equisection.clone import clone_of_package

#: Snakemake's line after each job.
_STEPS = re.compile(r"^(\d+) of (\d+) steps \(\d+%\) done$")
#: What Snakemake says of jobs that go well, which the bar stands for.
_ROUTINE = re.compile(r"^(\[.*\]|Finished jobid: .*|Select jobs to execute.*|Execute \d+ jobs?.*)$")
#: Words for ``snakemake`` with which the run is the whole one of its configurations: those that
#: have a value, and those that have none.
_WITH_VALUE = frozenset(
    ("--cores", "-c", "--jobs", "-j", "--profile", "--workflow-profile", "--latency-wait", "-w")
)
_ALONE = frozenset(
    ("--keep-going", "-k", "--rerun-incomplete", "--ri", "--printshellcmds", "-p", "--forceall")
)
_NUMBERED = re.compile(r"-[cjw]\d+")


def snakemake_command(configfiles: Iterable[Path], further: Sequence[str]) -> list[str]:
    """Return the command that runs the workflow.

    Parameters
    ----------
    configfiles
        Configurations on top of the default one.
    further
        Further words for ``snakemake``. Cores and profile are those of ``make run`` where they
        are not among them.
    """
    files = [str(path) for path in configfiles]
    # before all else, for it would take what follows it without a dash as a further file
    command = [sys.executable, "-m", "snakemake", *(["--configfile", *files] if files else [])]
    project = clone_of_package()
    place = project if project and project != Path.cwd().resolve() else Path()
    if place != Path() and not _given(further, "--snakefile", "-s"):
        command += ["--snakefile", str(place / "Snakefile")]
    if not _given(further, "--cores", "-c", "--jobs", "-j", "--profile"):
        command += ["--cores", "all"]
    if not _given(further, "--workflow-profile"):
        command += ["--workflow-profile", str(place / "workflow" / "profiles" / "default")]
    return [*command, *further]


def is_whole(further: Sequence[str]) -> bool:
    """Tell whether a run with further words makes all that its configurations ask for.

    A dry run, a target or other keys (``--config``) leave the tables that are there as they were,
    or make those of another run.
    """
    words = iter(further)
    for word in words:
        option, equals, _ = word.partition("=")
        if option in _WITH_VALUE:
            if not equals:
                next(words, None)
        elif word not in _ALONE and not _NUMBERED.fullmatch(word):
            return False
    return True


def launch(command: Sequence[str], console: Console) -> int:
    """Run a command of ``snakemake``; return its exit status.

    On a terminal the lines of jobs that go well give way to a bar, and what else is said is
    printed above it. Elsewhere every line is passed on.
    """
    if not console.is_terminal:
        return subprocess.run(command, check=False).returncode
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    with (
        Progress(*columns, TimeElapsedColumn(), console=console) as progress,
        subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
        ) as running,
    ):
        task = progress.add_task("jobs", total=None)
        assert running.stdout is not None
        try:
            for line in running.stdout:
                steps = _STEPS.match(line.strip())
                if steps:
                    progress.update(task, completed=int(steps.group(1)), total=int(steps.group(2)))
                elif not _ROUTINE.match(line.strip()) and line.strip():
                    progress.console.print(line.rstrip("\n"), markup=False, highlight=False)
        except KeyboardInterrupt:  # snakemake has it too, and ends its jobs before itself
            running.wait()
            raise
        return running.wait()


def _given(words: Sequence[str], *options: str) -> bool:
    """Tell whether one of the options is among the words, with its value apart or after '='."""
    return any(
        word == option
        or word.startswith(f"{option}=")
        or (len(option) == 2 and word.startswith(option) and word[2:].isdigit())
        for word in words
        for option in options
    )
