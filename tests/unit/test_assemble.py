"""What is put into a case."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq
from tests.sample_cases import STEADY

from equisection.aerodynamics.polar import Polar
from equisection.cases import UnsteadyCase, case_hash
from equisection.config import Config, load_config
from equisection.reduction.correction import CorrectionFactors
from equisection.reduction.flutter_bias import flutter_bias
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import REDUCTIONS, reduce_beam
from equisection.results.correction_dataset import factors_from_dataset, factors_to_dataset
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.section_dataset import (
    equivalent_to_dataset,
    nominal_k_star,
    section_from_dataset,
    section_in_flow,
    with_flutter,
)
from equisection.solvers.openfoam.flow_setup import reynolds_number
from equisection.solvers.openfoam.mesh.outline_mesh import require_mesher
from equisection.solvers.registry import solver_from_config
from equisection.structure.mode_set import frequency_constants
from equisection.structure.modes import compute_modes, modes_of_kinds
from equisection.study import plan
from equisection.study.assemble import case_at, k_star_as_given, steady_case, unsteady_case
from equisection.study.axes import INCIDENCE, K_STAR, SPEED, Axis, Point

RAW: dict[str, Any] = {
    "structure": {"bending_modes": 2, "torsion_modes": 2},
    "embedded": {"polars": {"thin": "flat-plate"}, "strips": 8},
    "steady": {"resolution": "thin"},
}


@pytest.fixture(scope="module")
def config() -> Config:
    return load_config(RAW)


@pytest.fixture(scope="module")
def data(config: Config) -> dict[str, xr.Dataset]:
    """Modes, equivalent section and a correction by one half, of the paper's plate."""
    modes = compute_modes(config.beam, "beam", (4, 15, 1), count=8)
    polar = solver_from_config(config, "thin")._polar  # type: ignore[attr-defined]
    half = type(polar)(
        polar.incidence, 0.5 * polar.drag, 0.5 * polar.lift, 0.5 * polar.moment, "half"
    )
    flow = config.flow
    return {
        "modes": modes_to_dataset(modes, list(frequency_constants(modes, config.beam))),
        "equivalent": equivalent_to_dataset(
            {reduction: reduce_beam(config.beam, modes, reduction) for reduction in REDUCTIONS},
            span_integrals(config.beam, modes, 2),
            (),
            density=flow.density,
            speed=flow.speed,
        ),
        "correction": factors_to_dataset(CorrectionFactors(polar, half)),
    }


def case(
    name: str, k_star: float, data: dict[str, xr.Dataset], config: Config | None = None
) -> UnsteadyCase:
    config = config or load_config(RAW)
    solver = solver_from_config(config, "thin")
    return unsteady_case(config, plan.model(name, config.reduction), k_star, data, solver)


