"""Forced motion: its signal, the loads that answer it, and the derivatives of known sections."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import equisection as eq
from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.indicial import theodorsen
from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.wake_lags import JONES, accurate_lags
from equisection.analysis.forced_derivatives import ForcedAnswers, derivatives_of
from equisection.beam.section import Section
from equisection.cases import ForcedCase, read_cases
from equisection.config import load_config
from equisection.errors import ArgumentError, ConfigError, ResultFileError
from equisection.motion.derivative_flutter import FlowingBody, derivative_onset
from equisection.motion.forced_signal import ForcedSignal, schroeder_phases
from equisection.results.forced_result import ForcedResult
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.embedded.forced_sections import forced_section
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.section.forced_section import ForcedRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from equisection.solvers.registry import solver_from_config
from equisection.store.index import write_index
from equisection.store.job import run_cases
from equisection.study.forced_cases import forced_case
from equisection.study.plan import forced_names
from equisection.validation.flutter_values import deck

ATTACHED = {"relaxation": 0.0, "delay": 0.0, "lift_lag": 0.0}
PLATE: dict[str, Any] = {
    "embedded": {"polars": {"thin": "flat-plate"}, "separation": ATTACHED},
    "steady": {"resolution": "thin"},
    "flow": {"incidence_deg": 0.5},
}
K = math.tau / np.array([3.0, 5.0, 8.0, 13.0])


def answers(raw: dict[str, Any], **forced: Any) -> ForcedAnswers:
    """Return what the embedded solver answers to the forced motion of a configuration."""
    config = load_config({**raw, "forced": {"run": True, **forced}})
    solver = solver_from_config(config, config.steady.resolution)
    assert isinstance(solver, Adapter)
    names = forced_names(config)
    cases = [forced_case(config, name, solver) for name in names]
    results = solver.run_forced(cases, Path(), lambda now, end: None)
    return derivatives_of(
        {
            name: (case, result.of_case(case))
            for name, case, result in zip(names, cases, results, strict=True)
        }
    )


def test_history_that_ends_before_the_motion_has_set_in_is_refused_by_name() -> None:
    config = load_config({**PLATE, "forced": {"run": True}})
    solver = solver_from_config(config, config.steady.resolution)
    assert isinstance(solver, Adapter)
    name = forced_names(config)[0]
    case = forced_case(config, name, solver)
    (result,) = solver.run_forced([case], Path(), lambda now, end: None)
    data = result.of_case(case)
    short = data.isel(time=data["time"] < 0.5 * case.settling)
    with pytest.raises(ResultFileError, match=rf"{name}: its history ends at .*; run it again"):
        derivatives_of({name: (case, short)})


def test_lags_of_the_wake_are_those_of_theodorsen() -> None:
    """C(0) = 1, C(infinity) = 1/2, and a hundredth of a per cent between; Jones has 2.3 %."""
    k, lags = np.geomspace(0.005, 5.0, 997), accurate_lags()
    assert np.max(np.abs(lags.lag(k) / theodorsen(k) - 1.0)) < 1e-4
    assert np.max(np.abs(JONES.lag(k) / theodorsen(k) - 1.0)) == pytest.approx(0.0234, abs=1e-3)
    assert abs(complex(lags.lag(1e-9)) - 1.0) < 1e-6
    assert lags.immediate == pytest.approx(0.5, abs=1e-9)


def test_motion_sets_in_without_a_jump() -> None:
    signal = ForcedSignal(K, np.full(4, 0.01), schroeder_phases(4), ramp=5.0)
    time = np.linspace(0.0, 20.0, 20001)
    moved = signal.at(time)
    rate = np.gradient(moved, time)
    acceleration = np.gradient(rate, time)
    assert (moved[0], rate[0]) == pytest.approx((0.0, 0.0), abs=1e-8)
    assert abs(acceleration[2]) < 1e-4
    later = time > 5.0
    exact = np.real(np.exp(1j * np.multiply.outer(time[later], K)) @ signal.response)
    assert moved[later] == pytest.approx(exact, abs=1e-12)


def test_schroeder_phases_keep_the_peak_low() -> None:
    """The peak of eight harmonics over the root mean square, 4 with all in phase, is below 2."""
    frequencies, time = np.arange(1.0, 9.0), math.tau * np.arange(4000) / 4000

    def crest(phases: Any) -> float:
        moved = np.cos(np.multiply.outer(time, frequencies) + phases).sum(axis=1)
        return float(np.max(np.abs(moved)) / np.sqrt(np.mean(moved**2)))

    assert crest(np.zeros(8)) == pytest.approx(4.0, rel=1e-3)
    assert crest(schroeder_phases(8)) < 2.0


def test_answer_is_found_under_mean_drift_and_other_frequencies() -> None:
    time = np.arange(0.0, 130.0, 0.1)
    wanted = np.array([1.0 - 2.0j, 0.5 + 0.1j, -0.3 + 2.0j, 0.2j])
    load = 0.4 + 0.01 * time + np.real(np.exp(1j * np.multiply.outer(time, K)) @ wanted)
    found = load_response(time, load, K)
    assert found.response == pytest.approx(wanted, abs=1e-9)
    assert found.rest < 1e-9
    assert found.spread == pytest.approx(np.zeros(4), abs=1e-9)
    disturbed = load_response(time, load + 0.3 * np.cos(7.0 * time), K)
    assert disturbed.response == pytest.approx(wanted, abs=0.02)
    size = math.sqrt(0.5 * float(np.sum(np.abs(wanted) ** 2)) + 0.045)
    assert disturbed.rest == pytest.approx(0.3 / math.sqrt(2.0) / size, rel=0.05)


def test_spread_is_the_error_of_noise() -> None:
    """Over many records the spread is the standard deviation of the answer."""
    rng = np.random.default_rng(3)
    time = np.arange(0.0, 130.0, 0.1)
    found = [load_response(time, rng.normal(0.0, 0.5, time.size), K) for _ in range(300)]
    actual = np.std([each.response.real for each in found], axis=0)
    given = np.sqrt(np.mean([each.spread**2 for each in found], axis=0))
    assert given == pytest.approx(actual, rel=0.15)


def test_record_that_is_too_short_for_its_frequencies_is_refused() -> None:
    time = np.arange(0.0, 8.0, 0.1)
    with pytest.raises(ArgumentError, match="record for longer"):
        load_response(time, np.cos(time), np.array([0.5, 0.52]))


@pytest.mark.parametrize("motion", ["multi-sine", "harmonic"])
def test_derivatives_of_a_thin_plate_are_those_of_theodorsen(motion: str) -> None:
    """Within 0.2 % of the load at each reduced velocity; 2.3 % with the lags of Jones."""
    table = answers(PLATE, motion=motion).derivatives
    exact = Derivatives.theodorsen(table.reduced_velocity)
    error = np.abs(table.loads - exact.loads) / np.abs(exact.loads)
    assert table.reduced_velocity == pytest.approx([3, 4, 6, 8, 12, 16, 24])
    assert error.max() < 2e-3
    assert table.incidence_deg == 0.5
    assert table.spread is not None
    assert table.doubts == ()


def test_onset_of_the_deck_from_forced_motion() -> None:
    """Deck of IABSE's TG3.1 (Diana et al., 2020) with Theodorsen's loads: 77.24 m/s."""
    table = answers(PLATE).derivatives
    found = derivative_onset(FlowingBody.of_section(deck(0.003), 1.22), table)
    assert found.speed == pytest.approx(77.242, rel=1e-3)
    assert found.speed_low <= 77.242 <= found.speed_high


def test_onset_of_a_plate_by_derivatives_about_its_equilibrium_is_that_of_eigenvalues() -> None:
    """Same equations, Jones' lags in both: small motion about the static equilibrium at the onset.

    About the rigid incidence, half a degree below, the onset is a third higher.
    """
    section = Section(
        torsional_stiffness=20.0,
        flexural_stiffness=3.7,
        inertia=8.8,
        mass=80.0,
    ).model_copy(update={"chord": 1.0})
    polar, lags = Adapter.from_config(load_config({}), "coarse").section_loads
    onset = eq.critical_speed(
        section, polar, incidence_deg=2.5, speed=(1.0, 4.0), density=2.0, lags=lags
    )
    twisted = 2.5 + math.degrees(float(onset.equilibrium_twist))
    about = {}
    for incidence in (2.5, twisted):
        raw = {"forced": {"run": True, "amplitude_deg": 0.02, "incidence_deg": incidence}}
        config = load_config(raw)
        solver = solver_from_config(config, "coarse")
        loads = UnsteadyLoads.from_polar(polar, lags)
        results = {}
        for name in forced_names(config):
            case = forced_case(config, name, solver)
            results[name] = case, forced_section(case, loads, JONES).of_case(case)
        table = derivatives_of(results).derivatives
        about[incidence] = eq.critical_speed(section, table, speed=(1.0, 6.0), density=2.0)
    by_table = about[twisted]
    assert float(by_table.critical_speed) == pytest.approx(float(onset.critical_speed), rel=0.01)
    assert float(by_table.frequency) == pytest.approx(float(onset.frequency), rel=0.01)
    assert float(about[2.5].critical_speed) > 1.2 * float(onset.critical_speed)


def test_linear_loads_do_not_depend_on_the_amplitude() -> None:
    small, large = (answers(PLATE, amplitude_deg=one).derivatives for one in (0.5, 4.0))
    assert large.values == pytest.approx(small.values, rel=1e-6)


def test_slow_motion_has_the_slopes_of_the_polar() -> None:
    """K^2 H3 and K^2 A3 go to -dc_l/dtheta and dc_m/dtheta of the plate's own polar at 1 deg."""
    raw = {"embedded": {"separation": ATTACHED}, "flow": {"incidence_deg": 1.0}}
    found = answers(
        raw, reduced_velocity=[100, 130, 200, 400], motion="harmonic", amplitude_deg=0.1
    )
    polar, _ = Adapter.from_config(load_config(raw), "coarse").section_loads
    step = math.radians(0.1)
    at = math.radians(1.0) + np.array([-step, step])
    lift = np.diff(polar.lift_coefficient(at))[0] / (2.0 * step)
    moment = np.diff(polar.moment_coefficient(at))[0] / (2.0 * step)
    square = (math.tau / 400.0) ** 2
    assert -square * found.derivatives.values[-1, 2] == pytest.approx(lift, rel=0.03)
    assert square * found.derivatives.values[-1, 6] == pytest.approx(moment, rel=0.03)


