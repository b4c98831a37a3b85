"""Validation of the keys that Snakemake hands over, with one line for each problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from equisection.config.model import Config
from equisection.errors import ConfigError
from equisection.keys.checks import DisagreementError, Path, Problem, disagreements
from equisection.keys.group import WHOLE, KeyGroup

#: Most problems that are told at once.
MOST_LINES = 12


def load_config(raw: Mapping[str, Any]) -> Config:
    """Return the validated configuration.

    Raises
    ------
    ConfigError
        With one line for each problem: the key's path, the value found, what is allowed.
    """
    if not isinstance(raw, Mapping):
        problem = Problem("", raw, "allowed is a file of sections, as config/config.yaml is")
        raise ConfigError(problem.line)
    try:
        return Config.model_validate(dict(raw), context=WHOLE)
    except ValidationError as error:
        problems = _problems(raw, error.errors(include_url=False))
    lines = list(dict.fromkeys(problem.line for problem in problems))
    if len(lines) > MOST_LINES:
        lines[MOST_LINES:] = [f"config: and {len(lines) - MOST_LINES} more; mend these first"]
    raise ConfigError("\n".join(lines))


def resolve_config(config: Config) -> dict[str, Any]:
    """Return the configuration with every default filled in, in builtin types only."""
    return config.model_dump(mode="json")


def _problems(raw: Mapping[str, Any], errors: Sequence[ErrorDetails]) -> list[Problem]:
    """Return what is wrong with values, then what the right ones do not agree on."""
    first = errors[0].get("ctx", {}).get("error")
    if isinstance(first, DisagreementError):
        return first.problems
    # Only a wrong configuration needs the schema for its words.
    from equisection.config.messages import meant_key, path_of, problem_of  # noqa: PLC0415

    errors = [error for error in errors if not _follows_from_others(error, errors)]
    wrong = [_field_of(path_of(error)) for error in errors]
    meant = [path for error in errors if (path := meant_key(error))]
    sound = _without(raw, wrong)
    problems = [problem_of(error) for error in errors]
    try:
        config = Config.model_validate(sound, context={**WHOLE, "values_only": True})
    except ValidationError:
        return problems
    return problems + disagreements(config, [*wrong, *meant])


def _follows_from_others(error: ErrorDetails, errors: Sequence[ErrorDetails]) -> bool:
    """Tell whether a list is short only because some of its entries were refused."""
    depth = len(error["loc"])
    return error["type"] == "too_short" and any(
        len(other["loc"]) > depth and other["loc"][:depth] == error["loc"] for other in errors
    )


def _field_of(path: Path) -> Path:
    """Return the path down to the key that has a default, for instance to a whole list."""
    section: type[BaseModel] | None = Config
    for depth, part in enumerate(path, start=1):
        field = section.model_fields.get(str(part)) if section else None
        section = _section_in(field.annotation) if field else None
        if section is None:
            return path[:depth]
    return path


def _section_in(annotation: Any) -> type[BaseModel] | None:
    """Return the section that an annotation holds, alone or with ``None``."""
    kinds = [kind for kind in get_args(annotation) or (annotation,) if kind is not type(None)]
    if len(kinds) == 1 and isinstance(kinds[0], type) and issubclass(kinds[0], KeyGroup):
        return kinds[0]
    return None


def _without(raw: Mapping[Any, Any], paths: Sequence[Path]) -> dict[Any, Any]:
    """Return a copy without the keys at some paths."""
    dropped = {path[0] for path in paths if len(path) == 1}
    kept: dict[Any, Any] = {}
    for key, value in raw.items():
        below = [path[1:] for path in paths if len(path) > 1 and path[0] == key]
        if key not in dropped:
            kept[key] = _without(value, below) if below and isinstance(value, Mapping) else value
    return kept
