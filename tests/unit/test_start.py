"""What is looked at, found and said before the graph is built."""

import os
import subprocess
import time
from pathlib import Path

import pytest
from tests.conftest import ROOT

from equisection.config import check_files, find_files, load_config
from equisection.config.groups.openfoam_keys import refused_path
from equisection.errors import ConfigError, SolverError
from equisection.provenance import COMMAND_VARIABLE, CONFIG_VARIABLE, commit_of, refused_by_git
from equisection.run import start
from equisection.run.command_line import main
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.process import run_program

POLAR = "config/polars/own_section.csv"
OPENFOAM = {"solver": "openfoam", "unsteady": {"time_step": 0.04, "output_interval": 0.2}}


def own(polar: str = POLAR, **keys: object) -> dict[str, object]:
    return {"steady": {"resolution": "own"}, "embedded": {"polars": {"own": polar}}, **keys}


def a_project(folder: Path) -> Path:
    (folder / "config/polars").mkdir(parents=True)
    (folder / "results/reference").mkdir(parents=True)
    (folder / POLAR).write_text("the project's")
    return folder


# -- files that a configuration names --------------------------------------------------------


def test_the_project_has_what_the_working_directory_has_not(tmp_path: Path) -> None:
    project, here = a_project(tmp_path / "project"), tmp_path / "here"
    here.mkdir()
    found = find_files(load_config(own()), project, here)
    assert found.embedded.polars["own"] == f"../project/{POLAR}"
    assert found.reuse == "../project/results/reference"
    check_files(found, here, project=project)


def test_the_working_directory_goes_first(tmp_path: Path) -> None:
    project, here = a_project(tmp_path / "project"), a_project(tmp_path / "here")
    config = load_config(own())
    assert find_files(config, project, here) == config


def test_in_the_project_nothing_changes(tmp_path: Path) -> None:
    project = a_project(tmp_path / "project")
    (tmp_path / "link").symlink_to(project)
    config = load_config(own())
    assert find_files(config, tmp_path / "link", project) is config


def test_results_of_another_run_are_those_of_the_working_directory(tmp_path: Path) -> None:
    project, here = a_project(tmp_path / "project"), tmp_path / "here"
    here.mkdir()
    index = "results/other/unsteady/3d/sweep.json"
    (project / index).parent.mkdir(parents=True)
    (project / index).touch()
    raw = own(sweep={"models": ["2d"], "taken": {"3d": index}})
    found = find_files(load_config(raw), project, here)
    assert found.sweep.taken["3d"] == index
    with pytest.raises(ConfigError, match=r"sweep\.taken\.3d.* no such file"):
        check_files(found, here, project=project)


def test_both_places_are_named_where_a_file_is_in_neither(tmp_path: Path) -> None:
    project, here = a_project(tmp_path / "project"), tmp_path / "here"
    here.mkdir()
    config = find_files(load_config(own("wing.csv", reuse="kept")), project, here)
    with pytest.raises(ConfigError) as caught:
        check_files(config, here, project=project)
    lines = str(caught.value).splitlines()
    assert len(lines) == 2
    assert all(f"seen from {here} or {project};" in line for line in lines)


def test_configuration_that_is_read_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    project = a_project(tmp_path / "project")
    theirs = project / start.CONFIG_FILE
    assert start.here_or_in_project(start.CONFIG_FILE, project) == theirs
    assert start.config_files(theirs, ["my.yaml"]) == [Path("my.yaml")]  # as Snakemake has it
    assert start.config_files(theirs, []) == [theirs]
    theirs.touch()
    assert start.config_files(theirs, ["my.yaml"]) == [theirs, Path("my.yaml")]
    (tmp_path / "config").mkdir()
    (tmp_path / start.CONFIG_FILE).touch()
    assert start.here_or_in_project(start.CONFIG_FILE, project) == start.CONFIG_FILE


def test_command_checks_a_configuration_in_any_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / "my.yaml"
    mine.write_text(
        f"run: mine\nsteady: {{resolution: own}}\nembedded: {{polars: {{own: {POLAR}}}}}"
    )
    assert main(["check", "my.yaml"]) == 0
    assert capsys.readouterr().out == (
        "the configuration is valid; its results go to results/mine\n"
    )
    mine.write_text("run: [1")
    for command in ("check", "folder", "cost"):
        assert main([command, "my.yaml"]) == 1
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith("error: config: my.yaml, line 1, column 8: is no YAML: ")


# -- the project ---------------------------------------------------------------------------


def test_project_is_where_its_rules_are(tmp_path: Path) -> None:
    rules = tmp_path / "project/workflow/rules"
    rules.mkdir(parents=True)
    assert start.project_of(rules) == tmp_path / "project"