@pytest.mark.parametrize("name", ["2d", "2d-corrected"])
def test_section_starts_from_the_equilibrium_of_the_steady_polar(
    data: dict[str, xr.Dataset], name: str
) -> None:
    """The springs carry the polar's loads there; below the fold of a thin plate nothing does."""
    start = {"state": "equilibrium", "twist_deg": 0.3}
    flow_solver = {
        "solver": "openfoam",
        "sweep": {"models": [name]},
        "steady": {"resolution": "coarse"},
        "unsteady": {"time_step": 0.02, "start": start},
    }
    config = load_config({**RAW, **flow_solver})
    assert plan.starts_by_polar(config)
    angles = np.arange(0.0, 31.0, 2.5)
    thin = Polar.flat_plate(math.radians(30.0))
    lift, moment = (
        getattr(thin, f"{load}_coefficient")(np.radians(angles)) for load in ("lift", "moment")
    )
    row = ("resolution", "incidence_deg")
    polar = xr.Dataset(
        {
            "cd": (row, 0.01 * np.ones((1, angles.size))),
            "cl": (row, lift[None]),
            "cm": (row, moment[None]),
        },
        {"resolution": ["coarse"], "incidence_deg": angles},
        {"solver_coarse": "a thin plate"},
    )
    solver = solver_from_config(config, "coarse")
    known = {**data, "polar_2d": polar}

    def case_of(k_star: float) -> UnsteadyCase:
        return unsteady_case(config, plan.model(name, config.reduction), k_star, known, solver)

    found = case_of(6.0)
    section, equilibrium = found.section, found.start.equilibrium
    assert section is not None
    assert equilibrium is not None
    alpha = math.radians(2.5) + equilibrium[0]
    assert section.torsional_stiffness * equilibrium[0] == pytest.approx(
        float(thin.moment_coefficient(alpha)), rel=1e-4
    )
    assert section.flexural_stiffness * equilibrium[1] == pytest.approx(
        float(thin.lift_coefficient(alpha)), rel=1e-4
    )
    push = math.radians(0.3) * section.twist_recovery
    assert found.section_start_twist == pytest.approx(equilibrium[0] + push)
    assert case_of(0.5).start.equilibrium is None
    # on a mesh of its own it starts from the same equilibrium
    unsteady = {**flow_solver["unsteady"], "resolution": "fine"}
    finer = load_config({**RAW, **flow_solver, "unsteady": unsteady})
    on_fine = unsteady_case(
        finer,
        plan.model(name, finer.reduction),
        6.0,
        known,
        solver_from_config(finer, finer.run_resolution),
    )
    assert (on_fine.resolution, on_fine.solver.settings["mesh"]) == ("fine", "fine")
    assert on_fine.start == found.start
    rigid = load_config({**RAW, **flow_solver, "unsteady": {"time_step": 0.02}})
    released = unsteady_case(
        rigid, plan.model(name, rigid.reduction), 6.0, known, solver_from_config(rigid, "coarse")
    )
    assert released.start.equilibrium is None
    assert "equilibrium" not in released.model_dump_json()


def test_beam_starts_from_the_equilibrium_of_the_polars_along_its_span(
    data: dict[str, xr.Dataset],
) -> None:
    """A number for each of its modes, the twist first; below the fold of the plate none."""
    start = {"state": "equilibrium", "twist_deg": 0.3}
    flow_solver = {
        "solver": "openfoam",
        "sweep": {"models": ["3d"]},
        "steady": {"resolution": "coarse"},
        "unsteady": {"time_step": 0.02, "start": start},
    }
    config = load_config({**RAW, **flow_solver})
    assert plan.starts_by_polar(config)
    angles, span = np.arange(0.0, 31.0, 2.5), np.linspace(0.02, 0.98, 20)
    slope, row = math.pi * np.radians(angles), ("resolution", "incidence_deg")
    along = np.ones((1, 1, span.size))
    polar = xr.Dataset(
        {
            "cd": (row, 0.01 * np.ones((1, angles.size))),
            "cl": (row, 2.0 * slope[None]),
            "cl_section": ((*row, "span"), 2.0 * slope[None, :, None] * along),
            "cm_section": ((*row, "span"), 0.5 * slope[None, :, None] * along),
        },
        {"resolution": ["coarse"], "incidence_deg": angles, "span": span},
        {"solver_coarse": "a thin plate"},
    )
    solver, known = solver_from_config(config, "coarse"), {**data, "polar_3d": polar}

    def case_of(k_star: float) -> UnsteadyCase:
        return unsteady_case(config, plan.model("3d", config.reduction), k_star, known, solver)

    position = case_of(6.0).start.equilibrium
    assert position is not None
    assert len(position) == 4
    assert 0.3 < math.degrees(position[0]) < 1.5
    assert position[2] > 0.0
    assert case_of(0.5).start.equilibrium is None
    moved = case_of(6.0).model_dump()
    moved["start"]["equilibrium"] = (0.0, 0.0)
    with pytest.raises(ValueError, match=r"start\.equilibrium has 2 numbers; wanted are 4"):
        UnsteadyCase(**moved)


@pytest.mark.parametrize("k_star", [2.0, 6.44, 21.0])
def test_section_of_the_paper_has_the_k_star_of_its_case(
    k_star: float, data: dict[str, xr.Dataset]
) -> None:
    section = case("2d-paper", k_star, data).section
    assert section is not None
    assert section.torsional_stiffness == pytest.approx(k_star, rel=1e-12)


