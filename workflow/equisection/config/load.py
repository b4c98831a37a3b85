"""Validate what Snakemake hands over, and say what is wrong with it in one line a problem."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from equisection.config.model import Config
from equisection.errors import ConfigError

#: Tags of unions; they are no part of a key's path.
_TAGS = frozenset({"list", "range"})
#: A model's own check starts its message with the path of the key that is wrong.
_OWN_PATH = re.compile(r"^(?P<key>[a-z0-9_.]+): (?P<rest>.*)$", re.DOTALL)


def load_config(raw: Mapping[str, Any]) -> Config:
    """Return the validated configuration.

    Raises
    ------
    ConfigError
        With one line for each problem: the key's path, the value found, what is allowed.
    """
    try:
        return Config.model_validate(dict(raw))
    except ValidationError as error:
        lines = sorted({_line(problem) for problem in error.errors()})
        raise ConfigError("\n".join(lines)) from None


def resolve_config(config: Config) -> dict[str, Any]:
    """Return the configuration with every default filled in, in builtin types only."""
    return config.model_dump(mode="json")


def _line(problem: ErrorDetails) -> str:
    path = ".".join(str(part) for part in problem["loc"] if part not in _TAGS)
    if problem["type"] == "value_error":
        message = str(problem["ctx"]["error"])
        own = _OWN_PATH.match(message)
        if own:
            path = f"{path}.{own['key']}" if path else own["key"]
            return f"config: {path}: {own['rest']}"
        return f"config: {path}: {message}"
    if problem["type"] == "extra_forbidden":
        return f"config: {path}: unknown key; allowed here: {_allowed_keys(problem['loc'])}"
    if problem["type"] == "missing":
        return f"config: {path}: missing; it has no default"
    if problem["type"] in ("model_type", "model_attributes_type", "dict_type"):
        return f"config: {path}: {problem['input']!r}: a section with keys is allowed here"
    return f"config: {path}: {problem['input']!r}: {_allowed(problem['msg'])}"


def _allowed(message: str) -> str:
    return re.sub(r"^Input should be (a |an )?", "allowed is ", message)


def _allowed_keys(loc: tuple[int | str, ...]) -> str:
    """Return the keys of the section that holds the unknown one."""
    model: Any = Config
    for part in loc[:-1]:
        if part in _TAGS or isinstance(part, int):
            continue
        field = model.model_fields.get(part)
        if field is None:
            break
        model = _section_in(field.annotation) or model
    return ", ".join(model.model_fields)


def _section_in(annotation: Any) -> Any:
    """Return the section that an annotation holds, for instance in ``Channel | None``."""
    if hasattr(annotation, "model_fields"):
        return annotation
    for argument in getattr(annotation, "__args__", ()):
        found = _section_in(argument)
        if found is not None:
            return found
    return None
