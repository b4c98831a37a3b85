"""Sensitivities of the critical speeds of a map, and the interval from what is known of its inputs.

Each parameter with a half-range is varied alone to either end, and the critical speed is found
again. The effects of all add up as the root of the sum of squares, downwards and upwards apart: the
half-ranges are taken as independent and equally likely either way. The worst case has all of
them downwards at once.

Strips and modes of a beam are no quantities: there the half-range is how far the critical speed
moves on half the strips, or with one mode of each kind less. The first is the error by Roache's
index of two meshes, with its factor of 3 and the second order of the strips (J. Fluids Eng. 116,
1994); a further mode moves it by less than the last one did.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.analysis.coarser_bodies import CoarserBody
from equisection.analysis.mapped_models import MappedModel
from equisection.config import Config
from equisection.motion.critical import critical_of
from equisection.motion.onset_sensitivity import FollowedOnset
from equisection.motion.varied_body import BodyParameter, parameters_of
from equisection.solvers.known_error import EIGENVALUE
from equisection.solvers.protocol import HasKnownError, HasKnownSpread, Solver
from equisection.study import plan

Floats = NDArray[np.float64]
Row = dict[str, Any]

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
    "lowers",
    "raises",
    "share",
    "source",
    "note",
)
#: Parameter that is the error of the growth itself.
GROWTH = "growth"
GIVEN = "configuration"
#: Kinds of sensitivity: of a parameter that is never zero, and of one that may be.
RELATIVE, ABSOLUTE = "d ln V/d ln p", "dV/dp (m/s per unit)"
#: Parameter that is the error of the mesh where it is given.
MESH = "mesh"
#: Part of the speed from which on, as half of the interval by the error of the growth alone, a
#: slope at the onset says little.
LITTLE = 0.5
#: Usual half-ranges of what a beam is made of, as parts, with their sources.
_STIFFNESS = (0.03, "usual: E of rolled steel (JCSS Probabilistic Model Code, 2001)")
_WEIGHT = (0.02, "usual: assumed")
_USUAL = {
    "mass": _WEIGHT,
    "inertia": _WEIGHT,
    "bending_stiffness": _STIFFNESS,
    "torsional_stiffness": _STIFFNESS,
}
#: Keys of ``uncertainty`` by parameter.
_KEYS = {
    "mass": "mass",
    "inertia": "inertia",
    "k_w": "bending_stiffness",
    "k_theta": "torsional_stiffness",
    "mass_axis": "mass_axis",
    "elastic_axis": "elastic_axis",
    "damping_bending": "damping",
    "damping_torsion": "damping",
    "tau_1": "lags",
    "tau_2": "lags",
    "tau_3": "lags",
    "lift": "lift",
    "moment": "moment",
    "drag": "drag",
    "density": "density",
    GROWTH: GROWTH,
    MESH: MESH,
}
#: Parameters that are never below zero.
_NEVER_NEGATIVE = ("damping_bending", "damping_torsion")


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
    if key in _USUAL:
        return HalfRange(*_USUAL[key])
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
    models: Sequence[MappedModel],
    config: Config,
    solver: Solver,
    coarser: Mapping[str, Sequence[CoarserBody]] | None = None,
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
    coarser
        Beams with less strips and modes, by model.

    Returns
    -------
    pd.DataFrame
        :data:`COLUMNS`. ``sensitivity`` is d ln V/d ln p, of a parameter that may be zero dV/dp, as
        ``sensitivity_of`` says; ``speed_at_less`` and ``speed_at_more`` (m/s) are the critical
        speeds at both ends of the half-range: infinite without an onset up to twice the speed,
        zero where it is unstable at all speeds. ``lowers`` and ``raises`` (m/s) are how far they
        are below and above, and ``share`` is the parameter's part of the sum of squares below.
    """
    rows = []
    for model in models:
        dimension = plan.model(model.name, config.reduction).dimension
        for line in model.lines:
            if not math.isfinite(critical_of(line).critical_speed):
                continue
            angle = round(math.degrees(line.incidence_rad), 9)
            ranges = {name: half_range(config, solver, dimension, name, angle) for name in _KEYS}
            others = (coarser or {}).get(model.name, ())
            if not isinstance(config.uncertainty.mesh, str):
                others = ()
            found = _rows_of(FollowedOnset(line), ranges, config.flow.density, others)
            rows += [{"model": model.name, "incidence_deg": angle, **row} for row in found]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _rows_of(
    onset: FollowedOnset,
    ranges: dict[str, HalfRange],
    density: float,
    coarser: Sequence[CoarserBody],
) -> list[Row]:
    rows = [
        _row(onset, one, ranges.get(one.name, HalfRange()), density)
        for one in parameters_of(onset.line.body)
    ]
    rows += [_row_of_coarser(onset, one) for one in coarser]
    if ranges[MESH].size:
        rows.append(_row_of_mesh(onset, ranges[MESH]))
    note = ""
    known = ranges[GROWTH]
    ends = onset.speeds_at_growth(known.size) if known.size else (math.nan, math.nan)
    if not math.isnan(ends[0]):
        note = _little_of_a_slope(onset.speed, ends, known.size)
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
    return [{**row, "note": note} for row in _with_parts(onset.speed, rows)]


