"""Cost of the cases of a run that are to come, by the cost model."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from equisection.cases import Kind
from equisection.clone import clone_of_package
from equisection.config import Config
from equisection.errors import ConfigError
from equisection.run import cost
from equisection.run.listing import Listed
from equisection.run.start import here_or_in_project


class CostOfRun:
    """The cost of each case of a run, if it is known.

    Parameters
    ----------
    config
        Configuration of the run.
    model
        File of the cost model (by default the working directory's or that of the clone).
    """

    def __init__(self, config: Config | None, model: Path | None = None) -> None:
        self._config = config
        model = model or here_or_in_project(cost.COST_MODEL, clone_of_package())
        try:
            self._model = cost.read_cost_model(model) if model.is_file() else None
        except ConfigError:
            self._model = None
        self._seconds = cache(self._expected)

    def core_seconds(self, listed: Listed) -> float | None:
        """Return the time of a whole case at most (s); None without a configuration or model."""
        if listed.case is None:
            return None
        case = listed.case
        return self._seconds(case.solver.name, listed.kind, case.dimension, case.resolution)

    def _expected(self, solver: str, kind: Kind, dimension: str, resolution: str) -> float | None:
        config = self._config
        if config is None or self._model is None or config.solver != solver:
            return None
        try:
            work = cost.work_of(config, kind, dimension, resolution)
            return cost.seconds(work, self._model.of(solver, dimension))
        except (ConfigError, KeyError):  # no entry, or a resolution of an earlier configuration
            return None
