"""Files of the project that a command writes from the code, or checks to be up to date."""

from __future__ import annotations

import argparse
import difflib
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from equisection.files import write_text


def write_or_check(
    wanted: Mapping[Path, str],
    root: Path,
    command: str,
    about: str,
    arguments: Sequence[str] | None,
) -> int:
    """Write files that are not as wanted, or with ``--check`` print the difference.

    Parameters
    ----------
    wanted
        Text of each file, by its path from the project's root.
    root
        The project's root.
    command
        Command line that writes them.
    about
        Description of the command.
    arguments
        Its arguments; those of the process if ``None``.

    Returns
    -------
    int
        Exit status: 1 if a file was checked and is outdated.
    """
    parser = argparse.ArgumentParser(prog=command, description=about)
    parser.add_argument("--check", action="store_true", help="change nothing, exit 1 if outdated")
    return write_outdated(wanted, root, command, check=parser.parse_args(arguments).check)


def write_outdated(wanted: Mapping[Path, str], root: Path, command: str, *, check: bool) -> int:
    """Write files that are not as wanted, or only print the difference; return the exit status.

    Parameters are those of :func:`write_or_check`, for a command with further arguments.
    """
    outdated = False
    for path, text in wanted.items():
        file = root / path
        found = file.read_text(encoding="utf-8") if file.is_file() else ""
        if found == text:
            continue
        outdated = True
        if check:
            _print_difference(path, found, text)
        else:
            write_text(file, text)
            print(f"written: {path}")
    if check and outdated:
        print(f"\nThe code has changed; to mend it: {command}", file=sys.stderr)
    return int(check and outdated)


def _print_difference(path: Path, found: str, wanted: str) -> None:
    sys.stdout.writelines(
        difflib.unified_diff(
            found.splitlines(keepends=True),
            wanted.splitlines(keepends=True),
            fromfile=f"{path} (found)",
            tofile=f"{path} (from the code)",
        )
    )