def test_loads_that_are_not_linear_are_said_to_be() -> None:
    """Over the bend of the polar at 2.5 deg, where the bubble grows, the loads have harmonics."""
    found = answers({}, motion="harmonic", amplitude_deg=4.0)
    assert any("not at the frequencies of the motion" in remark for remark in found.remarks)
    assert not answers(PLATE, motion="harmonic").remarks


def test_motion_beyond_the_polar_has_no_derivatives() -> None:
    with pytest.raises(ResultFileError, match=r"forced case pitch: .*forced\.amplitude_deg"):
        answers({}, amplitude_deg=15.0)


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        ({"forced": {"reduced_velocity": [4, 3, 6, 8]}}, "forced.reduced_velocity.1"),
        ({"forced": {"run": True}, "derivatives": {"table": "own.csv"}}, "derivatives.table"),
        ({"forced": {"reduced_velocity": [4, 6, 8]}}, "forced.reduced_velocity"),
        ({"forced": {"amplitude_deg": 0}}, "forced.amplitude_deg"),
        ({"forced": {"motion": "chirp"}}, "forced.motion"),
    ],
)
def test_configuration_that_is_no_motion_is_refused(raw: dict[str, Any], said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        load_config(raw)


def test_scripts_leave_a_table_and_its_fits(
    load_script: Callable[[str], ModuleType], tmp_path: Path
) -> None:
    raw = {**PLATE, "forced": {"run": True}}
    case_file = tmp_path / "cases" / "forced.json"
    names = forced_names(load_config(raw))
    assert names == ("pitch", "heave")
    load_script("forced_cases").main(raw, names, case_file)
    attributes = run_cases(
        read_cases(case_file), tmp_path / "forced", tmp_path / "store", tmp_path / "progress.json"
    )
    write_index(tmp_path / "forced" / "forced.json", attributes)
    table, fits = tmp_path / "2d.csv", tmp_path / "2d-fit.csv"
    load_script("forced_derivatives").main(
        [case_file], tmp_path / "forced" / "forced.json", table, fits
    )
    assert Derivatives.read(table).label == "forced motion, solver embedded, thin"
    assert fits.read_text().startswith("case,component,load,reduced_velocity,mean,rest\n")


def openfoam_case(component: str, frequency: float) -> ForcedCase:
    raw = {"solver": "openfoam", "flow": {"incidence_deg": 1.0}, "unsteady": {"time_step": 0.02}}
    config = load_config({**raw, "forced": {"run": True, "motion": "harmonic"}})
    solver = solver_from_config(config, "coarse")
    name = f"{component}_v{math.tau / frequency:.12g}"
    return forced_case(config, name, solver)


@pytest.mark.parametrize("component", ["pitch", "heave"])
def test_table_of_openfoam_is_the_motion_of_the_case(component: str, tmp_path: Path) -> None:
    """Nose up is a negative angle about z, in degrees; heave is along y."""
    case = openfoam_case(component, 1.0)
    mesh = mesh_of(case, 0.6)
    run = ForcedRun(Installation(()), case, mesh, Coupling(), tmp_path)
    lines = run.table().splitlines()
    rows = [line.replace("(", " ").replace(")", " ").split() for line in lines[2:-1]]
    time, _, up, _, _, _, angle = np.array(rows, dtype=np.float64).T
    assert int(lines[0]) == len(rows)
    assert time[0] < 0.0 < case.duration < time[-1]
    (only,) = case.harmonics
    late = time > case.ramp
    moved = only.amplitude * np.cos(only.frequency * time + only.phase)
    column = -np.radians(angle) if component == "pitch" else up
    assert column[late] == pytest.approx(moved[late], abs=1e-9)
    assert not (up if component == "pitch" else angle).any()
    assert isinstance(ForcedResult(time, up, up, up, up).of_case(case).attrs["component"], str)
