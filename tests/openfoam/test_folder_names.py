"""Which folders the installed OpenFOAM works in: those that are refused are those it fails in."""

import subprocess
from pathlib import Path

import pytest

from equisection.config.groups.openfoam_keys import refused_path
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import Installation

CUBE = """
FoamFile {version 2.0; format ascii; class dictionary; object blockMeshDict;}
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) (2 2 2) simpleGrading (1 1 1));
edges ();
boundary ();
"""


def makes_a_mesh(installation: Installation, folder: Path) -> bool:
    """Start the program itself, without the check that comes before it."""
    write_system(folder, control("blockMesh", 1, 1, 1), {}, {})
    (folder / "system" / "blockMeshDict").write_text(CUBE)
    command, variables = installation.command("blockMesh"), installation.variables()
    subprocess.run(command, cwd=folder, env=variables, capture_output=True, check=False)
    return (folder / "constant" / "polyMesh" / "points").is_file()


@pytest.mark.parametrize("name", ["a[b](c)", "ümlaut-日本", "a;b{c}$d#e&f,g:h*i"])
def test_folder_that_is_not_refused_works(
    name: str, installation: Installation, tmp_path: Path
) -> None:
    assert not refused_path(tmp_path / name)
    assert makes_a_mesh(installation, tmp_path / name)


def test_link_to_a_folder_without_blanks_works(installation: Installation, tmp_path: Path) -> None:
    (tmp_path / "store").mkdir()
    (tmp_path / "my documents").mkdir()
    link = tmp_path / "my documents" / "store"
    link.symlink_to(tmp_path / "store")
    assert not refused_path(link / "case")
    assert makes_a_mesh(installation, link / "case")


@pytest.mark.parametrize("name", ["a b", "a'b", 'a"b'])
def test_folder_that_is_refused_does_not(
    name: str, installation: Installation, tmp_path: Path
) -> None:
    """If a newer OpenFOAM takes it, the refusal has to go."""
    assert refused_path(tmp_path / name)
    assert not makes_a_mesh(installation, tmp_path / name)
