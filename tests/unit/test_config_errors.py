"""Whatever is wrong with a configuration is said in one line, with key, value and what is allowed.

No test looks for pydantic's words: they must not come through.
"""

import copy
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equisection.config import Config, load_config, resolve_config
from equisection.errors import ConfigError

JARGON = re.compile(
    r"Input should|valid (tuple|dict|number|integer|string|boolean)|pattern|finite number|"
    r"pydantic|union|discriminator|\btuple\b|unable to parse|Value error|type=",
    re.IGNORECASE,
)

INF, NAN = float("inf"), float("nan")

#: A section that is no homogeneous rectangle.
DECK = {
    "bending_rigidity": 6.4e14,
    "torsional_rigidity": 2e12,
    "mass_per_length": 22740.0,
    "inertia_per_length": 2.5e6,
}
#: A beam moved in its modes by OpenFOAM, whose section alone is let go.
MOVED_BEAM = {
    "solver": "openfoam",
    "unsteady": {"time_step": 0.02},
    "steady": {"beam_polar": "flat-plate"},
    "sweep": {"models": ["2d"]},
    "forced": {"run": True, "beam_modes": 1},
}
#: The configuration, the key's path, the value as shown, and what is allowed.
AXES = {"beam": {"cross_section": DECK, "chord": 31, "length": 900, "thickness": 4}}
MALFORMED = [
    # axes and damping
    (
        {"beam": {"elastic_axis": 33}},
        "beam.elastic_axis",
        "33",
        "write 0.33 for an axis at 33 % of the chord",
    ),
    (
        {"beam": {"mass_axis": "43"}},
        "beam.mass_axis",
        "43",
        "write 0.43 for a centre of mass at 43 % of the chord",
    ),
    (
        {"beam": {"elastic_axis": -0.17}},
        "beam.elastic_axis",
        "-0.17",
        "counted from mid-chord it would be an axis at 33 % of the chord, 0.33",
    ),
    ({"beam": {"elastic_axis": 600}}, "beam.elastic_axis", "600", "a number from 0 to 1"),
    ({"beam": {"elastic_axis": "33 %"}}, "beam.elastic_axis", "'33 %'", "without its unit"),
    ({"beam": {"elastic_axis": 0.33}}, "beam.elastic_axis", "0.33", "structure.method 'solid' is"),
    (
        {"beam": {"mass_axis": 0.43}, "structure": {"method": "beam"}},
        "beam.mass_axis",
        "0.43",
        "allowed is 0.5 without beam.cross_section",
    ),
    (
        {
            "beam": {**AXES["beam"], "mass_axis": 0.9},
            "structure": {"method": "beam"},
            "embedded": {"polars": {"coarse": "flat-plate"}},
        },
        "beam.cross_section.inertia_per_length",
        "2.5e+06",
        "above m d2 = 3.497e+06 kg m2/m: it is about the elastic axis, at 50 % of the chord, and "
        "the centre of mass is at 90 %",
    ),
    (
        {"beam": {"damping": {"torsion": -0.01}}},
        "beam.damping.torsion",
        "-0.01",
        "of at least 0 and below 0.2",
    ),
    ({"beam": {"damping": {"bending": 0.2}}}, "beam.damping.bending", "0.2", "and below 0.2"),
    ({"beam": {"damping": 0.01}}, "beam.damping", "0.01", "the keys bending, torsion"),
    (
        {
            "beam": {**AXES["beam"], "elastic_axis": 0.4, "mass_axis": 0.4},
            "structure": {"method": "beam"},
            "solver": "openfoam",
            "sweep": {"models": ["2d", "2d-corrected"]},
        },
        "sweep.models",
        "['2d', '2d-corrected']",
        "with solver 'openfoam' are models without 2d-corrected where",
    ),
    (
        {
            "beam": {**AXES["beam"], "mass_axis": 0.52},
            "structure": {"method": "beam"},
            "embedded": {"polars": {"coarse": "flat-plate"}},
            "reduction": "paper",
        },
        "reduction",
        "'paper'",
        "allowed is consistent where beam.elastic_axis and beam.mass_axis differ",
    ),
    (
        {"solver": "openfoam", "openfoam": {"turbulence": "laminar"}},
        "openfoam.turbulence",
        "'laminar'",
        "allowed is k-omega-sst with a beam in the flow: leave out the model 3d",
    ),
    (
        {**MOVED_BEAM, "openfoam": {"turbulence": "laminar"}},
        "openfoam.turbulence",
        "'laminar'",
        "allowed is k-omega-sst with forced.beam_modes; or forced.beam_modes: 0",
    ),
    (
        {**MOVED_BEAM, "flow": {"root_on_wall": False}},
        "flow.root_on_wall",
        "false",
        "allowed is true with forced.beam_modes and solver 'openfoam'",
    ),
    (
        {"openfoam": {"turbulence": "laminar", "mesh_motion": "overset"}},
        "openfoam.turbulence",
        "'laminar'",
        "allowed is k-omega-sst with openfoam.mesh_motion: overset",
    ),
    ({"embedded": {"moment_axis": 25}}, "embedded.moment_axis", "25", "from 0 to 1, or null"),
    # numbers
    ({"beam": {"chord": -0.1}}, "beam.chord", "-0.1", "a number above 0"),
    ({"beam": {"chord": 0}}, "beam.chord", "0", "a number above 0"),
    ({"beam": {"chord": True}}, "beam.chord", "true", "a number above 0"),
    ({"beam": {"chord": None}}, "beam.chord", "null", "leave the key out for its default"),
    ({"beam": {"chord": NAN}}, "beam.chord", ".nan", "neither infinite nor NaN"),
    ({"beam": {"chord": "inf"}}, "beam.chord", ".inf", "neither infinite nor NaN"),
    ({"beam": {"length": INF}}, "beam.length", ".inf", "neither infinite nor NaN"),
    ({"beam": {"chord": 10**400}}, "beam.chord", "1000000", "a number above 0"),
    ({"beam": {"chord": 10**5000}}, "beam.chord", "a number of 5000 digits", "to 1e+18"),
    ({"beam": {"chord": "1_0"}}, "beam.chord", "'1_0'", "a plain decimal with the digits 0 to 9"),
    ({"beam": {"chord": "0x5"}}, "beam.chord", "'0x5'", "a plain decimal with the digits 0 to 9"),
    ({"beam": {"chord": "010"}}, "beam.chord", "'010'", "a plain decimal with the digits 0 to 9"),
    ({"beam": {"chord": "1:30"}}, "beam.chord", "'1:30'", "a plain decimal with the digits 0 to 9"),
    ({"beam": {"chord": "\u0661\u0662"}}, "beam.chord", "'\u0661\u0662'", "with the digits 0 to 9"),
    ({"beam": {"chord": "\uff11\uff12"}}, "beam.chord", "'\uff11\uff12'", "with the digits 0 to 9"),
    ({"beam": {"length": 1e308}}, "beam.length", "1e+308", "in size from 1e-18 to 1e+18"),
    ({"beam": {"youngs_modulus": "2e19"}}, "beam.youngs_modulus", "'2e19'", "from 1e-18 to 1e+18"),
    ({"beam": {"thickness": 1e-300}}, "beam.thickness", "1e-300", "in size from 1e-18 to 1e+18"),
    ({"flow": {"incidence_deg": -1e-300}}, "flow.incidence_deg", "-1e-300", "from 1e-18"),
    ({"beam": {"chord": "0.1 m"}}, "beam.chord", "'0.1 m'", "write it without its unit"),
    ({"beam": {"chord": "0,1"}}, "beam.chord", "'0,1'", "write decimals with a point"),
    ({"beam": {"chord": "wide"}}, "beam.chord", "'wide'", "a number above 0"),
    ({"beam": {"chord": [0.1]}}, "beam.chord", "[0.1]", "a number above 0"),
    ({"beam": {"chord": {"m": 0.1}}}, "beam.chord", "{m: 0.1}", "a number above 0"),
    ({"beam": {"poisson_ratio": 0.5}}, "beam.poisson_ratio", "0.5", "above -1 and below 0.5"),
    ({"flow": {"incidence_deg": 90}}, "flow.incidence_deg", "90", "above -90 and below 90"),
    ({"structure": {"torsion_modes": 0}}, "structure.torsion_modes", "0", "from 1 to 12"),
    ({"structure": {"bending_modes": 2.5}}, "structure.bending_modes", "2.5", "a whole number"),
    ({"structure": {"elements": {"span": 1}}}, "structure.elements.span", "1", "from 2 to 4000"),
    ({"embedded": {"strips": 3}}, "embedded.strips", "3", "from 4 to 100"),
    ({"embedded": {"strips": True}}, "embedded.strips", "true", "from 4 to 100"),
    (
        {"flow": {"channel": {"downstream_chords": 1}}},
        "flow.channel.downstream_chords",
        "1",
        "of at least 2",
    ),
    (
        {"flow": {"channel": {"tip_gap_chords": -0.1}}},
        "flow.channel.tip_gap_chords",
        "-0.1",
        "of at least 0",
    ),
    (
        {"unsteady": {"verdict": {"steadiness": 0.5}}},
        "unsteady.verdict.steadiness",
        "0.5",
        "above 0 and below 0.5",
    ),
    # truths, choices and names
    (
        {"beam": {"cross_section": {**DECK, "inertia_per_length": 0}}},
        "beam.cross_section.inertia_per_length",
        "0",
        "a number above 0",
    ),
    (
        {"beam": {"cross_section": {"mass_per_length": 1}}, "structure": {"method": "beam"}},
        "beam.cross_section.torsional_rigidity",
        "null",
        "missing; allowed is a number above 0",
    ),
    ({"beam": {"cross_section": DECK}}, "structure.method", "'solid'", "beam and analytic"),
    (
        {"embedded": {"symmetric": False}, "flow": {"incidence_deg": 0}},
        "steady.incidence_deg",
        "[0, 1, 2",
        "on both sides of flow.incidence_deg, 0 deg",
    ),
    ({"flow": {"root_on_wall": 1}}, "flow.root_on_wall", "1", "true or false"),
    ({"embedded": {"symmetric": "maybe"}}, "embedded.symmetric", "'maybe'", "true or false"),
    ({"solver": "fluent"}, "solver", "'fluent'", "embedded"),
    ({"reduction": 1}, "reduction", "1", "one of consistent, paper"),
    ({"beam": {"boundary": "clamped"}}, "beam.boundary", "'clamped'", "clamped-free, clamped-cl"),
    ({"structure": {"method": "Beam"}}, "structure.method", "'Beam'", "did you mean 'beam'?"),
    ({"run": "a/b"}, "run", "'a/b'", "letters, digits"),
    ({"run": "../up"}, "run", "'../up'", "letters, digits"),
    ({"run": "a..b"}, "run", "'a..b'", "single dots inside"),
    ({"run": "end."}, "run", "'end.'", "single dots inside"),
    ({"run": ".hidden"}, "run", "'.hidden'", "starts with a letter"),
    ({"run": "line\n"}, "run", r"'line\n'", "letters, digits"),
    ({"run": "x" * 65}, "run", "'xxx", "64 at most"),
    ({"run": 2024}, "run", "2024", "put it in quotes"),
    ({"run": ""}, "run", "''", "letters, digits"),
    ({"run": "reference"}, "run", "'reference'", "another name"),
    # sections
    ({"beam": None}, "beam", "null", "a section with the keys chord, length"),
    ({"flow": 3}, "flow", "3", "a section with the keys speed"),
    ({"sweep": [4, 5]}, "sweep", "[4, 5]", "a section with the keys k_star"),
    ({"flow": {"channel": "wide"}}, "flow.channel", "'wide'", "height_chords"),
    ({"unsteady": {"verdict": 5}}, "unsteady.verdict", "5", "a section with the keys"),
    # unknown keys
    ({"beem": {}}, "beem", "{}", "did you mean 'beam'?"),
    ({"beam": {"lenght": 1}}, "beam.lenght", "1", "did you mean 'length'?"),
    ({"beam": {"colour": "red"}}, "beam.colour", "'red'", "allowed here are chord, length"),
    ({"k_star": [5]}, "k_star", "[5]", "did you mean sweep.k_star?"),
    ({"sweep.k_star": [5]}, "sweep.k_star", "[5]", "inside the section 'sweep'"),
    ({"beam": {"speed": 5}}, "beam.speed", "5", "did you mean flow.speed or sweep.speed?"),
    (
        {"flow": {"channel": {"height": 4}}},
        "flow.channel.height",
        "4",
        "did you mean 'height_chords'?",
    ),
    (
        {"sweep": {"k_star": {"start": 1, "stop": 2, "number": 3, "range": 1}}},
        "sweep.k_star.range",
        "1",
        "allowed here are start, stop, number",
    ),
    ({1: 2}, "1", "", "allowed here are run"),
    ({"new\nline": 2}, r"'new\nline'", "2", "unknown key"),
    # lists
    ({"sweep": {"k_star": 5}}, "sweep.k_star", "5", "a list of 1 or more"),
    ({"sweep": {"k_star": "4, 5"}}, "sweep.k_star", "'4, 5'", "a list is written [a, b]"),
    ({"sweep": {"k_star": []}}, "sweep.k_star", "[]", "a list of 1 or more"),
    ({"sweep": {"k_star": None}}, "sweep.k_star", "null", "null with sweep.speed alone"),
    ({"sweep": {"k_star": [5], "speed": [20]}}, "sweep.speed", "[20]", "one of sweep.k_star and"),
    ({"sweep": {"speed": [20, 200]}}, "sweep.speed", "200", "up to 102 m/s, Mach 0.3"),
    ({"sweep": {"speed": [20, 20]}}, "sweep.speed.1", "20", "allowed is each speed once"),
    ({"figure_formats": ["svg"]}, "figure_formats", "['svg']", "allowed is 'png'"),
    ({"sweep": {"speed": [-3]}}, "sweep.speed.0", "-3", "a number above 0"),
    ({"sweep": {"speed": [30], "onset": "refine"}}, "sweep.speed", "[30]", "two speeds or more"),
    ({"sweep": {"onset_reach": 0.5}}, "sweep.onset_reach", "0.5", "from 1 to 100"),
    ({"flow": {"design_speed": 0}}, "flow.design_speed", "0", "a number above 0, or null"),
    ({"sweep": {"k_star": [5, 6, 0]}}, "sweep.k_star.2", "0", "a number above 0"),
    ({"sweep": {"k_star": [5, "six"]}}, "sweep.k_star.1", "'six'", "a number above 0"),
    ({"sweep": {"k_star": [5, 6, 5.0000001]}}, "sweep.k_star.2", "5.0000001", "each k* once"),
    ({"sweep": {"k_star": {"start": 5}}}, "sweep.k_star.stop", "null", "missing"),
    (
        {"sweep": {"k_star": {"start": 5, "stop": 4, "number": 3}}},
        "sweep.k_star.stop",
        "4",
        "above start, 5",
    ),
    (
        {"sweep": {"k_star": {"start": 5, "stop": 5.0001, "number": 99}}},
        "sweep.k_star.number",
        "99",
        "fewer values",
    ),
    (
        {"sweep": {"k_star": {"start": 5, "stop": 6, "number": 1}}},
        "sweep.k_star.number",
        "1",
        "a whole number from 2 to 20000",
    ),
    ({"sweep": {"models": "3d"}}, "sweep.models", "'3d'", "a list of 1 or more, each one of 2d"),
    ({"sweep": {"models": ["3d", "4d"]}}, "sweep.models.1", "'4d'", "one of 2d, 2d-corrected"),
    ({"sweep": {"models": ["3d", "2d", "3d"]}}, "sweep.models.2", "'3d'", "each model once"),
    (
        {"sweep": {"models": ["2d", "3d"], "taken": {"3d": "other/unsteady/3d/sweep.json"}}},
        "sweep.taken.3d",
        "'other/unsteady/3d/sweep.json'",
        "a model that is not in sweep.models",
    ),
    (
        {"sweep": {"models": ["2d"], "taken": {"3d": "other/unsteady/2d/sweep.json"}}},
        "sweep.taken.3d",
        "'other/unsteady/2d/sweep.json'",
        "an index of results of this model",
    ),
    ({"compute": False, "reuse": ""}, "reuse", "''", "a folder with results"),
    (
        {"correction": "modal", "steady": {"beam_polar": "config/polars/paper_plate_3d.csv"}},
        "correction",
        "'modal'",
        "'mean' with steady.beam_polar",
    ),
    (
        {
            "sweep": {"onset": "model", "models": ["2d"]},
            "unsteady": {"start": {"state": "equilibrium", "twist_deg": 0.2}},
        },
        "unsteady.start.state",
        "'equilibrium'",
        "allowed with sweep.onset 'model' is 'rigid'",
    ),
    (
        {"sweep": {"onset": "refine", "k_star": [3]}},
        "sweep.k_star",
        "[3",
        "allowed with sweep.onset 'refine' are two k* or more",
    ),
    (
        {"compute": False, "sweep": {"onset": "refine"}},
        "sweep.onset",
        "'refine'",
        "'sweep' or 'model' where compute is false",
    ),
    ({"steady": {"incidence_deg": [0, 1]}}, "steady.incidence_deg", "[0, 1]", "of 4 or more"),
    (
        {"steady": {"incidence_deg": [0, 2, 1, 3]}},
        "steady.incidence_deg.2",
        "1",
        "above the one before it, 2 deg",
    ),
    (
        {"steady": {"incidence_deg": [0, 2, 2.0000001, 3]}},
        "steady.incidence_deg.2",
        "2.0000001",
        "first six digits",
    ),
    ({"steady": {"incidence_deg": [0, 1, 2, 95]}}, "steady.incidence_deg.3", "95", "below 90"),
    ({"flow": {"incidence_deg": 0}}, "flow.incidence_deg", "0", "nothing sets it in motion"),
    ({"flow": {"incidence_deg": 0}}, "flow.incidence_deg", "0", "0 with unsteady.start.twist_deg"),
    (
        {"unsteady": {"start": {"twist_deg": 0.02}}},
        "unsteady.start.twist_deg",
        "0.02",
        "0, or between 0.05 and 6 deg",
    ),
    ({"unsteady": {"start": {"twist_deg": -7}}}, "unsteady.start.twist_deg", "-7", "either way"),
    ({"unsteady": {"start": {"heave_rate": 2}}}, "unsteady.start.heave_rate", "2", "below 1"),
    (
        {"unsteady": {"start": {"state": "equilibrium"}}},
        "unsteady.start.state",
        "'equilibrium'",
        "with unsteady.start.twist_deg, such as 0.2",
    ),
    (
        {
            "solver": "openfoam",
            "unsteady": {"time_step": 0.02, "start": {"state": "equilibrium", "twist_deg": 0.2}},
            "steady": {"beam_polar": "config/polars/paper_plate_3d.csv"},
        },
        "steady.beam_polar",
        "'config/polars/paper_plate_3d.csv'",
        "the equilibrium is that of the loads along the span",
    ),
    (
        {"solver": "given", "unsteady": {"start": {"state": "equilibrium", "twist_deg": 0.2}}},
        "unsteady.start.state",
        "'equilibrium'",
        "'rigid' with solver 'given'",
    ),
    ({"embedded": {"incidence_point": 0}}, "embedded.incidence_point", "0", "0.25"),
    (
        {"flow": {"incidence_deg": 0}, "embedded": {"symmetric": False}, "solver": "openfoam"},
        "flow.incidence_deg",
        "0",
        "nothing sets it in motion",
    ),
    ({"steady": {"study": ["coarse"]}}, "steady.study.0", "'coarse'", "neither before it"),
    (
        {"steady": {"study_incidence_deg": [0, 2.6]}},
        "steady.study_incidence_deg.1",
        "2.6",
        "an angle of steady.incidence_deg: 0, 1, 2, 2.5",
    ),
    (
        {"steady": {"study_incidence_deg": [5, 5]}},
        "steady.study_incidence_deg.1",
        "5",
        "does not stand before it",
    ),
    (
        {"structure": {"mesh_study": [{"chord": 4, "sapn": 3}]}},
        "structure.mesh_study.0.sapn",
        "3",
        "did you mean 'span'?",
    ),
    (
        {"structure": {"mesh_study": [{"chord": 8}, {"chord": 4}]}},
        "structure.mesh_study.1",
        "{chord: 4",
        "no fewer elements",
    ),
    # what keys must agree on
    ({"beam": {"thickness": 0.05}}, "beam.thickness", "0.05", "below half the chord, 0.05 m"),
    ({"beam": {"length": 0.1}}, "beam.length", "0.1", "above the chord, beam.chord = 0.1 m"),
    (
        {"beam": {"boundary": "spring-root", "root_bending_stiffness": 1}},
        "beam.root_torsional_stiffness",
        "null",
        "nothing else holds the root",
    ),
    (
        {"beam": {"root_bending_stiffness": 1}},
        "beam.root_bending_stiffness",
        "1",
        "null with boundary 'clamped-free'",
    ),
    (
        {"beam": {"boundary": "one-fork"}},
        "beam.boundary",
        "'one-fork'",
        "clamped-pinned; or give structure.method: beam or analytic",
    ),
    ({"flow": {"speed": 120}}, "flow.speed", "120", "up to 102 m/s, Mach 0.3"),
    ({"flow": {"incidence_deg": 12}}, "flow.incidence_deg", "12", "0 to 10 deg"),
    (
        {"flow": {"channel": {"tip_gap_chords": 0}}},
        "flow.channel.tip_gap_chords",
        "0",
        "free tip of boundary 'clamped-free'",
    ),
    ({"steady": {"resolution": "fine"}}, "steady.resolution", "'fine'", "embedded.polars: coarse"),
    ({"steady": {"study": ["fine"]}}, "steady.study.0", "'fine'", "embedded.polars: coarse"),
    (
        {"unsteady": {"verdict": {"growing_amplitude_deg": 0.01}}},
        "unsteady.verdict.growing_amplitude_deg",
        "0.01",
        "above settled_amplitude_deg, 0.05 deg",
    ),
    ({"unsteady": {"duration": 0.5}}, "unsteady.duration", "0.5", "ten output intervals"),
    ({"unsteady": {"duration": 1e9}}, "unsteady.duration", "1e+09", "up to 10,000,000 time steps"),
    (
        {"flow": {"channel": {"height_chords": 1e9}}},
        "flow.channel.height_chords",
        "1e+09",
        "a number above 1 and of at most 1e+06",
    ),
    ({"beam": {"thickness": 1e-6}}, "beam.thickness", "1e-06", "0.000452 m or more, 1/819 of the"),
    (
        {"unsteady": {"output_interval": 0.12}},
        "unsteady.output_interval",
        "0.12",
        "the time step, 0.05 c/V, or a multiple",
    ),
    (
        {"embedded": {"separation": {"relaxation": 0, "delay": 1}}},
        "embedded.separation.delay",
        "1",
        "0 where relaxation is 0",
    ),
    # polars
    ({"embedded": {"polars": {}}}, "embedded.polars", "{}", "one or more pairs"),
    ({"embedded": {"polars": "x.csv"}}, "embedded.polars", "'x.csv'", "pairs `name: text`"),
    ({"embedded": {"polars": {"coarse": 3}}}, "embedded.polars.coarse", "3", "put it in quotes"),
    ({"embedded": {"polars": {"a b": "x"}}}, "embedded.polars.a b", "'a b'", "letters, digits"),
    ({"embedded": {"polars": {"list": 5}}}, "embedded.polars.list", "5", "allowed is text"),
]


