"""Signs, symbols, units and non-dimensional numbers: stated here, once, for everything.

Axes
    x chordwise and streamwise, y up (the direction of lift), z along the span with the root
    at z = 0. Positions along the span are given as z/L.
Twist and incidence
    Twist theta (rad) is positive nose up and is counted from the rigid incidence theta_0, so
    the incidence of a section is theta_0 + theta. Names that end in ``_deg`` are in degrees;
    every other angle is in radians.
Deflection
    w (m) is positive up; ``_chords`` marks w/c.
Moment
    Moment coefficients are about mid-chord, nose up, about the *moving* mid-chord. The elastic
    axis, about which a section turns and whose deflection is w, is mid-chord unless
    ``elastic_axis`` (x/c from the leading edge) says otherwise. x_ea is counted from mid-chord,
    aft, in chords: c_m about the axis is c_m + x_ea (c_l cos alpha + c_d sin alpha).
Dynamic pressure
    q = rho V^2 / 2. Section coefficients are c_l = F_L'/(q c), c_m = M'/(q c^2) (Eq. 21),
    those of the beam C_L = F_L/(q L c), C_M = M/(q L c^2) (Eq. 22).
Time
    s = t V / c, the convective time, is the time of everything that runs. Figures use
    t* = s sqrt(k*/I*).
Non-dimensional numbers (Eq. 18)
    k* = k_theta/(q c^2), I* = I_2D/(rho c^4/2), m* = m_2D/(rho c^2/2), k_w* = k_w/q, with
    which the section obeys

        I* theta'' + k* theta = c_m,    m* (w/c)'' + k_w* (w/c) = c_l,    ' = d/ds,

    where its axes are at mid-chord and it has no dampers (:mod:`equisection.beam.section`).

    The k* on every axis is that of Eq. 17 in the paper's form: the uncorrected structural
    stiffness, with K_theta from the slope of the first torsion shape. It is a measure of all of the
    beam's stiffness, with root springs, over q: all models at one k* are the same beam, and
    another k* is that beam at another dynamic pressure. (With shapes from three-dimensional
    elasticity the consistent section of that beam is some 6 % stiffer than k* says, since
    warping is restrained at the clamp; see docs/errata.md.)
Incidence that a moving section sees
    At the elastic axis theta_0 + theta - d(w/c)/ds; at three quarters of the chord, where the
    circulation is set, theta_0 + theta + (1/4 - x_ea) dtheta/ds - d(w/c)/ds.
Modes
    Shapes are normalised to a largest absolute value of 1 along the span, which is the tip
    for the first modes of a cantilever.
"""

from __future__ import annotations

import math

#: Largest |c_l| or |c_m| of a symmetric section at zero incidence that still counts as round-off.
SYMMETRY_TOLERANCE = 1e-4

#: Density (kg/m3) of air at sea level in the International Standard Atmosphere (ISO 2533:1975).
STANDARD_AIR = 1.225


def dynamic_pressure(density: float, speed: float) -> float:
    """Dynamic pressure q = rho V^2 / 2 (Pa)."""
    return 0.5 * density * speed**2


def reduced_time_factor(k_star: float, i_star: float) -> float:
    """Factor from convective time s to the paper's t* = s sqrt(k*/I*) (caption of Fig. 16)."""
    return math.sqrt(k_star / i_star)
