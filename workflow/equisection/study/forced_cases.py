"""Cases of the section that is moved: names, motion and records."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from equisection.cases import ForcedCase, Harmonic
from equisection.motion.forced_signal import schroeder_phases
from equisection.study.assemble import steady_case

if TYPE_CHECKING:
    from equisection.config import Config
    from equisection.solvers.protocol import Solver

#: Part of the settling time in which the motion sets in.
_RAMP = 1.0 / 6.0
#: Samples of the shortest period that a history holds at least.
_SAMPLES = 20


def forced_case(config: Config, name: str, solver: Solver) -> ForcedCase:
    """Return the case of a name (:func:`equisection.study.plan.forced_names`).

    Heave has the amplitude of incidence of pitch: omega c/V times w/c.
    """
    keys = config.forced
    component, _, velocity = name.partition("_v")
    kind: Literal["pitch", "heave"] = "pitch" if component == "pitch" else "heave"
    frequencies = [math.tau / float(velocity)] if velocity else list(keys.frequencies)
    angle = math.radians(keys.amplitude_deg) / math.sqrt(len(frequencies))
    harmonics = tuple(
        Harmonic(
            frequency=frequency,
            amplitude=angle if kind == "pitch" else angle / frequency,
            phase=float(phase),
        )
        for frequency, phase in zip(frequencies, schroeder_phases(len(frequencies)), strict=True)
    )
    unsteady = config.unsteady
    longest = 1.0 / (_SAMPLES * max(frequencies) / math.tau)
    every = max(1, math.floor(min(unsteady.output_interval, longest) / unsteady.time_step + 1e-9))
    interval = every * unsteady.time_step
    mean = config.flow.incidence_deg if keys.incidence_deg is None else keys.incidence_deg
    rigid = steady_case(config, "2d", mean, config.steady.resolution, solver)
    shared = {name: getattr(rigid, name) for name in type(rigid).model_fields if name != "kind"}
    return ForcedCase(
        **shared,
        component=kind,
        harmonics=harmonics,
        ramp=_RAMP * keys.settling,
        settling=keys.settling,
        duration=_multiple(keys.settling + keys.record(frequencies), interval),
        time_step=unsteady.time_step,
        output_interval=interval,
    )


def _multiple(duration: float, interval: float) -> float:
    """Return the multiple of an interval that is next to a duration."""
    return round(math.ceil(duration / interval - 1e-6) * interval, 9)
