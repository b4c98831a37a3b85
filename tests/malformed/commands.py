"""Command lines, answers at the terminal, and folders of runs that are wrong in one place."""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import xarray as xr

from equisection.results.netcdf import write_dataset
from equisection.run.command_line import main
from tests.malformed.given import ARABIC, JARGON, Malformed, judged

#: Folder of the run, its configuration, and the table with its answer.
RUN = "mine"
CONFIGURATION = """\
run: mine
beam: {chord: 0.8}
flow: {incidence_deg: 2.5, speed: 10.0, density: 1.2, dynamic_viscosity: 1.8e-5, sound_speed: 340.0}
steady: {resolution: fine}
"""
NAMES = "model,incidence_deg,speed,speed_low,speed_high,mechanism,frequency_hz,margin,basis,errs\n"
LINE = "3d,2.5,37.35,35.6,39.1,flutter,8.03,1.188,time,unsafe\n"
TABLE = "comparison/critical_speed.csv"
PICTURE = b"\x89PNG\r\n\x1a\n" + bytes(range(256))
LIKE_PLATE = ("init", RUN, "--like", "plate")


@dataclass(frozen=True)
class Call(Malformed):
    """A command that is to be refused; its files are those beside it.

    Attributes
    ----------
    words
        The command's words.
    answers
        What is typed at the terminal; None where there is none.
    status
        Exit status: 1, or 2 for a wrong usage.
    """

    words: tuple[str, ...] = ()
    answers: str | None = None
    status: int = 1


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def ran(one: Malformed, folder: Path) -> tuple[str, str]:
    """Return how the command takes it, in a word, and what it says; as of a configuration."""
    assert isinstance(one, Call)
    one.write(folder)
    before = sorted(folder.iterdir())
    out, err, status = io.StringIO(), io.StringIO(), 0
    keyboard = io.StringIO() if one.answers is None else _Terminal(one.answers)
    with contextlib.chdir(folder), contextlib.ExitStack() as stack:
        stack.enter_context(contextlib.redirect_stdout(out))
        stack.enter_context(contextlib.redirect_stderr(err))
        stack.callback(setattr, sys, "stdin", sys.stdin)
        sys.stdin = keyboard
        try:
            status = main(one.words)
        except SystemExit as error:  # a wrong usage
            status = int(error.code or 0)
        except Exception as error:  # whatever comes through
            return "uncaught", repr(error)
    said = err.getvalue()
    if status == 0:
        return "accepted", out.getvalue()
    if status != one.status:
        return f"status {status}", said
    if sorted(folder.iterdir()) != before:
        return "files were made", said
    if status == 2:
        clear = one.named in said and not any(word in said for word in JARGON)
        return ("named" if clear else "unnamed"), said
    return judged(one, said.removeprefix("error: "))


@cache
def foreign() -> bytes:
    """Return a sound NetCDF file that is nothing of a run."""
    says = {"units": "1", "long_name": "nothing of a run"}
    data = xr.Dataset({"a": ("x", [1.0, 2.0], says)}, {"x": ("x", [0, 1], says)})
    with TemporaryDirectory() as folder:
        write_dataset(Path(folder) / "foreign.nc", data)
        return (Path(folder) / "foreign.nc").read_bytes()


def calls() -> list[Malformed]:
    """Return the commands."""
    return [*_usages(), *_starts(), *_tables(), *_figures(), *_exports(), *_broken()]


def sound() -> list[Malformed]:
    """Return the commands that the malformed ones are made of."""
    whole: dict[str, str | bytes] = {f"{RUN}/{TABLE}": NAMES + LINE}
    answered = Call("answers", "", None, "", {}, ("init", RUN), "plate\n\n\n12.5\n")
    return [
        _call("start", f"{' '.join(LIKE_PLATE)} --design-speed=12.5", ""),
        answered,
        _call("answer", "onset mine", "", whole),
        _call("figure", "show mine a", "", {f"{RUN}/figures/a.png": "a"}),
        _call("rest", "export mine", "", _sound_export()),
    ]


def _sound_export() -> dict[str, str | bytes]:
    table = (Path(__file__).parents[2] / "config/derivatives/thin_plate.csv").read_bytes()
    return {f"{RUN}/config.resolved.yaml": CONFIGURATION, f"{RUN}/derivatives/2d.csv": table}


