"""The configuration resolves to the paper's plate, and the files made from the models fit."""

import shutil
from pathlib import Path

import pytest
import yaml

from equisection.aerodynamics.separation import IDENTIFIED_LAGS
from equisection.beam.beam import BOUNDARIES
from equisection.config import Config, check_files, input_files, load_config, resolve_config
from equisection.config.__main__ import COMMAND, MARK, README, SCHEMA, main
from equisection.config.groups import Range
from equisection.errors import ConfigError
from equisection.keys.values import NULL_WORDS
from equisection.structure.solid import SOLID_BOUNDARIES
from equisection.study import plan

ROOT = Path(__file__).parents[2]
#: A time step that OpenFOAM takes.
STEP = {"time_step": 0.02}
EXAMPLES = sorted((ROOT / "config/examples").glob("*.yaml"))


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def merged(base, other):
    """Add a configuration to another the way Snakemake does."""
    result = dict(base)
    for key, value in other.items():
        below = result.get(key)
        both = isinstance(value, dict) and isinstance(below, dict)
        result[key] = merged(below, value) if both else value
    return result


def test_default_configuration_is_that_of_the_models():
    assert load_config(read(ROOT / "config/config.yaml")) == Config()


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_examples_resolve_and_their_files_exist(example):
    config = load_config(merged(read(ROOT / "config/config.yaml"), read(example)))
    check_files(config, ROOT)
    assert config.run == example.stem.replace("_", "-")


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_boundaries_that_the_solid_lacks_are_refused_with_it_alone(boundary):
    beam = {"boundary": boundary}
    if boundary == "spring-root":
        beam |= {"root_torsional_stiffness": 4.0, "root_bending_stiffness": 1e5}
    load_config({"beam": beam, "structure": {"method": "beam"}})
    if boundary in SOLID_BOUNDARIES:
        load_config({"beam": beam})
    else:
        with pytest.raises(ConfigError, match=f"beam.boundary: '{boundary}': .* 'solid'"):
            load_config({"beam": beam})


def test_there_are_examples():
    assert {path.stem for path in EXAMPLES} >= {
        "free_air_wing",
        "own_polar",
        "photovoltaic_panel",
    }


def test_default_lags_are_the_identified_ones():
    lags = Config().embedded.separation.model_dump()
    assert lags == {name: getattr(IDENTIFIED_LAGS, name) for name in lags}


def test_schema_and_reference_are_those_of_the_models(capsys):
    status = main(["--check"])
    assert status == 0, capsys.readouterr().out + f"\nto mend it: {COMMAND}"


def test_check_shows_the_difference_and_the_command(tmp_path, capsys):
    for path in (SCHEMA, README):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / path, tmp_path / path)
    file = tmp_path / SCHEMA
    file.write_text(file.read_text().replace("Chord c (m).", "Chord b (m)."))
    before = file.read_text()

    assert main(["--check"], tmp_path) == 1
    printed = capsys.readouterr()
    assert "-        description: Chord b (m)." in printed.out
    assert "+        description: Chord c (m)." in printed.out
    assert COMMAND in printed.err
    assert file.read_text() == before

    assert main([], tmp_path) == 0
    assert main(["--check"], tmp_path) == 0


def test_what_is_written_by_hand_stays(tmp_path):
    readme = tmp_path / README
    readme.parent.mkdir()
    readme.write_text(f"by hand\n\n{MARK}an old table\n")
    main([], tmp_path)
    text = readme.read_text()
    assert text.startswith(f"by hand\n\n{MARK}")
    assert "an old table" not in text


def test_every_key_is_described_and_listed():
    text = (ROOT / README).read_text(encoding="utf-8")

    def keys(values, prefix=""):
        for name, value in values.items():
            yield prefix + name
            if isinstance(value, dict) and name not in ("polars", "meshes"):
                yield from keys(value, f"{prefix}{name}.")

    missing = [key for key in keys(resolve_config(Config())) if f"| `{key}` |" not in text]
    assert not missing


@pytest.mark.parametrize(
    ("written", "number"),
    [("3.3e9", 3.3e9), ("3.3e+9", 3.3e9), (" 70e9 ", 70e9), (2000000000, 2e9)],
)
def test_numbers_may_be_text(written, number):
    modulus = load_config({"beam": {"youngs_modulus": written}}).beam.youngs_modulus
    assert modulus == number
    assert isinstance(modulus, float)


def test_whole_numbers_may_be_text_or_float():
    elements = load_config({"structure": {"elements": {"chord": "12", "span": 40.0}}})
    assert (elements.structure.elements.chord, elements.structure.elements.span) == (12, 40)


@pytest.mark.parametrize("word", [None, *sorted(NULL_WORDS)])
def test_null_may_be_text_where_null_is_allowed(word):
    assert load_config({"flow": {"channel": word}}).flow.channel is None


