"""Progress of a job: its file, its log, its bar, and whether its process still lives."""

from __future__ import annotations

import io
import json
import logging
import math
import os
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from equisection.store import progress, progress_bar
from equisection.store.progress import (
    JobProgress,
    Process,
    Snapshot,
    clock,
    label_of,
    read_snapshot,
)
from equisection.store.progress_bar import Bar


def snapshot(**changes: object) -> Snapshot:
    made = Snapshot(
        cases=("abc",),
        title="a solver",
        unit="c/V",
        done=30.0,
        total=100.0,
        started=1000.0,
        updated=1060.0,
        first_done=0.0,
        first_time=1000.0,
        process=Process.this(),
    )
    return replace(made, **changes)  # type: ignore[arg-type]


class TestSnapshot:
    def test_estimated_end(self) -> None:
        assert snapshot().estimated_end == pytest.approx(1200.0)

    def test_a_resumed_job_does_not_count_what_it_found(self) -> None:
        """80 of 100 were there; 10 more took 60 s, so the last 10 take 60 s again."""
        assert snapshot(first_done=80.0, done=90.0).estimated_end == pytest.approx(1120.0)

    def test_no_estimate_without_a_rate(self) -> None:
        assert snapshot(done=0.0).estimated_end is None
        assert snapshot(first_time=1060.0).estimated_end is None

    def test_fraction_before_the_solver_told_anything(self) -> None:
        assert snapshot(done=0.0, total=0.0).fraction == 0.0

    def test_words(self) -> None:
        words = snapshot().words()
        for part in ("30 of 100 c/V (30 %)", f"since {clock(1000.0)}", f"about {clock(1200.0)}"):
            assert part in words

    def test_lives_on_another_machine_until_it_is_silent_for_long(self) -> None:
        there = snapshot(process=Process("elsewhere", 1, ""))
        assert there.lives(now=1061.0)
        assert not there.lives(now=1061.0 + progress.SILENCE)

    def test_few_words_fit_beside_a_bar(self) -> None:
        now = time.time()
        state = snapshot(started=now, first_time=now, updated=now + 1e-3, done=5599.0, total=5600.0)
        words = state.few_words()
        assert len("unsteady 2d-corrected " + 19 * "-" + words) <= 80


class TestProcess:
    def test_this_one_lives(self) -> None:
        assert Process.this().lives()

    @pytest.mark.parametrize(("shown", "lives"), [(None, True), ("", True), ("1", False)])
    def test_another_users_lives_unless_the_system_shows_that_it_is_another(
        self, monkeypatch: pytest.MonkeyPatch, shown: str | None, lives: bool
    ) -> None:
        """A system may hide the processes of other users (``hidepid``)."""

        def forbidden(pid: int, number: int) -> None:
            raise PermissionError

        process = replace(Process.this(), birth="2")
        monkeypatch.setattr(progress.os, "kill", forbidden)
        monkeypatch.setattr(progress, "_birth", lambda pid: shown)
        assert process.lives() is lives

    def test_one_that_ended_does_not(self) -> None:
        with subprocess.Popen([sys.executable, "-c", ""]) as child:
            process = replace(Process.this(), pid=child.pid, birth="")
        assert process.lives() is False

    @pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="no /proc here")
    def test_another_one_with_its_number_does_not(self) -> None:
        assert replace(Process.this(), birth="1").lives() is False

    @pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="no /proc here")
    def test_one_that_ended_and_was_not_yet_collected_does_not(self) -> None:
        with subprocess.Popen([sys.executable, "-c", ""]) as child:
            os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
            assert replace(Process.this(), pid=child.pid, birth="").lives() is False


