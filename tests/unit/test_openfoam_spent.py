"""What a case took, by the logs of its programs."""

from pathlib import Path

from equisection.results.spent import Spent
from equisection.solvers.openfoam.time_spent import spent

START = """Build  : OPENFOAM=1912
Exec   : pimpleFoam
nProcs : {ranks}
Time = 1
ExecutionTime = 1.5 s  ClockTime = 2 s
Time = 2
ExecutionTime = {last} s  ClockTime = 4 s
"""


def test_all_starts_and_ranks_count(tmp_path: Path) -> None:
    (tmp_path / "steady").mkdir()
    (tmp_path / "steady" / "log.simpleFoam").write_text(START.format(ranks=2, last=3.0))
    # a start that was killed in the middle of a line, and the one after it
    killed = START.format(ranks=1, last=2.5) + "Time = 3\nExecutionTi"
    (tmp_path / "log.pimpleFoam").write_text(killed + START.format(ranks=1, last=7.25))
    (tmp_path / "log.checkMesh").write_text("Exec   : checkMesh\nMesh OK.\n")
    assert spent(tmp_path) == Spent(cpu_seconds=6.0 + 2.5 + 7.25, wall_seconds=12.0)


def test_nothing_that_ran_took_nothing(tmp_path: Path) -> None:
    assert spent(tmp_path) == Spent(0.0, 0.0)
