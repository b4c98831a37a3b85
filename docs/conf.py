"""Documentation site: the project's own Markdown pages, as they stand in the repository.

make docs      # writes site/; needs no network
"""

import sys
from pathlib import Path

import equisection

sys.path.insert(0, str(Path(__file__).parent))

project = "equisection"
author = "the equisection authors"
release = equisection.__version__
extensions = ["myst_parser", "mathml"]
highlight_language = "text"
html_math_renderer = "mathml"
myst_fence_as_directive = ["math"]
root_doc = "docs/index"
source_suffix = {".md": "markdown"}
include_patterns = [
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "config/README.md",
    "docs/*.md",
    "results/reference/README.md",
]
myst_heading_anchors = 4
nitpicky = True
html_static_path = ["_static"]
html_theme = "furo"
html_title = f"equisection {release}"
html_show_copyright = False
