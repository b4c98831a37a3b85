"""Documentation site: the project's own Markdown pages, as they stand in the repository.

make docs      # writes site/; needs no network
"""

import equisection

project = "equisection"
author = "the equisection authors"
release = equisection.__version__
extensions = ["myst_parser"]
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
html_theme = "furo"
html_title = f"equisection {release}"
html_show_copyright = False
