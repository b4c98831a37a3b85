"""Figures of the paper: the number and name that each has here, and its caption.

Figs. 2 and 4 are sketches of the geometry, and Fig. 1 is the workflow.
"""

from __future__ import annotations

from equisection.figures.catalogue import FurtherName

#: Number and name of the paper's figures, by the names in the catalogue.
NUMBERED = {
    "mode-shapes": (3, "modes"),
    "mesh-of-section": (5, "section-mesh"),
    "section-polar": (6, "section-polar"),
    "surface-loads": (7, "surface"),
    "courant-number": (8, "courant-number"),
    "mesh-of-beam": (9, "plate-mesh"),
    "spanwise-loads": (10, "spanwise-loads"),
    "surface-of-beam": (11, "plate-surface"),
    "flow-at-tip": (12, "tip-flow"),
    "lift-correction": (13, "lift-correction"),
    "moment-correction": (14, "moment-correction"),
    "modal-contributions": (15, "modal-contributions"),
    "response": (16, "response"),
    "hysteresis": (17, "hysteresis"),
}
#: Fig. 1, a drawing that is kept.
WORKFLOW = "fig01-workflow"


def caption(number: int) -> str:
    """Return the path of a figure's caption, as a rule sees it."""
    return f"../equisection/paper/captions/fig{number:02}.rst"


def further_names() -> dict[str, FurtherName]:
    """Return the paper's names of figures, by those in the catalogue."""
    return {
        name: FurtherName(f"fig{number:02}-{short}", str(number), caption(number))
        for name, (number, short) in NUMBERED.items()
    }
