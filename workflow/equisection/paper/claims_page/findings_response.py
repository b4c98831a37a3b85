"""Findings on the paper's claims on the response over k*, its onset and its cost."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from equisection.paper.claims_page.evidence import Evidence
from equisection.paper.claims_page.findings import (
    ClaimVerdict,
    Finding,
    graded,
    open_finding,
    percent,
    resolution_of,
)
from equisection.paper.claims_page.kept_runs import base_of, cost_ladder
from equisection.paper.printed_values import PUBLISHED
from equisection.results.unsteady_result import STABLE

_SECTION, _CORRECTED, _BEAM = "2d", "2d-corrected", "3d"
#: Twist amplitude (deg) up to which a run has means that are compared, growing or not.
_SMALL = 3.0
#: k* from which on a stiffness counts as high.
_HIGH = 10.0
_BOTH_REDUCTIONS = (
    "coupled runs of the plate, and of the paper's section on its cells "
    "(`config/paper/reductions.yaml`)"
)
_PLATE_RUNS = "coupled runs of the plate (`config/openfoam3d.yaml`)"
#: k* of the onset, and cells times steps of the plate over those of the section, in the paper.
_PAPER_ONSET, _PAPER_COST = (
    next(entry.value for entry in PUBLISHED if entry.quantity == name)
    for name in ("k* of the onset", "cost of 3D over 2D, per time simulated")
)


def first_modes(evidence: Evidence) -> Finding:
    """Judge the dominance of the first modes."""
    names = {kind: f"first {kind} mode over the others" for kind in ("bending", "torsion")}
    ratios = {kind: evidence.number(name) for kind, name in names.items()}
    notes = evidence.paper.set_index("quantity")["note"]
    if not all(map(math.isfinite, ratios.values())):
        return open_finding(_PLATE_RUNS)
    least = min(ratios.values())
    words = "; ".join(
        f"{kind}: {ratio:.3g} times the next ({notes[names[kind]]})"
        for kind, ratio in ratios.items()
    )
    return Finding(
        ClaimVerdict.AGREES
        if least >= 100
        else ClaimVerdict.PARTLY
        if least >= 10
        else ClaimVerdict.DIFFERS,
        words,
        resolution_of(evidence.summary, _BEAM),
        "The share of the second mode is set by the shape of the load along the span and the ratio "
        "of the natural frequencies; a uniform load already gives what the note says.",
    )


def mean_twist_uncorrected(evidence: Evidence) -> Finding:
    """Judge the mean twist of the paper's section against the plate's."""
    return _means(evidence, _SECTION, ("mean_twist_deg",))


def means_corrected(evidence: Evidence) -> Finding:
    """Judge both means of the paper's corrected section against the plate's."""
    return _means(evidence, _CORRECTED, ("mean_twist_deg", "mean_deflection_chords"))


def mean_bending_uncorrected(evidence: Evidence) -> Finding:
    """Judge whether the paper's section bends more than the plate."""
    model, column = f"{_SECTION}-paper", "mean_deflection_chords"
    pairs = _pairs(evidence.reductions, model, column)
    if pairs.empty:
        return open_finding(_BOTH_REDUCTIONS)
    return Finding(
        ClaimVerdict.AGREES if (pairs["here"] > pairs["beam"]).all() else ClaimVerdict.DIFFERS,
        _deviations(pairs, column),
        resolution_of(evidence.reductions, model, _BEAM),
        _by_the_other_reduction(evidence, _SECTION, (column,)),
    )


def _means(evidence: Evidence, model: str, columns: tuple[str, ...]) -> Finding:
    name = f"{model}-paper"
    parts, differences = [], []
    for column in columns:
        pairs = _pairs(evidence.reductions, name, column)
        if not pairs.empty:
            differences += list(pairs["here"] / pairs["beam"] - 1.0)
            parts.append(_deviations(pairs, column))
    if not parts:
        return open_finding(_BOTH_REDUCTIONS)
    return Finding(
        graded(differences, 0.1, 0.25),
        "; ".join(parts),
        resolution_of(evidence.reductions, name, _BEAM),
        _by_the_other_reduction(evidence, model, columns),
    )


