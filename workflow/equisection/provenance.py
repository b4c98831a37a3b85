"""Origin of a file: version and commit of equisection, configuration, command."""

from __future__ import annotations

import hashlib
import os
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import yaml

import equisection

#: Environment variables by which the workflow tells its jobs. They are no parameters of a rule, so
#: that another command does not make anything run again.
COMMAND_VARIABLE = "EQUISECTION_COMMAND"
CONFIG_VARIABLE = "EQUISECTION_CONFIG_HASH"
#: Where the package is in a clone of the project.
_PLACE = "workflow/equisection/"
#: Names of the attributes that say what made a file.
ATTRIBUTES = ("equisection_version", "equisection_commit", "config_hash", "command")


@cache
def made_by_this() -> dict[str, str]:
    """Return the origin of the files that this process makes, as attributes.

    ``config_hash`` is empty where no workflow started the process, ``equisection_commit`` where the
    package is not in a clone of the project.
    """
    return {
        "equisection_version": equisection.__version__,
        "equisection_commit": commit_of(Path(equisection.__file__).parent),
        "config_hash": os.environ.get(CONFIG_VARIABLE, ""),
        "command": os.environ.get(COMMAND_VARIABLE) or command_line(sys.argv),
    }


def made_by(attributes: Mapping[str, Any]) -> dict[str, str]:
    """Return the origin of a file from its attributes; an older file lacks some of them."""
    return {name: str(attributes[name]) for name in ATTRIBUTES if name in attributes}


def commit_of(package: Path) -> str:
    """Return the commit of the clone that the package is in, with ``-modified`` if it differs.

    Empty without git, and where the package is not the one of the clone: an environment may be
    inside the repository of something else.
    """
    try:
        prefix = _git(package, "rev-parse", "--show-prefix")
        _git(package, "ls-files", "--error-unmatch", "--", "__init__.py")
        if prefix.strip() != _PLACE:
            return ""
        commit = _git(package, "rev-parse", "HEAD").strip()
        changed = _git(package, "status", "--porcelain", "--", ".").strip()
    except (OSError, subprocess.SubprocessError):
        return ""
    return f"{commit}-modified" if changed else commit


def refused_by_git(package: Path) -> str:
    """Return the reason why git refuses the commit of the package's clone, with the remedy.

    Empty without a clone, and where git gives the commit. Git is asked only if the clone belongs to
    another user, since it refuses only then.
    """
    clone = package.parents[1]
    try:
        owners = {clone.stat().st_uid, (clone / ".git").stat().st_uid}
    except OSError:
        return ""
    if owners == {os.geteuid()}:
        return ""
    try:
        _git(clone, "rev-parse", "HEAD")
    except OSError:
        return ""
    except subprocess.SubprocessError as error:
        if "ownership" not in (getattr(error, "stderr", "") or ""):
            return ""
        return (
            f"{clone} belongs to another user and git does not trust it, so no file will say which "
            f"commit made it; 'git config --global --add safe.directory {shlex.quote(str(clone))}' "
            "says that you do"
        )
    return ""


def command_line(words: Sequence[str]) -> str:
    """Return a command as a shell takes it, with the program's name without its folder."""
    if not words:
        return ""
    program = Path(words[0])
    name = program.parent.name if program.name == "__main__.py" else program.name
    return shlex.join([name, *words[1:]])


def config_text(resolved: Mapping[str, Any]) -> str:
    """Return the configuration as ``config.resolved.yaml`` holds it."""
    return yaml.safe_dump(dict(resolved), sort_keys=False)


def config_hash(resolved: Mapping[str, Any]) -> str:
    """Return the SHA-256 of that file, as ``sha256sum config.resolved.yaml`` prints it."""
    return hashlib.sha256(config_text(resolved).encode()).hexdigest()


def file_hash(path: Path) -> str:
    """Return the SHA-256 of a file; empty if it cannot be read."""
    try:
        with path.open("rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError:
        return ""


def _git(folder: Path, *arguments: str) -> str:
    command = ["git", "--no-optional-locks", "-C", str(folder), *arguments]
    environment = {**os.environ, "LC_ALL": "C"}
    return subprocess.run(
        command, capture_output=True, text=True, check=True, timeout=60, env=environment
    ).stdout
