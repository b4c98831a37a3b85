"""What deploys the project agrees with the project: image, hooks, forms, continuous integration."""

import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
MAKEFILE = (ROOT / "Makefile").read_text()
OF_GITHUB = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / ".github").rglob("*.yml"))


@pytest.mark.parametrize(
    "name", [".snakemake-workflow-catalog.yml", ".pre-commit-config.yaml", *OF_GITHUB]
)
def test_file_is_yaml(name: str) -> None:
    assert isinstance(yaml.safe_load((ROOT / name).read_text()), dict)


def test_image_has_what_make_installs() -> None:
    """It is installed by a target of the Makefile, which takes the pins."""
    dockerfile = (ROOT / "Dockerfile").read_text()
    (target,) = re.findall(r"\bmake (\w+)", re.sub(r"#.*", "", dockerfile).replace("apt-get", ""))[
        -1:
    ]
    rule = re.search(rf"^\$\(ENV\)/{target}: .*\n((?:\t.*\n)+)", MAKEFILE, re.MULTILINE)
    assert rule is not None
    assert "--constraint envs/constraints.txt" in rule[1]
    # the environment that is put on the path is the one that make makes
    assert re.search(r"^ENV := (.*)$", MAKEFILE, re.MULTILINE)[1] == ".venv"  # type: ignore[index]
    folder = re.findall(r"^WORKDIR (.*)$", dockerfile, re.MULTILINE)[0]
    assert f"PATH={folder}/.venv/bin:" in dockerfile


def test_nothing_that_the_workflow_reads_stays_outside_of_the_image() -> None:
    outside = (ROOT / ".dockerignore").read_text().split("\n")
    needed = {"Snakefile", "Makefile", "config", "envs", "scripts", "workflow", "pyproject.toml"}
    assert not needed & {line.strip("/") for line in outside}
    assert "!results/reference" in outside  # kept results, which the default run may reuse


def test_continuous_integration_begins_with_the_oldest_python_that_is_allowed() -> None:
    matrix = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text())
    tested = matrix["jobs"]["check"]["strategy"]["matrix"]["python"]
    oldest = re.search(r'requires-python = ">=([\d.]+)"', (ROOT / "pyproject.toml").read_text())
    assert oldest is not None
    assert tested[0] == oldest[1]
    minors = [int(version.removeprefix("3.")) for version in tested]
    assert minors == list(range(minors[0], minors[-1] + 1))


def test_hooks_do_what_make_lint_does() -> None:
    """And fetch nothing: their programs are those of the environment."""
    (repository,) = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())["repos"]
    assert repository["repo"] == "local"
    lint = re.search(r"^lint: .*\n((?:\t.*\n)+)", MAKEFILE, re.MULTILINE)
    assert lint is not None
    linted = lint[1].replace("$(BIN)/", ".venv/bin/")
    for hook in repository["hooks"]:
        assert hook["language"] == "system"
        assert hook["entry"].split(" --")[0] in linted


def test_catalogue_says_what_deploys_the_rules() -> None:
    """An environment of conda would need the package; a container would need to be named."""
    told = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    rules = "".join(
        path.read_text()
        for path in [ROOT / "workflow/Snakefile", *(ROOT / "workflow/rules").glob("*.smk")]
    )
    environment = yaml.safe_load((ROOT / "envs/environment.yaml").read_text())
    deployed = told["software-stack-deployment"]
    assert deployed["conda"] == any(
        isinstance(package, dict) for package in environment["dependencies"]
    )
    assert deployed["apptainer"] == bool(re.search(r"^\s*container:", rules, re.MULTILINE))
