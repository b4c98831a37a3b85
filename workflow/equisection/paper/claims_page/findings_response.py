"""Findings on the paper's claims on the response over k*, its onset and its cost."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd

from equisection.paper.claims_page.evidence import Evidence
from equisection.paper.claims_page.findings import (
    ClaimVerdict,
    Finding,
    Known,
    open_finding,
    percent,
    resolution_of,
    together,
)
from equisection.paper.claims_page.kept_runs import base_of, cost_ladder
from equisection.paper.mesh_convergence.kept_releases import OWN_RATIOS
from equisection.paper.mesh_convergence.loads_by_mesh import (
    EQUAL_CELLS,
    FIRST_MODE,
    TWO_OVER_FOUR,
)
from equisection.paper.mesh_convergence.mesh_series import LIMIT
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    DAMPING,
    GROWTH,
    GROWTH_EARLY,
    LEARNT_AT,
    ONSET,
    damped,
)
from equisection.paper.mesh_convergence.onset_targets import best_limit
from equisection.paper.printed_values import ABOUT, PAPER_ONSET, PUBLISHED

_SECTION, _CORRECTED, _BEAM = "2d", "2d-corrected", "3d"
#: Twist amplitude (deg) up to which a run has means that are compared, growing or not.
_SMALL = 3.0
#: k* from which on a stiffness counts as high.
_HIGH = 10.0
_BOTH_REDUCTIONS = (
    "coupled runs of the plate, and of the paper's section on its cells "
    "(`config/paper/reductions.yaml`)"
)
#: Ratio of the first mode to the others that the paper states.
_TWO_ORDERS = 100.0
#: Section over plate that counts as agreement.
_FAIR = Known(1.0, 1.0 - ABOUT, 1.0 + ABOUT)
#: Length (c/V) of a release that has come to its limit cycle.
_TO_THE_CYCLE = 300.0
#: Place of the plate's releases on two meshes.
_LEARNT_AT = f"k* = {LEARNT_AT:g}"
#: Quotient of the rigid loads that each mean goes with.
_LOADS = {"mean_twist_deg": "c_m/C_M", "mean_deflection_chords": "c_l/C_L"}
#: Folder of the kept sections on the plate's cells.
_REDUCTIONS = "paper-reductions"
_TITLES = {_CORRECTED: "2d-corrected, Table 1"}
_PLATE_RUNS = "coupled runs of the plate (`config/openfoam3d.yaml`)"
#: Cells times steps of the plate over those of the section, in the paper.
_PAPER_COST = next(
    entry.value for entry in PUBLISHED if entry.quantity == "cost of 3D over 2D, per time simulated"
)


def first_modes(evidence: Evidence) -> Finding:
    """Judge the dominance of the first modes."""
    parts, verdicts = [], []
    for kind in ("bending", "torsion"):
        rows = evidence.over_meshes(FIRST_MODE.format(kind), _BEAM, _LEARNT_AT)
        here = evidence.limit(FIRST_MODE.format(kind), _BEAM, _LEARNT_AT)
        if rows.empty:
            continue
        by_mesh = ", ".join(
            f"{row.value:.3g} ({row.mesh})" for row in rows[rows["mesh"] != LIMIT].itertuples()
        )
        verdicts.append(here.is_above(_TWO_ORDERS))
        stiff = evidence.number(f"first {kind} mode over the others")
        parts.append(
            f"{kind}: {by_mesh} times the next at {_LEARNT_AT}, limit {here.words()}, and "
            f"{stiff:.3g} at k* = 21 on coarse, paper at least {_TWO_ORDERS:g}: {verdicts[-1]}"
        )
    if not parts:
        return open_finding(_PLATE_RUNS)
    return Finding(
        together(verdicts),
        "; ".join(parts),
        resolution_of(evidence.summary, _BEAM),
        "A load uniform along the span gives 70 (bending) and 26 (torsion).",
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
        _quotients(evidence, pairs, column).is_above(1.0),
        _deviations(pairs, column) + _of_the_mesh(evidence, (column,)),
        resolution_of(evidence.reductions, model, _BEAM),
        _by_the_other_reduction(evidence, _SECTION, (column,)),
    )


def _means(evidence: Evidence, model: str, columns: tuple[str, ...]) -> Finding:
    name = f"{model}-paper"
    parts, verdicts = [], []
    for column in columns:
        pairs = _pairs(evidence.reductions, name, column)
        if not pairs.empty:
            verdicts.append(_quotients(evidence, pairs, column).meets(_FAIR))
            named = f": {verdicts[-1]}" if len(columns) > 1 else ""
            parts.append(f"{_deviations(pairs, column)}{named}")
    if not parts:
        return open_finding(_BOTH_REDUCTIONS)
    return Finding(
        together(verdicts),
        "; ".join(parts) + _of_the_mesh(evidence, columns),
        resolution_of(evidence.reductions, name, _BEAM),
        _by_the_other_reduction(evidence, model, columns),
    )


def _quotients(evidence: Evidence, pairs: pd.DataFrame, column: str) -> Known:
    """Return section over plate, over all k*, with what the mesh may change in it.

    At rest twist and deflection go as moment and lift, so the quotient of the rigid loads on two
    meshes tells of theirs.
    """
    quotient = pairs["here"] / pairs["beam"]
    part = _part_of_mesh(evidence, column)
    low, high = float(quotient.min()), float(quotient.max())
    return Known(float(quotient.mean()), low * (1.0 - part), high * (1.0 + part))


def _part_of_mesh(evidence: Evidence, column: str) -> float:
    """Return what mesh and iterations may change in section over plate, as a part of it.

    The first is the half-width of the quotient of the rigid loads over the meshes, the second the
    difference of the plate's means with two iterations from those with four.
    """
    limit = evidence.limit(_LOADS[column], EQUAL_CELLS, "2.5 deg")
    rows = evidence.over_meshes(_name(column), TWO_OVER_FOUR, _LEARNT_AT)
    coarse = rows.loc[rows["mesh"] == "coarse", "value"]
    of_iterations = abs(float(coarse.iloc[0]) - 1.0) if len(coarse) else math.nan
    return math.hypot(limit.half_width / limit.value, of_iterations)


def _of_the_mesh(evidence: Evidence, columns: tuple[str, ...]) -> str:
    parts = [_part_of_mesh(evidence, column) for column in columns]
    if all(map(math.isfinite, parts)):
        words = ", ".join(
            f"{100 * part:.2g} %" + f" ({_name(column)})" * (len(columns) > 1)
            for column, part in zip(columns, parts, strict=True)
        )
        return f". By mesh and iterations ± {words}"
    return ". What mesh and iterations change in it is not known"


def _by_the_other_reduction(evidence: Evidence, model: str, columns: tuple[str, ...]) -> str:
    """Say the same of the consistent reduction, which is not what the claim speaks of."""
    found = [
        _range(pairs, column)
        for column in columns
        if not (pairs := _pairs(evidence.reductions, f"{model}-consistent", column)).empty
    ]
    words = f"With the consistent reduction {', '.join(found)}, on" if found else "On"
    return f"{words} [the same cells](reductions.md)."


def _range(pairs: pd.DataFrame, column: str) -> str:
    relative = pairs["here"] / pairs["beam"] - 1.0
    ends = dict.fromkeys((percent(relative.min()), percent(relative.max())))
    return f"{_name(column)} {' to '.join(ends)}"


def _pairs(runs: pd.DataFrame, model: str, column: str) -> pd.DataFrame:
    """Return k* and a mean of a model and of the beam where the motion of both is small.

    Undecided runs have no mean to be compared.
    """
    decided = ~runs["regime"].isin(["failed", "undecided"])
    small = runs[(runs["twist_amplitude_deg"] < _SMALL) & decided]
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
    """Judge the k* of the onset of both corrected sections and of the plate, by the best limits."""
    parts, verdicts = [], []
    paper = Known(*PAPER_ONSET)
    for model in (_CORRECTED, OWN_RATIOS, _BEAM):
        best = best_limit(evidence.convergence, model)
        if best is None:
            continue
        basis = str(best["basis"])
        rows = evidence.over_meshes(ONSET, model, "", basis)
        rows = rows[rows["mesh"] != LIMIT]
        limit = evidence.limit(ONSET, model, "", basis)
        by_mesh = ", ".join(f"{row.value:.2f} ({row.mesh})" for row in rows.itertuples())
        verdicts.append(limit.meets(paper))
        at = f", limit {limit.words('.2f')}" if math.isfinite(limit.half_width) else ""
        parts.append(f"{_TITLES.get(model, model)} ({basis}): k* = {by_mesh}{at}: {verdicts[-1]}")
    if not parts:
        return open_finding("runs on both sides of the onset")
    return Finding(
        together(verdicts),
        f"{'; '.join(parts)}. Paper {paper.words()}",
        "the narrowest limit of each model over its meshes ([how](mesh-convergence.md))",
        f"{_with_damping(evidence)} By the sweep on `coarse`, not converged: "
        f"{_brackets(evidence)}. The paper reads its onset off the slope of the means.",
    )


def _with_damping(evidence: Evidence) -> str:
    """Say what structural damping, of which the paper says nothing, makes of the onset."""
    parts: dict[str, list[str]] = {}
    for model in (_CORRECTED, OWN_RATIOS, _BEAM):
        found = {}
        for zeta in DAMPING:
            rows = evidence.over_meshes(ONSET, model, damped(zeta), BY_MODEL)
            rows = rows[rows["mesh"] != LIMIT]
            if len(rows):
                found[f"{100 * zeta:g}"] = f"{float(rows['value'].iloc[-1]):.2f}"
                mesh = rows["mesh"].iloc[-1]
        if found:
            onsets, dampings = (", ".join(one) for one in (found.values(), found))
            of_these = parts.setdefault(dampings, [])
            of_these.append(f"{_TITLES.get(model, model)} ({mesh}) {onsets}")
    if not parts:
        return ""
    words = (f"{'; '.join(models)} at {dampings} %" for dampings, models in parts.items())
    return (
        "With structural damping (of critical, both motions; the paper gives none) the learnt "
        f"models on the finest mesh have k* = {'; '.join(words)}."
    )


def _brackets(evidence: Evidence) -> str:
    parts = []
    for model in (_CORRECTED, _BEAM, _SECTION):
        unstable, stable = evidence.bracket(model)
        if math.isfinite(unstable) and math.isfinite(stable):
            parts.append(f"{model} between {unstable:g} and {stable:g}")
    return "; ".join(parts) or "none"


def limit_cycle(evidence: Evidence) -> Finding:
    """Judge the runs next to the corrected section's onset, and the longest run inside."""
    runs = [evidence.at(_CORRECTED, k_star) for k_star in evidence.bracket(_CORRECTED)]
    known = [run for run in runs if run is not None]
    if not known:
        return open_finding("runs on both sides of the onset of the corrected section")
    verdicts, parts = [], []
    for run in known:
        is_cycle = run["regime"] == "limit-cycle"
        steady = run.get("growth_low", math.nan) <= 0.0 <= run.get("growth_high", math.nan)
        if is_cycle:
            verdicts.append(ClaimVerdict.AGREES if steady else ClaimVerdict.NOT_CONVERGED)
        parts.append(f"at k* = {run['k_star']:g}: {_in_words(run)}")
    if not verdicts:
        verdicts.append(ClaimVerdict.NOT_CONVERGED)
    inside = evidence.kept[
        (evidence.kept["regime"] == "limit-cycle") & (evidence.kept["end_time"] >= _TO_THE_CYCLE)
    ]
    for run in inside.itertuples():
        verdicts.append(ClaimVerdict.AGREES)
        parts.append(
            f"inside, {run.model} at k* = {run.k_star:g} after {run.end_time:.0f} c/V: limit cycle "
            f"of {run.twist_amplitude_deg:.3g} deg, growth {run.growth_rate:+.4f} V/c"
        )
    return Finding(
        together(verdicts),
        "; ".join(parts),
        resolution_of(evidence.summary, _CORRECTED),
        "A growth within a few 1e-4 V/c of zero keeps the amplitude over a run, which is no proof "
        "of a cycle for good.",
    )


