r"""Map of stability of learnt models: equilibria, modes and critical speeds over the incidence.

At each incidence the loads were learnt from a release of their own
(:mod:`equisection.analysis.learning`), so that nothing is interpolated between incidences. About
the equilibrium from rest the model is linear, and its motions are followed over the speed as those
of any body (:mod:`equisection.motion.mode_tracking`): growth, frequency, mode and mechanism.

The *critical speed* is that of the releases, by which the model was learnt and which runs confirm,
with the interval of its refits. Small motions about the equilibrium may cease to decay at another
speed, since the air of a release is not linear; that speed has columns of its own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.analysis.critical_speeds import MODEL, from_learnt
from equisection.analysis.learnt_lines import LearntLine
from equisection.errors import EquisectionError
from equisection.motion.learnt_beams import SWINGS_ALONG
from equisection.motion.map_dataset import described, maps_of_models
from equisection.motion.mechanism import Mechanism
from equisection.motion.mode_tracking import Spectrum

Floats = NDArray[np.float64]

_OVER_BOTH = (
    "growth_rate",
    "frequency",
    "equilibrium_twist",
    "equilibrium_deflection",
    "release_growth_rate",
    "release_growth_low",
    "release_growth_high",
)
_OVER_MODES = ("mode_growth_rate", "mode_frequency", "mode_damping")
#: Columns of ``comparison/stability.csv`` in order, that of another map and those of a model alone.
COLUMNS = (
    "model",
    "incidence_deg",
    "speed",
    "speed_low",
    "speed_high",
    "mechanism",
    "mode",
    "frequency_hz",
    "k_star",
    "twist_deg",
    "deflection_m",
    "speed_small",
    "speed_small_low",
    "speed_small_high",
    "heave_share",
    "twist_share",
    "coupling_share",
    "margin",
    "speed_from",
    "speed_to",
    "interval_of",
    "basis",
    "learnt",
    "extrapolated",
    "in_time",
    "note",
)
#: Units and meaning of the variables that no other map has.
OF_MODEL = {
    "release_growth_rate": ("s-1", "growth rate of a release by the model"),
    "release_growth_low": ("s-1", "lower end of the band of the growth rate of a release"),
    "release_growth_high": ("s-1", "upper end of the band of the growth rate of a release"),
    "speed_small": ("m s-1", "lowest speed at which a small motion ceases to decay"),
    "speed_small_low": ("m s-1", "the same at the upper end of the band of the growth rate"),
    "speed_small_high": ("m s-1", "the same at the lower end of the band of the growth rate"),
    "learnt": ("1", "what the model was learnt from"),
    "in_time": ("1", "whether runs bear the critical speed out"),
}


def stability_of_learnt(
    lines: Sequence[LearntLine], *, chord: float, design_speed: float | None
) -> pd.DataFrame:
    """Return ``comparison/stability.csv`` of learnt models (:data:`COLUMNS`).

    Parameters
    ----------
    lines
        Models at their incidences.
    chord
        c (m).
    design_speed
        Speed (m/s) of the margin; None for none.
    """
    rows = [_row(line, chord) for line in lines]
    table = pd.DataFrame(rows)
    design = math.nan if design_speed is None else design_speed
    table["margin"] = table["speed_low"] / design
    known = table["speed"].notna()  # of a model its own interval is all that is known
    table["speed_from"], table["speed_to"] = (
        table[name].where(known) for name in ("speed_low", "speed_high")
    )
    table["interval_of"] = ["refits of the model" if one else "" for one in known]
    return table[list(COLUMNS)]


def _row(line: LearntLine, chord: float) -> dict[str, object]:
    learnt = from_learnt([line.data], given=line.given, chord=chord).iloc[0]
    row: dict[str, object] = dict.fromkeys(COLUMNS, math.nan)
    row |= {
        "model": line.lessons.name,
        "incidence_deg": line.incidence_deg,
        "mechanism": "unknown",
        "mode": "",
        "basis": MODEL,
        "learnt": line.data.attrs["words"],
        "in_time": line.data.attrs["confirmation"],
        "note": line.refusal or line.data.attrs["reservations"],
    }
    if line.refusal:
        return row
    speed = float(learnt["speed"])
    row |= {name: learnt[name] for name in ("speed", "speed_low", "speed_high", "k_star")}
    row["frequency_hz"] = learnt["frequency_hz"]
    small, small_low, small_high = line.small
    row |= {"speed_small": small, "speed_small_low": small_low, "speed_small_high": small_high}
    if not math.isfinite(speed):
        without = _without_onset(line)
        _add(row, str(without.pop("note")))
        return row | without
    row["extrapolated"] = _extrapolated(line, float(learnt["k_star"]))
    row |= _equilibrium(line, speed)
    unstable = small_high if math.isfinite(small_high) else small
    if math.isfinite(unstable):
        spectrum = line.spectrum(np.array([unstable * (1.0 + 1e-6)]))
        _add(row, _faster_than_learnt(line, spectrum))
        told = line.mechanisms(spectrum)
        row |= {
            "mechanism": str(told.mechanism[0]),
            "heave_share": float(told.heave_share[0]),
            "twist_share": float(told.twist_share[0]),
            "coupling_share": float(told.coupling_share[0]),
            "mode": line.mode_at(unstable),
        }
        if row["mechanism"] in ("none", "unknown"):
            row["mechanism"] = _of_release(line, learnt)
    else:
        row["mechanism"] = _of_release(line, learnt)
        _add(row, "no small motion about an equilibrium grows: the release alone does")
    return row


def _faster_than_learnt(line: LearntLine, spectrum: Spectrum) -> str:
    """Say that the least stable motion is far faster than the pitch; empty where it is not."""
    bodies, _ = line.bodies(spectrum.speed)
    part = 0.0 if bodies is None else float(spectrum.least_stable.imag[0]) / bodies.pitch
    if part <= SWINGS_ALONG:
        return ""
    return f"what grows swings at {part:.2g} times the frequency of the pitch that was learnt from"


def _of_release(line: LearntLine, learnt: pd.Series) -> str:
    """Return the mechanism of the onset of the releases, which may have lost its equilibrium."""
    if learnt["mechanism"] != Mechanism.UNKNOWN:
        return str(learnt["mechanism"])
    k_star = line.data["k_star"].values
    beyond = line.given.speed_at(k_star[k_star < learnt["k_star"]].max())
    diverges = line.diverges(np.array([beyond]))
    return Mechanism.DIVERGENCE if diverges[0] else Mechanism.UNKNOWN


def _add(row: dict[str, object], note: str) -> None:
    row["note"] = "; ".join(filter(None, (str(row["note"]), note)))


def _without_onset(line: LearntLine) -> dict[str, object]:
    """Return what is known where the release has no onset in the reach of the sweep."""
    growth = line.data["growth_rate"].values
    k_star = line.data["k_star"].values[np.isfinite(growth)]
    growth = growth[np.isfinite(growth)]
    speed = line.given.speed_at(k_star)
    if not growth.size:
        return {"note": "no growth rate is known at any speed"}
    if (growth < 0.0).all():
        top = float(speed.max())
        return {"speed_low": top, "mechanism": "none", "note": f"stable up to {top:.4g} m/s"}
    if (growth > 0.0).all():
        least = float(speed.min())
        return {
            "speed_high": least,
            "note": f"unstable already at {least:.4g} m/s, the lowest speed that was looked at",
        }
    return {"note": "the growth beyond the onset is not known"}


def _extrapolated(line: LearntLine, k_star: float) -> float:
    """Return 1 where a release near a k* leaves the incidences that were learnt from, else 0."""
    near = int(np.abs(np.log(line.data["k_star"].values / k_star)).argmin())
    return float(line.data["extrapolated"].values[near])


def _equilibrium(line: LearntLine, speed: float) -> dict[str, float]:
    """Return static twist (deg) and deflection (m) of the tip at a speed (m/s)."""
    bodies, _ = line.bodies(np.array([speed]))
    if bodies is None:
        return {}
    states, _ = bodies.at_rest(line.model.loads)
    twist, deflection = (float(moved[0]) for moved in bodies.tip(states))
    chord = line.lessons.config.beam.chord
    return {"twist_deg": math.degrees(twist), "deflection_m": deflection * chord}


def map_of_learnt(lines: Sequence[LearntLine], table: pd.DataFrame, *, chord: float) -> xr.Dataset:
    """Return ``comparison/stability_map.nc`` of learnt models.

    Parameters
    ----------
    lines
        All models at all incidences.
    table
        Their critical speeds (:func:`stability_of_learnt`).
    chord
        c (m).

    Raises
    ------
    EquisectionError
        There is no model at any incidence.
    """
    if all(line.refusal for line in lines):
        reasons = "; ".join(dict.fromkeys(line.refusal for line in lines))
        raise EquisectionError(f"no model of the loads was learnt at any incidence ({reasons})")
    speeds = lines[0].speeds
    found = {}
    for model in dict.fromkeys(line.lessons.name for line in lines):
        own = [line for line in lines if line.lessons.name == model]
        found[model] = _map_of_model(own, table[table["model"] == model], chord)
    joined = maps_of_models(found)
    joined["k_star"] = ("speed", np.asarray(lines[0].given.k_star_at(speeds)))
    further = {name: joined[name] for name in OF_MODEL}
    dataset = described(joined.drop_vars(list(OF_MODEL)))
    for name, (units, long_name) in OF_MODEL.items():
        values = further[name].values
        is_text = values.dtype.kind not in "fiu"
        attrs = {"units": units, "long_name": long_name, "missing_allowed": "1"}
        dataset[name] = (further[name].dims, values.astype(object) if is_text else values, attrs)
    return dataset.assign_attrs(
        equilibrium="on the branch that comes from rest",
        polar="; ".join(dict.fromkeys(line.polar_label for line in lines if not line.refusal)),
        basis=MODEL,
        lags="one, learnt with the loads",
        highest_speed=float(speeds[-1]),
    )


def _map_of_model(lines: Sequence[LearntLine], rows: pd.DataFrame, chord: float) -> xr.Dataset:
    learnt = [line for line in lines if not line.refusal]
    names = next((line.modes.names for line in learnt if line.modes.names), ())
    bodies = next((line.bodies(line.speeds)[0] for line in learnt), None)
    places = np.array([0.5]) if bodies is None else bodies.places
    shape = (len(lines), lines[0].speeds.size)
    values = {name: np.full(shape, np.nan) for name in _OVER_BOTH}
    of_modes = {name: np.full((*shape, len(names)), np.nan) for name in _OVER_MODES}
    mechanism = np.full(shape, "unknown", dtype=object)
    motions = np.full((2, len(lines), places.size), np.nan, dtype=np.complex128)
    ratio = np.full(len(lines), np.nan, dtype=np.complex128)
    for row, line in enumerate(lines):
        if line.refusal:
            continue
        mechanism[row] = _fill(line, {name: one[row] for name, one in values.items()}, chord)
        _fill_modes(line, names, {name: one[row] for name, one in of_modes.items()}, chord)
        if math.isfinite(line.small[0]):
            onset = np.array(line.small[:1])
            found, _ = line.bodies(onset)
            assert found is not None, "a small motion grows about an equilibrium"
            motion = line.spectrum(onset).least_stable_motion
            twist, deflection = found.tip(motion)
            ratio[row] = deflection[0] / twist[0]
            for moved, along in zip(motions, found.along_span(motion), strict=True):
                moved[row] = along[0] / twist[0]
    over, by_mode = ("incidence_deg", "speed"), ("incidence_deg", "speed", "mode")
    critical = {
        "critical_speed": "speed",
        "speed_low": "speed_low",
        "speed_high": "speed_high",
        "critical_mechanism": "mechanism",
        "critical_mode": "mode",
        "critical_frequency": "frequency_hz",
        "critical_k_star": "k_star",
        "critical_deflection": "deflection_m",
        "heave_share": "heave_share",
        "twist_share": "twist_share",
        "coupling_share": "coupling_share",
        "note": "note",
        "speed_small": "speed_small",
        "speed_small_low": "speed_small_low",
        "speed_small_high": "speed_small_high",
        "learnt": "learnt",
        "in_time": "in_time",
    }
    none = np.full(len(lines), np.nan)
    return xr.Dataset(
        {
            **{name: (over, one) for name, one in values.items()},
            "mechanism": (over, mechanism),
            **{name: (by_mode, one) for name, one in of_modes.items()},
            **{name: ("incidence_deg", rows[one].to_numpy()) for name, one in critical.items()},
            "critical_twist": (
                "incidence_deg",
                np.radians(rows["twist_deg"].to_numpy(dtype=float)),
            ),
            "divergence_speed": ("incidence_deg", [_divergence(line) for line in lines]),
            "growth_slope": ("incidence_deg", none),
            "unstable_to": ("incidence_deg", none),
            "tip_ratio": ("incidence_deg", np.abs(ratio)),
            "tip_phase": ("incidence_deg", np.degrees(np.angle(ratio))),
            **{
                f"onset_{kind}_{part}": (("incidence_deg", "strip"), getattr(moved, part))
                for kind, moved in zip(("twist", "deflection"), motions, strict=True)
                for part in ("real", "imag")
            },
            "strip_place": ("strip", places),
        },
        {
            "incidence_deg": [line.incidence_deg for line in lines],
            "speed": lines[0].speeds,
            "mode": list(names),
            "strip": np.arange(1, places.size + 1),
        },
    )


def _fill(line: LearntLine, values: dict[str, Floats], chord: float) -> NDArray[np.object_]:
    """Fill in equilibrium, least stable motion and release at each speed; return mechanisms."""
    speeds = line.speeds
    spectrum = line.spectrum(speeds)
    told, p = line.mechanisms(spectrum), spectrum.least_stable
    rate = speeds / chord
    known = spectrum.exists
    values["growth_rate"][known] = (p.real * rate)[known]
    values["frequency"][known] = (p.imag * rate / math.tau)[known]
    bodies, there = line.bodies(speeds)
    if bodies is not None:
        twist, deflection = bodies.tip(spectrum.states[there])
        values["equilibrium_twist"][there] = twist
        values["equilibrium_deflection"][there] = deflection * chord
    of_release = line.data["k_star"].values
    order = np.argsort(of_release)
    k_star = np.asarray(line.given.k_star_at(speeds))
    for name, column in (
        ("release_growth_rate", "growth_rate"),
        ("release_growth_low", "growth_low"),
        ("release_growth_high", "growth_high"),
    ):
        growth = line.data[column].values
        values[name][:] = rate * np.interp(
            k_star, of_release[order], growth[order], left=math.nan, right=math.nan
        )
    return np.asarray(told.mechanism, dtype=object)


def _fill_modes(
    line: LearntLine, names: Sequence[str], values: dict[str, Floats], chord: float
) -> None:
    spectrum = line.modes.spectrum
    if line.modes.names != tuple(names):
        return
    there = np.isin(line.speeds, spectrum.speed)
    found = line.modes.values[np.searchsorted(spectrum.speed, line.speeds[there])]
    rate = (line.speeds[there] / chord)[:, None]
    values["mode_growth_rate"][there] = found.real * rate
    values["mode_frequency"][there] = found.imag * rate / math.tau
    values["mode_damping"][there] = -found.real / np.abs(found)


def _divergence(line: LearntLine) -> float:
    """Return the lowest of the speeds (m/s) at which there is no equilibrium but divergence."""
    if line.refusal:
        return math.nan
    lost = np.isnan(line.spectrum(line.speeds).states[:, 0]) | line.diverges(line.speeds)
    return float(line.speeds[lost][0]) if lost.any() else math.nan
