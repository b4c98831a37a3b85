"""The one Section: its numbers in a flow, what it refuses, and how it is written down."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from pydantic import ValidationError

from equisection.beam.section import MORE_THAN_SPRINGS, Section
from equisection.errors import EquisectionError, ReductionError

DENSITY, SPEED = 1.225, 80.0
#: Goland's wing, per metre.
WING = Section(
    mass=35.717,
    inertia=8.642,
    static_imbalance=6.532,
    flexural_stiffness=87486.0,
    torsional_stiffness=65574.0,
    flexural_damping=35.4,
    torsional_damping=15.1,
    chord=1.8288,
    elastic_axis=0.33,
    twist_recovery=0.785,
    deflection_recovery=0.639,
)
PLAIN = Section(mass=80.0, inertia=6.67, flexural_stiffness=3.9, torsional_stiffness=21.0)


def test_equations_of_motion_are_the_same_in_the_flow() -> None:
    """Forces over q c and moments over q c^2, of w in chords and time in c/V."""
    flow, chord = WING.in_flow(DENSITY, SPEED), WING.chord
    force = 0.5 * DENSITY * SPEED**2 * chord
    unit = np.diag([force, force * chord])  # of (lift, moment)
    motion = np.diag([chord, 1.0])  # of (w, theta)
    for name, rate in (("stiffness", 1.0), ("damping", SPEED / chord), ("mass", SPEED / chord)):
        power = 2 if name == "mass" else 1
        here, there = (getattr(section, f"{name}_matrix") for section in (WING, flow))
        np.testing.assert_allclose(here @ motion * rate**power, unit @ there, rtol=1e-12)
    assert flow.chord == 1.0
    assert (flow.elastic_axis, flow.twist_recovery, flow.deflection_recovery) == (
        0.33,
        0.785,
        0.639,
    )


def test_ratios_frequencies_and_damping_ratios_are_those_of_the_section_in_the_flow() -> None:
    flow = WING.in_flow(DENSITY, SPEED)
    assert flow.inertia_ratio == pytest.approx(WING.inertia_ratio, rel=1e-12)
    assert flow.stiffness_ratio == pytest.approx(WING.stiffness_ratio, rel=1e-12)
    np.testing.assert_allclose(
        flow.natural_frequencies * SPEED / WING.chord, WING.natural_frequencies, rtol=1e-12
    )
    for of in (flow, flow.scaled(0.3), flow.scaled(7.0)):
        ratio = of.torsional_damping / math.sqrt(of.torsional_stiffness * of.inertia)
        assert ratio == pytest.approx(15.1 / math.sqrt(65574.0 * 8.642), rel=1e-12)


def test_another_speed_is_another_stiffness() -> None:
    """In units of the flow half the speed is four times the stiffness, and the same masses."""
    slow, fast = (WING.in_flow(DENSITY, speed) for speed in (SPEED / 2, SPEED))
    for name in Section.model_fields:
        assert getattr(slow, name) == pytest.approx(getattr(fast.scaled(4.0), name), rel=1e-12)


def test_numbers_of_the_flow_are_those_of_eq_18() -> None:
    """Of the paper's plate, consistent: I* = 20/3 and m* = 80 in closed form."""
    mass, chord = 1180.0 * 0.1 * 0.004, 0.1
    plate = Section(
        mass=mass,
        inertia=mass * chord**2 / 12,
        flexural_stiffness=1150.0,
        torsional_stiffness=47.2,
        chord=chord,
    )
    assert plate.m_star(1.18) == pytest.approx(80.0)
    assert plate.i_star(1.18) == pytest.approx(20 / 3)
    assert plate.k_star(1.18, 20.0) == pytest.approx(20.0)
    assert plate.k_w_star(1.18, 20.0) == pytest.approx(1150.0 / 236.0)


def test_frequencies_without_imbalance_are_those_of_each_motion_alone() -> None:
    alone = [math.sqrt(3.9 / 80.0), math.sqrt(21.0 / 6.67)]
    np.testing.assert_allclose(PLAIN.natural_frequencies, alone, rtol=1e-12)