def _call(what: str, words: str, named: str, files: dict[str, str | bytes] | None = None) -> Call:
    further = {
        name: content.encode() if isinstance(content, str) else content
        for name, content in (files or {}).items()
    }
    return Call(what, "", None, named, further, tuple(words.split()))


def _usages() -> Iterator[Call]:
    """Give wrong usages, which argparse refuses with status 2."""
    for words, named in (
        ("onst mine", "invalid choice: 'onst'"),
        ("onset mine --jsn", "--jsn"),
        ("show", "RUN_FOLDER"),
        ("export", "RUN_FOLDER"),
        ("export mine --only", "--only"),
        ("export mine --only nonsense", "'nonsense'"),
        ("export mine --to", "--to"),
        ("init", "NAME"),
        ("init mine --like boat", "'boat'"),
        ("init mine further --like plate", "further"),
        ("polar", "RESULT"),
        ("completion fish", "'fish'"),
    ):
        yield Call(words, "", None, named, {}, tuple(words.split()), None, 2)


def _starts() -> Iterator[Call]:
    """Give names and dimensions that ``init`` refuses, as options and as answers."""
    no_numbers = (
        *("wide", "", "1_0", "12".translate(ARABIC), "0x5", "1e308", "1e-300", "nan", "inf"),
        *("-1", "0", "1:30", "5 m", "0,5", "010", "1e5000", "true", "9" * 100),
    )
    for value in no_numbers:
        words = (*LIKE_PLATE, f"--chord={value}")
        yield Call(f"init --chord={value[:9]}", "", None, "chord", {}, words)
        if value:  # no answer is the example's
            answers = f"plate\n{value}\n"
            yield Call(f"answer {value[:9]}", "", None, "nothing", {}, ("init", RUN), answers)
    for answers in ("", "boat\n", "\x1b[2J\n", "plate\n"):
        yield Call(f"answers {answers!r}", "", None, "nothing", {}, ("init", RUN), answers)
    for name in ("", "..", "a/b", "a b", "a\x1b[2J", "a" * 65, "ä"):
        yield Call(f"init {name[:9]!a}", "", None, "name", {}, ("init", name, "--like", "plate"))
    there = {"mine.yaml": b"run: precious\n"}
    yield Call("init, there already", "", None, "mine.yaml", there, LIKE_PLATE)
    yield Call("init, a folder there", "", None, "mine.yaml", {"mine.yaml/a": b""}, LIKE_PLATE)
    yield _call("init without a terminal", "init mine", "--like")


def _tables() -> Iterator[Call]:
    """Give tables of critical speeds that are none, to ``onset``."""
    yield _call("onset of nothing", "onset none", "none")
    yield _call("onset of a file", "onset mine", "mine", {"mine": "x"})
    yield _call("onset without a run", "onset", "results")
    several = {f"results/{name}/cases/a.json": "{}" for name in "ab"}
    yield _call("onset of several", "onset", "results/a", several)
    yield _call("a folder for the table", "onset mine", TABLE, {f"{RUN}/{TABLE}/a": ""})
    whole = NAMES + LINE
    changes = {
        "speed": (
            "37.35",
            ("-37.35", "1e308", "0x25", "3_7.35", "٣٧", "fast", "True", "3\x1b[2J7"),
        ),
        "low": ("35.6", ("inf", "45.6", "-1")),
        "frequency": ("8.03", ("fast", "-8")),
        "margin": ("1.188", ("x", "-1")),
        "incidence": ("2.5", ("400", "inf", "nan", "")),
        "mechanism": ("flutter", ("wobble", "5", "", "flut\x1b[2Jter")),
        "basis": ("time", ("oracle", "", "ti\x1b[2Jme")),
        "model": ("3d", ("", "3\x1b[2Jd")),
    }
    damaged: dict[str, str | bytes] = {
        f"{column} {value!a}": NAMES + LINE.replace(right, value)
        for column, (right, values) in changes.items()
        for value in values
    }
    damaged |= {
        "empty": "",
        "names alone": NAMES,
        "a picture": PICTURE,
        "UTF-16": whole.encode("utf-16"),
        "zeros": NAMES.encode() + bytes(100),
        "a value more": whole + LINE.strip() + ",7\n",
        "a value less": whole + LINE[:30] + "\n",
        "a column twice": NAMES.replace("errs", "speed") + LINE,
        "no speed": NAMES.replace("speed,", "fast,") + LINE,
        "semicolons": whole.replace(",", ";"),
        "an open quote": NAMES + '"' + LINE,
        "a web page": "<!doctype html>\n<html><body>404</body></html>\n",
    }
    for what, content in damaged.items():
        yield _call(f"onset, {what}", "onset mine", TABLE, {f"{RUN}/{TABLE}": content})


