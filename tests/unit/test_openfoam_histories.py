"""Histories that OpenFOAM writes: columns by name, restarts that overlap, files cut short."""

from pathlib import Path

import numpy as np
import pytest

from equisection.errors import SolverError
from equisection.motion.modal_response import ModalState
from equisection.solvers.openfoam.beam.beam_history import add_row, keep_until, require_state
from equisection.solvers.openfoam.reading.histories import read_history, read_table
from equisection.solvers.openfoam.reading.loads import Loads, reasonable

HEADER = "# Force coefficients\n# CofR : (0 0 0)\n# Time\tCd\tCl\tCmPitch\n"


def write(folder: Path, start: str, rows: str, name: str = "coefficient.dat") -> Path:
    path = folder / start / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER + rows)
    return path


def test_columns_are_found_by_their_names(tmp_path: Path) -> None:
    write(tmp_path, "0", "1\t2\t3\t4\n2\t5\t6\t7\n")
    history = read_history(tmp_path, "coefficient.dat", ["CmPitch", "Cd"])
    assert history["CmPitch"].tolist() == [4, 7]
    assert history["Cd"].tolist() == [2, 5]


def test_vectors_have_three_components(tmp_path: Path) -> None:
    path = tmp_path / "motion.dat"
    path.write_text("# Angle Units : radians\n# Time\tx\trotation\n1\t(1 2 3)\t(0 0 -1e-3)\n")
    np.testing.assert_allclose(read_table(path, ["rotation"])["rotation"], [[0, 0, -1e-3]])


def test_later_start_replaces_what_it_repeats(tmp_path: Path) -> None:
    write(tmp_path, "0", "1 0 1 0\n2 0 2 0\n3 0 3 0\n")
    write(tmp_path, "2", "3 0 30 0\n4 0 40 0\n")
    write(tmp_path, "10", "11 0 110 0\n")
    history = read_history(tmp_path, "coefficient.dat", ["Cl"])
    assert history["Time"].tolist() == [1, 2, 3, 4, 11]
    assert history["Cl"].tolist() == [1, 2, 30, 40, 110]


def test_second_start_from_the_same_time(tmp_path: Path) -> None:
    write(tmp_path, "0", "1 0 1 0\n2 0 2 0\n")
    write(tmp_path, "0", "1 0 10 0\n", "coefficient_0.dat")
    assert read_history(tmp_path, "coefficient.dat", ["Cl"])["Cl"].tolist() == [10]


@pytest.mark.parametrize("left", ["", "# Fo", HEADER[:-5], HEADER])
def test_start_that_was_killed_before_its_first_row_is_passed_over(
    tmp_path: Path, left: str
) -> None:
    write(tmp_path, "0", "1 0 1 0\n2 0 2 0\n")
    killed = write(tmp_path, "2", "")
    killed.write_text(left)
    write(tmp_path, "2", "3 0 3 0\n", "coefficient_2.dat")
    assert read_history(tmp_path, "coefficient.dat", ["Cl"])["Cl"].tolist() == [1, 2, 3]


@pytest.mark.parametrize("last", ["2 0 2", "2 0 2.", "2 0 2 0", ""])
def test_row_that_is_not_whole_is_left_out(tmp_path: Path, last: str) -> None:
    path = write(tmp_path, "0", f"1 0 1 0\n{last}")
    assert read_table(path, ["Cl"])["Cl"].tolist() == [1]


def test_truncated_row_inside_is_an_error(tmp_path: Path) -> None:
    path = write(tmp_path, "0", "1 0 1 0\n2 0\n3 0 3 0\n")
    with pytest.raises(SolverError, match="row 2 has 2 columns, wanted are 4"):
        read_table(path, ["Cl"])


def test_row_without_numbers_is_an_error(tmp_path: Path) -> None:
    path = write(tmp_path, "0", "1 0 1 0\n2 0 x 0\n3 0 3 0\n")
    with pytest.raises(SolverError, match=r"holds no numbers .*'x'"):
        read_table(path, ["Cl"])


@pytest.mark.parametrize(
    "header", ["# Time\tCm\tCd\tCl\tCl(f)\tCl(r)\n", "1 2 3 4\n", "# forces\n", ""]
)
def test_unknown_layout_is_refused(tmp_path: Path, header: str) -> None:
    path = tmp_path / "coefficient.dat"
    path.write_text(header)
    with pytest.raises(SolverError, match="version of OpenFOAM that is not known here"):
        read_table(path, ["Cl", "CmPitch"])


def test_missing_history_says_so(tmp_path: Path) -> None:
    with pytest.raises(SolverError, match=r"no coefficient\.dat"):
        read_history(tmp_path, "coefficient.dat", ["Cl"])


def test_loads_count_until_they_are_beyond_reason() -> None:
    time = np.arange(100.0)
    lift = np.where(time < 60, 0.4, 1e5)
    lift[0] = 1e4  # an impulsive start
    loads = Loads(time, np.zeros(100), lift, np.zeros(100))
    assert reasonable(loads) == 60
    lift[3] = np.nan
    assert reasonable(loads) == 3


STEP = 0.04


def structure(path: Path, rows: int) -> None:
    """Write the history of two modes over a number of steps."""
    with path.open("w", encoding="ascii") as stream:
        for number in range(rows):
            state = ModalState(number * STEP, *(np.full(2, float(number)) for _ in range(4)))
            add_row(stream, state, 0.3, 0.07)


def test_structure_is_taken_up_from_the_step_before_the_flow(tmp_path: Path) -> None:
    structure(tmp_path / "structure.txt", 101)
    state = keep_until(tmp_path / "structure.txt", 4.0 - 0.5 * STEP, 2).state()
    require_state(state, 4.0, STEP, tmp_path)
    assert state is not None
    assert state.time == pytest.approx(4.0 - STEP)


@pytest.mark.parametrize(("rows", "known"), [(90, "3.56 c/V"), (0, "nothing")])
def test_steps_that_are_missing_in_the_structure_are_not_passed_over(
    tmp_path: Path, rows: int, known: str
) -> None:
    structure(tmp_path / "structure.txt", rows)
    state = keep_until(tmp_path / "structure.txt", 4.0 - 0.5 * STEP, 2).state()
    with pytest.raises(SolverError, match=f"from 4 c/V, the structure from {known}: steps are"):
        require_state(state, 4.0, STEP, tmp_path)
