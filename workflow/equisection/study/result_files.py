"""Paths of the indices of results that a run is made of: its own, or those that it takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from equisection.study import plan

if TYPE_CHECKING:  # jobs need not build the models of the configuration
    from equisection.config import Config


def indices_of_model(config: Config, folder: str, model: str) -> list[str]:
    """Return the indices of a model's results, of this run or of the one they are taken from.

    Parameters
    ----------
    config
        The configuration.
    folder
        The folder of the run.
    model
        The model, for instance ``2d-corrected``.
    """
    if model in config.sweep.taken:
        return [config.sweep.taken[model]]
    return [f"{folder}/unsteady/{model}/{batch}.json" for batch in plan.batches(config)]


def indices_of_sweep(config: Config, folder: str) -> list[str]:
    """Return the indices of all results of all models."""
    return [
        index for model in config.sweep.shown for index in indices_of_model(config, folder, model)
    ]


def index_of_beam(config: Config, folder: str) -> list[str]:
    """Return the index of the beam's results, if the beam is run or taken."""
    return indices_of_model(config, folder, "3d")[:1] if "3d" in config.sweep.shown else []
