"""Whether the files that a configuration names are there, looked at before any job starts."""

from __future__ import annotations

import difflib
from pathlib import Path

from equisection.config.groups import FLAT_PLATE
from equisection.config.model import Config
from equisection.errors import ConfigError
from equisection.keys.checks import Problem

#: May be missing where cases are computed: a project need not keep any.
_USUAL_REUSE = Config.model_fields["reuse"].default


def check_files(config: Config, directory: Path | None = None) -> None:
    """Refuse what is named and not there, seen from ``directory`` (by default the working one).

    These are polars, the folder that results come from, and the indices of other runs' results. An
    index of this run is no other's: its rules make it.

    Braces in a path are Snakemake's, which would take what is in them for a wildcard.

    Raises
    ------
    ConfigError
        With one line for each missing file, and each path with braces.
    """
    directory = directory or Path.cwd()
    named = {}
    if config.solver == "embedded":
        named = {f"embedded.polars.{name}": path for name, path in config.embedded.polars.items()}
    if config.steady.beam_polar:
        named["steady.beam_polar"] = config.steady.beam_polar
    problems = [
        Problem(key, path, _advice(path, directory, built_in=key != "steady.beam_polar"))
        for key, path in named.items()
        if not (path == FLAT_PLATE and key != "steady.beam_polar")
        and not _is_file(directory / path)
    ]
    if config.reuse and not _is_folder(directory / config.reuse):
        otherwise = 'or "" to compute every case' if config.compute else "where compute is false"
        if not config.compute or config.reuse != _USUAL_REUSE:
            problems.append(
                Problem(
                    "reuse",
                    config.reuse,
                    f"no such folder, seen from {directory}; allowed is a folder with results, "
                    f"{otherwise}",
                )
            )
    own = directory / "results" / config.run
    problems += [
        Problem(
            f"sweep.taken.{model}",
            path,
            f"no such file, seen from {directory}; allowed is the index of a run that has ended: "
            "run its configuration first",
        )
        for model, path in config.sweep.taken.items()
        if not (directory / path).is_relative_to(own) and not _is_file(directory / path)
    ]
    problems += [
        Problem(key, path, "allowed is a path without braces; give the file or folder another name")
        for key, path in {**named, "reuse": config.reuse}.items()
        if {"{", "}"} & set(path)
    ]
    if problems:
        raise ConfigError("\n".join(problem.line for problem in problems))


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _advice(polar: str, directory: Path, *, built_in: bool) -> str:
    place = directory / polar
    what = "a folder" if "\0" not in polar and place.is_dir() else "no such file"
    allowed = f"a CSV file or {FLAT_PLATE}" if built_in else "a CSV file"
    answer = f"{what}, seen from {directory}; allowed is {allowed}"
    if polar == FLAT_PLATE:
        return f"{answer}; {FLAT_PLATE} is a polar of the section, in embedded.polars"
    candidates = {FLAT_PLATE: FLAT_PLATE} if built_in else {}
    if "\0" not in polar and place.parent.is_dir():
        candidates |= {
            str(Path(polar).with_name(other.name)): other.name
            for other in sorted(place.parent.glob("*.csv"))
        }
    near = difflib.get_close_matches(polar, candidates, n=1, cutoff=0.8)
    return f"{answer}; did you mean '{near[0]}'?" if near else answer
