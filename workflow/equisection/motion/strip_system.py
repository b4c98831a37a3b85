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
transfer. The wake of a finite beam induces incidence along span and chord with its own states
(:mod:`equisection.aerodynamics.unsteady_induction`),

    q_p' = p (c - q_p),    alpha_i = sum_p R_p q_p,    gamma = kappa sum_p 2 (R_p - Q_p) q_p,

so that nothing is induced at once. The rise gamma of alpha_i along the chord acts on the leading
edge as a pitch rate does, alpha_S = alpha_E - r (theta' - gamma); the air moves with the apparent
mass of the whole beam (:mod:`equisection.aerodynamics.apparent_mass`).

With the states Y = (Theta, Theta', W, W', z_1, z_2, y, c_lag, q_p) and the deficits
u = (Delta_l, Delta_m) of all strips, with n where an axis is off mid-chord and b(x) y_3 where the
lift lags, everything else is linear:

    Y' = A Y + B u + e,    (x, a_l alpha_E, c_lag, ...) = C Y + g.

Where the polar has drag, the wind that a strip meets is turned by w_r' = w' - (r - x_ea) theta'
(:mod:`equisection.aerodynamics.velocity_triangle`). Its lift then has one more deficit,
c - c_y, and Delta_m and n are those of the higher dynamic pressure. What the deficits depend on are
the *signals* of the strips: x, then a_l alpha_E and c_lag where the lift lags, then a_l alpha_E
(if not there yet), w_r' and alpha_S where there is drag.

Apparent mass is moved to the left of the equations of motion and so is implicit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.indicial import IMMEDIATE_SHARE, JONES_AMPLITUDES, LAG_RATES
from equisection.aerodynamics.separation import SLOPE_HALF_STEP
from equisection.aerodynamics.unsteady_induction import CURVATURE_SHARE
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
    span
        Induction and apparent mass of the strips on each other; None for those of a section, or of
        a beam between walls.
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
    span: FiniteSpan | None = None

    @property
    def is_offset(self) -> bool:
        """Presence of a lane with its elastic axis off mid-chord."""
        return bool(self.axis.any())

    @property
    def apparent(self) -> tuple[Floats, Floats]:
        """Apparent mass and inertia of the strips (-), each of shape (S, S)."""
        if self.span is None:
            unit = np.eye(self.strips)
            return APPARENT_MASS * unit, APPARENT_INERTIA * unit
        return self.span.apparent.mass, self.span.apparent.inertia

    @property
    def lanes(self) -> int:
        """Number N of lanes."""
        return int(self.torsion_inertia.shape[0])

    @property
    def strips(self) -> int:
        """Number S of strips."""
        return int(self.weights.size)

    @property
    def natural_frequencies(self) -> tuple[Floats, Floats]:
        """Frequencies omega c/V of torsion and bending modes in vacuum, without imbalance.

        They have the shapes (N, n_t) and (N, n_b).
        """
        return (
            np.sqrt(self.torsion_stiffness / self.torsion_inertia),
            np.sqrt(self.bending_stiffness / self.bending_mass),
        )

    @property
    def middles(self) -> Floats:
        """Middles z/L of the strips, shape (S,)."""
        return np.asarray(np.cumsum(self.weights) - 0.5 * self.weights)


@dataclass(frozen=True)
class StateLayout:
    """Places of each kind of state in Y."""

    torsion_modes: int
    bending_modes: int
    strips: int
    induction_states: int = 0

    @property
    def size(self) -> int:
        """Number n of states."""
        return self.structural + (4 + self.induction_states) * self.strips

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
        """Place of z_1, z_2 (number 0, 1), the bubble's y (2), c_lag (3) or the q_p (4 on)."""
        start = self.structural + number * self.strips
        return slice(start, start + self.strips)


@dataclass(frozen=True)
class StripSystem:
    """The system Y' = A Y + B u + e of N lanes, with n states and columns [Y | u | 1].

    A strip has d deficits (:func:`deficits_of_a_strip`) and p signals, as the module has them.

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
        [C | 0 | g], the signals of the strips, first the incidences x of the bubbles, shape
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
        strips, branches = self.layout.strips, self.loads.branches
        parts = iter([signals[:, at : at + strips] for at in range(0, signals.shape[1], strips)])
        x = next(parts)
        lift_deficit, moment_deficit = branches.lift_deficit(x), branches.moment_deficit(x)
        normal = [branches.polar.normal_rise(x)] if self.structure.is_offset else []
        if signals.shape[1] == strips:  # at rest the lift has caught up, and the wind is straight
            none = [np.zeros_like(x)] * (self.loads.lift_lags + self.loads.has_drag)
            return np.concatenate([lift_deficit, moment_deficit, *normal, *none], axis=1)
        circulatory = next(parts) - lift_deficit
        missing = []
        if self.loads.lift_lags:
            missing = [branches.lag_share(x) * (circulatory - next(parts))]
            circulatory = circulatory - missing[0]
        turn = []
        if self.loads.has_drag:
            rate, leading = parts
            rise = pressure_rise(rate)
            moment_deficit = moment_deficit - rise * (
                branches.moment_slope * leading - moment_deficit
            )
            normal = [each + rise * (circulatory + each) for each in normal]
            drag = branches.polar.drag_coefficient(x)
            turn = [circulatory - force_across(circulatory, drag, rate)]
        return np.concatenate([lift_deficit, moment_deficit, *normal, *missing, *turn], axis=1)

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
    """Return the number d of a strip.

    Delta_l, Delta_m, n if offset, b(x) y_3 if the lift lags, c - c_y if there is drag.
    """
    return 2 + structure.is_offset + loads.lift_lags + loads.has_drag


def assemble(
    structure: StripStructure, loads: UnsteadyLoads, incidence_rad: float | Floats
) -> StripSystem:
    """Assemble the system at rigid incidence theta_0 (rad), one value or one per lane."""
    layout = StateLayout(
        structure.torsion_shapes.shape[1],
        structure.bending_shapes.shape[1],
        structure.strips,
        0 if structure.span is None else structure.span.states.rates.size,
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
    if structure.span is not None:
        for number, rate in enumerate(structure.span.states.rates, start=4):
            rates[:, layout.lag(number)] = rate * (rows.circulatory - unit[layout.lag(number)])
    strip_loads = np.empty((lanes, 2 * strips, rows.columns))
    mass, inertia = structure.apparent
    rise = structure.torsion_shapes @ twist_acceleration
    heave = structure.bending_shapes @ deflection_acceleration
    axis = structure.axis[:, None, None]
    apparent = mass @ (heave + axis * rise)
    strip_loads[:, :strips] = rows.lift - rows.turn - apparent
    strip_loads[:, strips:] = rows.moment - inertia @ rise
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
    is alpha_34, ``leading`` alpha_S, ``circulatory`` c and ``target`` what c_lag follows;
    ``lift`` (before the wind is turned) and ``moment`` (about mid-chord) lack the terms with
    accelerations. ``normal_rise`` is n and ``turn`` c - c_y, of shape (S, columns). ``signals`` are
    those of :class:`StripSystem`, first x, of shape (N or 1, p S, columns).
    """

    columns: int
    rear: Floats
    leading: Floats
    target: Floats
    circulatory: Floats
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
    missing = next(deficits) if loads.lift_lags else none
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
    induced, curvature = _induced(layout, structure, columns)
    rear = geometric - induced
    effective = IMMEDIATE_SHARE * rear + lagging
    leading = effective - loads.rear_point * (twist_rate - curvature)
    bubble = leading
    if lags.relaxation > 0.0:
        follower = unit[layout.lag(2)]
        bubble = follower - (lags.delay / lags.relaxation) * (leading - follower)
    target = slope * effective - lift_deficit
    circulatory = target - missing
    lift = circulatory + structure.apparent[0] @ twist_rate
    moment = loads.branches.moment_slope * leading - moment_deficit
    kinds = [bubble]
    if loads.lift_lags or loads.has_drag:
        kinds.append(slope * effective)
    if loads.lift_lags:
        kinds.append(unit[None, layout.lag(3)])
    if loads.has_drag:
        kinds += [rise, leading]
    shape = np.broadcast_shapes(*(kind.shape for kind in kinds))
    signals = np.concatenate([np.broadcast_to(kind, shape) for kind in kinds], axis=1)
    return _StripRows(
        columns, rear, leading, target, circulatory, lift, moment, normal_rise, turn, signals
    )


def _induced(layout: StateLayout, structure: StripStructure, columns: int) -> tuple[Floats, Floats]:
    """Rows of alpha_i (rad) and of its rise gamma along the chord, shape (S, columns)."""
    induced, curvature = np.zeros((2, layout.strips, columns))
    if structure.span is None:
        return induced, curvature
    states = structure.span.states
    for number, (rear, front) in enumerate(
        zip(states.incidence, states.front, strict=True), start=4
    ):
        induced[:, layout.lag(number)] = rear
        curvature[:, layout.lag(number)] = 2.0 * CURVATURE_SHARE * (rear - front)
    return induced, curvature


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
    inertia, mass, across, back = mass_with_air(structure)
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
        matrix = np.block([[inertia, across], [back, mass]])
        both = np.linalg.solve(matrix, np.concatenate([torque, force], axis=1))
        return both[:, : torque.shape[1]], both[:, torque.shape[1] :]
    twist = np.asarray(np.linalg.solve(inertia, torque), dtype=np.float64)
    deflection = np.asarray(np.linalg.solve(mass, force), dtype=np.float64)
    return twist, deflection


def mass_with_air(structure: StripStructure) -> tuple[Floats, Floats, Floats, Floats]:
    """Generalised inertia, mass and imbalance of the modes with the apparent mass of the air.

    Of rows and columns (Theta, W) they are the blocks of the first, of the second, between them and
    between them the other way, of shapes (N, n_t, n_t), (N, n_b, n_b), (N, n_t, n_b) and
    (N, n_b, n_t). With the air of a finite span the blocks between are not each other's transpose.
    """
    weighted_f = structure.weights[:, None] * structure.torsion_shapes
    weighted_g = structure.weights[:, None] * structure.bending_shapes
    axis, lift_factor, moment_factor = (
        values[:, None, None]
        for values in (structure.axis, structure.lift_factor, structure.moment_factor)
    )
    air_mass, air_inertia = structure.apparent
    f, g = structure.torsion_shapes, structure.bending_shapes
    inertia = (
        diagonal(structure.torsion_inertia)
        + moment_factor * (weighted_f.T @ air_inertia @ f)
        + lift_factor * axis**2 * (weighted_f.T @ air_mass @ f)
    )
    mass = diagonal(structure.bending_mass) + lift_factor * (weighted_g.T @ air_mass @ g)
    across = lift_factor * axis * (weighted_f.T @ air_mass @ g) - structure.imbalance
    back = lift_factor * axis * (weighted_g.T @ air_mass @ f) - structure.imbalance.transpose(
        0, 2, 1
    )
    return inertia, mass, across, back


def diagonal(values: Floats) -> Floats:
    """Diagonal matrices, shape (N, m, m), of values of shape (N, m)."""
    return np.asarray(values[:, :, None] * np.eye(values.shape[1]), dtype=np.float64)
