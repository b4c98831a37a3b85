"""The flow about a rigid section or plate, followed until its loads are known.

The steady solver has converged when all loads stay within :data:`CONVERGED` of their means over
the last :data:`WINDOW` iterations. Where it does not, the flow goes on unsteadily from there until
the means of both halves of the record agree within :data:`KNOWN`. Around an outline its fluctuation
has to have stopped growing too (:data:`EVEN`), and where vortices are shed with one frequency,
halves and means are of whole periods.

A solver is followed from outside, by its log, and ends a little after it was told to. The loads
that are used end at a look, at a given number of iterations or a given time, so that a result does
not depend on the time at which the end was noticed.

Where vortices set in so late that they still build up at the end of the longest record, a further
run goes on from there, with a record and means of its own (:func:`follow_until_even`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from equisection.files import write_text
from equisection.results.fluctuation import Fluctuation
from equisection.solvers.openfoam.case_folder import emptied
from equisection.solvers.openfoam.dictionaries import dictionary
from equisection.solvers.openfoam.process import Every, Watch
from equisection.solvers.openfoam.reading.loads import (
    FLOOR,
    Loads,
    first_known,
    read_loads,
    require_reasonable,
)
from equisection.solvers.verdicts import LOOKS_EVERY

#: Relative half range of the loads over the last iterations of a converged steady run.
CONVERGED, WINDOW, FEWEST, MOST = 5e-4, 150, 300, 3000
#: The same on the mesh of an outline, and the mean that a coefficient counts as at least. Its cells
#: of any shape leave the residuals higher: a deck at 0 deg stood still from iteration 1100 on and
#: was not known at 3000 by what the mesh of blocks is judged by.
CONVERGED_OF_OUTLINE, FLOOR_OF_OUTLINE = 1e-3, 0.1
#: Iterations after which a steady run that only starts a motion may hunt, and by how much: half
#: range of its loads, a coefficient counting as :data:`FLOOR_OF_OUTLINE` at least. A plate on
#: 437,000 cells hunts by 0.2 %.
STARTS_AFTER, STARTS_WITHIN = 600, 5e-3
#: Iterations from one look at a steady run to the next.
ITERATIONS_TO_LOOK = 50
#: Time step of a rigid unsteady run (c/V), and the relative difference of the means of its halves
#: at which they count as known.
STEP, KNOWN = 0.02, 0.01
#: Growth of the fluctuation from one half of the record to the other, on the mesh of an outline,
#: from which on vortices still build up: bluff bodies shed them, and their loads follow late.
EVEN = 0.1
#: Runs one behind the other, at most, of a flow whose vortices still build up.
TURNS = 2

#: Called with what is done and what there is to do at most.
Tell = Callable[[float, float], None]


@dataclass(frozen=True)
class RigidFlowRecord:
    """Time left out, and shortest and longest record, of a rigid unsteady run (c/V).

    A mean counts as ``floor`` at least where the difference of two halves is judged. Their
    fluctuation may grow by ``evenness`` from one half to the other. Halves and means are of whole
    periods of the lift, where it has one, ``by_periods``: a bluff body's has no mean to speak of,
    and a part of a period more or less would decide when it is known.
    """

    discarded: float
    shortest: float
    longest: float
    floor: float = FLOOR
    evenness: float = math.inf
    by_periods: bool = False

    @property
    def end(self) -> float:
        """The latest end of the run."""
        return self.discarded + self.longest

    def period(self, loads: Loads) -> float | None:
        """Return the period of the lift (c/V); None where it has none, or none is asked for."""
        if not self.by_periods or loads.time.size < 2:
            return None
        found = Fluctuation.of(loads.time, loads.drag, loads.lift, loads.moment).frequency
        return None if found is None else 1.0 / found

    def is_known(self, loads: Loads) -> bool:
        """Tell whether the means of loads, without the time left out, are known."""
        halves = loads.halves(self.period(loads))
        return halves.drift(self.floor) <= KNOWN and halves.growth(self.floor) <= self.evenness

    def is_even(self, loads: Loads) -> bool:
        """Tell whether the fluctuation of averaged loads has stopped growing."""
        return loads.halves(self.period(loads)).growth(self.floor) <= self.evenness

    def averaged(self, loads: Loads) -> Loads:
        """Return the part of loads, without the time left out, that their means are of."""
        return loads.in_whole_periods(self.period(loads))


def of_outline(record: RigidFlowRecord) -> RigidFlowRecord:
    """Return a record as it is judged on the mesh of an outline."""
    return replace(record, floor=FLOOR_OF_OUTLINE, evenness=EVEN, by_periods=True)


def has_converged(loads: Loads) -> bool:
    """Tell whether a steady run has converged."""
    return loads.time.size >= FEWEST and loads.last(WINDOW).spread() <= CONVERGED


def has_converged_around_outline(loads: Loads) -> bool:
    """Tell whether a steady run on the mesh of an outline has converged."""
    return (
        loads.time.size >= FEWEST
        and loads.last(WINDOW).spread(FLOOR_OF_OUTLINE) <= CONVERGED_OF_OUTLINE
    )


def may_start_motion(loads: Loads) -> bool:
    """Tell whether a steady run that has not converged is steady enough to start a motion from."""
    enough = loads.time.size >= STARTS_AFTER
    return enough and loads.last(WINDOW).spread(FLOOR_OF_OUTLINE) <= STARTS_WITHIN


def follow_iterations(
    folder: Path,
    is_converged: Callable[[Loads], bool],
    tell: Tell,
    run: Callable[[Watch], None],
) -> tuple[Loads, bool]:
    """Follow a steady solver until it has converged, or for long enough.

    Parameters
    ----------
    folder
        Folder of the run.
    is_converged
        Tells whether loads up to an iteration are those of a converged run.
    tell
        Called with the progress; the steady run is the first half of the work that may come.
    run
        Runs the solver with a function that tells it when to end.

    Returns
    -------
    tuple
        The loads up to the iteration that converged, or all of them; and whether one did.

    Raises
    ------
    BlowUpError
        The loads are beyond reason.
    """
    seen = Every(ITERATIONS_TO_LOOK)

    def known(loads: Loads) -> Loads | None:
        require_reasonable(loads, folder)
        return first_known(loads, is_converged, FEWEST, ITERATIONS_TO_LOOK)

    def watch(iteration: float) -> bool:
        tell(iteration, 2 * MOST)
        return seen.is_due(iteration) and known(read_loads(folder)) is not None

    run(watch)
    loads = read_loads(folder)
    part = known(loads)
    return (loads, False) if part is None else (part, True)


def follow_unsteady(
    folder: Path, record: RigidFlowRecord, tell: Tell, run: Callable[[Watch], None]
) -> Loads:
    """Follow a rigid unsteady run until the means of its loads are known, or for long enough.

    Parameters
    ----------
    folder
        Folder of the run.
    record
        The record that is wanted.
    tell
        Called with the time of the run and its latest end (c/V).
    run
        Runs the solver with a function that tells it when to end.

    Returns
    -------
    Loads
        Loads to be averaged, without the time left out.

    Raises
    ------
    BlowUpError
        The loads are beyond reason.
    """
    seen = Every(LOOKS_EVERY)
    shortest = record.discarded + record.shortest
    refused: set[int] = set()  # parts by their samples, so that each is judged once

    def is_known(part: Loads) -> bool:
        if part.time.size not in refused and record.is_known(part.since(record.discarded)):
            return True
        refused.add(part.time.size)
        return False

    def known(loads: Loads) -> Loads | None:
        require_reasonable(loads, folder)
        return first_known(loads, is_known, shortest, LOOKS_EVERY)

    def watch(time: float) -> bool:
        tell(time, record.end)
        if time < shortest or not seen.is_due(time):
            return False
        return known(read_loads(folder)) is not None

    run(watch)
    loads = read_loads(folder)
    part = known(loads)
    return record.averaged((loads if part is None else part).since(record.discarded))


def follow_until_even(
    source: Path,
    work: Path,
    wanted: RigidFlowRecord,
    tell: Tell,
    run: Callable[[Path, Path, Watch], None],
) -> tuple[Path, Loads, str]:
    """Follow the flow that goes on unsteadily from a steady run until its loads are even.

    A run whose fluctuation still grows at the end of its longest record is followed by another,
    which goes on from its last state: its means would be of a flow before and with vortices.

    Parameters
    ----------
    source
        Folder of the steady run.
    work
        Folder in which it is done.
    wanted
        The record of each run.
    tell
        Called with the progress; the steady run was the first half of the work.
    run
        Runs the solver in the second folder, from the last state of the first, with a function
        that tells it when to end.

    Returns
    -------
    tuple
        The folder of the last run, its loads to be averaged, and their origin in words.

    Raises
    ------
    BlowUpError
        The loads are beyond reason.
    """
    turns = TURNS if math.isfinite(wanted.evenness) else 1
    for turn in range(turns):
        folder = emptied(work / f"unsteady{turn + 1 if turn else ''}")

        def told(time: float, end: float, turn: int = turn) -> None:
            tell(MOST * (1.0 + (turn + time / end) / turns), 2 * MOST)

        def watched(watch: Watch, source: Path = source, folder: Path = folder) -> None:
            run(source, folder, watch)

        record = follow_unsteady(folder, wanted, told, watched)
        if wanted.is_even(record):
            break
        source = folder
    return folder, record, method_of_mean(record, wanted, turn * wanted.end)


def method_of_mean(record: Loads, wanted: RigidFlowRecord, before: float = 0.0) -> str:
    """Return the origin of a record's means in words, and whether its fluctuation still grows.

    ``before`` is the time (c/V) of runs before that of the record.
    """
    length = record.time[-1] - record.time[0]
    behind = f" behind {before:.0f} c/V" if before else ""
    said = f"mean of unsteady over {length:.0f} c/V{behind}, "
    period = wanted.period(record)
    if period is not None:
        said += f"{round(length / period)} periods, "
    halves = record.halves(period)
    said += f"its halves {100 * halves.drift(wanted.floor):.2g} % apart"
    growth = halves.growth(wanted.floor)
    if growth <= wanted.evenness:
        return said
    return f"{said}, its fluctuation {1 + growth:.2g} times as large in the second"


def write_at_rest(folder: Path) -> None:
    """Write the dictionary of a mesh at rest."""
    write_text(
        folder / "constant" / "dynamicMeshDict",
        dictionary("dynamicMeshDict", {"dynamicFvMesh": "staticFvMesh"}),
    )
