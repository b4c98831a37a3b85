"""Digest of the modules that a job is made with, for ``params``: editing one makes it again.

A script names its modules itself, by its imports, and they name theirs, so no rule lists them.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parents[1]
NAME = PACKAGE.name
#: Modules around every script, which decide nothing of what it makes.
AROUND = frozenset({f"{NAME}.run.script"})
#: Imports as the package's sources have them; looked for in the text, since parsing all of it at
#: every start would take ten times as long.
_IMPORT = re.compile(rf"^[ \t]*from ({NAME}[\w.]*) import (\([^)]*\)|[^\n#]*)", re.MULTILINE)
_WORD = re.compile(r"(\w+)(?: as \w+)?")


def source_digest(script: Path, further: Iterable[str] = ()) -> str:
    """Return a digest of the package's modules that a script imports, directly or by others.

    Parameters
    ----------
    script
        The script.
    further
        Modules and packages that are loaded by name, as ``solvers`` or ``figures.response``.

    Raises
    ------
    FileNotFoundError
        There is no module of a name in ``further``.
    """
    found = set(_reached(script)) - {script}
    for name in further:
        for path in _in_package(name):
            found |= _reached(path)
    digest = hashlib.sha256()
    for content in sorted(map(_content, found)):
        digest.update(content)
    return digest.hexdigest()[:16]


@cache
def _reached(source: Path) -> frozenset[Path]:
    """Return a file and all that it imports, whatever imports which (there is no circle)."""
    return frozenset({source}).union(*map(_reached, imported(source)))


@cache
def imported(source: Path) -> tuple[Path, ...]:
    """Return the files of the package that a file imports from, at any place in it.

    Of the package itself only the version is used, which decides nothing here.
    """
    found: dict[Path, None] = {}
    for package, words in _IMPORT.findall(_text(source)):
        for word in _WORD.findall(words):
            module = f"{package}.{word}"
            path = _file(module) or (_file(package) if package != NAME else None)
            if path is not None and not AROUND & {module, package}:
                found[path] = None
    return tuple(found)


@cache
def _text(path: Path) -> str:
    """Return a file's text."""
    return path.read_text(encoding="utf-8")


@cache
def _content(path: Path) -> bytes:
    """Return a digest of one file."""
    return hashlib.sha256(_text(path).encode()).digest()


@cache
def _file(name: str) -> Path | None:
    """Return the file of a module, by its full name; None if there is none."""
    place = PACKAGE.joinpath(*name.split(".")[1:])
    for path in (place.with_suffix(".py"), place / "__init__.py"):
        if path.is_file():
            return path
    return None


def _in_package(name: str) -> list[Path]:
    """Return the files of a module, or of all modules of a package, named from this one."""
    place = PACKAGE.joinpath(*name.split("."))
    if place.is_dir():
        return sorted(place.rglob("*.py"))
    path = place.with_suffix(".py")
    if not path.is_file():
        raise FileNotFoundError(f"{name}: no module of {NAME}, wanted for the digest of a rule")
    return [path]
