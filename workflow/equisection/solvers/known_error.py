"""Known error of a solver's growth, from releases that a flow solver has run, too."""

from __future__ import annotations

from dataclasses import dataclass

#: Bases of a growth: of a release in time, or of small motions about equilibrium.
TIME, EIGENVALUE = "time", "eigenvalue"


@dataclass(frozen=True)
class KnownError:
    """Growth by a solver less that by a flow solver, over some releases.

    Attributes
    ----------
    dimension
        ``2d`` or ``3d``.
    polar
        Label of the section polar.
    basis
        :data:`TIME` or :data:`EIGENVALUE`.
    against
        What it is compared with.
    releases, wrong_side
        Number of releases, and how many of them grow in one solver and decay in the other.
    mean, rms
        Mean and root mean square of the difference (V/c).
    """

    dimension: str
    polar: str
    basis: str
    against: str
    releases: int
    wrong_side: int
    mean: float
    rms: float

    @property
    def errs(self) -> str:
        """Side to which a critical speed errs.

        ``safe`` where growth is too high, ``unsafe`` where it is too low; ``either`` where the mean
        is less than half of the root mean square and so tells no side.
        """
        if abs(self.mean) < 0.5 * self.rms:
            return "either"
        return "safe" if self.mean > 0.0 else "unsafe"

    def __str__(self) -> str:
        """Return the error in words."""
        high = "high" if self.mean > 0.0 else "low"
        return (
            f"growth {abs(self.mean):.4f} V/c too {high} in the mean ({self.rms:.4f} rms) of "
            f"{self.releases} releases of {self.against}, {self.wrong_side} of them on the wrong "
            f"side of the onset: errs to {side_in_words(self.errs)}"
        )


def side_in_words(errs: str) -> str:
    """Return the side of :attr:`KnownError.errs` in words."""
    return "either side" if errs == "either" else f"the {errs} side"
