"""A configuration to start from: an example with another name and the user's dimensions."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path

from equisection.errors import EquisectionError
from equisection.keys.written_number import LARGEST, is_of_sensible_size, number_in

#: What a beam may be like, and the example it starts from.
EXAMPLES = {
    "tracker": "tracker_over_tilt.yaml",
    "bridge": "bridge_deck.yaml",
    "wing": "goland_wing.yaml",
    "panel": "photovoltaic_panel.yaml",
    "plate": "plate_over_incidence.yaml",
}
#: What is asked of a beam: the section of the key, the key, its words and its unit.
QUESTIONS = (
    ("beam", "chord", "chord", "m"),
    ("beam", "length", "length along the span", "m"),
    ("flow", "design_speed", "design wind speed, which it has to stand", "m/s"),
)
#: What is said of an answer that is no dimension.
DIMENSION = f"allowed is a plain decimal number above 0, such as 12.5, up to {LARGEST:g}"


class StarterError(EquisectionError):
    """A configuration cannot be started as asked."""


def examples_folder(project: Path | None) -> Path:
    """Return the folder of the examples.

    Raises
    ------
    StarterError
        The package is installed without a clone of the project, which has them.
    """
    if project is None:
        raise StarterError(
            "the examples are in a clone of the project, and this package is in none; install it "
            "from a clone ('pip install -c envs/constraints.txt -e .')"
        )
    return project / "config" / "examples"


def asked(known: Mapping[str, float]) -> tuple[str, dict[str, float]]:
    """Ask at the terminal what the beam is like, and for the dimensions that are not known.

    Raises
    ------
    StarterError
        The answers end before the questions.
    """
    try:
        return _answers(known)
    except EOFError:
        raise StarterError("no answer; nothing is written (--like asks for nothing)") from None


def dimension(text: str) -> float:
    """Return a dimension as a person writes it.

    Raises
    ------
    ValueError
        It is no plain decimal number above 0 of a size that a dimension has.
    """
    number = number_in(text)
    if not (math.isfinite(number) and number > 0.0 and is_of_sensible_size(number)):
        raise ValueError("no dimension")
    return number


def _answers(known: Mapping[str, float]) -> tuple[str, dict[str, float]]:
    # Imported here, for only a terminal needs it.
    from rich.prompt import InvalidResponse, Prompt, PromptBase  # noqa: PLC0415

    class _Dimension(PromptBase[float]):
        """Question for a dimension; no answer is 0."""

        def process_response(self, value: str) -> float:
            try:
                return dimension(value)
            except ValueError:
                raise InvalidResponse(f"[red]{DIMENSION}") from None

    like = Prompt.ask("What is the beam like?", choices=list(EXAMPLES), default="tracker")
    values = dict(known)
    for _, key, words, unit in QUESTIONS:
        if key not in values:
            answer = _Dimension.ask(
                f"{words.capitalize()} ({unit}; Enter: as the example has it)",
                default=0.0,
                show_default=False,
            )
            if answer:
                values[key] = answer
    return like, values


def starter(like: str, name: str, file: Path, examples: Path, values: Mapping[str, float]) -> str:
    """Return the text of a configuration, with the comments of the example that it is like.

    Parameters
    ----------
    like
        One of :data:`EXAMPLES`.
    name
        Name of the run, which its folder of results has.
    file
        Where it will be written; the commands in its comments name it.
    examples
        Folder of the examples.
    values
        Values of keys of :data:`QUESTIONS`; what is left out stays as the example has it.

    Raises
    ------
    StarterError
        The name is no name of a folder.
    """
    _require_name(name)
    text = (examples / EXAMPLES[like]).read_text(encoding="utf-8")
    old = re.search(r"^run: *([^ #\n]+)", text, flags=re.MULTILINE)
    assert old is not None, "an example names its run"
    text = text.replace(f"config/examples/{EXAMPLES[like]}", str(file))
    head = f"# Begun from the example {EXAMPLES[like]}: what comments say of numbers is of that."
    text = f"{head}\n{text}"
    text = text.replace(f"results/{old.group(1)}/", f"results/{name}/")
    text = re.sub(r"^run: *[^ #\n]+", f"run: {_as_yaml(name)}", text, count=1, flags=re.MULTILINE)
    for section, key, _, unit in QUESTIONS:
        if key in values:
            text = _with_value(text, section, key, f"{values[key]:.12g} # {unit}")
    return text


def _require_name(name: str) -> None:
    """Refuse a name that a configuration refuses."""
    # Imported here, so that the command's --help comes at once.
    from pydantic import TypeAdapter, ValidationError  # noqa: PLC0415

    from equisection.config.words import allowed  # noqa: PLC0415
    from equisection.keys.values import Name  # noqa: PLC0415

    names: TypeAdapter[str] = TypeAdapter(Name)
    try:
        names.validate_python(name)
    except ValidationError:
        raise StarterError(f"name {name!r}: allowed is {allowed(names.json_schema())}") from None


def _as_yaml(name: str) -> str:
    """Return a name as YAML has it, in quotes where it would be a number, a date or a truth."""
    # Imported here, so that the command's --help comes at once.
    import yaml  # noqa: PLC0415

    return str(yaml.safe_dump(name)).splitlines()[0]


def _with_value(text: str, section: str, key: str, value: str) -> str:
    """Put a value in the place of a key's, or at the head of its section."""
    head = re.search(rf"^{section}:[^\n]*\n", text, flags=re.MULTILINE)
    if head is None:
        return f"{text.rstrip()}\n\n{section}:\n  {key}: {value}\n"
    end = re.compile(r"^\S", flags=re.MULTILINE).search(text, head.end())
    stop = end.start() if end else len(text)
    body, found = re.subn(
        rf"^  {key}: .*$", f"  {key}: {value}", text[head.end() : stop], flags=re.MULTILINE
    )
    if not found:
        body = f"  {key}: {value}\n{body}"
    return text[: head.end()] + body + text[stop:]
