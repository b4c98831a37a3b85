"""Work of a job of the embedded solver, which has sections in the place of cells."""

from __future__ import annotations

from equisection.config import Config
from equisection.solvers.work import Work

#: Steps in the shortest period of a forced motion: its rates by differences are known to 4e-5.
STEPS = 400
#: The same of a beam, whose rates are given: the motion is linear over a step, within 2e-4.
STEPS_OF_BEAM = 100


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
    shortest = min(config.forced.reduced_velocity)
    steps = STEPS if dimension == "2d" else STEPS_OF_BEAM
    step = min(config.unsteady.time_step, shortest / steps)
    return Work(_sections(config, dimension) * cases, steps=config.forced.longest / step)


def _sections(config: Config, dimension: str) -> int:
    return config.embedded.strips if dimension == "3d" else 1
