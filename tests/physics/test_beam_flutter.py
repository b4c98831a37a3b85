"""Flutter of beams on their modes, and the bias of their sections, by linear theory.

Numbers without another source are those of an independent finite-element and Theodorsen code.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.beam import Beam
from equisection.errors import ModesError, ReductionError
from equisection.motion.beam_flutter import FlutterOnset, beam_flutter, section_flutter
from equisection.motion.beams import BeamParameters, beam_system
from equisection.motion.steady_states import least_stable_eigenvalue
from equisection.reduction.beam_section import reduce
from equisection.reduction.flutter_bias import FlutterBias, flutter_bias, refusal
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import oscillation_factor, reduce_beam
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.mode_set import ModeSet
from equisection.structure.modes import modes_of_kinds

AIR = 1.225


def goland(
    *, damping: float = 0.0, boundary: str = "clamped-free", frequencies: float = 1.0, **axes: float
) -> Beam:
    """Goland's wing (J. Appl. Mech. 12, 1945), its inertia about the elastic axis.

    Between forks with rigidities that give it the first frequencies of the cantilever.
    """
    rigidities = {"bending_rigidity": 9.773e6, "torsional_rigidity": 9.876e5}
    if boundary == "pinned-pinned":
        length = 6.096 / math.pi
        rigidities = {
            "bending_rigidity": 35.717 * 49.4923**2 * length**4,
            "torsional_rigidity": 8.642 * 87.1081**2 * length**2,
        }
    rigidities["bending_rigidity"] *= frequencies
    return Beam(
        chord=1.8288,
        length=6.096,
        thickness=0.1,
        boundary=boundary,
        cross_section={"mass_per_length": 35.717, "inertia_per_length": 8.642, **rigidities},
        **{"elastic_axis": 0.33, "mass_axis": 0.43, **axes},
        damping={"bending": damping, "torsion": damping},
    )


def modes_of(beam: Beam, number: int = 8) -> ModeSet:
    return modes_of_kinds(beam, "analytic", (8, 60, 1), (number, number), 8)


def flutter_of(beam: Beam, number: int, density: float = AIR) -> FlutterOnset:
    matrices = modal_matrices(beam, modes_of(beam, number), number, number)
    return beam_flutter(matrices, beam.chord, beam.elastic_axis, density)


class TestModalMatrices:
    def test_frequencies_alone_are_those_of_the_uncoupled_beam(self):
        beam = goland()
        modes = modes_of(beam, 2)
        omega = (
            2 * math.pi * np.concatenate([modes.bending(2).frequency, modes.torsion(2).frequency])
        )
        np.testing.assert_allclose(omega, [49.4923, 310.163, 87.1081, 261.324], rtol=2e-6)

    def test_imbalance_couples_the_frequencies(self):
        matrices = modal_matrices(goland(), modes_of(goland()), 6, 6)
        known = [48.1554, 95.7193, 243.772, 347.61]
        np.testing.assert_allclose(matrices.natural_frequencies[:4], known, rtol=4e-5)

    def test_frequencies_in_still_air_are_the_published_ones(self):
        """46, 93, 233 and 337 rad/s: the first four of Goland's wing in still air.

        As the tutorial of ContourRoots on this wing has them; 45.996, 93.479, 233.33 and 337.30 of
        the independent code. Still air is the apparent mass alone.
        """
        beam, number = goland(), 8
        matrices = modal_matrices(beam, modes_of(beam, number), number, number)
        x = (beam.elastic_axis - 0.5) * beam.chord
        chord = beam.chord
        air = 0.25 * math.pi * AIR * chord**2 * np.array([[1.0, x], [x, chord**2 / 32 + x * x]])
        kinds = np.repeat([0, 1], number)
        mass = matrices.mass + air[np.ix_(kinds, kinds)] * matrices.likeness
        squares = np.linalg.eigvals(np.linalg.solve(mass, matrices.stiffness)).real
        omega = np.sqrt(np.sort(squares))[:4]
        np.testing.assert_allclose(omega, [45.996, 93.479, 233.33, 337.30], rtol=2e-4)

    def test_damping_ratios_are_those_of_the_modes_alone(self):
        beam = goland(damping=0.015, mass_axis=0.33)
        matrices = modal_matrices(beam, modes_of(beam, 2), 2, 2)
        critical = 2 * np.sqrt(np.diag(matrices.mass) * np.diag(matrices.stiffness))
        np.testing.assert_allclose(np.diag(matrices.damping), 0.015 * critical, rtol=1e-12)

    def test_inverse_from_measured_frequencies(self):
        """With e = S^2/(m I) the uncoupled squares are the roots of a quadratic of the coupled."""
        matrices = modal_matrices(goland(), modes_of(goland(), 1), 1, 1)
        one, two = matrices.natural_frequencies**2
        e = matrices.mass[0, 1] ** 2 / matrices.mass[0, 0] / matrices.mass[1, 1]
        assert e == pytest.approx(0.127030, rel=1e-5)
        alone = np.sqrt(np.sort(np.roots([1.0, -(1 - e) * (one + two), (1 - e) * one * two])))
        np.testing.assert_allclose(alone, [49.4923, 87.1081], rtol=2e-6)


class TestFlutterOfTheBeam:
    def test_goland_by_transfer_matrices(self):
        """136.984 m/s and 70.033 rad/s: ContourRoots, with its own rounding of the data."""
        onset = flutter_of(goland(), 8)
        assert onset.speed == pytest.approx(136.984, rel=2e-4)
        assert onset.omega == pytest.approx(70.033, rel=2e-4)

    @pytest.mark.parametrize(
        ("number", "density", "speed", "omega"),
        [
            (1, 1.225, 136.852, 69.985),
            (2, 1.225, 136.995, 70.026),
            (8, 1.225, 136.996, 70.027),
            (8, 1.02, 146.75, 69.70),
        ],
    )
    def test_goland_by_modes(self, number, density, speed, omega):
        onset = flutter_of(goland(), number, density)
        assert onset.speed == pytest.approx(speed, rel=3e-5)
        assert onset.omega == pytest.approx(omega, rel=3e-5)

    @pytest.mark.parametrize(
        ("ratio", "speed"), [(0.005, 138.414), (0.01, 139.819), (0.02, 142.624)]
    )
    def test_goland_with_viscous_damping(self, ratio, speed):
        assert flutter_of(goland(damping=ratio), 4).speed == pytest.approx(speed, rel=1e-5)

    def test_pairs_of_a_pinned_beam_are_sections_of_their_own(self):
        """The second flutters first, and the whole beam with it."""
        beam = goland(boundary="pinned-pinned")
        matrices = modal_matrices(beam, modes_of(beam, 6), 6, 6)

        def onset(of):
            return beam_flutter(of, beam.chord, beam.elastic_axis, AIR)

        assert onset(matrices.pair(1)).speed == pytest.approx(132.567, rel=1e-4)
        for second in (matrices.pair(2), matrices):
            assert onset(second).speed == pytest.approx(120.575, rel=1e-4)
            assert onset(second).omega == pytest.approx(227.264, rel=1e-4)


def embedded_flutter(beam: Beam, number: int, speeds: tuple[float, float]) -> float:
    """Speed (m/s) at which the least stable motion on the strips of the embedded solver grows."""
    modes, chord = modes_of(beam, number), beam.chord
    strips = cosine_strips(40)
    loads = UnsteadyLoads.from_polar(Polar.flat_plate(10.0), SeparationLags.none())

    def growth(speed: float) -> float:
        to_reduced = 2 * math.pi * chord / speed
        parameters = BeamParameters.from_modes(
            span=modes.span,
            torsion_shapes=modes.torsion(number).shape,
            torsion_frequencies=to_reduced * modes.torsion(number).frequency[None],
            inertia=np.array([beam.inertia_per_length / (0.5 * AIR * chord**4)]),
            bending_shapes=modes.bending(number).shape,
            bending_frequencies=to_reduced * modes.bending(number).frequency[None],
            mass=np.array([beam.mass_per_length / (0.5 * AIR * chord**2)]),
            stations=strips.stations,
            weights=strips.weights,
            imbalance=np.array([beam.imbalance_per_length / (0.5 * AIR * chord**3)]),
            damping_ratios=(beam.damping.bending, beam.damping.torsion),
            axis=beam.elastic_axis - 0.5,
        )
        return float(least_stable_eigenvalue(beam_system(parameters, loads, 0.0))[0].real)

    return float(brentq(growth, *speeds, xtol=1e-4))


class TestEmbeddedBeam:
    def test_goland_with_the_states_of_jones(self):
        """137.379 m/s with Jones in the place of C(k), 136.996 exact, both with 8 + 8 modes."""
        assert embedded_flutter(goland(), 4, (120.0, 150.0)) == pytest.approx(137.379, rel=2e-3)

    def test_pinned_beam_flutters_by_its_second_pair(self):
        beam = goland(boundary="pinned-pinned")
        found = embedded_flutter(beam, 3, (110.0, 128.0))
        assert found == pytest.approx(120.575, rel=0.01)

    def test_damping_raises_the_speed(self):
        """139.819 m/s at 1 % with C(k) exact; from one to the other Jones' states add 0.2 %."""
        damped = embedded_flutter(goland(damping=0.01), 4, (120.0, 150.0))
        assert damped == pytest.approx(139.819, rel=4e-3)
        assert damped > embedded_flutter(goland(), 4, (120.0, 150.0)) + 2.0


