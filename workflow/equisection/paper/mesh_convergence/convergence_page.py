"""Page of onset, growth, means and loads over the cell size."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from equisection.paper.mesh_convergence.kept_releases import MESHES, OWN_RATIOS
from equisection.paper.mesh_convergence.loads_by_mesh import (
    EQUAL_CELLS,
    FIRST_MODE,
    MEANS,
    RIGID,
    TWO_OVER_FOUR,
    printed_limit,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    GROWTH,
    GROWTH_EARLY,
    ONSET,
)
from equisection.paper.printed_values import COEFFICIENTS, PAPER_ONSET

#: Kinds of the beam's modes.
KINDS = ("torsion", "bending")
#: Half-width of an interval, as a part of the value, up to which a value counts as converged.
CONVERGED = 0.1

_PICTURE = (
    "Left: k* of the onset over the cell size, of three models, with the limit of each and the "
    "paper's 5.5. Right: over the structural damping"
)
_HEAD = f"""# The onset over the cell size

Onset of the paper's plate and of its sections over the cell size, and how sure its limit is.

![{_PICTURE}](onset-over-cell-size.png)

```
make paper                                          # or this step of it alone:
python -m equisection.paper.mesh_convergence
```

writes this page, its figure and `results/paper-convergence/mesh_convergence.csv` from the kept
results, with no flow solver: do not edit it.

A **limit** is the value at vanishing cell size. Its interval depends on the meshes:

| of | interval |
| --- | --- |
| three meshes | grid convergence index, observed order up to 2, factor 1.25 (Celik et al. 2008) |
| two meshes | the same with order 2 and factor 3 (Roache 1998) |
| three, order not 0.5 to 4 or none | 3 times the largest difference (Eca and Hoekstra 2014) |
| one mesh | not known |

Intervals of growth rates and bands of learnt models are added as independent errors. *Converged*
has an interval of ± {100 * CONVERGED:g} % or less.
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
    chosen = [one for one in series if one.quantity == ONSET and not one.at]
    low, high = PAPER_ONSET[1:]
    stated = f"{PAPER_ONSET[0]:g}, here taken as {low:g} to {high:g}"
    text = f"""## Onset

k\\* of the onset; above it a release decays. The paper has about {stated}.

{_table(("model", "basis"), [(one.model, one.basis) for one in chosen], chosen)}
- *releases*: growth rates of the runs, zero between two k\\*. A mesh with one release has the
  growth curve of the next coarser mesh, shifted by the difference of both at that k\\*.
- *learnt model*: from the release at k\\* 6.44 on that mesh ([how](reduced-model.md)); a polar of
  few angles is filled in the shape of the next coarser one.
- `2d-corrected` divides the section's loads by the plate's of the paper's Table 1: two programs'
  errors, and a moment factor that grows with the mesh.
- `{OWN_RATIOS}` divides by this project's plate, on equal cells in the plane
  {f"(mesh {own_mesh})" if own_mesh else "(not kept)"}.
"""
    return text + _notes(chosen) + _of_the_plate(chosen)


def _of_the_plate(chosen: Sequence[MeshSeries]) -> str:
    plate = [one for one in chosen if one.model == "3d" and one.basis != BY_MODEL]
    if not plate or not math.isfinite(plate[0].limit.half_width):
        return ""
    limit = plate[0].limit
    return f"""
**The plate's onset is not converged**: its limit has the interval {limit.low:.1f} to
{limit.high:.1f}. On `medium` only its difference from `coarse` over 30 c/V is known; the longer run
is [not converged in its time step](plate-sweep.md#on-the-medium-mesh).
"""


def _damping(series: Sequence[MeshSeries]) -> str:
    chosen = [one for one in series if one.quantity == ONSET and one.basis == BY_MODEL]
    return f"""## Structural damping

The paper gives none. Limits of the onset by the learnt models with the same damping (of critical)
in bending and torsion, with half of their intervals (none on one mesh):

{_limits("damping", chosen, form=".2f", line=lambda one: one.model)}"""


