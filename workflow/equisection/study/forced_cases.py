"""Cases of the section or beam that is moved: motion and records."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import xarray as xr

from equisection.cases import ForcedCase, Harmonic, ModeShapes
from equisection.errors import ArgumentError
from equisection.motion.forced_signal import schroeder_phases
from equisection.results.modes_dataset import modes_from_dataset
from equisection.solvers.protocol import HasRecords
from equisection.study.assemble import steady_case

if TYPE_CHECKING:
    from equisection.config import Config
    from equisection.solvers.protocol import Solver

#: Part of the settling time in which the motion sets in.
_RAMP = 1.0 / 6.0
#: Samples of the shortest period that a history holds at least.
_SAMPLES = 20


def forced_case(
    config: Config, name: str, solver: Solver, modes: xr.Dataset | None = None
) -> ForcedCase:
    """Return the case of a name (:func:`equisection.study.plan.forced_names`).

    Heave has the amplitude of incidence of pitch: omega c/V times w/c. So has a bending mode that
    of a torsion mode, where each is largest.

    Parameters
    ----------
    config
        The configuration.
    name
        Name of the case.
    solver
        The solver that is to run it.
    modes
        Modes of the beam (``structure/modes.nc``), for a case of the beam.
    """
    keys = config.forced
    component, _, velocity = name.partition("_v")
    moved = component.rstrip("0123456789")
    kind: Literal["pitch", "heave"] = "pitch" if moved in ("pitch", "torsion") else "heave"
    dimension = "2d" if moved == component else "3d"
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
    rigid = steady_case(config, dimension, mean, config.steady.resolution, solver)
    shared = {name: getattr(rigid, name) for name in type(rigid).model_fields if name != "kind"}
    if isinstance(solver, HasRecords):
        known = {"component": kind, "reduced_velocity": velocity, "incidence_deg": f"{mean:g}"}
        record = solver.motion_record_of(name, known)
        shared["solver"] = rigid.solver.model_copy(update={"settings": record})
    return ForcedCase(
        **shared,
        component=kind,
        **({} if dimension == "2d" else _of_beam(config, int(component[len(moved) :]), modes)),
        harmonics=harmonics,
        ramp=_RAMP * keys.settling,
        settling=keys.settling,
        duration=_multiple(keys.settling + keys.record(frequencies), interval),
        time_step=unsteady.time_step,
        output_interval=interval,
    )


def _of_beam(config: Config, mode: int, modes: xr.Dataset | None) -> dict[str, Any]:
    """Return the members of a case of the beam: its shapes, and the mode that moves."""
    if modes is None:
        raise ArgumentError("modes is None; wanted structure/modes.nc for a case of the beam")
    found, number = modes_from_dataset(modes), config.forced.beam_modes
    shapes = ModeShapes(
        span=tuple(found.span),
        bending=tuple(map(tuple, found.bending(number).shape)),
        torsion=tuple(map(tuple, found.torsion(number).shape)),
        elastic_axis=config.beam.elastic_axis,
    )
    return {"shapes": shapes, "mode": mode, "mean_twist_deg": config.forced.twist_deg}


def _multiple(duration: float, interval: float) -> float:
    """Return the multiple of an interval that is next to a duration."""
    return round(math.ceil(duration / interval - 1e-6) * interval, 9)
