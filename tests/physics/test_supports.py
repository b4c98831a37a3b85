"""Beams with supports, springs, dashpots and lumped masses along the span.

Numbers of Goland's wing are those of an independent finite-element and Theodorsen code.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.beam import Beam
from equisection.errors import ModesError, ReductionError
from equisection.motion.beam_flutter import beam_flutter
from equisection.motion.beams import BeamParameters, Fittings, beam_system
from equisection.motion.steady_states import least_stable_eigenvalue
from equisection.reduction.beam_section import reduce
from equisection.reduction.flutter_bias import flutter_bias
from equisection.reduction.reduce import reduce_beam
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.modes import compute_modes, modes_of_kinds

AIR, CHORD, LENGTH = 1.225, 1.8288, 6.096
EI, GJ, MASS, INERTIA = 9.773e6, 9.876e5, 35.717, 8.642
STORE = 0.5 * MASS * LENGTH


def goland(**more) -> Beam:
    return Beam(
        **{
            "chord": CHORD,
            "length": LENGTH,
            "thickness": 0.1,
            "elastic_axis": 0.33,
            "mass_axis": 0.43,
            "cross_section": {
                "bending_rigidity": EI,
                "torsional_rigidity": GJ,
                "mass_per_length": MASS,
                "inertia_per_length": INERTIA,
            },
            **more,
        }
    )


def tip_store() -> Beam:
    """Half the wing's mass at its tip, 0.2 c behind the axis, of the radius 0.3 c about it."""
    about_centre = STORE * CHORD**2 * (0.3**2 - 0.2**2)
    lump = {"at": 1.0, "mass": STORE, "behind_axis": 0.2 * CHORD}
    return goland(lumps=[{**lump, "inertia_about_centre": about_centre}])


def sprung() -> Beam:
    return goland(supports=[{"at": 0.6, "deflection_stiffness": 30 * EI / LENGTH**3}])


def modes_of(beam: Beam, number: int = 8, elements: int = 60):
    return modes_of_kinds(beam, "beam", (1, elements, 1), (number, number), 4)


def matrices_of(beam: Beam, number: int = 8):
    return modal_matrices(beam, modes_of(beam, number), number, number)


TRACKER = [
    {"at": 0.5, "deflection": "fixed", "twist": "fixed"},
    *({"at": at, "deflection": "fixed"} for at in (0.1, 0.3, 0.7, 0.9)),
]


