"""Small motions of learnt models over the speed, at each incidence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.analysis.learning import Lessons
from equisection.analysis.learnt_bodies import (
    LearntBeamBodies,
    LearntBodies,
    LearntSectionBodies,
)
from equisection.analysis.learnt_course import Learnt
from equisection.analysis.learnt_file import beam_model_of, is_of_strips, model_of
from equisection.analysis.recorded_beam import on_strips
from equisection.analysis.reduced_beam import SMALLEST_BAND_OF_BEAM, ReducedBeam
from equisection.analysis.reduced_model import SMALLEST_BAND, spread_of_refits
from equisection.cases import UnsteadyCase
from equisection.motion.mechanism import Instabilities, influence_of, instabilities
from equisection.motion.mode_tracking import FollowedModes, Spectrum, follow_modes, no_modes
from equisection.motion.stability_map import BELOW, STILL_AIR, WITHIN, speeds_between
from equisection.study.axes import SPEED, AsGiven

Floats = NDArray[np.float64]


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
        than :data:`~equisection.analysis.reduced_model.SMALLEST_BAND`, is zero. At the latest it
        begins where a refit has no equilibrium.
        """
        spectrum = self.modes.spectrum
        if spectrum.speed.size < 2:
            return math.nan, math.nan, math.nan
        growth = spectrum.least_stable.real
        refits = (
            self.spectrum(spectrum.speed, fit).least_stable.real
            for fit in range(1, len(self._fits))
        )
        rates = np.array([growth, *refits])
        band = np.maximum(spread_of_refits(rates), self.smallest_band)
        lost = np.isfinite(growth) & np.isnan(rates).any(axis=0)
        return (
            _first_rise(spectrum.speed, growth),
            _first_rise(spectrum.speed, np.where(lost, np.inf, growth + band)),
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


def _first_rise(speed: Floats, growth: Floats) -> float:
    """Return the speed of the first zero of a growth from below, by a straight line; NaN without.

    Where it grows already at the lowest speed there is none. An infinite growth begins right away.
    """
    known = ~np.isnan(growth)
    speed, growth = speed[known], growth[known]
    rises = np.flatnonzero((growth[:-1] <= 0.0) & (growth[1:] > 0.0))
    if not growth.size or growth[0] > 0.0 or not rises.size:
        return math.nan
    at = rises[0]
    part = -growth[at] / (growth[at + 1] - growth[at])
    return float(speed[at] + part * (speed[at + 1] - speed[at]))
