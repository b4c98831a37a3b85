"""Input of OpenFAST's unsteady-aerodynamics driver: read as the driver does, it is our section."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.conftest import ROOT

from equisection.aerodynamics.polar import Polar
from equisection.beam.section import Section
from equisection.io.aerodyn_polar import aerodyn_text
from equisection.io.ua_driver import DriverSection, ua_driver_text

#: Names in the order in which the driver reads them, each with its number of values; None is a
#: heading (OpenFAST's documentation, "Unsteady aerodynamics: Driver", and its test `ua_elast`).
ORDER = (
    *("Echo", None, "FldDens", "KinVisc", "SpdSound", None, "UAMod", "FLookup", None, "AirFoil"),
    *("Chord", "Vec_AQ", "Vec_AT", "UseCm", None, "SimMod", None, "InflowVel", "NCycles"),
    *("StepsPerCycle", "Frequency", "Amplitude", "Mean", "Phase", None, "TMax_PA", "DT_PA"),
    *("AeroTSFile", None, "TMax", "DT", "ActiveDOF", "InitPos", "InitVel"),
    *(f"{name}L{row}" for name in ("GFScaling", "MassMatrix") for row in (1, 2, 3)),
    *(f"{name}L{row}" for name in ("DampMatrix", "StifMatrix") for row in (1, 2, 3)),
    *("Twist", "InflowMod", "Inflow", "InflowTSFile", "MotionMod", "MotionTSFile", None),
    *("SumPrint", "WrAFITables"),
)
COUNTS = {"Vec_AQ": 2, "Vec_AT": 2, "Inflow": 2, "ActiveDOF": 3, "InitPos": 3, "InitVel": 3}

DENSITY, SPEED, INCIDENCE = 1.2, 9.0, 3.0
SECTION = Section(
    torsional_stiffness=40.0,
    flexural_stiffness=900.0,
    inertia=0.2,
    mass=3.0,
    static_imbalance=0.25,
    torsional_damping=0.03,
    flexural_damping=0.5,
    chord=0.8,
    elastic_axis=0.42,
)


def given(section: Section = SECTION) -> DriverSection:
    return DriverSection(
        airfoil="ua_airfoil.dat",
        chord=section.chord,
        elastic_axis=section.elastic_axis,
        mass=section.mass_matrix.tolist(),
        damping=section.damping_matrix.tolist(),
        stiffness=section.stiffness_matrix.tolist(),
        incidence_deg=INCIDENCE,
        twist=0.01,
        deflection=0.02,
        heave_rate=0.2,
        density=DENSITY,
        kinematic_viscosity=1.5e-5,
        sound_speed=340.0,
        speed=SPEED,
        duration=40.0,
        time_step=0.005,
    )


def read_as_the_driver(text: str) -> dict[str, list[str]]:
    """Read values before names, line by line in the driver's order; refuse any other."""
    lines = text.splitlines()[2:]
    found = {}
    for name, line in zip(ORDER, lines, strict=False):
        if name is None:
            assert line.startswith("---"), line
            continue
        count = 3 if "MatrixL" in name or "ScalingL" in name else COUNTS.get(name, 1)
        fields = re.split(r"[,\s]+", line.strip())
        assert fields[count] == name, line
        found[name] = fields[:count]
    assert lines[len(ORDER)].startswith("END")
    return found


def numbers(found: dict[str, list[str]], name: str) -> np.ndarray:
    return np.array(found[name], dtype=float)


def matrix(found: dict[str, list[str]], name: str) -> np.ndarray:
    return np.array([numbers(found, f"{name}MatrixL{row}") for row in (1, 2, 3)])


@pytest.fixture(scope="module")
def driver() -> dict[str, list[str]]:
    return read_as_the_driver(ua_driver_text(given(), "made up"))