def _figures() -> Iterator[Call]:
    """Give figures that are not there, to ``show``."""
    figure: dict[str, str | bytes] = {f"{RUN}/figures/a.png": "a"}
    yield _call("figures of nothing", "show none", "none")
    yield _call("figures of a file", "show mine", "mine", {"mine": "x"})
    yield _call("no figures", "show mine", "figures", {f"{RUN}/a": ""})
    yield _call("a file for the figures", "show mine", "figures", {f"{RUN}/figures": ""})
    yield _call("a folder for a figure", "show mine", "figures", {f"{RUN}/figures/a.png/b": ""})
    yield _call("another figure", "show mine b", "'b'", figure)
    yield _call("a path for a figure", "show mine ../mine/figures/a", "figures/a'", figure)
    yield _call("an escape for a figure", "show mine a\x1b[2J", "no figure", figure)
    yield _call("copies to a file", "show mine --to f", "f: ", {**figure, "f": ""})


def _exports() -> Iterator[Call]:
    """Give runs that are none, or not whole, to ``export``."""
    config = f"{RUN}/config.resolved.yaml"
    sound: dict[str, str | bytes] = {config: CONFIGURATION}
    yield _call("export of nothing", "export none", "none")
    yield _call("export of a file", "export mine", "mine", {"mine": "x"})
    yield _call("export of a folder", "export mine", "config.resolved.yaml", {f"{RUN}/a": ""})
    yield _call("nothing to export", "export mine", "mine: nothing to export", sound)
    two = {"a/mine/x": "", "b/mine/x": ""}
    yield _call("two runs of one name", "export a/mine b/mine --to t", "--to t", two)
    laughs = [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    for what, content in (
        ("empty", ""),
        ("a list", "- a"),
        ("a picture", PICTURE),
        ("UTF-16", CONFIGURATION.encode("utf-16")),
        ("an open bracket", "a: [1"),
        ("3,000 brackets", f"{CONFIGURATION}x: {'[' * 3000}{']' * 3000}\n"),
        ("a billion laughs", "\n".join(["a0: &a0 [1, 1]", *laughs, CONFIGURATION])),
        ("an object of Python", CONFIGURATION + "x: !!python/object/apply:os.getcwd []\n"),
        ("no flow", "run: mine\nbeam: {chord: 1}\n"),
        ("an escape for a name", CONFIGURATION.replace("run: mine", 'run: "a\\e[2J"')),
        ("1:30 for a number", CONFIGURATION.replace("0.8", "1:30")),
    ):
        yield _call(f"export, {what}", "export mine", config, {config: content})
    for name in (
        *("steady/polar_2d.nc", "steady/polar_3d.nc", "structure/equivalent.nc"),
        *("structure/modes.nc", "rom/2d/model.nc"),
    ):
        for what, broken in (("a text", b"hello\n" * 999), ("foreign", foreign())):
            files = {**sound, f"{RUN}/{name}": broken}
            yield _call(f"export, {name} {what}", "export mine", name, files)
    for what, table in (
        ("a picture", PICTURE),
        ("empty", b""),
        ("another table", b"a,b\n1,2\n"),
        ("a text", b"hello world\n"),
    ):
        for name in ("derivatives/2d.csv", "derivatives/3d.csv"):
            files = {**sound, f"{RUN}/{name}": table}
            yield _call(f"export, {name} {what}", "export mine", name, files)


def _broken() -> Iterator[Call]:
    """Give folders and files that are none to the other commands."""
    for command in ("status", "verify", "polar", "keep", "seal", "cost-model", "check", "cost"):
        yield _call(f"{command} of nothing", f"{command} none", "none")
        yield _call(f"{command} of a text", f"{command} f", "f", {"f": "hello"})
    for what, content in (("a text", b"hello\n" * 999), ("zeros", bytes(2000))):
        files = {f"{RUN}/a.nc": content}
        yield _call(f"polar of {what}", "polar mine/a.nc", "mine/a.nc", files)
        yield _call(f"seal of {what}", "seal mine", "mine/a.nc", files)
    yield _call("polar of another file", "polar a.nc", "a.nc", {"a.nc": foreign()})
