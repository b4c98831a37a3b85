"""Ask Snakemake for the rule graph of a configuration."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from equisection.errors import EquisectionError

#: Name of a run that has no results: the graph of a fresh run is the same before and after,
#: and this query touches nothing that other jobs are writing.
_FRESH_RUN = "rule-graph"
_PATIENCE_SECONDS = 240


class RuleGraphError(EquisectionError):
    """Snakemake did not give its rule graph."""


def ask_rule_graph(snakefile: Path, config: Path) -> str:
    """Return what ``snakemake --rulegraph`` prints for a resolved configuration.

    It locks nothing and runs nothing, so it may be asked while a workflow runs. The user's
    profile is left out, since it says where jobs go and not what they are.

    Raises
    ------
    RuleGraphError
        Snakemake cannot be found or ends with an error.
    """
    command = [
        _snakemake(),
        "--rulegraph",
        *("--snakefile", str(snakefile)),
        *("--configfile", str(config)),
        *("--config", f"run={_FRESH_RUN}"),
        *("--workflow-profile", "none"),
    ]
    environment = {name: value for name, value in os.environ.items() if name != "SNAKEMAKE_PROFILE"}
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            check=False,
            timeout=_PATIENCE_SECONDS,
            env=environment,
        )
    except subprocess.TimeoutExpired:
        raise RuleGraphError(
            f"{' '.join(command)}: no answer after {_PATIENCE_SECONDS} s; is the file system slow?"
        ) from None
    if done.returncode != 0:
        last = "\n".join(done.stderr.strip().splitlines()[-3:])
        raise RuleGraphError(f"{' '.join(command)}: exit status {done.returncode}\n{last}")
    return done.stdout


def _snakemake() -> str:
    """Return the Snakemake beside this Python, or the first on the path."""
    beside = Path(sys.executable).with_name("snakemake")
    found = str(beside) if beside.is_file() else shutil.which("snakemake")
    if found is None:
        raise RuleGraphError(
            f"no 'snakemake' beside {sys.executable} or on the path; "
            "install it there, or put it on the path"
        )
    return found
