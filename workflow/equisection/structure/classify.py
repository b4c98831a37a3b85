"""Kinds of modes of a solid plate: bending, torsion, in-plane, extension or chordwise.

At each station along the span the displacement of the mid-surface is split into the motions of
a rigid section and the rest:

    u_y(x) = w - x theta + rest,    u_x(x) = u + rest,    u_z(x) = s - x u' + rest,

and the kind is that of the largest share of the integral of |displacement|^2, which for a
homogeneous plate is its share of the kinetic energy. In "chordwise" modes, which no beam has, the
section changes its form.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

Floats = NDArray[np.float64]

KINDS = ("bending", "torsion", "in-plane", "extension", "chordwise")


@dataclass(frozen=True)
class Classified:
    """Kinds, shares of motion and span-wise shapes of n modes.

    Attributes
    ----------
    kind : tuple of str, length n
        One of `KINDS` for each mode.
    share : (n, 5) array
        Share of motion of each kind (-), in the order of `KINDS`; rows sum to 1.
    shape : (n, m) array
        Motion of the section along the span that belongs to the kind, not normalised: w (m), theta
        (rad), u (m), s (m), and the root mean square of the rest (m) for "chordwise".
    """

    kind: tuple[str, ...]
    share: Floats
    shape: Floats


def classify(chord_position: Floats, span: Floats, displacement: Floats) -> Classified:
    """Split displacements (n, m, p, 3) on x (p,) and z/L (m,) into motions of a section."""

    def over_chord(values: Floats) -> Floats:
        width = chord_position[-1] - chord_position[0]
        return np.asarray(
            scipy.integrate.simpson(values, x=chord_position, axis=-1) / width, dtype=np.float64
        )

    x = chord_position
    radius_squared = over_chord(x**2)
    u_x, u_y, u_z = (displacement[..., d] for d in range(3))
    w, u, s = over_chord(u_y), over_chord(u_x), over_chord(u_z)
    theta = -over_chord(u_y * x) / radius_squared  # nose up: u_y = -x theta (Eq. 3)
    lean = over_chord(u_z * x) / radius_squared
    whole = over_chord(u_x**2 + u_y**2 + u_z**2)
    parts = [w**2, theta**2 * radius_squared, u**2 + lean**2 * radius_squared, s**2]
    energy = np.stack([*parts, whole - sum(parts)])
    total = scipy.integrate.simpson(energy, x=span, axis=-1)
    share = (total / total.sum(axis=0)).T
    rest = np.sqrt(np.maximum(energy[-1], 0.0))
    index = np.argmax(share, axis=1)
    motions = np.stack([w, theta, u, s, rest])
    return Classified(
        kind=tuple(KINDS[i] for i in index),
        share=share,
        shape=motions[index, np.arange(len(index))],
    )
