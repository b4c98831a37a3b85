"""The reference of all keys, a table for each section, from the models."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from equisection.config.load import resolve_config
from equisection.config.model import Config
from equisection.config.words import Fragment, allowed, alternatives, resolved, schema
from equisection.keys.shown import shown

_HEAD = "| key | allowed | default | meaning (unit) |\n|---|---|---|---|"


def reference() -> str:
    """Return the tables of all keys as Markdown."""
    return "\n".join(_tables("", schema(), resolve_config(Config()))).rstrip() + "\n"


def _tables(path: str, section: Fragment, default: object) -> Iterator[str]:
    """Yield the table of a section, then those of the sections inside."""
    yield f"### `{path}`" if path else "### Top level"
    yield f"\n{section['description']}\n\n{_HEAD}"
    defaults: dict[str, Any] = default if isinstance(default, dict) else {}
    inner: list[tuple[str, Fragment, object]] = []
    for name, fragment in section["properties"].items():
        key = f"{path}.{name}" if path else name
        sections = [choice for choice in alternatives(fragment) if "properties" in choice]
        inner += [(key, choice, defaults.get(name)) for choice in sections]
        yield _row(key, fragment, defaults, bool(sections))
    yield ""
    for key, choice, inside in inner:
        yield from _tables(key, choice, inside)


def _row(key: str, fragment: Fragment, defaults: dict[str, Any], is_section: bool) -> str:
    name = key.rpartition(".")[2]
    if name not in defaults and "default" not in fragment:
        default = "none, needed"
    elif name not in defaults:  # of a section that is null by default
        default = f"`{_all_of(fragment['default'])}`"
    elif is_section and isinstance(defaults[name], dict):
        default = "that of its keys"
    else:
        default = f"`{_all_of(defaults[name])}`"
    cells = [f"`{key}`", _allowed(fragment), default, _meaning(fragment)]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _allowed(fragment: Fragment) -> str:
    """Return what is allowed, with the names of a choice as code and sections as such."""
    parts = []
    for choice in alternatives(fragment):
        if "properties" in choice:
            parts.append("a section, see below")
        elif "enum" in choice:
            parts.append(", ".join(f"`{word}`" for word in choice["enum"]))
        else:
            parts.append(allowed(choice))
    return ", or ".join(parts)


def _all_of(value: object) -> str:
    """Return a default in full, in YAML's words."""
    if isinstance(value, list):
        return f"[{', '.join(_all_of(item) for item in value)}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_all_of(item)}" for key, item in value.items()) + "}"
    return value if isinstance(value, str) else shown(value)


def _meaning(fragment: Fragment) -> str:
    """Return a key's description; one that repeats its section's stands there alone."""
    meaning: str = fragment.get("description") or resolved(fragment)["description"]
    return meaning