def growing_inside(evidence: Evidence) -> Finding:
    """Judge whether the paper's corrected section grows faster than the plate, k* by k*."""
    model = f"{_CORRECTED}-paper"
    both = _growing(evidence.kept, model)
    if both.empty:
        return open_finding(_BOTH_REDUCTIONS)
    mesh = _mesh_error_of_plate(evidence)
    verdicts, parts = [], []
    for row in both.itertuples():
        difference = row.here - row.beam
        half = math.hypot(row.half, row.half_beam, mesh)
        verdicts.append(Known(difference, difference - half, difference + half).is_above(0.0))
        parts.append(
            f"{row.here:+.4f} ± {row.half:.4f} and {row.beam:+.4f} ± {row.half_beam:.4f} at "
            f"{row.k_star:g}: {verdicts[-1]}"
        )
    words = "not known" if math.isnan(mesh) else f"± {mesh:.3f} V/c by two meshes of the plate"
    return Finding(
        together(verdicts),
        f"growth of section and plate (V/c, from 20 c/V after the release on): {'; '.join(parts)} "
        f"(k*). Error of the mesh: {words}",
        resolution_of(evidence.reductions, model, _BEAM),
        "On [the same cells](reductions.md). Without the first 20 of 60 c/V (the release shows) "
        "the plate's record is short for a growth rate.",
    )


