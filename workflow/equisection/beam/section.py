"""The section: two degrees of freedom per unit span, about the elastic axis.

With w the deflection of the elastic axis (up) and theta the twist (nose up), a point x behind
the axis moves by w - x theta, and the section obeys

    m w''     - S theta'' + c_w w'         + k_w w         = lift,
    I theta'' - S w''     + c_theta theta' + k_theta theta = moment about the axis,

with S = m d, d the distance of the centre of mass behind the axis (Theodorsen, NACA Report 496,
1935, Eqs. A and B, where h = -w).

A section is in SI units per metre of span, or, as :meth:`Section.in_flow` returns it, in units of
rho/2, V and c. Then it has the chord 1 and the numbers of Eq. 18, with w in chords and ' = d/ds:

    m* = m/(rho c^2/2)    S* = S/(rho c^3/2)      I* = I/(rho c^4/2)
    k_w* = k_w/q          k* = k_theta/(q c^2)    q = rho V^2/2
    c_w* = c_w/(rho V c/2)                        c_theta* = c_theta/(rho V c^3/2)
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from equisection.beam.quantity import Quantity
from equisection.conventions import dynamic_pressure
from equisection.errors import EquisectionError, ReductionError

Floats = NDArray[np.float64]

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
_NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]


class Section(BaseModel):
    """Section of a beam per unit span: mass, springs and dampers about its elastic axis.

    Units are those of SI; a section in a flow (:meth:`in_flow`) has none. The
    :class:`~equisection.beam.quantity.Quantity` of a member gives its number in a flow and its
    variable in results.

    Attributes
    ----------
    torsional_stiffness : float
        k_theta (N m/rad per m).
    flexural_stiffness : float
        k_w (N/m per m).
    inertia : float
        I about the elastic axis (kg m^2/m).
    mass : float
        m (kg/m).
    static_imbalance : float
        S = m d (kg m/m), positive where the centre of mass is behind the elastic axis.
    flexural_damping : float
        c_w (N s/m per m).
    torsional_damping : float
        c_theta (N m s/rad per m).
    chord : float
        c (m); 1 in a flow.
    elastic_axis : float
        Place of the elastic axis (x/c from the leading edge).
    twist_recovery : float
        a: the tip's twist is theta/a (-).
    deflection_recovery : float
        b: the tip's deflection is w/b (-).

    Raises
    ------
    pydantic.ValidationError
        A member is out of its bounds, or S^2 is not below m I.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    torsional_stiffness: Annotated[
        _Positive,
        Quantity(
            "N m rad-1 m-1",
            "torsional stiffness k_theta per unit span",
            "k_star",
            "k_theta/(q c^2)",
            speeds=2,
            chords=2,
            stiffness=1.0,
        ),
    ]
    flexural_stiffness: Annotated[
        _Positive,
        Quantity(
            "N m-2",
            "flexural stiffness k_w per unit span",
            "k_w_star",
            "k_w/q",
            speeds=2,
            stiffness=1.0,
        ),
    ]
    inertia: Annotated[
        _Positive,
        Quantity(
            "kg m",
            "moment of inertia I_2D about the elastic axis per unit span",
            "i_star",
            "I_2D/(rho c^4/2)",
            chords=4,
        ),
    ]
    mass: Annotated[
        _Positive,
        Quantity("kg m-1", "mass m_2D per unit span", "m_star", "m_2D/(rho c^2/2)", chords=2),
    ]
    static_imbalance: Annotated[
        _Finite,
        Quantity(
            "kg",
            "static imbalance S_2D per unit span, positive with mass aft",
            "s_star",
            "S_2D/(rho c^3/2)",
            chords=3,
        ),
    ] = 0.0
    flexural_damping: Annotated[
        _NotNegative,
        Quantity(
            "N s m-2",
            "flexural damping c_w per unit span",
            "c_w_star",
            "c_w/(rho V c/2)",
            speeds=1,
            chords=1,
            stiffness=0.5,
        ),
    ] = 0.0
    torsional_damping: Annotated[
        _NotNegative,
        Quantity(
            "N m s rad-1 m-1",
            "torsional damping c_theta per unit span",
            "c_theta_star",
            "c_theta/(rho V c^3/2)",
            speeds=1,
            chords=3,
            stiffness=0.5,
        ),
    ] = 0.0
    chord: Annotated[_Positive, Quantity("m", "chord c")] = 1.0
    elastic_axis: Annotated[
        float,
        Field(ge=0.0, le=1.0, allow_inf_nan=False),
        Quantity("1", "place of the elastic axis, x/c from the leading edge"),
    ] = 0.5
    twist_recovery: Annotated[
        _Finite, Quantity("1", "a: twist of the tip = twist of the section / a")
    ] = 1.0
    deflection_recovery: Annotated[
        _Finite, Quantity("1", "b: deflection of the tip = deflection of the section / b")
    ] = 1.0

    @model_validator(mode="after")
    def _is_a_body(self) -> Section:
        """Refuse an imbalance that no distribution of the mass has (Cauchy and Schwarz)."""
        if self.static_imbalance**2 >= self.mass * self.inertia:
            largest = math.sqrt(self.mass * self.inertia)
            raise ValueError(
                f"static_imbalance is {self.static_imbalance:g}; allowed is less than "
                f"sqrt(mass * inertia) = {largest:g} either way. The inertia is that about the "
                "elastic axis: I_cg + S^2/m"
            )
        return self

    @model_serializer(mode="wrap")
    def _without_defaults(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        values: dict[str, Any] = dump(self)
        return {name: v for name, v in values.items() if v != _LEFT_OUT.get(name)}

    def k_star(self, density: float, speed: float) -> float:
        """k* = k_theta/(q c^2) (-), Eq. 18; fluid density (kg/m^3), speed (m/s)."""
        return self.torsional_stiffness / (dynamic_pressure(density, speed) * self.chord**2)

    def k_w_star(self, density: float, speed: float) -> float:
        """k_w* = k_w/q (-), Eq. 18."""
        return self.flexural_stiffness / dynamic_pressure(density, speed)

    def i_star(self, density: float) -> float:
        """I* = I/(rho c^4/2) (-), Eq. 18."""
        return self.inertia / (0.5 * density * self.chord**4)

    def m_star(self, density: float) -> float:
        """m* = m/(rho c^2/2) (-), Eq. 18."""
        return self.mass / (0.5 * density * self.chord**2)

    @property
    def inertia_ratio(self) -> float:
        """c^2 m/I (-), 9.12 below Eq. 18."""
        return self.chord**2 * self.mass / self.inertia

    @property
    def stiffness_ratio(self) -> float:
        """c^2 k_w/k_theta (-), 0.183 below Eq. 18."""
        return self.chord**2 * self.flexural_stiffness / self.torsional_stiffness

    @property
    def axis_behind_mid_chord(self) -> float:
        """Chords from mid-chord back to the elastic axis, x_ea (-)."""
        return self.elastic_axis - 0.5

    @property
    def has_offset(self) -> bool:
        """Presence of an imbalance, or of an elastic axis off mid-chord."""
        return self.static_imbalance != 0.0 or self.axis_behind_mid_chord != 0.0

    def in_flow(self, density: float, speed: float) -> Section:
        """Return the section in units of rho/2, V and c: k*, k_w*, I*, m* and the rest.

        Parameters
        ----------
        density
            Density of the fluid rho (kg/m^3).
        speed
            Speed V (m/s).
        """
        flowing = {
            name: getattr(self, name)
            / (0.5 * density * speed**quantity.speeds * self.chord**quantity.chords)
            for name, quantity in QUANTITIES.items()
            if quantity.flow_name
        }
        return self._with(**flowing, chord=1.0)

    def scaled(self, stiffness_scale: float) -> Section:
        """Return the section with both stiffnesses times a factor s (-).

        The dampings grow with the square root of s, so that the damping ratios stay: another s is
        the same section in a flow of another speed.

        Raises
        ------
        ReductionError
            The factor is not positive.
        """
        if not stiffness_scale > 0.0:
            raise ReductionError(f"stiffness_scale is {stiffness_scale}; give a positive number")
        return self._with(
            **{
                name: stiffness_scale**quantity.stiffness * getattr(self, name)
                for name, quantity in QUANTITIES.items()
                if quantity.stiffness
            }
        )

    def _with(self, **changes: float) -> Section:
        """Return the section with other members, checked as it was."""
        return Section(**{**dict(self), **changes})

    @property
    def mass_matrix(self) -> Floats:
        """M of (w, theta), [[m, -S], [-S, I]]."""
        coupling = -self.static_imbalance
        return np.array([[self.mass, coupling], [coupling, self.inertia]])

    @property
    def damping_matrix(self) -> Floats:
        """C of (w, theta), diagonal: c_w, c_theta."""
        return np.diag([self.flexural_damping, self.torsional_damping])

    @property
    def stiffness_matrix(self) -> Floats:
        """K of (w, theta), diagonal: k_w, k_theta."""
        return np.diag([self.flexural_stiffness, self.torsional_stiffness])

    @property
    def natural_frequencies(self) -> Floats:
        """Undamped angular frequencies in vacuum (rad/s; rad per c/V in a flow), rising, (2,).

        Those of det(K - omega^2 M) = 0: coupled where S is not 0.
        """
        squares = np.linalg.eigvals(np.linalg.solve(self.mass_matrix, self.stiffness_matrix))
        return np.asarray(np.sqrt(np.sort(squares.real)), dtype=np.float64)

    @property
    def uncoupled_frequencies(self) -> tuple[float, float]:
        """Natural frequencies f of pitch and heave, as if S were 0 (Hz; f c/V in a flow)."""
        pitch = math.sqrt(self.torsional_stiffness / self.inertia)
        heave = math.sqrt(self.flexural_stiffness / self.mass)
        return pitch / (2.0 * math.pi), heave / (2.0 * math.pi)

    def require_in_flow(self) -> None:
        """Refuse a section in SI units where one without units is wanted.

        Raises
        ------
        EquisectionError
            The chord is not 1.
        """
        if self.chord != 1.0:
            raise EquisectionError(
                f"the section has the chord {self.chord:g} m and so is in SI units; give "
                "section.in_flow(density, speed), which has the chord 1"
            )

    def require_defaults(self, model: str, *, but: Iterable[str] = ()) -> None:
        """Refuse a section that has more than a model can represent.

        Parameters
        ----------
        model
            Name of the model in the message.
        but
            Members of :data:`MORE_THAN_SPRINGS` that the model has; a member that is added later
            is refused until the model names it.

        Raises
        ------
        EquisectionError
            Another of them is not at its default.
        """
        more = [
            f"{name} {getattr(self, name):g} (allowed is {default:g})"
            for name, default in MORE_THAN_SPRINGS.items()
            if name not in but and getattr(self, name) != default
        ]
        if more:
            raise EquisectionError(f"{model} takes no section with {', '.join(more)}")


#: Quantity of each member.
QUANTITIES: dict[str, Quantity] = {
    name: quantity
    for name, field in Section.model_fields.items()
    for quantity in field.metadata
    if isinstance(quantity, Quantity)
}
#: Members with a default that say nothing of the motion: how it is scaled, and the tip's.
_OF_NO_MOTION = ("chord", "twist_recovery", "deflection_recovery")
#: Members by which a section is more than a mass on two springs at mid-chord, and their defaults.
MORE_THAN_SPRINGS: dict[str, float] = {
    name: field.default
    for name, field in Section.model_fields.items()
    if not field.is_required() and name not in _OF_NO_MOTION
}
#: Left out where a section is written down, so that a case without them keeps its hash.
_LEFT_OUT = {"chord": 1.0, **MORE_THAN_SPRINGS}
