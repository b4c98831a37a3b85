"""The status of runs as one page of HTML: no script, nothing from a network, for small windows too.

Whatever a reason, a log or a name holds is text on it: Jinja, which Snakemake needs, escapes it.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from equisection.files import write_text
from equisection.run.status import RunStatus
from equisection.run.status_words import core_time, remarks_of, simulated_of, state_of, summary

_TEMPLATE = Path(__file__).with_name("status_page.html.jinja")


def write_page(path: Path, runs: Sequence[RunStatus], places: str) -> None:
    """Write the page of some runs, which were looked for in ``places``."""
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    template = environment.from_string(_TEMPLATE.read_text(encoding="utf-8"))
    now = datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z")
    words = (core_time, remarks_of, simulated_of, state_of, summary)
    text = template.render(
        runs=runs, places=places, now=now, **{word.__name__: word for word in words}
    )
    write_text(path, text)
