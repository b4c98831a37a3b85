"""Known flutter of sections and beams: Goland's wing, a bridge deck, a pitching airfoil."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial

import numpy as np

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.beam import Beam, Boundary, CrossSection, Damping
from equisection.beam.section import Section
from equisection.motion.beam_flutter import (
    FlutterOnset,
    beam_flutter,
    beam_growth,
    section_flutter,
)
from equisection.motion.derivative_flutter import FlowingBody, derivative_onset
from equisection.motion.linear_flutter import divergence_scale
from equisection.motion.mechanism import Mechanism
from equisection.motion.stability import critical_speed
from equisection.reduction.reduce import Reduction, reduce_beam
from equisection.structure.modal_matrices import ModalMatrices, modal_matrices
from equisection.structure.modes import modes_of_kinds
from equisection.validation.known_values import (
    DIGITS,
    OWN_CODE,
    OWN_JONES,
    KnownValue,
    Source,
)

_AIR = 1.225
_CONTOUR_ROOTS = Source(
    "published",
    "ContourRoots 0.6, tutorial 11 and validation record (flavioluiz/ContourRoots): beam by "
    "transfer matrices, exact C(p), centre of mass 0.183 m behind the axis",
)
_OWN = Source("independent", OWN_CODE)
_OWN_JONES = Source("independent", OWN_JONES)
_DIGITS = DIGITS

_GOLAND_MASS_AXIS = 0.43
#: Centre of mass of ContourRoots, 0.183 m behind the elastic axis.
_CONTOUR_ROOTS_MASS_AXIS = 0.33 + 0.183 / 1.8288


def goland(
    mass_axis: float = _GOLAND_MASS_AXIS, damping: float = 0.0, boundary: Boundary = "clamped-free"
) -> Beam:
    """Goland's wing (J. Appl. Mech. 12, 1945), inertia about the elastic axis.

    Between forks with the rigidities that give it the first frequencies of the cantilever.
    """
    bending, torsion = 9.773e6, 9.876e5
    if boundary == "pinned-pinned":
        length = 6.096 / math.pi
        bending = 35.717 * 49.4923**2 * length**4
        torsion = 8.642 * 87.1081**2 * length**2
    return Beam(
        chord=1.8288,
        length=6.096,
        thickness=0.1,
        boundary=boundary,
        cross_section=CrossSection(
            bending_rigidity=bending,
            torsional_rigidity=torsion,
            mass_per_length=35.717,
            inertia_per_length=8.642,
        ),
        elastic_axis=0.33,
        mass_axis=mass_axis,
        damping=Damping(bending=damping, torsion=damping),
    )


_STORE_MASS = 0.5 * 35.717 * 6.096
#: Goland's wing with a store of half its mass at the tip, 0.2 c behind the elastic axis and of the
#: radius of inertia 0.3 c about it; or with a spring of 30 E I/L^3 under 0.6 of its span.
_FITTED = {
    "store at the tip": {
        "lumps": [
            {
                "at": 1.0,
                "mass": _STORE_MASS,
                "inertia_about_centre": _STORE_MASS * 1.8288**2 * (0.3**2 - 0.2**2),
                "behind_axis": 0.2 * 1.8288,
            }
        ]
    },
    "spring at 0.6 L": {"supports": [{"at": 0.6, "deflection_stiffness": 30 * 9.773e6 / 6.096**3}]},
}


@cache
def _fitted(fitting: str) -> ModalMatrices:
    beam = Beam.model_validate(goland().model_dump() | _FITTED[fitting])
    return modal_matrices(beam, modes_of_kinds(beam, "beam", (1, 60, 1), (8, 8), 4), 8, 8)


def _fitted_frequency(fitting: str, number: int) -> float:
    return float(_fitted(fitting).natural_frequencies[number])


def _fitted_flutter(fitting: str) -> float:
    return beam_flutter(_fitted(fitting), 1.8288, 0.33, _AIR).speed


def _goland_fitted() -> list[KnownValue]:
    known = {
        "store at the tip": ((27.113, 70.534, 181.11), 135.306),
        "spring at 0.6 L": ((73.484, 105.848, 247.74), 98.492),
    }
    found = []
    for fitting, (frequencies, speed) in known.items():
        case = f"{_GOLAND}, {fitting}"
        found += [
            KnownValue(
                case,
                f"frequency {n + 1} in vacuum",
                "rad/s",
                value,
                _OWN,
                partial(_fitted_frequency, fitting, n),
                1e-4,
                _DIGITS,
            )
            for n, value in enumerate(frequencies)
        ]
        compute = partial(_fitted_flutter, fitting)
        found.append(KnownValue(case, "flutter", "m/s", speed, _OWN, compute, 1e-4, _DIGITS))
    return found


@cache
def _matrices(
    number: int, mass_axis: float, damping: float, boundary: Boundary = "clamped-free"
) -> ModalMatrices:
    beam = goland(mass_axis, damping, boundary)
    modes = modes_of_kinds(beam, "analytic", (8, 60, 1), (number, number), 8)
    return modal_matrices(beam, modes, number, number)


def _wing(
    number: int,
    mass_axis: float = _GOLAND_MASS_AXIS,
    density: float = _AIR,
    damping: float = 0.0,
) -> FlutterOnset:
    return beam_flutter(_matrices(number, mass_axis, damping), 1.8288, 0.33, density)


def _root_at_150() -> complex:
    matrices = _matrices(8, _CONTOUR_ROOTS_MASS_AXIS, 0.0)
    roots = beam_growth(matrices, 1.8288, 0.33, _AIR, np.array([150.0]))[0]
    return complex(roots[np.nanargmax(roots.real)])


def _still_air(number: int, mass_axis: float) -> float:
    """Return the n-th frequency (rad/s) in still air, which is the air's mass alone."""
    matrices, chord = _matrices(8, mass_axis, 0.0), 1.8288
    kinds = np.repeat([0, 1], 8)
    size = chord ** kinds.astype(float)
    air = ThinAirfoil(0.33 - 0.5).apparent_mass[np.ix_(kinds, kinds)] * matrices.likeness
    mass = matrices.mass + 0.5 * _AIR * chord**2 * np.outer(size, size) * air
    squares = np.linalg.eigvals(np.linalg.solve(mass, matrices.stiffness)).real
    return float(np.sqrt(np.sort(squares))[number])