def lines_of(raw):
    with pytest.raises(ConfigError) as caught:
        load_config(raw)
    return str(caught.value).splitlines()


@pytest.mark.parametrize(("raw", "key", "value", "allowed"), MALFORMED)
def test_refused_with_key_value_and_what_is_allowed(raw, key, value, allowed):
    lines = lines_of(raw)
    line = next(line for line in lines if line.startswith(f"config: {key}: {value}"))
    assert allowed in line.removeprefix(f"config: {key}: {value}")
    assert not JARGON.search("\n".join(lines))
    assert len(lines) == len(set(lines))
    assert all(line.startswith("config: ") for line in lines)


@pytest.mark.parametrize("raw", [[], "beam", 5, None])
def test_what_is_no_mapping_is_refused(raw):
    assert len(lines_of(raw)) == 1


def test_several_problems_give_several_lines():
    lines = lines_of(
        {
            "run": "a/b",
            "beam": {"chord": True, "lenght": 0.05},
            "flow": {"channel": {"tip_gap_chords": 0}, "incidence_deg": 45},
            "sweep": {"k_star": [5, 5, -1]},
        }
    )
    keys = [line.split(": ")[1] for line in lines]
    assert keys == [
        "run",
        "beam.chord",
        "beam.lenght",
        "sweep.k_star.2",
        "flow.channel.tip_gap_chords",
        "flow.incidence_deg",
    ]