def _mesh_error_of_plate(evidence: Evidence) -> float:
    """Return half of the interval that two meshes leave of the plate's growth (V/c); NaN of none.

    It is that of releases from equilibrium, where both meshes have one, and else that of the first
    30 c/V from rest.
    """
    of_equilibrium, early = (
        evidence.limit(quantity, _BEAM, _LEARNT_AT).half_width
        for quantity in (GROWTH, GROWTH_EARLY)
    )
    return of_equilibrium if math.isfinite(of_equilibrium) else early


def _growing(kept: pd.DataFrame, model: str) -> pd.DataFrame:
    """Return k*, growth (V/c) and half of its interval of a model and the beam, where both grow.

    Of several runs of the beam the coarse one with the sweep's iterations is taken, which has the
    section's cells in the plane.
    """
    growing = kept[(kept["growth_behind"] > 0.0) & (kept["resolution"] == "coarse")]
    sections = growing[(growing["model"] == model) & (growing["folder"] == _REDUCTIONS)]
    beams = growing[(growing["model"] == _BEAM) & ~growing["folder"].str.startswith("independence")]
    beams = beams.sort_values("end_time").drop_duplicates("k_star", keep="last")
    joined = sections.merge(beams, on="k_star", suffixes=("", "_beam")).sort_values("k_star")
    found = {"k_star": joined["k_star"]}
    for end, name in (("", ""), ("_beam", "_beam")):
        found["beam" if end else "here"] = joined[f"growth_behind{end}"]
        low, high = (joined[f"growth_behind_{side}{end}"] for side in ("low", "high"))
        found[f"half{name}"] = 0.5 * (high - low)
    return pd.DataFrame(found).dropna()


