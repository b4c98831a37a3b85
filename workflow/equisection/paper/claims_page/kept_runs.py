"""Unsteady runs that are kept, whatever configuration made them, and their cost."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pandas as pd

from equisection.cases import FREE, UnsteadyCase
from equisection.errors import ResultFileError
from equisection.paper.mesh_convergence.kept_releases import cells_of, growth_behind_release
from equisection.results.loads_zigzag import loads_zigzag
from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import judge
from equisection.store.judged_again import tip_motion
from equisection.store.kept import Kept, kept_results
from equisection.study.plan import model

#: Columns of :func:`kept_runs`, in order.
COLUMNS = (
    "folder",
    "model",
    "k_star",
    "solver",
    "resolution",
    "cells",
    "time_step",
    "settings",
    "regime",
    "growth_rate",
    "growth_behind",
    "growth_behind_low",
    "growth_behind_high",
    "twist_amplitude_deg",
    "loads_zigzag",
    "end_time",
    "cpu_seconds",
)


def kept_runs(folder: Path) -> pd.DataFrame:
    """Return a line for each release of the paper's plate below a folder that has not failed.

    Releases of other beams, which are kept too, are those with an outline of their own.
    ``model`` is the name of the folder that a result is in, ``folder`` that of its run, and
    ``settings`` the words of the solver's settings. ``regime`` and the numbers with it are judged
    by the present rules, whatever those were that a run ended by. ``growth_behind`` is the growth
    rate (V/c) over the last periods of the first 100 c/V, but from 20 c/V after the release on,
    with the ends of its interval: growth changes with time, so runs of different length are
    compared by it. NaN of a run that is too short. ``loads_zigzag`` is the zigzag of the loads (-).
    """
    rows = []
    for kept in kept_results(folder):
        if kept.case.get("kind") == FREE.folder and "outline" not in kept.case["geometry"]:
            solver = kept.case["solver"]
            row: dict[str, Any] = {name: kept.attributes.get(name) for name in COLUMNS}
            row |= {
                "folder": str(kept.path.parents[2].relative_to(folder)),
                "model": kept.path.parent.name,
                "cells": cells_of(str(kept.attributes["solver_description"])),
                "time_step": kept.case["time_step"],
                "settings": json.dumps(solver["settings"], sort_keys=True),
                **_verdict(kept),
                **loads_zigzag(kept.path, kept.attributes),
            }
            rows.append(row)
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    return table.sort_values(["model", "k_star", "cells", "folder"], ignore_index=True)


def _verdict(kept: Kept) -> dict[str, Any]:
    """Return the verdict on a run, and its growth (V/c) behind the release."""
    case, whole = UnsteadyCase.model_validate(kept.case), tip_motion(read_dataset(kept.path))
    verdict = judge(case, whole)
    growth = growth_behind_release(case, whole)
    low, high = growth.interval
    return {
        **{name: verdict[name] for name in ("regime", "growth_rate", "twist_amplitude_deg")},
        "growth_behind": growth.rate,
        "growth_behind_low": low,
        "growth_behind_high": high,
    }


def base_of(ladder: pd.DataFrame) -> pd.Series | None:
    """Return the line of a cost ladder that the others are compared with.

    It is that of the resolved section with the most k*, and of these that on the fewest cells.
    """
    section = ladder[ladder["what"].str.startswith("2D OpenFOAM")]
    if section.empty:
        return None
    return section.sort_values(["k_star", "cells"], ascending=[False, True]).iloc[0]


def cost_ladder(runs: pd.DataFrame, embedded: pd.DataFrame) -> pd.DataFrame:
    """Return the processor time of a time simulated, from the plate down to the embedded solver.

    Parameters
    ----------
    runs
        :func:`kept_runs`.
    embedded
        ``comparison/summary.csv`` of the embedded solver.

    Returns
    -------
    DataFrame
        A line for each solver, dimension and mesh, the dearest first: ``what``, ``cells``,
        ``time_step`` (c/V), ``k_star`` (how many), ``seconds`` (of the processor for each c/V, over
        the k* that the embedded solver has too), ``cell_steps`` (cells times steps for each c/V).

    Raises
    ------
    ResultFileError
        The embedded solver has no run.
    """
    if embedded.empty:
        raise ResultFileError("no run of the embedded solver to compare the cost with")
    rows = []
    known = runs.assign(dimension=[model(name, "consistent").dimension for name in runs["model"]])
    groups = ["dimension", "resolution", "cells", "time_step", "settings"]
    for (dimension, resolution, cells, step, settings), group in known.groupby(groups):
        shared = group[group["k_star"].isin(embedded["k_star"])]
        if shared.empty:
            continue
        chosen = json.loads(str(settings))
        motion = ", overset" if chosen.get("mesh_motion") == "overset" else ""
        motion += ", mesh of outlines" if chosen.get("mesher") else ""
        rows.append(
            {
                "what": f"{str(dimension).upper()} OpenFOAM, {resolution}, "
                f"{chosen.get('outer_correctors')} outer correctors{motion}",
                "cells": cells,
                "time_step": step,
                "k_star": shared["k_star"].nunique(),
                "seconds": shared["cpu_seconds"].sum() / shared["end_time"].sum(),
                "cell_steps": float(cells) / float(step),
            }
        )
    for dimension, names in (("3D", ("3d",)), ("2D", ("2d", "2d-corrected"))):
        group = embedded[embedded["model"].isin(names)]
        if len(group):
            rows.append(
                {
                    "what": f"{dimension} embedded",
                    "cells": math.nan,
                    "time_step": math.nan,
                    "k_star": group["k_star"].nunique(),
                    "seconds": group["cpu_seconds"].sum() / group["end_time"].sum(),
                    "cell_steps": math.nan,
                }
            )
    return pd.DataFrame(rows).sort_values("seconds", ascending=False, ignore_index=True)
