"""Rigid flows followed from outside: what counts does not depend on when an end was noticed."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.watching import nothing

from equisection.solvers.openfoam import rigid_flow
from equisection.solvers.openfoam.process import Watch
from equisection.solvers.openfoam.reading.loads import Loads
from equisection.solvers.openfoam.rigid_flow import (
    FLOOR_OF_OUTLINE,
    ITERATIONS_TO_LOOK,
    MOST,
    STARTS_AFTER,
    RigidFlowRecord,
    follow_iterations,
    follow_unsteady,
    follow_until_even,
    has_converged,
    may_start_motion,
    method_of_mean,
    of_outline,
)

RECORD = RigidFlowRecord(10.0, 40.0, 100.0)


def settling(time: np.ndarray, rate: float) -> Loads:
    """Loads that come to 0.1, 0.4 and 0.05 at a rate."""
    rest = 1 + np.exp(-rate * time)
    return Loads(time, 0.1 * rest, 0.4 * rest, 0.05 * rest)


def polled(
    monkeypatch: pytest.MonkeyPatch, whole: Loads, interval: float
) -> Callable[[Watch], None]:
    """A solver whose log is read every so many iterations, or units of time."""

    def run(watch: Watch) -> None:
        now = 0.0
        while now < whole.time[-1]:
            now = min(now + interval, float(whole.time[-1]))
            seen = whole.until(now)
            monkeypatch.setattr(rigid_flow, "read_loads", lambda folder, seen=seen: seen)
            if watch(now):
                break

    return run


@pytest.mark.parametrize("interval", [1.0, 7.0, 23.0, 171.0])
def test_steady_loads_end_at_the_first_look_that_finds_them_converged(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, interval: float
) -> None:
    whole = settling(np.arange(1.0, MOST + 1), 0.01)
    run = polled(monkeypatch, whole, interval)
    loads, converged = follow_iterations(tmp_path, has_converged, nothing, run)
    assert converged
    assert loads.time[-1] % ITERATIONS_TO_LOOK == 0
    assert has_converged(loads)
    assert not has_converged(whole.until(loads.time[-1] - ITERATIONS_TO_LOOK))


def test_steady_loads_that_do_not_converge_are_all_there(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    time = np.arange(1.0, MOST + 1)
    waving = 0.4 + 0.01 * np.sin(0.3 * time)
    run = polled(monkeypatch, Loads(time, waving, waving, waving), 7.0)
    loads, converged = follow_iterations(tmp_path, has_converged, nothing, run)
    assert not converged
    assert loads.time[-1] == MOST


@pytest.mark.parametrize(("hunts_by", "may_start"), [(1e-3, True), (4e-3, True), (6e-3, False)])
def test_flow_that_hunts_a_little_starts_a_motion_and_has_not_converged(
    hunts_by: float, may_start: bool
) -> None:
    time = np.arange(1.0, STARTS_AFTER + 1)
    load = 0.4 * (1 + hunts_by * np.sin(0.3 * time))
    loads = Loads(time, load, load, load)
    assert not has_converged(loads)
    assert may_start_motion(loads) == may_start
    assert not may_start_motion(loads.until(STARTS_AFTER - 1))


@pytest.mark.parametrize("interval", [0.02, 0.1, 3.3, 17.0])
def test_mean_is_of_the_first_record_whose_halves_agree(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, interval: float
) -> None:
    # halves of T: exp(-10 r) (1 - exp(-r T/2))^2/(r T/2) apart, which is 1 % at T = 66
    whole = settling(0.02 * np.arange(1.0, 5501), 0.25)
    record = follow_unsteady(tmp_path, RECORD, nothing, polled(monkeypatch, whole, interval))
    assert record.time[0] > RECORD.discarded
    assert record.time[-1] == pytest.approx(80.0)
    assert record.halves().drift() <= rigid_flow.KNOWN
    assert "mean of unsteady over 70 c/V" in method_of_mean(record, RECORD)


def test_vortices_that_build_up_do_not_count_as_known(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The wake of a bluff body sheds late: at first its means agree, and are not those to come."""
    time = 0.02 * np.arange(1.0, 5501)
    amplitude = 1.0 / (1.0 + np.exp(-0.2 * (time - 70.0)))
    vortices = 0.2 * amplitude * np.sin(2 * np.pi * 0.15 * time)
    whole = Loads(time, np.full_like(time, 1.5), vortices, 0.1 * vortices)
    means = replace(RECORD, floor=FLOOR_OF_OUTLINE)
    by_means = follow_unsteady(tmp_path, means, nothing, polled(monkeypatch, whole, 3.3))
    assert by_means.time[-1] == pytest.approx(50.0)
    assert "fluctuation" not in method_of_mean(by_means, means)
    even = of_outline(RECORD)
    record = follow_unsteady(tmp_path, even, nothing, polled(monkeypatch, whole, 3.3))
    assert record.time[-1] == pytest.approx(RECORD.end)
    seven = round(7 / 0.15 / 0.02)  # periods, the most in half of the 15 of the record
    first, last = amplitude[500 : 500 + seven], amplitude[-seven:]
    halves = (np.sqrt(np.mean(first**2)), np.sqrt(np.mean(last**2)))
    said = re.search(
        r"fluctuation (\d+) times as large in the second", method_of_mean(record, even)
    )
    assert said
    assert float(said[1]) == pytest.approx(halves[1] / halves[0], rel=0.05)
    steady = Loads(time, whole.drag, 0.0 * time, 0.0 * time)
    record = follow_unsteady(tmp_path, even, nothing, polled(monkeypatch, steady, 3.3))
    assert record.time[-1] == pytest.approx(50.0)
    assert "fluctuation" not in method_of_mean(record, even)


