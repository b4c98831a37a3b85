"""Malformed inputs: how many are refused in one clear line, by function and by command."""

import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row
from tests.malformed.all import KINDS
from tests.workflow.project import ROOT

#: Longest time of a refusal (s of the processor), and every how many configurations Snakemake gets.
LONG, EVERY = 2.0, 25


def rows() -> Iterator[Row]:
    """Look at every malformed input as ``equisection check`` does, and at some by Snakemake."""
    with TemporaryDirectory() as name:
        folders = (Path(name) / f"{number}" for number in count())
        for kind, (inputs, look) in KINDS.items():
            found: Counter[str] = Counter()
            slowest = (0.0, "")
            for one in inputs:
                folder = next(folders)
                folder.mkdir()
                start = time.process_time()
                answer, _ = look(one, folder)
                found[answer] += 1
                slowest = max(slowest, (time.process_time() - start, one.what))
            named = found.pop("named", 0)
            words = f"{kind}, refused in one line that names key or file"
            others = ", ".join(f"{number} {answer}" for answer, number in found.items())
            measured = f"{named} of {len(inputs)}" + (f" ({others})" if others else "")
            yield Row(words, measured, f"{len(inputs)}", named == len(inputs))
            yield Row(
                f"{kind}, the slowest ({slowest[1]})",
                f"{slowest[0]:.2f} s",
                f"<= {LONG:g} s",
                slowest[0] <= LONG,
            )
        yield _by_snakemake(folders)


def _by_snakemake(folders: Iterator[Path]) -> Row:
    """Give every so many configurations to the real command, from a folder of its own.

    A file that is no YAML of sections is Snakemake's to refuse: it reads files before workflows.
    """
    configurations, well = KINDS["configurations"][0], 0
    inputs = [one for one in configurations if one.named.startswith("config: ")][::EVERY]
    for one in inputs:
        folder = next(folders)
        folder.mkdir()
        ended = subprocess.run(
            [
                *(sys.executable, "-m", "snakemake", "-n", "--snakefile", str(ROOT / "Snakefile")),
                *("--configfile", one.write(folder).name),
            ],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        clear = one.named in ended.stderr and "Traceback" not in ended.stderr
        well += ended.returncode == 1 and clear and "rule " not in ended.stdout
    what = "configurations to snakemake, refused with status 1 and no traceback, before any job"
    return Row(what, f"{well} of {len(inputs)}", f"{len(inputs)}", well == len(inputs))
