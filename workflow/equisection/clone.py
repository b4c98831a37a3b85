"""Place of the clone that the package is in; an old Python must be able to read it."""

from __future__ import annotations

from pathlib import Path

#: The clone of the project; what it is next to in a package that is installed without one.
CLONE = Path(__file__).resolve().parents[2]


def clone_of_package() -> Path | None:
    """Return the clone that the package is in; none if it is installed without one."""
    return CLONE if (CLONE / "workflow" / "Snakefile").is_file() else None
