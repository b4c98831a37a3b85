"""Work behind a result of OpenFOAM, from its case and its attributes."""

from __future__ import annotations

import re
from typing import Any

from equisection.config.groups.openfoam_keys import MORPH
from equisection.solvers.openfoam.adapter import Adapter
from equisection.solvers.openfoam.job_work import OUTLINE, OVERSET, cells_of, iterations_of
from equisection.solvers.work import Work

#: The words by which a steady result says how it was obtained.
_STEADY = re.compile(r"steady, (\d+) iterations")
#: The shortest free run (c/V) whose time is that of its steps.
SHORTEST = 20.0


def work_done(case: dict[str, Any], attributes: dict[str, Any]) -> Work | None:
    """Return the work behind a result; None where that is not known well enough.

    It is unknown for another version of the adapter, whose iterations may differ; for a mean, which
    does not say its iterations; and for a beam around its outline, which does not say its cells.
    The steady flow that a free case starts from took time too and is not counted: a few hundred
    iterations against thousands of steps, but too many against
    those of a run below :data:`SHORTEST`.

    Parameters
    ----------
    case
        The case, as the result holds it.
    attributes
        Attributes of the result.
    """
    if case["solver"]["version"] != Adapter.version:
        return None
    settings = case["solver"]["settings"]
    is_outline = "mesher" in settings
    if is_outline and case["dimension"] == "3d":
        return None
    times = OUTLINE if is_outline else 1.0
    cells = cells_of(settings["mesh"], case["dimension"])
    if case["kind"] == "steady":
        found = _STEADY.match(str(attributes.get("method", "")))
        return Work(cells, iterations=times * int(found[1])) if found else None
    if float(attributes["end_time"]) < SHORTEST:
        return None
    steps = float(attributes["end_time"]) / case["time_step"]
    if case["dimension"] == "2d" and settings.get("mesh_motion", MORPH) != MORPH:
        steps *= OVERSET
    return Work(cells, steps=times * steps * iterations_of(settings["outer_correctors"]))