def _pinned(pair: int) -> FlutterOnset:
    matrices = _matrices(6, _GOLAND_MASS_AXIS, 0.0, "pinned-pinned").pair(pair)
    return beam_flutter(matrices, 1.8288, 0.33, _AIR)


def _reduced(reduction: Reduction, damping: float = 0.0) -> Section:
    beam = goland(damping=damping)
    return reduce_beam(beam, modes_of_kinds(beam, "analytic", (8, 60, 1), (1, 1), 8), reduction)


def divergence_speed(section: Section, density: float) -> float:
    """Return the speed (m/s) at which a section diverges by linear theory."""
    return 100.0 / math.sqrt(divergence_scale(section.in_flow(density, 100.0)))


def _embedded(section: Section, density: float, speed: tuple[float, float]) -> float:
    """Return the onset (m/s) by the embedded solver's states, attached, at zero incidence."""
    onset = critical_speed(
        section,
        Polar.flat_plate(10.0),
        incidence_deg=0.0,
        speed=speed,
        density=density,
        lags=SeparationLags.none(),
    )
    return float(onset["critical_speed"])


def deck(damping: float) -> Section:
    """Deck of IABSE's benchmark, Task Group 3.1 (Diana et al., 2020): 0.100 and 0.278 Hz."""
    heave, pitch = 2 * math.pi * 0.1, 2 * math.pi * 0.278
    return Section(
        mass=22740.0,
        inertia=2.47e6,
        flexural_stiffness=22740.0 * heave**2,
        torsional_stiffness=2.47e6 * pitch**2,
        flexural_damping=2 * damping * 22740.0 * heave,
        torsional_damping=2 * damping * 2.47e6 * pitch,
        chord=31.0,
    )


