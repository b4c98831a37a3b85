"""What a name, a path or a file from elsewhere may hold: it is a name, a path or text, and no more.

What stays of a shell or an unsafe loader in the sources, ruff's rules ``S`` find (`make lint`).
"""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.sample_cases import STEADY, UNSTEADY

from equisection.cases import case_hash, read_cases, write_cases
from equisection.config import check_files, load_config
from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from equisection.errors import CaseFileError, ConfigError, ResultFileError
from equisection.files import write_text
from equisection.run.command_line import main
from equisection.run.cost import read_cost_model
from equisection.run.status import run_status
from equisection.run.status_page import write_page
from equisection.solvers.openfoam import installation
from equisection.store.index import read_index, write_index
from equisection.store.mend import put_aside, unsound_files
from equisection.study import plan

LEADS_OUT = ["..", "../x", "/etc/x", "a/../../x", "a/b", "~root", ".hidden", "a\0b", ""]
TO_A_SHELL = ["a;b", "a b", "$(b)", "`b`", "a|b", "a&b", "a>b", "a'b", 'a"b', "a\nb", "-rf", "a*"]
TO_SNAKEMAKE = ["{a}", "a{b", "a}b"]
NAMES = [*LEADS_OUT, *TO_A_SHELL, *TO_SNAKEMAKE]
#: Snakemake's own way to execute what a configuration holds.
YTE = """__use_yte__: true
run: ?__import__("os").system("touch executed")
"""
EXECUTED = "!!python/object/apply:os.system ['touch executed']"


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("key", "config"),
    [
        ("run", lambda name: {"run": name}),
        ("steady.resolution", lambda name: {"steady": {"resolution": name}}),
        ("steady.study", lambda name: {"steady": {"study": [name]}}),
        ("embedded.polars", lambda name: {"embedded": {"polars": {name: "flat-plate"}}}),
        ("openfoam.meshes", lambda name: {"openfoam": {"meshes": {name: "coarse"}}}),
    ],
)
def test_no_key_that_names_a_file_takes_such_a_name(
    key: str, config: Callable[[str], dict[str, Any]], name: str
) -> None:
    with pytest.raises(ConfigError, match=key.replace(".", r"\.")):
        load_config(config(name))


@pytest.mark.parametrize("name", TO_SNAKEMAKE)
def test_braces_in_a_path_are_refused_in_words(name: str, tmp_path: Path) -> None:
    (tmp_path / name).touch()
    config = load_config({"embedded": {"polars": {"coarse": name}}, "reuse": name})
    with pytest.raises(ConfigError) as refused:
        check_files(config, tmp_path)
    assert "embedded.polars.coarse" in str(refused.value)
    assert "reuse" in str(refused.value)
    assert "without braces" in str(refused.value)


@pytest.mark.parametrize("name", [name for name in NAMES if name])
def test_a_file_from_elsewhere_leads_nowhere(name: str, tmp_path: Path) -> None:
    case_file, index = tmp_path / "sweep.json", tmp_path / "run/unsteady/2d/sweep.json"
    write_cases(case_file, {name: UNSTEADY})
    with pytest.raises(CaseFileError, match="no name of a case"):
        read_cases(case_file)
    write_index(index, {name: {"case_hash": case_hash(UNSTEADY)}})
    with pytest.raises(ResultFileError, match="no name of a case"):
        read_index(index)
    chosen = tmp_path / "round1.json"
    chosen.write_text(json.dumps({"cases": [name]}))
    with pytest.raises(ValueError, match="no name of a case"):
        plan.read_refinement(chosen)


def test_an_index_from_elsewhere_moves_no_file_outside_of_the_run(tmp_path: Path) -> None:
    outside, run = tmp_path / "mine.nc", tmp_path / "results" / "run"
    outside.write_text("mine")
    index = run / "unsteady" / "2d" / "sweep.json"
    write_index(index, {"../../../../mine": {"case_hash": "0" * 64}})
    put_aside(unsound_files(run))
    assert outside.read_text() == "mine"
    assert not index.exists()


def test_a_link_in_the_place_of_an_output_is_replaced_and_not_followed(tmp_path: Path) -> None:
    outside, output = tmp_path / "mine", tmp_path / "run" / "table.csv"
    outside.write_text("mine")
    output.parent.mkdir()
    output.symlink_to(outside)
    write_text(output, "a table")
    assert outside.read_text() == "mine"
    assert output.read_text() == "a table"
    assert not output.is_symlink()


def test_a_prefix_is_words_and_goes_to_no_shell(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    program = tmp_path / "said"
    program.write_text('#!/bin/sh\nprintf "%s\\n" "$@" > words\n')
    program.chmod(0o755)
    monkeypatch.setenv(PREFIX_VARIABLE, f"{program} ; touch executed '$(touch executed)' & `x`")
    found = installation.find()
    subprocess.run(found.command("blockMesh"), check=True)
    words = (tmp_path / "words").read_text().splitlines()
    assert words == [";", "touch", "executed", "$(touch executed)", "&", "`x`", "blockMesh"]
    assert found.version() == "unknown"
    assert not (tmp_path / "executed").exists()


@pytest.mark.parametrize(
    "text", [EXECUTED, f"run: {EXECUTED}", f"flow: {{speed: {EXECUTED}}}", YTE]
)
def test_a_configuration_executes_nothing(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for place in ("config/config.yaml", "results/beam/config.resolved.yaml", "cost.yaml"):
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text(text)
    assert main(["folder"]) == 1
    assert main(["check"]) == 1
    assert main(["status"]) == 0
    with pytest.raises(ConfigError):
        read_cost_model(Path("cost.yaml"))
    assert "Traceback" not in "".join(capsys.readouterr())
    assert not (tmp_path / "executed").exists()


def test_snakemake_reads_a_configuration_as_safely(tmp_path: Path) -> None:
    from snakemake.common.configfile import load_configfile  # noqa: PLC0415

    hostile = tmp_path / "hostile.yaml"
    hostile.write_text(f"run: {EXECUTED.replace('executed', str(tmp_path / 'executed'))}\n")
    with pytest.raises(Exception, match=r"(?i)tag|constructor|yaml"):
        load_configfile(str(hostile))
    assert not (tmp_path / "executed").exists()


def test_a_log_on_the_page_and_the_terminal_is_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run = tmp_path / "results" / "beam"
    write_cases(run / "cases/steady/2d/coarse_a0.json", {"coarse_a0": STEADY})
    (run / "logs").mkdir()
    said = "<script>alert(1)</script> \x1b]0;title\x07 [/red]"
    (run / "logs/steady_2d_coarse_a0.log").write_text(f"2026-01-01 10:00:00,000 ERROR {said}\n")
    write_page(tmp_path / "page.html", [run_status(run)], "results")
    page = (tmp_path / "page.html").read_text()
    assert "<script" not in page
    assert "&lt;script&gt;alert(1)" in page
    for arguments in (["status"], ["status", "--plain"]):
        assert main(arguments) == 0
        told = capsys.readouterr().out
        assert "alert(1)" in told
        assert "\x1b]" not in told
        assert "\x07" not in told