def test_a_mistake_is_not_reported_twice():
    """Checks that read a wrong key, or one that an unknown key stands for, keep silent."""
    assert len(lines_of({"beam": {"chord": "x", "thickness": 3}})) == 1
    assert len(lines_of({"beam": {"chord": 0.5, "lenght": 3}})) == 1
    assert len(lines_of({"structure": {"mesh_study": [5]}})) == 1


def test_long_values_are_cut():
    (line,) = lines_of({"beam": {"chord": "x" * 10000}})
    assert len(line) < 200


def test_a_model_without_a_name_is_refused_in_words():
    """Its place in the schema is that of any further key."""
    lines = lines_of({"sweep": {"taken": {None: None}}})
    assert any("sweep.taken.None: null: allowed is text" in line for line in lines)


def test_values_that_hold_themselves():
    loop = {}
    loop["beam"] = loop
    assert lines_of(loop)


def _paths(values, prefix=()):
    for key, value in values.items():
        yield (*prefix, key)
        if isinstance(value, dict):
            yield from _paths(value, (*prefix, key))


PATHS = list(_paths(resolve_config(Config())))
SCALARS = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=8)
    | st.dates()
    | st.binary(max_size=4)
)
JUNK = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(SCALARS, inner, max_size=4),
    max_leaves=8,
)


