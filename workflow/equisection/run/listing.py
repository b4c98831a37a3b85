"""The cases of a run, as its case files list them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml

from equisection.cases import KINDS, Case, Kind, case_hash, read_cases
from equisection.config import Config, load_config
from equisection.errors import CaseFileError, ConfigError
from equisection.study import plan
from equisection.study.axes import Point


@dataclass(frozen=True)
class Listed:
    """A case of a case file, or the problem of the file.

    Attributes
    ----------
    kind
        Kind of the case.
    model
        Model of the sweep, or kind and dimension, as in ``steady 2d``.
    place
        Folder of its result in that of the run.
    hash
        Hash of the case, computed from the file.
    """

    kind: Kind
    model: str
    place: str
    file: Path
    name: str
    hash: str = ""
    case: Case | None = None
    problem: str = ""

    @property
    def result(self) -> str:
        """Its result file, as seen from the folder of the run."""
        return f"{self.place}/{self.name}.nc"


def cases_of_run(run: Path) -> Iterator[Listed]:
    """List the cases of a run: kind by kind, then by model, and along the axes of the study.

    A case in several files, of a batch and of its own, is listed once. One that an earlier sweep of
    the run has left behind is not listed.
    """
    earlier = _earlier_sweep(run)
    for kind in KINDS.values():
        for folder in sorted((run / "cases" / kind.folder).glob("*/")):
            for listed in _cases_in(run, kind, folder.name):
                if not (kind.of_sweep and earlier(listed)):
                    yield listed


def config_of_run(run: Path) -> Config | None:
    """Return the configuration of a run; None if it is not there or not valid any more."""
    try:
        text = (run / "config.resolved.yaml").read_text(encoding="utf-8")
        return load_config(yaml.safe_load(text))
    except (OSError, ValueError, yaml.YAMLError, ConfigError):
        return None


def _earlier_sweep(run: Path) -> Callable[[Listed], bool]:
    """Return what tells whether a case file was left behind by an earlier sweep of the run.

    The run's configuration says which are wanted; of a case file that is newer it knows nothing.
    """
    config = config_of_run(run)
    if config is None:
        return lambda listed: False
    try:
        written = (run / "config.resolved.yaml").stat().st_mtime
        rounds = (run / "comparison" / "refine").glob("*.json")
        refined = [name for chosen in rounds for name in plan.read_refinement(chosen)]
    except (OSError, ValueError, KeyError):
        return lambda listed: False
    wanted = {*plan.sweep_cases(config), *refined}
    return lambda listed: listed.name not in wanted and listed.file.stat().st_mtime < written


def _cases_in(run: Path, kind: Kind, part: str) -> list[Listed]:
    """Return the cases of the case files of a folder, those of an unreadable name at the end."""
    found: dict[str, Listed] = {}
    model, place = kind.model_of(part), f"{kind.folder}/{part}"
    for file in sorted((run / "cases" / place).glob("*.json")):
        if file.name.startswith("."):
            continue
        try:
            for name, case in read_cases(file).items():
                found[name] = Listed(kind, model, place, file, name, case_hash(case), case)
        except CaseFileError as problem:
            found[file.stem] = Listed(kind, model, place, file, file.stem, problem=str(problem))
    return [found[name] for name in sorted(found, key=_order)]


def _order(name: str) -> tuple[bool, str, tuple[float, ...]]:
    try:
        return False, *Point.named(name).order
    except ValueError:
        return True, name, ()