@pytest.mark.parametrize(
    ("setting_in", "said"),
    [(80.0, "over 40 c/V behind 110 c/V, 6 periods"), (-50.0, "over 40 c/V, 6 periods")],
)
def test_flow_whose_vortices_set_in_late_goes_on_until_they_are_even(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, setting_in: float, said: str
) -> None:
    """An H section sheds from 60 c/V on; the mean over both flows is of neither."""
    wanted, ran, shares = of_outline(RECORD), [], []
    step = 0.02 * np.arange(1.0, 5501)

    def run(source: Path, folder: Path, watch: Watch) -> None:
        time = step + wanted.end * len(ran)
        size = 1.0 / (1.0 + np.exp(-0.2 * (time - setting_in)))
        lift = 0.2 * size * np.sin(2 * np.pi * 0.15 * time)
        ran.append((source.name, folder.name))
        polled(monkeypatch, Loads(step, 1.0 + 0.5 * size, lift, 0.1 * lift), 3.3)(watch)

    def tell(done: float, total: float) -> None:
        shares.append(done / total)

    folder, record, method = follow_until_even(tmp_path / "steady", tmp_path, wanted, tell, run)
    assert wanted.is_even(record)
    assert said in method
    assert record.means()[0] == pytest.approx(1.5, abs=0.01)
    late = setting_in > 70.0
    assert ran == [("steady", "unsteady"), ("unsteady", "unsteady2")][: 2 if late else 1]
    assert folder.name == ("unsteady2" if late else "unsteady")
    assert np.all(np.diff(shares) > 0)


