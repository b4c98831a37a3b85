"""OpenFOAM is found in each of the ways in which it is installed, and missed in clear words."""

from pathlib import Path

import pytest

from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from equisection.errors import SolverError
from equisection.solvers.openfoam.installation import PROGRAMS, Installation, find, version_in

NOWHERE = Path("/nonexistent")


@pytest.fixture(autouse=True)
def clean_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("WM_PROJECT_DIR", PREFIX_VARIABLE):
        monkeypatch.delenv(name, raising=False)


def with_programs(folder: Path, *names: str, script: str = "#!/bin/sh\n") -> str:
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(script)
        (folder / name).chmod(0o755)
    return str(folder)


def debian(folder: Path) -> Path:
    (folder / "etc").mkdir(parents=True)
    (folder / "etc" / "controlDict").touch()
    return folder


def test_nothing_says_how_to_install(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"not on this machine.*make openfoam"):
        find(str(tmp_path), NOWHERE)


def test_part_of_it_names_what_is_missing(tmp_path: Path) -> None:
    search = with_programs(tmp_path / "bin", "blockMesh", "checkMesh", "simpleFoam")
    with pytest.raises(SolverError, match="not whole, pimpleFoam, postProcess missing"):
        find(search, NOWHERE)


def test_package_of_debian_needs_its_folder_alone(tmp_path: Path) -> None:
    search, place = with_programs(tmp_path / "bin", *PROGRAMS), debian(tmp_path / "share")
    found = find(search, place)
    assert found.command("blockMesh") == ["blockMesh"]
    assert found.variables()["WM_PROJECT_DIR"] == str(place)


def test_sourced_environment_stays_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("WM_PROJECT_DIR", "/opt/OpenFOAM-v2312")
    search = with_programs(tmp_path / "bin", *PROGRAMS)
    found = find(search, debian(tmp_path / "share"))
    assert found.variables()["WM_PROJECT_DIR"] == "/opt/OpenFOAM-v2312"
    assert found.environment == {}


def test_programs_without_their_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match="source the etc/bashrc"):
        find(with_programs(tmp_path / "bin", *PROGRAMS), NOWHERE)


def test_newest_launcher_is_taken(tmp_path: Path) -> None:
    search = with_programs(tmp_path / "bin", "openfoam2112", "openfoam2312", "openfoam-selector")
    assert find(search, NOWHERE).command("blockMesh") == ["openfoam2312", "blockMesh"]


def test_prefix_goes_before_everything(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PREFIX_VARIABLE, "docker run --rm image")
    search = with_programs(tmp_path / "bin", "docker", *PROGRAMS)
    found = find(search, debian(tmp_path / "share"))
    assert found.command("blockMesh") == ["docker", "run", "--rm", "image", "blockMesh"]


def test_prefix_that_is_not_there_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PREFIX_VARIABLE, "openfoam9999")
    with pytest.raises(SolverError, match="no program 'openfoam9999'"):
        find(str(tmp_path), NOWHERE)


def test_version_is_what_the_programs_say(tmp_path: Path) -> None:
    script = "#!/bin/sh\necho 'Using: OpenFOAM-v2312 (2312) - visit www.openfoam.com'\n"
    search = with_programs(tmp_path / "bin", "openfoam2312", script=script)
    installation = find(search, NOWHERE)
    whole = type(installation)((f"{search}/openfoam2312",))
    assert whole.version() == "v2312"


@pytest.mark.parametrize(
    ("text", "version"),
    [
        ("Using: OpenFOAM- (1912) - visit www.openfoam.com", "v1912"),
        ("Using: OpenFOAM-v2312 (2312) - visit www.openfoam.com", "v2312"),
        ("Using: OpenFOAM-11 (see https://openfoam.org)", "v11"),
        ("no word of it", "unknown"),
    ],
)
def test_version_in_what_is_said(text: str, version: str) -> None:
    assert version_in(text) == version


def test_programs_that_do_not_start_say_so(tmp_path: Path) -> None:
    script = "#!/bin/sh\necho 'Could not find mandatory etc entry' >&2\nexit 1\n"
    search = with_programs(tmp_path / "bin", "openfoam2111", script=script)
    broken = type(find(search, NOWHERE))((f"{search}/openfoam2111",))
    with pytest.raises(SolverError, match="Could not find mandatory etc entry"):
        broken.version()


def test_one_rank_is_started_without_a_launcher() -> None:
    found = Installation(("openfoam2312",), launcher="srun")
    assert found.command("simpleFoam") == ["openfoam2312", "simpleFoam"]


def test_mpirun_is_that_of_the_installation() -> None:
    found = Installation(("openfoam2312",))
    words = ["openfoam2312", "mpirun", "-n", "4", "simpleFoam", "-parallel"]
    assert found.command("simpleFoam", 4) == words


def test_launcher_of_a_scheduler_starts_the_container_on_each_rank() -> None:
    found = Installation(("apptainer", "exec", "of.sif"), launcher="srun --mpi=pmix")
    launch, container = ["srun", "--mpi=pmix", "-n", "4"], ["apptainer", "exec", "of.sif"]
    assert found.command("simpleFoam", 4) == [*launch, *container, "simpleFoam", "-parallel"]
