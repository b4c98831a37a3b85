"""Words for the values that a key allows, from the JSON schema, for errors and reference alike."""

from __future__ import annotations

from functools import cache
from typing import Any

from equisection.config.model import Config
from equisection.keys.values import NAME_PATTERN

Fragment = dict[str, Any]

_NAME = (
    "a name of letters, digits, '_', '-' and single dots inside, 64 at most, "
    "that starts with a letter or a digit"
)


@cache
def schema() -> Fragment:
    """Return the JSON schema of the configuration."""
    return Config.model_json_schema()


def resolved(fragment: Fragment) -> Fragment:
    """Return a fragment with its reference followed."""
    reference = fragment.get("$ref")
    definitions: dict[str, Fragment] = schema()["$defs"]
    return definitions[reference.rpartition("/")[2]] if reference else fragment


def alternatives(fragment: Fragment) -> list[Fragment]:
    """Return the alternatives of a fragment, one or more, including ``null``."""
    fragment = resolved(fragment)
    choices = fragment.get("anyOf") or fragment.get("oneOf")
    return [resolved(choice) for choice in choices] if choices else [fragment]


def allowed(fragment: Fragment) -> str:
    """Return the allowed values of a fragment, for instance ``a number above 0, or null``."""
    return ", or ".join(_allowed(choice) for choice in alternatives(fragment))


def _allowed(fragment: Fragment) -> str:
    if "enum" in fragment:
        return "one of " + ", ".join(map(str, fragment["enum"]))
    if "const" in fragment:
        return str(fragment["const"])
    kinds = {
        "null": _null,
        "boolean": _truth,
        "integer": _number,
        "number": _number,
        "array": _list,
        "object": _section,
        "string": _text,
    }
    return kinds[fragment["type"]](fragment)


def _null(_: Fragment) -> str:
    return "null"


def _truth(_: Fragment) -> str:
    return "true or false"


def _number(fragment: Fragment) -> str:
    word = "a whole number" if fragment["type"] == "integer" else "a number"
    low, high = fragment.get("minimum"), fragment.get("maximum")
    if low is not None and high is not None:
        return f"{word} from {low:g} to {high:g}"
    bounds = [
        f"{relation} {fragment[bound]:g}"
        for bound, relation in (
            ("exclusiveMinimum", "above"),
            ("minimum", "of at least"),
            ("exclusiveMaximum", "below"),
            ("maximum", "of at most"),
        )
        if bound in fragment
    ]
    return " ".join([word, " and ".join(bounds)]).strip()


def _text(fragment: Fragment) -> str:
    return _NAME if fragment.get("pattern") == NAME_PATTERN else "text"


def _list(fragment: Fragment) -> str:
    fewest = fragment.get("minItems", 0)
    count = f" of {fewest} or more" if fewest else ", also an empty one"
    return f"a list{count}, each {allowed(fragment['items'])}"


def _section(fragment: Fragment) -> str:
    if "properties" in fragment:
        return f"a section with the keys {', '.join(fragment['properties'])}"
    return "a section of one or more pairs `name: text`"