def _growth(series: Sequence[MeshSeries]) -> str:
    chosen = [one for one in series if one.quantity == GROWTH]
    early = [one for one in series if one.quantity == GROWTH_EARLY and one.values]
    rows = [(one.at.removeprefix("k* = "), one.basis.removeprefix("releases, ")) for one in chosen]
    text = f"""## Growth at one k\\*

Growth of the section `2d` (V/c, with its interval of 95 %) over the same window on each mesh:

{_table(("k*", "window"), rows, chosen, form="+.4f", judged=False)}
"""
    if early:
        notes = "; ".join(f"{value.mesh} {value.note}" for value in early[0].values)
        text += f"""
The plate (`3d`) at {_plain(early[0].at)}, four iterations a step, 10 to 30 c/V. **Only the
difference of both meshes counts**: fits with and without the second bending mode differ by more
than their errors ({notes}).

{_table(("model",), [("3d",)], early, form="+.4f", judged=False)}
"""
    return text


def _means(series: Sequence[MeshSeries]) -> str:
    chosen = [one for one in series if one.quantity in MEANS.values()]
    return f"""## Means and frequency

Limits of the section `2d` with half of their intervals; in italics what is not converged:

{_limits("k*", chosen, form=".4g")}
The values on each mesh are in `results/paper-convergence/mesh_convergence.csv`.
"""


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

The column *paper* is the limit of the paper's own three meshes by the same rule.

{_table(("incidence", "coefficient", "paper"), of_plate, plate, form=".4f")}
"""
        + _notes(plate)
        + _of_one_plate(series)
    )


def _of_one_plate(series: Sequence[MeshSeries]) -> str:
    """Return the quotients on equal cells, and those of the plate's modes."""
    ratios = [one for one in series if one.model == EQUAL_CELLS]
    modes = [one for one in series if one.quantity in map(FIRST_MODE.format, KINDS)]
    of_modes = [(one.quantity,) for one in modes]
    at = _plain(modes[0].at) if modes else ""
    iterations = [one for one in series if one.model == TWO_OVER_FOUR]
    quotients = "; ".join(
        f"{one.quantity} {', '.join(f'{v.value:.3f} ({v.mesh})' for v in one.values)}"
        for one in iterations
    )
    return f"""
## Section over plate

Loads of the rigid section over those of the rigid plate, on equal cells in the plane:

{_limits("incidence", ratios, form=".3f")}
## Modes of the plate

Mean of the first mode over that of the next, at {at}, four iterations a step, 10 to 30 c/V:

{_table(("quantity",), of_modes, modes, form=".1f")}

## Iterations of a time step

Means of the plate with two iterations over those with four, at {at}, 10 to 30 c/V: {quotients}. Two
are enough for the means on `coarse`, and not on `medium`.
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
    meshes = [m for m in MESHES if any(v.mesh == m for one in series for v in one.values)]
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
    line: Callable[[MeshSeries], str] = lambda one: one.quantity,
) -> str:
    """Return a line for each quantity: its limit at each place, in italics if not converged."""
    places = list(dict.fromkeys(one.at for one in series))
    lines = [[_plain(head), *(_plain(at.rpartition(" = ")[2] or "0") for at in places)]]
    lines.append(["---"] * len(lines[0]))
    found = {(line(one), one.at): one for one in series}
    for name in dict.fromkeys(map(line, series)):
        cells = [found.get((name, at)) for at in places]
        lines.append([name, *("" if one is None else _limit(one, form) for one in cells)])
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
    found: dict[str, list[str]] = {}
    for one in series:
        for value in one.values:
            if value.note:
                found.setdefault(value.note, []).append(f"{one.model} ({one.basis}, {value.mesh})")
    lines = (
        f"- {', '.join(dict.fromkeys(names))}: {_plain(note)}.\n" for note, names in found.items()
    )
    return "".join(lines)


def _plain(text: str) -> str:
    """Keep the asterisk of k* from being read as a mark."""
    return text.replace("k*", "k\\*")
