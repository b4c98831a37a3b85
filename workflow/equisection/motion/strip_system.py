r"""Structure and aerodynamics of strips as one linear system with a static non-linearity.

A section is one strip with one mode of each kind. A beam has S strips with

    theta(zeta) = sum_i Theta_i f_i(zeta),    w/c = sum_j W_j g_j(zeta),    zeta = z/L,

and per mode, with the weights h_s of the strips (sum 1) and ' = d/ds,

    I_i Theta_i'' - sum_j S_ij W_j''     + C_i Theta_i' + K_i Theta_i = sum_s h_s f_si c_m,ea,s
    m_j W_j''     - sum_i S_ij Theta_i'' + c_j W_j'     + k_j W_j     = sum_s h_s g_sj c_l,s.

I_i, C_i, K_i are generalised inertia, damping and stiffness over (rho/2) c^4, (rho/2) V c^3 and
q c^2, m_j, c_j, k_j over (rho/2) c^2, (rho/2) V c and q, the imbalances S_ij over (rho/2) c^3.
With one strip they are those of the section (:mod:`equisection.beam.section`).

The elastic axis is x_ea chords behind mid-chord. w is its deflection, so that mid-chord moves by
w + x_ea theta, and with this the formulas of :mod:`equisection.aerodynamics.unsteady_loads` stay:
alpha_34 has (r - x_ea) theta', the apparent lift (pi/2) (theta' - w'' - x_ea theta''). The moment
c_m about mid-chord is transferred to the axis with the force normal to the chord,

    c_m,ea = c_m + x_ea (c_l + n(x)),    n(alpha) = c_l (cos alpha - 1) + c_d sin alpha,

where n is that of the steady polar and follows the bubble, as the drag of separated flow does. At
rest c_m,ea is therefore the polar's, and a section diverges where k* is the slope of
c_m + x_ea (c_l cos alpha + c_d sin alpha): c_m' + x_ea (c_l' + c_d) at small incidence. With the
slopes of a thin plate, no drag and no deficit this is Theodorsen's theory about x_ea (NACA Report
496, a = 2 x_ea). The c_l of this transfer is the lift normal to the wind that the strip meets.

The correction for the finite span multiplies c_l and n by one factor and c_m by another, before the
transfer. The induced incidence is quasi-steady,

    alpha_i = D (a_l alpha_E - Delta_l(x)),

and is solved with the rest instead of lagging a step behind (docs/embedded.md on what a
quasi-steady induced incidence leaves out).

With the states Y = (Theta, Theta', W, W', z_1, z_2, y, c) and the deficits
u = (Delta_l, Delta_m) of all strips, with n where an axis is off mid-chord, everything
else is linear:

    Y' = A Y + B u + e,    x = C Y + E u + g.

Where the polar has drag, the wind that a strip meets is turned by w_r' = w' - (r - x_ea) theta'
(:mod:`equisection.aerodynamics.velocity_triangle`). Its lift then has one more deficit,
c - c_y, and Delta_m and n are those of the higher dynamic pressure. They depend on (x, w_r', c,
alpha_S), which take the place of x in the second equation: the *signals* of the strips.

Apparent mass is moved to the left of the equations of motion and so is implicit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.indicial import IMMEDIATE_SHARE, JONES_AMPLITUDES, LAG_RATES
from equisection.aerodynamics.separation import SLOPE_HALF_STEP
from equisection.aerodynamics.unsteady_loads import (
    APPARENT_INERTIA,
    APPARENT_MASS,
    UnsteadyLoads,
)
from equisection.aerodynamics.velocity_triangle import force_across, pressure_rise

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class StripStructure:
    """Modes on strips, for N lanes (cases) at once.

    Parameters
    ----------
    torsion_shapes, bending_shapes
        f_si, shape (S, n_t), and g_sj, shape (S, n_b).
    weights
        h_s, shape (S,), sum 1.
    torsion_inertia, torsion_stiffness
        I_i, K_i, shape (N, n_t).
    bending_mass, bending_stiffness
        m_j, k_j, shape (N, n_b).
    imbalance
        S_ij, shape (N, n_t, n_b).
    torsion_damping, bending_damping
        Matrices C, shape (N, n_t, n_t), and c, shape (N, n_b, n_b); full with dashpots.
    axis
        x_ea, chords from mid-chord back to the elastic axis, shape (N,).
    lift_factor, moment_factor
        Factors of c_l and of c_m about mid-chord (-), shape (N,): 1 without a correction.
    induction
        D (rad), shape (S, S); all zero for a section.
    """

    torsion_shapes: Floats
    bending_shapes: Floats
    weights: Floats
    torsion_inertia: Floats
    torsion_stiffness: Floats
    bending_mass: Floats
    bending_stiffness: Floats
    imbalance: Floats
    torsion_damping: Floats
    bending_damping: Floats
    axis: Floats
    lift_factor: Floats
    moment_factor: Floats
    induction: Floats

    @property
    def is_offset(self) -> bool:
        """Presence of a lane with its elastic axis off mid-chord."""
        return bool(self.axis.any())

    @property
    def lanes(self) -> int:
        """Number N of lanes."""
        return int(self.torsion_inertia.shape[0])

    @property
    def strips(self) -> int:
        """Number S of strips."""
        return int(self.weights.size)


@dataclass(frozen=True)
class StateLayout:
    """Places of each kind of state in Y."""

    torsion_modes: int
    bending_modes: int
    strips: int

    @property
    def size(self) -> int:
        """Number n of states."""
        return 2 * (self.torsion_modes + self.bending_modes) + 4 * self.strips

    @property
    def structural(self) -> int:
        """Number of structural states, which come first."""
        return 2 * (self.torsion_modes + self.bending_modes)

    @property
    def twist(self) -> slice:
        """Place of Theta_i."""
        return slice(0, self.torsion_modes)

    @property
    def twist_rate(self) -> slice:
        """Place of Theta_i'."""
        return slice(self.torsion_modes, 2 * self.torsion_modes)

    @property
    def deflection(self) -> slice:
        """Place of W_j."""
        start = 2 * self.torsion_modes
        return slice(start, start + self.bending_modes)

    @property
    def deflection_rate(self) -> slice:
        """Place of W_j'."""
        start = 2 * self.torsion_modes + self.bending_modes
        return slice(start, start + self.bending_modes)

    def lag(self, number: int) -> slice:
        """Place of z_1, z_2 (number 0, 1), the bubble's y (2) or the circulatory lift c (3)."""
        start = self.structural + number * self.strips
        return slice(start, start + self.strips)