def pitching_airfoil() -> Section:
    """Airfoil of SU2's tutorial on dynamic fluid-structure interaction, chord 1 m, axis at c/4.

    chi = 0.25, r^2 = 0.25, omega_alpha = 45 rad/s, ratio 0.3185, mu = 100, of :data:`_AIR`.
    """
    b, mu, chi, gyration_2, pitch, ratio = 0.5, 100.0, 0.25, 0.25, 45.0, 0.3185
    mass = mu * math.pi * _AIR * b**2
    inertia = gyration_2 * mass * b**2
    return Section(
        mass=mass,
        inertia=inertia,
        static_imbalance=chi * mass * b,
        flexural_stiffness=mass * (ratio * pitch) ** 2,
        torsional_stiffness=inertia * pitch**2,
        chord=2 * b,
        elastic_axis=0.25,
    )


def _derivative(number: int, reduced_velocity: float) -> float:
    """Return H1* or H4* of a flat plate at U/(f B): 1/2 rho U^2 B, heave down, K = omega B/U."""
    k = 2 * math.pi / reduced_velocity
    of_heave = ThinAirfoil().influence(k)[0, 0] / k**2
    return float(of_heave.imag if number == 1 else of_heave.real)


def _speed(compute: Callable[[], FlutterOnset]) -> Callable[[], float]:
    return lambda: compute().speed


def _omega(compute: Callable[[], FlutterOnset]) -> Callable[[], float]:
    return lambda: compute().omega


_PRISM_A1, _PRISM_DRAG = 2.69, 2.0


def _galloping_onset() -> float:
    """Return n U/beta of a square prism that begins to gallop, n = rho h^2/(2 m), U = V/(omega h).

    By eigenvalues of the embedded solver's equations, of a prism so heavy that the lags of the wake
    and the mass of the air do not matter.
    """
    mass, omega, ratio = 1e6, math.tau, 0.01
    prism = Section(
        mass=mass,
        inertia=mass,
        flexural_stiffness=mass * omega**2,
        torsional_stiffness=1e6 * mass * omega**2,
        flexural_damping=2 * ratio * mass * omega,
        torsional_damping=2e3 * ratio * mass * omega,
    )
    alpha = np.radians(np.linspace(-10.0, 10.0, 41))
    nothing = np.zeros_like(alpha)
    lift = -(_PRISM_A1 + _PRISM_DRAG) * alpha
    polar = Polar(alpha, np.full_like(alpha, _PRISM_DRAG), lift, nothing, "square prism")
    expected = 4 * mass * ratio * omega / (_AIR * _PRISM_A1)
    onset = critical_speed(
        prism,
        polar,
        incidence_deg=0.0,
        speed=(0.8 * expected, 1.2 * expected),
        density=_AIR,
        lags=SeparationLags.none(),
    )
    if onset["mechanism"].item() != Mechanism.GALLOPING:
        return math.nan
    return float(onset["critical_speed"]) / omega * _AIR / (2 * mass) / ratio


def _prism() -> list[KnownValue]:
    source = Source(
        "unconfirmed",
        "Parkinson and Smith, Quarterly Journal of Mechanics and Applied Mathematics 17, 1964: "
        "A_1 = 2.69, U = 2 beta/(n A_1)",
    )
    return [
        KnownValue(
            "Square prism, galloping",
            "n U/beta at the onset",
            "-",
            2.0 / _PRISM_A1,
            source,
            _galloping_onset,
            1e-3,
            "a prism of finite mass has a wake that lags",
        )
    ]


_GOLAND = "Goland's wing"
_LIKE_CONTOUR_ROOTS = partial(_wing, 8, _CONTOUR_ROOTS_MASS_AXIS)


def _wing_value(  # noqa: PLR0917
    quantity: str,
    unit: str,
    known: float,
    source: Source,
    compute: Callable[[], float],
    tolerance: float,
    reason: str = _DIGITS,
) -> KnownValue:
    return KnownValue(_GOLAND, quantity, unit, known, source, compute, tolerance, reason)


def _section_value(
    quantity: str, known: float, source: Source, compute: Callable[[], float], tolerance: float
) -> KnownValue:
    case = f"{_GOLAND}, section"
    return KnownValue(case, quantity, "m/s", known, source, compute, tolerance, _DIGITS)


