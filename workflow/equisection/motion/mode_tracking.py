r"""Modes of a body followed over speed, from near vacuum on.

About an equilibrium the small motions are the eigenvectors v_i (right) and u_i (left) of J, with
u_i^H v_j = delta_ij. From one speed to the next a motion goes on as that with the largest

    W_ij = |(u_i^H v'_j) (u'_j^H v_i)|,

which is 1 for the same vector, whatever its length, and sums to about 1 over i and over j: the
modal assurance criterion in the metric of J itself. Where the largest is not clear of the second
one, the interval is halved; what is unclear at the shortest interval is a *crossing* of two modes,
and is named as such. Modes have their names where the air is next to nothing, by the part of their
kinetic energy in twist: ``torsion 1``, ``bending 1``, ``bending 2``, and so on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from equisection.motion.steady_states import jacobian
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

CLEAR = 0.1
"""Least difference of the two largest W of a mode that is followed."""
ROUNDS = 7
"""Halvings of an interval at most."""


@dataclass(frozen=True)
class Spectrum:
    """All small motions of a body about its equilibria at N speeds.

    Attributes
    ----------
    speed
        V (m/s), rising, shape (N,).
    values
        Eigenvalues p (V/c), shape (N, n); NaN where there is no equilibrium.
    right, left
        v_i in the columns of ``right``, u_i^H in the rows of ``left``, shape (N, n, n).
    states
        States Y of equilibrium, shape (N, n).
    """

    speed: Floats
    values: Complexes
    right: Complexes
    left: Complexes
    states: Floats

    @classmethod
    def of(cls, speeds: Floats, system: StripSystem, states: Floats, deficits: Floats) -> Spectrum:
        """Return the motions of a system about its equilibria, a lane for each speed."""
        return cls.about(speeds, states, jacobian(system, states, deficits))

    @classmethod
    def about(cls, speeds: Floats, states: Floats, linear: Floats) -> Spectrum:
        """Return the motions about equilibria by their matrices (N, n, n), NaN without one."""
        lanes, n = states.shape
        values = np.full((lanes, n), np.nan, dtype=np.complex128)
        right = np.full((lanes, n, n), np.nan, dtype=np.complex128)
        left = right.copy()
        found = np.isfinite(linear).all(axis=(1, 2))
        if found.any():
            values[found], right[found] = np.linalg.eig(linear[found])
            left[found] = np.linalg.inv(right[found])
        return cls(speeds, values, right, left, states)

    @classmethod
    def without_any(cls, size: int) -> Spectrum:
        """Return the motions of a body of n states at no speed."""
        vectors = np.empty((0, size, size), dtype=np.complex128)
        nothing = np.empty((0, size))
        return cls(np.empty(0), nothing.astype(np.complex128), vectors, vectors, nothing)

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Presence of an equilibrium at each speed, shape (N,)."""
        return np.asarray(np.isfinite(self.values.real).all(axis=1), dtype=np.bool_)

    @property
    def least_stable(self) -> Complexes:
        """Eigenvalue of largest growth at each speed, with its frequency positive, shape (N,)."""
        growth = np.where(np.isfinite(self.values.real), self.values.real, -np.inf)
        chosen = np.take_along_axis(self.values, growth.argmax(axis=1)[:, None], axis=1)[:, 0]
        return np.asarray(chosen.real + 1j * np.abs(chosen.imag))

    @property
    def least_stable_motion(self) -> Complexes:
        """Eigenvector v of largest growth whose frequency is not negative, shape (N, n)."""
        counts = np.isfinite(self.values.real) & (self.values.imag >= 0.0)
        place = np.where(counts, self.values.real, -np.inf).argmax(axis=1)
        chosen = np.take_along_axis(self.right, place[:, None, None], axis=2)[:, :, 0]
        return np.asarray(chosen, dtype=np.complex128)

    @property
    def largest_real(self) -> Floats:
        """Largest eigenvalue (V/c) of the motions that do not oscillate, shape (N,)."""
        real = np.where(self.values.imag == 0.0, self.values.real, -np.inf)
        return np.asarray(np.where(self.exists, real.max(axis=1), np.nan))

    def taken(self, places: NDArray[np.bool_] | slice) -> Spectrum:
        """Return those at some of the speeds."""
        return Spectrum(
            self.speed[places],
            self.values[places],
            self.right[places],
            self.left[places],
            self.states[places],
        )

    def joined(self, other: Spectrum) -> Spectrum:
        """Return both together, by rising speed."""
        both = [
            np.concatenate([getattr(self, name), getattr(other, name)])
            for name in ("speed", "values", "right", "left", "states")
        ]
        order = np.argsort(both[0], kind="stable")
        return Spectrum(*(part[order] for part in both))

    @cached_property
    def likeness(self) -> Floats:
        """W of each speed and the next, shape (N - 1, n, n)."""
        ahead = self.left[:-1] @ self.right[1:]
        back = self.left[1:] @ self.right[:-1]
        return np.asarray(np.abs(ahead * back.transpose(0, 2, 1)))


@dataclass(frozen=True)
class FollowedModes:
    """The structural modes of a body over speed.

    Attributes
    ----------
    spectrum
        All motions.
    names
        Name of each of the m modes.
    places
        Place of each mode among the motions at each speed, shape (N, m).
    crossings
        Speed (m/s) and names of two modes that cannot be told apart there.
    """

    spectrum: Spectrum
    names: tuple[str, ...]
    places: NDArray[np.intp]
    crossings: tuple[tuple[float, str, str], ...]

    @property
    def values(self) -> Complexes:
        """Eigenvalue p (V/c) of each mode, frequencies positive, shape (N, m)."""
        values = np.take_along_axis(self.spectrum.values, self.places, axis=1)
        return np.asarray(values.real + 1j * np.abs(values.imag))

    def shape(self, place: int, mode: int) -> Complexes:
        """Return the right eigenvector of a mode at one of the speeds, shape (n,)."""
        return np.asarray(self.spectrum.right[place, :, self.places[place, mode]])


