"""A wrong configuration on the real command line: status 1, a line a problem, and nothing done."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

pytestmark = pytest.mark.workflow

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A copy of what a fresh clone has, without results."""
    place = tmp_path_factory.mktemp("clone")
    for name in ("config", "workflow", "scripts", "envs"):
        shutil.copytree(ROOT / name, place / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "Snakefile", place)
    return place


def dry_run(place, *arguments, target="results/{run}/comparison/onset.csv", run="paper-plate"):
    command = [sys.executable, "-m", "snakemake", "-n", target.format(run=run), *arguments]
    return subprocess.run(
        command,
        cwd=place,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        env={**os.environ, "PYTHONWARNINGS": "ignore"},
    )


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


def test_lists_are_replaced_and_null_is_understood(clone):
    done = dry_run(clone, "--config", 'sweep={"k_star": [5, 6]}', 'flow={"channel": null}')
    assert done.returncode == 0, done.stderr
    assert "k5.json" in done.stdout
    assert "k7.json" not in done.stdout


@pytest.mark.parametrize("name", ["photovoltaic_panel", "free_air_wing", "own_polar"])
def test_examples_with_a_change_on_top(clone, name):
    file = f"config/examples/{name}.yaml"
    over = ["--configfile", file, "--config", f"run={name}-2", 'sweep={"k_star": [7]}']
    done = dry_run(clone, *over, run=f"{name}-2")
    assert done.returncode == 0, done.stderr
    assert "k7.json" in done.stdout
    assert "k8.json" not in done.stdout
