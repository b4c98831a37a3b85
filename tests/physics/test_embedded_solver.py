"""Physics of the embedded solver as the workflow sees it: through its adapter."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.conftest import ROOT
from tests.sample_cases import GEOMETRY, STEADY, UNSTEADY, UNSTEADY_PLATE, beam_modes
from tests.watching import nothing

from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.cases import SteadyCase, UnsteadyCase
from equisection.config import load_config
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.registry import SOLVERS, solver_from_config

POLAR = ROOT / "config" / "polars" / "plate_2d_11136.csv"


def adapter(polar: str = str(POLAR)) -> Adapter:
    raw = {"embedded": {"polars": {"coarse": polar}, "strips": 12}}
    solver = solver_from_config(load_config(raw), "coarse")
    assert isinstance(solver, Adapter)
    return solver


@pytest.fixture(scope="module")
def solver() -> Adapter:
    return adapter()


def steady(solver: Adapter, *cases: SteadyCase) -> list[SteadyResult]:
    return solver.run_steady(cases, Path("unused"), nothing)


def unsteady(solver: Adapter, *cases: UnsteadyCase) -> list[UnsteadyResult]:
    return solver.run_unsteady(cases, Path("unused"), nothing)


def rigid(dimension: str, incidence_deg: float, **geometry: object) -> SteadyCase:
    return STEADY.model_copy(
        update={
            "dimension": dimension,
            "incidence_deg": incidence_deg,
            "geometry": GEOMETRY.model_copy(update=geometry),
        }
    )


def free(k_star: float, duration: float = 400.0, **criteria: float) -> UnsteadyCase:
    assert UNSTEADY.section is not None
    section = UNSTEADY.section.model_copy(update={"torsional_stiffness": k_star})
    return UNSTEADY.model_copy(
        update={
            "k_star": k_star,
            "section": section,
            "duration": duration,
            "criteria": UNSTEADY.criteria.model_copy(update=criteria),
        }
    )


def test_what_the_solver_provides_is_what_the_graph_is_built_with() -> None:
    assert Adapter.provides == SOLVERS[Adapter.name].provides


@pytest.mark.parametrize("polar", [str(POLAR), "flat-plate"])
def test_settings_make_the_same_solver_again(polar: str) -> None:
    solver = adapter(polar)
    again = Adapter.from_settings(solver.settings("2d"))
    first, second = (steady(each, rigid("3d", 5.0))[0] for each in (solver, again))
    assert first.lift == pytest.approx(second.lift, rel=1e-12)
    assert again.settings("2d")["polar"]["label"] == solver.settings("2d")["polar"]["label"]
    np.testing.assert_allclose(
        again.settings("2d")["polar"]["incidence_deg"],
        solver.settings("2d")["polar"]["incidence_deg"],
        rtol=1e-12,
    )
    assert again.settings("2d")["separation"] == solver.settings("2d")["separation"]


@pytest.mark.parametrize("incidence_deg", [-3.0, 0.0, 1.0, 2.0, 3.0, 8.0])
def test_rigid_section_has_the_values_of_its_polar_file(
    incidence_deg: float, solver: Adapter
) -> None:
    polar = Polar.read(POLAR, symmetric=True)
    (result,) = steady(solver, rigid("2d", incidence_deg))
    alpha = math.radians(incidence_deg)
    assert result.lift == pytest.approx(float(polar.lift_coefficient(alpha)), abs=1e-15)
    assert result.moment == pytest.approx(float(polar.moment_coefficient(alpha)), abs=1e-15)
    # the file's own lines
    lines = {0.0: (0.0, 0.0), 1.0: (0.14703, 0.03459), 3.0: (0.45675, 0.08247)}
    if incidence_deg in lines:
        # polars are read through a table whose error is below 1e-6
        assert (result.lift, result.moment) == pytest.approx(lines[incidence_deg], abs=1e-6)


@pytest.mark.parametrize("incidence_deg", [1.0, 5.0, 9.0])
def test_beam_between_walls_without_a_gap_is_the_section(
    incidence_deg: float, solver: Adapter
) -> None:
    """No tip, no vortex: with both ends on walls every strip sees the flow of two dimensions."""
    beam, section = steady(
        solver, rigid("3d", incidence_deg, tip_gap=0.0), rigid("2d", incidence_deg)
    )
    assert beam.lift == pytest.approx(section.lift, rel=1e-9)
    assert beam.moment == pytest.approx(section.moment, rel=1e-9)
    np.testing.assert_allclose(beam.section_lift, section.lift, rtol=1e-9)


def test_rigid_beam_is_the_lifting_line_in_its_channel(solver: Adapter) -> None:
    """Span 3.7 c, a gap of 0.3 c to the far wall, 4 c from floor to ceiling."""
    strips = cosine_strips(12)
    span = SpanGeometry.of(strips, 1.0, 3.7, 4.0, 4.0)
    expected = LiftingLine.of(Polar.read(POLAR, symmetric=True), strips, span).solve(
        math.radians(2.5)
    )
    (beam,) = steady(solver, rigid("3d", 2.5))
    assert beam.lift == pytest.approx(expected.lift, rel=1e-12)
    assert beam.moment == pytest.approx(expected.moment, rel=1e-12)


def test_released_beam_starts_as_fast_as_its_masses_let_it(solver: Adapter) -> None:
    """From rest W_1 = s^2/2 int c_l g/(m int g^2), and as much of Theta_1 with c_m, f and I.

    The air that moves along adds a fiftieth to the mass.
    """
    start = {"duration": 4.0, "time_step": 0.05, "output_interval": 0.05}
    case = UNSTEADY_PLATE.model_copy(update={**start, "beam": beam_modes(1.0)})
    assert case.beam is not None
    (run,), (at_rest,) = unsteady(solver, case), steady(solver, rigid("3d", 2.5))
    strips, span = cosine_strips(12), np.array(case.beam.span)
    assert at_rest.section_lift is not None
    assert at_rest.section_moment is not None
    beam = case.beam
    for amplitudes, shapes, load, mass in (
        (run.bending_amplitudes, beam.bending_shape, at_rest.section_lift, beam.mass),
        (run.torsion_amplitudes, beam.torsion_shape, at_rest.section_moment, beam.inertia),
    ):
        assert amplitudes is not None
        first = np.array(shapes[0])
        work = strips.weights @ (load * np.interp(strips.stations, span, first))
        acceleration = work / (mass * np.trapezoid(first**2, span))
        assert 2 * amplitudes[0, 2] / run.time[2] ** 2 == pytest.approx(acceleration, rel=0.05)


def test_beam_with_a_gap_lifts_less_than_its_section(solver: Adapter) -> None:
    beam, section = steady(solver, rigid("3d", 2.5), rigid("2d", 2.5))
    assert 0 < beam.lift < section.lift
    assert beam.section_lift[-1] < beam.section_lift[0]


@pytest.mark.parametrize("dimension", ["2d", "3d"])
def test_loads_turn_over_with_the_incidence(dimension: str, solver: Adapter) -> None:
    up, down = steady(solver, rigid(dimension, 4.0), rigid(dimension, -4.0))
    assert down.lift == pytest.approx(-up.lift, rel=1e-9)
    assert down.moment == pytest.approx(-up.moment, rel=1e-9)
    assert down.drag == pytest.approx(up.drag, rel=1e-9)


def test_angle_beyond_the_polar_fails_and_the_others_have_values(solver: Adapter) -> None:
    inside, beyond, also_inside = steady(
        solver, rigid("2d", 2.0), rigid("2d", 20.0), rigid("2d", 3.0)
    )
    assert inside.failure == also_inside.failure == ""
    assert math.isnan(beyond.lift)
    assert "20" in beyond.failure


def test_stiff_section_settles_where_spring_and_moment_are_equal(solver: Adapter) -> None:
    r"""k* theta = c_m(theta_0 + theta) and k_w* w/c = c_l(theta_0 + theta)."""
    (run,) = unsteady(solver, free(21.0, periods=60))
    section = UNSTEADY.section
    assert section is not None
    assert run.verdict["regime"] == "settled"
    twist_deg = float(run.verdict["mean_twist_deg"]) * section.twist_recovery
    deflection = float(run.verdict["mean_deflection_chords"]) * section.deflection_recovery
    (there,) = steady(solver, rigid("2d", 2.5 + twist_deg))
    assert 21.0 * math.radians(twist_deg) == pytest.approx(there.moment, rel=1e-6)
    assert section.flexural_stiffness * deflection == pytest.approx(there.lift, rel=1e-6)


def test_release_is_from_rest_against_the_apparent_mass(solver: Adapter) -> None:
    """The steady loads accelerate the section with the air about it (NACA Report 496).

    With m* w'' = c_l - (pi/2) w'' and I* theta'' = c_m - (pi/64) theta'' the section itself
    takes the shares m*/(m* + pi/2) and I*/(I* + pi/64) of the steady loads.
    """
    (run,) = unsteady(solver, free(9.0, duration=20.0))
    (there,) = steady(solver, rigid("2d", 2.5))
    section = UNSTEADY.section
    assert section is not None
    assert run.time[0] == run.twist[0] == run.deflection[0] == 0.0
    lift_share = section.mass / (section.mass + math.pi / 2)
    moment_share = section.inertia / (section.inertia + math.pi / 64)
    # the time loop reads the polar with a table of its own
    assert run.lift[0] == pytest.approx(lift_share * there.lift, rel=1e-5)
    assert run.moment[0] == pytest.approx(moment_share * there.moment, rel=1e-5)


def test_tip_is_recovered_from_the_section(solver: Adapter) -> None:
    (run,) = unsteady(solver, free(9.0, duration=20.0))
    assert UNSTEADY.section is not None
    np.testing.assert_allclose(run.tip_twist, run.twist / UNSTEADY.section.twist_recovery)
    np.testing.assert_allclose(run.incidence, math.radians(2.5) + run.twist)


def test_cases_in_a_batch_run_as_they_do_alone(solver: Adapter) -> None:
    cases = [free(k_star, duration=100.0) for k_star in (3.0, 6.0, 9.0, 21.0)]
    together = unsteady(solver, *cases)
    for case, run in zip(cases, together, strict=True):
        (alone,) = unsteady(solver, case)
        assert alone.time.size == run.time.size
        np.testing.assert_allclose(run.twist, alone.twist, rtol=0, atol=1e-12)
        np.testing.assert_allclose(run.lift, alone.lift, rtol=0, atol=1e-12)
        assert alone.verdict["regime"] == run.verdict["regime"]


def test_results_come_in_the_order_of_their_cases(solver: Adapter) -> None:
    """Cases that do not share duration run in groups, and still answer in order."""
    cases = [free(21.0, 30.0), free(9.0, 20.0), free(15.0, 30.0), free(12.0, 20.0)]
    runs = unsteady(solver, *cases)
    assert [run.time[-1] for run in runs] == pytest.approx([30.0, 20.0, 30.0, 20.0])
    for case, run in zip(cases, runs, strict=True):
        np.testing.assert_array_equal(run.twist, unsteady(solver, case)[0].twist)


def test_section_that_leaves_the_polar_has_failed_and_says_when(solver: Adapter) -> None:
    unbounded = {"growing_amplitude_deg": 60.0}
    soft, stiff = unsteady(
        solver, free(0.3, duration=100.0, **unbounded), free(21.0, duration=100.0, **unbounded)
    )
    assert soft.verdict["regime"] == "failed"
    assert "left the section polar" in str(soft.verdict["reason"])
    assert 0 < soft.time[-1] < 100.0
    assert np.isfinite(soft.twist).all()
    assert stiff.verdict["regime"] != "failed"


def test_progress_rises_to_its_total(solver: Adapter) -> None:
    told: list[tuple[float, float]] = []
    cases = [free(9.0, 30.0), free(12.0, 30.0), free(21.0, 20.0)]
    solver.run_unsteady(cases, Path("unused"), lambda done, total: told.append((done, total)))
    done = [share[0] for share in told]
    assert done == sorted(done)
    assert {share[1] for share in told} == {80.0}
    assert done[-1] == pytest.approx(80.0)
