"""YAML that holds plain data alone: no value with another meaning than its writer's.

YAML 1.1 reads ``1:30`` as 90, ``010`` as 8, ``1_0`` as 10 and ``on`` as true; its aliases may stand
for themselves or for billions of values.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import yaml

from equisection.keys.written_number import is_plain_number

#: Most keys and values of a file, aliases written out; the largest example has a hundred.
MOST_VALUES = 10_000
#: Most sections or lists inside each other; the configuration has five.
DEEPEST = 30
_YAML = "tag:yaml.org,2002:"
_PLAIN = {f"{_YAML}{name}" for name in ("null", "bool", "int", "float", "str", "seq", "map")}
_NUMBERS = {f"{_YAML}int": "a whole number", f"{_YAML}float": "a number"}
_KEYS = {
    f"{_YAML}null": "nothing",
    f"{_YAML}bool": "true or false",
    f"{_YAML}timestamp": "a date",
    **_NUMBERS,
}
_SHOWN = 40


class Oddity(NamedTuple):
    """A value with another meaning than its writer's: path of its key, line, and words."""

    key: str
    line: int
    words: str


class BoundError(yaml.composer.ComposerError):
    """A document is YAML, and has more values or levels than a configuration needs."""


class PlainLoader(yaml.SafeLoader):
    """Loader that refuses too many values, too deep nesting, and aliases of what holds them."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._values = 0
        self._depth = 0
        self._sizes: dict[str, int] = {}
        self._open: set[str] = set()

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Return the next node.

        Raises
        ------
        BoundError
            With the place, if a bound is passed or an alias stands for what holds it.
        """
        event = self.peek_event()  # type: ignore[no-untyped-call]
        mark, anchor = event.start_mark, event.anchor
        if isinstance(event, yaml.AliasEvent):
            if anchor in self._open:
                raise _refused(f"the alias *{_cut(anchor)} stands for what holds it", mark)
            self._count(self._sizes.get(anchor, 1), mark)
            return super().compose_node(parent, index)
        before = self._values
        self._count(1, mark)
        self._depth += 1
        if self._depth > DEEPEST:
            raise _refused(f"is nested more than {DEEPEST} deep", mark)
        if anchor is not None:
            self._open.add(anchor)
        node = super().compose_node(parent, index)
        self._depth -= 1
        if anchor is not None:
            self._open.discard(anchor)
            self._sizes[anchor] = self._values - before
        return node

    def _count(self, number: int, mark: yaml.Mark) -> None:
        self._values += number
        if self._values > MOST_VALUES:
            raise _refused(f"holds more than {MOST_VALUES} keys and values", mark)


def oddities(node: yaml.Node | None, above: str = "") -> Iterator[Oddity]:
    """Give each key and value of a document that is no plain data as it is written.

    Refused are numbers in another form than decimal, keys that are no text, and tags of dates,
    binary data, sets and objects.
    """
    if node is None:
        return
    line = node.start_mark.line + 1
    if node.tag not in _PLAIN:
        yield Oddity(above, line, f"{_tag(node)}; allowed are plain values: put it in quotes")
    elif node.tag in _NUMBERS and not is_plain_number(node.value):
        yield Oddity(
            above,
            line,
            f"{_written(node)} is no decimal number; write it with the digits 0 to 9, as 90 or "
            "1.5e3, or in quotes if it is a text",
        )
    if isinstance(node, yaml.SequenceNode):
        for place, item in enumerate(node.value):
            yield from oddities(item, _joined(above, str(place)))
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if key.tag == f"{_YAML}merge":
                yield from oddities(value, above)
                continue
            if key.tag in _KEYS:
                yield Oddity(
                    _joined(above, str(key.value)),
                    key.start_mark.line + 1,
                    f"the key {_written(key)} is {_KEYS[key.tag]} in YAML; allowed are the keys "
                    "that config/README.md lists, and names in quotes",
                )
            yield from oddities(value, _joined(above, str(key.value)))


def _joined(above: str, name: str) -> str:
    short = _cut(name)
    return f"{above}.{short}" if above else short


def _written(node: yaml.Node) -> str:
    return f"'{_cut(node.value)}'"


def _cut(text: str) -> str:
    if len(text) <= _SHOWN:
        return text
    return f"{text[:_SHOWN]}... ({len(text)} characters)"


def _tag(node: yaml.Node) -> str:
    known = {f"{_YAML}timestamp": "is a date in YAML", f"{_YAML}value": "is no value"}
    return known.get(node.tag, f"has the tag {_cut(node.tag.replace(_YAML, '!!'))}")


def _refused(words: str, mark: yaml.Mark) -> BoundError:
    return BoundError(None, None, words, mark)