@pytest.mark.parametrize("name", ["2d", "2d-paper"])
def test_stiffness_alone_grows_with_k_star(name: str, data: dict[str, xr.Dataset]) -> None:
    soft, stiff = case(name, 5.0, data).section, case(name, 10.0, data).section
    assert soft is not None
    assert stiff is not None
    assert stiff.torsional_stiffness == pytest.approx(2 * soft.torsional_stiffness, rel=1e-12)
    assert stiff.flexural_stiffness == pytest.approx(2 * soft.flexural_stiffness, rel=1e-12)
    for kept in ("inertia", "mass", "twist_recovery", "deflection_recovery"):
        assert getattr(stiff, kept) == getattr(soft, kept)


def test_frequencies_of_the_beam_grow_as_the_root_of_k_star(data: dict[str, xr.Dataset]) -> None:
    soft, stiff = case("3d", 5.0, data).beam, case("3d", 20.0, data).beam
    assert soft is not None
    assert stiff is not None
    np.testing.assert_allclose(stiff.torsion_frequency, 2 * np.array(soft.torsion_frequency))
    np.testing.assert_allclose(stiff.bending_frequency, 2 * np.array(soft.bending_frequency))
    assert stiff.torsion_shape == soft.torsion_shape
    assert len(soft.bending_frequency) == len(soft.torsion_frequency) == 2


def test_beam_at_its_own_k_star_has_its_own_frequencies(
    config: Config, data: dict[str, xr.Dataset]
) -> None:
    beam = case("3d", nominal_k_star(data["equivalent"]), data).beam
    modes = data["modes"]
    first = float(modes["frequency"].values[modes["kind"].values == "torsion"][0])
    assert beam is not None
    reduced = 2 * math.pi * first * config.beam.chord / config.flow.speed
    assert beam.torsion_frequency[0] == pytest.approx(reduced, rel=1e-12)


def test_consistent_section_has_the_natural_frequency_of_the_beam(
    data: dict[str, xr.Dataset],
) -> None:
    section, beam = case("2d-consistent", 9.0, data).section, case("3d", 9.0, data).beam
    assert section is not None
    assert beam is not None
    pitch = math.sqrt(section.torsional_stiffness / section.inertia)
    heave = math.sqrt(section.flexural_stiffness / section.mass)
    assert pitch == pytest.approx(beam.torsion_frequency[0], rel=1e-4)
    assert heave == pytest.approx(beam.bending_frequency[0], rel=1e-4)


def test_correction_multiplies_masses_and_stiffnesses(data: dict[str, xr.Dataset]) -> None:
    """Eq. 20: a beam with half the section's coefficients makes the factors two."""
    plain, corrected = case("2d", 21.0, data).section, case("2d-corrected", 21.0, data).section
    assert plain is not None
    assert corrected is not None
    for name in ("torsional_stiffness", "flexural_stiffness", "inertia", "mass"):
        assert getattr(corrected, name) == pytest.approx(2 * getattr(plain, name), rel=1e-9)
    assert corrected.twist_recovery == plain.twist_recovery


def test_lift_corrects_the_heave_and_moment_the_pitch(data: dict[str, xr.Dataset]) -> None:
    """Eq. 20: l_f goes to k_w* and m*, m_f to k* and I*."""
    section = factors_from_dataset(data["correction"]).section
    beam = replace(section, lift=0.5 * section.lift, moment=0.8 * section.moment)
    corrected_by = {**data, "correction": factors_to_dataset(CorrectionFactors(section, beam))}
    plain = case("2d", 21.0, corrected_by).section
    corrected = case("2d-corrected", 21.0, corrected_by).section
    assert plain is not None
    assert corrected is not None
    for name, factor in {
        "torsional_stiffness": 1.25,
        "inertia": 1.25,
        "flexural_stiffness": 2.0,
        "mass": 2.0,
    }.items():
        assert getattr(corrected, name) == pytest.approx(factor * getattr(plain, name), rel=1e-9)