def _goland() -> list[KnownValue]:
    found = [
        _wing_value(
            "flutter",
            "m/s",
            136.983977449,
            _CONTOUR_ROOTS,
            _speed(_LIKE_CONTOUR_ROOTS),
            1e-6,
            _DIGITS,
        ),
        _wing_value(
            "flutter",
            "rad/s",
            70.033012953,
            _CONTOUR_ROOTS,
            _omega(_LIKE_CONTOUR_ROOTS),
            1e-6,
            _DIGITS,
        ),
        _wing_value(
            "growth at 150 m/s",
            "1/s",
            3.70,
            _CONTOUR_ROOTS,
            lambda: _root_at_150().real,
            2e-3,
            _DIGITS,
        ),
        _wing_value(
            "frequency at 150 m/s",
            "rad/s",
            68.2,
            _CONTOUR_ROOTS,
            lambda: _root_at_150().imag,
            8e-4,
            _DIGITS,
        ),
        *(
            _wing_value(
                f"frequency {n + 1} in still air",
                "rad/s",
                value,
                _CONTOUR_ROOTS,
                partial(_still_air, n, _CONTOUR_ROOTS_MASS_AXIS),
                0.6 / value,
                _DIGITS,
            )
            for n, value in enumerate((46.0, 93.0, 233.0, 337.0))
        ),
        *(
            _wing_value(
                f"frequency {n + 1} in vacuum", "rad/s", value, _OWN, partial(_coupled, n), 4e-5
            )
            for n, value in enumerate((48.1554, 95.7193, 243.772, 347.61))
        ),
        _wing_value("flutter, 8 + 8 modes", "m/s", 136.996, _OWN, _speed(partial(_wing, 8)), 2e-5),
        _wing_value("flutter, 1 + 1 modes", "m/s", 136.852, _OWN, _speed(partial(_wing, 1)), 2e-5),
        _wing_value("flutter, 2 + 2 modes", "m/s", 136.995, _OWN, _speed(partial(_wing, 2)), 2e-5),
        _wing_value(
            "flutter, density 1.02 kg/m3",
            "m/s",
            146.75,
            _OWN,
            _speed(partial(_wing, 8, density=1.02)),
            4e-5,
        ),
        *(
            _wing_value(
                f"flutter, damping {100 * ratio:g} %",
                "m/s",
                value,
                _OWN,
                _speed(partial(_wing, 4, damping=ratio)),
                1e-5,
            )
            for ratio, value in ((0.005, 138.414), (0.01, 139.819), (0.02, 142.624))
        ),
        _wing_value(
            "flutter of pair 1, pinned",
            "m/s",
            132.567,
            _OWN,
            _speed(partial(_pinned, 1)),
            1e-4,
            "rounding of the frequencies given",
        ),
        _wing_value(
            "flutter of pair 2, pinned",
            "m/s",
            120.575,
            _OWN,
            _speed(partial(_pinned, 2)),
            1e-4,
            "rounding of the frequencies given",
        ),
    ]
    section = [
        _section_value(
            "flutter, `consistent`",
            133.297,
            _OWN,
            lambda: section_flutter(_reduced("consistent"), _AIR).speed,
            2e-5,
        ),
        _section_value(
            "flutter, `paper` reduction",
            124.425,
            _OWN,
            lambda: section_flutter(_reduced("paper"), _AIR).speed,
            2e-5,
        ),
        _section_value(
            "flutter, damping 1 %",
            136.198,
            _OWN,
            lambda: section_flutter(_reduced("consistent", 0.01), _AIR).speed,
            2e-5,
        ),
        _section_value(
            "flutter, embedded solver",
            133.954,
            _OWN_JONES,
            lambda: _embedded(_reduced("consistent"), _AIR, (120.0, 150.0)),
            2e-5,
        ),
        _section_value(
            "divergence", 252.35, _OWN, lambda: divergence_speed(_reduced("consistent"), _AIR), 4e-5
        ),
    ]
    return [*found, *section]


def _coupled(number: int) -> float:
    return float(_matrices(6, _GOLAND_MASS_AXIS, 0.0).natural_frequencies[number])


def _deck_speed(damping: float) -> float:
    return section_flutter(deck(damping), 1.22).speed


def _deck_from_table(damping: float) -> float:
    """Return the flutter speed (m/s) from 15 rows of Theodorsen's derivatives."""
    table = Derivatives.theodorsen(np.arange(2.0, 31.0, 2.0))
    return derivative_onset(FlowingBody.of_section(deck(damping), 1.22), table).speed