def test_imbalance_drives_the_frequencies_apart() -> None:
    """Products and sums of the squares: both roots of (1 - e) x^2 - (a + b) x + a b = 0."""
    a, b = 87486.0 / 35.717, 65574.0 / 8.642
    e = 6.532**2 / (35.717 * 8.642)
    squares = WING.natural_frequencies**2
    assert squares.prod() == pytest.approx(a * b / (1 - e), rel=1e-12)
    assert squares.sum() == pytest.approx((a + b) / (1 - e), rel=1e-12)
    assert squares[0] < min(a, b) < max(a, b) < squares[1]


def test_imbalance_forward_of_the_axis_has_the_same_frequencies() -> None:
    forward = Section(**{**dict(WING), "static_imbalance": -6.532})
    np.testing.assert_allclose(forward.natural_frequencies, WING.natural_frequencies, rtol=1e-12)


@pytest.mark.parametrize(
    ("member", "value", "allowed"),
    [
        ("mass", 0.0, "greater than 0"),
        ("inertia", -1.0, "greater than 0"),
        ("torsional_stiffness", math.nan, "finite number"),
        ("flexural_stiffness", math.inf, "finite number"),
        ("chord", 0.0, "greater than 0"),
        ("elastic_axis", 1.01, "less than or equal to 1"),
        ("elastic_axis", -0.17, "greater than or equal to 0"),
        ("torsional_damping", -0.1, "greater than or equal to 0"),
        ("flexural_damping", -0.1, "greater than or equal to 0"),
        ("static_imbalance", math.nan, "finite number"),
        ("axis", 0.3, "Extra inputs are not permitted"),
    ],
)
def test_what_no_section_has_is_refused_by_name(member: str, value: float, allowed: str) -> None:
    with pytest.raises(ValidationError, match=f"{member}\n.*{allowed}"):
        Section(**{**dict(WING), member: value})


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_imbalance_that_no_body_has_is_refused_with_the_largest(sign: float) -> None:
    largest = math.sqrt(35.717 * 8.642)
    Section(**{**dict(WING), "static_imbalance": sign * 0.999 * largest})
    with pytest.raises(ValidationError, match=r"static_imbalance is .* sqrt\(mass \* inertia\)"):
        Section(**{**dict(WING), "static_imbalance": sign * 1.001 * largest})


@pytest.mark.parametrize("factor", [0.0, -1.0, math.nan])
def test_no_stiffness_is_refused(factor: float) -> None:
    with pytest.raises(ReductionError, match="stiffness_scale is"):
        WING.scaled(factor)


def test_a_section_does_not_change() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        WING.mass = 1.0  # type: ignore[misc]


def test_only_what_differs_from_mass_and_springs_is_written_down() -> None:
    assert PLAIN.model_dump(mode="json") == {
        "torsional_stiffness": 21.0,
        "flexural_stiffness": 3.9,
        "inertia": 6.67,
        "mass": 80.0,
        "twist_recovery": 1.0,
        "deflection_recovery": 1.0,
    }
    assert WING.model_dump() == {name: getattr(WING, name) for name in WING.model_fields_set}
    for section in (PLAIN, WING):
        assert Section.model_validate(json.loads(section.model_dump_json())) == section


@pytest.mark.parametrize(
    ("member", "value"),
    [
        ("static_imbalance", 0.3),
        ("flexural_damping", 0.3),
        ("torsional_damping", 0.3),
        ("elastic_axis", 0.3),
    ],
)
def test_models_without_a_member_refuse_it_by_name(member: str, value: float) -> None:
    PLAIN.require_defaults("the strip model")
    assert member in MORE_THAN_SPRINGS
    section = Section(**{**dict(PLAIN), member: value})
    said = f"the strip model takes no section with {member} 0.3 .allowed is"
    for others in ((), set(MORE_THAN_SPRINGS) - {member}):
        with pytest.raises(EquisectionError, match=said):
            section.require_defaults("the strip model", but=others)
    section.require_defaults("the strip model", but=[member])


def test_si_units_are_refused_where_none_are_wanted() -> None:
    PLAIN.require_in_flow()
    with pytest.raises(EquisectionError, match=r"chord 1\.8288 m .* section\.in_flow\("):
        WING.require_in_flow()
