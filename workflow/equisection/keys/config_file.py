"""Files of a configuration, read as YAML or JSON, with one line for each fault."""

from __future__ import annotations

import codecs
import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import yaml

from equisection.clone import CLONE
from equisection.errors import ConfigError
from equisection.keys.plain_yaml import BoundError, PlainLoader, oddities

#: With this key Snakemake takes values for Python and executes them (its "yte").
_EXECUTES = "__use_yte__"
#: Most bytes of a file, and most lines that it is refused with.
_MOST_BYTES = 1_000_000
_MOST_LINES = 10
_ALLOWED = "allowed is a file of sections, as config/config.yaml is"
#: How files of other encodings begin; UTF-32 first, whose mark begins with that of UTF-16.
_MARKS = {
    codecs.BOM_UTF32_LE: "UTF-32",
    codecs.BOM_UTF32_BE: "UTF-32",
    codecs.BOM_UTF16_LE: "UTF-16",
    codecs.BOM_UTF16_BE: "UTF-16",
}


def read_config_file(path: Path) -> dict[str, Any]:
    """Return the keys of a file of the configuration.

    Raises
    ------
    ConfigError
        The file is missing, a folder, not in UTF-8, neither YAML nor JSON, or holds no sections,
        in one line with file, line and column; or keys occur twice, with one line for each.
    """
    text = _text(path)
    try:
        # the parser in C would be faster, and crash on what is nested a million times
        loader = PlainLoader(text)
        node = loader.get_single_node()
        repeated = list(_repeated(node))
        odd = [_is_odd(path, *oddity) for oddity in oddities(node)]
        content = None if node is None or odd else loader.construct_document(node)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        content, repeated, odd = None if isinstance(error, BoundError) else _json(text), [], []
        if content is None:
            raise ConfigError(f"config: {_place(path, text, error)}") from None
    if odd:
        raise ConfigError("\n".join(_first(path, odd)))
    if not isinstance(content, dict):
        found = "nothing" if content is None else type(content).__name__
        found = {"list": "a list", "str": "a text"}.get(found, found)
        raise ConfigError(f"config: {path}: holds {found}; {_ALLOWED}")
    if repeated:
        raise ConfigError("\n".join(_stands_twice(path, *key) for key in repeated))
    if _EXECUTES in content:
        raise ConfigError(
            f"config: {path}: {_EXECUTES}: Snakemake executes what such a file holds, before this "
            "is looked at; allowed is a file of plain values: take the key out"
        )
    return content


def check_config_files(paths: Iterable[Path]) -> None:
    """Refuse files that cannot be read as a configuration, and keys that occur twice.

    Raises
    ------
    ConfigError
        With a line for each problem.
    """
    problems = []
    for path in paths:
        try:
            read_config_file(path)
        except ConfigError as error:
            problems.append(str(error))
    if problems:
        raise ConfigError("\n".join(problems))


def _in_clone(path: Path) -> str:
    """Return where the project has a file of this relative path, as the end of a sentence."""
    there = CLONE / path
    return f"; the clone has one: {there}" if there.is_file() else ""


def _text(path: Path) -> str:
    if path.is_fifo():
        raise ConfigError(f"config: {path}: is a pipe, which can be read but once; {_ALLOWED}")
    try:
        with path.open("rb") as file:
            content = file.read(_MOST_BYTES + 1)
    except IsADirectoryError:
        raise ConfigError(f"config: {path}: is a folder; {_ALLOWED}") from None
    except FileNotFoundError:
        raise ConfigError(
            f"config: {path}: no such file, seen from {Path.cwd()}; {_ALLOWED}{_in_clone(path)}"
        ) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ConfigError(f"config: {path}: cannot be read ({reason}); {_ALLOWED}") from None
    if len(content) > _MOST_BYTES:
        raise ConfigError(f"config: {path}: is larger than {_MOST_BYTES // 10**6} MB; {_ALLOWED}")
    for mark, encoding in _MARKS.items():
        if content.startswith(mark):
            raise ConfigError(
                f"config: {path}, line 1, column 1: is in {encoding}; save the file in UTF-8"
            )
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        line, column = _line_and_column(content[: error.start].decode("utf-8"))
        letter = chr(content[error.start])
        meant = f" ('{letter}' in Latin-1?)" if letter.isprintable() else ""
        raise ConfigError(
            f"config: {path}, line {line}, column {column}: the byte 0x{ord(letter):02x} is not "
            f"UTF-8{meant}; save the file in UTF-8"
        ) from None


def _line_and_column(before: str) -> tuple[int, int]:
    """Return the place behind a text, both from 1."""
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def _json(text: str) -> Any:
    """Return what JSON holds that is no YAML (indented by tabs); none if it is no JSON either."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return None


def _place(path: Path, text: str, error: Exception) -> str:
    """Return where a file is no YAML, and why, in the parser's words."""
    mark = getattr(error, "problem_mark", None)
    if isinstance(error, yaml.reader.ReaderError):
        line, column = _line_and_column(text[: error.position])
        reason = f"the character {_code(error.character)} is none of YAML's"
    elif isinstance(error, yaml.MarkedYAMLError) and mark is not None:
        line, column, reason = mark.line + 1, mark.column + 1, str(error.problem)
    elif isinstance(error, RecursionError):
        return f"{path}: is nested too deeply; {_ALLOWED}"
    else:
        return f"{path}: a value is no YAML ({error}); put it in quotes"
    tab = text.split("\n")[line - 1][column - 1 : column] == "\t"
    hint = "; indent with blanks, not with tabs" if tab else ""
    fault = "" if isinstance(error, BoundError) else "is no YAML: "
    return f"{path}, line {line}, column {column}: {fault}{reason}{hint}"


def _code(character: int | str | bytes) -> str:
    """Return a character's code, for it may not be one that can be shown."""
    return f"0x{character if isinstance(character, int) else ord(character):02x}"


def _stands_twice(path: Path, key: str, first: int, again: int) -> str:
    return (
        f"config: {key}: stands twice in {path}, in lines {first} and {again}; allowed is each key "
        "once in its section"
    )


def _is_odd(path: Path, key: str, line: int, words: str) -> str:
    where = key if key.isprintable() else repr(key)
    return f"config: {where or 'all of it'}: {words} ({path}, line {line})"


def _first(path: Path, lines: list[str]) -> list[str]:
    """Return the first lines, and the number of those that follow."""
    further = len(lines) - _MOST_LINES
    rest = [f"config: {path}: {further} more values of this sort"] if further > 0 else []
    return lines[:_MOST_LINES] + rest


def _repeated(
    node: yaml.Node | None, above: str = "", seen: set[int] | None = None
) -> Iterator[tuple[str, int, int]]:
    """Give the path of each key that occurs twice, with both of its lines: YAML takes the last.

    A node that aliases repeat is looked at once: there may be billions of them.
    """
    seen = set() if seen is None else seen
    if not isinstance(node, yaml.CollectionNode) or id(node) in seen:
        return
    seen.add(id(node))
    if isinstance(node, yaml.SequenceNode):
        for place, item in enumerate(node.value):
            yield from _repeated(item, f"{above}{place}.", seen)
        return
    lines: dict[str, int] = {}
    for key, value in node.value:
        name, line = str(key.value), key.start_mark.line + 1
        if name in lines:
            yield f"{above}{name}", lines[name], line
        lines.setdefault(name, line)
        yield from _repeated(value, f"{above}{name}.", seen)
