"""Problems that pydantic found, in the words of the person who wrote the configuration.

Whatever the kind of the error, the message says what the key allows, by the schema.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterator, Mapping, Sequence

from pydantic_core import ErrorDetails

from equisection.config.words import Fragment, allowed, alternatives, resolved, schema
from equisection.keys.checks import Path, Problem
from equisection.keys.values import NAME_PATTERN
from equisection.keys.written_number import LARGEST, SMALLEST, is_of_sensible_size, number_in

#: Parts of pydantic's locations that are no part of a key's path, and the types they choose.
_TAGS = {
    "list": "array",
    "range": "object",
    "auto": "string",
    "count": "integer",
    "known": "string",
    "half-range": "number",
}
_KEY_ITSELF = "[key]"
_STARTS_AS_NUMBER = re.compile(r"\s*[-+]?\.?\d")
#: Digits of any script and base, with what some languages allow between them.
_OTHER_DIGITS = re.compile(r"\s*[-+]?(?:0[xXbBoO][0-9a-fA-F_]+|[\d_:.]+(?:[eE][-+]?\d+)?)\s*")
_DECIMAL_COMMA = re.compile(r"\s*[-+]?\d+,\d+\s*$")
_NAME: Fragment = {"type": "string", "pattern": NAME_PATTERN}


def problem_of(error: ErrorDetails) -> Problem:
    """Return an error of pydantic as a key's path, the value found and what is allowed."""
    kind, loc, value = error["type"], error["loc"], error["input"]
    path, fragment = _find(loc)
    key = ".".join(str(part) for part in path)
    if kind in ("extra_forbidden", "invalid_key"):
        return Problem(key, value, _unknown_key(path, key))
    if kind == "missing":
        return Problem(key, None, f"missing; allowed is {allowed(fragment)}")
    return Problem(key, value, f"allowed is {allowed(fragment)}{_hint(value, fragment)}")


def meant_key(error: ErrorDetails) -> Path | None:
    """Return the path of the key that was most likely meant by an unknown one."""
    if error["type"] != "extra_forbidden":
        return None
    path, _ = _find(error["loc"])
    near = _nearest(str(path[-1]), _keys_beside(path))
    return (*path[:-1], near) if near else None


def path_of(error: ErrorDetails) -> Path:
    """Return the path of the key that an error is about."""
    return _find(error["loc"])[0]


def _find(loc: Path) -> tuple[Path, Fragment]:
    """Follow a location through the schema; return the key's path and its fragment."""
    path: list[str | int] = []
    fragment = schema()
    for place, part in enumerate(loc):
        choices = [choice for choice in alternatives(fragment) if choice.get("type") != "null"]
        if len(choices) > 1 and part in _TAGS:
            if place + 1 < len(loc):
                fragment = next(c for c in choices if c["type"] == _TAGS[str(part)])
            continue
        if part == _KEY_ITSELF and place + 1 == len(loc):
            return tuple(path), _NAME
        path.append(part)
        fragment = _child(choices[0], part)
    return tuple(path), fragment


def _child(fragment: Fragment, part: str | int) -> Fragment:
    if isinstance(part, int) and "items" in fragment:
        return resolved(fragment["items"])
    patterns: dict[str, Fragment] = fragment.get("patternProperties", {})
    for child in patterns.values():
        return child
    further = fragment.get("additionalProperties")
    other = further if isinstance(further, dict) else {}
    child = fragment.get("properties", {}).get(part, other)
    return child if child.get("description") else resolved(child)


def _unknown_key(path: Path, key: str) -> str:
    beside = _keys_beside(path)
    near = _nearest(str(path[-1]), beside)
    answer = f"unknown key; allowed here are {', '.join(beside)}"
    if near:
        return f"{answer}; did you mean '{near}'?"
    known = dict.fromkeys(_all_keys(schema()))
    if key in known:
        section, _, name = key.rpartition(".")
        return f"{answer}; write '{name}' inside the section '{section}'"
    elsewhere = [other for other in known if other.rpartition(".")[2] == path[-1]]
    return f"{answer}; did you mean {' or '.join(elsewhere)}?" if elsewhere else answer


def _keys_beside(path: Path) -> list[str]:
    section: Fragment = schema()
    for part in path[:-1]:
        choices = alternatives(section)
        section = _child(next(c for c in choices if c.get("type") in ("object", "array")), part)
    for choice in alternatives(section):
        if "properties" in choice:
            return list(choice["properties"])
    return []


def _all_keys(fragment: Fragment, prefix: str = "") -> Iterator[str]:
    for choice in alternatives(fragment):
        for name, child in choice.get("properties", {}).items():
            yield prefix + name
            yield from _all_keys(child, f"{prefix}{name}.")


def _nearest(word: str, words: Sequence[str]) -> str | None:
    found = difflib.get_close_matches(word.lower(), words, n=1, cutoff=0.6)
    return found[0] if found else None


def _hint(value: object, fragment: Fragment) -> str:
    """Return a next step for the mistakes that are made most."""
    kinds = {choice.get("type") for choice in alternatives(fragment) if "const" not in choice}
    if value is None:
        return "; leave the key out for its default"
    if kinds & {"number", "integer"}:
        return _number_hint(value)
    if isinstance(value, str):
        choices: list[str] = next((c["enum"] for c in alternatives(fragment) if "enum" in c), [])
        near = _nearest(value, choices)
        if near:
            return f"; did you mean '{near}'?"
        if "array" in kinds:
            return "; a list is written [a, b]"
    elif "string" in kinds and not isinstance(value, list | Mapping):
        return "; put it in quotes"
    return ""


def _number_hint(value: object) -> str:
    if not isinstance(value, str):
        return _size_hint(value)
    if _DECIMAL_COMMA.match(value):
        return "; write decimals with a point"
    try:
        return _size_hint(number_in(value))
    except ValueError:
        pass
    if _OTHER_DIGITS.fullmatch(value):
        return "; write it as a plain decimal with the digits 0 to 9, as 90 or 1.5e3"
    return "; write it without its unit" if _STARTS_AS_NUMBER.match(value) else ""


def _size_hint(value: object) -> str:
    if not isinstance(value, int | float) or isinstance(value, bool):
        return ""
    if isinstance(value, float) and not math.isfinite(value):
        return ", neither infinite nor NaN"
    if is_of_sensible_size(value):
        return ""
    return f", in size from {SMALLEST:g} to {LARGEST:g}"
