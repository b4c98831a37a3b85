r"""Sensitivity of a critical speed to a parameter, and the critical speed with it varied.

At an onset V one eigenvalue lambda of J(V, p) has no growth: Re lambda(V, p) = 0. With its left and
right vectors u and v (u^H v = 1) an eigenvalue changes by d lambda = u^H dJ v (e.g. Murthy and
Haftka, Int. J. Numer. Methods Eng. 26, 1988), so that along the same branch and mode

    dV/dp = - Re(u^H J_p v)/Re(u^H J_V v).

J_p and J_V are central differences of J, each about the equilibrium with the changed parameter.
A fold has no such eigenvalue: its speed is that of the branch's end, and its derivative a central
difference of it.

A larger change is followed by Newton's method on the growth of the eigenvalue whose vectors are the
most like those at the onset. If another motion grows there, or no root is found, the critical speed
is the first one of a whole map of the changed body.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from equisection.errors import EquisectionError
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.critical import Critical, critical_of
from equisection.motion.equilibrium_path import BeamPath, SectionPath, path_from_rest
from equisection.motion.mechanism import Mechanism
from equisection.motion.mode_tracking import Spectrum
from equisection.motion.stability_map import MapLine, map_lines
from equisection.motion.static_branch import BranchEnd
from equisection.motion.steady_states import equilibrium, jacobian
from equisection.motion.strip_system import StripSystem
from equisection.motion.varied_body import BodyParameter

Floats = NDArray[np.float64]
#: Motions at a speed, and the place of one of them.
_Motion = tuple[Spectrum, int]

STEP = 1e-3
"""Part, or amount in chords or of critical damping, of the differences to either side."""
NEAR = 1e-6
"""Relative change of the speed at which Newton's method ends."""
MOST_STEPS = 12
LEAST_LIKENESS = 0.25
"""W below which an eigenvector is not the one of the onset any more."""
FURTHEST = 2.0
"""How far a whole map looks: from the speed of the onset over it to so many times that speed."""
SPEEDS_OF_A_MAP = 25
GROWS = 1e-7
"""Growth (V/c) of another motion that is more than the error of an eigenvalue."""


