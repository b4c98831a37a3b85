"""Checks of keys that have to agree; each names the keys it reads.

A check runs only when all of its keys hold allowed values, so that a mistake is reported once
and the other checks still speak.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import reduce
from types import SimpleNamespace
from typing import Any

from equisection.keys.shown import shown

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong: the key's path, the value found, and what is allowed."""

    key: str
    value: object
    allowed: str

    @property
    def text(self) -> str:
        """Return the problem in one line."""
        key = self.key if self.key.isprintable() else repr(self.key)
        where = f"{key}: " if key else ""
        return f"{where}{shown(self.value)}: {self.allowed}"

    @property
    def line(self) -> str:
        """Return the problem in one line, as one of the configuration."""
        return f"config: {self.text}"


class DisagreementError(ValueError):
    """Keys do not agree with each other; raised inside validation."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(problem.line for problem in problems))
        self.problems = problems


Check = Callable[..., Iterator[Problem]]
_CHECKS: list[tuple[tuple[str, ...], Check]] = []


def check(*keys: str) -> Callable[[Check], Check]:
    """Register a check, which is called with the values of its keys, in their order."""

    def register(function: Check) -> Check:
        _CHECKS.append((keys, function))
        return function

    return register


def disagreements(config: object, wrong: Collection[Path] = ()) -> list[Problem]:
    """Return the problems that the checks find, without checks of a key that is wrong itself."""
    found: list[Problem] = []
    for keys, function in _CHECKS:
        paths = [tuple(key.split(".")) for key in keys]
        if not any(_overlap(path, other) for path in paths for other in wrong):
            found += _of_one(function, paths, config)
    return found


def disagreements_within(name: str, group: object) -> list[Problem]:
    """Return the problems found by the checks that read keys of one group alone, by its name."""
    whole = SimpleNamespace(**{name: group})
    found: list[Problem] = []
    for keys, function in _CHECKS:
        paths = [tuple(key.split(".")) for key in keys]
        if all(path[0] == name and len(path) > 1 for path in paths):
            found += _of_one(function, paths, whole)
    return found


def _of_one(function: Check, paths: list[tuple[str, ...]], config: object) -> Iterator[Problem]:
    values: list[Any] = [reduce(_attribute, path, config) for path in paths]
    return function(*values)


def _attribute(section: Any, name: str) -> Any:
    """Return a key's value, or nothing inside an optional section that is null."""
    return None if section is None else getattr(section, name)


def _overlap(path: Path, other: Path) -> bool:
    shared = min(len(path), len(other))
    return path[:shared] == other[:shared]
