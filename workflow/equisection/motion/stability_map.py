r"""Stability of a section or beam over incidence and speed: growth, mechanism and critical speed.

At each rigid incidence the body is followed from rest (:mod:`equisection.motion.equilibrium_path`),
linearised about its equilibrium, and its modes are followed from near vacuum on
(:mod:`equisection.motion.mode_tracking`). The *onset* is the lowest speed on this branch at which
a motion ceases to decay: where the largest growth of all motions crosses zero, or at the fold in
which the branch ends. A motion that decays again at a higher speed leaves a *hump*, which is named.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.equilibrium_path import (
    NoPath,
    PathFromRest,
    SectionPath,
    path_from_rest,
    systems_of_sections,
)
from equisection.motion.mode_tracking import FollowedModes, Spectrum, follow_modes, no_modes
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

STILL_AIR = 20.0
"""Lowest frequency (V/c) of a body in air that is next to nothing to it."""
BELOW, WITHIN = 1.15, 1.03
"""Largest ratio of two speeds below the range that is asked for, and within it."""
TO_THE_END = 1.0 - 1e-6
"""Part of the speed of a branch's end up to which it is looked at."""
WIDTH = 1e-6
"""Relative width of the interval that an onset is known to."""
MOST_ROUNDS = 12
NEARNESS = 0.02
"""Part of an interval to either side of where a straight line has an onset."""
Further = Callable[[list[Floats]], list[Spectrum]]
"""Motions at further speeds (m/s), a list for each incidence."""
#: Entries of the matrices that are in memory together.
_TOGETHER = 2_000_000


@dataclass(frozen=True)
class Crossing:
    """Change of sign of the largest growth at some incidence.

    Attributes
    ----------
    low, high
        Speeds (m/s) below and above it.
    growth_low, growth_high
        Largest growth (V/c) there.
    """

    low: float
    high: float
    growth_low: float
    growth_high: float

    @property
    def rises(self) -> bool:
        """Stability at ``low`` and instability at ``high``."""
        return self.growth_high > 0.0

    @property
    def speed(self) -> float:
        """Speed (m/s) in the middle."""
        return 0.5 * (self.low + self.high)

    @property
    def guesses(self) -> Floats:
        """Speeds near that at which a straight line has no growth, and to either side of it."""
        width = self.high - self.low
        part = self.growth_low / (self.growth_low - self.growth_high)
        near = np.array([part - NEARNESS, part, part + NEARNESS, 0.5])
        return np.unique(self.low + width * np.clip(near, 0.5 * NEARNESS, 1.0 - 0.5 * NEARNESS))


@dataclass(frozen=True)
class MapLine:
    """Motions of a body over speed at one incidence.

    Attributes
    ----------
    body, path
        The body and its equilibria from rest.
    incidence_rad
        theta_0 (rad).
    modes
        Its motions and modes at all speeds that were looked at, rising.
    crossings
        Changes of sign of the largest growth, by rising speed.
    highest
        Speed (m/s) up to which an onset was looked for.
    """

    body: BodyInFlow
    path: PathFromRest
    incidence_rad: float
    modes: FollowedModes
    crossings: tuple[Crossing, ...]
    highest: float

    @property
    def exists(self) -> bool:
        """Presence of an equilibrium at any speed."""
        return self.modes.spectrum.speed.size > 0

    @property
    def lowest(self) -> float:
        """Lowest speed (m/s) that was looked at."""
        return float(self.modes.spectrum.speed[0])

    @cached_property
    def least_stable(self) -> Complexes:
        """Eigenvalue (V/c) of largest growth at each speed."""
        return self.modes.spectrum.least_stable

    @property
    def onset(self) -> Crossing | None:
        """First loss of stability that eigenvalues tell; None without one.

        There is none where a motion grows already at the lowest speed: what is lost again at a
        higher one, after a hump, is no onset.
        """
        if self.is_unstable_at_rest:
            return None
        return next((one for one in self.crossings if one.rises), None)

    @property
    def is_unstable_at_rest(self) -> bool:
        """Growth already at the lowest speed."""
        return self.exists and bool(self.least_stable[0].real > 0.0)

    @property
    def humps(self) -> list[tuple[float, float]]:
        """Speeds (m/s) from and to which it is unstable, of those bands that end."""
        found, start = [], self.lowest if self.is_unstable_at_rest else math.nan
        for one in self.crossings:
            if one.rises:
                start = one.speed
            else:
                found.append((start, one.speed))
        return found

    def place(self, speed: float) -> int:
        """Return the place among the speeds that is nearest to a speed (m/s)."""
        return int(np.abs(self.modes.spectrum.speed - speed).argmin())

    def mode_at(self, place: int) -> tuple[str, Complexes]:
        """Return name and eigenvector (n,) of the least stable motion at one of the speeds.

        A motion that is not one of the structure's has no name: one that does not turn comes from
        the lags of the air.
        """
        spectrum = self.modes.spectrum
        growth = spectrum.values[place].real
        least = int(growth.argmax())
        conjugate = np.flatnonzero(
            np.isclose(spectrum.values[place], spectrum.values[place, least].conj())
        )
        for number, name in enumerate(self.modes.names):
            if self.modes.places[place, number] in (least, *conjugate):
                return name, spectrum.right[place, :, self.modes.places[place, number]]
        return "", spectrum.right[place, :, least]

    def least_damped_mode_at(self, place: int) -> tuple[complex, Complexes]:
        """Return eigenvalue (V/c) and eigenvector (n,) of the structural mode of largest growth."""
        number = int(self.modes.values[place].real.argmax())
        return complex(self.modes.values[place, number]), self.modes.shape(place, number)

    def tip(self, place: int) -> tuple[float, float]:
        """Return twist (rad) and deflection (m) of the tip in equilibrium at one of the speeds."""
        states = self.modes.spectrum.states[place]
        twist, deflection = self.body.tip(states)
        return float(twist.real), float(deflection.real) * self.body.chord