class TestClosedForm:
    @pytest.mark.parametrize("ratio", [0.1, 0.5, 2.0])
    def test_cantilever_with_a_mass_at_its_tip(self, ratio):
        """1 + cos b cosh b + r b (cos b sinh b - sin b cosh b) = 0, r = M/(m L): Blevins, 1979."""

        def equation(b):
            across = math.cos(b) * math.sinh(b) - math.sin(b) * math.cosh(b)
            return 1 + math.cos(b) * math.cosh(b) + ratio * b * across

        beam = goland(lumps=[{"at": 1.0, "mass": ratio * MASS * LENGTH}])
        omega = 2 * np.pi * modes_of(beam).bending(1).frequency[0]
        exact = brentq(equation, 0.3, 1.9) ** 2 * math.sqrt(EI / MASS) / LENGTH**2
        assert omega == pytest.approx(exact, rel=1e-6)

    def test_spring_and_inertia_at_the_tip_in_torsion(self):
        """G J f'(L) + k f(L) = omega^2 I_p f(L): gamma cot(gamma) = q gamma^2 - kappa."""
        kappa, q = 1.7, 0.4
        beam = goland(
            supports=[{"at": 1.0, "twist_stiffness": kappa * GJ / LENGTH}],
            lumps=[{"at": 1.0, "mass": 1e-6, "inertia_about_centre": q * INERTIA * LENGTH}],
        )
        root = brentq(lambda g: g * math.cos(g) - (q * g * g - kappa) * math.sin(g), 0.5, 3.0)
        omega = 2 * np.pi * modes_of(beam).torsion(1).frequency[0]
        assert omega == pytest.approx(root * math.sqrt(GJ / INERTIA) / LENGTH, rel=1e-6)

    def test_supports_at_the_ends_are_the_boundary_of_that_name(self):
        ends = [{"at": at, "deflection": "fixed", "twist": "fixed"} for at in (0.0, 1.0)]
        listed = modes_of(goland(boundary="supports", supports=ends))
        named = modes_of(goland(boundary="pinned-pinned"))
        assert listed.frequency[:6] == pytest.approx(named.frequency[:6], rel=1e-8)

    def test_prop_in_the_middle_halves_the_span(self):
        """A pinned beam on a middle prop has the second frequency of the pinned beam as first."""
        prop = [{"at": 0.5, "deflection": "fixed"}]
        propped = modes_of(goland(boundary="pinned-pinned", supports=prop)).bending(1)
        free = modes_of(goland(boundary="pinned-pinned")).bending(2)
        assert propped.frequency[0] == pytest.approx(free.frequency[1], rel=1e-8)

    def test_stiffer_and_stiffer_springs_end_in_a_fixed_support(self):
        fixed = modes_of(goland(supports=[{"at": 0.7, "deflection": "fixed"}])).bending(1)
        errors = []
        for stiffness in (1e4, 1e5, 1e6):
            spring = [{"at": 0.7, "deflection_stiffness": stiffness * EI / LENGTH**3}]
            found = modes_of(goland(supports=spring)).bending(1).frequency[0]
            errors.append(1 - found / fixed.frequency[0])
        assert errors[0] > 0
        assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)
        assert errors[1] / errors[2] == pytest.approx(10, rel=0.1)

    def test_place_between_two_nodes_is_met_exactly(self):
        """1/3 is no node of 20 or 80 equal elements."""
        beam = goland(supports=[{"at": 1 / 3, "deflection": "fixed"}])
        coarse, fine = (modes_of(beam, 1, n).bending(1).frequency[0] for n in (20, 80))
        assert coarse == pytest.approx(fine, rel=2e-5)


class TestFlutter:
    def test_tip_store(self):
        found = matrices_of(tip_store())
        assert found.natural_frequencies[:3] == pytest.approx([27.113, 70.534, 181.11], rel=1e-4)
        onset = beam_flutter(found, CHORD, 0.33, AIR)
        assert (onset.speed, onset.omega) == pytest.approx((135.306, 40.006), rel=1e-3)

    def test_spring_in_the_span(self):
        found = matrices_of(sprung())
        assert found.natural_frequencies[:3] == pytest.approx([73.484, 105.848, 247.74], rel=1e-4)
        assert beam_flutter(found, CHORD, 0.33, AIR).speed == pytest.approx(98.492, rel=1e-3)

    def test_section_of_the_wing_with_a_store(self):
        section = reduce_beam(tip_store(), modes_of(tip_store()))
        found = (section.mass, section.inertia, section.static_imbalance)
        assert found == pytest.approx((110.07, 22.557, 27.801), rel=1e-4)

    @pytest.mark.parametrize("beam", [tip_store(), sprung()], ids=["store", "spring"])
    def test_section_has_the_coupled_frequencies_of_its_pair(self, beam):
        section = reduce_beam(beam, modes_of(beam))
        pair = matrices_of(beam).pair(1)
        assert section.natural_frequencies == pytest.approx(pair.natural_frequencies, rel=1e-6)

    @pytest.mark.parametrize(
        ("beam", "speed"), [(tip_store(), 134.017), (sprung(), 100.802)], ids=["store", "spring"]
    )
    def test_strips_flutter_where_jones_states_do(self, beam, speed):
        """Thin-plate strips without induction; speeds of the independent code with Jones' lag."""
        assert strip_growth(beam, 0.98 * speed) < 0 < strip_growth(beam, 1.02 * speed)
        onset = brentq(lambda v: strip_growth(beam, v), 0.98 * speed, 1.02 * speed, rtol=1e-5)
        assert onset == pytest.approx(speed, rel=2e-3)


