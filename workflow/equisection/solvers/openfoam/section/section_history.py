"""Motion and loads of the free section over time, from the files of its run so far."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.reading.loads import Loads, read_loads, reasonable
from equisection.solvers.openfoam.section.body_axes import BodyAxes, moment_about
from equisection.solvers.openfoam.section.section_motion import BodyMotion, read_motion

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SectionHistory:
    """Motion and loads of the section over convective time, shape (n,).

    Attributes
    ----------
    time
        s (c/V).
    twist, deflection
        Nose up (rad); of the elastic axis, up (chords).
    lift, moment
        c_l, and c_m about the moving mid-chord.
    axis_moment
        c_m about the moving elastic axis.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift: Floats
    moment: Floats
    axis_moment: Floats

    def first(self, samples: int) -> SectionHistory:
        """Return the first samples."""
        return SectionHistory(*(getattr(self, one.name)[:samples] for one in fields(self)))

    def sampled(self, step: float, interval: float, end: float = math.inf) -> SectionHistory:
        """Return the samples up to an end at multiples of an interval, which is one of the step."""
        every = round(interval / step)
        kept = np.rint(self.time / step).astype(int) % every == 0
        kept &= self.time < end + 0.5 * step
        return SectionHistory(
            self.time[kept],
            self.twist[kept],
            self.deflection[kept],
            self.lift[kept],
            self.moment[kept],
            self.axis_moment[kept],
        )


def read_section(
    folder: Path,
    axes: BodyAxes,
    loads: Loads | None = None,
    motion_of: Callable[[Path], BodyMotion] = read_motion,
) -> SectionHistory:
    """Return the history of a free run so far.

    Parameters
    ----------
    folder
        Folder of the run.
    axes
        Axes of its section.
    loads
        Its loads, if they are read already.
    motion_of
        Reads its motion from its folder.

    Raises
    ------
    SolverError
        A file is missing or of an unknown layout, or steps are missing in it.
    """
    loads = read_loads(folder) if loads is None else loads
    loads = loads.first(reasonable(loads))
    motion = motion_of(folder)
    # either file may have a row that the other does not have yet
    _, one, other = np.intersect1d(
        _steps(loads.time), _steps(motion.time), return_indices=True, assume_unique=True
    )
    _require_every_step(loads.time[one], folder)
    twist = axes.start_twist + motion.rotation[other]
    deflection = axes.deflection(motion.height[other], twist)
    known = loads.moment[one], loads.lift[one], loads.drag[one]
    return SectionHistory(
        time=loads.time[one],
        twist=twist,
        deflection=deflection,
        lift=loads.lift[one],
        moment=moment_about(axes.mid_chord_places(twist, deflection), *known),
        axis_moment=moment_about(axes.axis_places(twist, deflection), *known),
    )


def _steps(time: Floats) -> NDArray[np.int64]:
    """Return times as whole numbers, by which two files agree."""
    return np.rint(time * 1e7).astype(np.int64)


def _require_every_step(time: Floats, folder: Path) -> None:
    """Refuse a history that a full disk, or a hand, has left with a gap."""
    steps = np.diff(_steps(time))
    if steps.size and steps.max() > 1.5 * np.median(steps):
        gap = int(steps.argmax())
        raise SolverError(
            f"{folder / 'postProcessing'}: steps are missing between {time[gap]:g} and "
            f"{time[gap + 1]:g} c/V; delete {folder} and run again"
        )
