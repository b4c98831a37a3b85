"""Elastic axis, centre of mass and mid-chord of the section in the mesh.

OpenFOAM's rigid body (v1912) has the force as the mass times the acceleration of the centre that it
turns about, and the moment about that centre as the inertia times the angular acceleration. That is
Newton's and Euler's law where the centre is the centre of mass, and leaves out the static imbalance
elsewhere. So the body turns about its centre of mass, on a vertical line, and the spring and the
damper of the bending are attached to the elastic axis.

At rest the centre of mass is level with the axis, d behind it, at any incidence. So the section
obeys its equations (:mod:`equisection.beam.section`) as they are, and S is not reduced by the
cosine of the incidence. The centre of mass being held along the stream in the place of the axis,
the axis moves by d (1 - cos theta) along it.

A section that is held at a twist until its release is meshed there, so that its mesh is at rest
then and not distorted.

Lengths are in chords; x is along the stream and y up, from mid-chord at the release. Nose up
is a rotation about -z.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.section import Section

Floats = NDArray[np.float64]
#: x and y, each of shape (n,).
Places = tuple[Floats, Floats]
Value = Floats | float


#: Members of a section beyond mass and springs that the rigid body has.
OF_BODY = ("elastic_axis", "static_imbalance", "flexural_damping", "torsional_damping")


@dataclass(frozen=True)
class BodyAxes:
    """Axes of a section at its rigid incidence.

    Attributes
    ----------
    incidence
        theta_0 (rad).
    behind_mid_chord
        x_ea, chords from mid-chord back to the elastic axis.
    arm
        d, chords from the elastic axis back to the centre of mass.
    start_twist
        Twist at the release (rad), in which the section is meshed.
    equilibrium
        Twist (rad) and deflection (chords) that the steady flow carries; of the twist at the
        release a part, of the deflection all.
    """

    incidence: float
    behind_mid_chord: float = 0.0
    arm: float = 0.0
    start_twist: float = 0.0
    equilibrium: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(
        cls,
        section: Section,
        incidence: float,
        start_twist: float = 0.0,
        equilibrium: tuple[float, float] = (0.0, 0.0),
    ) -> BodyAxes:
        """Return the axes of a section in its flow at a rigid incidence and a first twist (rad).

        Raises
        ------
        EquisectionError
            The section has more than the rigid body of OpenFOAM has.
        """
        section.require_defaults("the rigid body of OpenFOAM", but=OF_BODY)
        arm = section.static_imbalance / section.mass
        return cls(incidence, section.axis_behind_mid_chord, arm, start_twist, equilibrium)

    @property
    def elastic_axis(self) -> tuple[float, float]:
        """Place of the elastic axis at the release."""
        incidence = self.incidence + self.start_twist
        return (
            self.behind_mid_chord * math.cos(incidence),
            -self.behind_mid_chord * math.sin(incidence) + 0.0,
        )

    @property
    def centre_of_mass(self) -> tuple[float, float]:
        """Place of the centre of mass at the release."""
        along, up = self.elastic_axis
        return (
            along + self.arm * math.cos(self.start_twist),
            up - self.arm * math.sin(self.start_twist),
        )

    def deflection(self, height: Floats, twist: Floats) -> Floats:
        """Return w/c of the elastic axis from the height of the centre of mass and the twist."""
        moved = height - self.elastic_axis[1] + self.arm * np.sin(twist)
        return np.asarray(self.equilibrium[1] + moved)

    def axis_places(self, twist: Floats, deflection: Floats) -> Places:
        """Return the places of the elastic axis at twists (rad) and deflections (chords)."""
        along, up = self.elastic_axis
        moved = deflection - self.equilibrium[1]
        return along + self.arm * (math.cos(self.start_twist) - np.cos(twist)), up + moved

    def mid_chord_places(self, twist: Floats, deflection: Floats) -> Places:
        """Return the places of mid-chord at twists (rad) and deflections (chords)."""
        along, up = self.axis_places(twist, deflection)
        incidence = self.incidence + twist
        ahead = self.behind_mid_chord
        return along - ahead * np.cos(incidence), up + ahead * np.sin(incidence)


def moment_about(places: tuple[Value, Value], moment: Value, lift: Value, drag: Value) -> Floats:
    """Return c_m about places from c_m about mid-chord at the release, c_l and c_d.

    c_m(x, y) = c_m(0) + x c_l - y c_d: lift ahead of a place, and drag above it, turn the nose up
    about it.
    """
    along, up = places
    return np.asarray(moment + along * lift - up * drag)
