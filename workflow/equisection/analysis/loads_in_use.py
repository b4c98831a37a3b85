"""Static loads of the air on a body of a map: on its supports, and the largest along its span."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.analysis.mapped_models import MappedModel
from equisection.config import Config
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.stability_map import MapLine
from equisection.motion.strip_system import StripSystem
from equisection.structure.static_loads import StaticLoads, static_loads

Floats = NDArray[np.float64]

#: Columns of ``comparison/reactions.csv``, in order.
COLUMNS = (
    "model",
    "incidence_deg",
    "speed",
    "support",
    "place_m",
    "force_n",
    "bending_moment_nm",
    "torque_nm",
)


def is_there(line: MapLine, speed: float) -> bool:
    """Tell whether a body has an equilibrium at a speed (m/s) that its map looked at."""
    return line.exists and speed < line.path.end_speed and speed <= line.highest


def loads_at_rest(
    body: BodyInFlow, system: StripSystem, equilibrium: tuple[Floats, Floats], config: Config
) -> StaticLoads:
    """Return the loads of the air in equilibrium on the supports of the beam, whatever its modes.

    Parameters
    ----------
    body
        Section or beam. The section of a beam has its loads all along it.
    system
        Its system at the speed of the configuration ``flow.design_speed``, one lane.
    equilibrium
        States Y and deficits u there, shape (1, n) and (1, m).
    config
        The configuration, with the beam and its supports.
    """
    beam, flow = config.beam, config.flow
    assert flow.design_speed is not None, "loads are asked for at the design speed"
    columns = np.concatenate([*equilibrium, np.ones((1, 1))], axis=1)[0]
    strips, structure = system.layout.strips, system.structure
    pressure = 0.5 * flow.density * flow.design_speed**2
    lift = structure.lift_factor[0] * (system.strip_loads[0, :strips] @ columns)
    torque = system.axis_moments[0] @ columns
    edges = np.concatenate([[0.0], np.cumsum(structure.weights)])
    return static_loads(
        beam,
        edges / edges[-1],
        pressure * body.chord * np.asarray(lift),
        pressure * body.chord**2 * np.asarray(torque),
    )


def reactions(models: Sequence[MappedModel], config: Config) -> pd.DataFrame:
    """Return ``comparison/reactions.csv``: static loads of the air on each support.

    A row for each model, incidence and support (:class:`..structure.static_loads.SupportLoad`) at
    the design speed; none where there is no equilibrium.
    """
    design = config.flow.design_speed
    assert design is not None, "the plan asks for it with a design speed alone"
    rows: list[dict[str, Any]] = []
    for model in models:
        for line in model.lines:
            if not is_there(line, design):
                continue
            system, *rest = line.path.system(np.array([design]))
            loads = loads_at_rest(line.body, system, (rest[0], rest[1]), config)
            rows += [
                {
                    "model": model.name,
                    "incidence_deg": round(math.degrees(line.incidence_rad), 9),
                    "speed": design,
                    "support": one.name,
                    "place_m": one.at * config.beam.length,
                    "force_n": one.force,
                    "bending_moment_nm": one.bending_moment,
                    "torque_nm": one.torque,
                }
                for one in loads.supports
            ]
    return pd.DataFrame(rows, columns=list(COLUMNS))
