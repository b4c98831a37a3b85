"""Input files of OpenFAST's unsteady-aerodynamics driver: a section that moves elastically.

``UnsteadyAero_Driver`` with ``SimMod`` 3 integrates M q'' + C q' + K q = loads, q = (x, y, th), of
a reference point A (OpenFAST's documentation, "Unsteady aerodynamics: Driver"). The wind blows
along y; x is across it, towards the suction side; these axes are fixed. Twist is positive nose
*down*: the angle of attack is that of the flow less ``Twist`` and th. Lengths along the chord are
in chords, aft of A.

With w up and theta nose up as in :mod:`equisection.conventions` this is x = w and th = -theta, so
that the coupling of the mass matrix, -S of (w, theta), is +S of (x, th).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

#: A row of three numbers, of x, y and th.
Row = tuple[float, float, float]
_RULE = 79


@dataclass(frozen=True)
class DriverSection:
    """Section in a flow, in SI units per metre of span.

    Attributes
    ----------
    airfoil
        Name of the airfoil table, as seen from the folder of the driver's file.
    chord
        c (m).
    elastic_axis
        Place of the reference point A (x/c from the leading edge).
    mass, damping, stiffness
        Matrices of (w, theta) about A, shape (2, 2): kg/m to kg m; N s/m^2 to N s; N/m^2 to N.
    incidence_deg
        Rigid incidence theta_0 (deg), nose up.
    twist, deflection
        Twist (rad), nose up, and deflection (m), up, at the start.
    heave_rate
        Rate of the deflection at the start (m/s), up.
    density, kinematic_viscosity, sound_speed, speed
        Of the fluid: rho (kg/m^3), nu (m^2/s), a (m/s), V (m/s).
    duration, time_step
        Length of the run and time step (s).
    """

    airfoil: str
    chord: float
    elastic_axis: float
    mass: Sequence[Sequence[float]]
    damping: Sequence[Sequence[float]]
    stiffness: Sequence[Sequence[float]]
    incidence_deg: float
    twist: float
    deflection: float
    heave_rate: float
    density: float
    kinematic_viscosity: float
    sound_speed: float
    speed: float
    duration: float
    time_step: float


def ua_driver_text(section: DriverSection, title: str) -> str:
    """Return the driver's input file: an elastic section in a steady stream.

    The degree of freedom along the stream (y) is held; its mass and stiffness are those across.
    The unsteady model is number 4, Beddoes and Leishman's in the four states of Hansen, Gaunaa and
    Madsen (Risoe-R-1354, 2004).

    Parameters
    ----------
    section
        The section.
    title
        A line for the head of the file.
    """
    quarter = 0.25 - section.elastic_axis
    three_quarters = 0.75 - section.elastic_axis
    lines = [
        f"{'-' * 11} {title} {'-' * 11}",
        "x across the wind (up), y along it, th nose down, about the elastic axis A; SI units "
        "per metre of span",
        _line("False", "Echo", "Echo the input file data (flag)"),
        _head("ENVIRONMENTAL CONDITIONS"),
        _line(section.density, "FldDens", "Density of working fluid (kg/m^3)"),
        _line(section.kinematic_viscosity, "KinVisc", "Kinematic viscosity (m^2/s)"),
        _line(section.sound_speed, "SpdSound", "Speed of sound (m/s)"),
        _head("UNSTEADYAERO"),
        _line(4, "UAMod", "Unsteady model {4: B-L HGM 4-states}"),
        _line("True", "FLookup", "Look f' up in the airfoil table (flag)"),
        _head("AIRFOIL PROPERTIES"),
        _line(f'"{section.airfoil}"', "AirFoil", "Airfoil table: alpha, Cl, Cd, Cm"),
        _line(section.chord, "Chord", "Chord length (m)"),
        _line((0.0, quarter), "Vec_AQ", "From A to the quarter chord, aft (chords)"),
        _line((0.0, three_quarters), "Vec_AT", "From A to three quarters, aft (chords)"),
        _line("True", "UseCm", "Use Cm of the airfoil table (flag)"),
        _head("SIMULATION CONTROL"),
        _line(3, "SimMod", "Simulation {3: elastic cross section}"),
        _head("REDUCED-FREQUENCY SIMULATION [used only when SimMod=1]"),
        _line(section.speed, "InflowVel", "Inflow velocity (m/s)"),
        _line(1, "NCycles", "Number of oscillations (-)"),
        _line(60, "StepsPerCycle", "Time steps per cycle (-)"),
        _line(1, "Frequency", "Frequency of the oscillations (Hz)"),
        _line(0, "Amplitude", "Amplitude of the angle of attack (deg)"),
        _line(section.incidence_deg, "Mean", "Mean of the angle of attack (deg)"),
        _line(0, "Phase", "Initial phase (steps)"),
        _head("PRESCRIBED-AERO SIMULATION [used only when SimMod=2]"),
        _line(section.duration, "TMax_PA", "Total run time (s)"),
        _line(section.time_step, "DT_PA", "Time step (s)"),
        _line('"unused"', "AeroTSFile", "File of a time series"),
        _head("AERO-ELASTIC SIMULATION [used only when SimMod=3]"),
        _line(section.duration, "TMax", "Total run time (s)"),
        _line(section.time_step, "DT", "Time step (s)"),
        _line(("T", "F", "T"), "ActiveDOF", "Degrees of freedom that move: x, y, th (flags)"),
        _line((section.deflection, 0.0, -section.twist), "InitPos", "Start (m, m, rad)"),
        _line((section.heave_rate, 0.0, 0.0), "InitVel", "Start (m/s, m/s, rad/s)"),
        *_matrix("GFScaling", ((1, 0, 0), (0, 1, 0), (0, 0, 1)), "Loads per metre as they are (-)"),
        *_matrix("MassMatrix", _of_three(section.mass), "Mass matrix (kg/m, kg, kg m)"),
        *_matrix("DampMatrix", _of_three(section.damping), "Damping matrix (N s/m^2, N s/m, N s)"),
        *_matrix("StifMatrix", _of_three(section.stiffness), "Stiffness matrix (N/m^2, N/m, N)"),
        _line(-section.incidence_deg, "Twist", "Twist at th = 0 (deg), nose down"),
        _line(1, "InflowMod", "Inflow {1: constant}"),
        _line((0.0, section.speed), "Inflow", "Inflow velocity along x and y (m/s)"),
        _line('"unused"', "InflowTSFile", "File of the inflow"),
        _line(1, "MotionMod", "Motion {1: dynamic}"),
        _line('"unused"', "MotionTSFile", "File of a prescribed motion"),
        _head("OUTPUT CONTROL"),
        _line("True", "SumPrint", "Write a summary file (flag)"),
        _line("False", "WrAFITables", "Write the coefficients used internally (flag)"),
        "END of driver input file",
    ]
    return "\n".join(lines) + "\n"


def _of_three(of_two: Sequence[Sequence[float]]) -> tuple[Row, Row, Row]:
    """Return a matrix of (x, y, th) from that of (w, theta)."""
    (across, coupling), (other, turning) = of_two
    return (across, 0.0, -coupling), (0.0, across, 0.0), (-other, 0.0, turning)


def _head(title: str) -> str:
    return f"{'-' * 19} {title} ".ljust(_RULE, "-")


def _matrix(name: str, rows: Sequence[Sequence[float]], meaning: str) -> Iterable[str]:
    for number, row in enumerate(rows, start=1):
        yield _line(tuple(row), f"{name}L{number}", meaning if number == 1 else "")


def _line(value: object, name: str, meaning: str) -> str:
    values = value if isinstance(value, tuple) else (value,)
    text = ", ".join(f"{one + 0.0:.10g}" if isinstance(one, float) else str(one) for one in values)
    return f"{text:<36} {name:<14} - {meaning}".rstrip()