def test_units_are_si_and_angles_in_degrees_where_the_driver_has_them(
    driver: dict[str, list[str]],
) -> None:
    for name, value in (
        ("FldDens", DENSITY),
        ("KinVisc", 1.5e-5),
        ("SpdSound", 340.0),
        ("Chord", SECTION.chord),
        ("TMax", 40.0),
        ("DT", 0.005),
        ("Twist", -INCIDENCE),
        ("SimMod", 3),
    ):
        assert numbers(driver, name) == pytest.approx([value]), name
    assert numbers(driver, "Inflow") == pytest.approx([0.0, SPEED])
    assert numbers(driver, "InitPos") == pytest.approx([0.02, 0.0, -0.01])
    assert numbers(driver, "InitVel") == pytest.approx([0.2, 0.0, 0.0])
    assert driver["ActiveDOF"] == ["T", "F", "T"]
    assert driver["AirFoil"] == ['"ua_airfoil.dat"']
    aft = numbers(driver, "Vec_AT")[1] - numbers(driver, "Vec_AQ")[1]
    assert aft == pytest.approx(0.5), "from the quarter chord to three quarters"


def test_energies_and_work_of_the_dampers_are_those_of_the_section(
    driver: dict[str, list[str]],
) -> None:
    """The driver's (x, y, th) are (w, 0, -theta): each quadratic form is the same number."""
    w, theta = 0.013, 0.07
    ours, theirs = np.array([w, theta]), np.array([w, 0.0, -theta])
    for name, own in (
        ("Mass", SECTION.mass_matrix),
        ("Damp", SECTION.damping_matrix),
        ("Stif", SECTION.stiffness_matrix),
    ):
        found = matrix(driver, name)
        np.testing.assert_allclose(found, found.T)
        assert theirs @ found @ theirs == pytest.approx(ours @ own @ ours, rel=1e-9), name
    free = np.ix_((0, 2), (0, 2))
    squares = np.linalg.eigvals(
        np.linalg.solve(matrix(driver, "Mass")[free], matrix(driver, "Stif")[free])
    )
    np.testing.assert_allclose(np.sqrt(np.sort(squares.real)), SECTION.natural_frequencies)


def test_static_equilibrium_of_the_driver_is_ours(tmp_path: Path) -> None:
    """Loads of the airfoil table about its quarter chord, moved to A as the driver moves them."""
    polar = Polar.read(ROOT / "config/polars/plate_2d_11136.csv").continued
    angles = np.arange(-12.0, 12.5, 0.5)
    coefficients = (polar.lift_coefficient, polar.moment_coefficient, polar.drag_coefficient)
    points = [(a, *(float(f(math.radians(a))) for f in coefficients)) for a in angles]
    path = tmp_path / "airfoil.dat"
    path.write_text(aerodyn_text(points, 1e5, [], unsteady=True))
    assert re.search(r"^True +InclUAdata", path.read_text(), flags=re.MULTILINE)
    rows = np.array([line.split() for line in path.read_text().splitlines()[-len(angles) :]])
    alpha_deg, lift, drag, moment = rows.astype(float).T
    still = replace(given(), twist=0.0, heave_rate=0.0)
    driver = read_as_the_driver(ua_driver_text(still, "made up"))
    chord, aft = numbers(driver, "Chord")[0], numbers(driver, "Vec_AQ")[1]
    pressure = 0.5 * numbers(driver, "FldDens")[0] * numbers(driver, "Inflow")[1] ** 2 * chord
    stiffness = matrix(driver, "Stif")

    def unbalanced(th: float) -> float:
        """Torque about A, nose down, less that of the spring (N m/m)."""
        twist = th + math.radians(numbers(driver, "Twist")[0])
        c_l, c_d, c_m = (
            np.interp(math.degrees(-twist), alpha_deg, f) for f in (lift, drag, moment)
        )
        across, along = pressure * c_l, pressure * c_d
        torque = pressure * chord * c_m
        torque -= across * chord * aft * math.cos(twist)
        torque += along * chord * aft * math.sin(twist)
        return -torque - stiffness[2, 2] * th

    th = brentq(unbalanced, -0.1, 0.1)

    def ours(theta: float) -> float:
        """Moment about the elastic axis, nose up, less that of the spring (N m/m)."""
        alpha = math.radians(INCIDENCE) + theta
        x_ea = SECTION.axis_behind_mid_chord
        c_l, c_m, c_d = (float(f(alpha)) for f in coefficients)
        about = c_m + x_ea * (c_l * math.cos(alpha) + c_d * math.sin(alpha))
        return pressure * chord * about - SECTION.torsional_stiffness * theta

    theta = brentq(ours, -0.1, 0.1)
    assert theta > math.radians(0.5)
    assert -th == pytest.approx(theta, rel=2e-3)  # five digits of the table