def test_flow_that_never_is_even_ends_after_its_turns_and_says_so(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    wanted, ran = of_outline(RECORD), []
    step = 0.02 * np.arange(1.0, 5501)

    def run(source: Path, folder: Path, watch: Watch) -> None:
        time = step + wanted.end * len(ran)
        lift = 0.01 * np.exp(0.02 * time) * np.sin(2 * np.pi * 0.15 * time)
        ran.append(folder.name)
        polled(monkeypatch, Loads(step, 1.0 + 0.0 * time, lift, lift), 3.3)(watch)

    _, _, method = follow_until_even(tmp_path / "steady", tmp_path, wanted, nothing, run)
    assert ran == ["unsteady", "unsteady2"]
    assert "times as large in the second" in method


@pytest.mark.parametrize("strouhal", [0.11, 0.131, 0.146, 0.24])
def test_mean_of_even_shedding_is_known_at_once_and_of_whole_periods(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, strouhal: float
) -> None:
    """Parts of a period in the halves would leave their means some 0.01 of the lift apart."""
    time = 0.02 * np.arange(1.0, 5501)
    lift = 0.003 + 0.3 * np.sin(2 * np.pi * strouhal * time + 1.0)
    drag = 1.5 + 0.05 * np.sin(4 * np.pi * strouhal * time)
    whole = Loads(time, drag, lift, 0.1 * lift)
    wanted = of_outline(RECORD)
    record = follow_unsteady(tmp_path, wanted, nothing, polled(monkeypatch, whole, 3.3))
    assert record.time[-1] == pytest.approx(50.0)
    periods = (record.time[-1] - record.time[0]) * strouhal
    assert periods == pytest.approx(np.floor(40.0 * strouhal), abs=0.02)
    assert record.means()[1] == pytest.approx(0.003, abs=5e-4)
    assert f"{periods:.0f} periods" in method_of_mean(record, wanted)
    # by the halves of the time alone it goes on
    by_time = replace(wanted, by_periods=False)
    record = follow_unsteady(tmp_path, by_time, nothing, polled(monkeypatch, whole, 3.3))
    assert record.time[-1] > 50.0


@pytest.mark.parametrize(("periods", "whole"), [(3.9, 3), (3.99, 4), (4.0, 4), (4.3, 4)])
def test_period_that_lacks_next_to_nothing_is_whole(periods: float, whole: int) -> None:
    """A frequency is known no better; a record is never longer than it is."""
    step, period = 0.02, 7.0
    time = step * np.arange(1.0, round(periods * period / step) + 1)
    lift = np.sin(2 * np.pi * time / period)
    loads = Loads(time, lift, lift, lift)
    part = loads.in_whole_periods(period)
    assert part.time.size * step / period == pytest.approx(min(whole, periods), abs=0.01)
    assert part.time[-1] == time[-1]
    halves = loads.halves(period)
    assert halves.first.time.size * step / period == pytest.approx(whole // 2, abs=0.01)
    assert halves.first.time.size == halves.last.time.size


def test_record_goes_on_to_the_longest(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    time = 0.02 * np.arange(1.0, 5501)
    drifting = 0.4 + 0.01 * time
    run = polled(monkeypatch, Loads(time, drifting, drifting, drifting), 3.3)
    record = follow_unsteady(tmp_path, RECORD, nothing, run)
    assert record.time[-1] == pytest.approx(RECORD.end)


def test_what_is_told_of_a_run_that_goes_on_unsteadily_never_goes_back(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shares: list[float] = []

    def tell(done: float, total: float) -> None:
        shares.append(done / total)

    iterations = np.arange(1.0, MOST + 1)
    waving = 0.4 + 0.01 * np.sin(0.3 * iterations)
    steady = Loads(iterations, waving, waving, waving)
    follow_iterations(tmp_path, has_converged, tell, polled(monkeypatch, steady, 100.0))
    time = 0.02 * np.arange(1.0, 5501)
    drifting = Loads(time, 0.4 + time, 0.4 + time, 0.4 + time)

    def run(source: Path, folder: Path, watch: Watch) -> None:
        polled(monkeypatch, drifting, 5.0)(watch)

    follow_until_even(tmp_path / "steady", tmp_path, RECORD, tell, run)
    assert np.all(np.diff(shares) > 0)
    assert shares[-1] == pytest.approx(1.0)
