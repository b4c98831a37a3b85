"""The plate as lumped points, at which OpenFOAM gives the loads and takes the positions.

A point is in the middle of each layer of cells along the plate, and one at either end. The
loads of a layer's faces go to its point; the mesh's points on the plate are moved as the lumped
points to either side, linearly between them, so the shapes of the modes are followed to second
order in the size of a layer. The last layer of a free tip moves without a slope: beyond the tip the
mesh has none, and cells in between would be squeezed. A load does its work on the surface as it
moves, so a mode's load takes the mean of the shape over each layer. Loads are those of the
pressure: ``lumpedPointMovement`` leaves out friction, which has next to no lift and no moment
about mid-chord.

The points are at mid-chord, whatever the elastic axis is: they are told where mid-chord goes as the
section turns about its axis, and the moments that they give, about where they are, are taken to the
axis (:mod:`~equisection.solvers.openfoam.section.body_axes`).

Angles are Euler angles (z, x, z) in radians, and a rotation about +z is nose *down*.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.beam.beam import MID_CHORD
from equisection.cases import BeamModes
from equisection.errors import SolverError
from equisection.files import write_text
from equisection.motion.modal_response import ModalStep
from equisection.solvers.openfoam.dictionaries import PLATE, dictionary
from equisection.solvers.openfoam.mesh.beam_mesh import SIDE_WALLS
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.section.body_axes import BodyAxes, Places
from equisection.solvers.openfoam.section.section_motion import displacement
from equisection.structure.span import gram, integrate

Floats = NDArray[np.float64]

#: Fields of the modes with a default that the coupled beam has.
_OF_BEAM = ("imbalance", "bending_damping", "torsion_damping", "elastic_axis")
#: Iterations of the mesh's displacement in each motion.
_ITERATIONS = 4
#: The same of the cells around an outline, of any shape.
_ITERATIONS_OF_OUTLINE = 20
#: Name of all points together, in versions after v1912.
_CONTROLLER = "beam"
#: A shape that is less than this at the tip, relative to its largest, is held there.
_HELD = 1e-6


@dataclass(frozen=True)
class LumpedPoints:
    """Modes of the plate at its lumped points, torsion modes before bending modes.

    Attributes
    ----------
    span
        L/c.
    locations
        z/c of the points, shape (P,).
    torsion, bending
        f_i and g_j that the points follow, shape (n_t, P) and (n_b, P).
    torsion_at_loads, bending_at_loads
        f_i and g_j on which the loads of the points do work, shape (n_t, P) and (n_b, P).
    inertia
        Generalised inertia of the modes, (I*/2) (L/c) int f_i^2 and (m*/2) (L/c) int g_j^2 (over
        rho c^5 and rho c^3), shape (n_t + n_b,).
    frequency
        omega c/V, shape (n_t + n_b,).
    damping_ratio
        Of critical, shape (n_t + n_b,).
    mass
        Mass matrix of the modes, each row over its generalised inertia: 1 on the diagonal, and
        -S int f_i g_j over it between torsion and bending, shape (n_t + n_b, n_t + n_b).
    axes
        Rigid incidence and elastic axis.
    torsion_at_tip, bending_at_tip
        Shapes at the place where the first of each kind is largest, shape (n_t,) and (n_b,).
    """

    span: float
    locations: Floats
    torsion: Floats
    bending: Floats
    torsion_at_loads: Floats
    bending_at_loads: Floats
    inertia: Floats
    frequency: Floats
    damping_ratio: Floats
    mass: Floats
    axes: BodyAxes
    torsion_at_tip: Floats
    bending_at_tip: Floats

    @classmethod
    def of(cls, modes: BeamModes, edges: Floats, incidence: float = 0.0) -> LumpedPoints:
        """Place the points of a plate whose layers of cells begin and end at ``edges`` (z/c).

        ``incidence`` is the rigid one (rad), on which only an axis off mid-chord depends.

        Raises
        ------
        EquisectionError
            The beam has more than the coupled beam of OpenFOAM has.
        """
        modes.require_defaults("the coupled beam of OpenFOAM", but=_OF_BEAM)
        span = float(edges[-1])
        locations = _points(edges)
        stations = np.array(modes.span)
        torsion, bending = np.array(modes.torsion_shape), np.array(modes.bending_shape)
        inertia = np.concatenate(
            [
                0.5 * modes.inertia * span * integrate(stations, torsion**2),
                0.5 * modes.mass * span * integrate(stations, bending**2),
            ]
        )
        across = -0.5 * modes.imbalance * span * gram(stations, torsion, bending)
        twisting = _followed(
            scipy.interpolate.CubicSpline(stations, torsion, axis=1)(locations / span), edges
        )
        heaving = _followed(
            scipy.interpolate.CubicSpline(stations, bending, axis=1)(locations / span), edges
        )
        return cls(
            span=span,
            locations=locations,
            torsion=twisting,
            bending=heaving,
            torsion_at_loads=_mean_of_layers(twisting, edges),
            bending_at_loads=_mean_of_layers(heaving, edges),
            inertia=inertia,
            frequency=np.array([*modes.torsion_frequency, *modes.bending_frequency]),
            damping_ratio=np.repeat(
                [modes.torsion_damping, modes.bending_damping], [len(torsion), len(bending)]
            ),
            mass=_coupled(across) / inertia[:, None] + np.eye(inertia.size),
            axes=BodyAxes(incidence, modes.elastic_axis - MID_CHORD),
            torsion_at_tip=torsion[:, np.abs(torsion[0]).argmax()],
            bending_at_tip=bending[:, np.abs(bending[0]).argmax()],
        )

    @property
    def torsion_modes(self) -> int:
        """Number n_t of torsion modes."""
        return int(self.torsion.shape[0])

    def release(self, twist: float, heave_rate: float) -> tuple[Floats, Floats]:
        """Return position and velocity of the modes at a release, shape (n_t + n_b,) each.

        Parameters
        ----------
        twist
            Theta of the tip in the first torsion mode (rad).
        heave_rate
            w'/c of the tip in the first bending mode (over V), up.
        """
        position, velocity = np.zeros((2, self.frequency.size))
        position[0] = twist / self.torsion_at_tip[0]
        velocity[self.torsion_modes] = heave_rate / self.bending_at_tip[0]
        return position, velocity

    def modes(self, step: float) -> ModalStep:
        """Return a time step (c/V) of the modes."""
        return ModalStep(self.frequency, step, self.damping_ratio, self.mass)

    def modal_loads(self, forces: Floats, moments: Floats) -> Floats:
        """Return the loads of the modes over their inertia.

        Parameters
        ----------
        forces, moments
            Force (rho V^2 c^2) and moment about the elastic axis (rho V^2 c^3) of each point, shape
            (P, 3).
        """
        loads = np.concatenate(
            [-self.torsion_at_loads @ moments[:, 2], self.bending_at_loads @ forces[:, 1]]
        )
        return np.asarray(loads / self.inertia)

    def twist(self, position: Floats) -> Floats:
        """Return theta (rad, nose up) of each point."""
        return np.asarray(position[: self.torsion_modes] @ self.torsion)

    def deflection(self, position: Floats) -> Floats:
        """Return w/c of each point."""
        return np.asarray(position[self.torsion_modes :] @ self.bending)

    def tip(self, position: Floats) -> tuple[Floats, Floats]:
        """Return theta (rad) and w/c of the tip, of positions of shape (..., n)."""
        twist = position[..., : self.torsion_modes] @ self.torsion_at_tip
        deflection = position[..., self.torsion_modes :] @ self.bending_at_tip
        return np.asarray(twist), np.asarray(deflection)

    def mid_chord(self, position: Floats) -> Places:
        """Return the shift (x, y) of mid-chord from where it is at rest, at each point (chords)."""
        return self.axes.mid_chord_places(self.twist(position), self.deflection(position))

    def about_axis(self, forces: Floats, moments: Floats, position: Floats) -> Floats:
        """Return moments about the moving elastic axis from those about the moving mid-chords.

        Parameters
        ----------
        forces, moments
            Force and moment on each point, shape (P, 3).
        position
            Position of the modes around which the flow was solved.
        """
        incidence = self.axes.incidence + self.twist(position)
        normal = np.cos(incidence) * forces[:, 1] + np.sin(incidence) * forces[:, 0]
        about = moments.copy()
        about[:, 2] -= self.axes.behind_mid_chord * normal
        return about

    def coefficients(self, forces: Floats, moments: Floats) -> tuple[float, float]:
        """Return C_L, and C_M (Eq. 22) about what the moments are about."""
        area = 0.5 * self.span
        return float(forces[:, 1].sum()) / area, float(-moments[:, 2].sum()) / area

    def message(self, position: Floats) -> str:
        """Return places and angles of the points as ``lumpedPointMovement`` reads them."""
        angles, (along, up) = -self.twist(position), self.mid_chord(position)
        rows = [
            f"{x:.12g} {y:.12g} {z:.12g} {angle:.12g} 0 0"
            for x, y, z, angle in zip(along, up, self.locations, angles, strict=True)
        ]
        return "\n".join([str(len(rows)), *rows, ""])


def _coupled(across: Floats) -> Floats:
    """Return the part of the mass matrix between torsion and bending, of shape (n_t, n_b)."""
    torsion, bending = across.shape
    return np.block(
        [
            [np.zeros((torsion, torsion)), across],
            [across.T, np.zeros((bending, bending))],
        ]
    )


def _points(edges: Floats) -> Floats:
    """Return z/c of the points: the ends, and the middle of each layer between them."""
    return np.concatenate([edges[:1], 0.5 * (edges[1:] + edges[:-1]), edges[-1:]])


def _at_edges(shapes: Floats, edges: Floats) -> Floats:
    """Return shapes given at the points at the edges of the layers, linearly between points."""
    points = _points(edges)
    return np.array([np.interp(edges, points, shape) for shape in shapes])


def _followed(shapes: Floats, edges: Floats) -> Floats:
    """Return shapes without a slope in the last layer, but for those of a tip that is held."""
    flat = shapes.copy()
    is_free = np.abs(shapes[:, -1]) > _HELD * np.abs(shapes).max(axis=1)
    flat[is_free, -1] = _at_edges(shapes, edges)[is_free, -2]
    return flat


def _mean_of_layers(shapes: Floats, edges: Floats) -> Floats:
    """Return the means of shapes over each layer; at the ends, their values there."""
    ends = _at_edges(shapes, edges)
    means = 0.5 * (ends[:, 1:] + ends[:, :-1])
    return np.concatenate([ends[:, :1], means, ends[:, -1:]], axis=1)


@dataclass(frozen=True)
class Handed:
    """Forces and moments of the points that OpenFOAM gives at a time, shape (P, 3)."""

    time: float
    forces: Floats
    moments: Floats

    @classmethod
    def read(cls, message: str, folder: Path) -> Handed:
        """Read the plain form of ``lumpedPointMovement``, which runs in a folder.

        Raises
        ------
        SolverError
            The message is not of this form.
        """
        lines = message.splitlines()
        try:
            time = next(
                float(word.removeprefix("value="))
                for line in lines
                if line.startswith("# Time")
                for word in line.split()
                if word.startswith("value=")
            )
            rows = [line.split() for line in lines if line and not line.startswith("#")]
            values = np.array(rows, dtype=float).reshape(len(rows), 9)
        except (ValueError, StopIteration):
            raise SolverError(
                f"{folder}: what lumpedPointMovement handed over is not in its plain form: "
                f"{message[:200]!r}"
            ) from None
        return cls(time, values[:, 3:6], values[:, 6:9])

    def is_again(self, last: Handed | None) -> bool:
        """Tell whether these are the last loads again: the same forces at the same time.

        The correction of the mesh's points at the plate asks twice for each motion of the mesh,
        and must get the same answer. In a further iteration the loads are never quite the same.
        """
        return last is not None and (
            self.time == last.time and np.array_equal(self.forces, last.forces)
        )

    def about(self, places: Places) -> Handed:
        """Return the loads with moments about points that have moved by ``places`` (chords).

        A run that starts anew takes its first moments about the points at rest.
        """
        along, up = places
        moments = self.moments.copy()
        moments[:, 2] += up * self.forces[:, 0] - along * self.forces[:, 1]
        return Handed(self.time, self.forces, moments)


def write_lumped_motion(
    folder: Path, points: LumpedPoints, comms: Mapping[str, str], *, is_deformed: bool = False
) -> None:
    """Write the files that move the mesh of a case, divided or not.

    The dictionary has the keys of v1912 and those of later versions, as their published sources
    read them; what a version does not know it leaves alone.

    Parameters
    ----------
    comms
        Names of the folder and the files of the exchange: ``commsDir``, ``inputName``,
        ``outputName`` and ``logName``.
    is_deformed
        The displacement of the mesh at time 0 is there already. Otherwise the plate is at rest.
    """
    places = tuple((0.0, 0.0, float(location)) for location in points.locations)
    movement = {
        # v1912 reads these five
        "axis": (0, 0, 1),
        "locations": tuple(map(float, points.locations)),
        "centre": (0, 0, 0),
        "division": 0.5,
        "interpolationScheme": "linear",
        # later versions these two; faces go to the nearest point, which is that of their layer
        "points": places,
        "controllers": {_CONTROLLER: {"pointLabels": tuple(range(len(places)))}},
        "relax": 1.0,
        "forces": {"p": "p", "pRef": 0.0, "rhoRef": 1.0},
        "communication": {
            **comms,
            "log": False,
            "waitInterval": 1,
            "timeOut": 100,
            "initByExternal": False,
            # later versions: loads and places in each iteration of a step, as v1912 has it
            "calcFrequency": 0,
            "inputFormat": "plain",
            "outputFormat": "plain",
        },
    }
    mesh = {
        "dynamicFvMesh": "dynamicMotionSolverFvMesh",
        "motionSolverLibs": ['"libfvMotionSolvers.so"'],
        "motionSolver": "displacementLaplacian",
        # the cells' displacements alone leave the points beside the plate behind by more than the
        # first cells are high, wherever the plate's displacement is curved along the span
        "displacementLaplacianCoeffs": {
            "diffusivity": f"quadratic inverseDistance ({PLATE})",
            "interpolation": f"patchCorrected (({PLATE}) (inlet outlet floor ceiling))",
        },
    }
    write_text(
        folder / "system" / "lumpedPointMovement", dictionary("lumpedPointMovement", movement)
    )
    write_text(folder / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", mesh))
    for part in [] if is_deformed else parts(folder):
        write_text(part / "0" / "pointDisplacement", _point_displacement())


def _point_displacement() -> str:
    walls = {"floor": "symmetryPlane", "ceiling": "symmetryPlane", **SIDE_WALLS}
    return displacement(
        {
            **{name: {"type": kind} for name, kind in walls.items()},
            PLATE: {
                "type": "lumpedPointDisplacement",
                "controllers": (_CONTROLLER,),
                "value": "uniform (0 0 0)",
            },
            '"proc.*"': {"type": "processor", "value": "uniform (0 0 0)"},
        }
    )


def motion_solvers(*, of_outline: bool = False) -> dict[str, Any]:
    """Return the entries of ``fvSolution`` for the displacement of the mesh, or that of an outline.

    At the plate the diffusivity is practically infinite, and so is the scale of the residuals. By
    them the equation is solved after one iteration, while all but the first cells still lag behind.
    So the number of iterations is given. For the same reason corrections from coarser levels are
    not scaled, since the scaling would make them vanish.
    """
    iterations = _ITERATIONS_OF_OUTLINE if of_outline else _ITERATIONS
    solver = {
        "solver": "GAMG",
        "smoother": "GaussSeidel",
        "tolerance": 0.0,
        "relTol": 0.0,
        "scaleCorrection": False,
        "minIter": iterations,
        "maxIter": iterations,
    }
    return {"cellDisplacement": solver, "cellDisplacementFinal": solver}


def motion_schemes() -> dict[str, str]:
    """Return the entry of ``laplacianSchemes`` for the displacement of the mesh.

    It leaves out the correction of faces that are not orthogonal. On the thin cells at the plate
    that correction feeds on the distortion that it makes, until the mesh fails within 8 c/V.
    """
    return {"laplacian(diffusivity,cellDisplacement)": "Gauss linear uncorrected"}
