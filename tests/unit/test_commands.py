"""Commands that start a run and say what came out: ``init``, ``run``, ``onset``, ``show``."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import pytest
import yaml
from rich.console import Console
from tests.conftest import ROOT

from equisection.run import launch, starter
from equisection.run.answer import answer_of
from equisection.run.command_line import main
from equisection.store.made_from import write_record

HEADER = (
    "model,incidence_deg,speed,speed_low,speed_high,mechanism,frequency_hz,k_star,margin,basis,"
    "growth_error,growth_error_rms,errs\n"
)


def run_with(folder: Path, *lines: str) -> Path:
    (folder / "comparison").mkdir(parents=True)
    (folder / "comparison" / "critical_speed.csv").write_text(HEADER + "\n".join(lines) + "\n")
    return folder


class TestOnset:
    def test_the_beam_answers_before_its_sections(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            "2d,2.5,39.54,39.54,39.54,flutter,7.89,9,,eigenvalue,,,",
            "2d-corrected,2.5,41.3,39,43.6,flutter,7.6,8,,time,,,",
            "3d,2.5,37.35,35.6,39.1,flutter,8.03,10,1.188,time,-0.004,0.005,unsafe",
        )
        lines = list(answer_of(run).lines())
        assert lines[0].endswith("between 35.6 m/s (stable) and 39.1 m/s (unstable), at 2.5 deg")
        assert lines[1].endswith("flutter at 8.03 Hz")
        assert lines[2].endswith("1.19 times the design speed")
        assert "such growth rates are off by 0.005 V/c" in lines[3]
        assert lines[3].endswith("so that the speed is too high")
        assert "by runs in time below and above it" in lines[3]
        assert "2d 39.54 m/s (eigenvalue)" in lines[4]
        assert len(lines) == 5

    def test_runs_without_a_verdict_between_the_speeds_are_counted(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            "2d,1,35,30,40,divergence,,1.8,,time,,,",
            "3d,1,40.3,37.5,43.1,divergence,,1.4,,time,,,",
        )
        (run / "comparison" / "onset.csv").write_text(
            "model,speed_stable,speed_unstable,failed_inside,undecided_inside\n"
            "2d,30,40,32 34 35,\n3d,37.5,43.12,39.38 40 41.25,38\n"
        )
        how_sure = list(answer_of(run).lines())[3]
        assert "of the runs between these speeds 3 failed and 1 undecided" in how_sure
        assert f"'equisection status {run}' says why of each" in how_sure

    @pytest.mark.parametrize("reduction", ["", "-paper", "-consistent"])
    def test_a_corrected_section_answers_before_one_that_is_not(
        self, reduction: str, tmp_path: Path
    ) -> None:
        models = (f"2d{reduction}", f"2d-corrected{reduction}")
        run = run_with(
            tmp_path / "run", *(f"{one},0,30,29,31,flutter,2,1,,time,,," for one in models)
        )
        assert answer_of(run).chosen["model"] == models[1]

    def test_of_several_incidences_the_lowest_answers(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            *(f"3d,{a},{v},{v},{v},flutter,2,1,,time,,," for a, v in ((-5, 30), (0, 21), (5, 29))),
        )
        first = next(answer_of(run).lines())
        assert "21 m/s, at 0 deg, the lowest of 3 incidences from -5 to 5 deg" in first

    def test_eigenvalues_find_what_is_below_all_runs(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            "3d,0,6.4,6.4,6.4,divergence,0,1,1.28,eigenvalue,,,",
            "3d,0,,,10,divergence,,,,time,,,",
            "3d,5,3.4,3.4,3.4,flutter,1.7,4,0.68,eigenvalue,,,",
            "3d,5,,,10,divergence,,,,time,,,",
        )
        lines = list(answer_of(run).lines())
        assert "3.4 m/s, at 5 deg, the lowest of 2 incidences from 0 to 5 deg" in lines[0]
        assert "0.68 times the design speed" in lines[2]
        assert "3d below 10 m/s, where it is unstable already (time)" in lines[4]

    def test_eigenvalues_do_not_overrule_an_unstable_run(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            "3d,0,12,12,12,flutter,2,1,,eigenvalue,,,",
            "3d,0,,,10,flutter,2,,,time,,,",
        )
        lines = list(answer_of(run).lines())
        assert "below 10 m/s" in lines[0]
        assert lines[2].endswith("no speed is known to be stable")

    def test_a_model_whose_name_is_a_number_is_taken_as_a_name(self, tmp_path: Path) -> None:
        run = run_with(tmp_path / "run", "2,0,30,29,31,flutter,2,1,,time,,,")
        assert answer_of(run).chosen["model"] == "2"

    def test_recorded_histories_of_another_run_answer_before_eigenvalues(
        self, tmp_path: Path
    ) -> None:
        run = run_with(
            tmp_path / "run",
            "3d,0,12,12,12,flutter,2,1,,eigenvalue,,,",
            "3d,0,14,13,15,flutter,2,1,,given,,,",
        )
        answer = answer_of(run)
        assert answer.chosen["basis"] == "given"
        assert "by recorded histories" in "\n".join(answer.lines())

    def test_bases_of_one_incidence_leave_the_others_in(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run",
            "3d,2.5,32,31,33,flutter,2,1,,time,,,",
            "3d,5,23,23,23,flutter,2,1,,eigenvalue,,,",
            "3d,6,,,,unknown,,,,eigenvalue,,,",
        )
        first = next(answer_of(run).lines())
        assert "23 m/s, at 5 deg, the lowest of 3 incidences" in first
        assert first.endswith("at 1 of them nothing is known")

    def test_a_model_of_which_nothing_is_known_gives_way(self, tmp_path: Path) -> None:
        run = run_with(
            tmp_path / "run", "3d,0,,,,unknown,,,,time,,,", "2d,0,30,29,31,flutter,2,1,,time,,,"
        )
        lines = list(answer_of(run).lines())
        assert "between 29 m/s (stable) and 31 m/s (unstable)" in lines[0]
        assert "3d unknown: no run has a verdict (time)" in lines[4]

    @pytest.mark.parametrize(
        ("low", "high", "words"),
        [
            ("160.6", "161.45", "between 160.6 m/s (stable) and 161.4 m/s (unstable)"),
            ("1010", "1180", "between 1010 m/s (stable) and 1180 m/s (unstable)"),
        ],
    )
    def test_both_sides_of_an_onset_are_told_apart_without_powers_of_ten(
        self, tmp_path: Path, low: str, high: str, words: str
    ) -> None:
        run = run_with(tmp_path / "run", f"3d,1,{low},{low},{high},flutter,1430,1,,time,,,")
        first, mechanism, *_ = answer_of(run).lines()
        assert words in first
        assert mechanism.endswith("flutter at 1430 Hz")

    def test_derivatives_without_an_onset_are_no_runs_without_a_verdict(
        self, tmp_path: Path
    ) -> None:
        run = run_with(tmp_path / "run", "2d,0,,,,unknown,,,,derivatives,,,")
        lines = list(answer_of(run).lines())
        assert "unknown: no onset by flutter derivatives, at 0 deg" in lines[0]
        assert "run" not in "".join(lines[:2])

    def test_of_equal_brackets_that_with_the_lowest_eigenvalue_answers(
        self, tmp_path: Path
    ) -> None:
        run = run_with(
            tmp_path / "run",
            *(f"3d,{at},22,10,35,flutter,2,1,,time,,," for at in (3, 6)),
            "3d,3,29.5,29.5,29.5,flutter,2,1,,eigenvalue,,,",
            "3d,6,22.2,22.2,22.2,flutter,2,1,,eigenvalue,,,",
        )
        assert ", at 6 deg, the lowest of 2 incidences" in next(answer_of(run).lines())

    def test_an_onset_without_an_upper_end_is_no_stable_speed(self, tmp_path: Path) -> None:
        run = run_with(tmp_path / "run", "3d,0,32,19,inf,flutter,2,1,,model,,,")
        answer = answer_of(run)
        assert "32 m/s, from 19 m/s, open beyond" in next(answer.lines())
        assert json.loads(answer.as_json())["answer"]["speed_high"] is None

    @pytest.mark.parametrize(
        ("low", "high", "words"),
        [("30", "", "above 30 m/s"), ("", "12", "below 12 m/s"), ("", "", "unknown")],
    )
    def test_an_open_bracket_is_no_number(
        self, tmp_path: Path, low: str, high: str, words: str
    ) -> None:
        run = run_with(tmp_path / "run", f"3d,1,,{low},{high},none,,,,time,,,")
        assert words in next(answer_of(run).lines())

    def test_a_design_speed_beyond_the_stable_ones_is_said_loudly(self, tmp_path: Path) -> None:
        run = run_with(tmp_path / "run", "3d,1,25,24,26,flutter,2,1,0.8,time,,,")
        assert "NOT REACHED" in list(answer_of(run).lines())[2]

    def test_for_machines(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        run = run_with(tmp_path / "run", "3d,1,,24,,none,,,,time,,,")
        assert main(["onset", str(run), "--json"]) == 0
        answer = json.loads(capsys.readouterr().out)
        assert answer["run"] == "run"
        assert (answer["answer"]["speed_low"], answer["answer"]["speed_high"]) == (24.0, None)

    @pytest.mark.parametrize(
        "text",
        [
            "",
            "model,speed\n3d,2\n",
            HEADER,
            HEADER + "3d,0,fast,,,none,,,,time,,,\n",
            HEADER + "3d,,1,1,1,flutter,,,,time,,,\n",
            HEADER + ",0,1,1,1,flutter,,,,time,,,\n",
        ],
    )
    def test_what_is_no_such_table_is_named(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str
    ) -> None:
        run = run_with(tmp_path / "run")
        (run / "comparison" / "critical_speed.csv").write_text(text)
        assert main(["onset", str(run)]) == 1
        assert "critical_speed.csv: " in capsys.readouterr().err

    def test_a_sweep_without_a_result_is_told_with_where_to_look(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        run = run_with(tmp_path / "run")
        (run / "comparison" / "critical_speed.csv").write_text(HEADER)
        assert main(["onset", str(run)]) == 1
        said = capsys.readouterr().err
        assert f"no run of the sweep has a result; 'equisection status {run}' says why" in said

    def test_a_table_that_was_edited_is_no_answer(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        run = run_with(tmp_path / "run", "3d,1,25,24,26,flutter,2,1,1.2,time,,,")
        table = run / "comparison" / "critical_speed.csv"
        write_record(run / "logs" / "job.log", [], [table])
        assert main(["onset", str(run)]) == 0
        table.write_text(table.read_text().replace("24", "23"))
        assert main(["onset", str(run)]) == 1
        assert "critical_speed.csv: edited since its job made it" in capsys.readouterr().err

    def test_a_run_without_an_answer_says_where_to_look(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        assert main(["onset", str(tmp_path)]) == 1
        assert "equisection status" in capsys.readouterr().err


class TestInit:
    @pytest.mark.parametrize("like", starter.EXAMPLES)
    def test_every_start_is_a_valid_configuration_with_the_new_values(
        self, like: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(tmp_path)
        example = yaml.safe_load((ROOT / "config/examples" / starter.EXAMPLES[like]).read_text())
        defaults = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())
        beam = defaults["beam"] | example.get("beam", {})
        chord, length = 1.1 * beam["chord"], 1.1 * beam["length"]
        values = [f"--chord={chord}", f"--length={length}", "--design-speed=11"]
        assert main(["init", "mine", "--like", like, *values]) == 0
        text = Path("mine.yaml").read_text()
        keys = yaml.safe_load(text)
        assert keys["run"] == "mine"
        assert keys["beam"]["chord"] == pytest.approx(chord)
        assert keys["beam"]["length"] == pytest.approx(length)
        assert keys["flow"]["design_speed"] == 11
        assert "config/examples/" + starter.EXAMPLES[like] not in text
        assert main(["check", "mine.yaml"]) == 0

    def test_nothing_is_written_over(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.chdir(tmp_path)
        Path("mine.yaml").write_text("run: precious\n")
        assert main(["init", "mine", "--like", "plate"]) == 1
        assert "mine.yaml: is there already" in capsys.readouterr().err
        assert Path("mine.yaml").read_text() == "run: precious\n"

    def test_answers_that_end_before_the_questions_write_nothing(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.chdir(tmp_path)
        terminal = io.StringIO("")
        monkeypatch.setattr(terminal, "isatty", lambda: True)
        monkeypatch.setattr(sys, "stdin", terminal)
        assert main(["init", "mine"]) == 1
        assert "nothing is written" in capsys.readouterr().err
        assert not list(tmp_path.iterdir())

    def test_the_name_may_be_that_of_the_file(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(tmp_path)
        assert main(["init", "mine.yaml", "--like", "plate"]) == 0
        assert yaml.safe_load(Path("mine.yaml").read_text())["run"] == "mine"

    @pytest.mark.parametrize("name", ["2024", "2024-01-01", "0x1F", "1.5", "true", "on", "null"])
    def test_a_name_that_yaml_would_read_as_something_else_is_in_quotes(
        self, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(tmp_path)
        assert main(["init", name, "--like", "panel"]) == 0
        assert main(["check", f"{name}.yaml"]) == 0

    @pytest.mark.parametrize("value", ["-1", "0", "nan", "inf"])
    def test_a_dimension_that_none_has_is_refused(
        self,
        value: str,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
        capsys: pytest.CaptureFixture[str],
    ) -> None:
        monkeypatch.chdir(tmp_path)
        assert main(["init", "mine", "--like", "plate", f"--chord={value}"]) == 1
        assert f"chord {value}: allowed is" in capsys.readouterr().err
        assert not list(tmp_path.iterdir())

    @pytest.mark.parametrize("name", ["", "..", "a..b", "a/b", "a b", "-x\n", "a" * 65])
    def test_a_name_that_is_no_folder_is_refused(
        self, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(tmp_path)
        assert main(["init", "--like", "plate", "--", name]) == 1
        assert not list(tmp_path.iterdir())


class TestRun:
    def test_command_here_and_elsewhere(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(ROOT)
        here = launch.snakemake_command([Path("a.yaml")], ["-n"])
        assert here[1:3] == ["-m", "snakemake"]
        assert "--snakefile" not in here
        assert here[3:5] == ["--configfile", "a.yaml"]
        assert here[5].startswith("--")  # what has no dash would be a further configuration
        assert here[-1] == "-n"
        monkeypatch.chdir(tmp_path)
        there = launch.snakemake_command([], ["-j4"])
        assert there[there.index("--snakefile") + 1] == str(ROOT / "Snakefile")
        assert "--cores" not in there

    @pytest.mark.parametrize(
        ("further", "whole"),
        [
            ("", True),
            ("--cores 1 -k --profile=x", True),
            ("-j4", True),
            ("-n", False),
            ("--cores 1 results/a/x.csv", False),
            ("--config run=other", False),
            ("--unlock", False),
        ],
    )
    def test_a_run_answers_only_where_it_is_whole(self, further: str, whole: bool) -> None:
        assert launch.is_whole(further.split()) == whole

    def test_lines_of_jobs_that_go_well_give_way_to_the_bar(self, tmp_path: Path) -> None:
        says = ["Finished jobid: 3 (Rule: x)", "warning: wind", "2 of 5 steps (40%) done"]
        with (tmp_path / "out").open("w") as out:
            console = Console(file=out, force_terminal=True, width=80)
            status = launch.launch(
                [sys.executable, "-c", f"print({chr(10).join(says)!r}); raise SystemExit(3)"],
                console,
            )
        assert status == 3
        shown = (tmp_path / "out").read_text()
        assert "warning: wind" in shown
        assert "2/5" in shown
        assert "Finished jobid" not in shown

    def test_a_wrong_configuration_starts_nothing(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        wrong = tmp_path / "wrong.yaml"
        wrong.write_text("beam: {chord: -1}\n")
        assert main(["run", str(wrong)]) == 1
        assert "beam.chord" in capsys.readouterr().err


class TestShow:
    @pytest.fixture
    def run(self, tmp_path: Path) -> Path:
        folder = tmp_path / "run" / "figures"
        folder.mkdir(parents=True)
        for name in ("a.png", "a.svg", "b.png"):
            (folder / name).write_bytes(name.encode())
        return folder.parent

    def test_without_a_display_their_places_are_told(
        self, run: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.setattr("equisection.run.shown_figures.has_display", lambda: False)
        assert main(["show", str(run), "b"]) == 0
        assert capsys.readouterr().out == f"{run}/figures/b.png\n"

    def test_copies_have_every_format(self, run: Path, tmp_path: Path) -> None:
        assert main(["show", str(run), "--to", str(tmp_path / "there")]) == 0
        assert {path.name for path in (tmp_path / "there").iterdir()} == {"a.png", "a.svg", "b.png"}

    def test_a_run_that_is_not_there_is_said_so(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        assert main(["show", str(tmp_path / "no")]) == 1
        assert "no such folder" in capsys.readouterr().err

    def test_an_unknown_figure_is_named_with_those_that_there_are(
        self, run: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        assert main(["show", str(run), "c"]) == 1
        assert "no figure 'c'; there are a, b" in capsys.readouterr().err


def test_a_shell_can_complete_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", "bash"]) == 0
    assert "onset" in capsys.readouterr().out