def _deck() -> list[KnownValue]:
    case = "Bridge deck, IABSE TG 3.1"
    exact = ((0.0, 76.682), (0.003, 77.242), (0.005, 77.600), (0.01, 78.449), (0.02, 80.002))
    found = [
        KnownValue(
            case,
            f"flutter, damping {100 * ratio:g} %",
            "m/s",
            value,
            _OWN,
            partial(_deck_speed, ratio),
            2e-5,
            _DIGITS,
        )
        for ratio, value in exact
    ]
    quoted = Source(
        "unconfirmed",
        "Diana et al., Structural Engineering International 30, 2020 (TG 3.1); the deck's values "
        "as others use them",
    )
    found += [
        KnownValue(
            case,
            f"flutter, damping {100 * ratio:g} %",
            "m/s",
            value,
            quoted,
            partial(_deck_speed, ratio),
            1e-4,
            _DIGITS,
        )
        for ratio, value in ((0.0, 76.68), (0.003, 77.24))
    ]
    found += [
        KnownValue(
            case,
            f"flutter, table of derivatives, damping {100 * ratio:g} %",
            "m/s",
            value,
            _OWN,
            partial(_deck_from_table, ratio),
            1e-3,
            "interpolation between reduced velocities 2 apart",
        )
        for ratio, value in exact
    ]
    return [
        *found,
        KnownValue(
            case,
            "flutter frequency, damping 0.3 %",
            "Hz",
            0.19358,
            _OWN,
            lambda: section_flutter(deck(0.003), 1.22).omega / (2 * math.pi),
            3e-5,
            _DIGITS,
        ),
        KnownValue(
            case, "divergence", "m/s", 90.466, _OWN,
            lambda: divergence_speed(deck(0.0), 1.22), 2e-5, _DIGITS,
        ),
        KnownValue(
            case,
            "flutter, embedded solver, damping 0 %",
            "m/s",
            76.165,
            _OWN_JONES,
            lambda: _embedded(deck(0.0), 1.22, (60.0, 85.0)),
            2e-5,
            _DIGITS,
        ),
        KnownValue(
            case,
            "flutter, embedded solver, damping 0.3 %",
            "m/s",
            76.679,
            _OWN_JONES,
            lambda: _embedded(deck(0.003), 1.22, (60.0, 85.0)),
            2e-5,
            _DIGITS,
        ),
    ]  # fmt: skip


def _airfoil() -> list[KnownValue]:
    case = "Pitching and plunging airfoil of SU2's tutorial"
    exact, jones = (126.91, 25.645), 127.61
    return [
        KnownValue(
            case, "flutter", "m/s", exact[0], _OWN,
            lambda: section_flutter(pitching_airfoil(), _AIR).speed, 4e-5, _DIGITS,
        ),
        KnownValue(
            case, "flutter", "rad/s", exact[1], _OWN,
            lambda: section_flutter(pitching_airfoil(), _AIR).omega, 4e-5, _DIGITS,
        ),
        KnownValue(
            case, "flutter, embedded solver", "m/s", jones, _OWN_JONES,
            lambda: _embedded(pitching_airfoil(), _AIR, (100.0, 150.0)), 5e-5, _DIGITS,
        ),
    ]  # fmt: skip


def _flat_plate() -> list[KnownValue]:
    known = {
        4: (-2.222, 1.099),
        8: (-5.019, 0.242),
        12: (-8.226, -0.637),
        16: (-11.688, -1.449),
    }
    return [
        KnownValue(
            "Flutter derivatives of a flat plate",
            f"H{number}\\* at U/(f B) = {reduced}",
            "-",
            value,
            Source("independent", "Theodorsen's function, half rho U^2 B, heave down"),
            partial(_derivative, number, reduced),
            0.0006 / abs(value),
            _DIGITS,
        )
        for place, number in enumerate((1, 4))
        for reduced, value in ((one, values[place]) for one, values in known.items())
    ]


def flutter_values() -> list[KnownValue]:
    """Known values of flutter and divergence."""
    return [
        *_goland(),
        *_goland_fitted(),
        *_deck(),
        *_airfoil(),
        *_flat_plate(),
        *_prism(),
    ]