def decay_at_high_stiffness(evidence: Evidence) -> Finding:
    """Judge the stiffest runs, with what the mesh may change in their growth."""
    parts, verdicts = [], []
    mesh = {
        _SECTION: evidence.limit(GROWTH, _SECTION, "k* = 14").half_width,
        _BEAM: _mesh_error_of_plate(evidence),
    }
    mesh[_CORRECTED] = mesh[_SECTION]
    for model in (_SECTION, _CORRECTED, _BEAM):
        runs = evidence.runs(model)
        stiff = runs[runs["k_star"] >= _HIGH]
        if stiff.empty:
            parts.append(f"{model}: not run from k* = {_HIGH:g} on")
            verdicts.append(ClaimVerdict.NOT_CONVERGED)
            continue
        run = stiff.iloc[-1]
        rate, half = float(run["growth_rate"]), mesh[model]
        verdicts.append(Known(rate, rate - half, rate + half).is_below(0.0))
        by_mesh = f"± {half:.4f}" if math.isfinite(half) else "± an unknown error"
        parts.append(
            f"{model} at k* = {run['k_star']:g}: {_in_words(run)}, {by_mesh} by the mesh: "
            f"{verdicts[-1]}"
        )
    if all(part.endswith("on") for part in parts):
        return open_finding("runs at high k*")
    return Finding(
        together(verdicts),
        "; ".join(parts),
        resolution_of(evidence.summary, _SECTION, _CORRECTED, _BEAM),
        "Errors of the mesh: section at k* = 14, plate at 6.44.",
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
    own = f"Its flutter is at k* = {flutter:.2f}, " if math.isfinite(flutter) else "It has none; "
    return Finding(
        ClaimVerdict.AGREES if fastest["growth_rate"] < 0.0 else ClaimVerdict.DIFFERS,
        f"at k* = {unstable:g}, with the uncorrected section still unstable, the least damped "
        f"motion of linear theory ({fastest['motion']}) decays by "
        f"{fastest['growth_rate']:+.4f} V/c. {own}divergence at {divergence:.2f} "
        f"({by_polar:.2f} with the slope of the section's own c_m)",
        "Theodorsen's loads, k and p-k methods",
        "The instability is none of attached, linear flow. There is [a linear flutter](linear.md), "
        "next to divergence and far below the k* at which the section stalls.",
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
        f"the cells and steps (paper {_PAPER_COST:.0f})",
        f"{dearest['what']} over {section['what']}",
        "The meshes here are nearer in size than the paper's.",
    )
