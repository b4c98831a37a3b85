"""The captions of the report are sound reStructuredText."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest
from docutils.core import publish_string
from jinja2 import Environment, StrictUndefined

WORKFLOW = Path(__file__).parents[2] / "workflow"
CAPTIONS = sorted(
    [*WORKFLOW.glob("report/**/*.rst"), *WORKFLOW.glob("equisection/paper/captions/*.rst")]
)


@pytest.mark.parametrize("path", CAPTIONS, ids=lambda path: path.name)
def test_caption_renders(path):
    snakemake = SimpleNamespace(
        config={"run": "a-run", "solver": "embedded"}, params={"values": {"resolution": "coarse"}}
    )
    template = Environment(undefined=StrictUndefined).from_string(path.read_text("utf-8"))
    publish_string(
        template.render(snakemake=snakemake),
        writer="html",
        settings_overrides={"halt_level": 2, "report_level": 2},
    )
