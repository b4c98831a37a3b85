"""Values of this run for each number of the paper."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from equisection.config import Config
from equisection.paper.printed_values import (
    BUBBLE_2D,
    COEFFICIENTS,
    DISCRETISATION,
    FLOW_FIELD,
    TABLE_1,
    TABLE_2_KINDS,
)
from equisection.paper.tables import at_incidence, modes_of_table_2
from equisection.results.correction_dataset import factor_at
from equisection.study import plan


@dataclass(frozen=True)
class Run:
    """The results of one run that the paper's numbers are compared with.

    Attributes
    ----------
    polar_3d, correction
        Polar and correction of the rigid beam; None where the solver does not run it, the latter
        only where no polar of it is given either.
    reference_3d
        Result of the beam at the stiffest k* of the sweep; None if the beam is not run.
    bubble
        ``tables/bubble.csv``; None where the solver has no surface data.
    """

    config: Config
    modes: xr.Dataset
    equivalent: xr.Dataset
    summary: pd.DataFrame
    onset: pd.DataFrame
    polar_3d: xr.Dataset | None = None
    correction: xr.Dataset | None = None
    reference_3d: xr.Dataset | None = None
    bubble: pd.DataFrame | None = None


@dataclass(frozen=True)
class Here:
    """One value of a run.

    Attributes
    ----------
    value
        Value; NaN if the run has none, with the reason in the note.
    note
        Remark that the comparison needs.
    model
        The model, where a quantity has one value for each.
    comparable
        False where a relative difference from the paper, or a bound that holds, means nothing.
    """

    value: float
    note: str = ""
    model: str = ""
    comparable: bool = True


_NOT_AMONG = "not among the incidences of this run (steady.incidence_deg)"
_BEYOND = "beyond the incidences of this run (steady.incidence_deg)"
#: From this on the second mode has no part in it: what is left of its mean is rounding.
_NO_PART = 1e6
_MODAL = (
    "correction: modal, of the loads that the first modes feel, and not of the means that the "
    "paper's factors are of"
)
_NO_BEAM = Here(math.nan, "this run has no rigid beam of its own")


def values_here(run: Run) -> dict[str, list[Here]]:
    """Return this run's values by the quantities of :data:`paper_values.PUBLISHED`."""
    found = {name: [Here(value)] for name, value in _case(run.config).items()}
    found |= _section(run.equivalent)
    found |= _frequency_constants(run.modes)
    found |= _rigid_plate(run)
    found |= _factors(run)
    found |= _modal_contributions(run)
    found["k* of the onset"] = onsets(run.onset, run.summary, run.config.reduction)
    found["cost of 3D over 2D, per time simulated"] = [_cost(run.summary)]
    found |= _surface(run)
    for quantity in FLOW_FIELD:
        found[quantity] = [Here(math.nan, "a resolved flow field has it; not in this run's files")]
    for quantity in DISCRETISATION:
        found[quantity] = [Here(math.nan, "the paper's CFD set-up; no counterpart in this run")]
    return found | _elements(run.config)


def _case(config: Config) -> dict[str, float]:
    beam, flow, channel = config.beam, config.flow, config.flow.channel
    is_plate = beam.cross_section is None
    return {
        "chord c (m)": beam.chord,
        "span L/c": beam.length / beam.chord,
        "thickness h/c": beam.thickness / beam.chord,
        "aspect ratio 2L/c": 2.0 * beam.length / beam.chord,
        "channel height H/c": channel.height_chords if channel else math.nan,
        "channel upstream L_u/c": channel.upstream_chords if channel else math.nan,
        "channel downstream L_d/c": channel.downstream_chords if channel else math.nan,
        "incidence theta_0 (deg)": flow.incidence_deg,
        "speed V (m/s)": flow.speed,
        "density rho (kg/m3)": flow.density,
        "viscosity mu (Pa s)": flow.dynamic_viscosity,
        "sound speed a (m/s)": flow.sound_speed,
        "Young's modulus E (Pa)": beam.youngs_modulus if is_plate else math.nan,
        "Poisson's ratio nu": beam.poisson_ratio if is_plate else math.nan,
        "density of the plate rho_s (kg/m3)": beam.density if is_plate else math.nan,
        "Reynolds number": flow.density * flow.speed * beam.chord / flow.dynamic_viscosity,
        "Mach number": flow.speed / flow.sound_speed,
    }


