"""A stand-in for the programs of OpenFOAM: the same files, in no time, and faults on demand.

    EQUISECTION_OPENFOAM="python tests/openfoam_stand_in.py"

The free section is an oscillator under loads that its motion damps. Rows and states are written
piece by piece, so that a kill leaves what kills leave. ``STAND_IN_FAULT`` names what
goes wrong, ``STAND_IN_SOFTEST`` the torsional stiffness k*/2 below which it does,
``STAND_IN_WRONG_FROM`` the time of the fault.

``STAND_IN_HOLD``, as ``pimpleFoam:17:/tmp/held``, holds the program behind the 17th piece that it
writes: half a row, or half a state. It writes its number to the file and waits to be killed, or for
``/tmp/held.go``. Where the file is there already nothing is held.
"""

import contextlib
import itertools
import json
import os
import re
import signal
import sys
import time
from pathlib import Path
from typing import TextIO

END = "// ************************************************************************* //\n"
FIELDS = ("U", "p", "k", "omega", "nut", "phi")
FATAL = """

--> FOAM FATAL {kind}:
{words}

    From function virtual void Foam::standIn::solve()
    in file standIn.C at line 1.

FOAM exiting

"""
FAULT = os.environ.get("STAND_IN_FAULT", "")
#: Time (c/V) from which a fault is due.
WRONG_FROM = float(os.environ.get("STAND_IN_WRONG_FROM", "7"))
HOLD = os.environ.get("STAND_IN_HOLD", "::").split(":", 2)
#: Pieces that have been written.
written = itertools.count(1)


def main(program: str, arguments: list[str]) -> None:
    if arguments == ["-help"]:
        print("Using: OpenFOAM-v1912 (1912) - a stand-in")
    elif program == "blockMesh":
        write(Path("constant/polyMesh/points"), "points\n")
    elif program == "checkMesh":
        skewed = " ***Max skewness = 9, 3 highly skew faces\nFailed 1 mesh checks."
        print(skewed if FAULT == "mesh" else "Mesh OK.")
    elif program == "simpleFoam":
        steady()
    elif program == "pimpleFoam":
        free()
    else:
        sys.exit(f"the stand-in has no {program}")


def steady() -> None:
    loads = history("loads", "0", "coefficient.dat", "Cd Cl CmPitch")
    for iteration in range(1, int(entry("controlDict", "endTime")) + 1):
        say(f"Time = {iteration}\n")
        row(loads, iteration, "0.05 0.38 0.075")
        say("ExecutionTime = 0 s\n")
        time.sleep(0.001)
        if iteration >= 400 or Path("stop").exists():
            write_state(str(iteration), {})
            return


def free() -> None:
    step, end = entry("controlDict", "deltaT"), entry("controlDict", "endTime")
    states = round(entry("controlDict", "writeInterval") / step)
    softness, stiffness = springs()
    start = max((float(path.name), path.name) for path in times())[1]
    motion = {"twist": 0.0, "rate": 0.0, "lift": 0.0, "speed": 0.0}
    if start != "0":
        motion = json.loads((Path(start) / "uniform/time").read_text().partition("\n")[0])
    if FAULT == "library":
        go_wrong(0.0)
    loads = places = None
    wrong = stiffness < float(os.environ.get("STAND_IN_SOFTEST", "inf"))
    for number in range(round(float(start) / step) + 1, round(end / step) + 1):
        now = f"{number * step:.10g}"
        say(f"Time = {now}\n\n")
        lift, moment = 0.38 - 0.5 * motion["speed"], 0.075 - 0.5 * motion["rate"]
        motion["rate"] += step * (moment - 2 * stiffness * motion["twist"]) / 8.8
        motion["twist"] += step * motion["rate"]
        motion["speed"] += step * (lift - 2 * softness * motion["lift"]) / 80
        motion["lift"] += step * motion["speed"]
        if wrong and (FAULT in ("set-up", "start") or number * step >= WRONG_FROM):
            lift = go_wrong(lift)
        if loads is None or places is None:  # opened behind the first step, as by OpenFOAM
            loads = history("loads", start, "coefficient.dat", "Cd Cl CmPitch")
            places = history(
                "motion", start, "sixDoFRigidBodyState.dat", "centreOfRotation rotation"
            )
        # the loads are about the centre at rest
        seen = lift + 0.05 * (-1) ** number if FAULT == "zigzag" else lift
        row(loads, now, f"0.05 {seen!r} {moment + 0.05 * motion['lift']!r}")
        row(places, now, f"(0 {motion['lift']!r} 0) (0 0 {-motion['twist']!r})")
        say("ExecutionTime = 0 s\n")
        stop = Path("stop").exists()
        if number % states == 0 or stop:
            write_state(now, motion)
        if stop:
            return