def test_factors_are_those_of_the_incidence_at_equilibrium(data: dict[str, xr.Dataset]) -> None:
    """A ratio of moments that changes with incidence tells at which incidence it was taken.

    k* theta = c_m(theta_0 + theta)/m_f is the beam's own equilibrium: k* theta = C_M.
    """
    angles = np.radians(np.linspace(-10.0, 10.0, 41))
    section = Polar(angles, 0.1 + angles**2, 6.0 * angles, 1.5 * angles, "section")
    beam = replace(section, moment=section.moment * (0.9 - 2.0 * np.abs(angles)))
    factors = CorrectionFactors(section, beam)
    given = {**data, "correction": factors_to_dataset(factors)}
    k_star, start = 9.0, math.radians(2.5)
    plain = case("2d", k_star, given).section
    corrected = case("2d-corrected", k_star, given).section
    assert plain is not None
    assert corrected is not None

    def moment(twist: float, of: Polar) -> float:
        return float(PchipInterpolator(of.incidence, of.moment)(start + twist))

    stiffness = plain.torsional_stiffness
    twist = brentq(lambda t: stiffness * t - moment(t, beam), 0.0, math.radians(1.5))
    expected = moment(twist, section) / moment(twist, beam)
    at_rest = moment(0.0, section) / moment(0.0, beam)
    assert expected > 1.01 * at_rest
    assert corrected.torsional_stiffness / stiffness == pytest.approx(expected, rel=1e-9)


def test_beam_has_the_mass_and_the_inertia_of_a_flat_bar(data: dict[str, xr.Dataset]) -> None:
    """m = rho_s c t over rho c^2/2 and I = rho_s t c^3/12 over rho c^4/2, t = 0.04 c."""
    beam = case("3d", 9.0, data).beam
    assert beam is not None
    assert beam.mass == pytest.approx(2 * 1000 * 0.04)
    assert beam.inertia == pytest.approx(2 * 1000 * 0.04 / 12)


def test_history_that_would_look_at_rest_is_refused_alone(data: dict[str, xr.Dataset]) -> None:
    """At k* = 21 the pitch has a period of 2 pi sqrt(I*/k*) = 3.5 c/V: 0.59 c/V is a sixth."""
    seldom = {"unsteady": {"time_step": 0.05, "output_interval": 0.6}}
    config = load_config({**RAW, **seldom})
    for name in ("2d", "3d"):
        assert not case(name, 18.0, data, config).not_run
        refused = case(name, 21.5, data, config)
        assert "0.6 c/V; allowed is up to 0.58 c/V at k* = 21.5" in refused.not_run
        assert refused.section is None
        assert refused.beam is None
        assert not refused.diverges


def test_corrected_section_that_diverges_is_refused_in_its_case(
    data: dict[str, xr.Dataset],
) -> None:
    refused = case("2d-corrected", 0.05, data)
    assert refused.section is None
    assert refused.refusal
    assert case("2d-corrected", 21.0, data).refusal == ""


def test_corrected_section_without_a_factor_is_refused_and_the_others_go_on(
    data: dict[str, xr.Dataset],
) -> None:
    """A section whose moment changes sign where the beam's does not; softer, it twists past it."""
    both = factors_from_dataset(data["correction"])
    section = replace(both.section, moment=both.section.moment - 0.08)
    crossing = {**data, "correction": factors_to_dataset(CorrectionFactors(section, both.beam))}
    refused = case("2d-corrected", 21.0, crossing)
    assert refused.section is None
    assert "c_m/C_M" in refused.refusal
    assert not refused.diverges
    assert case("2d-corrected", 2.0, crossing).section is not None


def test_case_holds_no_name_and_no_path_of_the_run(data: dict[str, xr.Dataset]) -> None:
    other = load_config({**RAW, "run": "other"})
    assert case_hash(case("2d", 9.0, data)) == case_hash(case("2d", 9.0, data, other))


