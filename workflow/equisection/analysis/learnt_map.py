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
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.analysis.critical_speeds import MODEL, from_learnt
from equisection.analysis.learning import Learnt, Lessons
from equisection.analysis.learnt_bodies import (
    LearntBeamBodies,
    LearntBodies,
    LearntSectionBodies,
)
from equisection.analysis.learnt_file import beam_model_of, is_of_strips, model_of
from equisection.analysis.recorded_beam import on_strips
from equisection.analysis.reduced_beam import SMALLEST_BAND_OF_BEAM, ReducedBeam
from equisection.analysis.reduced_model import SMALLEST_BAND
from equisection.cases import UnsteadyCase
from equisection.errors import EquisectionError
from equisection.motion.learnt_beams import SWINGS_ALONG
from equisection.motion.map_dataset import described, maps_of_models
from equisection.motion.mechanism import (
    Instabilities,
    Mechanism,
    influence_of,
    instabilities,
)
from equisection.motion.mode_tracking import FollowedModes, Spectrum, follow_modes, no_modes
from equisection.motion.stability_map import BELOW, STILL_AIR, WITHIN, speeds_between
from equisection.study.axes import SPEED, AsGiven

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

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


@dataclass(frozen=True)
class LearntLine:
    """Motions of a learnt model over the speed at one incidence.

    Attributes
    ----------
    lessons
        What makes its sections or beams.
    data
        Its file, ``rom/<model>/model*.nc``.
    given
        The beam as given.
    speeds
        Speeds (m/s) that are asked for, rising.
    """

    lessons: Lessons
    data: xr.Dataset
    given: AsGiven
    speeds: Floats
    _cases: dict[float, UnsteadyCase] = field(default_factory=dict, init=False, repr=False)

    @property
    def refusal(self) -> str:
        """Reason for which there is no model; empty where there is one."""
        return str(self.data.attrs.get("refusal", ""))

    @property
    def incidence_deg(self) -> float:
        """Rigid incidence theta_0 (deg)."""
        return float(self.data.attrs["incidence_deg"])

    @cached_property
    def model(self) -> Learnt:
        """The model with its refits."""
        if is_of_strips(self.data):
            return beam_model_of(self.data, self.lessons.strip_polars)
        return model_of(self.data, self.lessons.polar)

    @property
    def polar_label(self) -> str:
        """Label of the steady loads of the model."""
        if isinstance(self.model, ReducedBeam):
            return self.model.loads.polars.label
        return self.model.loads.polar.label

    @property
    def smallest_band(self) -> float:
        """Smallest band of the growth rate (V/c)."""
        return SMALLEST_BAND_OF_BEAM if isinstance(self.model, ReducedBeam) else SMALLEST_BAND

    def _cases_at(self, speeds: Floats) -> list[UnsteadyCase]:
        """Return the cases at speeds (m/s), some perhaps without a section or beam to move."""
        new = np.array(
            [speed for speed in dict.fromkeys(map(float, speeds)) if speed not in self._cases]
        )
        if new.size:
            values = new if self.lessons.axis is SPEED else self.given.k_star_at(new)
            cases = self.lessons.cases_at(map(float, values))
            self._cases.update(zip(map(float, new), cases, strict=True))
        return [self._cases[float(speed)] for speed in speeds]

    def diverges(self, speeds: Floats) -> NDArray[np.bool_]:
        """Tell at which speeds (m/s) a corrected section diverges, and so has no case to move."""
        return np.array([case.diverges for case in self._cases_at(speeds)], dtype=np.bool_)

    def bodies(self, speeds: Floats) -> tuple[LearntBodies | None, NDArray[np.bool_]]:
        """Return the sections or beams at speeds (m/s), and at which of them there is one."""
        cases = self._cases_at(speeds)
        if isinstance(self.model, ReducedBeam):
            beams = [case.beam for case in cases if case.beam is not None]
            there = np.array([case.beam is not None for case in cases], dtype=np.bool_)
            if not beams:
                return None, there
            return LearntBeamBodies(on_strips(beams, self.model.loads.polars.strips)), there
        sections = tuple(case.section for case in cases if case.section is not None)
        there = np.array([case.section is not None for case in cases], dtype=np.bool_)
        return (LearntSectionBodies(sections) if sections else None), there

    def spectrum(self, speeds: Floats, fit: int = 0) -> Spectrum:
        """Return the small motions by one of the fits; NaN where there is no equilibrium."""
        bodies, there = self.bodies(speeds)
        size = self._size if bodies is None else bodies.size
        states = np.full((speeds.size, size), np.nan)
        linear = np.full((speeds.size, size, size), np.nan)
        if bodies is not None:
            states[there], linear[there] = bodies.at_rest(self._fits[fit])
        return Spectrum.about(speeds, states, linear)

    @property
    def _size(self) -> int:
        """Number of states of the bodies."""
        found = (
            self.bodies(self.speeds[place : place + 1])[0] for place in range(self.speeds.size)
        )
        return next((one.size for one in found if one is not None), 0)

    @property
    def _fits(self) -> tuple[LearntLoads | LearntStrips, ...]:
        return (self.model.loads, *self.model.refits)

    @cached_property
    def modes(self) -> FollowedModes:
        """Its modes from near vacuum on, at the speeds that are asked for and more."""
        first = float(self.speeds[0])
        bodies, _ = self.bodies(self.speeds[:1])
        if bodies is None:
            return no_modes(self._size)
        start = min(bodies.slowest * first / STILL_AIR, 0.5 * first)
        grid = [speeds_between(start, first, BELOW), self.speeds]
        for low, high in zip(self.speeds[:-1], self.speeds[1:], strict=True):
            grid.append(speeds_between(float(low), float(high), WITHIN))
        (found,) = follow_modes(
            [self.spectrum(np.unique(np.concatenate(grid)))],
            lambda wanted: [self.spectrum(speeds) for speeds in wanted],
            bodies.attached(self.model.loads),
        )
        return found

    @cached_property
    def small(self) -> tuple[float, float, float]:
        """Speed (m/s) at which a small motion ceases to decay, with its interval; NaN without.

        The interval is where the growth rate, less or more the farthest of the refits but no less
        than :data:`~equisection.analysis.reduced_model.SMALLEST_BAND`, is zero.
        """
        spectrum = self.modes.spectrum
        if spectrum.speed.size < 2:
            return math.nan, math.nan, math.nan
        growth = spectrum.least_stable.real
        refits = [
            self.spectrum(spectrum.speed, fit).least_stable.real
            for fit in range(1, len(self._fits))
        ]
        spread = np.max([np.abs(one - growth) for one in refits], axis=0, initial=0.0)
        band = np.maximum(np.where(np.isfinite(spread), spread, 0.0), self.smallest_band)
        return (
            _first_rise(spectrum.speed, growth),
            _first_rise(spectrum.speed, growth + band),
            _first_rise(spectrum.speed, growth - band),
        )

    def mechanisms(self, spectrum: Spectrum) -> Instabilities:
        """Return the mechanism of the least stable of the small motions at each speed."""
        known = spectrum.exists
        names = np.full(known.size, "unknown", dtype=object)
        numbers = np.full((4, known.size), np.nan)
        names[self.diverges(spectrum.speed)] = "divergence"
        bodies, _ = self.bodies(spectrum.speed[known])
        if bodies is not None:
            motion = spectrum.least_stable_motion[known]
            attached = bodies.attached(self.model.loads)
            layout = attached.layout
            told = instabilities(
                spectrum.least_stable[known],
                motion[:, layout.deflection],
                motion[:, layout.twist],
                bodies.influence(self.model.loads, spectrum.states[known]),
                influence_of(attached, attached.rates[:, :, : layout.size]),
            )
            names[known] = told.mechanism
            shares = (told.heave_share, told.twist_share, told.coupling_share, told.heave_phase)
            numbers[:, known] = shares
        return Instabilities(names.astype(np.str_), *numbers)

    def mode_at(self, speed: float) -> str:
        """Return the name of the structural mode of largest growth near a speed (m/s)."""
        over = self.modes.spectrum.speed
        place = int(np.abs(over - speed).argmin())
        return self.modes.names[int(self.modes.values[place].real.argmax())]


def learnt_lines(
    lessons: Lessons, files: Sequence[xr.Dataset], given: AsGiven, speeds: Floats
) -> list[LearntLine]:
    """Return the motions of a model at each incidence, by its files in the order of these."""
    each = lessons.at_each_incidence()
    return [LearntLine(one, data, given, speeds) for one, data in zip(each, files, strict=True)]


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


def _first_rise(speed: Floats, growth: Floats) -> float:
    """Return the speed of the first zero of a growth from below, by a straight line; NaN without.

    Where it grows already at the lowest speed there is none.
    """
    known = np.isfinite(growth)
    speed, growth = speed[known], growth[known]
    rises = np.flatnonzero((growth[:-1] <= 0.0) & (growth[1:] > 0.0))
    if not growth.size or growth[0] > 0.0 or not rises.size:
        return math.nan
    at = rises[0]
    part = -growth[at] / (growth[at + 1] - growth[at])
    return float(speed[at] + part * (speed[at + 1] - speed[at]))


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
