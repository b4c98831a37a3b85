"""Coupling of bending and twist as a quantity of the section: physics, files and cases."""

import math
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError
from tests.sample_cases import MEDIUM, PAPER, UNSTEADY

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.cases import case_hash, read_cases, write_cases
from equisection.errors import EquisectionError
from equisection.motion.linear_flutter import divergence_scale
from equisection.motion.sections import section_system
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import reduce_beam
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_dataset import equivalent_to_dataset, section_from_dataset
from equisection.structure.modes import compute_modes

PLAIN = Section(mass=80.0, inertia=6.67, flexural_stiffness=3.9, torsional_stiffness=21.0)
WASHED_OUT = Section(**{**dict(PLAIN), "coupling_stiffness": 0.7})


@pytest.mark.parametrize("coupling", [-0.7, 0.0, 0.3, 0.7])
def test_divergence_is_where_loads_and_springs_balance(coupling: float) -> None:
    section = Section(**{**dict(PLAIN), "coupling_stiffness": coupling})
    scale = divergence_scale(section)
    springs, loads = section.stiffness_matrix, ThinAirfoil().influence(0.0).real
    assert np.linalg.det(scale * springs - loads) == pytest.approx(0.0, abs=1e-12)


def test_fibres_that_twist_the_nose_down_under_lift_put_divergence_off() -> None:
    """Aeroelastic tailoring (Weisshaar, J. Aircraft 18(8), 1981)."""
    assert divergence_scale(WASHED_OUT) < divergence_scale(PLAIN)
    assert divergence_scale(Section(**{**dict(PLAIN), "coupling_stiffness": 1.1})) == 0.0


def test_stiffness_that_some_motion_does_not_feel_is_refused() -> None:
    limit = math.sqrt(3.9 * 21.0)
    with pytest.raises(ValidationError, match="allowed is less than sqrt"):
        Section(**{**dict(PLAIN), "coupling_stiffness": limit})


def test_energy_is_the_same_in_the_flow() -> None:
    """Work over q c^2 of a deflection of one chord and a twist of one radian."""
    density, speed, chord = 1.18, 20.0, 0.1
    section = Section(**{**dict(WASHED_OUT), "chord": chord})
    motion = np.diag([chord, 1.0])
    work = motion @ section.stiffness_matrix @ motion
    flowing = section.in_flow(density, speed).stiffness_matrix
    np.testing.assert_allclose(0.5 * density * speed**2 * chord**2 * flowing, work, rtol=1e-12)


def test_it_goes_to_file_and_back(tmp_path: Path) -> None:
    modes = compute_modes(PAPER, "analytic", count=4)
    reduced = reduce_beam(PAPER, modes)
    section = Section(**{**dict(reduced), "coupling_stiffness": 12.0})
    data = equivalent_to_dataset(
        {"consistent": section},
        span_integrals(PAPER, modes, count=1),
        (),
        density=MEDIUM.density,
        speed=MEDIUM.speed,
    )
    write_dataset(tmp_path / "equivalent.nc", data)
    read = read_dataset(tmp_path / "equivalent.nc")
    assert section_from_dataset(read, "consistent") == section
    assert read["coupling_stiffness"].attrs["units"] == "N rad-1 m-1"
    assert read["k_c_star"].item() == pytest.approx(12.0 / (236.0 * 0.1))


def test_it_reaches_the_case_where_it_is_not_nil(tmp_path: Path) -> None:
    assert UNSTEADY.section is not None
    nil, coupled = (
        UNSTEADY.model_copy(
            update={"section": Section(**{**dict(UNSTEADY.section), "coupling_stiffness": value})}
        )
        for value in (0.0, 0.2)
    )
    assert case_hash(nil) == case_hash(UNSTEADY)
    assert case_hash(coupled) != case_hash(UNSTEADY)
    write_cases(tmp_path / "cases.json", {"k6.44": coupled})
    assert read_cases(tmp_path / "cases.json") == {"k6.44": coupled}


def test_strip_model_refuses_it_by_name() -> None:
    with pytest.raises(EquisectionError, match=r"takes no section with coupling_stiffness 0\.7"):
        section_system([WASHED_OUT], None, 0.0)  # type: ignore[arg-type]