def test_project_of_rules_that_are_fetched_is_that_of_the_package(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    fetched = Path("https://forge.example/equisection/workflow/rules")
    assert start.project_of(fetched) == ROOT
    monkeypatch.setattr(start, "clone_of_package", lambda: None)
    with pytest.raises(ConfigError, match="clone it"):
        start.project_of(fetched)


def test_braces_in_the_project_s_path_are_refused(tmp_path: Path) -> None:
    rules = tmp_path / "my {project}/workflow/rules"
    rules.mkdir(parents=True)
    with pytest.raises(ConfigError, match=r"\{project\}.*give the folder another name"):
        start.project_of(rules)


# -- notices -------------------------------------------------------------------------------


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.csv").touch()
    return tmp_path


def test_nothing_is_said_where_nothing_is_wrong(here: Path) -> None:
    assert list(start.notices(load_config(own("mine.csv")))) == []


def test_file_of_the_future_is_named_with_how_far(here: Path) -> None:
    result = here / "results/mine/steady/2d/own_a0.nc"
    result.parent.mkdir(parents=True)
    result.touch()
    config = load_config(own("mine.csv", run="mine"))
    assert list(start.notices(config)) == []
    ahead = time.time() + 5.5 * 3600
    os.utime("mine.csv", (ahead, ahead))
    os.utime(result, (ahead - 3600, ahead - 3600))
    (line,) = start.notices(config)
    assert line.startswith(
        "warning: mine.csv is 5.5 h ahead of this machine's clock (1 more are from the future): "
    )
    assert "made again" in line
    assert "set the clock, or 'touch' the files" in line


@pytest.mark.parametrize("aside", ["logs", "provenance"])
def test_logs_of_the_future_do_no_harm(here: Path, aside: str) -> None:
    log = here / "results/mine" / aside / "modes.log"
    log.parent.mkdir(parents=True)
    log.touch()
    os.utime(log, (time.time() + 9e4, time.time() + 9e4))
    assert list(start.notices(load_config(own("mine.csv", run="mine")))) == []


def test_a_line_is_said_once(capsys: pytest.CaptureFixture[str]) -> None:
    """A workflow may use rules of a module in several statements, each of which reads them all."""
    start.say(["a line of this test"])
    start.say(["a line of this test", "another line of this test"])
    assert capsys.readouterr().err == "a line of this test\nanother line of this test\n"


def test_jobs_of_two_modules_are_told_no_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(start, "_CONFIGS", set())
    for name in (COMMAND_VARIABLE, CONFIG_VARIABLE):
        monkeypatch.setenv(name, "")
    start.tell_jobs("snakemake", "a1")
    start.tell_jobs("snakemake", "a1")
    assert os.environ[CONFIG_VARIABLE] == "a1"
    assert os.environ[COMMAND_VARIABLE] == "snakemake"
    start.tell_jobs("snakemake", "b2")
    assert os.environ[CONFIG_VARIABLE] == ""


# -- a folder that the solver cannot work in -------------------------------------------------

#: Names that OpenFOAM v1912 was tried in: what it drops from a path it does not find.
REFUSED = ["a b", "a\tb", "a\nb", "a'b", 'a"b']
TAKEN = ["a[b]", "a(b)", "ümlaut", "日本", "a;b", "a{b}", "a$b", "a#b", "a&b", "a,b", "a:b", "a*b"]


@pytest.mark.parametrize("name", REFUSED)
def test_openfoam_is_not_started_where_it_finds_nothing(name: str, tmp_path: Path) -> None:
    folder = tmp_path / name
    folder.mkdir()
    assert refused_path(folder)
    with pytest.raises(SolverError, match="no blank and no quote in a path") as refused:
        run_program(Installation(("touch",)), "started", folder)
    assert len(str(refused.value).splitlines()) == 1
    assert not list(folder.iterdir())


@pytest.mark.parametrize("name", TAKEN)
def test_openfoam_takes_any_other_name(name: str, tmp_path: Path) -> None:
    (tmp_path / name).mkdir()
    assert refused_path(tmp_path / name) == ""


def test_folder_that_openfoam_cannot_work_in_is_said_at_the_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = tmp_path / "my documents"
    (here / "results").mkdir(parents=True)
    monkeypatch.chdir(here)
    (line,) = start.notices(load_config(OPENFOAM))
    assert line.startswith("warning: OpenFOAM takes no blank")
    assert str(here / "results/.store") in line
    assert list(start.notices(load_config({}))) == []  # the embedded solver takes any
    assert list(start.notices(load_config({**OPENFOAM, "compute": False}))) == []
    (tmp_path / "scratch").mkdir()
    (here / "results/.store").symlink_to(tmp_path / "scratch")
    assert list(start.notices(load_config(OPENFOAM))) == []


# -- a clone that git does not trust -------------------------------------------------------


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    package = tmp_path / "my clone/workflow/equisection"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    me = ("-c", "user.name=me", "-c", "user.email=me@example.org")
    for words in (["init", "-q"], ["add", "."], [*me, "commit", "-q", "-m", "first"]):
        subprocess.run(["git", "-C", tmp_path / "my clone", *words], check=True)
    return package


def test_clone_of_ones_own_is_trusted(clone: Path) -> None:
    assert refused_by_git(clone) == ""
    assert len(commit_of(clone)) == 40


def test_clone_of_another_owner_is_said_with_what_helps(
    clone: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: clone.stat().st_uid + 1)
    assert refused_by_git(clone) == ""  # git trusts it all the same
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    said = refused_by_git(clone)
    assert said.startswith(f"{clone.parents[1]} belongs to another user and git does not trust it")
    assert f"--add safe.directory '{clone.parents[1]}'" in said
    assert commit_of(clone) == ""


def test_package_without_a_clone_is_nothing_to_talk_of(tmp_path: Path) -> None:
    assert refused_by_git(tmp_path / "site-packages/equisection") == ""


# -- what changes files -----------------------------------------------------------------------


@pytest.mark.parametrize(
    "command",
    ["-n", "--dry-run", "--dryrun", "-np", "--unlock", "--lint", "--dag", "--list", "--summary"],
)
def test_commands_that_run_no_job_change_nothing(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert not start.changes_files([command, "--cores", "1"])


@pytest.mark.parametrize("command", [["--cores", "2"], ["-c1", "results/a/b.csv"], ["--no-such"]])
def test_runs_change_files_unless_another_has_the_lock(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert start.changes_files(command)
    (tmp_path / ".snakemake/locks").mkdir(parents=True)
    (tmp_path / ".snakemake/locks/0.output.lock").touch()
    assert not start.changes_files(command)
