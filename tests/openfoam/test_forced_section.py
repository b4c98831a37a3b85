"""The section of OpenFOAM in prescribed motion, fast enough for the air to be a mass."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import STEADY
from tests.watching import nothing

from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.cases import ForcedCase, Harmonic
from equisection.results.forced_result import signal_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.section.forced_section import ForcedRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of

#: Coarser than any preset, about 4,000 cells.
VERY_COARSE = 0.6


def forced(component: str, frequency: float, amplitude: float) -> ForcedCase:
    """Return a case at incidence 0; two c/V of it are judged, after one of settling."""
    shared = {n: getattr(STEADY, n) for n in type(STEADY).model_fields if n != "kind"}
    return ForcedCase(
        **{**shared, "incidence_deg": 0.0},
        component=component,
        harmonics=(Harmonic(frequency=frequency, amplitude=amplitude, phase=0.0),),
        ramp=0.5,
        settling=1.0,
        duration=3.0,
        time_step=0.02,
        output_interval=0.02,
    )


def test_fast_heave_has_the_apparent_mass_of_a_plate(
    installation: Installation, tmp_path: Path
) -> None:
    """Lift with the acceleration at K = 2 pi: Theodorsen's within a fifth, of a thick plate."""
    frequency = 2.0 * math.pi
    case = forced("heave", frequency, math.radians(1.0) / frequency)
    run = ForcedRun(installation, case, mesh_of(case, VERY_COARSE), Coupling(4), tmp_path)
    result = run.run(nothing)
    assert not result.failure
    assert result.time[-1] == pytest.approx(3.0)
    kept = result.time >= case.settling
    found = load_response(result.time[kept], result.lift[kept], np.array([frequency]))
    load = complex(found.response[0] / signal_of(case).response[0])
    exact = complex(ThinAirfoil().influence(frequency)[0, 0])
    assert load.real == pytest.approx(exact.real, rel=0.2)
    assert load.imag == pytest.approx(exact.imag, rel=0.3)
    again = ForcedRun(installation, case, run.mesh, run.coupling, tmp_path).run(nothing)
    assert again.lift == pytest.approx(result.lift, rel=1e-6)  # resumed from its state at 2 c/V