def _section(equivalent: xr.Dataset) -> dict[str, list[Here]]:
    names = {
        "c^2 k_w/k_theta": "stiffness_ratio",
        "c^2 m_2D/I_2D": "inertia_ratio",
        "k* of the plate as given": "k_star",
    }
    found = {}
    for quantity, name in names.items():
        paper, consistent = (
            float(equivalent[name].sel(reduction=form)) for form in ("paper", "consistent")
        )
        note = f"reduction 'paper'; reduction 'consistent' gives {consistent:.4g}"
        found[quantity] = [Here(paper, note)]
    return found


def _frequency_constants(modes: xr.Dataset) -> dict[str, list[Here]]:
    found = {}
    where = modes_of_table_2([str(kind) for kind in modes["kind"].values])
    for number, (kind, index) in enumerate(zip(TABLE_2_KINDS, where, strict=True), start=1):
        if index is None:
            here = Here(math.nan, f"fewer {kind} modes were computed")
        else:
            value = float(modes["frequency_constant"].values[index])
            here = Here(value, f"{modes.attrs['method']}, elements {modes.attrs['elements']}")
        found[f"C_{number} ({kind})"] = [here]
    return found


def _rigid_plate(run: Run) -> dict[str, list[Here]]:
    resolution = run.config.steady.resolution
    angles = next(iter(TABLE_1.values()))
    if run.polar_3d is None:
        return {f"{name} at {angle:g} deg": [_NO_BEAM] for angle in angles for name in COEFFICIENTS}
    if resolution not in run.polar_3d["resolution"].values:
        nothing = Here(math.nan, f"no incidence has a result at resolution {resolution}")
        return {f"{name} at {angle:g} deg": [nothing] for angle in angles for name in COEFFICIENTS}
    solver = str(run.polar_3d.attrs[f"solver_{resolution}"])
    found = {}
    for angle in angles:
        row = at_incidence(run.polar_3d, resolution, angle)
        for name, short in COEFFICIENTS.items():
            value = math.nan if row is None else float(row[short])
            if row is None:
                note = _NOT_AMONG
            elif math.isfinite(value):
                note = f"resolution {resolution}, {solver}"
            else:
                note = f"failed here: {run.polar_3d.attrs.get('failures') or 'no value'}"
            found[f"{name} at {angle:g} deg"] = [Here(value, note)]
    return found


def _surface(run: Run) -> dict[str, list[Here]]:
    """Return the bubble of the section at the paper's incidences, and y+ at that of the run."""
    found = {
        f"bubble over chord, 2D at {angle:g} deg": _on_surface(run, angle, "bubble")
        for angle in BUBBLE_2D
    }
    return found | {
        "wall y+, 2D": _on_surface(run, run.config.flow.incidence_deg, "y_plus_largest")
    }


def _on_surface(run: Run, angle: float, column: str) -> list[Here]:
    if run.bubble is None:
        return [Here(math.nan, f"solver '{run.config.solver}' has no surface data")]
    table, resolution = run.bubble, run.config.steady.resolution
    rows = table[(table["resolution"] == resolution) & np.isclose(table["incidence_deg"], angle)]
    if rows.empty:
        return [Here(math.nan, f"{angle:g} deg: {_NOT_AMONG}")]
    row = rows.iloc[0]
    if not math.isfinite(row[column]):
        return [Here(math.nan, str(row["note"]))]
    note = f"resolution {resolution}, {row['solver']}, {row['method']}"
    if column == "y_plus_largest":
        note = (
            f"largest, at {angle:g} deg; {row['y_plus_mean']:.2g} in the mean, below 1 on "
            f"{100 * row['y_plus_below_1']:.0f} % of both sides; {note}"
        )
    return [Here(float(row[column]), note)]


def _factors(run: Run) -> dict[str, list[Here]]:
    factors = {"c_l/C_L": "lift_factor", "c_m/C_M": "moment_factor"}
    angles = {"theta_0": run.config.flow.incidence_deg, "10 deg": 10.0}
    if run.correction is None:
        return {f"{quantity} at {label}": [_NO_BEAM] for quantity in factors for label in angles}
    incidence = run.correction["incidence_deg"].values
    is_modal = run.correction.attrs.get("correction") == "modal"
    found = {}
    for quantity, name in factors.items():
        for label, angle in angles.items():
            value, notes = factor_at(run.correction, name, angle), []
            if not math.isfinite(value):
                covered = incidence.size and incidence[0] <= angle <= incidence[-1]
                notes.append("not a positive number in this run" if covered else _BEYOND)
            if is_modal:
                notes.append(_MODAL)
            found[f"{quantity} at {label}"] = [
                Here(value, "; ".join(notes), comparable=not is_modal)
            ]
    return found


