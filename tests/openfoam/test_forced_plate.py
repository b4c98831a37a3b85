"""The coupled mesh of OpenFOAM in prescribed motion, fast enough for the air to be a mass."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import STEADY_PLATE, beam_modes
from tests.watching import nothing

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.cases import ForcedCase, Harmonic, ModeShapes
from equisection.results.forced_result import ForcedResult, signal_of
from equisection.solvers.embedded.forced_beams import forced_beam
from equisection.solvers.openfoam.beam import coupled_run, rigid_beam
from equisection.solvers.openfoam.beam.forced_beam import ForcedPlateRun
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation

FREQUENCY = 4.0 * math.pi


def forced(component: str, amplitude: float, mean_twist_deg: float) -> ForcedCase:
    """Return a case at incidence 0; two periods of it are judged, after one of settling."""
    shared = {n: getattr(STEADY_PLATE, n) for n in type(STEADY_PLATE).model_fields if n != "kind"}
    modes = beam_modes()
    return ForcedCase(
        **{**shared, "incidence_deg": 0.0},
        component=component,
        shapes=ModeShapes(
            span=modes.span, bending=modes.bending_shape[:1], torsion=modes.torsion_shape[:1]
        ),
        mode=1,
        mean_twist_deg=mean_twist_deg,
        harmonics=(Harmonic(frequency=FREQUENCY, amplitude=amplitude, phase=0.0),),
        ramp=0.4,
        settling=0.5,
        duration=1.5,
        time_step=0.02,
        output_interval=0.02,
    )


def answer(case: ForcedCase, result: ForcedResult) -> complex:
    """Return the load on the bending mode over the motion."""
    kept = result.time >= case.settling
    load = result.bending_load[0][kept]
    found = load_response(result.time[kept], load, np.array([FREQUENCY]))
    return complex(found.response[0] / signal_of(case).response[0])


def test_fast_bending_has_the_apparent_mass_of_the_beam(
    installation: Installation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The load with the acceleration is that of the embedded strips within a fifth.

    The beam is held in a twist, which gives it lift at 0 deg, and moved about that.
    """
    monkeypatch.setattr(coupled_run, "STATE_INTERVAL", 1.25)
    monkeypatch.setattr(rigid_beam, "MOST", 150)
    case = forced("heave", math.radians(1.0) / FREQUENCY, mean_twist_deg=1.0)
    run = ForcedPlateRun(
        installation, case, rigid_beam.plate_mesh_of(case, 0.2), Coupling(2, 0.98), tmp_path, 1
    )
    result = run.run(nothing)
    assert not result.failure
    assert result.time[-1] == pytest.approx(case.duration, abs=0.021)
    assert result.lift.mean() > 0.04
    np.testing.assert_allclose(np.diff(result.time), 0.02)
    strips = cosine_strips(8, True)
    geometry = case.geometry
    assert geometry.tip_gap is not None
    width = geometry.span + geometry.tip_gap
    span = SpanGeometry.of(strips, 1.0, geometry.span, width, geometry.channel_height)
    loads = UnsteadyLoads.from_polar(Polar.flat_plate(0.5), SeparationLags.none())
    embedded = forced_beam(case, loads, strips, FiniteSpan.of(span))
    by_cfd, by_strips = answer(case, result), answer(case, embedded)
    assert by_cfd.real == pytest.approx(by_strips.real, rel=0.2)
    assert by_cfd.imag == pytest.approx(by_strips.imag, rel=0.4)
    again = ForcedPlateRun(installation, case, run.mesh, run.coupling, tmp_path, 1).run(nothing)
    assert again.lift == pytest.approx(result.lift, rel=1e-6)  # resumed from its state at 1.25 c/V
