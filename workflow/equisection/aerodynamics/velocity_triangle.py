r"""The velocity triangle of a section that moves across the wind.

A section that rises at the rate w_r' (over V) meets a wind that is turned down by
phi = arctan(w_r') and faster by the factor sqrt(1 + w_r'^2). Lift and drag are normal to that wind
and along it, so that the force normal to the oncoming flow is, over q c,

    c_y = (1 + w_r'^2) (c_l cos phi - c_d sin phi) = sqrt(1 + w_r'^2) (c_l - c_d w_r'),

with the coefficients of the incidence alpha - phi. The heave damping of a section at rest is then
c_l' + c_d and not c_l' alone: Den Hartog's criterion of galloping (J. P. Den Hartog, *Mechanical
Vibrations*, section on galloping transmission lines). Forces normal to the chord, and the moment,
are those at the incidence alpha - phi, times 1 + w_r'^2.

Incidences are linear in the rates elsewhere (alpha - w_r' for alpha - phi), which is right to the
second order of w_r'. Apparent mass is not turned.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def force_across(lift: Floats, drag: Floats, rate: Floats) -> Floats:
    """Force c_y normal to the oncoming flow (-), of a section with c_l and c_d (-).

    Parameters
    ----------
    lift, drag
        c_l and c_d (-) in the wind that the section meets.
    rate
        w_r' over V (-), up, of the point whose incidence they are of; all of one shape.
    """
    return np.asarray(np.sqrt(1.0 + rate**2) * (lift - drag * rate), dtype=np.float64)


def pressure_rise(rate: Floats) -> Floats:
    """Rise w_r'^2 of the dynamic pressure of the wind that the section meets, over q (-)."""
    return np.asarray(rate**2, dtype=np.float64)
