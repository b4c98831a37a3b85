"""Generalised aerodynamic forces of a beam on its modes, over the reduced velocity V/(f c).

In harmonic motion of K = omega c/V of bending modes W_j (chords) and torsion modes Theta_i (rad),

    (int c_l g_j dz/L, int c_m f_i dz/L) = Q(K) (W, Theta),

with the shapes g_j and f_i of largest value 1, c_m about the elastic axis and the deflection that
of it. The order is bending modes before torsion modes. Of independent strips Q is the loads of the
section times the integrals of two shapes (:mod:`equisection.motion.beam_flutter`); measured on the
beam it has what the strips do to each other.

Between the rows Q is interpolated as that of a section is
(:mod:`equisection.aerodynamics.load_table`).
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.load_table import LoadTable
from equisection.errors import ArgumentError, DerivativesFileError
from equisection.files import write_text

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Columns of the file.
COLUMNS = ("reduced_velocity", "load", "motion", "real", "imaginary", "spread")
_SAID = ("axis", "incidence_deg", "twist_deg", "source")
_KINDS = ("bending", "torsion")


@dataclass(frozen=True)
class GeneralisedForces(LoadTable):
    """Generalised aerodynamic forces of n_b bending and n_t torsion modes, m together.

    Attributes
    ----------
    reduced_velocity : ndarray, shape (n,)
        V/(f c), ascending.
    values : ndarray, shape (n, m, m)
        Q (-), rows by loads and columns by motions.
    spread : ndarray, shape (n, m, m), optional
        Standard deviation of the real and of the imaginary part; None where it is not known.
    bending : int
        Number n_b of bending modes, which come first.
    axis : float
        Elastic axis (x/c from the leading edge).
    incidence_deg, twist_deg : float
        Mean incidence of the undeformed beam, and mean twist beyond it in the first torsion mode
        where that is largest (deg).
    label : str
        Where they come from.
    """

    called = "forces"

    bending: int = field(kw_only=True)
    twist_deg: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        shape, rows = np.shape(self.values), len(self.reduced_velocity)
        if len(shape) != 3 or shape[0] != rows or shape[1] != shape[2]:
            raise ArgumentError(
                f"values has the shape {shape}; wanted ({rows}, m, m), a square matrix at each "
                "reduced velocity"
            )

    @property
    def modes(self) -> tuple[str, ...]:
        """Names of the modes in order, such as ``bending1``."""
        size = self.values.shape[1]
        return mode_names(self.bending, size - self.bending)

    @property
    def loads(self) -> Complexes:
        """Q at each row, shape (n, m, m)."""
        return self.values

    @property
    def quantities(self) -> int:
        """Number of quantities that have a spread: real and imaginary part of each force."""
        return 2 * len(self.modes) ** 2

    def influence(self, omega: ArrayLike) -> Complexes:
        """Return Q at K = omega c/V within :attr:`frequencies`, shape (..., m, m).

        Raises
        ------
        ArgumentError
            A frequency is outside of the rows.
        """
        return self.between_rows(omega)

    def shifted(self, number: int, times: float) -> GeneralisedForces:
        """Table in which one quantity is moved, as :class:`.LoadTable` has it.

        They are numbered force by force, along the rows of Q: the real part, then the imaginary.
        """
        values = self.values.copy()
        if self.spread is not None:
            size = values.shape[1]
            place, is_imaginary = divmod(number, 2)
            row, column = divmod(place, size)
            values[:, row, column] += (
                (1j if is_imaginary else 1.0) * times * (self.spread[:, row, column])
            )
        return replace(self, values=values)

    def write(self, path: str | Path, comments: Sequence[str] = ()) -> None:
        """Write a CSV file that :meth:`read` reads, whole or not at all.

        Parameters
        ----------
        path
            The file.
        comments
            Further lines for its top.
        """
        text = io.StringIO()
        said = {
            "axis": f"{self.axis:g}",
            "incidence_deg": f"{self.incidence_deg:g}",
            "twist_deg": f"{self.twist_deg:g}",
            "source": self.label,
        }
        text.writelines(f"# {line}\n" for line in comments)
        text.writelines(f"# {key}: {value}\n" for key, value in said.items())
        table = csv.writer(text, lineterminator="\n")
        table.writerow(COLUMNS)
        for place, velocity in enumerate(self.reduced_velocity):
            for row, load in enumerate(self.modes):
                for column, motion in enumerate(self.modes):
                    value = self.values[place, row, column]
                    spread = math.nan if self.spread is None else self.spread[place, row, column]
                    numbers = (f"{one:.8g}" for one in (value.real, value.imag, spread))
                    table.writerow((f"{velocity:.8g}", load, motion, *numbers))
        write_text(Path(path), text.getvalue())

    @classmethod
    def read(cls, path: str | Path) -> GeneralisedForces:
        """Read a file of :meth:`write`.

        Raises
        ------
        DerivativesFileError
            The file is not of this form, or lacks a pair of modes at a reduced velocity.
        """
        place = Path(path)
        try:
            lines = place.read_text(encoding="utf-8").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise DerivativesFileError(f"{place}: cannot be read as text ({error})") from error
        pairs = (line[1:].partition(":") for line in lines if line.startswith("#"))
        said = {key.strip(): value.strip() for key, _, value in pairs}
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        missing = [key for key in _SAID if key not in said]
        if missing or not rows or tuple(rows[0]) != COLUMNS:
            raise DerivativesFileError(
                f"{place}: wanted comments {', '.join(_SAID)} and the columns {', '.join(COLUMNS)}"
            )
        try:
            found = {
                (float(row["reduced_velocity"]), row["load"], row["motion"]): (
                    complex(float(row["real"]), float(row["imaginary"])),
                    float(row["spread"]),
                )
                for row in rows
            }
            numbers = {key: float(said[key]) for key in _SAID[:3]}
            return cls._gathered(found, numbers, said["source"])
        except KeyError as error:
            velocity, load, motion = error.args[0]
            raise DerivativesFileError(
                f"{place}: no load on {load} by {motion} at the reduced velocity {velocity:g}; "
                "wanted every pair of modes at each"
            ) from None
        except ArgumentError as error:
            raise DerivativesFileError(f"{place}: {error}") from None
        except (TypeError, ValueError) as error:
            raise DerivativesFileError(f"{place}: {error}; wanted numbers") from None

    @classmethod
    def _gathered(
        cls,
        found: dict[tuple[float, str, str], tuple[complex, float]],
        numbers: dict[str, float],
        label: str,
    ) -> GeneralisedForces:
        velocities = sorted({velocity for velocity, _, _ in found})
        of_kind = [len({load for _, load, _ in found if load.startswith(kind)}) for kind in _KINDS]
        modes = mode_names(*of_kind)
        both = np.array(
            [
                [[found[velocity, load, motion] for motion in modes] for load in modes]
                for velocity in velocities
            ]
        )
        spread = both[..., 1].real
        return cls(
            np.array(velocities),
            both[..., 0],
            spread if np.isfinite(spread).all() else None,
            **numbers,
            label=label,
            bending=of_kind[0],
        )


def mode_names(bending: int, torsion: int) -> tuple[str, ...]:
    """Return the names of some bending modes and then torsion modes, such as ``bending1``."""
    return tuple(
        f"{kind}{number}"
        for kind, many in zip(_KINDS, (bending, torsion), strict=True)
        for number in range(1, many + 1)
    )