def _by_the_other_reduction(evidence: Evidence, model: str, columns: tuple[str, ...]) -> str:
    """Say the same of the consistent reduction, which is not what the claim speaks of."""
    found = [
        _deviations(pairs, column)
        for column in columns
        if not (pairs := _pairs(evidence.reductions, f"{model}-consistent", column)).empty
    ]
    words = f"With the consistent reduction {'; '.join(found)}. " if found else ""
    return (
        f"{words}Section and plate have the same cells in the plane ([reductions](reductions.md))."
    )


def _pairs(runs: pd.DataFrame, model: str, column: str) -> pd.DataFrame:
    """Return k* and a mean of a model and of the beam where the motion of both is small."""
    small = runs[(runs["twist_amplitude_deg"] < _SMALL) & (runs["regime"] != "failed")]
    return _beside(small, model, column)


def _beside(runs: pd.DataFrame, model: str, column: str) -> pd.DataFrame:
    """Return k* and a column of a model and of the beam at the k* that both have."""
    section, beam = (runs[runs["model"] == name] for name in (model, _BEAM))
    joined = section.merge(beam, on="k_star", suffixes=("", "_beam")).sort_values("k_star")
    return pd.DataFrame(
        {"k_star": joined["k_star"], "here": joined[column], "beam": joined[f"{column}_beam"]}
    ).dropna()


def _deviations(pairs: pd.DataFrame, column: str) -> str:
    relative = pairs["here"] / pairs["beam"] - 1.0
    words = ", ".join(
        f"{percent(value)} at {k_star:g}"
        for k_star, value in zip(pairs["k_star"], relative, strict=True)
    )
    return f"{_name(column)}: {words} (k*)"


def _name(column: str) -> str:
    return column.removesuffix("_deg").removesuffix("_chords").replace("_", " ")


def _by_k_star(k_star: pd.Series, values: pd.Series) -> str:
    return ", ".join(f"{v:.2f} at k* = {k:g}" for k, v in zip(k_star, values, strict=True))


def onset(evidence: Evidence) -> Finding:
    """Judge the k* of the onset."""
    parts, found = [], []
    for model in (_CORRECTED, _BEAM, _SECTION):
        unstable, stable = evidence.bracket(model)
        if math.isfinite(unstable) and not math.isfinite(stable):
            parts.append(f"{model}: unstable up to {unstable:g}, the highest that was run")
        if math.isfinite(unstable) and math.isfinite(stable):
            crossing = _crossing(evidence.runs(model))
            zero = f", growth through zero at {crossing:.2g}" if math.isfinite(crossing) else ""
            parts.append(f"{model}: unstable at {unstable:g}, stable at {stable:g}{zero}")
            if model != _SECTION:
                found.append((unstable, stable))
    if not found:
        return open_finding(
            "runs on both sides of the onset", "; ".join(parts) + _mesh_shift(evidence.kept) + "."
        )
    holds = [0.9 * low <= _PAPER_ONSET <= 1.1 * high for low, high in found]
    verdict = ClaimVerdict.PARTLY if any(holds) else ClaimVerdict.DIFFERS
    if all(holds) and len(found) > 1:
        verdict = ClaimVerdict.AGREES
    if not evidence.runs(_BEAM).size:
        parts.append(f"{_BEAM}: not run yet")
    return Finding(
        verdict,
        "; ".join(parts) + _mesh_shift(evidence.kept),
        resolution_of(evidence.summary, _SECTION, _CORRECTED, _BEAM),
        "Near the onset the growth is slow, so that its k* hangs on the mesh, on the correction "
        "and on what counts as stable: a limit cycle below 0.5 deg does here "
        "([files.md](files.md)). The paper reads it off the slope of the means.",
    )


