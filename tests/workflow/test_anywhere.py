"""The workflow started from any folder, as a module, read-only, and where it cannot start."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from equisection.cases import read_cases
from tests.processes import LONG
from tests.workflow.project import ROOT, Project, has_nothing_to_do, jobs_planned, small

SWEEP = {"k_star": [6.0, 10.0], "models": ["2d"]}
STEADY = "cases/steady/2d/polar.json"
SNAKEMAKE = (sys.executable, "-m", "snakemake")


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clone that is not changed, in a folder whose name has everything but braces."""
    return Project.fresh(tmp_path_factory.mktemp("clones") / "cl öne [1] 'q' \"d\" $x;&").folder


def snakemake(
    here: Path, clone: Path, *arguments: str, python: tuple[str, ...] = SNAKEMAKE
) -> subprocess.CompletedProcess[str]:
    """Start Snakemake in a folder with the package of a clone, which gets no byte code."""
    paths = {"PYTHONPATH": str(clone / "workflow"), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(
        [*python, *arguments],
        cwd=here,
        env={**os.environ, **paths, "COLUMNS": "200"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=LONG,
    )


def finished(ended: subprocess.CompletedProcess[str]) -> str:
    assert ended.returncode == 0, ended.stdout
    return ended.stdout


def said(ended: subprocess.CompletedProcess[str]) -> list[str]:
    """Return what is said instead of a run, which must be no traceback."""
    assert ended.returncode == 1, ended.stdout
    assert "Traceback" not in ended.stdout
    return [line for line in ended.stdout.splitlines() if line.strip()]


def write(here: Path, config: dict[str, object]) -> str:
    here.mkdir(exist_ok=True)
    (here / "my.yaml").write_text(yaml.safe_dump(config))
    return "my.yaml"


# -- from another folder ---------------------------------------------------------------------


def test_default_run_from_another_folder_is_that_of_the_clone(clone: Path, tmp_path: Path) -> None:
    planned = jobs_planned(
        finished(snakemake(tmp_path, clone, "-n", "-s", str(clone / "Snakefile")))
    )
    assert planned == jobs_planned(finished(snakemake(clone, clone, "-n")))
    assert planned["unsteady_batch"] > 0
    assert {path.name for path in tmp_path.iterdir()} <= {".snakemake"}


def test_results_are_in_the_working_directory_and_of_the_same_cases(
    clone: Path, tmp_path: Path
) -> None:
    here, files = tmp_path / "hêre [2]", {path for path in clone.rglob("*") if path.is_file()}
    options = ("--cores", "2", "--configfile", write(here, small(sweep=SWEEP)))
    started = ("-s", str(clone / "Snakefile"), f"results/small/{STEADY}", *options)
    finished(snakemake(here, clone, *started))
    assert {path for path in clone.rglob("*") if path.is_file()} == files

    inside = Project.fresh(tmp_path / "clone", small(sweep=SWEEP))
    inside.run(inside.target(STEADY))
    assert read_cases(here / "results/small" / STEADY) == read_cases(inside.results / STEADY)

    assert has_nothing_to_do(finished(snakemake(here, clone, "-n", *started)))


# -- as a module -----------------------------------------------------------------------------


def module(
    here: Path,
    clone: Path,
    directive: str,
    config: dict[str, object],
    snakefile: str = "",
) -> None:
    """Write another workflow with this one as a module."""
    write(here, {"theirs": 1, "equisection": config})
    snakefile = snakefile or repr(str(clone / "workflow" / "Snakefile"))
    (here / "Snakefile").write_text(
        f"""
configfile: "my.yaml"


module equisection:
    snakefile: {snakefile}
    config: config["equisection"]
    {directive}


use rule * from equisection as eq_*


rule all:
    default_target: True
    input:
        rules.eq_all.input,
"""
    )


def module_with_refinement(here: Path, clone: Path, directive: str) -> None:
    """Write the workflow with a module that has checkpoints and a polar that is given."""
    shutil.copy(ROOT / "config/polars/plate_2d_11136.csv", here / "mine.csv")
    sweep = SWEEP | {"onset": "refine"}
    config = small(sweep=sweep, embedded={"polars": {"coarse": "mine.csv"}})
    module(here, clone, directive, config)


def test_module_with_a_prefix(clone: Path, tmp_path: Path) -> None:
    """Everything goes below the prefix, and what is given is seen from the working directory."""
    module_with_refinement(tmp_path, clone, 'prefix: "eq"')
    made = "eq/results/small/unsteady/2d/round1.json"
    finished(snakemake(tmp_path, clone, "--cores", "2", made))
    assert (tmp_path / made).is_file()
    assert (tmp_path / "eq/results/.store").is_dir()
    top = {path.name for path in tmp_path.iterdir()} - {".snakemake"}
    assert top == {"Snakefile", "my.yaml", "mine.csv", "eq"}
    planned = jobs_planned(finished(snakemake(tmp_path, clone, "-n")))
    assert planned["eq_unsteady_batch"] == 2  # rounds that come
    assert planned["eq_modes"] == 0
    (tmp_path / "eq/results/small/unsteady/2d/k6.nc").unlink()
    lost = finished(snakemake(tmp_path, clone, "-n", made))
    assert "sweep.json: names results that are not there; they are made again" in lost


@pytest.mark.parametrize(
    ("directive", "results"), [("", "results"), ('pathvars: results="beams"', "beams")]
)
def test_module_without_one(clone: Path, tmp_path: Path, directive: str, results: str) -> None:
    module_with_refinement(tmp_path, clone, directive)
    planned = finished(snakemake(tmp_path, clone, "-n"))
    assert jobs_planned(planned)["eq_refine_onset"] == 3
    assert f"{results}/small/unsteady/2d/sweep.json" in planned


def test_module_from_a_tag(clone: Path, tmp_path: Path) -> None:
    """Rules that Snakemake takes out of a repository, as those of `github(..., tag=...)`."""
    repository, here = tmp_path / "repository", tmp_path / "here"
    for part in ("envs", "scripts", "workflow"):
        shutil.copytree(clone / part, repository / part)
    git = ("git", "-C", str(repository), "-c", "user.name=t", "-c", "user.email=t@example.org")
    for words in (("init", "-q"), ("add", "-A"), ("commit", "-qm", "all"), ("tag", "v0.2.0")):
        subprocess.run([*git, *words], check=True)
    # what comes behind the tag is not taken
    (repository / "workflow" / "Snakefile").write_text("what stands here is no workflow\n")
    subprocess.run([*git, "commit", "-qam", "another"], check=True)
    source = f'gitfile({str(repository)!r}, path="workflow/Snakefile", tag="v0.2.0")'
    module(here, clone, 'prefix: "eq"', small(sweep=SWEEP), source)
    made = f"eq/results/small/{STEADY}"
    finished(snakemake(here, clone, "--cores", "1", made))
    assert (here / made).is_file()


def test_module_that_runs_its_cases_one_by_one(clone: Path, tmp_path: Path) -> None:
    shutil.copy(ROOT / "config/polars/paper_plate_3d.csv", tmp_path / "rigid.csv")
    config = {
        "run": "mine",
        "solver": "openfoam",
        "unsteady": {"time_step": 0.04, "output_interval": 0.2},
        "steady": {"beam_polar": "rigid.csv"},
        "sweep": {"k_star": [6.0], "models": ["2d", "2d-corrected"]},
    }
    module(tmp_path, clone, 'prefix: "eq"', config)
    planned = jobs_planned(finished(snakemake(tmp_path, clone, "-n")))
    assert planned["eq_given_beam_polar"] == 1
    assert planned["eq_unsteady_case"] == 2


def test_keys_of_the_other_workflow_are_refused_by_name(clone: Path, tmp_path: Path) -> None:
    module(tmp_path, clone, "", {"cores": 5})
    (line,) = (line for line in said(snakemake(tmp_path, clone, "-n")) if "config:" in line)
    assert line.startswith("config: cores: 5: unknown key; ")


# -- from a clone that cannot be written to --------------------------------------------------


def as_a_user() -> tuple[str, ...]:
    """Return what goes before a command so that it cannot write where nobody may."""
    if os.geteuid() != 0:
        return ()
    if shutil.which("setpriv") is None:
        pytest.skip("root writes to what is read-only, without setpriv (util-linux)")
    return ("setpriv", "--bounding-set", "-dac_override")


@pytest.fixture
def read_only(tmp_path: Path) -> Iterator[Path]:
    """A clone that cannot be written to."""
    clone = Project.fresh(tmp_path / "clone").folder
    subprocess.run(["chmod", "-R", "a-w", clone], check=True)
    yield clone
    subprocess.run(["chmod", "-R", "u+w", clone], check=True)


def test_read_only_clone(read_only: Path, tmp_path: Path) -> None:
    """Results and Snakemake's own files go to the working directory."""
    user, here = as_a_user(), tmp_path / "here"
    assert subprocess.run([*user, "touch", read_only / "x"], check=False).returncode == 1
    files = sorted(read_only.rglob("*"))
    target = f"results/small/{STEADY}"
    options = ("--cores", "1", "--configfile", write(here, small(sweep=SWEEP)))
    started = ("-s", str(read_only / "Snakefile"), target, *options)
    finished(snakemake(here, read_only, *started, python=(*user, *SNAKEMAKE)))
    assert (here / target).is_file()
    assert sorted(read_only.rglob("*")) == files


# -- where it cannot start ------------------------------------------------------------------


def without(tmp_path: Path, *modules: str) -> tuple[str, ...]:
    """Return the start of Snakemake on a Python that has every package but some."""
    packages = tmp_path / "packages"
    packages.mkdir()
    for site in {Path(path) for path in sys.path if path.endswith("-packages")}:
        for path in site.iterdir():
            if path.name not in modules and path.suffix != ".pth":
                (packages / path.name).symlink_to(path)
    main = "from snakemake.cli import main; main()"
    start = f"import sys; sys.path.append({str(packages)!r}); sys.argv[0] = 'snakemake'; {main}"
    return (sys.executable, "-S", "-c", start)


def test_packages_that_are_missing(clone: Path, tmp_path: Path) -> None:
    python = without(tmp_path, "numpy", "netCDF4")
    (line,) = said(snakemake(tmp_path, clone, "-n", "-s", f"{clone}/Snakefile", python=python))
    assert line.startswith("equisection is not installed in ")
    assert "(missing: numpy, netCDF4): 'pip install -c envs/constraints.txt -e .' in " in line
    assert str(clone) in line


def test_default_configuration_that_is_none(clone: Path, tmp_path: Path) -> None:
    broken = tmp_path / "config/config.yaml"
    broken.parent.mkdir()
    broken.write_bytes("run: Flügel\n".encode("latin-1"))
    (line,) = said(snakemake(tmp_path, clone, "-n", "-s", str(clone / "Snakefile")))
    assert line.startswith("config: config/config.yaml, line 1, column 8: the byte 0xfc is not")


def test_braces_in_the_path_of_the_clone(clone: Path, tmp_path: Path) -> None:
    braces = tmp_path / "my {clone}"
    braces.symlink_to(clone, target_is_directory=True)
    (line,) = said(snakemake(tmp_path, clone, "-n", "-s", str(braces / "Snakefile")))
    assert "Snakemake takes what is in braces for a wildcard" in line


# -- what is said at the start ---------------------------------------------------------------


def test_what_a_dry_run_says_before_anything_is_computed(clone: Path, tmp_path: Path) -> None:
    """OpenFOAM in a folder with a blank, and a polar from the future."""
    here = tmp_path / "my documents"
    here.mkdir()
    rigid = shutil.copy(ROOT / "config/polars/paper_plate_3d.csv", here / "rigid.csv")
    os.utime(rigid, (2e10, 2e10))
    config: dict[str, object] = {
        "solver": "openfoam",
        "unsteady": {"time_step": 0.04, "output_interval": 0.2},
        "steady": {"beam_polar": "rigid.csv"},
        "sweep": {"models": ["2d"]},
    }
    started = ("-n", "-s", str(clone / "Snakefile"), "--configfile", write(here, config))
    lines = finished(snakemake(here, clone, *started)).splitlines()
    place, time = (line for line in lines if line.startswith("warning: "))
    assert place.startswith("warning: OpenFOAM takes no blank and no quote in a path")
    assert str(here / "results/.store") in place
    assert time.startswith("warning: rigid.csv is ")
    assert "ahead of this machine's clock" in time