@pytest.mark.parametrize(
    "change",
    [
        {"flow": {"speed": 19.0}},
        {"flow": {"incidence_deg": 2.0}},
        {"flow": {"channel": None}},
        {"unsteady": {"time_step": 0.1}},
        {"unsteady": {"verdict": {"periods": 6}}},
        {"embedded": {"polars": {"thin": "flat-plate"}, "strips": 9}},
    ],
    ids=str,
)
def test_what_decides_a_result_is_in_the_case(
    change: dict[str, Any], data: dict[str, xr.Dataset]
) -> None:
    changed = load_config({**RAW, **change})
    assert case_hash(case("3d", 9.0, data)) != case_hash(case("3d", 9.0, data, changed))


@pytest.mark.parametrize(
    "change",
    [
        {"sweep": {"k_star": [9.0]}},
        {"sweep": {"onset": "refine"}},
        {"steady": {"resolution": "thin", "incidence_deg": [0, 1, 2, 3, 9]}},
    ],
    ids=str,
)
def test_what_decides_no_result_of_a_case_is_not_in_it(
    change: dict[str, Any], data: dict[str, xr.Dataset]
) -> None:
    changed = load_config({**RAW, **change})
    assert case_hash(case("3d", 9.0, data)) == case_hash(case("3d", 9.0, data, changed))


def test_steady_case_has_its_angle_and_the_geometry_in_chords(config: Config) -> None:
    made = steady_case(config, "3d", 2.5, "thin", solver_from_config(config, "thin"))
    assert (made.dimension, made.incidence_deg, made.resolution) == ("3d", 2.5, "thin")
    # the sample cases are written down by hand for the same plate
    assert made.geometry.model_dump() == pytest.approx(STEADY.geometry.model_dump())
    assert made.medium == STEADY.medium


def at(model: str, values: dict[Axis, float], data: dict[str, xr.Dataset]) -> UnsteadyCase:
    config = load_config(RAW)
    solver = solver_from_config(config, "thin")
    return case_at(config, plan.model(model, config.reduction), Point.at(values), data, solver)


@pytest.mark.parametrize("model", ["2d-corrected-paper", "3d"])
def test_point_of_k_star_alone_is_the_case_of_that_k_star(
    model: str, data: dict[str, xr.Dataset]
) -> None:
    assert case_hash(at(model, {K_STAR: 6.44}, data)) == case_hash(case(model, 6.44, data))


def test_point_with_an_incidence_is_the_case_of_a_run_at_it(data: dict[str, xr.Dataset]) -> None:
    there = load_config(RAW | {"flow": {"incidence_deg": 5.0}})
    found = at("2d-corrected", {INCIDENCE: 5.0, K_STAR: 6.44}, data)
    assert case_hash(found) == case_hash(case("2d-corrected", 6.44, data, there))


@pytest.mark.parametrize("speed", [10.0, 20.0, 33.0])
def test_point_of_a_speed_is_the_beam_as_given_at_that_speed(
    speed: float, config: Config, data: dict[str, xr.Dataset]
) -> None:
    """k* is a stiffness over a dynamic pressure; frequencies over V/c go with the time c/V."""
    given = k_star_as_given(config, data["equivalent"])
    section, beam = (at(model, {SPEED: speed}, data) for model in ("2d-paper", "3d"))
    ratio = config.flow.speed / speed
    assert section.medium.speed == beam.medium.speed == speed
    assert section.k_star == pytest.approx(given * ratio**2, rel=1e-12)
    assert section.section is not None
    assert section.section.torsional_stiffness == pytest.approx(section.k_star, rel=1e-12)
    as_given = case("3d", given, data).beam
    assert beam.beam is not None
    assert as_given is not None
    assert beam.beam.torsion_frequency == pytest.approx(
        ratio * np.array(as_given.torsion_frequency), rel=1e-12
    )