def no_modes(size: int) -> FollowedModes:
    """Return the modes of a body of n states that has no equilibrium."""
    return FollowedModes(Spectrum.without_any(size), (), np.empty((0, 0), dtype=np.intp), ())


def follow_modes(
    spectra: Sequence[Spectrum],
    further: Callable[[list[Floats]], Sequence[Spectrum]],
    system: StripSystem,
) -> list[FollowedModes]:
    """Follow the modes of a body at several incidences over speed.

    Parameters
    ----------
    spectra
        Motions at each incidence, from a speed on at which the air is next to nothing.
    further
        Function that returns the motions at further speeds (m/s), a list for each incidence.
    system
        A system of the body, whose modes and energies are those of its first lane.
    """
    found = [spectrum.taken(spectrum.exists) for spectrum in spectra]
    for _ in range(ROUNDS):
        wanted = [_unclear(spectrum, system) for spectrum in found]
        if not any(speeds.size for speeds in wanted):
            break
        found = [
            old.joined(new.taken(new.exists))
            for old, new in zip(found, further(wanted), strict=True)
        ]
    return [_followed(spectrum, system) for spectrum in found]


def _unclear(spectrum: Spectrum, system: StripSystem) -> Floats:
    """Return speeds in the middle of the intervals over which modes cannot be told apart."""
    if spectrum.speed.size < 2:
        return np.empty(0)
    places, _ = _chained(spectrum, system)
    unclear = np.flatnonzero((_clearness(spectrum, places) < CLEAR).any(axis=1))
    return np.sqrt(spectrum.speed[unclear] * spectrum.speed[unclear + 1])


def _clearness(spectrum: Spectrum, places: NDArray[np.intp]) -> Floats:
    """Largest W of each mode less the second, over the mean of both, shape (N - 1, m)."""
    of_modes = np.take_along_axis(spectrum.likeness, places[:-1, :, None], axis=1)
    top = np.partition(of_modes, -2, axis=2)[:, :, -2:]
    return np.asarray((top[:, :, 1] - top[:, :, 0]) / np.maximum(top.sum(axis=2), 1e-300))


def _chained(spectrum: Spectrum, system: StripSystem) -> tuple[NDArray[np.intp], tuple[str, ...]]:
    """Place of each mode among the motions at each speed (N, m), and the names of the modes."""
    first, names = _in_still_air(spectrum, system)
    places = np.empty((spectrum.speed.size, first.size), dtype=np.intp)
    places[:1] = first
    best = spectrum.likeness.argmax(axis=2) if spectrum.speed.size > 1 else first[None]
    for step in range(1, spectrum.speed.size):
        places[step] = best[step - 1, places[step - 1]]
    return places, names


def _in_still_air(
    spectrum: Spectrum, system: StripSystem
) -> tuple[NDArray[np.intp], tuple[str, ...]]:
    """Return the fastest motions at the lowest speed, with names by their energies."""
    layout, structure = system.layout, system.structure
    count = layout.torsion_modes + layout.bending_modes
    if not spectrum.speed.size:
        return np.empty(0, dtype=np.intp), ()
    frequency = spectrum.values[0].imag
    fastest = np.argsort(frequency)[::-1][:count]
    chosen = fastest[np.argsort(frequency[fastest])]
    vectors = np.abs(spectrum.right[0][:, chosen]) ** 2
    twisting = structure.torsion_inertia[0] @ vectors[layout.twist_rate]
    bending = structure.bending_mass[0] @ vectors[layout.deflection_rate]
    numbers = {"torsion": 0, "bending": 0}
    names = []
    for is_torsion in twisting > bending:
        kind = "torsion" if is_torsion else "bending"
        numbers[kind] += 1
        names.append(f"{kind} {numbers[kind]}")
    order = sorted(range(count), key=lambda place: (names[place].split()[0], place))
    return chosen[order], tuple(names[place] for place in order)


def _followed(spectrum: Spectrum, system: StripSystem) -> FollowedModes:
    places, names = _chained(spectrum, system)
    crossings = []
    if spectrum.speed.size > 1:
        unclear = _clearness(spectrum, places) < CLEAR
        for step in np.flatnonzero(unclear.any(axis=1)):
            mode = int(unclear[step].argmax())
            other = _like(spectrum, places, int(step), mode)
            if other is not None:
                pair = sorted((names[mode], names[other]))
                crossings.append((float(spectrum.speed[step]), pair[0], pair[1]))
    return FollowedModes(spectrum, names, places, _of_each_pair(crossings))


def _like(spectrum: Spectrum, places: NDArray[np.intp], step: int, mode: int) -> int | None:
    """Return the other mode that one cannot be told from; None if that is no mode."""
    second = np.argsort(spectrum.likeness[step, places[step, mode]])[-2:]
    others = (
        number
        for number, place in enumerate(places[step + 1])
        if place in second and number != mode
    )
    return next(others, None)


def _of_each_pair(
    crossings: list[tuple[float, str, str]],
) -> tuple[tuple[float, str, str], ...]:
    """Return the first crossing of each pair."""
    first: dict[tuple[str, str], float] = {}
    for speed, one, other in crossings:
        first.setdefault((one, other), speed)
    return tuple((speed, *pair) for pair, speed in first.items())
