"""Sensitivities of the critical speeds of a map, and the interval from what is known of its inputs.

Each parameter with a half-range is varied alone to either end, and the critical speed is found
again. The effects of all add up as the root of the sum of squares, downwards and upwards apart: the
half-ranges are taken as independent and equally likely either way. The worst case has all of
them downwards at once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from equisection.analysis.mapped_models import MappedModel
from equisection.config import Config
from equisection.motion.critical import critical_of
from equisection.motion.onset_sensitivity import FollowedOnset
from equisection.motion.stability_map import MapLine
from equisection.motion.varied_body import BodyParameter, parameters_of
from equisection.solvers.known_error import EIGENVALUE
from equisection.solvers.protocol import HasKnownError, HasKnownSpread, Solver
from equisection.study import plan

#: Columns of ``comparison/sensitivities.csv``, in order.
COLUMNS = (
    "model",
    "incidence_deg",
    "parameter",
    "value",
    "unit",
    "sensitivity",
    "sensitivity_of",
    "half_range",
    "speed_at_less",
    "speed_at_more",
    "source",
)
#: Parameter that is the error of the growth itself.
GROWTH = "growth"
GIVEN = "configuration"
#: Kinds of sensitivity: of a parameter that is never zero, and of one that may be.
RELATIVE, ABSOLUTE = "d ln V/d ln p", "dV/dp (m/s per unit)"
#: Keys of ``uncertainty`` by parameter.
_KEYS = {
    "damping_bending": "damping",
    "damping_torsion": "damping",
    "tau_1": "lags",
    "tau_2": "lags",
    "tau_3": "lags",
    "lift": "lift",
    "moment": "moment",
    GROWTH: GROWTH,
}


@dataclass(frozen=True)
class HalfRange:
    """Half-range of a parameter, as a part of it or in its unit, and its source; 0 for none."""

    size: float = 0.0
    source: str = ""


def half_range(
    config: Config, solver: Solver, dimension: str, parameter: str, incidence_deg: float
) -> HalfRange:
    """Return the half-range of a parameter, by the configuration or by what the solver knows."""
    key = _KEYS.get(parameter)
    if key is None:
        return HalfRange()
    given = getattr(config.uncertainty, key)
    if not isinstance(given, str):
        return HalfRange(given, GIVEN) if given > 0.0 else HalfRange()
    if parameter == GROWTH:
        error = None
        if isinstance(solver, HasKnownError):
            error = solver.known_error(dimension, EIGENVALUE)
        return HalfRange() if error is None else HalfRange(error.rms, str(error))
    spread = None
    if isinstance(solver, HasKnownSpread):
        spread = solver.known_spread(parameter, incidence_deg)
    return HalfRange() if spread is None else HalfRange(spread.half_range, spread.source)


def sensitivity_table(
    models: Sequence[MappedModel], config: Config, solver: Solver
) -> pd.DataFrame:
    """Return ``comparison/sensitivities.csv``: a row for each model, incidence and parameter.

    Parameters
    ----------
    models
        Models of the map; those without an onset have no rows.
    config
        The configuration.
    solver
        The solver of the models.

    Returns
    -------
    pd.DataFrame
        :data:`COLUMNS`. ``sensitivity`` is d ln V/d ln p, of a parameter that may be zero dV/dp, as
        ``sensitivity_of`` says; ``speed_at_less`` and ``speed_at_more`` (m/s) are the critical
        speeds at both ends of the half-range: infinite without an onset up to twice the speed,
        zero where it is unstable at all speeds.
    """
    rows = []
    for model in models:
        dimension = plan.model(model.name, config.reduction).dimension
        for line in model.lines:
            if not math.isfinite(critical_of(line).critical_speed):
                continue
            angle = round(math.degrees(line.incidence_rad), 9)
            ranges = {name: half_range(config, solver, dimension, name, angle) for name in _KEYS}
            found = _rows_of(line, ranges, config.flow.density)
            rows += [{"model": model.name, "incidence_deg": angle, **row} for row in found]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _rows_of(
    line: MapLine, ranges: dict[str, HalfRange], density: float
) -> list[dict[str, object]]:
    onset = FollowedOnset(line)
    rows = [
        _row(onset, one, ranges.get(one.name, HalfRange()), density)
        for one in parameters_of(line.body)
    ]
    known = ranges[GROWTH]
    ends = onset.speeds_at_growth(known.size) if known.size else (math.nan, math.nan)
    if not math.isnan(ends[0]):
        rows.append(
            {
                "parameter": GROWTH,
                "value": 0.0,
                "unit": "V/c",
                "sensitivity": 1.0 / onset.growth_by_speed,
                "sensitivity_of": ABSOLUTE,
                "half_range": known.size,
                "speed_at_less": ends[0],
                "speed_at_more": ends[1],
                "source": known.source,
            }
        )
    return rows


def _row(
    onset: FollowedOnset, parameter: BodyParameter, known: HalfRange, density: float
) -> dict[str, object]:
    derivative = onset.derivative(parameter)
    value = parameter.value(onset.line.body, density)
    less = more = math.nan
    if known.size:
        down = known.size if parameter.by_a_part else min(known.size, max(value, 0.0))
        less = onset.speed_with(parameter, -down) if down else onset.speed
        more = onset.speed_with(parameter, known.size)
    return {
        "parameter": parameter.name,
        "value": value,
        "unit": parameter.unit,
        "sensitivity": derivative / onset.speed if parameter.by_a_part else derivative,
        "sensitivity_of": RELATIVE if parameter.by_a_part else ABSOLUTE,
        "half_range": known.size or math.nan,
        "speed_at_less": less,
        "speed_at_more": more,
        "source": known.source,
    }


@dataclass(frozen=True)
class SpeedInterval:
    """Interval of a critical speed.

    Attributes
    ----------
    low, high
        Its ends (m/s) by the root of the sum of squares; 0 or infinite where it is open.
    worst
        Speed (m/s) with all effects downwards at once.
    """

    low: float
    high: float
    worst: float

    @classmethod
    def of(cls, speed: float, ends: Sequence[tuple[float, float]]) -> SpeedInterval:
        """Return the interval of a speed (m/s) from those at both ends of each half-range (m/s)."""
        effects = np.asarray(ends, dtype=np.float64).reshape(-1, 2) - speed
        if np.isnan(effects).any():
            return cls(math.nan, math.nan, math.nan)
        is_open = bool((effects <= -speed).any())
        lowered = np.minimum(effects.min(axis=1), 0.0)
        raised = np.maximum(effects.max(axis=1), 0.0)
        down, up = np.linalg.norm(lowered), np.linalg.norm(raised)
        return cls(
            0.0 if is_open else max(0.0, speed - float(down)),
            speed + float(up),
            max(0.0, speed + float(lowered.sum())),
        )


def with_intervals(table: pd.DataFrame, sensitivities: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/stability.csv`` with the interval of each critical speed.

    ``speed_from``, ``speed_to`` and ``speed_worst`` (m/s) are those of :class:`SpeedInterval`;
    ``interval_of`` names the parameters that were varied, with those that leave an end open. Empty
    without an onset, and where nothing is known of any parameter.
    """
    varied = sensitivities[sensitivities["half_range"].notna()]
    groups = dict(tuple(varied.groupby(["model", "incidence_deg"])))
    found = []
    for row in table.to_dict("records"):
        part = groups.get((row["model"], row["incidence_deg"]))
        if part is None:
            found.append((math.nan, math.nan, math.nan, ""))
            continue
        ends = list(zip(part["speed_at_less"], part["speed_at_more"], strict=True))
        interval = SpeedInterval.of(row["speed"], ends)
        found.append((interval.low, interval.high, interval.worst, _in_words(part)))
    result = table.copy()
    place = result.columns.get_loc("margin")
    names = ("speed_from", "speed_to", "speed_worst", "interval_of")
    for number, name in enumerate(names, start=1):
        result.insert(place + number, name, [values[number - 1] for values in found])
    return result


def _in_words(part: pd.DataFrame) -> str:
    """Name the parameters of an interval, and why an end of it is open."""
    words = [" + ".join(part["parameter"])]
    ends = part[["speed_at_less", "speed_at_more"]]
    for name, which in (
        ("open below by", (ends == 0.0).any(axis=1)),
        ("open above by", np.isinf(ends).any(axis=1)),
        ("no equilibrium on the polar with", ends.isna().any(axis=1)),
    ):
        if which.any():
            words.append(f"{name} {' + '.join(part.loc[which, 'parameter'])}")
    return "; ".join(words)
