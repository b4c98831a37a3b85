"""What the status says of time, place, cost and failures, on a terminal and as a page."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
import yaml
from tests.conftest import ROOT
from tests.run_by_hand import GONE, Run
from tests.sample_cases import UNSTEADY

from equisection.cases import FREE, Case, SolverBlock, UnsteadyCase, history_hash, write_cases
from equisection.config import load_config, resolve_config
from equisection.run import cost
from equisection.run.command_line import main
from equisection.run.status import State, run_status
from equisection.run.status_words import core_time, estimated_end, where_of
from equisection.store.index import write_index
from equisection.store.lock import FOLDER, Owner
from equisection.store.progress import Process

OPENFOAM = SolverBlock(name="openfoam", version="3", settings={})
CONFIG = {"solver": "openfoam", "sweep": {"models": ["2d"]}, "unsteady": {"time_step": 0.02}}
CONFIG |= {"steady": {"beam_polar": "config/polars/paper_plate_3d.csv"}}


def one_by_one(k_star: float) -> UnsteadyCase:
    return UNSTEADY.model_copy(update={"k_star": k_star, "solver": OPENFOAM})


def write_case(run: Run, name: str, case: Case) -> None:
    write_cases(run.folder / f"cases/unsteady/2d/{name}.json", {name: case})


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    return Run(tmp_path / "results")


def test_simulated_time_of_what_is_done_and_of_what_runs(run: Run) -> None:
    run.result(
        run.folder / "unsteady/2d/k6.nc", case_hash=run.case(6.0), regime="settled", end_time=120.0
    )
    run.job(7.0, Process.this())
    assert (run.entry("k6").simulated, run.entry("k6").duration) == (120.0, 400.0)
    assert run.entry("k7").simulated == pytest.approx(100.0)


def test_where_a_case_runs_and_by_whom(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SLURM_JOB_ID", "4711")
    case = one_by_one(6.0)
    write_case(run, "k6", case)
    file = run.folder.parent / ".store" / history_hash(case) / FOLDER / "1.json"
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps(asdict(Owner.this())))
    entry = run.entry("k6")
    assert entry.state is State.RUNNING  # of another workflow: this one has no progress file
    assert where_of(entry).startswith("SLURM job 4711, process ")
    file.write_text(json.dumps(asdict(replace(Owner.this(), ended=1.0))))
    assert run.entry("k6").state is State.WAITING


def test_cost_of_what_is_done_and_by_the_model_of_what_is_not(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = load_config(CONFIG)
    (run.folder / "config.resolved.yaml").write_text(yaml.safe_dump(resolve_config(config)))
    monkeypatch.chdir(ROOT)
    for name, k_star in (("k6.44", 6.44), ("k7", 7.0)):
        write_case(run, name, one_by_one(k_star))
    status = run_status(run.folder)
    model = cost.read_cost_model(ROOT / "workflow/profiles/cost.yaml")
    one = cost.seconds(cost.work_of(config, FREE, "2d", "coarse"), model.of("openfoam", "2d"))
    assert status.core_seconds_to_come() == pytest.approx(2 * one)
    assert status.core_seconds_used() == 0.0


def test_cost_is_unknown_without_a_configuration(run: Run) -> None:
    run.case(6.0)
    assert run_status(run.folder).core_seconds_to_come() is None


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(None, "unknown"), (90, "90 core seconds"), (600, "10 core minutes"), (9e4, "25 core hours")],
)
def test_core_time_in_words(seconds: float | None, words: str) -> None:
    assert core_time(seconds) == words


def test_end_of_the_run_at_the_rate_of_now(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    run.job(7.0, Process.this())  # 100 of 400 c/V in 50 s
    run.case(8.0)  # 400 c/V more
    monkeypatch.setattr("time.time", lambda: 1.0e9 + 50)
    assert estimated_end(run_status(run.folder)) == pytest.approx(1.0e9 + 50 + 700 / 2.0)


def test_last_lines_of_the_log_of_what_failed(run: Run, capsys: pytest.CaptureFixture[str]) -> None:
    case = one_by_one(6.0)
    write_case(run, "k6", case)
    run.log("unsteady_2d_k6", "2026-01-01 10:00:01,000 ERROR the solver gave up\n")
    work = run.folder.parent / ".store" / history_hash(case)
    work.mkdir(parents=True)
    (work / "log.pimpleFoam").write_text("\n".join(f"Time = {n}" for n in range(20)))
    lines = run.entry("k6").last_lines
    assert lines[0].endswith("log.pimpleFoam:")
    assert lines[-1] == "Time = 19"
    assert len(lines) == 6
    assert main(["status"]) == 0
    assert "Time = 19" in capsys.readouterr().out


def test_an_index_spares_the_opening_of_results(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    hashes = {f"k{k:g}": run.case(k) for k in (6.0, 7.0)}
    for name, digest in hashes.items():
        run.result(run.folder / f"unsteady/2d/{name}.nc", case_hash=digest, regime="settled")
    attributes = {
        name: {"case_hash": digest, "regime": "settled"} for name, digest in hashes.items()
    }
    write_index(run.folder / "unsteady/2d/sweep.json", attributes)
    opened: list[Path] = []
    monkeypatch.setattr("equisection.run.status.read_attributes", opened.append)
    assert run_status(run.folder).count(FREE) == {State.DONE: 2}
    assert opened == []


def test_of_many_cases_the_table_lists_those_that_need_a_look(
    run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    cases = {f"k{k:g}": one_by_one(float(k)) for k in range(1, 301)}
    write_cases(run.folder / "cases/unsteady/2d/sweep.json", cases)
    run.result(run.folder / "unsteady/2d/k7.nc", case_hash="0" * 64)
    assert main(["status"]) == 0
    told = capsys.readouterr().out
    assert "stale" in told
    assert "299 cases that are done or waiting are not listed" in told
    assert len(told.splitlines()) < 20


class Page(HTMLParser):
    """What a browser without script and network makes of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.cells: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag in ("td", "th"):
            self.cells.append("")

    def handle_data(self, data: str) -> None:
        if self.cells:
            self.cells[-1] += data

    def with_tag(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


@pytest.fixture
def page(run: Run, capsys: pytest.CaptureFixture[str]) -> Page:
    run.finished(6.0, "growing")
    run.finished(7.0, "failed", "left the polar")
    run.job(8.0, Process.this())
    run.job(9.0, GONE)
    run.case(10.0)
    assert main(["status", "--html", "status.html"]) == 0
    assert "page: status.html" in capsys.readouterr().out
    return Page(Path("status.html").read_text(encoding="utf-8"))


def test_page_shows_every_case_with_its_state(page: Page) -> None:
    told = " ".join(" ".join(page.cells).split())
    for words in ("2d k6 growing", "k7 failed", "left the polar", "k8 running 25 %", "k9 stopped"):
        assert words in told
    assert "100 of 400" in told


def test_page_needs_nothing_from_elsewhere(page: Page) -> None:
    assert {"script", "img", "link", "iframe"}.isdisjoint(tag for tag, _ in page.tags)
    assert not any({"src", "href", "onclick"} & attributes.keys() for _, attributes in page.tags)


def test_page_is_for_small_windows_and_for_readers_aloud(page: Page) -> None:
    assert {"name": "viewport", "content": "width=device-width, initial-scale=1"} in page.with_tag(
        "meta"
    )
    assert page.with_tag("html") == [{"lang": "en"}]
    assert len(page.with_tag("caption")) == len(page.with_tag("table")) == 1
    assert all(head["scope"] in ("col", "row") for head in page.with_tag("th"))


def test_page_that_cannot_be_written(run: Run, capsys: pytest.CaptureFixture[str]) -> None:
    run.case(6.0)
    Path("a-file").touch()
    assert main(["status", "--html", "a-file/status.html"]) == 1
    assert capsys.readouterr().err.startswith("error: a-file/status.html: the page cannot be")