def map_lines(body: BodyInFlow, incidences_rad: Sequence[float], speeds: Floats) -> list[MapLine]:
    """Return the motions of a body over speed at each incidence.

    Parameters
    ----------
    body
        The body.
    incidences_rad
        Rigid incidences theta_0 (rad).
    speeds
        Speeds (m/s) that are asked for, rising; others are looked at too.

    Notes
    -----
    Where there is no steady flow at rest (an incidence beyond the polar) a line has no motions.
    """
    highest = float(speeds[-1])
    paths = [path_from_rest(body, rigid, highest) for rigid in incidences_rad]
    start = min(body.slowest * body.chord / STILL_AIR, 0.5 * float(speeds[0]))
    system = body.system(np.array([start]), np.zeros(1))
    lines = {
        place: MapLine(body, path, incidences_rad[place], no_modes(system.layout.size), (), highest)
        for place, path in enumerate(paths)
        if isinstance(path, NoPath)
    }
    there = [place for place in range(len(paths)) if place not in lines]
    grids = [_grid(start, speeds, paths[place]) for place in there]
    for group in _groups([grid.size for grid in grids], system.layout.size):
        chosen = [there[number] for number in group]
        found = _lines(
            body,
            paths=[paths[place] for place in chosen],
            incidences_rad=[incidences_rad[place] for place in chosen],
            grids=[grids[number] for number in group],
            system=system,
            highest=highest,
        )
        lines.update(zip(chosen, found, strict=True))
    return [lines[place] for place in range(len(paths))]


def _groups(sizes: list[int], n: int) -> list[list[int]]:
    """Return incidences in groups whose matrices fit into memory together."""
    groups: list[list[int]] = [[]] if sizes else []
    filled = 0
    for place, size in enumerate(sizes):
        if groups[-1] and filled + size * n * n > _TOGETHER:
            groups.append([])
            filled = 0
        groups[-1].append(place)
        filled += size * n * n
    return groups


def _lines(
    body: BodyInFlow,
    *,
    paths: list[PathFromRest],
    incidences_rad: list[float],
    grids: list[Floats],
    system: StripSystem,
    highest: float,
) -> list[MapLine]:
    def further(wanted: list[Floats]) -> list[Spectrum]:
        return spectra(paths, wanted, system.layout.size)

    found = further(grids)
    found = [
        spectrum.joined(more)
        for spectrum, more in zip(found, further([_near_humps(one) for one in found]), strict=True)
    ]
    modes = follow_modes(found, further, system)
    brackets = [_sign_changes(one.spectrum) for one in modes]
    brackets = _narrowed(brackets, further)
    return [
        MapLine(body, path, rigid, followed, tuple(crossings), highest)
        for path, rigid, followed, crossings in zip(
            paths, incidences_rad, modes, brackets, strict=True
        )
    ]


