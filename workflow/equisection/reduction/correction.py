"""Correction of the section for the finite span (Eq. 20), and the incidence that it is made for.

The aerodynamic coefficients of the beam replace those of the section when mass and stiffness of
the section are multiplied by

    lift factor = c_l(alpha)/C_L(alpha),    moment factor = c_m(alpha)/C_M(alpha)

(Eqs. 19, 20), the first for m_2D and k_w, the second for I_2D and k_theta. A symmetric section
has 0/0 at zero incidence. The quotient is continuous there: it is that of c_l/alpha and C_L/alpha,
which tend to the slopes. A polar that is given from zero incidence on is continued by symmetry, so
that the quotient is the same whether its other half is listed or not. Where only one of the two
vanishes, or they differ in sign, the corrected mass would be zero, infinite or negative: there is
no factor (NaN), and no equivalent section for a beam whose equilibrium is there.

Taken at every instant the factors would make the mass depend on the angle. They are taken once,
at the aeroelastic equilibrium, where the corrected section obeys

    (c_m/C_M) k* theta = c_m(theta_0 + theta)     or     k* theta = C_M(theta_0 + theta),
    (c_l/C_L) k_w* w/c = c_l(theta_0 + theta)     or     k_w* w/c = C_L(theta_0 + theta),

so the equilibrium follows from the beam's polar alone.

A section with an imbalance couples both rows, and one factor on each would leave no body; about an
axis off mid-chord c_m,ea/C_M,ea means nothing near the quarter chord, where both vanish. Of such a
section the loads are multiplied instead, by C_L/c_l and by C_M/c_m about mid-chord, before the
moment is transferred to the axis x_ea chords behind mid-chord. Its equilibrium is at

    k* theta = C_M + x_ea (C_L cos alpha + C_D sin alpha).

Of several roots the one is taken that is
met first when theta grows from zero in the direction of the moment. There k* exceeds the slope
of C_M: it is statically stable. No root inside the polar means divergence, or a short polar.
Without a moment at theta_0 the section stays there, or diverges where k* does not exceed the slope.
A solver's residue of zero counts as no moment.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.polar import Polar, is_nil
from equisection.errors import DivergenceError, ReductionError

Floats = NDArray[np.float64]

#: Incidence (rad) up to which theta_0 stands at the end of a polar.
_NO_WAY = 1e-9


@dataclass(frozen=True)
class CorrectionFactors:
    """Factors of Eq. 20 against incidence.

    Attributes
    ----------
    section
        c_l, c_m of the two-dimensional section.
    beam
        C_L, C_M of the rigid, untwisted beam.
    """

    section: Polar
    beam: Polar

    def lift_factor(self, alpha: ArrayLike) -> Floats:
        """c_l/C_L (1) at ``alpha`` (rad, any shape): the factor of m_2D and k_w.

        NaN where it is not a positive number.

        Raises
        ------
        IncidenceOutOfRangeError
            A polar, continued by symmetry, does not cover ``alpha``.
        """
        section, beam = self._covering(alpha)
        return _quotient(section.lift_cubic, beam.lift_cubic, alpha)

    def moment_factor(self, alpha: ArrayLike) -> Floats:
        """c_m/C_M (1) at ``alpha`` (rad, any shape): the factor of I_2D and k_theta.

        NaN where it is not a positive number.

        Raises
        ------
        IncidenceOutOfRangeError
            A polar, continued by symmetry, does not cover ``alpha``.
        """
        section, beam = self._covering(alpha)
        return _quotient(section.moment_cubic, beam.moment_cubic, alpha)

    def _covering(self, alpha: ArrayLike) -> tuple[Polar, Polar]:
        """Return both polars, a half one continued by symmetry."""
        section, beam = self.section.continued, self.beam.continued
        section.require(alpha)
        beam.require(alpha)
        return section, beam


@dataclass(frozen=True, eq=False)
class CorrectedEquilibrium:
    """The corrected section at rest in the flow, one entry for each k*.

    Attributes
    ----------
    k_star
        k* (1) of the uncorrected structural stiffness, shape (m,).
    twist_rad
        theta (rad), nose up, beyond theta_0, shape (m,).
    deflection_chords
        w/c (1), shape (m,).
    lift_factor, moment_factor
        Eq. 20 at theta_0 + theta, shape (m,).
    """

    k_star: Floats
    twist_rad: Floats
    deflection_chords: Floats
    lift_factor: Floats
    moment_factor: Floats


def corrected_equilibrium(
    factors: CorrectionFactors,
    incidence_rad: float,
    k_star: ArrayLike,
    stiffness_ratio: float,
    axis: float = 0.0,
) -> CorrectedEquilibrium:
    """Find the static equilibrium of the corrected section, and the factors there.

    Parameters
    ----------
    factors
        Polars of section and beam.
    incidence_rad
        theta_0 (rad).
    k_star
        k* (1), scalar or shape (m,).
    stiffness_ratio
        c^2 k_w/k_theta = k_w*/k* (1).
    axis
        x_ea, chords from mid-chord back to the elastic axis.

    Raises
    ------
    DivergenceError
        The moment outgrows the stiffness at a k*.
    ReductionError
        The beam's polar ends before an equilibrium, or a factor is not a positive number there.
    IncidenceOutOfRangeError
        A polar does not cover theta_0 or the equilibrium.
    """
    stiffness = np.atleast_1d(np.asarray(k_star, dtype=np.float64))
    section, beam = factors.section.continued, factors.beam.continued
    beam.require(incidence_rad)
    twist = np.array([_first_twist(beam, incidence_rad, float(k), axis) for k in stiffness])
    incidence = incidence_rad + twist
    lift_factor, moment_factor = factors.lift_factor(incidence), factors.moment_factor(incidence)
    _require_factor(lift_factor, section.lift_cubic, beam.lift_cubic, incidence, "C_L")
    _require_factor(moment_factor, section.moment_cubic, beam.moment_cubic, incidence, "C_M")
    return CorrectedEquilibrium(
        k_star=stiffness,
        twist_rad=twist,
        deflection_chords=beam.lift_cubic(incidence) / (stiffness_ratio * stiffness),
        lift_factor=lift_factor,
        moment_factor=moment_factor,
    )


def _quotient(
    section: scipy.interpolate.PchipInterpolator,
    beam: scipy.interpolate.PchipInterpolator,
    alpha: ArrayLike,
) -> Floats:
    """Return c/C of two curves; NaN where it is not a positive number."""
    incidence = np.asarray(alpha, dtype=np.float64)
    if _vanishes_at_zero(section) and _vanishes_at_zero(beam):
        above, below = _mean_slope(section, incidence), _mean_slope(beam, incidence)
    else:
        above, below = section(incidence), beam(incidence)
    is_positive = above * below > 0
    quotient: Floats = np.where(is_positive, above / np.where(is_positive, below, 1.0), np.nan)
    return quotient


def _require_factor(
    factor: Floats,
    section: scipy.interpolate.PchipInterpolator,
    beam: scipy.interpolate.PchipInterpolator,
    incidence: Floats,
    name: str,
) -> None:
    """Raise ReductionError unless there is a factor at every equilibrium."""
    bad = np.isnan(factor)
    if np.any(bad):
        worst = float(incidence[bad][0])
        raise ReductionError(
            f"the correction factor {name.lower()}/{name} is not a positive number at the "
            f"equilibrium's incidence of {np.degrees(worst):.4g} deg: the beam's {name} is "
            f"{float(beam(worst)):.4g}, the section's {name.lower()} {float(section(worst)):.4g}; "
            "choose another incidence, or run without the correction"
        )


def _vanishes_at_zero(curve: scipy.interpolate.PchipInterpolator) -> bool:
    """Tell whether a curve passes through zero, but for what a solver leaves of zero."""
    return _is_nil(curve, 0.0)


def _is_nil(curve: scipy.interpolate.PPoly, alpha: float) -> bool:
    """Tell whether a curve vanishes at ``alpha`` (rad), but for what a solver leaves of zero."""
    return is_nil(float(curve(alpha)), curve(curve.x))


def _mean_slope(curve: scipy.interpolate.PchipInterpolator, incidence: Floats) -> Floats:
    """(c(alpha) - c(0))/alpha (1/rad) of a curve through zero, with its limit at alpha = 0.

    c(0) is what a solver leaves of zero. It is the mean of the slope between zero and alpha. Up
    to the first knot the slope is quadratic and Gauss' rule of two points is exact, without the
    division of zero by zero.
    """
    first_knot = np.min(np.abs(curve.x[curve.x != 0]))
    near = np.abs(incidence) <= first_knot
    lower, upper = 0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0)
    mean = 0.5 * (curve(lower * incidence, 1) + curve(upper * incidence, 1))
    secant: Floats = np.where(
        near, mean, (curve(incidence) - curve(0.0)) / np.where(near, 1.0, incidence)
    )
    return secant


def _first_twist(beam: Polar, incidence_rad: float, k_star: float, axis: float) -> float:
    """First root theta of k* theta = C_M(theta_0 + theta) from zero on (rad)."""
    cubic = beam.moment_cubic_about(axis)
    moment, slope = float(cubic(incidence_rad)), float(cubic(incidence_rad, 1))
    if _is_nil(cubic, incidence_rad):
        if k_star > slope:
            return 0.0
        raise DivergenceError(
            f"at k* = {k_star:.4g} the undeflected state is statically unstable: at theta_0 = "
            f"{np.degrees(incidence_rad):.4g} deg polar {beam.label!r} has no moment, but a slope "
            f"of {slope:.4g}, which outgrows the stiffness (static divergence)"
        )
    coefficients = cubic.c.copy()  # of C_M(alpha) - k* (alpha - theta_0), knot by knot
    coefficients[2] -= k_star
    coefficients[3] -= k_star * (cubic.x[:-1] - incidence_rad)
    roots = scipy.interpolate.PPoly(coefficients, cubic.x).roots(extrapolate=False)
    twists = (roots - incidence_rad) * np.sign(moment)
    ahead = twists[twists > 0]
    if ahead.size == 0:
        raise _no_equilibrium(beam, cubic, incidence_rad, k_star)
    return float(np.min(ahead) * np.sign(moment))


def _no_equilibrium(
    beam: Polar, cubic: scipy.interpolate.PPoly, incidence_rad: float, k_star: float
) -> ReductionError:
    end = beam.incidence_range[0 if cubic(incidence_rad) < 0 else 1]
    has_a_way = abs(end - incidence_rad) > _NO_WAY
    if has_a_way and float(cubic(end, 1)) >= k_star:  # the gap still widens where the polar ends
        return DivergenceError(_diverges(beam, incidence_rad, k_star))
    nothing = _nothing_inside(beam, incidence_rad, k_star)
    return ReductionError(
        f"{nothing}: the polar is too short; give it more incidences (steady.incidence_deg, or the "
        "file of steady.beam_polar) or raise k*"
    )


def _diverges(beam: Polar, incidence_rad: float, k_star: float) -> str:
    nothing = _nothing_inside(beam, incidence_rad, k_star)
    return f"{nothing}: the moment outgrows the stiffness (static divergence)"


def _nothing_inside(beam: Polar, incidence_rad: float, k_star: float) -> str:
    least, greatest = np.degrees(beam.incidence_range)
    return (
        f"no static equilibrium at k* = {k_star:.4g} from theta_0 = "
        f"{np.degrees(incidence_rad):.4g} deg inside polar {beam.label!r} ({least:.4g} to "
        f"{greatest:.4g} deg)"
    )
