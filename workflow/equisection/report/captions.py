"""Captions of figures and tables: templates in reStructuredText, those of Snakemake's report."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

from docutils.core import publish_parts
from docutils.utils import SystemMessage
from docutils.writers import html5_polyglot
from jinja2 import Environment, StrictUndefined, TemplateError
from markupsafe import Markup

from equisection.errors import EquisectionError

#: A caption reads no file and writes no HTML of its own; a warning in it is an error.
_SETTINGS = {
    "file_insertion_enabled": False,
    "raw_enabled": False,
    "math_output": "MathML",
    "initial_header_level": 4,
    "halt_level": 2,
    "report_level": 2,
    "warning_stream": False,
}


class CaptionError(EquisectionError):
    """A caption cannot be rendered."""


def caption_html(
    template: str, config: Mapping[str, Any], values: Mapping[str, Any], name: str
) -> Markup:
    """Return a caption as HTML.

    Parameters
    ----------
    template
        The caption, which may name ``snakemake.config`` and ``snakemake.params["values"]``.
    config
        ``run`` and ``solver`` of the run.
    values
        Values of the configuration that the figure is drawn with.
    name
        Name of the figure or table, for messages.

    Raises
    ------
    CaptionError
        The template names what is not there, or is no sound reStructuredText.
    """
    known = SimpleNamespace(config=config, params={"values": values})
    try:
        text = Environment(undefined=StrictUndefined).from_string(template).render(snakemake=known)  # noqa: S701, it is no HTML yet
        parts = publish_parts(text, writer=html5_polyglot.Writer(), settings_overrides=_SETTINGS)
    except (TemplateError, SystemMessage) as error:
        raise CaptionError(
            f"caption of {name}: {error}; it is reStructuredText, with snakemake.config and "
            'snakemake.params["values"] alone'
        ) from None
    return Markup(parts["body"])  # noqa: S704, docutils escapes, and raw HTML is off