def _with_parts(speed: float, rows: list[Row]) -> list[Row]:
    """Add to the rows by how much each parameter lowers and raises the speed, and its share."""
    ends = [(row["speed_at_less"], row["speed_at_more"]) for row in rows]
    lowered, raised = _effects(speed, ends)
    squares = np.nan_to_num(lowered**2)
    whole = float(squares.sum())
    share = np.where(np.isnan(lowered), math.nan, squares / whole if whole else 0.0)
    parts = zip(np.abs(lowered), raised, share, strict=True)
    return [
        {**row, "lowers": down, "raises": up, "share": part}
        for row, (down, up, part) in zip(rows, parts, strict=True)
    ]


def _little_of_a_slope(speed: float, ends: tuple[float, float], growth: float) -> str:
    """Say where the error of the growth leaves little meaning to a slope at the onset."""
    if ends[1] - ends[0] <= 2.0 * LITTLE * speed:
        return ""
    upwards = "up" if math.isinf(ends[1]) else f"to {ends[1]:.4g} m/s"
    return (
        f"the growth is known to {growth:.2g} V/c alone, with which any onset from {ends[0]:.4g} "
        f"m/s {upwards} agrees: a slope at {speed:.4g} m/s says little"
    )


def _row(onset: FollowedOnset, parameter: BodyParameter, known: HalfRange, density: float) -> Row:
    derivative = onset.derivative(parameter)
    value = parameter.value(onset.line.body, density)
    less = more = math.nan
    if known.size:
        down = known.size
        if parameter.name in _NEVER_NEGATIVE:
            down = min(down, max(value, 0.0))
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


def _row_of_coarser(onset: FollowedOnset, coarser: CoarserBody) -> Row:
    """Return the row of strips or modes: the speed with less of them, and as far to the other side.

    Where the coarser beam has no onset the mesh says nothing of it: both ends are open.
    """
    less = onset.speed_of(coarser.body)
    return {
        "parameter": coarser.parameter,
        "value": coarser.number,
        "unit": "1",
        "sensitivity": math.nan,
        "sensitivity_of": "",
        "half_range": coarser.less,
        "speed_at_less": less,
        "speed_at_more": less if math.isnan(less) else max(0.0, 2.0 * onset.speed - less),
        "source": f"the beam with {coarser.number - coarser.less} of them",
    }


def _row_of_mesh(onset: FollowedOnset, known: HalfRange) -> Row:
    return {
        "parameter": MESH,
        "value": 1.0,
        "unit": "1",
        "sensitivity": 1.0,
        "sensitivity_of": RELATIVE,
        "half_range": known.size,
        "speed_at_less": (1.0 - known.size) * onset.speed,
        "speed_at_more": (1.0 + known.size) * onset.speed,
        "source": known.source,
    }


def _effects(speed: float, ends: Sequence[tuple[float, float]]) -> tuple[Floats, Floats]:
    """Return by how much (m/s) both ends of each half-range lower and raise a speed."""
    effects = np.asarray(ends, dtype=np.float64).reshape(-1, 2) - speed
    return np.minimum(effects.min(axis=1), 0.0), np.maximum(effects.max(axis=1), 0.0)


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
        lowered, raised = _effects(speed, ends)
        if np.isnan(lowered).any():
            return cls(math.nan, math.nan, math.nan)
        is_open = bool((lowered <= -speed).any())
        down, up = np.linalg.norm(lowered), np.linalg.norm(raised)
        return cls(
            0.0 if is_open else max(0.0, speed - float(down)),
            speed + float(up),
            max(0.0, speed + float(lowered.sum())),
        )


def with_intervals(table: pd.DataFrame, sensitivities: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/stability.csv`` with the interval of each critical speed.

    ``speed_from``, ``speed_to`` and ``speed_worst`` (m/s) are those of :class:`SpeedInterval`;
    ``interval_of`` names the parameters that were varied, with those that leave an end open, and
    ``largest_part`` the one that lowers it most, with its share. Empty without an onset, and where
    nothing is known of any parameter.
    """
    varied = sensitivities[sensitivities["half_range"].notna()]
    groups = dict(tuple(varied.groupby(["model", "incidence_deg"])))
    found = []
    for row in table.to_dict("records"):
        part = groups.get((row["model"], row["incidence_deg"]))
        if part is None:
            found.append((math.nan, math.nan, math.nan, "", ""))
            continue
        ends = list(zip(part["speed_at_less"], part["speed_at_more"], strict=True))
        interval = SpeedInterval.of(row["speed"], ends)
        words = (_in_words(part), _largest(part))
        found.append((interval.low, interval.high, interval.worst, *words))
    result = table.copy()
    place = result.columns.get_loc("margin")
    names = ("speed_from", "speed_to", "speed_worst", "interval_of", "largest_part")
    for number, name in enumerate(names, start=1):
        result.insert(place + number, name, [values[number - 1] for values in found])
    return result


def _largest(part: pd.DataFrame) -> str:
    """Name the parameter with the largest share, and that in per cent."""
    share = part["share"].astype(float)
    if not (share > 0.0).any():
        return ""
    row = part.loc[share.idxmax()]
    return f"{row['parameter']} {100 * row['share']:.0f} %"


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