def strip_growth(beam: Beam, speed: float, number: int = 4) -> float:
    modes = modes_of(beam, number)
    found = matrices_of(beam, number)
    bending, torsion = modes.bending(number), modes.torsion(number)
    ratio = 2 * math.pi * CHORD / speed
    strips = cosine_strips(40)
    half = 0.5 * AIR
    mass = found.mass.diagonal()
    own = found.likeness.diagonal() * np.repeat([MASS, INERTIA], number)
    lumps = mass - own
    across = -found.mass[number:, :number]
    plain = beam.imbalance_per_length * found.likeness[number:, :number]
    none = np.zeros((1, number, number))
    parameters = BeamParameters.from_modes(
        span=modes.span,
        torsion_shapes=torsion.shape,
        torsion_frequencies=ratio * torsion.frequency[None],
        inertia=np.array([INERTIA / (half * CHORD**4)]),
        bending_shapes=bending.shape,
        bending_frequencies=ratio * bending.frequency[None],
        mass=np.array([MASS / (half * CHORD**2)]),
        stations=strips.stations,
        weights=strips.weights,
        imbalance=np.array([beam.imbalance_per_length / (half * CHORD**3)]),
        axis=beam.elastic_axis - 0.5,
        fittings=Fittings(
            mass=lumps[None, :number] / (half * CHORD**2),
            inertia=lumps[None, number:] / (half * CHORD**4),
            imbalance=(across - plain)[None] / (half * CHORD**3),
            bending_dashpots=none,
            torsion_dashpots=none,
        ),
    )
    loads = UnsteadyLoads.from_polar(Polar.flat_plate(10.0), SeparationLags.none())
    system = beam_system(parameters, loads, 0.0)
    return float(least_stable_eigenvalue(system)[0].real)


class TestDashpots:
    @pytest.mark.parametrize(("projected", "found"), [(0.2, 0.2027), (0.5, 0.559)])
    def test_projection_against_the_full_beam(self, projected, found):
        """Damper at the tip: its exact damping ratio, which many modes of the beam converge to."""
        clean = modes_of(goland(), 1).torsion(1)
        omega = 2 * math.pi * clean.frequency[0]
        damper = projected * omega * INERTIA * LENGTH  # zeta = c f(1)^2/(2 omega I L/2)
        beam = goland(mass_axis=0.33, supports=[{"at": 1.0, "twist_damping": damper}])
        many = modal_matrices(beam, modes_of(beam, 12, 120), 1, 12)
        assert many.damping_ratios[1] == pytest.approx(projected, rel=1e-4)
        mass, damping, stiffness = (m[1:, 1:] for m in (many.mass, many.damping, many.stiffness))
        inverse = np.linalg.inv(mass)
        state = np.block(
            [[np.zeros((12, 12)), np.eye(12)], [-inverse @ stiffness, -inverse @ damping]]
        )
        values = np.linalg.eigvals(state)
        first = min(values[values.imag > 1], key=abs)
        assert -first.real / abs(first) == pytest.approx(found, rel=2e-2)

    def test_too_strong_a_dashpot_has_no_section(self):
        omega = 2 * math.pi * modes_of(goland(), 1).torsion(1).frequency[0]
        damper = 0.6 * omega * INERTIA * LENGTH
        beam = goland(supports=[{"at": 1.0, "twist_damping": damper}])
        with pytest.raises(ReductionError, match=r"damping ratio of 0\.600"):
            reduce(beam, method="beam")

    def test_dashpot_of_the_section_is_the_projected_one(self):
        beam = goland(supports=[{"at": 1.0, "deflection_damping": 50.0, "twist_damping": 20.0}])
        modes = modes_of(beam)
        section = reduce_beam(beam, modes)
        pair = modal_matrices(beam, modes, 1, 1)
        assert section.flexural_damping == pytest.approx(pair.damping[0, 0] / 0.25, rel=1e-6)
        assert section.torsional_damping == pytest.approx(pair.damping[1, 1] / 0.5, rel=1e-6)


