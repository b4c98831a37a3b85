"""Configurations that are wrong in one place."""

from collections.abc import Iterator

from tests.malformed.given import Malformed, no_files

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
#: Sections that a key needs around it, so that it is the one thing that is wrong.
GIVEN = "solver: given\nsteady: {resolution: own}\n"
GIVEN_POLARS = "polars: {own: own.csv}"
SECTION = (
    "cross_section: {bending_rigidity: 60, torsional_rigidity: 25, mass_per_length: 1.2, "
    "inertia_per_length: 0.006}"
)
#: Values that are none of these keys', by the key.
NO_VALUES = {
    "forced.motion": ("sine", "5"),
    "forced.reduced_velocity": ("[4, 3, 6, 8]", "[3]", "4", "[0, 1, 2, 3]", "[3, 3.01, 5, 7]"),
    "forced.amplitude_deg": ("0", "25", "1:30"),
    "forced.periods": ("1", "2.5"),
    "forced.settling": ("0", "1e300"),
    "forced.twist_deg": ("90", "5 deg"),
    "forced.beam_modes": ("-1", "13", "1.5"),
    "forced.run": ("maybe", "[true]"),
    "given.columns.time": ("''", "[t]"),
    "given.columns.speed": ("v",),
    "given.units.time": ("min", "S"),
    "given.units.lift": ("kN",),
    "given.signs.twist": ("0", "2", "up"),
    "given.span": ("0", "1e30"),
    "given.moment_axis": ("1.5", "quarter"),
    "given.release": ("nan", "now"),
    "given.basis": ("guess",),
    "given.polars": ("a.csv", "{'a b': x}", "{a: ''}"),
    "rom.confirm": ("1", "3", "-2", "[]", "[4, 4]", "[0]", "two", "2.5", "{a: 1}"),
    "rom.learn_from": ("5", "[]", "[4, 5, 6]", "[4, 4]", "[0]", "never"),
    "openfoam.turbulence": ("k-epsilon", "SST", "true"),
    "openfoam.turbulence_intensity": ("0", "5", "5 %", ".nan"),
    "openfoam.viscosity_ratio": ("0", "1e6", "ten"),
    "openfoam.turbulence_intensty": ("0.1",),
    "openfoam.inlet": ("5",),
    "openfoam.mesher": ("snappy",),
    "openfoam.far_field_chords": ("1", "'30 c'"),
    "openfoam.meshes": ("{}", "{a: huge}", "coarse"),
    "unsteady.start": ("5", "rigid", "{state: moving}", "{state: equilibrium}", "{twist: 1}"),
    "unsteady.start.twist_deg": ("90", "0.01", "-10", "1 deg"),
    "unsteady.start.heave_rate": ("1", "-1", "fast", ".nan"),
    "steady.beam_polar_section": ("own.csv", "[a]", "5"),
    "derivatives.table": ("none.csv", "[a]", "."),
}
#: Shapes that ``beam.outline`` is none of.
NO_SHAPES = (
    *("{}", "5", "naca0012", "[0012]", "{circle: 1}", "{naca: '0012', file: a.csv}"),
    *("{naca: 12}", "{naca: 0012}", "{naca: '00x2'}", "{naca: '0000'}", "{naca: 'NACA0012'}"),
    *("{naca: '23012'}", "{naca: '٠٠١٢'}", "{naca: '00１２'}", "{naca: true}"),
    *("{rectangle: {edge_radius: 1}}", "{rectangle: {thickness: 0}}", "{rectangle: 5}"),
    *("{rectangle: {height: 1}}", "{naca: '0012', chord: 1}", "{naca: '0012', axis: [0, 0]}"),
    *("{file: none.csv}", "{file: .}", "{file: [a]}", "{file: a.csv, axis: [1]}"),
    *("{file: a.csv, axis: tube}", "{file: a.csv, chord: 0}"),
)
#: Paths of forced motions that name no file, or none that there is.
NO_MOTIONS = (
    *("''", "data/{cas}.csv", "data/{case.csv", "data/case}.csv", "data/{model}.csv", "{}"),
    *("data/{k_star}/{case}.csv", "data/{0}.csv", "{case!r}.csv"),
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
    for key, values in NO_VALUES.items():
        for value in values:
            yield f"{key} is {value}", _nested(key, value), key
    for key in ("on", "No", "~", "010", "1.5", "2024-01-31"):
        yield f"key {key}", f"beam: {{{key}: 1}}\n", f"beam.{key}"


def _together() -> Iterator[tuple[str, str, str]]:
    """Give keys that are wrong together with others."""
    for shape in NO_SHAPES:
        text = f"structure: {{method: beam}}\nbeam:\n  {SECTION}\n  outline: {shape}\n"
        yield f"beam.outline is {shape}", text, "beam.outline"
    for path in NO_MOTIONS:
        quoted = path if path == "''" else f"'{path}'"
        text = f"{GIVEN}forced: {{run: true}}\ngiven: {{{GIVEN_POLARS}, forced: {quoted}}}\n"
        yield f"given.forced is {path}", text, "given.forced"
    path = "forced: 'data/{case}.csv'"
    modes = f"{GIVEN}forced: {{run: true, beam_modes: 1}}\ngiven: {{{GIVEN_POLARS}, {path}}}\n"
    yield "modes of a beam that nobody recorded", modes, "forced.beam_modes"
    for key, value in (("settling", "1e9"), ("reduced_velocity", "[3, 4, 6, 1e9]")):
        endless = f"forced: {{run: true, {key}: {value}}}\n"
        yield f"a forced motion without an end, {key} {value}", endless, "forced.settling"
    angles = ", ".join(f"{1 + place / 1000:g}" for place in range(500))
    many = f"sweep: {{speed: {{start: 1, stop: 50, number: 500}}, incidence_deg: [{angles}]}}\n"
    yield "250,000 cases of a model", many, "sweep.speed.number"
    laminar = "openfoam: {turbulence: laminar, mesh_motion: overset}\n"
    yield "laminar flow above an overset mesh", laminar, "openfoam.turbulence"


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
        for what, text, key in (*_texts(), *_together())
    ]
    for what, content, named in _bytes():
        text = content.encode() if isinstance(content, str) else content
        found.append(Malformed(what, "mine.yaml", text, named))
    return [*found, *no_files("mine.yaml")]
