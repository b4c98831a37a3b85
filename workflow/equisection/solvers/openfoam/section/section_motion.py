"""The free section as a rigid body with springs, and the mesh that follows it.

Without dimensions (chord, speed and density 1) the section of Eq. 18 has, per unit span, the
inertia I*/2, the mass m*/2, the static imbalance S*/2, the stiffnesses k*/2 and k_w*/2, and the
dampings c_theta*/2 and c_w*/2. The body turns about its centre of mass
(:mod:`~equisection.solvers.openfoam.section.body_axes`), about which its inertia is I - S^2/m.

Newmark's rule (gamma 1/2, beta 1/4) is applied anew in each outer iteration of a time step, with
loads, springs and dampers at the latest estimate of the new position.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.beam.section import Section
from equisection.files import write_text
from equisection.solvers.openfoam.dictionaries import PLATE, Entries, dictionary
from equisection.solvers.openfoam.reading.histories import read_history
from equisection.solvers.openfoam.section.body_axes import BodyAxes

#: Name of the function object of the motion.
MOTION = "motion"
#: Length of the spring (chords) of a section with a damper or with offset axes. A spring pulls, and
#: its damper brakes, along the line to its attachment: so long a spring stays vertical where the
#: attachment wanders along the stream, and in its middle position.
_LONG = 1e3
#: Digits of the attachment's height, so that the long spring is slack to the last digit written.
_DIGITS = 8
#: Within the first distance from the plate the mesh moves with it, beyond the second it stands;
#: the second as a part of the half channel at the most.
_RIGID_WITHIN, _STILL_BEYOND, _STILL_PART = 0.3, 1.5, 0.75


@dataclass(frozen=True)
class BodyMotion:
    """Motion of the rigid body, shape (n,).

    Attributes
    ----------
    time
        s (c/V).
    rotation
        Rotation since the release (rad), nose up.
    height
        Height of the centre of mass (chords).
    """

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    height: NDArray[np.float64]


def write_motion(
    folder: Path, section: Section, axes: BodyAxes, channel_height: float, heave_rate: float = 0.0
) -> None:
    """Write ``constant/dynamicMeshDict``: the section, and the mesh that morphs around it."""
    entries = morphing(section, axes, channel_height, heave_rate)
    write_text(folder / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", entries))
    write_displacement(folder)


def morphing(
    section: Section, axes: BodyAxes, channel_height: float, heave_rate: float = 0.0
) -> dict[str, Any]:
    """Return the section, and the mesh that morphs around it.

    It does so up to near the channel's walls.
    """
    still = min(_STILL_BEYOND, _STILL_PART * channel_height / 2)
    within = min(_RIGID_WITHIN, 0.4 * still)
    return {
        "dynamicFvMesh": "dynamicMotionSolverFvMesh",
        "motionSolverLibs": ['"libsixDoFRigidBodyMotion.so"'],
        "motionSolver": "sixDoFRigidBodyMotion",
        "sixDoFRigidBodyMotionCoeffs": rigid_body(section, axes, within, still, heave_rate),
    }


def rigid_body(
    section: Section, axes: BodyAxes, rigid_within: float, still: float, heave_rate: float = 0.0
) -> dict[str, Any]:
    """Return the section in its flow, released from its first twist.

    The springs are slack, but for what its axes have of a first twist and of an equilibrium.

    Parameters
    ----------
    section
        The section in its flow (:meth:`equisection.beam.section.Section.in_flow`).
    axes
        Its axes, with its rigid incidence and its twist at the release.
    rigid_within, still
        Up to the first distance (chords) the mesh moves with it, beyond the second it is at rest.
    heave_rate
        Rate of the deflection at the release (over V), up.
    """
    twist = axes.start_twist
    cosine, sine = math.cos(twist), math.sin(twist)
    centre = (*axes.centre_of_mass, 0)
    about_centre = section.inertia - section.static_imbalance**2 / section.mass
    return {
        "patches": [PLATE],
        "innerDistance": rigid_within,
        "outerDistance": still,
        "mass": section.mass / 2,
        "centreOfMass": centre,
        "momentOfInertia": (1.0, 1.0, about_centre / 2),
        "velocity": (0, heave_rate, 0),
        "acceleration": (0, 0, 0),
        "angularMomentum": (0, 0, 0),
        # of the spring, less what the flow carries; without it the first step would have half of it
        "torque": (0, 0, section.torsional_stiffness / 2 * (twist - axes.equilibrium[0])),
        "rho": "rhoInf",
        "rhoInf": 1.0,
        "g": (0, 0, 0),
        "accelerationRelaxation": 1.0,
        "report": False,
        "solver": {"type": "Newmark", "gamma": 0.5, "beta": 0.25},
        "constraints": {
            "heave": {
                "sixDoFRigidBodyMotionConstraint": "line",
                "centreOfRotation": centre,
                "direction": (0, 1, 0),
            },
            "pitch": {"sixDoFRigidBodyMotionConstraint": "axis", "axis": (0, 0, 1)},
        },
        "restraints": {
            "bending": _bending(section, axes),
            "torsion": {
                "sixDoFRigidBodyMotionRestraint": "linearAxialAngularSpring",
                "axis": (0, 0, 1),
                "stiffness": section.torsional_stiffness / 2,
                "damping": section.torsional_damping / 2,
                # where the spring is slack, seen from the release
                "referenceOrientation": (cosine, 0.0 - sine, 0, sine, cosine, 0, 0, 0, 1),
            },
        },
    }


def _bending(section: Section, axes: BodyAxes) -> dict[str, Any]:
    """Return spring and damper of the bending, attached to the elastic axis."""
    along, up = axes.elastic_axis
    up, slack = round(up, _DIGITS), round(up - axes.equilibrium[1], _DIGITS)
    length = _LONG if section.has_offset or section.flexural_damping else 0.0
    return {
        "sixDoFRigidBodyMotionRestraint": "linearSpring",
        "anchor": (along, slack - length, 0),
        "refAttachmentPt": (along, up, 0),
        "stiffness": section.flexural_stiffness / 2,
        "damping": section.flexural_damping / 2,
        "restLength": length,
    }


def write_displacement(folder: Path, further: Mapping[str, Entries] | None = None) -> None:
    """Write the field ``pointDisplacement`` at time 0, with patches beyond those of the channel."""
    mirror = {"type": "symmetryPlane"}
    patches = {
        "floor": mirror,
        "ceiling": mirror,
        PLATE: {"type": "calculated"},
        "sides": {"type": "empty"},
        **(further or {}),
    }
    write_text(folder / "0" / "pointDisplacement", displacement(patches))


def displacement(patches: Mapping[str, Entries]) -> str:
    """Return the field ``pointDisplacement`` of a mesh at rest; inlet and outlet stay there."""
    at_rest = {"type": "fixedValue", "value": "uniform (0 0 0)"}
    entries = {
        "dimensions": "[0 1 0 0 0 0 0]",
        "internalField": "uniform (0 0 0)",
        "boundaryField": {"inlet": at_rest, "outlet": at_rest, **patches},
    }
    return dictionary("pointDisplacement", entries, "pointVectorField")


def motion_output() -> dict[str, Any]:
    """Return the function object that writes position and rotation of the section."""
    return {
        MOTION: {
            "type": "sixDoFRigidBodyState",
            "libs": ['"libsixDoFRigidBodyState.so"'],
            "angleFormat": "radians",
            "writeControl": "timeStep",
            "writeInterval": 1,
        }
    }


def read_motion(folder: Path) -> BodyMotion:
    """Return the motion of a run so far, from what its function object wrote.

    The rotation is that since the release.

    Raises
    ------
    SolverError
        There is none, or its file has an unknown layout.
    """
    motion = read_history(
        folder / "postProcessing" / MOTION,
        "sixDoFRigidBodyState.dat",
        ["centreOfRotation", "rotation"],
    )
    return BodyMotion(
        motion["Time"],
        -motion["rotation"].reshape(-1, 3)[:, 2],
        motion["centreOfRotation"].reshape(-1, 3)[:, 1],
    )
