"""The beam: properties of its section, what it refuses, and how it is read from a file."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pydantic import ValidationError
from tests.sample_cases import PAPER, altered, beam_with

from equisection.beam.beam import BOUNDARIES, Beam, CrossSection, torsion_series_factor
from equisection.config import Config, load_config
from equisection.errors import ConfigError

DECK = {
    "bending_rigidity": 6.41e14,
    "torsional_rigidity": 2.014e12,
    "mass_per_length": 22740.0,
    "inertia_per_length": 2.47e6,
}


def test_section_properties_of_the_papers_plate():
    assert PAPER.bending_rigidity == pytest.approx(3.3e9 * 0.1 * 0.004**3 / 12)
    assert PAPER.torsional_rigidity == pytest.approx(3.3e9 / 2.7 * 0.1 * 0.004**3 / 3)
    assert PAPER.mass_per_length == pytest.approx(0.472)
    ratio = PAPER.chord**2 * PAPER.mass_per_length / PAPER.inertia_per_length
    assert ratio == pytest.approx(12.0)


def test_thick_rectangle_is_warned_of_with_what_a_thin_strip_has_too_much() -> None:
    """Saint-Venant's J of a 5 : 1 rectangle is 0.291 b^3 a (Timoshenko, Goodier, art. 109)."""
    thick = altered(PAPER, thickness=0.02)
    (warning,) = thick.warnings
    too_large, too_small = (float(number) for number in re.findall(r"([\d.]+) % too", warning))
    assert too_large == pytest.approx(100 * ((1 / 3) / 0.291 - 1), abs=0.2)
    assert too_small == pytest.approx(100 * (1 - 1 / 1.04), abs=0.05)
    assert not PAPER.warnings


@pytest.mark.parametrize(
    ("aspect", "k_1"),
    [(1.0, 0.1406), (2.0, 0.229), (5.0, 0.291), (10.0, 0.312)],
)
def test_exact_torsion_constant_matches_timoshenko_and_goodier(aspect, k_1):
    # Theory of Elasticity, table in art. 109: J = k_1 a b^3 for a bar a by b.
    assert torsion_series_factor(1 / aspect) / 3.0 == pytest.approx(k_1, abs=6e-4)


def test_thin_strip_limit_of_the_torsion_constant():
    assert torsion_series_factor(1e-5) == pytest.approx(1.0, abs=1e-5)
    assert torsion_series_factor(0.04) == pytest.approx(1.0 - 0.63 * 0.04, abs=1e-3)


def test_section_as_given_takes_the_place_of_the_rectangle():
    deck = altered(PAPER, thickness=0.02, cross_section=CrossSection(**DECK))
    assert {name: getattr(deck, name) for name in DECK} == DECK
    assert not deck.warnings


def test_ends_of_each_boundary():
    assert len(BOUNDARIES) == 6
    held = {boundary: beam_with(boundary) for boundary in BOUNDARIES}
    assert held["spring-root"].bending_ends == ("spring", "free")
    assert held["spring-root"].torsion_ends == ("spring", "free")
    assert held["pinned-pinned"].torsion_ends == ("fixed", "fixed")
    assert held["one-fork"].torsion_ends == ("fixed", "free")
    assert held["one-fork"].bending_ends == ("pinned", "pinned")


#: Changes of the paper's plate that no beam can have, and what the refusal says.
IMPOSSIBLE = [
    ({"chord": -0.1}, r"chord\n.*greater than 0"),
    ({"density": float("nan")}, r"density\n.*finite"),
    ({"poisson_ratio": 0.5}, r"poisson_ratio\n.*less than 0\.5"),
    ({"boundary": "glued"}, r"boundary\n.*'spring-root' or 'supports'"),
    ({"lenght": 1.0}, r"lenght\n.*not permitted"),
    ({"thickness": 0.05}, r"beam\.thickness: 0\.05: allowed is .* below half the chord, 0\.05 m"),
    ({"length": 0.1}, r"beam\.length: 0\.1: allowed is a number above the chord"),
    ({"boundary": "spring-root"}, r"beam\.root_torsional_stiffness: null: allowed is a number"),
    ({"boundary": "spring-root"}, r"beam\.root_bending_stiffness: null: allowed is a number"),
    ({"root_bending_stiffness": 3.0}, r"beam\.root_bending_stiffness: 3: allowed is null with"),
    ({"root_torsional_stiffness": 0.0}, r"root_torsional_stiffness\n.*greater than 0"),
    ({"cross_section": {**DECK, "mass_per_length": 0}}, r"mass_per_length\n.*greater than 0"),
    ({"cross_section": {"mass_per_length": 1}}, r"bending_rigidity\n.*required"),
]


@pytest.mark.parametrize(("change", "said"), IMPOSSIBLE)
def test_an_impossible_beam_is_refused_by_key_and_by_what_is_allowed(change, said):
    with pytest.raises(ValidationError, match=said):
        Beam(**change)
    with pytest.raises(ConfigError):  # and so it is in a configuration
        load_config({"beam": change, "structure": {"method": "beam"}})
    with pytest.raises(ValidationError):
        Config(beam=change)