@dataclass(frozen=True)
class FollowedOnset:
    """Onset of a body at one incidence, to be followed under a change of the body.

    Attributes
    ----------
    line
        Motions over speed.
    critical
        Its critical speed, which must be finite.
    """

    line: MapLine
    critical: Critical = field(init=False)
    _spectrum: Spectrum | None = field(init=False)
    _place: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "critical", critical_of(self.line))
        if not math.isfinite(self.speed):
            raise EquisectionError("an onset that is not there has no sensitivities")
        spectrum, place = None, 0
        if not self.is_fold:
            spectrum = self._spectrum_of(self.line.body, self.speed)
            place = _least_stable(spectrum)
        object.__setattr__(self, "_spectrum", spectrum)
        object.__setattr__(self, "_place", place)

    @property
    def speed(self) -> float:
        """Critical speed V (m/s)."""
        return self.critical.critical_speed

    @property
    def is_fold(self) -> bool:
        """Loss of the equilibrium itself."""
        return self.line.onset is None and self.line.path.end is BranchEnd.FOLD

    def derivative(self, parameter: BodyParameter) -> float:
        """Return dV/dp (m/s per unit), or V d ln V/d ln p (m/s) of one that varies by a part.

        NaN where a changed body has no equilibrium.
        """
        if self.is_fold:
            ends = [
                self._fold_of(parameter.changed(self.line.body, sign * STEP)) for sign in (1, -1)
            ]
            return (ends[0] - ends[1]) / (2.0 * STEP)
        bodies = [parameter.changed(self.line.body, sign * STEP) for sign in (1, -1)]
        by_parameter = self._change([(body, self.speed) for body in bodies]) / (2.0 * STEP)
        return -by_parameter / self.growth_by_speed

    @cached_property
    def growth_by_speed(self) -> float:
        """Re d lambda/dV (V/c per m/s)."""
        body, step = self.line.body, STEP * self.speed
        return self._change([(body, self.speed + step), (body, self.speed - step)]) / (2.0 * step)

    def _change(self, pairs: list[tuple[BodyInFlow, float]]) -> float:
        """Re u^H (J_1 - J_2) v of two bodies at their speeds."""
        spectrum = self._spectrum
        assert spectrum is not None, "a fold has no vectors"
        first, second = (
            jacobian(*self._system(body, np.array([speed])))[0] for body, speed in pairs
        )
        left, right = spectrum.left[0, self._place], spectrum.right[0, :, self._place]
        return float((left @ (first - second) @ right).real)

    def _system(self, body: BodyInFlow, speeds: Floats) -> tuple[StripSystem, Floats, Floats]:
        """System, states and deficits of equilibrium of a body that is nearly that of the line."""
        rigid = self.line.incidence_rad
        path = self.line.path
        if not isinstance(path, BeamPath):
            return SectionPath(body, rigid).system(speeds)
        system = body.system(speeds, np.full(speeds.shape, rigid))
        return system, *equilibrium(system, path.incidences_near(speeds))

    def _spectrum_of(self, body: BodyInFlow, speed: float) -> Spectrum:
        at = np.array([speed])
        return Spectrum.of(at, *self._system(body, at))

    def _fold_of(self, body: BodyInFlow) -> float:
        """Speed (m/s) of the fold of a body; infinite without one."""
        path = path_from_rest(body, self.line.incidence_rad, FURTHEST * self.speed)
        return path.end_speed if path.end is BranchEnd.FOLD else math.inf

    def speed_with(self, parameter: BodyParameter, change: float) -> float:
        """Return the critical speed (m/s) with a parameter changed by a part or an amount.

        Infinite where the body is stable up to :data:`FURTHEST` times the speed of the onset, zero
        where it is unstable at all speeds that a map looks at; NaN where its equilibrium ends
        with the polar.
        """
        body = parameter.changed(self.line.body, change)
        if self.is_fold:
            return self._of_a_map(body)

        def motion_at(speed: float) -> _Motion | None:
            spectrum = self._spectrum_of(body, speed)
            place = self._most_like(spectrum)
            return None if place is None else (spectrum, place)

        first = self.speed + self.derivative(parameter) * change
        found = self._speed_without_growth(motion_at, first)
        return self._of_a_map(body) if found is None else found

    def speed_of(self, other: BodyInFlow) -> float:
        """Return the critical speed (m/s) of the same beam on other strips or with other modes.

        Its states are others, so that the motion of the onset is looked for by its eigenvalue: the
        nearest one. Values beyond the range are those of :meth:`speed_with`.
        """
        if self.is_fold:
            return self._of_a_map(other)
        assert self._spectrum is not None, "a fold has no vectors"
        near = complex(self._spectrum.values[0, self._place])

        def motion_at(speed: float) -> _Motion | None:
            nonlocal near
            spectrum = self._spectrum_of_other(other, speed)
            if not spectrum.exists[0]:
                return None
            place = int(np.abs(spectrum.values[0] - near).argmin())
            near = complex(spectrum.values[0, place])
            return spectrum, place

        found = self._speed_without_growth(motion_at, self.speed)
        return self._of_a_map(other) if found is None else found

    def _speed_without_growth(
        self, motion_at: Callable[[float], _Motion | None], speed: float
    ) -> float | None:
        """Return the speed (m/s) from which a motion grows, by Newton's method from one near it.

        None where the motion is lost, the speed too far off, or another motion grows there.
        """
        slope = self.growth_by_speed
        earlier: tuple[float, float] | None = None
        for _ in range(MOST_STEPS):
            if not self.speed / FURTHEST < speed < FURTHEST * self.speed:
                return None
            motion = motion_at(speed)
            if motion is None:
                return None
            spectrum, place = motion
            growth = float(spectrum.values[0, place].real)
            if earlier is not None and speed != earlier[0]:
                slope = (growth - earlier[1]) / (speed - earlier[0])
            if slope <= 0.0:
                return None
            earlier, following = (speed, growth), speed - growth / slope
            if abs(following - speed) < NEAR * speed:
                others = np.delete(spectrum.values[0].real, _pair(spectrum, place))
                return None if others.max() > GROWS else following
            speed = following
        return None

    def _spectrum_of_other(self, other: BodyInFlow, speed: float) -> Spectrum:
        """Motions of a body on other strips about its equilibrium near that of the line."""
        at, path = np.array([speed]), self.line.path
        if not isinstance(path, BeamPath):
            return self._spectrum_of(other, speed)
        here, there = self.line.body.structure.middles, other.structure.middles
        near = np.interp(there, here, path.incidences_near(at)[0])[None]
        system = other.system(at, np.full(1, self.line.incidence_rad))
        return Spectrum.of(at, system, *equilibrium(system, near))

    def _most_like(self, spectrum: Spectrum) -> int | None:
        """Return the place of the motion of the onset among others; None where it is not clear."""
        if not spectrum.exists[0]:
            return None
        assert self._spectrum is not None, "a fold has no vectors"
        left, right = self._spectrum.left[0, self._place], self._spectrum.right[0, :, self._place]
        likeness = np.abs((left @ spectrum.right[0]) * (spectrum.left[0] @ right))
        place = int(likeness.argmax())
        return place if likeness[place] > LEAST_LIKENESS else None

    def _of_a_map(self, body: BodyInFlow) -> float:
        """Critical speed (m/s) of a body by a whole map at the incidence of the line."""
        speeds = np.geomspace(self.speed / FURTHEST, FURTHEST * self.speed, SPEEDS_OF_A_MAP)
        found = critical_of(map_lines(body, [self.line.incidence_rad], speeds)[0])
        if math.isfinite(found.critical_speed):
            return found.critical_speed
        if found.critical_mechanism == Mechanism.NONE:
            return math.inf
        return 0.0 if math.isfinite(found.speed_high) else math.nan

    def speeds_at_growth(self, growth: float) -> tuple[float, float]:
        """Return the speeds (m/s) at which the growth of the mode of the onset is less and more.

        ``growth`` (V/c) is how much less than zero, and how much more. Along the modes as the map
        has them, read linearly between its speeds: zero where the mode decays less than that at
        all lower speeds, infinite where it does not grow so much at any higher one. NaN of a
        divergence, to which no such growth applies.
        """
        line, speed = self.line, self.line.modes.spectrum.speed
        if self.is_fold or self.critical.critical_mechanism == Mechanism.DIVERGENCE:
            return math.nan, math.nan
        names = line.modes.names
        if self.critical.critical_mode in names:
            values = line.modes.values[:, names.index(self.critical.critical_mode)].real
        else:
            values = line.least_stable.real
        onset = int(np.searchsorted(speed, self.speed))
        values, speed = np.insert(values, onset, 0.0), np.insert(speed, onset, self.speed)
        below = np.flatnonzero(values[: onset + 1] <= -growth)
        above = np.flatnonzero(values[onset:] >= growth) + onset
        low = _between(speed, values, int(below[-1]), -growth) if below.size else 0.0
        high = _between(speed, values, int(above[0]) - 1, growth) if above.size else math.inf
        return low, high


def _between(speed: Floats, values: Floats, place: int, wanted: float) -> float:
    """Speed at which a straight line from one place to the next has a value."""
    part = (wanted - values[place]) / (values[place + 1] - values[place])
    return float(speed[place] + part * (speed[place + 1] - speed[place]))


def _least_stable(spectrum: Spectrum) -> int:
    """Place of the largest growth, of a pair that of the positive frequency."""
    values = spectrum.values[0]
    pair = _pair(spectrum, int(values.real.argmax()))
    return pair[int(values[pair].imag.argmax())]


def _pair(spectrum: Spectrum, place: int) -> list[int]:
    """Places of an eigenvalue and its conjugate; one of a real eigenvalue."""
    values = spectrum.values[0]
    if values[place].imag == 0.0:
        return [place]
    return [place, int(np.abs(values - values[place].conj()).argmin())]