def spectra(paths: Sequence[PathFromRest], speeds: list[Floats], size: int) -> list[Spectrum]:
    """Return the motions about the equilibria of some paths, at the speeds (m/s) of each.

    ``size`` is the number n of states.
    """
    exact = [path for path in paths if isinstance(path, SectionPath)]
    if len(exact) < len(paths):
        return [
            Spectrum.of(v, *path.system(v)) if v.size else Spectrum.without_any(size)
            for path, v in zip(paths, speeds, strict=True)
        ]
    if not any(v.size for v in speeds):
        return [Spectrum.without_any(size) for _ in speeds]
    together = Spectrum.of(np.concatenate(speeds), *systems_of_sections(exact, speeds))
    bounds = np.cumsum([0, *(len(v) for v in speeds)])
    return [together.taken(slice(a, b)) for a, b in itertools.pairwise(bounds)]


def _grid(start: float, speeds: Floats, path: PathFromRest) -> Floats:
    """Speeds from near vacuum on, through those asked for, to the end of a path."""
    first, last = float(speeds[0]), float(speeds[-1])
    known = np.concatenate([speeds_between(start, first, BELOW), speeds])
    for low, high in itertools.pairwise(map(float, speeds)):
        known = np.concatenate([known, speeds_between(low, high, WITHIN)])
    end = path.end_speed * TO_THE_END
    if end < last:
        known = np.append(known[known < end], [0.999 * end, end] if end > start else [])
    return np.unique(known)


def speeds_between(low: float, high: float, ratio: float) -> Floats:
    """Return speeds from one to another, each at most so many times the one before it."""
    return np.geomspace(low, high, math.ceil(math.log(high / low) / math.log(ratio)) + 1)


def _near_humps(spectrum: Spectrum) -> Floats:
    """Speeds at which a parabola through the largest growth has a top above zero, unseen so far."""
    growth = spectrum.least_stable.real
    if growth.size < 3:
        return np.empty(0)
    before, here, after = growth[:-2], growth[1:-1], growth[2:]
    is_top = (here < 0.0) & (here >= before) & (here >= after)
    found = []
    for place in np.flatnonzero(is_top) + 1:
        left, right = spectrum.speed[place - 1], spectrum.speed[place + 1]
        if growth[place] + abs(growth[place - 1] - growth[place + 1]) > 0.0:
            found += list(np.linspace(left, right, 7)[1:-1])
    return np.setdiff1d(found, spectrum.speed)


def _sign_changes(spectrum: Spectrum) -> list[Crossing]:
    """Return the changes of sign of the largest growth over rising speed."""
    growth = spectrum.least_stable.real
    return [
        Crossing(*map(float, (*spectrum.speed[p : p + 2], *growth[p : p + 2])))
        for p in np.flatnonzero((growth[:-1] > 0.0) != (growth[1:] > 0.0))
    ]


def _narrowed(brackets: list[list[Crossing]], further: Further) -> list[list[Crossing]]:
    """Narrow the changes of sign at all incidences together."""
    for _ in range(MOST_ROUNDS):
        wide = [[one for one in row if one.high - one.low > WIDTH * one.low] for row in brackets]
        if not any(wide):
            break
        wanted = [np.concatenate([np.empty(0), *(one.guesses for one in row)]) for row in wide]
        seen = further(wanted)
        brackets = [
            [_within(one, spectrum) if one in row else one for one in old]
            for old, row, spectrum in zip(brackets, wide, seen, strict=True)
        ]
    return brackets


def _within(one: Crossing, spectrum: Spectrum) -> Crossing:
    """Return the part of a bracket that has the first change of sign."""
    inside = (spectrum.speed > one.low) & (spectrum.speed < one.high) & spectrum.exists
    speed = np.concatenate([[one.low], spectrum.speed[inside], [one.high]])
    growth = np.concatenate(
        [[one.growth_low], spectrum.least_stable.real[inside], [one.growth_high]]
    )
    changed = (growth > 0.0) == one.rises
    place = int(changed.argmax())
    return Crossing(*map(float, (*speed[place - 1 : place + 1], *growth[place - 1 : place + 1])))
