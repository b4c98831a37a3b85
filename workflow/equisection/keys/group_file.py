"""One section of a configuration file, read by itself."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import ValidationError
from pydantic_core import ErrorDetails

from equisection.errors import ConfigError
from equisection.keys.group import KeyGroup
from equisection.keys.repeated_keys import check_repeated_keys
from equisection.keys.shown import shown

Group = TypeVar("Group", bound=KeyGroup)


def read_group(path: Path, name: str, group: type[Group]) -> Group:
    """Return a section of a configuration file; keys that it lacks are at their defaults.

    Other sections of the file are not looked at.

    Parameters
    ----------
    path
        The file.
    name
        Name of the section.
    group
        Its model.

    Raises
    ------
    ConfigError
        The file cannot be read, is no YAML in UTF-8 or has no such section; or, with one line for
        each problem, a key of the section is not allowed.
    """
    values = _section(path, name)
    check_repeated_keys([path])
    try:
        return group.model_validate(values)
    except ValidationError as error:
        lines = [_line(problem, name, group) for problem in error.errors(include_url=False)]
    raise ConfigError("\n".join(f"{path}: {line}" for line in lines))


def _section(path: Path, name: str) -> Any:
    """Return the values of a section as YAML has them."""
    wanted = f"give a configuration file with a section '{name}', as config/config.yaml is"
    try:
        raw = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read ({error.strerror}); {wanted}") from None
    except UnicodeDecodeError as error:
        raise ConfigError(
            f"{path}: is no text in UTF-8 (byte {error.start}); save it as UTF-8"
        ) from None
    except yaml.YAMLError as error:
        why = " ".join(str(error).split())
        raise ConfigError(f"{path}: is no YAML ({why}); {wanted}") from None
    if not isinstance(raw, Mapping):
        raise ConfigError(f"{path}: {shown(raw)}: is no file of sections; {wanted}")
    if name not in raw:
        there = ", ".join(str(key) for key in raw) or "nothing"
        raise ConfigError(f"{path}: has no section '{name}' (there is {there}); {wanted}")
    return raw[name]


def _line(problem: ErrorDetails, name: str, group: type[KeyGroup]) -> str:
    """Return a problem in one line: the key's path, the value found, what is allowed."""
    if problem["type"] == "value_error" and not problem["loc"]:  # of keys that do not agree
        return str(problem["ctx"]["error"])
    key = ".".join(str(part) for part in (name, *problem["loc"]))
    found = f"{key}: {shown(problem['input'])}"
    if problem["type"] == "extra_forbidden":
        inside = group.model_fields if len(problem["loc"]) == 1 else ()
        allowed = f"; allowed here are {', '.join(inside)}" if inside else ""
        return f"{found}: unknown key{allowed}"
    if problem["type"] == "missing":
        return f"{key}: missing; it is needed"
    if problem["type"] == "value_error":
        return f"{found}: {problem['ctx']['error']}"
    message = problem["msg"]
    return f"{found}: {message[0].lower()}{message[1:]}"