def _crossing(runs: pd.DataFrame) -> float:
    """Return the highest k* at which the growth rate passes through zero, by interpolation."""
    known = runs.dropna(subset=["growth_rate"]).sort_values("k_star", ascending=False)
    k_star, growth = known["k_star"].to_numpy(), known["growth_rate"].to_numpy()
    for place in range(len(growth) - 1):
        high, low = growth[place], growth[place + 1]
        if high < 0.0 <= low:
            return float(np.interp(0.0, [high, low], [k_star[place], k_star[place + 1]]))
    return math.nan


def _mesh_shift(kept: pd.DataFrame) -> str:
    """Say by how much a finer mesh changes the growth rate of the section at the same k*."""
    section = kept[kept["model"] == _SECTION]
    parts = []
    for k_star, runs in section.groupby("k_star"):
        but_for_mesh = runs["settings"].str.replace(r'"mesh": "\w+"', "", regex=True)
        for _, alike in runs.groupby([but_for_mesh, "time_step"]):
            by_mesh = alike.drop_duplicates("cells").sort_values("cells")
            if len(by_mesh) > 1:
                words = ", ".join(
                    f"{row.growth_by_100:+.4f} ({row.resolution})" for row in by_mesh.itertuples()
                )
                parts.append(f"k* = {k_star:g}: {words}")
    of = "Growth (V/c) of the section over the last periods of the first 100 c/V, by mesh"
    return f". {of}: {'; '.join(parts)}" if parts else ""


def limit_cycle(evidence: Evidence) -> Finding:
    """Judge the runs on both sides of the corrected section's onset."""
    runs = [evidence.at(_CORRECTED, k_star) for k_star in evidence.bracket(_CORRECTED)]
    if runs[-1] is None:
        return open_finding("a stable run above the onset of the corrected section")
    known = [run for run in runs if run is not None]
    is_cycle = any(run["regime"] == "limit-cycle" for run in known)
    return Finding(
        ClaimVerdict.AGREES if is_cycle else ClaimVerdict.DIFFERS,
        "; ".join(f"at k* = {run['k_star']:g}: {_in_words(run)}" for run in known),
        resolution_of(evidence.summary, _CORRECTED),
        "A motion whose growth is within a few 1e-4 V/c of zero keeps its amplitude over the "
        "length of a run; whether it is a cycle for good cannot be told from that."
        if is_cycle
        else "",
    )


def growing_inside(evidence: Evidence) -> Finding:
    """Judge whether the paper's corrected section grows faster than the plate, k* by k*."""
    model = f"{_CORRECTED}-paper"
    both = _growing(evidence.reductions, model)
    if both.empty:
        return open_finding(_BOTH_REDUCTIONS)
    faster = both["here"] > both["beam"]
    finer = _growing(_first_60(evidence.summary, evidence.kept), _CORRECTED)
    return Finding(
        ClaimVerdict.AGREES
        if faster.all()
        else ClaimVerdict.PARTLY
        if faster.any()
        else ClaimVerdict.DIFFERS,
        _growth_in_words(both),
        resolution_of(evidence.reductions, model, _BEAM),
        "Section and plate have the same cells in the plane ([reductions](reductions.md))."
        + (
            f" The section on the sweep's mesh, over the plate's 60 c/V: {_growth_in_words(finer)}."
            if len(finer)
            else ""
        ),
    )


def _first_60(summary: pd.DataFrame, kept: pd.DataFrame) -> pd.DataFrame:
    """Return runs with the growth rate that each shows in its first 60 c/V, if it is kept."""
    keys = ["model", "k_star", "end_time"]
    known = kept[[*keys, "growth_by_60"]].drop_duplicates(keys)
    first = summary.merge(known, on=keys, how="inner")
    return first.assign(growth_rate=first["growth_by_60"])


def _growing(runs: pd.DataFrame, model: str) -> pd.DataFrame:
    """Return k* and growth rate (V/c) of a model and of the beam where both grow."""
    return _beside(runs[runs["regime"] == "growing"], model, "growth_rate")


def _growth_in_words(both: pd.DataFrame) -> str:
    words = ", ".join(
        f"{row.here:+.4f} and {row.beam:+.4f} at {row.k_star:g}" for row in both.itertuples()
    )
    return f"growth of section and plate (V/c): {words} (k*)"


