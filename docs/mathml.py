"""Equations of the site as MathML, which browsers typeset themselves: no script, no network."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the renderer `mathml`, for `html_math_renderer`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_display, None))
    app.add_css_file("equations.css")
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(_typeset(node.astext(), as_block=False))
    raise nodes.SkipNode


def _display(translator: Any, node: nodes.math_block) -> None:
    equation = _typeset(node.astext(), as_block=True)
    translator.body.append(f'<div class="math">{equation}</div>\n')
    raise nodes.SkipNode


def _typeset(tex: str, *, as_block: bool) -> str:
    """Return the MathML of an equation, with primes that look like primes."""
    prime = '<mo lspace="0" rspace="0">\N{PRIME}</mo>'
    return str(tex2mathml(tex, as_block=as_block)).replace("<mo>'</mo>", prime)
