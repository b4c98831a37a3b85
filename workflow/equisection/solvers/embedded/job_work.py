"""Work of a job of the embedded solver, which has sections in the place of cells."""

from __future__ import annotations

from equisection.config import Config
from equisection.solvers.work import Work


def steady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a job of rigid cases: an iteration of each section."""
    del resolution
    return Work(_sections(config, dimension) * cases, iterations=1)


def unsteady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a job of free cases."""
    del resolution
    steps = config.unsteady.duration / config.unsteady.time_step
    return Work(_sections(config, dimension) * cases, steps=steps)


def forced_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a job of forced cases."""
    del resolution
    steps = config.forced.settling + config.forced.periods * max(config.forced.reduced_velocity)
    return Work(_sections(config, dimension) * cases, steps=steps / config.unsteady.time_step)


def _sections(config: Config, dimension: str) -> int:
    return config.embedded.strips if dimension == "3d" else 1