def test_each_speed_of_a_sweep_has_the_mesher_of_its_reynolds_number(
    data: dict[str, xr.Dataset],
) -> None:
    """The configuration's own speed may be on the other side of where the first cells thin."""
    sweep = {"speed": [20.0, 90.0], "models": ["2d"]}
    config = load_config(
        RAW
        | {"solver": "openfoam", "openfoam": {"mesher": "outline"}, "sweep": sweep}
        | {"steady": {"resolution": "coarse"}, "unsteady": {"time_step": 0.02}}
    )
    solver, model = solver_from_config(config, "coarse"), plan.model("2d", config.reduction)
    meshers = []
    for speed in config.sweep.values():
        found = case_at(config, model, Point.at({SPEED: speed}), data, solver)
        meshers.append(found.solver.settings["mesher"])
        require_mesher(meshers[-1], reynolds_number(found.geometry, found.medium))
    assert [mesher.partition(",")[0] for mesher in meshers] == ["outline 1", "outline 2"]


@pytest.mark.parametrize("member", ["static_imbalance", "flexural_damping", "torsional_damping"])
def test_what_a_section_has_beyond_its_springs_is_put_into_its_case(
    member: str, data: dict[str, xr.Dataset]
) -> None:
    """Stiffer by 4, a damper weighs twice as much in the flow, and an imbalance the same."""
    value = 1e-3
    equivalent = data["equivalent"].assign({member: ("reduction", [value, value])})
    soft, stiff = (case("2d", k_star, {**data, "equivalent": equivalent}) for k_star in (5.0, 20.0))
    assert soft.section is not None
    assert stiff.section is not None
    ratio = getattr(stiff.section, member) / getattr(soft.section, member)
    assert ratio == pytest.approx(1.0 if member == "static_imbalance" else 2.0)
    assert case_hash(soft) != case_hash(case("2d", 5.0, data))
    assert section_from_dataset(equivalent, "consistent").model_dump()[member] == value


@pytest.mark.parametrize(("member", "value"), [("static_imbalance", 1e-3), ("elastic_axis", 0.3)])
def test_correction_of_a_section_with_an_offset_is_that_of_its_loads(
    member: str, value: float, data: dict[str, xr.Dataset]
) -> None:
    """Eq. 20 scales rows, and rows of other scales that share an imbalance are no body."""
    equivalent = data["equivalent"].assign({member: ("reduction", [value, value])})
    both = {**data, "equivalent": equivalent}
    plain, corrected = (case(name, 9.0, both) for name in ("2d", "2d-corrected"))
    assert corrected.section == plain.section
    assert (plain.lift_factor, plain.moment_factor) == (1.0, 1.0)
    assert 0.3 < corrected.lift_factor < 1.0
    assert 0.3 < corrected.moment_factor < 1.0
    scaled = case("2d-corrected", 9.0, data)
    assert scaled.section is not None
    assert plain.section is not None
    if member == "static_imbalance":  # the same equilibrium, and so the same factors
        assert 1 / corrected.lift_factor == pytest.approx(scaled.section.mass / plain.section.mass)
    assert "lift_factor" not in plain.model_dump()
    assert "lift_factor" not in scaled.model_dump()
    assert UnsteadyCase.model_validate_json(corrected.model_dump_json()) == corrected


def test_section_in_the_flow_is_the_one_in_si_units(data: dict[str, xr.Dataset]) -> None:
    flow = Config().flow
    for reduction in REDUCTIONS:
        here = section_from_dataset(data["equivalent"], reduction)
        there = section_in_flow(data["equivalent"], reduction)
        assert here.chord == 0.1
        assert there == here.in_flow(flow.density, flow.speed)


def test_correction_keeps_the_damping_ratios(data: dict[str, xr.Dataset]) -> None:
    dampings = {"flexural_damping": 0.02, "torsional_damping": 1e-4}
    damped = {name: ("reduction", [value, value]) for name, value in dampings.items()}
    both = {**data, "equivalent": data["equivalent"].assign(damped)}
    plain, corrected = (case(name, 9.0, both).section for name in ("2d", "2d-corrected"))
    assert plain is not None
    assert corrected is not None
    assert corrected.mass != plain.mass
    for damper, spring, inertia in (
        ("flexural_damping", "flexural_stiffness", "mass"),
        ("torsional_damping", "torsional_stiffness", "inertia"),
    ):
        here, there = (
            getattr(one, damper) / math.sqrt(getattr(one, spring) * getattr(one, inertia))
            for one in (plain, corrected)
        )
        assert here == pytest.approx(there, rel=1e-12)