def _modal_contributions(run: Run) -> dict[str, list[Here]]:
    result, found = run.reference_3d, {}
    for kind in ("torsion", "bending"):
        name = f"{kind}_amplitude"
        if result is None or name not in result or not result["time"].size:
            here = Here(math.nan, "no run of the beam (3d) at the stiffest k* to take it from")
        else:
            start = float(result.attrs["window_start"])
            late = result[name].sel(time=slice(start if math.isfinite(start) else None, None))
            mean = np.abs(late.mean("time").values)
            note = (
                f"means over the end of the run at k* = {float(result.attrs['k_star']):g}; a load "
                f"that is uniform along the span {_of_uniform_load(uniform_load_ratio(run, kind))}"
            )
            value = mean[0] / mean[1:].max() if mean.size > 1 and mean[1:].max() else math.nan
            here = Here(float(value), note)
        found[f"first {kind} mode over the others"] = [here]
    return found


def _of_uniform_load(ratio: float) -> str:
    return "does not move the second" if ratio > _NO_PART else f"gives {ratio:.0f}"


def uniform_load_ratio(run: Run, kind: str) -> float:
    """Return the first modal amplitude over the second under a static uniform load.

    An amplitude is (mean of the shape)/(M_ii omega_i^2) times a factor that all modes share
    (Eqs. 13 and 14 without the terms of motion); NaN with fewer than two modes.
    """
    mean_name, mass_name = {
        "torsion": ("f_mean", "mass_theta"),
        "bending": ("g_mean", "mass_w"),
    }[kind]
    mean = run.equivalent[mean_name].values[:2]
    mass = np.diag(run.equivalent[mass_name].values)[:2]
    frequency = run.modes["frequency"].values[run.modes["kind"].values == kind][:2]
    if min(mean.size, mass.size, frequency.size) < 2:
        return math.nan
    amplitude = np.abs(mean) / (mass * frequency**2)
    return float(amplitude[0] / amplitude[1])


def onsets(onset: pd.DataFrame, summary: pd.DataFrame, reduction: str) -> list[Here]:
    """Return the middle of the onset's bracket for the models that the paper speaks of.

    Those are the beam and the corrected sections; the bracket is in the note.
    """
    found = []
    for row in onset.to_dict("records"):
        name = str(row["model"])
        model = plan.model(name, reduction)
        if model.dimension == "3d" or model.corrected:
            runs = summary[summary["model"] == name]
            found.append(_onset(name, row["k_star_unstable"], row["k_star_stable"], runs))
    return found or [Here(math.nan, "neither the beam nor a corrected section was run")]


def _onset(name: str, unstable: float, stable: float, runs: pd.DataFrame) -> Here:
    k_star = runs["k_star"]
    if math.isfinite(unstable) and math.isfinite(stable):
        note = (
            f"middle of the bracket {unstable:g} ({_regime(runs, unstable)}) to "
            f"{stable:g} ({_regime(runs, stable)})"
        )
        return Here(0.5 * (unstable + stable), note, name)
    if math.isfinite(stable):
        note = f"no unstable run down to k* = {k_star.min():g}: the onset is below {stable:g}"
    elif math.isfinite(unstable):
        note = f"no stable run up to k* = {k_star.max():g}: the onset is above {unstable:g}"
    else:
        note = "every run failed"
    return Here(math.nan, note, name)


def _regime(runs: pd.DataFrame, k_star: float) -> str:
    """Return regime and, for a limit cycle, amplitude of the run at a k*."""
    run = runs.iloc[int(np.argmin(np.abs(runs["k_star"] - k_star)))]
    if run["regime"] != "limit-cycle":
        return str(run["regime"])
    return f"limit cycle of {run['twist_amplitude_deg']:.2g} deg"


def _cost(summary: pd.DataFrame) -> Here:
    per_time = {
        str(model): float(runs["cpu_seconds"].sum() / runs["end_time"].sum())
        for model, runs in summary.groupby("model")
        if runs["end_time"].sum() > 0
    }
    section = next((name for name in ("2d-corrected", "2d") if name in per_time), None)
    if "3d" not in per_time or section is None or per_time[section] <= 0:
        return Here(math.nan, "needs runs of 3d and of 2d or 2d-corrected", comparable=False)
    solvers = ", ".join(sorted(set(summary["solver"])))
    note = f"CPU time of 3d over {section} with this run's solver ({solvers})"
    return Here(per_time["3d"] / per_time[section], note, comparable=False)


def _elements(config: Config) -> dict[str, list[Here]]:
    if config.structure.method != "solid":
        return {}
    elements = config.structure.elements
    note = "quadratic elements here"
    return {
        "element size of the plate over chord": [
            Here(1.0 / elements.chord, note, comparable=False)
        ],
        "elements through the plate's thickness": [
            Here(float(elements.thickness), note, comparable=False)
        ],
    }