class TestJobProgress:
    def test_the_file_tells_the_state_and_goes_when_the_job_ends_well(self, tmp_path: Path) -> None:
        path = tmp_path / "unsteady_2d_k6.progress.json"
        with JobProgress(path, ["abc", "def"], "a solver") as job:
            started = read_snapshot(path)
            assert started is not None
            assert started.lives()
            assert started.fraction == 0.0
            job.update(30.0, 100.0)
            job.update(100.0, 100.0)
            told = read_snapshot(path)
            assert told is not None
            assert told.cases == ("abc", "def")
            assert (told.first_done, told.done, told.fraction) == (30.0, 100.0, 1.0)
        assert not path.exists()

    def test_the_file_stays_when_the_job_fails(self, tmp_path: Path) -> None:
        path = tmp_path / "a.progress.json"
        job = JobProgress(path, ["abc"], "a solver")

        def fail() -> None:
            with job:
                job.update(10.0, 100.0)
                raise RuntimeError

        with pytest.raises(RuntimeError):
            fail()
        assert read_snapshot(path) is not None

    def test_the_log_tells_time_simulated_since_when_and_until_when(
        self,
        tmp_path: Path,
        caplog: pytest.LogCaptureFixture,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        now = iter(range(1000, 2000, 5))
        monkeypatch.setattr(progress.time, "time", lambda: float(next(now)))
        with (
            caplog.at_level(logging.INFO),
            JobProgress(tmp_path / "a.progress.json", ["abc"], "a solver") as job,
        ):
            for done in range(10):
                job.update(10.0 * done, 100.0)
        told = [record.message for record in caplog.records if " of 100 c/V" in record.message]
        assert len(told) >= 3
        assert all("since" in line and "ends about" in line for line in told)
        assert "ended well" in caplog.messages[-1]

    def test_not_every_update_is_logged(
        self, tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(progress.time, "time", lambda: 1000.0)
        with (
            caplog.at_level(logging.INFO),
            JobProgress(tmp_path / "a.progress.json", ["abc"], "a solver") as job,
        ):
            for done in range(1000):
                job.update(float(done), 1000.0)
        assert len(caplog.messages) == 2

    def test_alone_but_for_jobs_that_are_gone(self, tmp_path: Path) -> None:
        with JobProgress(tmp_path / "a.progress.json", ["abc"], "a solver") as job:
            assert job._is_alone()
            gone = snapshot(process=replace(Process.this(), birth="1", pid=2**22 + 1))
            write(tmp_path / "b.progress.json", gone)
            assert job._is_alone()
            write(tmp_path / "c.progress.json", snapshot())
            assert not job._is_alone()


def write(path: Path, state: Snapshot) -> None:
    raw = {**state.__dict__, "process": state.process.__dict__}
    path.write_text(json.dumps(raw), encoding="utf-8")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"cases": []}', '{"process": 1}', "\x00"])
def test_a_file_that_is_none_is_not_read(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.progress.json"
    path.write_text(text, encoding="utf-8")
    assert read_snapshot(path) is None


@pytest.mark.parametrize(
    ("key", "value"),
    [
        *[("done", value) for value in ("30", None, [], math.nan, 1e400)],
        *[("started", value) for value in ("now", -1.0, 1e30, math.nan)],
        *[("title", 5), ("cases", [5]), ("cases", 5), ("unit", {})],
        *[("process", {"host": "a", "pid": pid, "birth": ""}) for pid in (-1, 2**40, "7")],
        ("process", {"host": 5, "pid": 7, "birth": ""}),
    ],
)
def test_a_file_with_a_wrong_value_is_not_read(tmp_path: Path, key: str, value: object) -> None:
    path = tmp_path / "a.progress.json"
    write(path, snapshot())
    assert read_snapshot(path) == snapshot()
    raw = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps(raw | {key: value}), encoding="utf-8")
    assert read_snapshot(path) is None


def test_label() -> None:
    assert label_of(Path("logs/unsteady_3d_k6.44.progress.json")) == "unsteady 3d k6.44"


class TestBar:
    @pytest.fixture
    def screen(self, monkeypatch: pytest.MonkeyPatch) -> io.StringIO:
        monkeypatch.setattr(progress_bar, "PATIENCE", 0.0)
        monkeypatch.setattr(progress_bar, "LINE_INTERVAL", 0.0)
        return io.StringIO()

    def bar(self, screen: io.StringIO) -> Bar:
        console = Console(file=screen, force_terminal=True, width=100)
        return Bar(console, "unsteady 2d")

    def test_lines_beside_others_have_no_cursor_movement(self, screen: io.StringIO) -> None:
        bar = self.bar(screen)
        for percent in range(0, 101, 2):
            bar.show(percent / 100, f"{percent} %", alone=False)
        bar.close()
        shown = screen.getvalue()
        assert "\x1b" not in shown
        assert "\r" not in shown
        assert len(shown.splitlines()) == 10
        assert shown.splitlines()[4] == "unsteady 2d  [#####-----]  50 %"

    def test_a_slow_job_shows_a_sign_before_its_next_tenth(
        self, screen: io.StringIO, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(progress_bar, "LINE_INTERVAL_OF_SLOW_RUN", 0.0)
        self.bar(screen).show(0.03, "3 %", alone=False)
        assert screen.getvalue() == "unsteady 2d  [----------]  3 %\n"

    def test_a_moving_bar_goes_when_another_job_comes(self, screen: io.StringIO) -> None:
        bar = self.bar(screen)
        bar.show(0.3, "30 %", alone=True)
        assert "\x1b" in screen.getvalue()
        bar.show(0.41, "41 %", alone=False)
        assert screen.getvalue().endswith("unsteady 2d  [####------]  41 %\n")
        assert bar._moving is None

    def test_nothing_of_a_job_that_ends_at_once(
        self, screen: io.StringIO, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(progress_bar, "PATIENCE", 60.0)
        self.bar(screen).show(1.0, "100 %", alone=True)
        assert screen.getvalue() == ""
