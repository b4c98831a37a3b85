"""Page of onset, growth, means and loads over the cell size."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterable, Sequence

from equisection.analysis.grid_limit import FORMAL_ORDER
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    MESHES,
    OWN_RATIOS,
)
from equisection.paper.mesh_convergence.loads_by_mesh import (
    EQUAL_CELLS,
    MEANS,
    RIGID,
    TWO_OVER_FOUR,
    printed_limit,
)
from equisection.paper.mesh_convergence.mesh_series import (
    MeshSeries,
    MeshValue,
    as_table,
    is_part_of_another,
)
from equisection.paper.mesh_convergence.onset_by_difference import BY_DIFFERENCE
from equisection.paper.mesh_convergence.onset_by_direction import (
    ALONG_SPAN,
    BY_DIRECTION,
    IN_PLANE,
    SPARSE,
    hides_error,
)
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    BY_RELEASES,
    GROWTH,
    ONSET,
    POLAR_OF,
)
from equisection.paper.mesh_convergence.onset_by_mesher import AROUND, BOTH_MESHERS, DO_NOT_MEET
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    BY_EQUILIBRIUM,
    LEARNT_FROM_EQUILIBRIUM,
)
from equisection.paper.mesh_convergence.onset_targets import best_limit, foreseen, targets
from equisection.paper.printed_values import COEFFICIENTS, PAPER_ONSET
from equisection.solvers.openfoam.mesh.presets import PRESETS

#: Twist (deg) that disturbs the equilibrium of a release.
DISTURBANCE = FROM_EQUILIBRIUM["twist_deg"]
#: Bases of an onset that is predicted by a learnt model.
_LEARNT = (BY_MODEL, LEARNT_FROM_EQUILIBRIUM)
#: Half-width of an interval, as a part of the value, up to which a value counts as converged.
CONVERGED = 0.1

_PICTURE = "The onset: left over the cell size, right over the structural damping"
_HEAD = f"""# The onset over the cell size

Onset of the paper's plate and sections, and how sure its limit is.

![{_PICTURE}](onset-over-cell-size.png)

```
make paper                                          # or this step of it alone:
python -m equisection.paper.mesh_convergence
```

writes this page, its figure and `results/paper-convergence/mesh_convergence.csv` from kept
results.

A **limit** is the value at vanishing cell size:

| meshes | its interval |
| --- | --- |
| three | grid convergence index, observed order up to 2.1, factor 1.25 (Celik et al. 2008) |
| three, order above: errors of opposite signs, or chance | as of two |
| more | so of the finest and two that differ by more than their errors; one between adds its miss |
| two | the same with order 2 and factor 3 (Roache 1998) |
| three, order below 0.5, above 4 or none | 3 times the largest difference (Eca and Hoekstra 2014) |
| one | not known |

Intervals of growth rates and bands of learnt models are added as independent errors. *Converged*:
± {100 * CONVERGED:g} % or less.
"""


def page(series: Sequence[MeshSeries], own_mesh: str) -> str:
    """Return the page.

    Parameters
    ----------
    series
        All series.
    own_mesh
        Mesh of the plate that the own ratios are of; empty if there are none.
    """
    parts = [
        _HEAD,
        _onsets(series, own_mesh),
        _damping(series),
        _growth(series),
        _means(series),
        _loads(series),
    ]
    return "\n".join(parts)


def _onsets(series: Sequence[MeshSeries], own_mesh: str) -> str:
    every = [one for one in series if one.quantity == ONSET and not one.at]
    excluded = _contradictions([one for one in every if one.model == "3d"])
    # what the runs exclude has a line of its own
    chosen = [one for one in every if not (excluded and one.basis == LEARNT_FROM_EQUILIBRIUM)]
    shown = [
        one
        for one in chosen
        if not is_part_of_another(one, (other for other in chosen if other.model == one.model))
    ]
    low, high = PAPER_ONSET[1:]
    stated = f"{PAPER_ONSET[0]:g}, here taken as {low:g} to {high:g}"
    of_directions = (
        f"- *{BY_DIRECTION}*: cells that shrink in the plane alone, and what is left along the\n"
        "  span ([growth](#growth-at-one-k)).\n"
        if (is_by_direction := any(one.basis == BY_DIRECTION for one in chosen))
        else ""
    )
    of_meshers = _of_both_meshers(chosen)
    text = f"""## Onset

