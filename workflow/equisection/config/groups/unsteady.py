"""Section ``unsteady``: runs of the free section and of the free beam, and their verdict."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import EMPTY, NUMBER, WHOLE, Angle, Positive

#: Most time steps of a run.
MOST_STEPS = 10_000_000


class VerdictKeys(KeyGroup):
    """Criteria for the end and the regime of an unsteady run; amplitudes are those of the tip."""

    settled_amplitude_deg: Positive = Field(
        0.05, description="Twist amplitude (deg) below which a run has settled."
    )
    growing_amplitude_deg: Positive = Field(
        6.0, description="Twist amplitude (deg) beyond which a run is growing, and ends."
    )
    steadiness: Annotated[float, Field(gt=0, lt=0.5, allow_inf_nan=False), NUMBER] = Field(
        0.02, description="Relative change of amplitude that a limit cycle may still have (-)."
    )
    periods: Annotated[int, Field(ge=2, le=50), WHOLE] = Field(
        10, description="Periods that a verdict rests on (-)."
    )


class StartKeys(KeyGroup):
    """Start of the unsteady runs; by default they are released at rest and untwisted."""

    state: Literal["rigid", "equilibrium"] = Field(
        "rigid",
        description="`rigid`: the undeformed section or beam; `equilibrium`: its static "
        "equilibrium in the flow, from which `twist_deg` or `heave_rate` push it (solver "
        "`embedded`; `openfoam` by the run's steady polars).",
    )
    twist_deg: Angle = Field(
        0.0,
        description="Twist of the tip (deg), nose up, in which section and beam (in its first "
        "torsion mode) are held until the flow is steady, beyond that of `state`. The springs' "
        "zero stays at `flow.incidence_deg`.",
    )
    heave_rate: Annotated[float, Field(gt=-1, lt=1, allow_inf_nan=False), NUMBER] = Field(
        0.0,
        description="Rate of the tip's deflection at the release (over V), up, in the first "
        "bending mode; for sections that gallop.",
    )

    @property
    def is_given(self) -> bool:
        """Presence of a start other than rest."""
        return self.twist_deg != 0.0 or self.heave_rate != 0.0


class Unsteady(KeyGroup):
    """Runs of the free section and of the free beam, from a steady state."""

    duration: Positive = Field(
        400.0,
        description="The longest a run may take (c/V), ten output intervals or more. One shorter "
        "than 30 c/V, or than four periods of the pitch after 10 c/V, is undecided.",
    )
    time_step: Positive = Field(0.05, description="Time step (c/V).")
    output_interval: Positive = Field(
        0.1, description="Interval of the stored history (c/V), a multiple of the time step."
    )
    resolution: Annotated[str, EMPTY] = Field(
        "",
        description="Resolution of the runs, on solver `openfoam` a name in `openfoam.meshes`; "
        "empty for `steady.resolution`, of whose polars equilibrium, correction and map are in any "
        "case.",
    )
    start: StartKeys = Field(StartKeys(), description="What the runs start from.")
    verdict: VerdictKeys = Field(VerdictKeys(), description="How a run is judged.")


@check("unsteady.start", "solver")
def _equilibrium_is_pushed(start: StartKeys, solver: str) -> Iterator[Problem]:
    """Refuse an equilibrium that nothing leaves, and releases that cannot start from one."""
    if start.state != "equilibrium":
        return
    if solver == "given":
        yield Problem(
            "unsteady.start.state",
            start.state,
            "allowed is 'rigid' with solver 'given': a record starts as it was recorded",
        )
    elif not start.is_given:
        yield Problem(
            "unsteady.start.state",
            start.state,
            "allowed is 'equilibrium' with unsteady.start.twist_deg, such as 0.2, or heave_rate: "
            "nothing else sets the beam in motion",
        )


@check(
    "unsteady.start.twist_deg",
    "unsteady.verdict.settled_amplitude_deg",
    "unsteady.verdict.growing_amplitude_deg",
)
def _start_is_seen(twist: float, settled: float, growing: float) -> Iterator[Problem]:
    """Refuse a start that is settled, or growing, before anything has moved."""
    if twist != 0 and not settled < abs(twist) < growing:
        yield Problem(
            "unsteady.start.twist_deg",
            twist,
            f"allowed is 0, or between {settled:g} and {growing:g} deg either way: settled and "
            "growing_amplitude_deg of unsteady.verdict",
        )


@check("unsteady.verdict.growing_amplitude_deg", "unsteady.verdict.settled_amplitude_deg")
def _growing_is_more(growing: float, settled: float) -> Iterator[Problem]:
    if growing <= settled:
        yield Problem(
            "unsteady.verdict.growing_amplitude_deg",
            growing,
            f"allowed is a number above settled_amplitude_deg, {settled:g} deg",
        )


@check("unsteady.duration", "unsteady.output_interval")
def _long_enough(duration: float, interval: float) -> Iterator[Problem]:
    if duration < 10 * interval:
        yield Problem(
            "unsteady.duration",
            duration,
            f"allowed are ten output intervals, {interval:g} c/V each, or more",
        )


@check("unsteady.duration", "unsteady.time_step")
def _not_too_many_steps(duration: float, step: float) -> Iterator[Problem]:
    if duration > MOST_STEPS * step:
        yield Problem(
            "unsteady.duration",
            duration,
            f"allowed are up to {MOST_STEPS:,} time steps, {step:g} c/V each",
        )


@check("unsteady.output_interval", "unsteady.time_step")
def _whole_steps(interval: float, step: float) -> Iterator[Problem]:
    ratio = interval / step
    if ratio >= 1e9 or ratio < 1 - 1e-9 or abs(ratio - round(ratio)) > 1e-6 * ratio:
        yield Problem(
            "unsteady.output_interval",
            interval,
            f"allowed is the time step, {step:g} c/V, or a multiple of it",
        )
