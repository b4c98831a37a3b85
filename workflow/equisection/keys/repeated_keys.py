"""Keys that stand twice in a file of the configuration, of which YAML's readers take the last."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import yaml

from equisection.errors import ConfigError


def check_repeated_keys(paths: Iterable[Path]) -> None:
    """Refuse files in which a key stands twice in one place: the first would be lost unseen.

    Raises
    ------
    ConfigError
        With one line for each such key.
    """
    lines = [
        f"config: {key}: stands twice in {path}, in lines {first} and {again}; allowed is each key "
        "once in its section"
        for path in paths
        for key, first, again in _repeated(_read(path))
    ]
    if lines:
        raise ConfigError("\n".join(lines))


def _read(path: Path) -> yaml.Node | None:
    """Return the nodes of a file; none of what is no YAML, which its reader refuses."""
    try:
        return yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except (OSError, UnicodeDecodeError, yaml.YAMLError):
        return None


def _repeated(node: yaml.Node | None, above: str = "") -> Iterator[tuple[str, int, int]]:
    """Give the path of each key that stands twice, with both of its lines."""
    if isinstance(node, yaml.SequenceNode):
        for place, item in enumerate(node.value):
            yield from _repeated(item, f"{above}{place}.")
    if not isinstance(node, yaml.MappingNode):
        return
    lines: dict[str, int] = {}
    for key, value in node.value:
        name, line = str(key.value), key.start_mark.line + 1
        if name in lines:
            yield f"{above}{name}", lines[name], line
        lines.setdefault(name, line)
        yield from _repeated(value, f"{above}{name}.")
