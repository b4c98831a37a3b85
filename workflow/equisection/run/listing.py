"""The cases of a run, as its case files list them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import yaml

from equisection.cases import Case, case_hash, read_cases
from equisection.config import Config, load_config
from equisection.errors import CaseFileError, ConfigError
from equisection.study import plan


@dataclass(frozen=True)
class Listed:
    """A case of a case file, or what is wrong with the file.

    Attributes
    ----------
    model
        Model of the sweep, or ``steady 2d`` and ``steady 3d``.
    place
        Folder of its result in that of the run.
    hash
        Hash of the case, computed from the file.
    """

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
    """List the cases of a run, steady ones by resolution and incidence, then by model and k*.

    A case that stands in several files, of a batch and of its own, is listed once; one that an
    earlier sweep of the run has left behind is not.
    """
    for dimension in ("2d", "3d"):
        yield from _cases_in(run, f"steady {dimension}", f"steady/{dimension}", _by_angle)
    earlier = _earlier_sweep(run)
    for folder in sorted((run / "cases" / "unsteady").glob("*/")):
        for listed in _cases_in(run, folder.name, f"unsteady/{folder.name}", _by_k_star):
            if not earlier(listed):
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


def _cases_in(
    run: Path, model: str, place: str, order: Callable[[str], tuple[str, float]]
) -> list[Listed]:
    """Return the cases of the case files of a folder."""
    found: dict[str, Listed] = {}
    for file in sorted((run / "cases" / place).glob("*.json")):
        if file.name.startswith("."):
            continue
        try:
            for name, case in read_cases(file).items():
                found[name] = Listed(model, place, file, name, case_hash(case), case)
        except CaseFileError as problem:
            found[file.stem] = Listed(model, place, file, file.stem, problem=str(problem))
    return [found[name] for name in sorted(found, key=order)]


def _by_k_star(name: str) -> tuple[str, float]:
    try:
        return "", plan.k_star_of(name)
    except ValueError:
        return name, math.inf


def _by_angle(name: str) -> tuple[str, float]:
    try:
        return plan.angle_of(name)
    except ValueError:
        return name, math.inf