class TestSection:
    def test_consistent_section_of_goland(self):
        section = reduce_beam(goland(), modes_of(goland(), 1), "consistent")
        assert section.static_imbalance == pytest.approx(0.958641 * goland().imbalance_per_length)
        assert section.elastic_axis == 0.33
        onset = section_flutter(section, AIR)
        assert onset.speed == pytest.approx(133.297, rel=1e-5)
        assert onset.omega == pytest.approx(71.019, rel=1e-5)

    def test_paper_section_of_goland(self):
        section = reduce_beam(goland(), modes_of(goland(), 1), "paper")
        assert section.mass == pytest.approx(0.73761 * 35.717, rel=1e-5)
        assert section.static_imbalance == pytest.approx(
            0.82332 * goland().imbalance_per_length, rel=1e-5
        )
        assert section_flutter(section, AIR).speed == pytest.approx(124.425, rel=1e-5)

    @pytest.mark.parametrize("reduction", ["consistent", "paper"])
    @pytest.mark.parametrize("mass_axis", [0.25, 0.43, 0.5])
    def test_coupled_frequencies_are_those_of_the_first_pair(self, reduction, mass_axis):
        beam = goland(mass_axis=mass_axis)
        pair = modal_matrices(beam, modes_of(beam, 1), 1, 1)
        section = reduce_beam(beam, modes_of(beam, 1), reduction)
        np.testing.assert_allclose(section.natural_frequencies, pair.natural_frequencies, rtol=1e-6)

    @pytest.mark.parametrize("reduction", ["consistent", "paper"])
    def test_damping_ratios_are_those_of_the_beam(self, reduction):
        section = reduce_beam(goland(damping=0.02), modes_of(goland(), 1), reduction)
        critical = 2 * math.sqrt(section.torsional_stiffness * section.inertia)
        assert section.torsional_damping == pytest.approx(0.02 * critical)
        critical = 2 * math.sqrt(section.flexural_stiffness * section.mass)
        assert section.flexural_damping == pytest.approx(0.02 * critical)

    def test_plate_without_axes_or_damping_has_a_section_without_them(self):
        beam = Beam()
        assert not set(reduce_beam(beam, modes_of(beam, 1)).model_dump()) & {
            "static_imbalance",
            "elastic_axis",
            "torsional_damping",
            "flexural_damping",
        }