def decay_at_high_stiffness(evidence: Evidence) -> Finding:
    """Judge the stiffest runs."""
    parts, settled = [], []
    for model in (_SECTION, _CORRECTED, _BEAM):
        runs = evidence.runs(model)
        stiff = runs[runs["k_star"] >= _HIGH]
        if len(stiff):
            run = stiff.iloc[-1]
            settled.append(run["regime"] in STABLE)
            parts.append(f"{model} at k* = {run['k_star']:g}: {_in_words(run)}")
        else:
            parts.append(f"{model}: not run from k* = {_HIGH:g} on")
    if not settled:
        return open_finding("runs at high k*")
    verdict = ClaimVerdict.AGREES if len(settled) == len(parts) else ClaimVerdict.PARTLY
    return Finding(
        verdict if all(settled) else ClaimVerdict.DIFFERS,
        "; ".join(parts),
        resolution_of(evidence.summary, _SECTION, _CORRECTED, _BEAM),
    )


def _in_words(run: pd.Series) -> str:
    return (
        f"{str(run['regime']).replace('-', ' ')}, amplitude {run['twist_amplitude_deg']:.3g} deg, "
        f"growth {run['growth_rate']:+.4f} V/c"
    )


def not_classical_flutter(evidence: Evidence) -> Finding:
    """Judge the motions by linear theory at the k* of the instability."""
    row = evidence.onset[evidence.onset["model"] == _SECTION]
    unstable, _ = evidence.bracket(_SECTION)
    if row.empty or not math.isfinite(unstable):
        return open_finding("an unstable run of the section as it is")
    at = evidence.linear[np.isclose(evidence.linear["k_star"], unstable)]
    fastest = at.loc[at["growth_rate"].idxmax()]
    flutter, divergence, by_polar = (
        float(row[name].iloc[0])
        for name in ("linear_flutter", "linear_divergence", "divergence_by_polar")
    )
    own = (
        f"Its own flutter is at k* = {flutter:.2f}, " if math.isfinite(flutter) else "It has none; "
    )
    return Finding(
        ClaimVerdict.AGREES if fastest["growth_rate"] < 0.0 else ClaimVerdict.DIFFERS,
        f"at k* = {unstable:g}, where the uncorrected section is still unstable, the least damped "
        f"motion of linear theory ({fastest['motion']}) decays by "
        f"{fastest['growth_rate']:+.4f} V/c. {own}divergence at {divergence:.2f} "
        f"({by_polar:.2f} with the slope of the section's own c_m)",
        "Theodorsen's loads, k and p-k methods; fractions of a second",
        "The instability is none of attached, linear flow. With centre of mass and pitch axis in "
        "one there is still a linear flutter, next to divergence and far below the k* at which the "
        "section stalls ([linear.md](linear.md)).",
    )


def cost(evidence: Evidence) -> Finding:
    """Judge the cost of the plate over the section's."""
    ladder = cost_ladder(evidence.kept, evidence.embedded)
    plate = ladder[ladder["what"].str.startswith("3D OpenFOAM")]
    section = base_of(ladder)
    if section is None or plate.empty:
        return open_finding(_PLATE_RUNS, f"The paper's cells and steps make it {_PAPER_COST:.0f}.")
    dearest = plate.iloc[0]
    ratio = float(dearest["seconds"] / section["seconds"])
    steps = float(dearest["cell_steps"] / section["cell_steps"])
    return Finding(
        ClaimVerdict.AGREES
        if ratio >= 100
        else ClaimVerdict.PARTLY
        if ratio >= 5
        else ClaimVerdict.DIFFERS,
        f"{ratio:.3g} times the processor time for the same time simulated, with {steps:.3g} times "
        f"the cells and steps (in the paper {_PAPER_COST:.0f})",
        f"{dearest['what']} over {section['what']}; the table below",
        "The meshes here are nearer to each other in size than the paper's.",
    )
