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

    def has_beam_of(self, outline: object) -> bool:
        """Tell whether the solver runs the beam, and not its section alone, of an outline."""
        del outline
        return True