WING: dict[str, Any] = {
    "beam": {
        "chord": 1.8288,
        "length": 6.096,
        "thickness": 0.1,
        "elastic_axis": 0.33,
        "mass_axis": 0.43,
        "damping": {"bending": 0.01, "torsion": 0.02},
        "cross_section": {
            "bending_rigidity": 9.773e6,
            "torsional_rigidity": 9.876e5,
            "mass_per_length": 35.717,
            "inertia_per_length": 8.642,
        },
    },
    "flow": {"speed": 100.0, "density": 1.225, "incidence_deg": 1.0, "channel": None},
    "structure": {"method": "analytic", "bending_modes": 2, "torsion_modes": 2},
    "embedded": {"polars": {"thin": "flat-plate"}},
    "steady": {"resolution": "thin"},
}


def wing(**changes: Any) -> tuple[Config, dict[str, xr.Dataset]]:
    """Return Goland's wing, changed, with its modes and sections as the workflow makes them."""
    config = load_config(WING | {"beam": {**WING["beam"], **changes}})
    modes = modes_of_kinds(config.beam, "analytic", (8, 40, 1), (2, 2), 4)
    sections = {name: reduce_beam(config.beam, modes, name) for name in REDUCTIONS}
    integrals = span_integrals(config.beam, modes, 2)
    speeds = {"density": config.flow.density, "speed": config.flow.speed}
    flutter = {
        name: flutter_bias(section, config.beam, modes, config.flow.density)
        for name, section in sections.items()
    }
    equivalent = with_flutter(
        equivalent_to_dataset(sections, integrals, (), **speeds), flutter, 1.225
    )
    return config, {"modes": modes_to_dataset(modes, [0.0] * 4), "equivalent": equivalent}


def test_beam_with_axes_and_damping_has_them_in_its_case_at_any_k_star() -> None:
    config, made = wing()
    for k_star in (2.0, 8.0):
        found = case("3d", k_star, made, config)
        assert found.beam is not None
        assert found.beam.imbalance == pytest.approx(
            35.717 * 0.1 * 1.8288 / (0.5 * 1.225 * 1.8288**3)
        )
        assert (found.beam.bending_damping, found.beam.torsion_damping) == (0.01, 0.02)
        assert found.beam.elastic_axis == 0.33
        assert UnsteadyCase.model_validate_json(found.model_dump_json()) == found


def test_beam_without_axes_and_damping_is_the_case_that_it_was(data: dict[str, xr.Dataset]) -> None:
    plain = case("3d", 9.0, data)
    assert plain.beam is not None
    assert set(plain.model_dump()["beam"]) == {
        "span",
        "bending_frequency",
        "bending_shape",
        "torsion_frequency",
        "torsion_shape",
        "inertia",
        "mass",
    }


def test_section_of_an_offset_beam_is_in_its_case_with_its_damping_ratios() -> None:
    config, made = wing()
    section = case("2d", 2.0, made, config).section
    assert section is not None
    assert section.elastic_axis == 0.33
    for damper, spring, inertia, ratio in (
        ("flexural_damping", "flexural_stiffness", "mass", 0.01),
        ("torsional_damping", "torsional_stiffness", "inertia", 0.02),
    ):
        critical = 2 * math.sqrt(getattr(section, spring) * getattr(section, inertia))
        assert getattr(section, damper) == pytest.approx(ratio * critical)


def test_section_too_far_from_its_beam_is_refused_in_its_case_and_the_beam_runs() -> None:
    config, made = wing(
        boundary="one-fork",
        cross_section={**WING["beam"]["cross_section"], "bending_rigidity": 0.55 * 9.773e6},
    )
    assert abs(float(made["equivalent"]["flutter_bias"].sel(reduction="consistent"))) > 0.15
    refused = case("2d", 2.0, made, config)
    assert refused.section is None
    assert not refused.diverges
    assert "their shapes are too unlike for a section; run the beam" in refused.refusal
    assert case("3d", 2.0, made, config).refusal == ""
