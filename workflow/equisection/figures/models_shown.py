"""Models of a sweep that have their histories shown. The rules ask too, so this loads nothing."""

from __future__ import annotations

from collections.abc import Sequence


def section_model(models: Sequence[str]) -> str | None:
    """Return the 2D model whose histories are shown: the corrected one before the plain one."""
    sections = [name for name in models if name.startswith("2d")]
    wanted = [name for name in ("2d-corrected", "2d") if name in sections]
    return next(iter([*wanted, *sections]), None)


def beam_model(models: Sequence[str]) -> str | None:
    """Return the 3D model, if it is run."""
    return "3d" if "3d" in models else None
