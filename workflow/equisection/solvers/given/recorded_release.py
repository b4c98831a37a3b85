"""Recorded release of a section: read, moved to the project's axes, sampled, and weighed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.load_balance import FEWEST_SAMPLES, LoadBalance, load_balance
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
from equisection.errors import ArgumentError, HistoryFileError
from equisection.io.history_file import (
    NEEDED,
    QUANTITIES,
    UNITS,
    HistoryColumns,
    HistoryScales,
    HistoryTable,
    read_table,
)
from equisection.io.polar_rows import MID_CHORD

Floats = NDArray[np.float64]

#: Units of a file that says nothing else.
_UNITS = {
    "time": "s",
    "twist": "rad",
    "deflection": "m",
    "lift": "N/m",
    "moment": "N m/m",
    "drag": "N/m",
}


@dataclass(frozen=True)
class RecordAxes:
    """Points of the section that a record is about (x/c from the leading edge).

    Attributes
    ----------
    moment, deflection
        Point that moments are about and point whose deflection is recorded; None is the elastic
        axis.
    """

    moment: float | None = None
    deflection: float | None = None


@dataclass(frozen=True)
class RecordedRelease:
    """Release as recorded, in units of rho/2, V and c, at uniform times.

    Attributes
    ----------
    history
        Motion of the elastic axis, c_l, and c_m about mid-chord.
    axis_moment
        c_m about the elastic axis, shape (n,).
    balance
        Agreement of motion and loads.
    """

    history: ReferenceHistory
    axis_moment: Floats
    balance: LoadBalance


def recorded_release(
    path: Path,
    columns: HistoryColumns,
    scales: HistoryScales,
    axes: RecordAxes,
    *,
    section: Section,
    incidence_rad: float,
    interval: float | None = None,
    load_factors: tuple[float, float] = (1.0, 1.0),
    k_star: float = math.nan,
) -> RecordedRelease:
    """Read a release and weigh its motion against its loads.

    A moment about a point x becomes that about the elastic axis, x_ea, by adding
    (x_ea - x) (c_l cos alpha + c_d sin alpha); without a recorded drag the second part is left out.
    The point x of the section is at the height w - (x - x_ea) (sin alpha - sin theta_0).

    Parameters
    ----------
    path
        The file.
    columns, scales, axes
        Meaning of its columns.
    section
        The section in its flow (:meth:`~equisection.beam.section.Section.in_flow`).
    incidence_rad
        theta_0 (rad).
    interval
        Interval of the samples that are kept (c/V); None for the usual one of the file, at most
        that of :data:`~equisection.aerodynamics.load_balance.FEWEST_SAMPLES` a natural period.
    load_factors
        Factors of c_l and c_m under which the section moves.
    k_star
        k* of the section's beam.

    Raises
    ------
    HistoryFileError
        The file cannot be read, or is sampled too seldom or too short to be weighed.
    """
    raw = read_table(path, columns, scales)
    most = math.tau / float(section.natural_frequencies[-1]) / FEWEST_SAMPLES
    longest = float(np.diff(raw.time).max())
    if longest > most:
        factor = scales.factor("time", columns.units["time"])
        raise HistoryFileError(
            f"{path}: up to {longest / factor:.3g} {columns.units['time']} ({longest:.3g} c/V) "
            f"from one sample to the next; allowed is {most / factor:.2g} ({most:.2g} c/V), "
            f"{FEWEST_SAMPLES} a natural period: write it more often (or is given.units.time, "
            "speed or chord another?)"
        )
    step = interval or min(float(np.median(np.diff(raw.time))), most)
    history, axis_moment = _about_own_axes(raw.sampled(step), axes, section, incidence_rad)
    name = f"{path.parent.name}/{path.stem}"
    history = replace(history, k_star=k_star, name=name)
    moving = replace(history, lift_coefficient=load_factors[0] * history.lift_coefficient)
    try:
        balance = load_balance(moving, load_factors[1] * axis_moment)
    except ArgumentError as error:
        raise HistoryFileError(f"{path}: {error}") from None
    return RecordedRelease(history, axis_moment, balance)


def _about_own_axes(
    table: HistoryTable, axes: RecordAxes, section: Section, incidence_rad: float
) -> tuple[ReferenceHistory, Floats]:
    """Return the history of the elastic axis, and c_m about it."""
    axis = section.elastic_axis
    deflected = axis if axes.deflection is None else axes.deflection
    about = axis if axes.moment is None else axes.moment
    history = ReferenceHistory(
        table.time,
        table.twist,
        deflection_of(axis, table, deflected, incidence_rad),
        table.lift,
        moment_about(MID_CHORD, table, about, incidence_rad),
        incidence_rad,
        k_star=math.nan,
        section=section,
        name="",
        source="given",
    )
    return history, moment_about(axis, table, about, incidence_rad)


def deflection_of(
    point: float, table: HistoryTable, recorded: float, incidence_rad: float
) -> Floats:
    """Return the deflection of a point of the section from that of the recorded one (x/c)."""
    risen = np.sin(incidence_rad + table.twist) - math.sin(incidence_rad)
    return table.deflection + (recorded - point) * risen


def moment_about(
    point: float, table: HistoryTable, recorded: float, incidence_rad: float
) -> Floats:
    """Return c_m about a point of the section from that about the recorded one (x/c)."""
    incidence = incidence_rad + table.twist
    normal = table.lift * np.cos(incidence)
    if table.drag.size:
        normal = normal + table.drag * np.sin(incidence)
    return table.moment + (point - recorded) * normal


def read_history(
    path: Path | str,
    section: Section,
    *,
    speed: float,
    density: float,
    columns: Mapping[str, str],
    units: Mapping[str, str] | None = None,
    signs: Mapping[str, int] | None = None,
    incidence_deg: float = 0.0,
    span: float = 1.0,
    moment_axis: float | None = None,
    deflection_axis: float | None = None,
    release: float | None = None,
) -> xr.Dataset:
    """Read a released section's history of any program, and weigh its motion against its loads.

    Parameters
    ----------
    path
        Text file with a line of column names over lines of numbers.
    section
        The section that moves (SI), with its chord.
    speed, density
        V (m/s) and rho (kg/m^3) of the record.
    columns
        Column of ``time``, ``twist``, ``deflection``, ``lift``, ``moment`` and, if recorded,
        ``drag``.
    units
        Units by quantity: ``s, ms, c/V, b/V``; ``rad, deg``; ``m, mm, c, b``; ``N, N/m, 1``; ``N m,
        N m/m, 1``, where b is the semi-chord and 1 a coefficient. By default s, rad, m, N/m, N m/m.
    signs
        -1 for a quantity that is positive nose down, or downwards.
    incidence_deg
        Rigid incidence theta_0 (deg).
    span
        Length that forces in N are of (m).
    moment_axis, deflection_axis
        Points that moments are about and whose deflection is recorded (x/c from the leading edge);
        None is the elastic axis.
    release
        Time of the release in the file's unit; None for the first line.

    Returns
    -------
    xr.Dataset
        Over ``time`` (c/V): ``twist`` (rad), ``deflection`` (m), ``cl``, ``cm`` about mid-chord and
        ``cm_axis`` about the elastic axis. Attributes: ``unexplained_lift`` and
        ``unexplained_moment``, the shares of their variances that the motion leaves unexplained;
        ``unexplained_growth`` (V/c); ``unexplained_energy``; ``is_explained`` (1 or 0); and
        ``balance``, which says in words what to write where it is 0.

    Raises
    ------
    HistoryFileError
        The file cannot be used; the message names file and line.
    ArgumentError
        A quantity or a unit is not known, or a number is out of its range.
    """
    _require_known(columns, units or {}, signs or {})
    for name, value in {"speed": speed, "density": density, "span": span}.items():
        if not (math.isfinite(value) and value > 0.0):
            raise ArgumentError(f"{name} is {value!r}; wanted a positive number")
    found = recorded_release(
        Path(path),
        HistoryColumns(columns, {**_UNITS, **(units or {})}, signs or {}, release),
        HistoryScales(section.chord, density, speed, span),
        RecordAxes(moment_axis, deflection_axis),
        section=section.in_flow(density, speed),
        incidence_rad=math.radians(incidence_deg),
    )
    return _dataset(found, section.chord)


def _require_known(
    columns: Mapping[str, str], units: Mapping[str, str], signs: Mapping[str, int]
) -> None:
    for what, given in (("columns", columns), ("units", units), ("signs", signs)):
        unknown = sorted(set(given) - set(QUANTITIES))
        if unknown:
            raise ArgumentError(
                f"{what} names {', '.join(unknown)}; allowed are {', '.join(QUANTITIES)}"
            )
    missing = [name for name in NEEDED if name not in columns]
    if missing:
        raise ArgumentError(f"columns has no {', '.join(missing)}; name the column of each")
    for name, unit in units.items():
        if unit not in UNITS[name]:
            raise ArgumentError(
                f"units: {name} is in {unit!r}; allowed are {', '.join(UNITS[name])}"
            )
    for name, sign in signs.items():
        if sign not in (1, -1):
            raise ArgumentError(f"signs: {name} is {sign!r}; allowed are 1 and -1")


def _dataset(found: RecordedRelease, chord: float) -> xr.Dataset:
    history, balance = found.history, found.balance
    variables = {
        "twist": (history.twist, "rad", "twist, nose up"),
        "deflection": (history.deflection * chord, "m", "deflection of the elastic axis, up"),
        "cl": (history.lift_coefficient, "1", "lift coefficient"),
        "cm": (history.moment_coefficient, "1", "moment coefficient about mid-chord, nose up"),
        "cm_axis": (found.axis_moment, "1", "moment coefficient about the elastic axis, nose up"),
    }
    return xr.Dataset(
        {
            name: ("time", values, {"units": unit, "long_name": text})
            for name, (values, unit, text) in variables.items()
        },
        {"time": ("time", history.time, {"units": "c/V", "long_name": "convective time t V/c"})},
        attrs={
            "unexplained_lift": balance.lift,
            "unexplained_moment": balance.moment,
            "unexplained_growth": balance.growth,
            "unexplained_energy": balance.energy,
            "is_explained": int(balance.is_explained),
            "balance": balance.text,
        },
    )