k\\* of the onset; above it a release decays. The paper: about {stated}.

{_table(("model", "basis"), [(one.model, one.basis) for one in shown], shown)}
- *releases*: zero of the runs' growth between two k\\*. From one release on a mesh: the next
  coarser growth curve, shifted by the difference at that k\\*.
- *learnt model*: from the release at k\\* 6.44 on that mesh ([how](reduced-model.md)); a polar of
  few angles is filled in the shape of the next coarser one.
- *{BY_EQUILIBRIUM}*: with {DISTURBANCE:g} deg more ([why](openfoam.md#starts)), growth of small
  motions from 10 c/V on. A finer mesh, or more iterations, shift the curve by the difference at
  one k\\*; the interval has what the section's shift changes with k\\*.
- *{BY_DIFFERENCE}*: the best onset of `2d`, and what the correction moves it by: by releases
  where there are any, on finer meshes as the learnt models change. That change is as uncertain as
  it is large, or as they miss the releases.
- *{LEARNT_FROM_EQUILIBRIUM}*: from such a release at k\\* 6.44; onset by eigenvalues.
{of_directions}{of_meshers}\
- `2d-corrected` divides by the plate of the paper's Table 1: two programs' errors, and a moment
  factor that grows with the mesh; `{OWN_RATIOS}` by this project's plate, on equal cells in the
  plane {f"(mesh {own_mesh}; releases: the mesh's own)" if own_mesh else "(not kept)"}.
"""
    has_it = is_by_direction or any(
        (one.model, one.basis) == ("3d", BOTH_MESHERS) for one in chosen
    )
    hidden = "" if has_it else _hidden(series)
    of_plate = _of_the_plate(chosen, narrowed=not hidden) + excluded + hidden
    return text + _notes(chosen) + of_plate + _targets(chosen)


def _of_the_plate(chosen: Sequence[MeshSeries], *, narrowed: bool) -> str:
    best = best_limit(as_table(chosen), "3d")
    if best is None:
        return ""
    one = next(one for one in chosen if (one.model, one.basis) == ("3d", best["basis"]))
    limit, state = one.limit, "converged" if is_converged(one) else "not converged"
    if not math.isfinite(limit.half_width):
        return "\n**The plate's onset is not converged**: each of its series has one mesh.\n"
    order = f", with the assumed order {FORMAL_ORDER:g}" if limit.meshes == 2 else ""
    is_of_two = limit.meshes == 2 and one.derived is None
    first = f" ({_by_first_order(one):.1f} with the order 1)" if is_of_two else ""
    return f"""
**The plate's onset is {state}**: its best limit ({one.basis}) is {limit.value:.1f} with the
interval {limit.low:.1f} to {limit.high:.1f}{order}{first}.
{_what_narrows_it(one) if narrowed else ""}From rest the run on `medium` is
[not converged in its time step](plate-sweep.md#on-the-medium-mesh) beyond 30 c/V.
"""


def _hidden(series: Sequence[MeshSeries]) -> str:
    """Return whether the cells of the plate in the plane are too coarse to show their error."""
    if not any(hides_error(one) for one in series if (one.model, one.basis) == ("2d", IN_PLANE)):
        return ""
    return (
        "On the plate's cells in the plane the section changes more from `medium` to `fine` than\n"
        "before ([growth](#growth-at-one-k)): do not trust the plate's limit by two meshes.\n"
    )


def _what_narrows_it(one: MeshSeries) -> str:
    """Return how narrow the interval of two meshes would become with finer ones."""
    if one.limit.meshes != 2 or one.derived is not None:
        return ""
    fine, extra = (PRESETS[name].plate_cells for name in ("fine", "extra-fine"))
    limits = [foreseen(one, [fine]), foreseen(one, [fine, extra], 0.5 * one.values[-1].half_width)]
    parts = [f"{100.0 * limit.half_width / limit.value:.0f} %" for limit in limits]
    return (
        f"By these rules and order 2 `fine` ({fine / 1e6:.1f} million cells) would make it ± "
        f"{parts[0]};\n`extra-fine` ({extra / 1e6:.1f}) as well, with half of the error of each "
        f"onset, ± {parts[1]}.\n"
    )


def _contradictions(chosen: Sequence[MeshSeries]) -> str:
    """Return where a learnt model and the releases on one mesh of blocks exclude each other."""
    lines, between = "", " and\n"
    for learnt in chosen:
        for here in learnt.values if learnt.basis in _LEARNT else ():
            excluded = [
                f"*{runs.basis}* ({_of_mesh([there], there.mesh, '.2f')})"
                for runs in chosen
                if runs.basis not in (*_LEARNT, AROUND, BOTH_MESHERS)
                for there in runs.values
                if here.mesh == there.mesh and (here.low > there.high or here.high < there.low)
            ]
            if excluded:
                lines += (
                    f"On `{here.mesh}` *{learnt.basis}* ({_of_mesh([here], here.mesh, '.2f')})\n"
                    f"excludes {between.join(excluded)}.\n"
                )
    if lines:
        lines += "The runs count: do not trust such a model away from the k\\* of its release.\n"
    return lines


def _by_first_order(one: MeshSeries) -> float:
    """Return the limit of two meshes if the error fell as the cell size."""
    (there, here), (coarse, fine) = (value.value for value in one.values), one.sizes
    return here + (here - there) / (coarse / fine - 1.0)


def _targets(chosen: Sequence[MeshSeries]) -> str:
    """Return how sure the best limit of each model is, and how sure it is wanted."""
    lines = [("model", "basis", "interval", "wanted", "reached"), ("---",) * 5]
    for row in targets(as_table(chosen)).itertuples():
        interval = f"± {row.interval:.1f} %" if math.isfinite(row.interval) else "none"
        reached = "yes" if row.lacking == 0.0 else "no"
        lines.append((row.model, row.basis, interval, f"± {row.wanted:g} %", reached))
    table = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    return f"""
Best limit of each model: its interval, and the one wanted
(`python -m equisection.paper.mesh_convergence --targets`):

{table}
"""


def _of_both_meshers(chosen: Sequence[MeshSeries]) -> str:
    """Return what the limits of both meshers are together, and of which models they do not meet."""
    both = [one for one in chosen if one.basis == BOTH_MESHERS]
    if not both:
        return ""
    apart = ", ".join(f"`{one.model}`" for one in both if one.limit.basis == DO_NOT_MEET)
    return (
        f"- *{BOTH_MESHERS}*: meshes of blocks and around the [outline](outline-mesh.md). Where\n"
        "  their intervals meet, the narrower one, widened to hold the other limit; else both"
        f"{f' ({apart})' if apart else ''}.\n"
    )


def _damping(series: Sequence[MeshSeries]) -> str:
    learnt = [one for one in series if one.quantity == ONSET and one.basis == BY_MODEL]
    known = {one.model for one in learnt if math.isfinite(one.limit.half_width)}
    chosen = [one for one in learnt if one.model in known]
    return f"""## Structural damping

The paper gives none. Limits of the onset by the learnt models, with the same damping (of
critical) in both motions, and half of their intervals:

{_limits("damping", chosen, form=".2f", line=lambda one: one.model)}"""


def _growth(series: Sequence[MeshSeries]) -> str:
    growths = [one for one in series if one.quantity == GROWTH]
    directions = [one for one in growths if one.basis.startswith((ALONG_SPAN, IN_PLANE))]
    chosen, plate = (
        [
            one
            for one in growths
            if one.model == model and one not in directions and len(one.values) >= fewest
        ]
        for model, fewest in (("2d", 2), ("3d", 1))
    )
    rows = [(one.at.removeprefix("k* = "), _window(one.basis)) for one in chosen]
    text = f"""## Growth at one k\\*

Of `2d` (V/c, interval of 95 %), one window on all meshes:

{_table(("k*", "window, c/V"), rows, chosen, form="+.4f", judged=False)}
"""
    if plate:
        rows = [
            (
                one.at.removeprefix("k* = "),
                ", ".join(value.note.removesuffix(" iterations") for value in one.values),
            )
            for one in plate
        ]
        head = ("k*", "iterations a step")
        text += f"""
Of the plate from static equilibrium, 10 to 30 c/V:

{_table(head, rows, plate, form="+.4f", judged=False)}
"""
    if directions:
        text += f"""
On cells that shrink in one direction and are of `coarse` in the other (`{SPARSE}`: half of its
layers); sections on the plate's cells:

{_table(("k*", "finer"), _places(directions), directions, form="+.4f", judged=False)}
"""
    return text


def _places(series: Sequence[MeshSeries]) -> list[tuple[str, str]]:
    return [(one.at.removeprefix("k* = "), f"{one.basis}, `{one.model}`") for one in series]


def _window(basis: str) -> str:
    """Return the window of a growth, and its start where that is not from rest."""
    start, _, window = basis.replace(" c/V", "").partition(", ")
    return window if start == BY_RELEASES else f"{window}, from equilibrium"


def _means(series: Sequence[MeshSeries]) -> str:
    chosen = [one for one in series if one.quantity in MEANS.values()]
    return f"""## Means and frequency

Limits of the section `2d` with half of their intervals; not converged in italics:

{_limits("k*", chosen, form=".4g")}"""


def _loads(series: Sequence[MeshSeries]) -> str:
    section = [one for one in series if one.model == RIGID["2d"]]
    plate = [one for one in series if one.model == RIGID["3d"]]
    text = f"""## Loads of the rigid section

{_limits("incidence", section, form=".4f")}
"""
    of_plate = []
    for one in plate:
        printed = printed_limit(_symbol(one), float(one.at.split()[0]))
        of_plate.append((one.at, one.quantity, f"{printed.value:.4f} ± {printed.half_width:.4f}"))
    return (
        text
        + f"""
## Loads of the rigid plate, Table 1

*Paper* is the limit of its three meshes by the same rule (judged: [claim
3](side-by-side.md#3-loads-of-the-rigid-plate)).

{_table(("incidence", "coefficient", "paper"), of_plate, plate, form=".4f", judged=False)}
"""
        + _notes(plate)
        + _of_one_plate(series)
    )


def _of_one_plate(series: Sequence[MeshSeries]) -> str:
    """Return the quotients on equal cells, and those of the plate's means by iterations."""
    ratios = [one for one in series if one.model == EQUAL_CELLS]
    iterations = [one for one in series if one.model == TWO_OVER_FOUR]
    at = _plain(iterations[0].at) if iterations else ""
    quotients = "; ".join(
        f"{one.quantity} {', '.join(f'{v.value:.3f} ({v.mesh})' for v in one.values)}"
        for one in iterations
    )
    return f"""
## Section over plate

Rigid loads, on equal cells in the plane:

{_limits("incidence", ratios, form=".3f")}
## Iterations of a time step

Means of the plate with two over those with four, at {at}, 10 to 30 c/V:
{quotients}.
For means two are enough on `coarse`, not on `medium`; for the [onset](#onset) on neither.
"""


def _symbol(one: MeshSeries) -> str:
    assert one.quantity in COEFFICIENTS, "a coefficient of Table 1"
    return one.quantity


def _table(
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    series: Sequence[MeshSeries],
    form: str = ".2f",
    *,
    judged: bool = True,
) -> str:
    """Return a line for each series: its head, its values by mesh, order and limit."""
    meshes = [
        m for m in (SPARSE, *MESHES) if any(v.mesh == m for one in series for v in one.values)
    ]
    columns = [*map(_plain, head), *meshes, "order", "limit", "interval"]
    columns += ["converged"] if judged else []
    lines = [columns, ["---"] * len(columns)]
    for words, one in zip(rows, series, strict=True):
        limit = one.limit
        known = math.isfinite(limit.half_width)
        lines.append(
            [
                *map(_plain, words),
                *(_of_mesh(one.values, mesh, form) for mesh in meshes),
                f"{limit.order:.1f}" if math.isfinite(limit.order) else "",
                format(limit.value, form) if known else "",
                f"{format(limit.low, form)} to {format(limit.high, form)}" if known else "none",
                *(["yes" if is_converged(one) else "no"] if judged else []),
            ]
        )
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def _limits(
    head: str,
    series: Sequence[MeshSeries],
    form: str,
    line: Callable[[MeshSeries], str] | None = None,
) -> str:
    """Return a line for each quantity: its limit at each place, in italics if not converged.

    Of several models each has a line, unless ``line`` names the lines otherwise. Series of one line
    and place, which differ in their basis, share a cell.
    """
    models = {one.model for one in series}

    def named(one: MeshSeries) -> str:
        if line is not None:
            return line(one)
        return f"{one.quantity}, {one.model}" if len(models) > 1 else one.quantity

    places = list(dict.fromkeys(one.at for one in series))
    lines = [[_plain(head), *(_plain(at.rpartition(" = ")[2] or "0") for at in places)]]
    lines.append(["---"] * len(lines[0]))
    found: dict[tuple[str, str], list[str]] = {}
    for one in series:
        found.setdefault((named(one), one.at), []).append(_limit(one, form))
    for name in dict.fromkeys(map(named, series)):
        lines.append([name, *("; ".join(found.get((name, at), [])) for at in places)])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def _limit(one: MeshSeries, form: str) -> str:
    limit = one.limit
    if not math.isfinite(limit.half_width):
        return "none"
    words = f"{format(limit.value, form)} ± {format(limit.half_width, form.replace('4g', '2g'))}"
    return words if is_converged(one) else f"*{words}*"


def is_converged(one: MeshSeries) -> bool:
    """Tell whether the interval of a limit is narrow enough to judge by."""
    part = one.limit.half_width / abs(one.limit.value) if one.limit.value else math.nan
    return bool(part <= CONVERGED)


def _of_mesh(values: Iterable[MeshValue], mesh: str, form: str) -> str:
    for value in values:
        if value.mesh == mesh:
            half = value.half_width
            text = format(value.value, form)
            if math.isinf(half):
                return f"{text} (interval unknown)"
            return f"{text} ± {format(half, form.lstrip('+'))}" if half else text
    return ""


def _notes(series: Iterable[MeshSeries]) -> str:
    """Return the notes of values, each once: for all models of a basis and all its meshes."""
    found: dict[str, dict[tuple[str, str], dict[str, None]]] = {}
    for one in series:
        for value in one.values:
            if value.note and not value.note.startswith(POLAR_OF):  # which the bases tell
                models = found.setdefault(value.note, {}).setdefault((one.basis, value.mesh), {})
                models[one.model] = None
    lines = ""
    for note, places in found.items():
        meshes: dict[tuple[str, str], list[str]] = {}
        for (basis, mesh), models in places.items():
            meshes.setdefault(("; ".join(models), basis), []).append(mesh)
        names = (f"{m} ({basis}, {', '.join(on)})" for (m, basis), on in meshes.items())
        line = f"- {', '.join(names)}: {_plain(note)}."
        lines += textwrap.fill(line, 100, subsequent_indent="  ", break_on_hyphens=False) + "\n"
    return lines


def _plain(text: str) -> str:
    """Keep the asterisk of k* from being read as a mark."""
    return text.replace("k*", "k\\*")