@pytest.mark.parametrize(("word", "truth"), [("true", True), ("False", False), ("no", False)])
def test_truths_may_be_text(word, truth):
    assert load_config({"flow": {"root_on_wall": word}}).flow.root_on_wall is truth


def test_values_of_the_sweep_ascend():
    assert load_config({"sweep": {"k_star": [9, "5", 7.5]}}).sweep.values() == (5.0, 7.5, 9.0)
    evenly = load_config({"sweep": {"k_star": {"start": 4, "stop": 6, "number": 5}}}).sweep
    assert isinstance(evenly.k_star, Range)
    assert evenly.values() == (4.0, 4.5, 5.0, 5.5, 6.0)


def test_missing_polars_are_named_with_the_place_and_a_guess(tmp_path):
    (tmp_path / "polars").mkdir()
    (tmp_path / "polars/wing.csv").touch()
    polars = {
        "coarse": "polars/wnig.csv",
        "good": "polars/wing.csv",
        "absolute": str(tmp_path / "polars/wing.csv"),
        "thin": "flat-plate",
        "folder": "polars",
        "odd": "\0",
    }
    config = load_config({"embedded": {"polars": polars}})
    with pytest.raises(ConfigError) as caught:
        check_files(config, tmp_path)
    first, folder, odd = str(caught.value).splitlines()
    assert first.startswith("config: embedded.polars.coarse: 'polars/wnig.csv': no such file")
    assert f"seen from {tmp_path};" in first
    assert first.endswith("did you mean 'polars/wing.csv'?")
    assert folder.startswith("config: embedded.polars.folder: 'polars': a folder")
    assert odd.startswith("config: embedded.polars.odd:")


def test_polars_are_looked_up_in_the_working_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError, match=str(tmp_path)):
        check_files(Config())
    monkeypatch.chdir(ROOT)
    check_files(Config())


def test_flat_plate_is_no_polar_of_the_beam(tmp_path):
    config = load_config(
        {"solver": "openfoam", "unsteady": STEP, "steady": {"beam_polar": "flat-plate"}}
    )
    with pytest.raises(ConfigError, match=r"beam_polar: 'flat-plate': .* in embedded\.polars$"):
        check_files(config, tmp_path)


def test_results_that_are_only_taken_must_be_there(tmp_path):
    index = "results/other/unsteady/3d/sweep.json"
    config = load_config(
        {
            "solver": "openfoam",
            "unsteady": STEP,
            "compute": False,
            "reuse": "kept",
            "sweep": {"models": ["2d"], "taken": {"3d": index}},
        }
    )
    with pytest.raises(ConfigError) as caught:
        check_files(config, tmp_path)
    reuse, taken = str(caught.value).splitlines()
    assert reuse.startswith(f"config: reuse: 'kept': no such folder, seen from {tmp_path}")
    assert taken.startswith(f"config: sweep.taken.3d: '{index}': no such file")
    (tmp_path / "kept").mkdir()
    (tmp_path / index).parent.mkdir(parents=True)
    (tmp_path / index).touch()
    check_files(config, tmp_path)


@pytest.mark.parametrize("reuse", ["", "results/reference"])
def test_results_to_reuse_may_be_none_where_cases_are_computed(reuse, tmp_path):
    check_files(load_config({"solver": "openfoam", "unsteady": STEP, "reuse": reuse}), tmp_path)


def test_folder_to_reuse_that_is_not_there_is_refused(tmp_path):
    """A slip of the pen would run for hours what is kept."""
    config = load_config({"solver": "openfoam", "unsteady": STEP, "reuse": "results/refrence"})
    with pytest.raises(ConfigError, match=r'reuse: .results/refrence.: no such folder.* or ""'):
        check_files(config, tmp_path)
    (tmp_path / "results/refrence").mkdir(parents=True)
    check_files(config, tmp_path)


def test_folder_to_reuse_that_holds_far_too_much_is_asked_back(tmp_path, monkeypatch):
    """A whole disk (`reuse: /`) would be looked through at each start and by each job."""
    monkeypatch.setattr(input_files, "MOST_KEPT", 3)
    kept = tmp_path / "kept"
    (kept / "deep/er").mkdir(parents=True)
    (kept / "a.nc").touch()
    (kept / "deep/round").symlink_to(kept)
    config = load_config({"solver": "openfoam", "unsteady": STEP, "reuse": str(kept)})
    with pytest.raises(ConfigError, match=r"more than 3 files and folders, .* with results alone"):
        check_files(config, tmp_path)
    (kept / "a.nc").unlink()
    check_files(config, tmp_path)


@pytest.mark.parametrize("nothing", [None, ""])
def test_polar_of_the_beam_of_another_file_is_taken_back(nothing):
    raw = merged(read(ROOT / "config/openfoam.yaml"), {"steady": {"beam_polar": nothing}})
    config = load_config(raw)
    assert config.steady.beam_polar == ""
    assert plan.steady_dimensions(config) == ("2d", "3d")
