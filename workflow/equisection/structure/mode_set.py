"""Modes of a beam as data, the same for every method."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import Beam
from equisection.errors import ModesError
from equisection.structure.fittings import inertias, lumped
from equisection.structure.span import derivative, gram

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ModeSet:
    """Natural modes of a beam, in order of frequency.

    Attributes
    ----------
    frequency : (n,) array
        Natural frequencies (Hz).
    kind : tuple of str, length n
        ``bending``, ``torsion``, ``in-plane``, ``extension`` or ``chordwise``.
    span : (m,) array
        z/L in [0, 1].
    shape : (n, m) array
        Largest absolute value 1, positive at the tip (or at the largest value where the tip is
        held): w for bending, theta (nose up) for torsion, u for in-plane.
    method : str
        ``solid``, ``beam`` or ``analytic``.
    elements : str
        Label of the mesh, as in ``24 x 89 x 2``.
    """

    frequency: Floats
    kind: tuple[str, ...]
    span: Floats
    shape: Floats
    method: str
    elements: str

    def bending(self, count: int) -> ModeSet:
        """First bending modes."""
        return self.of_kind("bending", count)

    def torsion(self, count: int) -> ModeSet:
        """First torsion modes."""
        return self.of_kind("torsion", count)

    @property
    def places(self) -> tuple[float, float]:
        """Places z/L where twist and deflection of the beam are read.

        There the first mode of each is largest: at a free tip, or inside.
        """
        twist, deflection = (
            float(self.span[np.abs(first.shape[0]).argmax()])
            for first in (self.torsion(1), self.bending(1))
        )
        return twist, deflection

    def section_pair(self) -> tuple[ModeSet, int]:
        """First torsion mode and the bending mode most like it, and the number of that.

        The likeness is |cos phi| = |int f g| / sqrt(int f^2 int g^2). On equal spans the first
        bending mode alternates and is unlike the twist. The deflection is turned so that cos phi is
        positive.
        """
        twist = self.torsion(1)
        found = [i for i, this in enumerate(self.kind) if this == "bending"]
        deflections = self.bending(max(len(found), 1))
        across = gram(self.span, twist.shape, deflections.shape)[0]
        own = np.diag(gram(self.span, deflections.shape, deflections.shape))
        best = int(np.argmax(np.abs(across) / np.sqrt(own)))
        first = self.kind.index("torsion")
        pair = self._chosen(sorted([found[best], first]))
        if across[best] < 0.0:
            shape = pair.shape.copy()
            shape[pair.kind.index("bending")] *= -1.0
            pair = replace(pair, shape=shape)
        return pair, best + 1

    def lowest(self, count: int) -> ModeSet:
        """Lowest modes of any kind."""
        return self._chosen(list(range(min(count, len(self.kind)))))

    def of_kind(self, kind: str, count: int) -> ModeSet:
        """First modes of a kind.

        Raises
        ------
        ModesError
            The set has fewer.
        """
        found = [i for i, this in enumerate(self.kind) if this == kind]
        if len(found) < count:
            raise ModesError(
                f"{count} {kind} modes are needed and {len(found)} are among the "
                f"{len(self.kind)} computed by method {self.method!r} ({self.elements}); "
                f"lower structure.{kind}_modes or refine structure.elements"
            )
        return self._chosen(found[:count])

    def _chosen(self, chosen: list[int]) -> ModeSet:
        return ModeSet(
            self.frequency[chosen],
            tuple(self.kind[i] for i in chosen),
            self.span,
            self.shape[chosen],
            self.method,
            self.elements,
        )


@dataclass(frozen=True)
class MeshStudy:
    """Frequencies of the same modes on finer and finer meshes.

    Attributes
    ----------
    elements : tuple of (chord, span, thickness)
        Levels, coarse to fine.
    kind : tuple of str
        Kinds on the finest level.
    frequency : (levels, n) array
        Natural frequencies (Hz); NaN of a mode that a level lacks.
    """

    elements: tuple[tuple[int, int, int], ...]
    kind: tuple[str, ...]
    frequency: Floats

    @property
    def change(self) -> Floats:
        """Relative change of each frequency from the level before, (levels - 1, n)."""
        return np.asarray(self.frequency[1:] / self.frequency[:-1] - 1.0)

    @property
    def error(self) -> Floats:
        """Frequency over that of the finest level, less 1, (levels, n)."""
        return np.asarray(self.frequency / self.frequency[-1] - 1.0)


def torsion_strain(modes: ModeSet, beam: Beam, count: int) -> Floats:
    """K_theta of Eq. 7 from the slopes of the torsion shapes, (count, count), dimensionless.

    A spring that holds the root adds its energy, (k_t L/GJ) f_i(0) f_j(0). With supports or lumped
    masses along the span the slopes jump, and omega_i omega_j M_ij, which is the same for a beam's
    own modes, takes their place.
    """
    if beam.has_fittings:
        first = modes.torsion(count)
        omega = 2.0 * np.pi * first.frequency
        rate = beam.torsional_rigidity / (beam.inertia_per_length * beam.length**2)
        mass = gram(modes.span, first.shape, first.shape)
        mass = mass + lumped(modes.span, first.shape, first.shape, inertias(beam))
        return np.asarray(np.outer(omega, omega) * mass / rate)
    shape = modes.torsion(count).shape
    slope = derivative(modes.span, shape)
    spring = (beam.root_torsional_stiffness or 0.0) * beam.length / beam.torsional_rigidity
    root = shape[:, 0]
    return np.asarray(gram(modes.span, slope, slope) + spring * np.outer(root, root))


def frequency_constants(modes: ModeSet, beam: Beam) -> Floats:
    """C_i of Eq. 23 for each mode (-): f_i c/V = C_i (L/h) sqrt(k*/I*).

    k* is that of Eq. 17 with the slope of the computed torsion shape, which reproduces Table 2. The
    constants hold for this L/h only: L/h has no place in Eq. 23, since sqrt(k*/I*) is already
    omega_theta c/V.
    """
    first = modes.torsion(1).shape
    strain = (torsion_strain(modes, beam, 1) / gram(modes.span, first, first)).item()
    stiffness = beam.torsional_rigidity / beam.length**2 * strain
    radian_rate = np.sqrt(stiffness / beam.inertia_per_length)
    return np.asarray(modes.frequency / radian_rate * beam.thickness / beam.length)
