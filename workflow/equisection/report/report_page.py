"""The report as one page: no file next to it, nothing from a network, whatever a run holds escaped.

The answer comes first, then cases that have none, the map of stability where the run has one, and
figures and tables in reading order. A browser runs the scripts of the page alone, by their hashes.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import pandas as pd
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from equisection.errors import EquisectionError
from equisection.figures.models import LOOKS
from equisection.files import write_text
from equisection.provenance import made_by_this
from equisection.report.csv_tables import table_shown
from equisection.report.embedded_files import picture
from equisection.results.netcdf import read_dataset
from equisection.run.answer import AnswerError, answer_of
from equisection.run.status import RunStatus, State, run_status
from equisection.run.status_words import state_of

_FOLDER = Path(__file__).parent
_TEMPLATE, _SCRIPT = _FOLDER / "report_page.html.jinja", _FOLDER / "report_page.js"
#: Figures that come right after the answer, by their names in the catalogue.
_FIRST = ("critical-speed", "response")
#: Tables that are open from the start, by their names; the others unfold.
_OPEN = ("critical_speed", "onset")
#: Verdicts that decide nothing.
_UNTOLD = ("failed", "undecided")


class ReportError(EquisectionError):
    """A report cannot be written."""


@dataclass(frozen=True)
class Shown:
    """A figure or table of the report.

    Attributes
    ----------
    path
        Its file: a PNG picture, or a CSV table.
    name
        Its name in the catalogue, or that of its file.
    number
        Number by which it is known elsewhere; empty for none.
    shows
        Its contents in a few words.
    caption
        Its caption as HTML.
    """

    path: Path
    name: str
    number: str
    shows: str
    caption: Markup


@dataclass(frozen=True)
class MapFiles:
    """Map of stability of a run: its data set, its table, and the design speed (m/s) to mark."""

    stability_map: Path
    stability: Path
    design_speed: float | None


def write_report(
    path: Path,
    run: Path,
    *,
    figures: Sequence[Shown],
    tables: Sequence[Shown],
    map_files: MapFiles | None,
    config_text: str,
) -> list[str]:
    """Write the report of a run.

    Parameters
    ----------
    path
        The page.
    run
        Folder of the run, which has the answer and its cases.
    figures, tables
        What is shown. Numbered ones are put in the order of their numbers, before the others.
    map_files
        Map of stability; None for a run without one.
    config_text
        The resolved configuration.

    Returns
    -------
    list of str
        What the page lacks, in words.

    Raises
    ------
    EquisectionError
        A figure or table cannot be read, or the page cannot be written.
    """
    drawn, lacks = (None, []) if map_files is None else _map(map_files)
    status = run_status(run)
    untold = _untold(status)
    parts, model = _answer(run)
    script = _SCRIPT.read_text(encoding="utf-8")
    scripts = [] if drawn is None else [_one_line_ends(_plotly()), _one_line_ends(script)]
    pictures = [(one, picture(one.path)) for one in sorted(figures, key=_place)]
    drawn_ones = [(one, image) for one, image in pictures if not image.empty]
    first = [pair for name in _FIRST for pair in drawn_ones if pair[0].name == name]
    further = [pair for pair in drawn_ones if pair not in first]
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    text = environment.from_string(_TEMPLATE.read_text(encoding="utf-8")).render(
        run=run.resolve().name,
        parts=parts,
        model=model,
        cases=len(status.entries),
        untold=untold,
        untold_cases=sum(len(names) for _, names, _, _ in untold),
        map=Markup(_as_script(drawn)) if drawn else None,  # noqa: S704, without < and &
        learnt=drawn is not None and drawn["is_learnt"],
        lacks=lacks,
        first=first,
        figures=further,
        empty=[(one, image.empty) for one, image in pictures if image.empty],
        tables=[
            (one, table_shown(one.path), one.name in _OPEN) for one in sorted(tables, key=_place)
        ],
        title=_title,
        config=config_text,
        made_by=made_by_this(),
        now=datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z"),
        scripts=[Markup(one) for one in scripts],  # noqa: S704, the project's, and plotly's own
        hashes=[_hash(one) for one in scripts],
    )
    try:
        write_text(path, text)
    except OSError as error:
        raise ReportError(f"{path}: the report cannot be written there ({error})") from None
    return lacks


def _answer(run: Path) -> tuple[list[tuple[str, str]], str]:
    """Return the answer by its parts with the model that answers, or why there is none."""
    try:
        answer = answer_of(run)
    except AnswerError as error:
        return [("critical speed", f"no answer: {error}")], ""
    speed, *others = answer.parts()
    model = str(answer.chosen["model"])
    label = f" ({LOOKS[model].label})" if model in LOOKS else ""
    return [speed, ("model", f"{model}{label}"), *others], model


def _untold(status: RunStatus) -> list[tuple[str, list[str], str, str]]:
    """Return model, cases, state and reason of cases that failed, are undecided or have no result.

    Cases of a model that have one state for one reason come together.
    """
    alike: dict[tuple[str, str, str], list[str]] = {}
    for one in status.entries:
        if one.state != State.DONE or one.regime in _UNTOLD:
            alike.setdefault((one.model, state_of(one), one.text), []).append(one.case)
    return [(model, cases, state, reason) for (model, state, reason), cases in alike.items()]


def _place(one: Shown) -> tuple[int, int]:
    """Return what puts figures and tables in reading order: numbered ones by their numbers."""
    if one.name in _OPEN:
        return 0, _OPEN.index(one.name)
    return (1, int(one.number)) if one.number else (2, 0)


def _title(one: Shown, kind: str) -> str:
    """Return the heading of a figure or table."""
    words = one.shows[:1].upper() + one.shows[1:]
    return f"{kind} {one.number}: {words}" if one.number else words


def _map(files: MapFiles) -> tuple[dict[str, Any] | None, list[str]]:
    """Return the map to point at, or why the page has none."""
    try:
        # Loaded here, for a run without a map needs no plotly, and plotly may be missing.
        from equisection.report.interactive_map import interactive_map  # noqa: PLC0415
    except ModuleNotFoundError as error:
        if error.name != "plotly":
            raise
        return None, [
            "the map of stability is a picture alone, since the package plotly is not there: "
            "pip install -c envs/constraints.txt -e '.[report]', and make the report again"
        ]
    table = _stability(files.stability)
    return interactive_map(read_dataset(files.stability_map), table, files.design_speed), []


def _stability(path: Path) -> pd.DataFrame:
    """Return the table of a map of stability."""
    kinds = {"model": str, "incidence_deg": float, "speed_from": float, "speed_to": float}
    try:
        return pd.read_csv(path).astype(kinds)
    except (OSError, ValueError, KeyError) as error:
        raise ReportError(f"{path}: no table of a map ({error}); delete it and run again") from None


def _plotly() -> str:
    """Return plotly.js, which comes with the package plotly."""
    from plotly.offline import get_plotlyjs  # noqa: PLC0415, as above

    return str(get_plotlyjs())


def _one_line_ends(script: str) -> str:
    """Return a script with the ends of lines that a browser hashes."""
    return script.replace("\r\n", "\n").replace("\r", "\n")


def _hash(script: str) -> str:
    """Return the hash by which a page's policy names a script (CSP Level 3)."""
    digest = hashlib.sha256(script.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"


def _as_script(value: Mapping[str, Any]) -> str:
    """Return JSON that a page can hold in a script element, which ends at no other place."""
    text = json.dumps(value, separators=(",", ":"))
    return text.replace("&", r"\u0026").replace("<", r"\u003c").replace(">", r"\u003e")