@dataclass(frozen=True)
class StripSystem:
    """The system Y' = A Y + B u + e of N lanes, with n states and columns [Y | u | 1].

    A strip has d deficits (:func:`deficits_of_a_strip`) and p signals: x, and with drag w_r', c and
    alpha_S.

    Parameters
    ----------
    layout
        Places of the states in Y.
    structure, loads
        Structure and loads that the system was assembled from.
    incidence
        theta_0 (rad), shape (N,).
    rates
        [A | B | e], shape (N, n, n + d S + 1).
    probe
        [C | E | g], the signals of the strips, first the incidences x of the bubbles, shape
        (N, p S, n + d S + 1).
    strip_loads
        c_l and c_m of the strips, without a correction, shape (N, 2 S, n + d S + 1); c_m is about
        the moving mid-chord, wherever the axis is.
    axis_moments
        c_m,ea of the strips, those of the equations of motion, shape (N, S, n + d S + 1).
    """

    layout: StateLayout
    structure: StripStructure
    loads: UnsteadyLoads
    incidence: Floats
    rates: Floats
    probe: Floats
    strip_loads: Floats
    axis_moments: Floats

    def deficits(self, signals: Floats) -> Floats:
        """Deficits u, shape (N, d S), at the signals of the strips, shape (N, p S).

        Of a system at rest the bubble incidences x (rad), shape (N, S), are enough.
        """
        strips = self.layout.strips
        x = signals[:, :strips]
        branches = self.loads.branches
        deficits = [branches.lift_deficit(x), branches.moment_deficit(x)]
        if self.structure.is_offset:
            deficits.append(branches.polar.normal_rise(x))
        if self.loads.has_drag:
            moving = signals.shape[1] > strips
            self._turn(deficits, x, signals[:, strips:] if moving else None)
        return np.concatenate(deficits, axis=1)

    def _turn(self, deficits: list[Floats], x: Floats, motion: Floats | None) -> None:
        """Turn the wind by the motion w_r', c, alpha_S of the strips, which None has at rest."""
        if motion is None:
            deficits.append(np.zeros_like(x))
            return
        rate, circulatory, leading = np.split(motion, 3, axis=1)
        branches, rise = self.loads.branches, pressure_rise(rate)
        deficits[1] = deficits[1] - rise * (branches.moment_slope * leading - deficits[1])
        if self.structure.is_offset:
            deficits[2] = deficits[2] + rise * (circulatory + deficits[2])
        drag = branches.polar.drag_coefficient(x)
        deficits.append(circulatory - force_across(circulatory, drag, rate))

    def deficit_slopes(self, signals: Floats) -> Floats:
        """Slopes du/d(signals) by central differences, (N, d S, p S); of x alone (N, d S, S)."""
        strips = self.layout.strips
        own_strip = np.tile(np.eye(strips), (deficits_of_a_strip(self.structure, self.loads), 1))
        slopes = []
        for place in range(signals.shape[1] // strips):
            step = np.zeros(signals.shape[1])
            step[place * strips : (place + 1) * strips] = SLOPE_HALF_STEP
            change = self.deficits(signals + step) - self.deficits(signals - step)
            slopes.append(change[:, :, None] / (2 * SLOPE_HALF_STEP) * own_strip)
        return np.concatenate(slopes, axis=2)

    def of(self, lanes: NDArray[np.bool_]) -> StripSystem:
        """Keep some of the lanes (their matrices only)."""
        return replace(
            self,
            incidence=self.incidence[lanes],
            rates=self.rates[lanes],
            probe=self.probe[lanes],
            strip_loads=self.strip_loads[lanes],
            axis_moments=self.axis_moments[lanes],
        )


def deficits_of_a_strip(structure: StripStructure, loads: UnsteadyLoads) -> int:
    """Return the number d of a strip: Delta_l, Delta_m, n if offset, c - c_y if drag."""
    return 2 + structure.is_offset + loads.has_drag


def assemble(
    structure: StripStructure, loads: UnsteadyLoads, incidence_rad: float | Floats
) -> StripSystem:
    """Assemble the system at rigid incidence theta_0 (rad), one value or one per lane."""
    layout = StateLayout(
        structure.torsion_shapes.shape[1], structure.bending_shapes.shape[1], structure.strips
    )
    rows = _strip_rows(layout, structure, loads)
    twist_acceleration, deflection_acceleration = _accelerations(layout, structure, rows)
    lanes, strips = structure.lanes, structure.strips
    rates = np.zeros((lanes, layout.size, rows.columns))
    unit = np.eye(layout.size, rows.columns)
    rates[:, layout.twist] = unit[layout.twist_rate]
    rates[:, layout.twist_rate] = twist_acceleration
    rates[:, layout.deflection] = unit[layout.deflection_rate]
    rates[:, layout.deflection_rate] = deflection_acceleration
    for number, rate in enumerate(LAG_RATES):
        rates[:, layout.lag(number)] = rate * (rows.rear - unit[layout.lag(number)])
    followed = ((loads.lags.relaxation, rows.leading), (loads.lags.lift_lag, rows.target))
    for number, (lag, target) in enumerate(followed, start=2):
        rate = 1.0 / lag if lag > 0.0 else 1.0  # without lag the state is not read
        rates[:, layout.lag(number)] = rate * (target - unit[layout.lag(number)])
    strip_loads = np.empty((lanes, 2 * strips, rows.columns))
    rise = structure.torsion_shapes @ twist_acceleration
    heave = structure.bending_shapes @ deflection_acceleration
    axis = structure.axis[:, None, None]
    apparent = APPARENT_MASS * (heave + axis * rise)
    strip_loads[:, :strips] = rows.lift - rows.turn - apparent
    strip_loads[:, strips:] = rows.moment - APPARENT_INERTIA * rise
    axis_moments = structure.moment_factor[:, None, None] * strip_loads[:, strips:] + axis * (
        structure.lift_factor[:, None, None] * (rows.lift - apparent + rows.normal_rise)
    )
    probe = np.broadcast_to(rows.signals, (lanes, *rows.signals.shape[1:])).copy()
    constant = np.broadcast_to(np.asarray(incidence_rad, dtype=np.float64), (lanes,))
    for matrix in (rates, probe, strip_loads, axis_moments):
        matrix[:, :, -1] *= constant[:, None]
    return StripSystem(layout, structure, loads, constant, rates, probe, strip_loads, axis_moments)


@dataclass(frozen=True)
class _StripRows:
    """Linear expressions in [Y | u | theta_0] at the strips.

    Each has the shape (N, S, columns), or (1, S, columns) where all lanes have one axis. ``rear``
    is alpha_34, ``leading`` alpha_S, ``target`` what the circulatory lift c follows;
    ``lift`` (before the wind is turned) and ``moment`` (about mid-chord) lack the terms with
    accelerations. ``normal_rise`` is n and ``turn`` c - c_y, of shape (S, columns). ``signals`` are
    those of :class:`StripSystem`, first x, of shape (N or 1, p S, columns).
    """

    columns: int
    rear: Floats
    leading: Floats
    target: Floats
    lift: Floats
    moment: Floats
    normal_rise: Floats
    turn: Floats
    signals: Floats


def _strip_rows(layout: StateLayout, structure: StripStructure, loads: UnsteadyLoads) -> _StripRows:
    strips = layout.strips
    columns = layout.size + deficits_of_a_strip(structure, loads) * strips + 1
    unit = np.eye(columns)
    deficits = iter(unit[layout.size : -1].reshape(-1, strips, columns))
    lift_deficit, moment_deficit = next(deficits), next(deficits)
    none = np.zeros((strips, columns))
    normal_rise = next(deficits) if structure.is_offset else none
    turn = next(deficits) if loads.has_drag else none
    twist_rate = structure.torsion_shapes @ unit[layout.twist_rate]
    axes = structure.axis[:1] if np.ptp(structure.axis) == 0.0 else structure.axis
    rise = (
        structure.bending_shapes @ unit[layout.deflection_rate]
        - (loads.rear_point - axes[:, None, None]) * twist_rate
    )
    geometric = unit[-1] + structure.torsion_shapes @ unit[layout.twist] - rise
    lagging = sum(
        (a * unit[layout.lag(i)] for i, a in enumerate(JONES_AMPLITUDES)),
        start=np.zeros((strips, columns)),
    )
    slope, lags = loads.branches.lift_slope, loads.lags
    rear = np.linalg.solve(
        np.eye(strips) + IMMEDIATE_SHARE * slope * structure.induction,
        geometric - structure.induction @ (slope * lagging - lift_deficit),
    )
    effective = IMMEDIATE_SHARE * rear + lagging
    leading = effective - loads.rear_point * twist_rate
    bubble = leading
    if lags.relaxation > 0.0:
        follower = unit[layout.lag(2)]
        bubble = follower - (lags.delay / lags.relaxation) * (leading - follower)
    target = slope * effective - lift_deficit
    circulatory = unit[None, layout.lag(3)] if lags.lift_lag > 0.0 else target
    lift = circulatory + APPARENT_MASS * twist_rate
    moment = loads.branches.moment_slope * leading - moment_deficit
    kinds = [bubble, rise, circulatory, leading] if loads.has_drag else [bubble]
    shape = np.broadcast_shapes(*(kind.shape for kind in kinds))
    signals = np.concatenate([np.broadcast_to(kind, shape) for kind in kinds], axis=1)
    return _StripRows(columns, rear, leading, target, lift, moment, normal_rise, turn, signals)


def _accelerations(
    layout: StateLayout, structure: StripStructure, rows: _StripRows
) -> tuple[Floats, Floats]:
    """Theta'' and W'' in [Y | u | theta_0], shapes (N, n_t, columns) and (N, n_b, columns)."""
    unit = np.eye(layout.size, rows.columns)
    weighted_f = structure.weights[:, None] * structure.torsion_shapes
    weighted_g = structure.weights[:, None] * structure.bending_shapes
    axis, lift_factor, moment_factor = (
        values[:, None, None]
        for values in (structure.axis, structure.lift_factor, structure.moment_factor)
    )
    inertia, mass, across = mass_with_air(structure)
    lift = lift_factor * rows.lift
    torque = (
        weighted_f.T
        @ (moment_factor * rows.moment + axis * (lift + lift_factor * rows.normal_rise))
        - structure.torsion_stiffness[:, :, None] * unit[layout.twist]
        - structure.torsion_damping @ unit[layout.twist_rate]
    )
    force = (
        weighted_g.T @ (lift - lift_factor * rows.turn)
        - structure.bending_stiffness[:, :, None] * unit[layout.deflection]
        - structure.bending_damping @ unit[layout.deflection_rate]
    )
    if structure.imbalance.any() or structure.is_offset:
        return _coupled(inertia, mass, across, torque, force)
    twist = np.asarray(np.linalg.solve(inertia, torque), dtype=np.float64)
    deflection = np.asarray(np.linalg.solve(mass, force), dtype=np.float64)
    return twist, deflection


def mass_with_air(structure: StripStructure) -> tuple[Floats, Floats, Floats]:
    """Generalised inertia, mass and imbalance of the modes with the apparent mass of the air.

    Of rows and columns (Theta, W) they are the blocks of the first, of the second and between, of
    shapes (N, n_t, n_t), (N, n_b, n_b) and (N, n_t, n_b).
    """
    weighted_f = structure.weights[:, None] * structure.torsion_shapes
    weighted_g = structure.weights[:, None] * structure.bending_shapes
    axis, lift_factor, moment_factor = (
        values[:, None, None]
        for values in (structure.axis, structure.lift_factor, structure.moment_factor)
    )
    both_f = weighted_f.T @ structure.torsion_shapes
    inertia = (
        diagonal(structure.torsion_inertia)
        + moment_factor * APPARENT_INERTIA * both_f
        + lift_factor * APPARENT_MASS * axis**2 * both_f
    )
    mass = diagonal(structure.bending_mass) + lift_factor * APPARENT_MASS * (
        weighted_g.T @ structure.bending_shapes
    )
    across = lift_factor * APPARENT_MASS * axis * (weighted_f.T @ structure.bending_shapes)
    return inertia, mass, across - structure.imbalance


def _coupled(
    inertia: Floats, mass: Floats, across: Floats, torque: Floats, force: Floats
) -> tuple[Floats, Floats]:
    """Theta'' and W'' of twist and deflection that imbalance and apparent mass couple."""
    matrix = np.concatenate(
        [
            np.concatenate([inertia, across], axis=2),
            np.concatenate([across.transpose(0, 2, 1), mass], axis=2),
        ],
        axis=1,
    )
    both = np.asarray(
        np.linalg.solve(matrix, np.concatenate([torque, force], axis=1)), dtype=np.float64
    )
    return both[:, : torque.shape[1]], both[:, torque.shape[1] :]


def diagonal(values: Floats) -> Floats:
    """Diagonal matrices, shape (N, m, m), of values of shape (N, m)."""
    return np.asarray(values[:, :, None] * np.eye(values.shape[1]), dtype=np.float64)
