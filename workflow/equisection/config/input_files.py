"""Files that a configuration names, found and checked before any job starts.

A relative path is seen from the working directory first. A file that is not there is taken from the
project, which comes with polars and kept results.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable, Sequence
from pathlib import Path

from equisection.config.groups import FLAT_PLATE, Beam
from equisection.config.model import Config
from equisection.errors import ConfigError
from equisection.files import holds_more_than
from equisection.keys.checks import Problem

#: Key of the outline's file.
OUTLINE = "beam.outline.file"
#: Most files and folders below that of kept results, all of which are looked through for results.
MOST_KEPT = 100_000
#: May be missing where cases are computed: a project need not keep any.
_USUAL_REUSE = Config.model_fields["reuse"].default

#: Keys that FLAT_PLATE may have for a file.
_POLARS = "embedded.polars."


def find_files(config: Config, project: Path, directory: Path | None = None) -> Config:
    """Return the configuration with the project's files in the place of missing ones.

    Their paths are relative to ``directory`` (by default the working one), so that both may move
    together. The project has polars and kept results; an index of another run's results
    (``sweep.taken``) is always the working directory's. In the project's own folder nothing
    changes.
    """
    directory = directory or Path.cwd()
    if _is_same(project, directory):
        return config

    def found(path: str) -> str:
        if not path or _is_there(directory / path) or not _is_there(project / path):
            return path
        return os.path.relpath(project / path, directory)

    def all_found(paths: Sequence[str]) -> tuple[str, ...]:
        return tuple(found(path) for path in paths)

    lags = config.embedded.identification
    polars = {
        name: path if path == FLAT_PLATE else found(path)
        for name, path in config.embedded.polars.items()
    }
    embedded = {
        "polars": polars,
        "identification": lags.model_copy(
            update={
                "fitted_to": all_found(lags.fitted_to),
                "judged_on": all_found(lags.judged_on),
            }
        ),
    }
    return config.model_copy(
        update={
            "beam": _with_outline(config.beam, found),
            "reuse": found(config.reuse),
            "steady": config.steady.model_copy(
                update={
                    "beam_polar": found(config.steady.beam_polar),
                    "beam_polar_section": found(config.steady.beam_polar_section),
                }
            ),
            "embedded": config.embedded.model_copy(update=embedded),
            "given": config.given.model_copy(
                update={
                    "polars": {name: found(path) for name, path in config.given.polars.items()},
                    "histories": _found_pattern(config.given.histories, found),
                }
            ),
            "derivatives": config.derivatives.model_copy(
                update={"table": found(config.derivatives.table)}
            ),
        }
    )


def _found_pattern(pattern: str, found: Callable[[str], str]) -> str:
    """Return a path with placeholders, of which the folder before the first one is looked for."""
    folder, brace, name = pattern.partition("{")
    folder, slash, start = folder.rpartition("/")
    return f"{found(folder)}{slash}{start}{brace}{name}" if folder else pattern


def _with_outline(beam: Beam, found: Callable[[str], str]) -> Beam:
    if beam.outline is None or not beam.outline.file:
        return beam
    outline = beam.outline.model_copy(update={"file": found(beam.outline.file)})
    return beam.model_copy(update={"outline": outline})


def named_files(config: Config) -> dict[str, str]:
    """Return outline, polars and derivatives that a configuration names, by their keys."""
    named = dict(zip([OUTLINE], config.beam.input_files, strict=False))
    if config.solver == "embedded":
        named |= {f"embedded.polars.{name}": path for name, path in config.embedded.polars.items()}
    if config.solver == "given":
        named |= {f"given.polars.{name}": path for name, path in config.given.polars.items()}
    if config.steady.beam_polar:
        named["steady.beam_polar"] = config.steady.beam_polar
    if config.steady.beam_polar_section:
        named["steady.beam_polar_section"] = config.steady.beam_polar_section
    if config.derivatives.table:
        named["derivatives.table"] = config.derivatives.table
    return named


def check_files(
    config: Config,
    directory: Path | None = None,
    *,
    project: Path | None = None,
    results: Path = Path("results"),
) -> None:
    """Refuse missing files, seen from ``directory`` (by default the working one).

    These are polars, derivatives, the folder that results come from, and the indices of other
    runs' results. An index of this run, in ``results``, is made by its rules and may be missing.
    ``project`` is the folder that :func:`find_files` has searched as well.

    Refused are also braces in a path, since Snakemake would read them as a wildcard, and a folder
    to take results from that holds far more than results.

    Raises
    ------
    ConfigError
        With one line for each of them.
    """
    directory = directory or Path.cwd()
    elsewhere = project is not None and not _is_same(project, directory)
    seen = f"{directory} or {project}" if elsewhere else str(directory)
    named = named_files(config)
    problems = [
        Problem(key, path, _advice(path, directory, seen, key))
        for key, path in named.items()
        if not (path == FLAT_PLATE and key.startswith(_POLARS)) and not _is_file(directory / path)
    ]
    if config.reuse and not _is_folder(directory / config.reuse):
        otherwise = 'or "" to compute every case' if config.compute else "where compute is false"
        if not config.compute or config.reuse != _USUAL_REUSE:
            problems.append(
                Problem(
                    "reuse",
                    config.reuse,
                    f"no such folder, seen from {seen}; allowed is a folder with results, "
                    f"{otherwise}",
                )
            )
    elif config.reuse and holds_more_than(directory / config.reuse, MOST_KEPT):
        problems.append(
            Problem(
                "reuse",
                config.reuse,
                f"holds more than {MOST_KEPT:,} files and folders, which would all be looked "
                "through; allowed is a folder with results alone, as results/reference is",
            )
        )
    own = directory / results / config.run
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


def _is_same(one: Path, other: Path) -> bool:
    try:
        return one.samefile(other)
    except OSError:
        return False


def _is_there(path: Path) -> bool:
    return _is_file(path) or _is_folder(path)


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


def _advice(polar: str, directory: Path, seen: str, key: str) -> str:
    place = directory / polar
    built_in = key.startswith(_POLARS)
    what = "a folder" if "\0" not in polar and place.is_dir() else "no such file"
    allowed = f"a CSV file or {FLAT_PLATE}" if built_in else "a CSV file"
    if key == OUTLINE:
        return f"{what}, seen from {seen}; allowed is an airfoil (.dat) or a polygon (.csv)"
    answer = f"{what}, seen from {seen}; allowed is {allowed}"
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