def go_wrong(lift: float) -> float:
    if FAULT == "library":
        say(FATAL.format(kind="ERROR", words='could not load "liboverset.so"'))
        sys.exit(1)
    if FAULT == "set-up":
        say(FATAL.format(kind="ERROR", words="Unknown solver type GAMMG"))
        sys.exit(1)
    if FAULT == "fatal":
        say(FATAL.format(kind="ERROR", words="Maximum number of iterations exceeded: 1000"))
        sys.exit(1)
    if FAULT == "file":
        say(FATAL.format(kind="IO ERROR", words='error in IOstream "U" for operation'))
        sys.exit(1)
    if FAULT in ("fpe", "start"):
        os.kill(os.getpid(), signal.SIGFPE)
    if FAULT == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    return float("nan") if FAULT == "nan" else lift


def entry(name: str, key: str) -> float:
    found = re.search(rf"^{key} (.*);", (Path("system") / name).read_text(), re.MULTILINE)
    assert found is not None
    return float(found[1])


def springs() -> tuple[float, float]:
    text = Path("constant/dynamicMeshDict").read_text()
    bending, torsion = re.findall(r"stiffness (.*);", text)
    return float(bending), float(torsion)


def times() -> list[Path]:
    return [path for path in Path().iterdir() if re.fullmatch(r"[0-9.]+", path.name)]


def history(function: str, start: str, name: str, columns: str) -> TextIO:
    """Open a history as OpenFOAM does: a second start from a time has it in the file's name."""
    path = Path("postProcessing") / function / start / name
    if path.exists():
        path = path.with_name(f"{path.stem}_{start}{path.suffix}")
    path.parent.mkdir(parents=True, exist_ok=True)
    opened = path.open("w")
    pieces(opened, f"# a stand-in\n# Time {columns}\n")
    return opened


def row(file: TextIO, now: object, values: str) -> None:
    pieces(file, f"{now} {values}\n")


def pieces(file: TextIO, text: str) -> None:
    for part in (text[: len(text) // 2], text[len(text) // 2 :]):
        file.write(part)
        file.flush()
        if HOLD[:2] == [sys.argv[1], str(next(written))]:
            hold(Path(HOLD[2]))


def hold(place: Path) -> None:
    with contextlib.suppress(FileExistsError), place.open("x") as opened:
        opened.write(f"{os.getpid()}\n")
        opened.flush()
        while not Path(f"{place}.go").exists():
            time.sleep(0.02)


def write_state(now: str, motion: dict[str, float]) -> None:
    for name in FIELDS:
        write(Path(now) / name, "values\n" * 1000 + END)
    write(Path(now) / "uniform" / "time", f"{json.dumps(motion)}\n{END}")
    old = sorted((path for path in times() if path.name != "0"), key=lambda path: float(path.name))
    for path in old[:-2]:
        for file in sorted(path.rglob("*"), reverse=True):
            file.rmdir() if file.is_dir() else file.unlink()
        path.rmdir()


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as opened:
        pieces(opened, text)


def say(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