class TestPairs:
    @pytest.mark.parametrize(
        ("boundary", "supports", "bending_mode", "likeness"),
        [
            ("clamped-free", [{"at": 1.0, "deflection": "fixed"}], 1, 0.89),
            ("pinned-pinned", [{"at": 0.5, "deflection": "fixed"}], 2, 0.74),
            ("one-fork", [{"at": n / 4, "deflection": "fixed"} for n in (1, 2, 3)], 4, 0.71),
            ("pinned-pinned", [{"at": n / 4, "deflection": "fixed"} for n in (1, 3)], None, 0.74),
            (
                "pinned-pinned",
                [{"at": n / 4, "deflection": "fixed", "twist": "fixed"} for n in (1, 3)],
                1,
                0.976,
            ),
        ],
    )
    def test_likeness(self, boundary, supports, bending_mode, likeness):
        beam = goland(boundary=boundary, supports=supports)
        modes = modes_of(beam, 6)
        found = flutter_bias(reduce_beam(beam, modes), beam, modes, AIR)
        assert found.likeness == pytest.approx(likeness, abs=6e-3)
        if bending_mode:
            assert found.bending_mode == bending_mode

    def test_motion_is_read_where_the_first_modes_are_largest(self):
        """Twist of a row held in the middle: at an end; deflection of a propped beam: inside."""
        tracker = modes_of(goland(boundary="supports", supports=TRACKER), 4)
        assert tracker.places[0] in {0.0, 1.0}
        propped = modes_of(goland(supports=[{"at": 1.0, "deflection": "fixed"}]), 2)
        assert propped.places[0] == pytest.approx(1.0)
        assert propped.places[1] == pytest.approx(0.58, abs=0.02)
        assert modes_of(goland(), 2).places == (1.0, 1.0)

    def test_unlike_shapes_have_no_section(self):
        beam = goland(boundary="pinned-pinned", supports=[{"at": 0.5, "deflection": "fixed"}])
        with pytest.raises(ReductionError, match="too unlike"):
            reduce(beam, method="beam")

    def test_twist_held_in_the_middle_alone_is_split_by_symmetry(self):
        """Each half turns alone: first both alike, then oppositely, at one frequency."""
        modes = modes_of(goland(boundary="supports", supports=TRACKER), 4).torsion(4)
        assert modes.frequency[0] == pytest.approx(modes.frequency[1], rel=1e-9)
        quarter = math.sqrt(GJ / INERTIA) / (4 * LENGTH / 2)
        assert modes.frequency[0] == pytest.approx(quarter, rel=1e-6)
        assert modes.shape[0] == pytest.approx(modes.shape[0, ::-1], abs=1e-6)
        assert modes.shape[1] == pytest.approx(-modes.shape[1, ::-1], abs=1e-6)
        assert modes.shape[0] == pytest.approx(
            np.abs(np.sin(math.pi * (modes.span - 0.5))), abs=1e-5
        )


class TestRefusals:
    @pytest.mark.parametrize(
        ("given", "said"),
        [
            ({"supports": [{"at": 1.2, "deflection": "fixed"}]}, "part of the span"),
            ({"supports": [{"at": 60, "deflection": "fixed"}]}, "part of the span"),
            ({"lumps": [{"at": -0.1, "mass": 1.0}]}, "part of the span"),
            ({"supports": [{"at": 0.5, "twist": "fixed"}] * 2}, "another place"),
            ({"supports": [{"at": 0.5}]}, "fixes, springs or damps"),
            ({"supports": [{"at": 0.0, "deflection": "fixed"}]}, "already"),
            (
                {"supports": [{"at": 0.5, "twist": "fixed", "twist_stiffness": 3.0}]},
                "does not move",
            ),
            ({"boundary": "supports"}, "two or more"),
            (
                {
                    "boundary": "supports",
                    "supports": [{"at": at, "deflection": "fixed"} for at in (0.2, 0.8)],
                },
                "holds the twist",
            ),
        ],
    )
    def test_of_the_beam(self, given, said):
        with pytest.raises(ValueError, match=said):
            goland(**given)

    @pytest.mark.parametrize("method", ["solid", "analytic"])
    def test_of_other_methods(self, method):
        with pytest.raises(ModesError, match="use method 'beam'"):
            compute_modes(sprung(), method, (4, 10, 1), 4)
