"""Critical speed of each model: from the brackets of the runs, and from eigenvalues."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.analysis.onset import OnsetBracket, bracket_of, sweeps
from equisection.beam.section import Section
from equisection.motion.mechanism import Mechanism
from equisection.motion.stability import SHARES, critical_speed
from equisection.solvers.protocol import Capability
from equisection.solvers.registry import SOLVERS
from equisection.study.axes import INCIDENCE, SPEED, AsGiven, onset_axis_among

#: Columns of ``comparison/critical_speed.csv``, in order.
COLUMNS = (
    "model",
    "incidence_deg",
    "speed",
    "speed_low",
    "speed_high",
    "mechanism",
    "frequency_hz",
    "k_star",
    "margin",
    "basis",
    "energy_share",
)
#: Those of a table that has no margin yet.
BEFORE_MARGIN = tuple(name for name in COLUMNS if name != "margin")
#: Basis of a speed: runs of CFD, runs in time of another solver, a model that was learnt from runs,
#: eigenvalues, or flutter derivatives.
CFD, TIME, MODEL, EIGENVALUE = "cfd", "time", "model", "eigenvalue"
DERIVATIVES = "derivatives"


def from_runs(
    summary: pd.DataFrame,
    *,
    given: AsGiven,
    chord: float,
    incidence_deg: float,
    bases: Mapping[str, str] | None = None,
) -> pd.DataFrame:
    """Return the critical speed of each model by the brackets of its runs.

    Parameters
    ----------
    summary
        ``comparison/summary.csv``.
    given
        The beam as given.
    chord
        c (m).
    incidence_deg
        Rigid incidence (deg) of a study that does not vary it.
    bases
        Basis of the runs of a solver whose runs are what its configuration says, by its name.

    Returns
    -------
    pd.DataFrame
        :data:`BEFORE_MARGIN`. The speed is the middle of the bracket from
        ``speed_low``, stable, to ``speed_high``, unstable. Where one side is open the speed is NaN,
        and the mechanism of a model that is stable throughout is ``none``, but ``unknown`` where
        runs failed or were undecided beyond the last stable one. The unstable run nearest to the
        onset tells the mechanism. A twist that left ever faster and never turned has diverged. One
        that oscillates is called ``flutter``, with or without separation, which a history alone
        does not tell, but ``galloping`` where the heave grows and the twist does not. A twist that
        turned, and left before its oscillation was counted, is ``unknown``: it may flutter. The
        basis is
        :data:`CFD` where the solver of all its runs has a mesh, else :data:`TIME`; of records it is
        what the configuration says, and ``given`` where that is another run's.
    """
    axis = onset_axis_among(summary.columns)
    rows = []
    for model, fixed, runs in sweeps(summary):
        bracket = bracket_of(runs)
        low, high = bracket.stable, bracket.unstable
        if axis is not SPEED:
            low, high = given.speed_at(low), given.speed_at(high)
        middle = 0.5 * (low + high)
        unstable = runs[axis.same(runs[axis.name], bracket.unstable)]
        strouhal = unstable["frequency_strouhal"].max() if len(unstable) else math.nan
        rows.append(
            {
                "model": model,
                "incidence_deg": fixed.get(INCIDENCE, incidence_deg),
                "speed": middle,
                "speed_low": low,
                "speed_high": high,
                "mechanism": _mechanism(bracket, unstable),
                "frequency_hz": strouhal * high / chord,
                "k_star": given.k_star_at(middle),
                "basis": _basis(runs["solver"], bases or {}),
                "energy_share": math.nan,
            }
        )
    return pd.DataFrame(rows, columns=list(BEFORE_MARGIN))


def _basis(solvers: Iterable[str], bases: Mapping[str, str]) -> str:
    """Return what the runs of some solvers are; a model of another run may have its own."""
    solvers = list(solvers)
    said = {bases.get(name) or SOLVERS[name].basis for name in solvers}
    if len(said) == 1 and said != {""}:
        return said.pop()
    meshed = all(Capability.MESH in SOLVERS[name].provides for name in solvers)
    return CFD if meshed else TIME


def _mechanism(bracket: OnsetBracket, unstable: pd.DataFrame) -> str:
    """Return the mechanism of the unstable run that is nearest to the onset."""
    if math.isnan(bracket.unstable):
        is_open = math.isnan(bracket.stable) or bool(bracket.unknown)
        return Mechanism.UNKNOWN if is_open else Mechanism.NONE
    if "heave_grows" in unstable and (unstable["heave_grows"] == 1).any():
        return Mechanism.GALLOPING
    if unstable["frequency_strouhal"].notna().any():
        return Mechanism.FLUTTER
    # a result from before turns were counted does not tell
    went_one_way = "twist_turns" in unstable and (unstable["twist_turns"] == 0).all()
    return Mechanism.DIVERGENCE if went_one_way else Mechanism.UNKNOWN


def from_learnt(learnt: Iterable[xr.Dataset], *, given: AsGiven, chord: float) -> pd.DataFrame:
    """Return the critical speed of each model by what was learnt from its releases.

    Parameters
    ----------
    learnt
        ``rom/<model>/model*.nc`` of each model and incidence. ``speed_low`` and ``speed_high`` are
        the ends of the interval of the onset.
    given
        The beam as given.
    chord
        c (m).
    """
    rows = []
    for data in learnt:
        k_star, least, most = (
            float(data.attrs[f"onset_k_star{end}"]) for end in ("", "_low", "_high")
        )
        speed = given.speed_at(k_star)
        strouhal = math.nan
        if math.isfinite(k_star):
            known = data["frequency_strouhal"].notnull().values
            at = [data[name].values[known] for name in ("k_star", "frequency_strouhal")]
            strouhal = float(np.interp(k_star, *at)) if known.any() else math.nan
        rows.append(
            {
                "model": data.attrs["model"],
                "incidence_deg": float(data.attrs["incidence_deg"]),
                "speed": speed,
                "speed_low": given.speed_at(most),
                "speed_high": given.speed_at(least),
                "mechanism": _learnt_mechanism(data, k_star),
                "frequency_hz": strouhal * speed / chord,
                "k_star": k_star,
                "basis": MODEL,
            }
        )
    return pd.DataFrame(rows, columns=list(BEFORE_MARGIN))


def _learnt_mechanism(data: xr.Dataset, k_star: float) -> str:
    """Return the mechanism of the onset of a learnt model.

    A release that oscillates at a growth rate flutters. One that leaves at once, next to the onset,
    has no growth rate, and may have diverged.
    """
    if not math.isfinite(k_star):
        return Mechanism.UNKNOWN
    known = data.set_coords("k_star")["growth_rate"].sortby("k_star")
    beyond = known.values[known["k_star"].values < k_star][-1:]
    return Mechanism.UNKNOWN if np.isnan(beyond).any() else Mechanism.FLUTTER


def from_eigenvalues(
    sections: Mapping[str, Section],
    polar: Polar,
    lags: SeparationLags,
    *,
    incidence_deg: Sequence[float],
    speed: tuple[float, float],
    density: float,
) -> pd.DataFrame:
    """Return the critical speed of some sections by eigenvalues (:mod:`..motion.stability`).

    Parameters
    ----------
    sections
        Sections (SI) by the names of their models.
    polar, lags
        Loads of the section.
    incidence_deg
        Rigid incidences (deg).
    speed
        Lowest and highest speed (m/s) looked at.
    density
        rho (kg/m3).

    Returns
    -------
    pd.DataFrame
        :data:`BEFORE_MARGIN`. ``energy_share`` (-) is the largest part of the power of
        the air, by which an oscillation's mechanism is named.
    """
    rows = []
    for model, section in sections.items():
        found = critical_speed(
            section,
            polar,
            incidence_deg=list(incidence_deg),
            speed=speed,
            density=density,
            lags=lags,
        )
        for angle in incidence_deg:
            one = found.sel(incidence_deg=angle)
            number = {
                name: float(one[name]) for name in ("critical_speed", "speed_low", "speed_high")
            }
            rows.append(
                {
                    "model": model,
                    "incidence_deg": float(angle),
                    "speed": number["critical_speed"],
                    "speed_low": number["speed_low"],
                    "speed_high": number["speed_high"],
                    "mechanism": str(one["mechanism"].values),
                    "frequency_hz": float(one["frequency"]),
                    "k_star": float(one["k_star"]),
                    "basis": EIGENVALUE,
                    "energy_share": max(float(one[name]) for name in SHARES),
                }
            )
    return pd.DataFrame(rows, columns=list(BEFORE_MARGIN))


def from_map(stability: pd.DataFrame) -> pd.DataFrame:
    """Return the critical speed of the models of a map of stability (``stability.csv``)."""
    known = stability[np.isfinite(stability["incidence_deg"])].assign(
        basis=EIGENVALUE, energy_share=lambda table: table[list(SHARES)].max(axis=1)
    )
    return known[list(BEFORE_MARGIN)]


def with_margin(tables: Iterable[pd.DataFrame], design_speed: float | None) -> pd.DataFrame:
    """Return ``comparison/critical_speed.csv`` of some tables, by model and incidence.

    ``margin`` is the highest speed known to be stable below the onset over the design speed, so
    that the width of a bracket is on the safe side; NaN without a design speed.
    """
    found = pd.concat([table for table in tables if len(table)] or [pd.DataFrame(columns=COLUMNS)])
    design = math.nan if design_speed is None else design_speed
    order = {model: number for number, model in enumerate(dict.fromkeys(found["model"]))}
    return (
        found.assign(margin=found["speed_low"].astype(float) / design)[list(COLUMNS)]
        .sort_values(
            ["model", "incidence_deg", "basis"],
            key=lambda column: column.map(order) if column.name == "model" else column,
            kind="stable",
        )
        .reset_index(drop=True)
    )


def in_words(table: pd.DataFrame) -> list[str]:
    """Return a line for each critical speed: what was found, or up to where nothing was."""
    return [_line(row) for row in table.to_dict("records")]


def _line(row: Mapping[Any, Any]) -> str:
    who = f"{row['model']} at {row['incidence_deg']:g} deg ({row['basis']})"
    low, high = row["speed_low"], row["speed_high"]
    if np.isfinite(row["speed"]):
        return f"{who}: {_onset(row)}"
    if np.isfinite(high):
        return f"{who}: unstable at {high:.4g} m/s and at all lower speeds that were run"
    if np.isfinite(low) and row["mechanism"] == "unknown":
        return (
            f"{who}: stable up to {low:.4g} m/s; what is beyond failed or is undecided, so nothing "
            "is known of it"
        )
    if np.isfinite(low):
        return f"{who}: stable up to {low:.4g} m/s; no onset was found"
    return f"{who}: nothing is known, no run has a verdict"


def _onset(row: Mapping[Any, Any]) -> str:
    """Return the mechanism and the interval of a speed that is known, as far as they are."""
    low, high = row["speed_low"], row["speed_high"]
    is_known = row["mechanism"] != Mechanism.UNKNOWN
    what = row["mechanism"] if is_known else "an instability of unknown mechanism"
    if np.isfinite(low) and np.isfinite(high):
        return f"{what} between {low:.4g} and {high:.4g} m/s"
    at = f"{what} at {row['speed']:.4g} m/s"
    if np.isfinite(low):
        return f"{at}, or from {low:.4g} m/s on: its interval has no upper end"
    if np.isfinite(high):
        return f"{at}, or up to {high:.4g} m/s: its interval has no lower end"
    return f"{at}, without an interval"
