"""Look at what a run starts from, before the workflow builds its graph.

Here are the folders that a run may be started from, and the notices at the start: files of the
future, a folder that the solver cannot work in, a clone that git does not trust. It runs at every
start of the workflow, so it must be cheap.
"""

from __future__ import annotations

import io
import os
import sys
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import redirect_stderr
from pathlib import Path
from typing import Any

import equisection
from equisection.clone import clone_of_package
from equisection.config import Config, check_files, find_files, load_config, named_files
from equisection.errors import ConfigError
from equisection.provenance import COMMAND_VARIABLE, CONFIG_VARIABLE, refused_by_git
from equisection.solvers.registry import check_provided
from equisection.study.given_derivatives import check_derivatives
from equisection.study.given_outline import check_outline
from equisection.study.given_polars import check_polars, polar_notices

#: Where the folders of runs are, and in it the store of all results by their hash.
RESULTS = Path("results")
STORE = ".store"
#: The configuration that is read first.
CONFIG_FILE = Path("config") / "config.yaml"
#: Where Snakemake keeps the locks of a folder.
_LOCKS = Path(".snakemake") / "locks"
#: Options with which ``snakemake`` runs no job.
_ONLY_LOOK = (
    *("dryrun", "unlock", "lint", "dag", "rulegraph", "filegraph", "d3dag", "archive", "report"),
    *("summary", "detailed_summary", "list_rules", "list_target_rules", "list_changes"),
    *("list_input_changes", "list_params_changes", "list_untracked", "print_compilation"),
    *("cleanup_metadata", "generate_unit_tests", "containerize", "export_cwl", "touch"),
)
#: How far ahead of the clock a file may be (s); clocks of file servers are that much off.
_AHEAD = 10.0
#: Folders of a run that nothing is made from.
_ASIDE = {"logs", "provenance"}
#: Hashes of the configurations of this process, and what it has said: both are per process, for a
#: workflow may use this one as a module several times.
_CONFIGS: set[str] = set()
_SAID: set[str] = set()


def here_or_in_project(path: Path, project: Path | None) -> Path:
    """Return a path as seen from the working directory or, if it is not there, from the project."""
    return path if path.exists() or project is None else project / path


def config_files(first: Path, given: Iterable[Path]) -> list[Path]:
    """Return the files of the configuration in the order in which they add up.

    The first may be missing where others are given.
    """
    others = [Path(path) for path in given]
    return [first, *others] if first.exists() or not others else others


def project_of(rules: Path) -> Path:
    """Return the folder of the project, whose rules are in ``rules``.

    Rules that Snakemake fetches, as those of a module may be, are in no folder; then it is the
    clone that the package is in.

    Raises
    ------
    ConfigError
        There is none, or its path has braces.
    """
    project = rules.parents[1] if rules.is_dir() else clone_of_package()
    if project is None:
        raise ConfigError(
            f"{rules}: the rules are fetched, and the package is in no clone of the project, which "
            "has the polars and more; clone it and name its Snakefile, or install the package from "
            "the clone ('pip install -c envs/constraints.txt -e .')"
        )
    if {"{", "}"} & set(str(project)):
        raise ConfigError(
            f"the project is in {project}: Snakemake takes what is in braces for a wildcard; give "
            "the folder another name"
        )
    return project


def checked_config(raw: Mapping[str, Any], project: Path, results: Path = RESULTS) -> Config:
    """Return the configuration of a run, after the checks of its files and of its solver.

    Parameters
    ----------
    raw
        The keys of all files and of the command line.
    project
        The clone, which files are taken from that are not in the working directory.
    results
        Folder with the folders of runs.

    Raises
    ------
    ConfigError
        With one line for each problem.
    """
    config = find_files(load_config(raw), project)
    check_files(config, project=project, results=results)
    check_outline(config)
    check_polars(config)
    check_derivatives(config)
    check_provided(config)
    return config


def tell_jobs(command: str, config: str) -> None:
    """Hand jobs the command and the hash of their run's configuration, by the environment.

    A workflow that uses this one as a module more than once has several configurations. Its jobs
    get no hash, since it could be the wrong one.
    """
    _CONFIGS.add(config)
    os.environ[COMMAND_VARIABLE] = command
    os.environ[CONFIG_VARIABLE] = config if len(_CONFIGS) == 1 else ""


def changes_files(arguments: Sequence[str]) -> bool:
    """Tell whether a ``snakemake`` command runs jobs; a dry run, a list or a graph changes nothing.

    Nothing is to be changed either while another run has the lock of this folder.
    """
    from snakemake.cli import get_argument_parser  # noqa: PLC0415, a third of a second

    if any(_LOCKS.glob("*")):
        return False
    try:
        with redirect_stderr(io.StringIO()):
            options = vars(get_argument_parser().parse_known_args(list(arguments))[0])
    except SystemExit:  # not a command that snakemake reads: another program runs the workflow
        return True
    return not any(options.get(name) for name in _ONLY_LOOK)


def say(lines: Iterable[str]) -> None:
    """Print lines to the terminal, each only once in a process."""
    for line in lines:
        if line not in _SAID:
            print(line, file=sys.stderr)
        _SAID.add(line)


def notices(config: Config, results: Path = RESULTS) -> Iterator[str]:
    """Yield the notices before the jobs start, a line each.

    Parameters
    ----------
    config
        The configuration.
    results
        Folder with the folders of runs and the store.
    """
    if config.compute:
        refusal = config.solver_section.refuses_folder(results / STORE)
        if refusal:
            yield f"warning: {refusal}; until then a case that is not kept cannot be computed"
    yield from polar_notices(config)
    files = [*named_files(config).values(), *_files(results / config.run)]
    ahead = _of_the_future(files, time.time())
    if ahead:
        yield ahead
    distrusted = refused_by_git(Path(equisection.__file__).parent)
    if distrusted:
        yield f"warning: {distrusted}"


def _of_the_future(paths: Iterable[str], now: float) -> str:
    """Return a line on the files that are newer than the clock says; empty if none is."""
    ahead = {path: modified - now for path in paths if (modified := _modified(path)) > now + _AHEAD}
    if not ahead:
        return ""
    furthest = max(ahead, key=lambda path: ahead[path])
    others = f" ({len(ahead) - 1} more are from the future)" if len(ahead) > 1 else ""
    return (
        f"warning: {furthest} is {_duration(ahead[furthest])} ahead of this machine's clock"
        f"{others}: what is made from such a file may be made again at every start, and a change "
        "of what it was made from may pass unseen; set the clock, or 'touch' the files"
    )


def _files(folder: Path) -> Iterator[str]:
    """Give the files of a run that something is made from; as text, for there may be many."""
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in _ASIDE]
        for name in names:
            yield f"{place}/{name}"


def _modified(path: str) -> float:
    try:
        return os.stat(path).st_mtime  # noqa: PTH116, a third of the time
    except (OSError, ValueError):
        return 0.0


def _duration(seconds: float) -> str:
    """Return a duration in its largest unit."""
    for size, unit in ((86400, "d"), (3600, "h"), (60, "min")):
        if seconds >= size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.0f} s"
