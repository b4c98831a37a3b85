"""``equisection status``: what it says of cases in every state."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from tests.run_by_hand import GONE, PARTS, Run, unsteady

from equisection.cases import (
    SteadyCase,
    case_hash,
    write_cases,
)
from equisection.run import status_text
from equisection.run.command_line import main
from equisection.run.status import State, run_status
from equisection.run.status_logs import last_error
from equisection.store.progress import Process


@pytest.fixture
def run(tmp_path: Path) -> Run:
    return Run(tmp_path / "results")


ERROR = "2026-01-01 10:00:01,000 ERROR the mesh has a hole; mend it\n"


class TestStates:
    def test_done(self, run: Run) -> None:
        run.finished(6.0, "limit-cycle")
        entry = run.entry("k6")
        assert (entry.state, entry.regime) == (State.DONE, "limit-cycle")

    def test_loads_that_zigzag_are_told_beside_the_verdict(self, run: Run) -> None:
        run.finished(6.0, "settled", "at rest", loads_zigzag=0.0641)
        run.finished(7.0, "settled", "at rest", loads_zigzag=0.0041)
        text = run.entry("k6").text
        assert text.startswith("at rest; not converged in its time step: ")
        assert "6.4 %" in text
        assert run.entry("k7").text == "at rest"

    def test_a_failed_run_gives_its_reason(self, run: Run) -> None:
        run.finished(6.0, "failed", "left the polar")
        entry = run.entry("k6")
        assert (entry.state, entry.text) == (State.FAILED, "left the polar")

    def test_the_cases_of_a_batch_are_told_apart(self, run: Run) -> None:
        cases = {f"k{k:g}": unsteady(k) for k in (10.0, 6.0, 8.0)}
        write_cases(run.folder / "cases/unsteady/2d/sweep.json", cases)
        result = run.folder / "unsteady/2d/k8.nc"
        run.result(result, case_hash=case_hash(cases["k8"]), regime="settled", reason="at rest")
        entries = run_status(run.folder).entries
        assert [entry.case for entry in entries] == ["k6", "k8", "k10"]
        assert [entry.state for entry in entries] == [State.WAITING, State.DONE, State.WAITING]

    def test_a_case_in_a_batch_and_on_its_own_is_listed_once(self, run: Run) -> None:
        run.case(6.0)
        write_cases(run.folder / "cases/unsteady/2d/sweep.json", {"k6": unsteady(6.0)})
        assert len(run_status(run.folder).entries) == 1

    def test_waiting(self, run: Run) -> None:
        run.case(6.0)
        assert run.entry("k6").state is State.WAITING

    def test_waiting_with_a_result_in_the_store(self, run: Run) -> None:
        store = run.folder.parent / ".store" / run.case(6.0)
        run.result(store / "result.nc")
        assert "in the store" in run.entry("k6").text

    def test_running(self, run: Run) -> None:
        run.job(6.0, Process.this())
        entry = run.entry("k6")
        assert entry.state is State.RUNNING
        assert entry.job is not None
        assert entry.job.fraction == 0.25

    def test_a_warning_is_told_while_the_job_runs(self, run: Run) -> None:
        run.job(6.0, Process.this())
        run.log("unsteady_2d_k6", "2026-01-01 10:00:01,000 WARNING the loads zigzag\n")
        run.job(7.0, Process.this())
        entry = run.entry("k6")
        assert (entry.state, entry.text) == (State.RUNNING, "the loads zigzag")
        assert run.entry("k7").text == ""

    def test_a_killed_job_does_not_run(self, run: Run) -> None:
        run.job(6.0, GONE)
        entry = run.entry("k6")
        assert entry.state is State.STOPPED
        assert "25 %" in entry.text

    def test_a_job_that_ended_with_an_error_failed(self, run: Run) -> None:
        run.job(6.0, GONE)
        run.log("unsteady_2d_k6", ERROR)
        entry = run.entry("k6")
        assert (entry.state, entry.text) == (State.FAILED, "the mesh has a hole; mend it")

    def test_the_log_of_a_batch_counts_for_each_of_its_cases(self, run: Run) -> None:
        run.case(6.0)
        run.log("unsteady_2d", ERROR)
        assert run.entry("k6").state is State.FAILED

    def test_an_error_from_before_the_case_was_written_is_not_its(self, run: Run) -> None:
        run.log("unsteady_2d", ERROR)
        os.utime(run.folder / "logs/unsteady_2d.log", (1e9, 1e9))
        run.case(6.0)
        assert run.entry("k6").state is State.WAITING

    def test_a_job_that_runs_again_is_not_failed(self, run: Run) -> None:
        run.job(6.0, Process.this())
        run.log("unsteady_2d_k6", ERROR)
        assert run.entry("k6").state is State.RUNNING

    def test_a_truncated_result(self, run: Run) -> None:
        path = run.finished(6.0, "settled")
        path.write_bytes(path.read_bytes()[:-200])
        entry = run.entry("k6")
        assert entry.state is State.BROKEN
        assert "truncated" in entry.text
        assert "run again" in entry.text

    def test_a_foreign_result(self, run: Run) -> None:
        path = run.finished(6.0, "settled")
        run.result(path, case_hash="0" * 64, regime="settled", reason="")
        entry = run.entry("k6")
        assert entry.state is State.STALE
        assert "another case" in entry.text

    @pytest.mark.parametrize("text", ["", "{", "{}", "\x00\x01"])
    def test_a_case_file_that_is_none(self, run: Run, text: str) -> None:
        run.case(6.0)
        (run.folder / "cases/unsteady/2d/k6.json").write_text(text)
        assert run.entry("k6").state is State.BROKEN

    def test_steady_cases(self, run: Run) -> None:
        case = SteadyCase(dimension="3d", **PARTS)  # type: ignore[arg-type]
        for name, failure in (("coarse_a0", ""), ("coarse_a10", "left the polar")):
            write_cases(run.folder / f"cases/steady/3d/{name}.json", {name: case})
            path = run.folder / f"steady/3d/{name}.nc"
            run.result(path, case_hash=case_hash(case), failure=failure)
        assert run.entry("coarse_a0").state is State.DONE
        assert run.entry("coarse_a10").text == "left the polar"

    def test_by_ascending_k_star(self, run: Run) -> None:
        for k_star in (21.0, 4.5, 10.0, 4.0):
            run.case(k_star)
        names = [entry.case for entry in run_status(run.folder).entries]
        assert names == ["k4", "k4.5", "k10", "k21"]

    def test_cases_of_an_earlier_sweep_are_left_out(self, run: Run) -> None:
        run.case(6.0)
        run.case(7.0)
        resolved = run.folder / "config.resolved.yaml"
        resolved.write_text("sweep: {k_star: [7.0]}\n")
        os.utime(resolved, (2e9, 2e9))
        assert [entry.case for entry in run_status(run.folder).entries] == ["k7"]

    def test_cases_that_are_newer_than_the_configuration_are_not(self, run: Run) -> None:
        resolved = run.folder / "config.resolved.yaml"
        resolved.write_text("sweep: {k_star: [7.0]}\n")
        os.utime(resolved, (1e9, 1e9))
        run.case(6.0)
        assert run.entry("k6").state is State.WAITING


def test_a_fault_of_the_program_gives_its_last_line(tmp_path: Path) -> None:
    log = tmp_path / "a.log"
    log.write_text(ERROR + "Traceback (most recent call last):\n  File\nValueError: no\n")
    assert "ValueError: no" in last_error(log)


def test_errors_of_other_jobs_are_told(run: Run) -> None:
    run.log("modes", ERROR)
    (trouble,) = run_status(run.folder).troubles
    assert "modes.log" in trouble
    assert "the mesh has a hole" in trouble


class TestCommand:
    @pytest.fixture(autouse=True)
    def _here(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.chdir(tmp_path)
        monkeypatch.setenv("COLUMNS", "120")

    def test_nothing_there(self, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["status"]) == 0
        assert "There is no run" in capsys.readouterr().out

    def test_a_missing_folder(self, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["status", "results/nowhere"]) == 1
        told = capsys.readouterr()
        assert told.out == ""
        assert told.err.startswith("error: results/nowhere: no such folder")

    def test_a_run_without_cases(self, run: Run, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["status", str(run.folder)]) == 0
        assert "no case has been written yet" in capsys.readouterr().out

    def test_table_and_summary(self, run: Run, capsys: pytest.CaptureFixture[str]) -> None:
        run.finished(6.0, "growing")
        run.job(7.0, Process.this())
        run.case(8.0)
        assert main(["status"]) == 0
        told = capsys.readouterr().out
        assert "running 25 %" in told
        assert "beam: sweep 1 of 3 done, 1 running, 1 waiting (1 growing)" in told

    def test_all_runs_of_results_and_nothing_else(
        self, run: Run, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        run.case(6.0)
        Run(tmp_path / "results", "another").case(6.0)
        (tmp_path / "results/reference").mkdir()
        assert main(["status"]) == 0
        told = capsys.readouterr().out
        assert "another:" in told
        assert "beam:" in told
        assert "reference" not in told

    def test_plain(self, run: Run, capsys: pytest.CaptureFixture[str]) -> None:
        run.job(6.0, Process.this())
        run.finished(7.0, "failed", "two\nlines\tand a tab")
        assert main(["status", "--plain"]) == 0
        lines = [line.split("\t") for line in capsys.readouterr().out.splitlines()]
        assert tuple(lines[0]) == status_text.PLAIN_COLUMNS
        assert {len(line) for line in lines} == {len(lines[0])}
        assert lines[1][:6] == ["beam", "2d", "k6", "running", "", "25.0"]
        assert lines[2][-1] == "two lines and a tab"

    def test_markup_in_a_reason_is_text(self, run: Run, capsys: pytest.CaptureFixture[str]) -> None:
        run.finished(6.0, "failed", "no key [/nothing] here")
        assert main(["status"]) == 0
        assert "[/nothing]" in capsys.readouterr().out

    def test_help_and_version(self, capsys: pytest.CaptureFixture[str]) -> None:
        assert main([]) == 0
        assert "status" in capsys.readouterr().out
        with pytest.raises(SystemExit) as end:
            main(["--version"])
        assert end.value.code == 0
        assert capsys.readouterr().out.startswith("equisection 0.")
