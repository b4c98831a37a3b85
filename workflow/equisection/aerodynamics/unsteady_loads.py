"""Unsteady lift and moment of strips: Wagner lag, apparent mass and a lagging bubble.

At each strip, with theta the twist, w the deflection in chords and ' = d/ds,

    alpha_34 = theta_0 + theta + r theta' - w' - alpha_i          incidence at 3/4 chord, r = 1/4
    z_i'     = 2 b_i (alpha_34 - z_i),  i = 1, 2                   Wagner lag (``indicial``)
    alpha_E  = (1 - A_1 - A_2) alpha_34 + A_1 z_1 + A_2 z_2        effective incidence
    alpha_S  = alpha_E - r theta'                                  incidence of the leading edge
    tau_1 x' + x = alpha_S - tau_2 alpha_S'                        bubble (``separation``)
    c* = a_l alpha_E - Delta_l(x),    tau_3 c_lag' + c_lag = c*
    c = c* - b(x) (c* - c_lag)                                     circulatory lift
    c_l = sqrt(1 + w_r'^2) (c - c_d(x) w_r') + (pi/2) (theta' - w'')
    c_m = (1 + w_r'^2) (a_m alpha_S - Delta_m(x)) - (pi/64) theta'',    w_r' = w' - r theta'

alpha_i is the incidence that the wake of a finite beam induces; zero for a section. The terms
with pi are Theodorsen's apparent-mass terms about mid-chord (NACA Report 496 with a = 0), those of
a thin plate in free air. c_l is normal to the oncoming flow: the wind that a moving section meets
is turned by arctan(w_r') (:mod:`equisection.aerodynamics.velocity_triangle`), so drag damps heave.
Without any drag in the polar, as in thin-plate theory, the loads are linear in the motion: the
wind is not turned, and w_r' above is 0.

r is the distance of the *incidence point* behind mid-chord. A quarter of the chord, at 3/4 chord,
is that of a thin plate, whose wake leaves at a sharp trailing edge. Of a bluff section the point is
not known; quasi-steady theory takes one between mid-chord (r = 0) and there.

The suction at the leading edge is proportional to alpha_S: (sqrt 2/2)(2 C Q - b theta') of
Garrick (NACA Report 567), the first coefficient A_0 of thin-airfoil theory. This suction makes the
flow separate at the sharp edge, so alpha_S and not alpha_E drives the bubble (Ramesh et al.,
J. Fluid Mech. 751, 2014). The moment of a thin plate about mid-chord is that of its leading edge:
Theodorsen's (pi/2) alpha_E - (pi/8) theta' is (pi/2) alpha_S. Here the polar's slope a_m takes the
place of pi/2.
With a_l = 2 pi, a_m = pi/2, no drag and no deficit this *is* Theodorsen's theory, whatever the
lags.

The derivative of alpha_S is not needed: with y' = (alpha_S - y)/tau_1,

    x = (1 + tau_2/tau_1) y - (tau_2/tau_1) alpha_S.

So all states are linear and the only non-linear functions are Delta_l(x), Delta_m(x) and b(x); the
time loop makes use of that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, Branches, SeparationLags
from equisection.aerodynamics.velocity_triangle import force_across, pressure_rise
from equisection.aerodynamics.wake_lags import JONES, WakeLags

Floats = NDArray[np.float64]

APPARENT_MASS = math.pi / 2
"""Lift against heave acceleration and with pitch rate: (pi/2) (theta' - w'')."""

APPARENT_INERTIA = math.pi / 64
"""Moment against pitch acceleration: -(pi/64) theta''."""


REAR_POINT = 0.25
"""Chords r of a thin plate, from mid-chord back to the point whose incidence sets circulation."""


@dataclass(frozen=True)
class UnsteadyLoads:
    """The unsteady loads of one polar.

    Attributes
    ----------
    branches
        Branches of the polar.
    lags
        Lags of its bubble.
    rear_point
        r, chords from mid-chord back to the point whose incidence sets the circulation.
    """

    branches: Branches
    lags: SeparationLags
    rear_point: float = REAR_POINT

    @classmethod
    def from_polar(
        cls,
        polar: Polar,
        lags: SeparationLags = IDENTIFIED_LAGS,
        rear_point: float = REAR_POINT,
    ) -> UnsteadyLoads:
        """Take the polar's own slopes at zero lift as the attached branch."""
        return cls(Branches.from_polar(polar), lags, rear_point)

    @property
    def lift_lags(self) -> bool:
        """Presence of a lag of the lift of separated flow."""
        return self.lags.lift_lag > 0.0

    @property
    def has_drag(self) -> bool:
        """Presence of drag in the polar, with which the wind is turned by the motion."""
        return bool(self.branches.polar.drag.any())


@dataclass(frozen=True)
class ForcedMotion:
    """Prescribed motion of one section at uniform times.

    Parameters
    ----------
    time
        s = tV/c, uniform, shape (n,).
    incidence
        theta_0 + theta (rad), shape (n,).
    deflection
        w/c, shape (n,).
    """

    time: Floats
    incidence: Floats
    deflection: Floats

    @property
    def time_step(self) -> float:
        """Interval of the samples in convective times."""
        return float(self.time[1] - self.time[0])


@dataclass(frozen=True)
class LoadHistory:
    """Loads under prescribed motion, each of shape (n,).

    ``lift_coefficient`` c_l; ``moment_coefficient`` c_m about the moving mid-chord;
    ``effective_incidence`` alpha_E (rad).
    """

    lift_coefficient: Floats
    moment_coefficient: Floats
    effective_incidence: Floats


def follow(signal: Floats, rate: float, time_step: float) -> Floats:
    """State z of z' = rate (signal - z), exact for a signal linear between its samples.

    Starts in equilibrium with the first sample. Shape (n,) in and out.
    """
    decay = math.exp(-rate * time_step)
    mean = (1.0 - decay) / (rate * time_step)
    old, new = mean - decay, 1.0 - mean
    change = signal - signal[0]
    followed, _ = scipy.signal.lfilter([new, old], [1.0, -decay], change, zi=[0.0])
    return np.asarray(followed + signal[0], dtype=np.float64)


def forced_loads(motion: ForcedMotion, loads: UnsteadyLoads, wake: WakeLags = JONES) -> LoadHistory:
    """Find the loads under prescribed motion, from equilibrium at the first sample.

    Parameters
    ----------
    motion
        The motion.
    loads
        Unsteady loads of a polar.
    wake
        Lags of the circulation; by default those of the free motions.
    """
    step = motion.time_step
    pitch_rate = np.gradient(motion.incidence, step)
    heave_rate = np.gradient(motion.deflection, step)
    rise = heave_rate - loads.rear_point * pitch_rate
    rear = motion.incidence - rise
    effective = wake.immediate * rear
    for amplitude, rate in zip(wake.amplitudes, wake.rates, strict=True):
        effective = effective + amplitude * follow(rear, rate, step)
    lags, branches = loads.lags, loads.branches
    leading = effective - loads.rear_point * pitch_rate
    bubble = adapted_incidence(leading, lags, step)
    lift = branches.lift_slope * effective - branches.lift_deficit(bubble)
    if loads.lift_lags:
        lagging = follow(lift, 1.0 / lags.lift_lag, step)
        lift = lift - branches.lag_share(bubble) * (lift - lagging)
    moment = branches.moment_slope * leading - branches.moment_deficit(bubble)
    if loads.has_drag:
        lift = force_across(lift, branches.polar.drag_coefficient(bubble), rise)
        moment = moment * (1.0 + pressure_rise(rise))
    lift = lift + APPARENT_MASS * (pitch_rate - np.gradient(heave_rate, step))
    moment = moment - APPARENT_INERTIA * np.gradient(pitch_rate, step)
    return LoadHistory(lift, moment, effective)


def adapted_incidence(leading: Floats, lags: SeparationLags, time_step: float) -> Floats:
    """Incidence x (rad) to which the bubble has adapted under a history of alpha_S (rad)."""
    if lags.relaxation == 0.0:
        return leading
    follower = follow(leading, 1.0 / lags.relaxation, time_step)
    return follower - (lags.delay / lags.relaxation) * (leading - follower)
