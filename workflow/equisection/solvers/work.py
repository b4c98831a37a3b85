"""Upper bound on the work of a job, from which its memory and time follow.

A solver gives it from the configuration alone, so that the graph is built on a fresh clone.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from equisection.config import Config


@dataclass(frozen=True)
class Work:
    """Work of the longest run of a job.

    Attributes
    ----------
    cells
        Cells of the mesh, or their counterpart in the solver, of all cases of the job.
    iterations
        Iterations of a steady solver.
    steps
        Time steps, times the iterations that each is expected to take.
    """

    cells: float
    iterations: float = 0.0
    steps: float = 0.0


class Estimate(Protocol):
    """Protocol of a solver's module of work: a function for each kind of case that it runs."""

    def steady_work(self, config: Config, dimension: str, resolution: str, cases: int) -> Work:
        """Return the work of a job of rigid cases at a resolution."""
        ...

    def unsteady_work(self, config: Config, dimension: str, resolution: str, cases: int) -> Work:
        """Return the work of a job of free cases at a resolution."""
        ...