def test_beam_does_not_change():
    with pytest.raises(ValidationError, match="frozen"):
        PAPER.chord = 0.2


class TestFromYaml:
    @pytest.fixture
    def file(self, tmp_path: Path) -> Path:
        return tmp_path / "my-beam.yaml"

    def test_what_the_file_leaves_out_is_at_its_default(self, file):
        """As in the workflow: text that YAML 1.1 makes of 3.3e9 is a number."""
        file.write_text("run: mine\nbeam: {chord: 0.2, length: 2.0, youngs_modulus: 7e10}\n")
        found = Beam.from_yaml(file)
        assert found == Beam(chord=0.2, length=2.0, youngs_modulus=7e10)
        assert found == Beam.from_yaml(str(file))
        assert found.density == 1180.0

    @pytest.mark.parametrize(
        "example", sorted((Path(__file__).parents[2] / "config/examples").glob("*.yaml")), ids=str
    )
    def test_examples_that_have_a_beam(self, example):
        if "\nbeam:" in example.read_text(encoding="utf-8"):
            assert isinstance(Beam.from_yaml(example), Beam)
        else:
            with pytest.raises(ConfigError, match="has no section 'beam'"):
                Beam.from_yaml(example)

    @pytest.mark.parametrize(
        ("text", "said"),
        [
            (b"", r"holds nothing; allowed is a file of sections"),
            (b"- 1\n", r"holds a list; allowed is a file of sections"),
            (b"run: mine\nflow: {}\n", r"has no section 'beam' \(there is run, flow\)"),
            (b"{}\n", r"has no section 'beam' \(there is nothing\)"),
            (b"beam:\n", r"beam: null: input should be a valid dictionary"),
            (b"beam: [\n", r"line 2, column 1: is no YAML"),
            (b"beam: {name: \xff}\n", r"line 1, column 14: the byte 0xff is not UTF-8"),
            (b"beam: {chord: 0.1, chord: 0.2}\n", r"beam\.chord: stands twice"),
            (
                b"beam: {lenght: 1}\n",
                r"beam\.lenght: 1: unknown key; allowed here are chord, length",
            ),
            (b"beam: {chord: wide}\n", r"beam\.chord: 'wide': not a plain decimal number"),
            (b"beam: {chord: true}\n", r"beam\.chord: true: not a number"),
            (b"beam: {chord: -1}\n", r"beam\.chord: -1: input should be greater than 0"),
            (b"beam: {thickness: 0.05}\n", r"beam\.thickness: 0\.05: allowed is a number above 0"),
            (
                b"beam: {cross_section: {mass_per_length: 1}}\n",
                r"beam\.cross_section\.bending_rigidity: missing",
            ),
        ],
    )
    def test_what_is_wrong_is_said_with_the_file(self, file, text, said):
        file.write_bytes(text)
        with pytest.raises(ConfigError, match=said) as refused:
            Beam.from_yaml(file)
        assert str(file) in str(refused.value)
        assert "Traceback" not in str(refused.value)

    def test_each_problem_has_its_line(self, file):
        file.write_text("beam: {chord: -1, length: x, colour: red}\n")
        with pytest.raises(ConfigError) as refused:
            Beam.from_yaml(file)
        lines = str(refused.value).split("\n")
        assert [line.split(": ")[1] for line in lines] == [
            "beam.chord",
            "beam.length",
            "beam.colour",
        ]

    def test_missing_file(self, file):
        with pytest.raises(ConfigError, match=r"my-beam\.yaml: no such file"):
            Beam.from_yaml(file)


def test_inertia_of_a_plate_on_an_axis_elsewhere_is_moved_there():
    """Steiner: rho_s c^3 h/12 + m d^2, and S = m d."""
    on_axis = Beam(elastic_axis=0.3)
    distance = 0.2 * on_axis.chord
    assert on_axis.axes_apart == pytest.approx(distance)
    assert on_axis.imbalance_per_length == pytest.approx(0.472 * distance)
    assert on_axis.inertia_per_length == pytest.approx(
        PAPER.inertia_per_length + 0.472 * distance**2
    )
    assert on_axis.axes_in_words == ("elastic axis at 30 % and centre of mass at 50 % of the chord")
    assert PAPER.imbalance_per_length == 0.0


def test_inertia_as_given_is_that_about_the_elastic_axis():
    section = {**DECK, "inertia_per_length": 2.47e6}
    deck = Beam(
        chord=31.0,
        length=1624.0,
        thickness=4.0,
        cross_section=section,
        elastic_axis=0.45,
        mass_axis=0.5,
    )
    assert deck.inertia_per_length == 2.47e6
    assert deck.imbalance_per_length == pytest.approx(22740.0 * 0.05 * 31.0)
    with pytest.raises(ValueError, match=r"inertia_per_length: .* above m d2 = "):
        Beam(**{**dict(deck), "mass_axis": 0.9})
