"""Histories of other programs: layouts, units, and files that cannot be used."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from equisection.errors import HistoryFileError
from equisection.io.history_file import HistoryColumns, HistoryScales, read_table

SCALES = HistoryScales(chord=0.2, density=1.2, speed=10.0, span=0.5)
NAMES = {name: name for name in ("time", "twist", "deflection", "lift", "moment")}
SI = {"time": "s", "twist": "rad", "deflection": "m", "lift": "N", "moment": "N m", "drag": "N"}
TIME = np.arange(40) * 0.01
ROWS = np.column_stack([TIME, np.sin(TIME), TIME**2, 1 + TIME, 2 - TIME])


def written(folder: Path, rows: np.ndarray = ROWS, head: str = "", separator: str = ",") -> Path:
    """Write rows below a line of names."""
    path = folder / "history.txt"
    lines = [separator.join(f"{value:.12g}" for value in row) for row in rows]
    path.write_text("\n".join([head or separator.join(NAMES), *lines]) + "\n")
    return path


def test_si_becomes_convective(tmp_path: Path) -> None:
    """s = t V/c, and F/(q c L) with q = 60 Pa."""
    found = read_table(written(tmp_path), HistoryColumns(NAMES, SI), SCALES)
    assert found.time == pytest.approx(TIME * 10.0 / 0.2)
    assert found.twist == pytest.approx(np.sin(TIME))
    assert found.deflection == pytest.approx(TIME**2 / 0.2)
    assert found.lift == pytest.approx((1 + TIME) / (60.0 * 0.2 * 0.5))
    assert found.moment == pytest.approx((2 - TIME) / (60.0 * 0.2**2 * 0.5))


@pytest.mark.parametrize(
    ("units", "factors"),
    [
        ({"time": "ms", "deflection": "mm", "twist": "deg"}, (0.001, math.radians(1), 0.001)),
        ({"time": "c/V", "deflection": "c"}, (0.02, 1.0, 0.2)),
        ({"time": "b/V", "deflection": "b"}, (0.01, 1.0, 0.1)),
    ],
    ids=str,
)
def test_other_units_are_multiples(
    tmp_path: Path, units: dict[str, str], factors: tuple[float, ...]
) -> None:
    si = read_table(written(tmp_path), HistoryColumns(NAMES, SI), SCALES)
    found = read_table(written(tmp_path), HistoryColumns(NAMES, SI | units), SCALES)
    for name, factor in zip(("time", "twist", "deflection"), factors, strict=True):
        assert getattr(found, name) == pytest.approx(factor * getattr(si, name))


@pytest.mark.parametrize(
    ("head", "separator"),
    [
        ("time;twist;deflection;lift;moment", ";"),
        ("time\ttwist\tdeflection\tlift\tmoment", "\t"),
        ("# time twist deflection lift moment", " "),
        ('"report"\n"flow"\n("time" "twist" "deflection" "lift" "moment")', " "),
    ],
)
def test_layouts_of_other_programs_hold_the_same(tmp_path: Path, head: str, separator: str) -> None:
    wanted = read_table(written(tmp_path), HistoryColumns(NAMES, SI), SCALES)
    path = written(tmp_path, head=head, separator=separator)
    assert read_table(path, HistoryColumns(NAMES, SI), SCALES).moment == pytest.approx(
        wanted.moment
    )


def test_signs_turn_columns_and_the_release_cuts(tmp_path: Path) -> None:
    columns = HistoryColumns(NAMES, SI, {"twist": -1}, release=0.1)
    found = read_table(written(tmp_path), columns, SCALES)
    assert found.time[0] == pytest.approx(0.0, abs=1e-9)
    assert found.twist == pytest.approx(-np.sin(TIME[10:]))


def test_resampling_is_of_fourth_order(tmp_path: Path) -> None:
    """Half the interval leaves a sixteenth of the error of a sine, between its samples."""
    errors = []
    for number in (20, 40):
        time = np.linspace(0.0, 3.0, number + 1)
        rows = np.column_stack([time, np.sin(time), time, time, time])
        table = read_table(written(tmp_path, rows), HistoryColumns(NAMES, SI), SCALES)
        inside = np.linspace(1.0, 2.0, 301)
        found = table.at(inside * SCALES.speed / SCALES.chord).twist
        errors.append(np.abs(found - np.sin(inside)).max())
    assert math.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.4)


def test_a_gap_a_repeat_and_a_word_are_named_with_their_lines(tmp_path: Path) -> None:
    columns = HistoryColumns(NAMES, SI)
    with pytest.raises(HistoryFileError, match=r"line 12: nothing between time 0\.09 and 0\.2"):
        read_table(written(tmp_path, np.delete(ROWS, range(10, 20), axis=0)), columns, SCALES)
    with pytest.raises(HistoryFileError, match=r"line 22: time goes from 0\.19 to 0\.15; .* run"):
        read_table(written(tmp_path, np.vstack([ROWS[:20], ROWS[15:]])), columns, SCALES)
    path = written(tmp_path)
    path.write_text(path.read_text().replace("0.05,", "0.05,nose,", 1).replace(",0.0025,", ",", 1))
    with pytest.raises(HistoryFileError, match=r"line 7: twist is 'nose'"):
        read_table(path, columns, SCALES)


def test_a_column_that_is_not_there_is_named_with_those_that_are(tmp_path: Path) -> None:
    columns = HistoryColumns(NAMES | {"twist": "theta"}, SI)
    with pytest.raises(HistoryFileError, match=r"twist \('theta'\); columns are 'time', 'twist'"):
        read_table(written(tmp_path), columns, SCALES)
    with pytest.raises(HistoryFileError, match="no such file"):
        read_table(tmp_path / "none.csv", columns, SCALES)


def test_a_release_outside_of_the_record_is_refused(tmp_path: Path) -> None:
    for release, words in ((5.0, "0 samples from the release at 5"), (-1.0, "after the release")):
        with pytest.raises(HistoryFileError, match=words):
            read_table(written(tmp_path), HistoryColumns(NAMES, SI, release=release), SCALES)


def test_columns_that_are_not_read_may_have_one_name_or_none(tmp_path: Path) -> None:
    """A program may write the same monitor twice, and a comma at the end of each line."""
    wanted = read_table(written(tmp_path), HistoryColumns(NAMES, SI), SCALES)
    more = np.column_stack([ROWS, TIME, 5.0 - TIME])
    head = ",".join([*NAMES, "drag", "drag", ""])
    path = written(tmp_path, more, head=head)
    path.write_text(path.read_text().replace("\n", ",\n").replace(",,\n", ",\n"))
    found = read_table(path, HistoryColumns(NAMES, SI), SCALES)
    assert found.moment == pytest.approx(wanted.moment)