def accepted_or_refused(raw):
    """Load; what is accepted resolves to something that loads to the same."""
    refusal = None
    try:
        config = load_config(raw)
    except ConfigError as error:
        refusal = str(error)
    if refusal is None:
        resolved = resolve_config(config)
        assert load_config(resolved) == config
        assert resolve_config(load_config(resolved)) == resolved
    else:
        assert refusal
        assert all(line.startswith("config: ") for line in refusal.split("\n"))
        assert not JARGON.search(re.sub(r"'.*'", "", refusal))


@given(JUNK)
def test_junk_is_refused_in_words(raw):
    accepted_or_refused(raw)


@given(st.dictionaries(st.sampled_from(PATHS), JUNK | st.floats(0.01, 50), max_size=4))
def test_junk_at_known_keys_is_refused_in_words(values):
    raw = {}
    for path, value in values.items():
        section = raw
        for key in path[:-1]:
            section = section.setdefault(key, {})
            if not isinstance(section, dict):
                break
        else:
            section[path[-1]] = copy.deepcopy(value)
    accepted_or_refused(raw)


@given(
    chord=st.floats(0.01, 10),
    aspect=st.floats(1.1, 30),
    k_star=st.lists(st.integers(1, 500), min_size=1, unique=True),
    channel=st.none() | st.fixed_dictionaries({"tip_gap_chords": st.floats(0.01, 3)}),
    incidence_deg=st.floats(0.01, 10),
)
def test_resolving_and_loading_again_changes_nothing(chord, aspect, k_star, channel, incidence_deg):
    raw = {
        "beam": {"chord": chord, "length": aspect * chord, "thickness": 0.04 * chord},
        "flow": {"channel": channel, "incidence_deg": incidence_deg},
        "sweep": {"k_star": [value / 10 for value in k_star]},
    }
    config = load_config(raw)
    assert load_config(resolve_config(config)) == config


def test_many_problems_are_told_a_few_at_a_time() -> None:
    with pytest.raises(ConfigError) as caught:
        load_config({"sweep": {"k_star": [0.1] * 50}})
    *lines, last = str(caught.value).split("\n")
    assert len(lines) == 12
    assert all(line.startswith("config: sweep.k_star.") for line in lines)
    assert last == "config: and 37 more; mend these first"
