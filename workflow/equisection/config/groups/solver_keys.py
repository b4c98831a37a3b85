"""Base of the sections of solvers: what the workflow asks of one before any job starts."""

from __future__ import annotations

from pathlib import Path

from equisection.keys.group import KeyGroup


class SolverKeys(KeyGroup):
    """Base of the section of a solver, which reads no file, takes one thread, and runs anywhere."""

    def input_files(self) -> list[str]:
        """Return the files that the solver reads."""
        return []

    @property
    def said_basis(self) -> str:
        """Basis of its results, where the configuration says so; empty where the solver does."""
        return ""

    def threads(self, dimension: str) -> int:
        """Return the threads of a job that runs cases of a dimension."""
        del dimension
        return 1

    def environment(self) -> dict[str, str]:
        """Return variables by which jobs find the solver on a machine; no part of a case."""
        return {}

    def refuses_folder(self, folder: Path) -> str:
        """Return why the solver cannot work in a folder; empty if it can."""
        del folder
        return ""

    def runs_rigid_beam(self, outline: object, models: tuple[str, ...]) -> bool:
        """Tell whether the rigid beam is run too, for an outline and the models of the sweep."""
        del outline, models
        return True
