"""Configurations that are wrong in one place."""

from collections.abc import Iterator

from tests.malformed.given import Malformed

#: Keys that take a number, with the section around them.
NUMBERS = (
    "beam.chord",
    "beam.length",
    "beam.thickness",
    "beam.youngs_modulus",
    "beam.density",
    "beam.poisson_ratio",
    "flow.speed",
    "flow.density",
    "flow.incidence_deg",
    "flow.channel.height_chords",
    "structure.torsion_modes",
    "unsteady.duration",
    "unsteady.time_step",
    "embedded.strips",
)
#: What YAML 1.1, Python or a person may read as a number, and a decimal is not.
NO_NUMBERS = (
    *("1:30", "1:30.5", "010", "0o17", "0x5", "0b1", "1_0", "1_0.5", "１２", "١٢", "²", "½"),
    *("1,5", "5 m", "5m", "5 %", "1e", "1.2.3", "--5", "5 6", "−5", "1e308", "-1e308"),
    *("1.0e-300", "1e5000", ".nan", ".inf", "-.inf", "nan", "true", "No", "null", "''", "wide"),
    *(
        "[1]",
        "[]",
        "{m: 1}",
        "2024-01-31",
        "2024-13-45",
        "!!int '010'",
        "!!float 1:30",
        "!!set {a}",
    ),
    *("!!binary aGk=", "!!python/name:os.system", "!mine 5", "9" * 400, "0." + "9" * 5000),
)
SECTIONS = (
    *("beam", "flow", "structure", "steady", "sweep", "unsteady", "embedded", "openfoam", "given"),
    *("forced", "derivatives", "rom", "uncertainty"),
)
CHOICES = ("solver", "reduction", "correction", "beam.boundary", "structure.method", "sweep.onset")
#: Values that are no lists of k*, by their place below it.
NO_LISTS = {
    "5": "",
    "4, 5": "",
    "[]": "",
    "[4, 0]": ".1",
    "[4, -1]": ".1",
    "[4, five]": ".1",
    "[4, 5, 4]": ".2",
    "[4, .nan]": ".1",
    "[4, 1e30]": ".1",
    "[[4]]": ".0",
    "[4, null]": ".1",
    "{start: 5, stop: 6}": ".number",
    "{start: 5, stop: 4, number: 3}": ".stop",
    "{start: 1, stop: 4, number: 1}": ".number",
}
MISSPELT = (
    *("beam.chrod", "beam.lenght", "beam.Chord", "beam.youngs modulus", "flow.sped", "flow.V"),
    *("sweep.k-star", "sweep.kstar", "steady.incidence", "unsteady.dt", "embedded.polar", "solvr"),
    *("openfoam.mesh", "given.history", "rom.learn", "forced.runs", "structure.elements.chords"),
)
MOST = "more than 10000 keys and values"


def _nested(path: str, value: str) -> str:
    """Return YAML of a value at a path of keys."""
    *sections, key = path.split(".")
    lines = [f"{'  ' * depth}{name}:" for depth, name in enumerate(sections)]
    return "\n".join([*lines, f"{'  ' * len(sections)}{key}: {value}"]) + "\n"


def _texts() -> Iterator[tuple[str, str, str]]:
    """Give what is wrong, the file, and what is to be named."""
    for place, value in enumerate(NO_NUMBERS):
        for step in (0, 5, 9):
            key = NUMBERS[(place + step) % len(NUMBERS)]
            yield f"{key} is {value[:20]}", _nested(key, value), key
    for place, section in enumerate(SECTIONS):
        for value in ("5", "text", "[1, 2]", "true")[place % 2 :: 2]:
            yield f"{section} is {value}", _nested(section, value), section
    for key in CHOICES:
        for value in ("nonsense", "[a, b]", "5"):
            yield f"{key} is {value}", _nested(key, value), key
    for value, place_below in NO_LISTS.items():
        key = "sweep.k_star"
        yield f"{key} is {value}", _nested(key, value), key + place_below
    for key in MISSPELT:
        yield f"misspelt {key}", _nested(key, "5"), key
    for key in ("on", "No", "~", "010", "1.5", "2024-01-31"):
        yield f"key {key}", f"beam: {{{key}: 1}}\n", f"beam.{key}"


def _bytes() -> Iterator[tuple[str, str | bytes, str]]:
    """Give what is wrong with a file as a whole, its content, and what is to be named."""
    laughs = [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    good = "run: a\nbeam: {chord: 0.2}\n"
    yield from (
        ("empty", "", "holds nothing"),
        ("a comment alone", "# run: a\n", "holds nothing"),
        ("a text", "beam", "holds a text"),
        ("a list", "- beam\n", "holds a list"),
        ("two documents", "run: a\n---\nrun: b\n", "line 2"),
        ("a tab", "beam:\n\tchord: 1\n", "line 2"),
        ("two colons", "beam: chord: 1\n", "line 1"),
        ("an open bracket", "sweep: {k_star: [1\nrun: a\n", "line 2"),
        ("an open quote", 'run: "a\n', "line "),
        ("no alias", "beam: *b\n", "line 1"),
        ("an alias of what holds it", "a: &a [*a]\n", "*a"),
        ("a mapping that holds itself", "a: &a\n  b: {c: *a}\n", "*a"),
        ("a billion laughs", "\n".join(["a0: &a0 [1, 1]", *laughs]), MOST),
        ("10^5 values", f"a: [{'1,' * 10**5}]\n", MOST),
        ("10^6 values", f"a: [{'1,' * 10**6}]\n", "larger than 1 MB"),
        ("3,000 brackets", "[" * 3000 + "]" * 3000, "nested more than 30 deep"),
        ("3,000 mappings", "{a: " * 3000 + "1" + "}" * 3000, "nested more than 30 deep"),
        ("10^5 open brackets", "[" * 10**5, "nested more than 30 deep"),
        ("a key that is a list", "? [1]\n: 2\n", "line 1"),
        ("a key twice", "beam: {chord: 1}\nrun: a\nbeam: {length: 2}\n", "lines 1 and 3"),
        ("a key twice in JSON", '{"run": "a",\n "run": "b"}', "lines 1 and 2"),
        ("Python to be executed", "__use_yte__: true\n?print(5): 1\n", "__use_yte__"),
        ("an object of Python", "run: !!python/object/apply:os.getcwd []\n", "!!python/object"),
        ("Latin-1", "run: Flügel\n".encode("latin-1"), "0xfc is not UTF-8"),
        ("UTF-16", good.encode("utf-16"), "UTF-16"),
        ("UTF-16 without its mark", good.encode("utf-16-le"), "0x00"),
        ("UTF-32", good.encode("utf-32"), "UTF-32"),
        ("a picture", b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "0x89"),
        ("zeros", bytes(100), "0x00"),
        ("a bell", good.encode() + b"x: \x07\n", "0x07"),
        ("an escape in a name", 'run: "\\e[2J"\n', "run: "),
        ("a line end in a key", '"new\\nline": 1\n', r"'new\nline'"),
    )


def configurations() -> list[Malformed]:
    """Return the malformed configurations."""
    found = [
        Malformed(what, "mine.yaml", text.encode(), f"config: {key}")
        for what, text, key in _texts()
    ]
    for what, content, named in _bytes():
        text = content.encode() if isinstance(content, str) else content
        found.append(Malformed(what, "mine.yaml", text, named))
    return found
