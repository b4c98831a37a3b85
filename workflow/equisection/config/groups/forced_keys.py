"""Section ``forced``: motion that is prescribed, for the derivatives of the section."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from equisection.config.groups.unsteady import MOST_STEPS
from equisection.io.derivative_table import FEWEST_ROWS
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NULLABLE, NUMBER, WHOLE, Angle, Positive, Truth


class ForcedKeys(KeyGroup):
    """Motion of the section in pitch, and in heave, that its flutter derivatives are found from."""

    run: Truth = Field(
        False,
        description="Whether the section is moved: its derivatives come to `derivatives/2d.csv`, "
        "and their onset to `comparison/critical_speed.csv`.",
    )
    motion: Literal["multi-sine", "harmonic"] = Field(
        "multi-sine",
        description="`multi-sine`: all reduced velocities in one run of pitch and one of heave; "
        "`harmonic`: a run for each.",
    )
    reduced_velocity: Annotated[tuple[Positive, ...], Field(min_length=FEWEST_ROWS)] = Field(
        (3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0),
        description="Reduced velocities V/(f c), ascending; the onset is looked for between them.",
    )
    incidence_deg: Annotated[Angle | None, NULLABLE] = Field(
        None,
        description="Mean incidence (deg). The onset is that of the section about its static "
        "equilibrium, so that this is the rigid incidence plus the twist there; "
        "`flow.incidence_deg` with null.",
    )
    amplitude_deg: Annotated[float, Field(gt=0, le=20, allow_inf_nan=False), NUMBER] = Field(
        0.25,
        description="Amplitude of the incidence (deg), by pitch or by the speed of heave: of a "
        "harmonic, or root mean square times the root of 2 of a multi-sine.",
    )
    beam_modes: Annotated[int, Field(ge=0, le=12), WHOLE] = Field(
        0,
        description="Bending modes, and as many torsion modes, of the beam that are moved too, "
        "each by itself: the loads on these modes come to `derivatives/3d.csv`, and their onset "
        "takes the place of strips with the loads of the section (-). 0: the section alone.",
    )
    twist_deg: Angle = Field(
        0.0,
        description="Mean twist of the moved beam where that is largest (deg), in its first "
        "torsion mode, beyond `incidence_deg`: that of its static equilibrium.",
    )
    periods: Annotated[int, Field(ge=2, le=100), WHOLE] = Field(
        4,
        description="Periods of the slowest harmonic that are recorded, or more where it takes "
        "more to tell two frequencies apart (-).",
    )
    settling: Positive = Field(
        30.0,
        description="Time before the record (c/V), in the first sixth of which the motion sets in.",
    )

    @property
    def frequencies(self) -> tuple[float, ...]:
        """Reduced frequencies omega c/V, descending."""
        return tuple(math.tau / one for one in self.reduced_velocity)

    def record(self, frequencies: Sequence[float]) -> float:
        """Length of a record (c/V) in whose halves frequencies (omega c/V) are told apart."""
        apart = [abs(a - b) for a, b in itertools.pairwise(sorted(frequencies))]
        halves = [math.tau / one for one in apart]
        return max(
            self.periods * math.tau / min(frequencies), *(2.0 * half for half in halves), 0.0
        )

    @property
    def longest(self) -> float:
        """Duration of the longest run (c/V), but for its last step."""
        together = self.motion == "multi-sine"
        slowest = self.frequencies if together else self.frequencies[-1:]
        return self.settling + self.record(slowest)


@check("forced.reduced_velocity")
def _ascending_velocities(velocities: tuple[float, ...]) -> Iterator[Problem]:
    for place, (low, high) in enumerate(itertools.pairwise(velocities), start=1):
        if not high > 1.02 * low:
            yield Problem(
                f"forced.reduced_velocity.{place}",
                high,
                f"allowed is a number that is 2 % or more above the one before it, {low:g}",
            )


@check("forced.beam_modes", "structure.bending_modes", "structure.torsion_modes")
def _modes_that_there_are(moved: int, bending: int, torsion: int) -> Iterator[Problem]:
    if moved > min(bending, torsion):
        yield Problem(
            "forced.beam_modes",
            moved,
            f"allowed is 0 to {min(bending, torsion)}, what structure.bending_modes and "
            "structure.torsion_modes are",
        )


@check("forced", "unsteady.time_step")
def _not_too_many_steps(forced: ForcedKeys, step: float) -> Iterator[Problem]:
    if forced.run and forced.longest > MOST_STEPS * step:
        yield Problem(
            "forced.settling",
            forced.settling,
            f"allowed are runs of up to {MOST_STEPS:,} time steps, {step:g} c/V each; settling and "
            f"record of the slowest motion are {forced.longest:.3g} c/V",
        )


@check("forced.run", "derivatives.table")
def _one_source(run: bool, table: str) -> Iterator[Problem]:
    if run and table:
        yield Problem(
            "derivatives.table",
            table,
            'allowed with forced.run: true is "": the run makes a table of its own',
        )
