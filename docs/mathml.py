"""Equations of the site as MathML, which browsers typeset themselves: no script, no network."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util.logging import getLogger


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the renderer `mathml`, for `html_math_renderer`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_display, None))
    app.add_css_file("equations.css")
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(_typeset(node, as_block=False))
    raise nodes.SkipNode


def _display(translator: Any, node: nodes.math_block) -> None:
    equation = _typeset(node, as_block=True)
    translator.body.append(f'<div class="math">{equation}</div>\n')
    raise nodes.SkipNode


def _typeset(node: nodes.math | nodes.math_block, *, as_block: bool) -> str:
    """Return the MathML of an equation, with primes that look like primes."""
    prime = '<mo lspace="0" rspace="0">\N{PRIME}</mo>'
    try:
        equation = str(tex2mathml(node.astext(), as_block=as_block))
    except MathError as error:
        getLogger(__name__).warning("equation cannot be typeset: %s", error, location=node)
        return ""
    return equation.replace("<mo>'</mo>", prime)
