r"""Beam under static loads along its span: what its supports carry, and its largest loads.

The loads are uniform between some edges z/L. With s = z/L the deflection w and the twist theta obey

    EI/L^3 [ int w'' v'' ds + springs ] = L int q v ds,
    GJ/L   [ int theta' v' ds + springs ] = L int t v ds

for every admissible v, on the elements of :mod:`.beam_elements`, of which every edge and every
support is a node. Cubic deflections and quadratic twists then have the exact values at the nodes
(Timoshenko, *Strength of Materials*, on statically indeterminate beams; the elements' exactness:
Tong, AIAA Journal 7, 1969). What holds the beam carries

    load of the elements - stiffness of the beam alone times the unknowns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray
from skfem import ElementLineP0, LinearForm

from equisection.beam.beam import Beam
from equisection.structure.beam_elements import (
    BeamSystem,
    bending_system,
    node_at,
    torsion_system,
)

Floats = NDArray[np.float64]

ROOT, TIP = "root", "tip"
#: Distance z/L of nodes up to which they are one.
_ONE_PLACE = 1e-12


@dataclass(frozen=True)
class SupportLoad:
    """Load of the beam on what holds it at one place.

    Attributes
    ----------
    name
        ``root`` or ``tip`` of what ``beam.boundary`` holds, else ``supports.0`` and so on.
    at
        z/L (-).
    force
        Force (N), up.
    bending_moment
        Bending moment (N m) that would lift the tip; zero but at a clamp or a root spring.
    torque
        Torque about the elastic axis (N m), nose up.
    """

    name: str
    at: float
    force: float
    bending_moment: float
    torque: float


@dataclass(frozen=True)
class StaticLoads:
    """Loads of a beam at rest.

    Attributes
    ----------
    supports
        Loads on all that holds it, from the root on.
    bending_moment, torque
        Bending moment (N m) at the root and torque (N m) there, of all that is at z = 0.
    largest_bending_moment, bending_moment_at
        Bending moment (N m) of largest size along the span, and its place z/L.
    largest_torque, torque_at
        Torque (N m) of largest size along the span, and its place z/L.
    """

    supports: tuple[SupportLoad, ...]
    largest_bending_moment: float
    bending_moment_at: float
    largest_torque: float
    torque_at: float

    @property
    def bending_moment(self) -> float:
        """Bending moment (N m) on all that is at the root."""
        return sum(one.bending_moment for one in self.supports if one.at == 0.0)

    @property
    def torque(self) -> float:
        """Torque (N m) on all that is at the root."""
        return sum(one.torque for one in self.supports if one.at == 0.0)


def static_loads(beam: Beam, edges: Floats, lift: Floats, torque: Floats) -> StaticLoads:
    """Return what a beam under loads along its span does to its supports.

    Parameters
    ----------
    beam
        The beam, which something has to hold.
    edges
        z/L from 0 to 1 between which the loads are uniform, shape (S + 1,).
    lift, torque
        q (N/m), up, and t about the elastic axis (N m/m), nose up, shape (S,).
    """
    places = [one.at for one in (*beam.supports, *beam.lumps)]
    nodes = np.unique([*edges, *places])
    nodes = nodes[np.diff(nodes, prepend=-1.0) > _ONE_PLACE]
    strip = np.clip(np.searchsorted(edges, 0.5 * (nodes[1:] + nodes[:-1])) - 1, 0, lift.size - 1)
    bent, turned = bending_system(beam, nodes), torsion_system(beam, nodes)
    length = beam.length
    carried = _carried(bent, lift[strip] * length, beam.bending_rigidity / length**3)
    twisted = _carried(turned, torque[strip] * length, beam.torsional_rigidity / length)
    force, moment = carried[bent.values], length * carried[bent.others]
    supports = _supports(beam, nodes, force, moment, twisted[turned.values])
    return StaticLoads(
        supports,
        *_largest_bending_moment(nodes, lift[strip], force, moment, length),
        *_largest_torque(nodes, torque[strip], twisted[turned.values], length),
    )


def _carried(system: BeamSystem, load: Floats, rigidity: float) -> Floats:
    """Return the load on what holds each unknown, zero where nothing does."""
    uniform = system.basis.with_element(ElementLineP0()).interpolate(load)
    force = LinearForm(lambda v, w: w["load"] * v).assemble(system.basis, load=uniform)
    free = np.setdiff1d(np.arange(force.size), system.held)
    moved = np.zeros(force.size)
    moved[free] = scipy.linalg.solve(
        rigidity * system.stiffness[np.ix_(free, free)], force[free], assume_a="pos"
    )
    # what a spring carries, and not the rounding of a difference
    carried = (rigidity * (system.stiffness - system.of_beam)) @ moved
    carried[system.held] = (force - rigidity * (system.of_beam @ moved))[system.held]
    return np.asarray(carried)


def _supports(
    beam: Beam, nodes: Floats, force: Floats, moment: Floats, torque: Floats
) -> tuple[SupportLoad, ...]:
    found = []
    for node, name in ((0, ROOT), (-1, TIP)):
        bending, torsion = beam.bending_ends[node], beam.torsion_ends[node]
        if (bending, torsion) == ("free", "free"):
            continue
        found.append(
            SupportLoad(
                name,
                float(nodes[node]),
                float(force[node]) if bending != "free" else 0.0,
                float(moment[node]),
                float(torque[node]) if torsion != "free" else 0.0,
            )
        )
    for number, support in enumerate(beam.supports):
        node = node_at(nodes, support.at)
        found.append(
            SupportLoad(
                f"supports.{number}",
                support.at,
                float(force[node]) if support.restrains_deflection else 0.0,
                0.0,
                float(torque[node]) if support.restrains_twist else 0.0,
            )
        )
    return tuple(sorted(found, key=lambda one: one.at))


def _beyond(values: Floats) -> Floats:
    """Return the sums of what is beyond each of the elements' first nodes, shape (n,)."""
    return np.asarray(np.cumsum(values[::-1])[::-1])


