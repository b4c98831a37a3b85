"""The plate's section properties and the messages for what it cannot be."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from tests.sample_cases import PAPER

from equisection.errors import ConfigError
from equisection.structure.plate import BOUNDARIES


def test_section_properties_of_the_papers_plate():
    assert PAPER.bending_rigidity == pytest.approx(3.3e9 * 0.1 * 0.004**3 / 12)
    assert PAPER.torsional_rigidity == pytest.approx(3.3e9 / 2.7 * 0.1 * 0.004**3 / 3)
    assert PAPER.mass_per_length == pytest.approx(0.472)
    ratio = PAPER.chord**2 * PAPER.mass_per_length / PAPER.inertia_per_length
    assert ratio == pytest.approx(12.0)


def test_thick_rectangle_is_warned_of_with_what_a_thin_strip_has_too_much() -> None:
    """Saint-Venant's J of a 5 : 1 rectangle is 0.291 b^3 a (Timoshenko, Goodier, art. 109)."""
    thick = replace(PAPER, thickness=0.02)
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
    plate = replace(PAPER, chord=aspect * PAPER.thickness)
    assert plate.torsion_series_factor / 3.0 == pytest.approx(k_1, abs=6e-4)


def test_thin_strip_limit_of_the_torsion_constant():
    thin = replace(PAPER, thickness=1e-6)
    assert thin.torsion_series_factor == pytest.approx(1.0, abs=1e-5)
    assert PAPER.torsion_series_factor == pytest.approx(1.0 - 0.63 * 0.04, abs=1e-3)


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"chord": -0.1}, "plate.chord"),
        ({"density": float("nan")}, "plate.density"),
        ({"poisson_ratio": 0.5}, "plate.poisson_ratio"),
        ({"boundary": "glued"}, "plate.boundary"),
        ({"boundary": "spring-root"}, "root_torsional_stiffness"),
        ({"root_bending_stiffness": 3.0}, "spring-root"),
        ({"boundary": "spring-root", "root_torsional_stiffness": -1.0}, "zero or more"),
    ],
)
def test_an_impossible_plate_is_refused_by_name(change, key):
    with pytest.raises(ConfigError, match=key):
        replace(PAPER, **change)


def test_a_root_spring_that_is_left_out_is_rigid():
    plate = replace(PAPER, boundary="spring-root", root_torsional_stiffness=5.0)
    assert plate.bending_ends == ("clamped", "free")
    assert plate.torsion_ends == ("spring", "free")
    assert len(BOUNDARIES) == 6
