"""Beams of a map on fewer strips and with fewer modes, by which its mesh is judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import xarray as xr

from equisection.analysis.mapped_models import MappedModel, body_of_model
from equisection.config import Config
from equisection.keys.group import KeyGroup
from equisection.motion.body_in_flow import BodyInFlow
from equisection.solvers.registry import solver_from_config
from equisection.study import plan
from equisection.study.axes import AsGiven

STRIPS, MODES = "strips", "modes"
#: Fewest strips along a span that has a distribution of its loads.
FEWEST = 2


@dataclass(frozen=True)
class CoarserBody:
    """Beam with less of something.

    Attributes
    ----------
    parameter
        :data:`STRIPS` or :data:`MODES`.
    number, less
        Number of them in the map, and how many of them are left out.
    body
        The beam without these.
    """

    parameter: str
    number: int
    less: int
    body: BodyInFlow


def coarser_bodies(
    models: Sequence[MappedModel],
    config: Config,
    data: Mapping[str, xr.Dataset],
    given: AsGiven,
) -> dict[str, tuple[CoarserBody, ...]]:
    """Return beams with half the strips, and with one mode of each kind less, by their models.

    A section has neither, and a last mode of a kind stays. Parameters are those of
    :func:`.mapped_models.mapped_models`.
    """
    found = {}
    for model in models:
        if model.lines and plan.model(model.name, config.reduction).dimension == "3d":
            found[model.name] = tuple(_coarser(model.name, config, data, given))
    return found


def _coarser(
    name: str, config: Config, data: Mapping[str, xr.Dataset], given: AsGiven
) -> list[CoarserBody]:
    strips, structure = config.embedded.strips, config.structure
    wanted: list[tuple[str, int, int, dict[str, KeyGroup]]] = []
    if strips // 2 >= FEWEST:
        fewer = config.embedded.model_copy(update={"strips": strips // 2})
        wanted.append((STRIPS, strips, strips - strips // 2, {"embedded": fewer}))
    numbers = {key: getattr(structure, key) for key in ("bending_modes", "torsion_modes")}
    kept = {key: max(1, number - 1) for key, number in numbers.items()}
    left_out = sum(numbers.values()) - sum(kept.values())
    if left_out:
        without = structure.model_copy(update=kept)
        wanted.append((MODES, sum(numbers.values()), left_out, {"structure": without}))
    found = []
    for parameter, number, less, update in wanted:
        coarse = config.model_copy(update=update)
        solver = solver_from_config(coarse, coarse.steady.resolution)
        body = body_of_model(coarse, name, data, solver, given)
        if isinstance(body, BodyInFlow):
            found.append(CoarserBody(parameter, number, less, body))
    return found
