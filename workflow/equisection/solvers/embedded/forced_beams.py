"""Loads of a beam in prescribed motion of a mode, by the equations of the embedded solver.

The circulation follows by the lags of the free motions, so that derivatives and eigenvalues are
those of the same equations.
"""

from __future__ import annotations

import math

import numpy as np

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.span_strips import SpanStrips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.beam import MID_CHORD
from equisection.cases import ForcedCase
from equisection.errors import IncidenceOutOfRangeError
from equisection.motion.beams import BeamParameters, beam_system
from equisection.motion.prescribed_strips import ModalMotion, prescribed_loads
from equisection.results.forced_result import ForcedResult, motion_of, signal_of
from equisection.solvers.embedded.job_work import STEPS_OF_BEAM


def forced_beam(
    case: ForcedCase, loads: UnsteadyLoads, strips: SpanStrips, finite_span: FiniteSpan | None
) -> ForcedResult:
    """Return the history of a case; a failed one where a strip leaves the polar.

    Parameters
    ----------
    case
        The case.
    loads
        Unsteady loads of the section polar.
    strips, finite_span
        Strips of the span, and what they do to each other; None for nothing.
    """
    longest = math.tau / max(one.frequency for one in case.harmonics) / STEPS_OF_BEAM
    every = max(1, math.ceil(case.output_interval / longest - 1e-9))
    step = case.output_interval / every
    number = round(case.duration / case.output_interval) * every + 1
    time = np.asarray(step * np.arange(number), dtype=np.float64)
    kept = slice(0, number, every)
    twist, deflection = motion_of(case, time[kept])
    parameters = _parameters(case, strips, finite_span)
    system = beam_system(parameters, loads, math.radians(case.incidence_deg))
    try:
        found = prescribed_loads(system, _motion(case, time, step))
    except IncidenceOutOfRangeError as error:
        return ForcedResult.without_history(
            f"{error}; or make forced.amplitude_deg or forced.twist_deg smaller"
        )
    return ForcedResult(
        time[kept],
        twist,
        deflection,
        found.lift[kept],
        found.moment[kept],
        bending_load=found.bending[kept].T,
        torsion_load=found.torsion[kept].T,
    )


def _parameters(
    case: ForcedCase, strips: SpanStrips, finite_span: FiniteSpan | None
) -> BeamParameters:
    """Return the modes at the strips, with a structure whose numbers do not matter."""
    shapes = case.shapes
    assert shapes is not None
    return BeamParameters.from_modes(
        span=np.array(shapes.span),
        torsion_shapes=np.array(shapes.torsion),
        torsion_frequencies=np.ones((1, len(shapes.torsion))),
        inertia=np.ones(1),
        bending_shapes=np.array(shapes.bending),
        bending_frequencies=np.ones((1, len(shapes.bending))),
        mass=np.ones(1),
        stations=strips.stations,
        weights=strips.weights,
        finite_span=finite_span,
        axis=shapes.elastic_axis - MID_CHORD,
    )


def _motion(case: ForcedCase, time: np.ndarray, step: float) -> ModalMotion:
    """Return the motion of all modes at times (c/V)."""
    assert case.shapes is not None
    twist = np.zeros((3, time.size, len(case.shapes.torsion)))
    deflection = np.zeros((3, time.size, len(case.shapes.bending)))
    moved = twist if case.component == "pitch" else deflection
    moved[:, :, case.mode - 1] = signal_of(case).moving(time)
    twist[0, :, 0] += math.radians(case.mean_twist_deg)
    return ModalMotion(step, *twist, *deflection)