def _largest_bending_moment(
    nodes: Floats, lift: Floats, force: Floats, moment: Floats, length: float
) -> tuple[float, float]:
    """Return the bending moment of largest size and its place.

    In an element M(x) = M_0 - Q_0 x + q x^2/2 with the shear force Q_0 = -dM/dz: its extremes are
    at both ends and where the shear force vanishes.
    """
    size = length * np.diff(nodes)
    of_air = lift * size
    shear = _beyond(of_air - force[1:])
    # from the tip inwards: each element adds its load's moment, and what is beyond it its lever
    outer = np.append(shear[1:], 0.0) - force[1:]
    inner = np.cumsum((0.5 * of_air * size + outer * size - moment[1:])[::-1])[::-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.where(lift != 0.0, shear / lift, 0.0)
    turn = np.clip(turn, 0.0, size)
    places = np.concatenate([nodes[:-1], nodes[:-1] + turn / length])
    values = np.concatenate([inner, inner - shear * turn + 0.5 * lift * turn**2])
    largest = int(np.abs(values).argmax())
    at_tip = -float(moment[-1])
    if abs(at_tip) > abs(values[largest]):
        return at_tip, 1.0
    return float(values[largest]), float(places[largest])


def _largest_torque(
    nodes: Floats, torque: Floats, carried: Floats, length: float
) -> tuple[float, float]:
    """Return the torque of largest size, which is next to a node on one of its sides."""
    of_air = torque * length * np.diff(nodes)
    inner = _beyond(of_air - carried[1:])
    values = np.concatenate([inner, inner - of_air])
    largest = int(np.abs(values).argmax())
    return float(values[largest]), float(np.concatenate([nodes[:-1], nodes[1:]])[largest])
