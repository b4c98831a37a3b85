"""A wrong configuration on the real command line: status 1, a line a problem, and nothing done."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tests.processes import LONG

pytestmark = pytest.mark.workflow

ROOT = Path(__file__).parents[2]


def copied(place):
    """Make a copy of what a fresh clone has, without results."""
    for name in ("config", "workflow", "scripts", "envs"):
        shutil.copytree(ROOT / name, place / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "Snakefile", place)
    return place


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A clone for dry runs, in which nothing may appear."""
    return copied(tmp_path_factory.mktemp("clone"))


@pytest.fixture(scope="module")
def workplace(tmp_path_factory):
    """A clone that resolves configurations."""
    return copied(tmp_path_factory.mktemp("workplace"))


def snakemake(place, *arguments):
    return subprocess.run(
        [sys.executable, "-m", "snakemake", *arguments],
        cwd=place,
        capture_output=True,
        text=True,
        check=False,
        timeout=LONG,
        env={**os.environ, "PYTHONWARNINGS": "ignore"},
    )


def dry_run(place, *arguments, run="paper-plate"):
    return snakemake(place, "-n", f"results/{run}/comparison/onset.csv", *arguments)


def resolved(place, *arguments, run="paper-plate"):
    """Let the workflow write the configuration as it understands it."""
    file = f"results/{run}/config.resolved.yaml"
    done = snakemake(place, "--cores", "1", file, *arguments)
    assert done.returncode == 0, done.stderr
    return yaml.safe_load((place / file).read_text())


def refusals(place, *arguments):
    """Run, and return the lines of the refusal after checking that nothing else happened."""
    done = dry_run(place, *arguments)
    assert done.returncode == 1, done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    assert "rule " not in done.stdout
    assert not (place / "results").exists()
    said = [line for line in done.stderr.splitlines() if line.strip()]
    assert all(
        line.startswith("config: ") or line.startswith("Config file config/config.yaml is extended")
        for line in said
    ), done.stderr
    return [line for line in said if line.startswith("config: ")]


def test_several_problems_at_once(clone, tmp_path):
    file = tmp_path / "wrong.yaml"
    file.write_text(
        yaml.safe_dump(
            {
                "beam": {"thickness": -0.004, "lenght": 1},
                "flow": {"channel": {"tip_gap_chords": 0}},
                "sweep": {"k_star": [5, 0]},
            }
        )
    )
    lines = refusals(clone, "--configfile", str(file))
    assert [line.split(": ")[1] for line in lines] == [
        "beam.thickness",
        "beam.lenght",
        "sweep.k_star.1",
        "flow.channel.tip_gap_chords",
    ]
    assert lines[0] == "config: beam.thickness: -0.004: allowed is a number above 0"


@pytest.mark.parametrize(
    ("argument", "line"),
    [
        ('sweep={"k_star": 0}', "config: sweep.k_star: '0': allowed is a list of 1 or more"),
        ("k_star=5", "config: k_star: 5: unknown key; allowed here are run"),
        ("beam=", "config: beam: null: allowed is a section with the keys chord"),
        ('flow={"speed": true}', "config: flow.speed: 'true': allowed is a number above 0"),
    ],
)
def test_on_the_command_line(clone, argument, line):
    (found,) = refusals(clone, "--config", argument)
    assert found.startswith(line)


def test_missing_polar(clone):
    (line,) = refusals(clone, "--config", 'embedded={"polars": {"coarse": "mine.csv"}}')
    assert line.startswith("config: embedded.polars.coarse: 'mine.csv': no such file, seen from ")
    assert str(clone) in line


def test_command_line_replaces_lists_and_knows_null(workplace):
    over = ["--config", 'sweep={"k_star": [5, 6]}', 'flow={"channel": null}']
    config = resolved(workplace, *over)
    assert config["sweep"]["k_star"] == [5.0, 6.0]
    assert config["sweep"]["onset"] == "sweep"
    assert config["flow"]["channel"] is None
    assert config["flow"]["speed"] == 20.0


def test_command_line_goes_on_top_of_a_file(workplace):
    over = ["run=both", 'sweep={"k_star": [1.5, 2]}', 'flow={"channel": {"tip_gap_chords": 1}}']
    file = "config/examples/free_air_wing.yaml"
    config = resolved(workplace, "--configfile", file, "--config", *over, run="both")
    assert config["sweep"]["k_star"] == [1.5, 2.0]
    assert config["sweep"]["models"] == ["2d", "2d-corrected", "3d"]
    assert config["flow"]["channel"]["tip_gap_chords"] == 1.0
    assert config["flow"]["channel"]["height_chords"] == 4.0
    assert config["beam"]["boundary"] == "spring-root"


@pytest.mark.parametrize("name", ["photovoltaic_panel", "free_air_wing", "own_polar"])
def test_dry_runs_of_the_examples(clone, name):
    file = f"config/examples/{name}.yaml"
    done = dry_run(clone, "--configfile", file, run=name.replace("_", "-"))
    assert done.returncode == 0, done.stderr
    assert not (clone / "results").exists()