def bias_of(beam: Beam, reduction: str = "consistent") -> FlutterBias:
    modes = modes_of(beam, 3)
    return flutter_bias(reduce_beam(beam, modes, reduction), beam, modes, AIR)


def deflection_over_twist(
    mass, stiffness, likeness, onset: FlutterOnset, beam: Beam | None = None
) -> float:
    """|w/theta| (chords per rad) of a bending and a torsion mode at flutter, from the row of w."""
    beam = goland() if beam is None else beam
    chord = beam.chord
    pressure = 0.5 * AIR * onset.speed**2
    units = pressure * np.array([1.0, chord])
    air = ThinAirfoil(beam.elastic_axis - 0.5).influence(onset.omega * chord / onset.speed)
    row = (stiffness[0] - onset.omega**2 * mass[0]) / units - air[0] * likeness[0]
    return abs(row[1] / row[0])


def test_ratio_of_an_oscillating_tip():
    """Goland's wing at flutter: 0.484 for its tip; the section's 0.321 times sqrt(2) is 0.454.

    With a/b, the ratio of a static load, it would be 0.395.
    """
    beam = goland()
    section = reduce_beam(beam, modes_of(beam), "consistent")
    ratio = span_integrals(beam, modes_of(beam), 1).oscillation_ratio
    assert ratio == pytest.approx(math.sqrt(2.0), rel=1e-4)
    raw = deflection_over_twist(
        section.mass_matrix,
        section.stiffness_matrix,
        np.ones((2, 2)),
        section_flutter(section, AIR),
    )
    pair = modal_matrices(beam, modes_of(beam), 1, 1)
    exact = deflection_over_twist(
        pair.mass, pair.stiffness, pair.likeness, beam_flutter(pair, beam.chord, 0.33, AIR)
    )
    assert raw == pytest.approx(0.321, abs=1e-3)
    assert exact == pytest.approx(0.482, abs=2e-3)  # 0.484 with all modes
    assert raw * ratio == pytest.approx(0.4545, abs=1e-3)
    static = section.twist_recovery / section.deflection_recovery
    assert raw * static == pytest.approx(0.395, abs=1e-3)


