"""Static equilibrium of a beam by the loads along the span of the rigid beam."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import beam_modes

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.cases import UnsteadyCase
from equisection.motion.beam_equilibrium import beam_in_equilibrium
from equisection.results.netcdf import read_dataset
from equisection.results.polar_dataset import gather_polar, strip_polars_at
from equisection.solvers.embedded.releases import beam_parameters

KEPT = Path(__file__).parents[2] / "results/reference"
RIGID = math.radians(2.5)


def test_springs_of_every_mode_carry_the_loads_of_the_strips():
    """Of a thin plate whose loads fall towards the tip; None beyond its fold and its polar."""
    incidence, stations = np.radians(np.arange(0.0, 21.0, 1.0)), np.linspace(0.02, 0.98, 25)
    thin, fall = Polar.flat_plate(math.radians(20.0)), np.sqrt(1.0 - stations**4)
    lift, moment = (
        getattr(thin, f"{load}_coefficient")(incidence)[:, None] * fall
        for load in ("lift", "moment")
    )
    polars = StripPolars(incidence, stations, lift, moment, "thin")
    beam = beam_parameters([beam_modes(0.3)], polars.strips, None)
    structure = beam.structure
    position = beam_in_equilibrium(beam, polars, RIGID)
    assert position is not None
    torsion, bending = position[:2], position[2:]
    alpha = RIGID + torsion @ structure.torsion_shapes.T
    assert alpha[-1] > RIGID + math.radians(0.2)
    by_moment = structure.torsion_stiffness[0], torsion, structure.torsion_shapes
    by_lift = structure.bending_stiffness[0], bending, structure.bending_shapes
    for (spring, motion, shapes), loads in (
        (by_moment, thin.moment_coefficient(alpha)),
        (by_lift, thin.lift_coefficient(alpha)),
    ):
        carried = (structure.weights * fall * loads) @ shapes
        np.testing.assert_allclose(spring * motion, carried, rtol=1e-3, atol=1e-6)
    soft = beam_parameters([beam_modes(0.02)], polars.strips, None)
    assert beam_in_equilibrium(soft, polars, RIGID) is None
    assert beam_in_equilibrium(beam, polars, math.radians(21.0)) is None


@pytest.mark.parametrize(("k_star", "run"), [(6.44, "3d"), (8, "3d"), (10, "3d-long")])
def test_release_of_the_plate_settles_about_its_equilibrium(k_star: float, run: str):
    """OpenFOAM's releases from rest swing about it: twist within 5 %, deflection within 6 %."""
    place = KEPT / "paper-plate-openfoam-3d/steady/3d"
    results = {
        ("coarse", float(data.attrs["incidence_deg"])): data
        for data in map(read_dataset, place.glob("coarse_a*.nc"))
    }
    polars = strip_polars_at(gather_polar(results), "coarse")
    data = read_dataset(KEPT / f"paper-plate-openfoam-{run}/unsteady/3d/k{k_star:g}.nc")
    case = UnsteadyCase.model_validate(json.loads(data.attrs["case"]))
    assert case.beam is not None
    beam = beam_parameters([case.beam], polars.strips, None)
    position = beam_in_equilibrium(beam, polars, math.radians(case.incidence_deg))
    assert position is not None
    late = data["time"].to_numpy() > 15.0
    twist = float(data["tip_twist"].to_numpy()[late].mean())
    deflection = float(data["tip_deflection"].to_numpy()[late].mean()) / data.attrs["chord"]
    modes = beam.torsion_at_tip.size
    assert position[:modes] @ beam.torsion_at_tip == pytest.approx(twist, rel=0.05)
    assert position[modes:] @ beam.bending_at_tip == pytest.approx(deflection, rel=0.06)