@pytest.mark.parametrize(("reduction", "bound"), [("consistent", 0.08), ("paper", 0.3)])
@pytest.mark.parametrize("beam", [goland(), Beam()], ids=["Goland", "plate"])
def test_oscillating_tip_of_a_section_is_nearer_to_its_beams(beam, reduction, bound):
    """At flutter the factor brings W/Theta nearer to that of the beam's first pair of modes."""
    modes = modes_of(beam)
    section, pair = reduce_beam(beam, modes, reduction), modal_matrices(beam, modes, 1, 1)
    by_means = (
        deflection_over_twist(
            section.mass_matrix,
            section.stiffness_matrix,
            np.ones((2, 2)),
            section_flutter(section, AIR),
            beam,
        )
        * section.twist_recovery
        / section.deflection_recovery
    )
    exact = deflection_over_twist(
        pair.mass,
        pair.stiffness,
        pair.likeness,
        beam_flutter(pair, beam.chord, beam.elastic_axis, AIR),
        beam,
    )
    factor = oscillation_factor(section, span_integrals(beam, modes, 1), reduction)
    assert abs(by_means * factor / exact - 1) < bound
    assert abs(by_means * factor / exact - 1) < 0.75 * abs(by_means / exact - 1)


def test_where_twist_and_deflection_have_one_shape_all_recover_alike():
    """Pinned: f = g, so that means and oscillations have one ratio, and both reductions too."""
    beam = goland(boundary="pinned-pinned")
    integrals = span_integrals(beam, modes_of(beam), 1)
    for reduction in ("consistent", "paper"):
        section = reduce_beam(beam, modes_of(beam), reduction)
        assert oscillation_factor(section, integrals, reduction) == pytest.approx(1.0, abs=1e-6)


class TestBias:
    @pytest.mark.parametrize(
        ("ratio", "bias"), [(0.3, -0.021), (0.568, -0.026), (0.8, -0.049), (0.9, -0.077)]
    )
    def test_section_flutters_the_earlier_the_closer_the_frequencies(self, ratio, bias):
        stiffer = (ratio / (49.4923 / 87.1081)) ** 2
        assert bias_of(goland(frequencies=stiffer)).bias == pytest.approx(bias, abs=6e-4)

    def test_paper_section_is_worse_and_a_warning_says_so(self):
        found = bias_of(goland(), "paper")
        assert found.bias == pytest.approx(124.425 / 136.852 - 1, abs=1e-4)
        (warning,) = found.warnings("paper")
        assert "the section of the paper reduction flutters at 124.4 m/s" in warning
        assert "(-9.1 %)" in warning
        assert not bias_of(goland()).warnings("consistent")

    @pytest.mark.parametrize(
        ("boundary", "bias"),
        [("clamped-clamped", -0.009), ("clamped-pinned", -0.017), ("one-fork", -0.095)],
    )
    def test_other_ends_with_the_same_frequencies(self, boundary, bias):
        """Against the beam with all of its modes."""
        first = modes_of(goland(boundary=boundary), 1)
        cantilever = modes_of(goland(), 1)
        scale = {
            kind: (getattr(cantilever, kind)(1).frequency / getattr(first, kind)(1).frequency) ** 2
            for kind in ("bending", "torsion")
        }
        beam = goland(boundary=boundary)
        section = beam.cross_section.model_copy(
            update={
                "bending_rigidity": 9.773e6 * float(scale["bending"][0]),
                "torsional_rigidity": 9.876e5 * float(scale["torsion"][0]),
            }
        )
        found = bias_of(Beam(**{**dict(beam), "cross_section": section}))
        assert found.section.speed / found.beam.speed - 1 == pytest.approx(bias, abs=6e-4)

    def test_pair_that_flutters_before_the_first_is_named(self):
        found = bias_of(goland(boundary="pinned-pinned"))
        assert found.bias == pytest.approx(0.0, abs=1e-6)
        assert found.critical_pair == 2
        (warning,) = found.warnings("consistent")
        assert "flutters at 120.6 m/s, by pair 2, before the 132.6 m/s" in warning

    def test_section_that_is_too_far_off_is_refused(self):
        assert not refusal(-0.149, "consistent")
        assert not refusal(math.nan, "consistent")
        assert "at 0.83 times the speed" in refusal(-0.17, "consistent")
        assert "allowed is 0.85 to 1.15" in refusal(0.2, "paper")

    def test_reduce_warns_and_refuses(self):
        reduce(goland(), method="analytic")
        with pytest.warns(UserWarning, match=r"flutters at 124\.4 m/s"):
            reduce(goland(), reduction="paper", method="analytic")
        close = goland(boundary="one-fork", frequencies=0.55)
        assert abs(bias_of(close).bias) > 0.15
        with pytest.raises(ReductionError, match="their shapes are too unlike for a section"):
            reduce(close, method="analytic")

    def test_solid_has_no_axes_elsewhere(self):
        with pytest.raises(ModesError, match=r"elastic axis at 30 % and centre of mass at 50 %"):
            reduce(Beam(elastic_axis=0.3))
