"""Write the page that compares the paper's claims with the findings of this project.

    python -m equisection.paper.claims_page            # writes docs/side-by-side.md
    python -m equisection.paper.claims_page --check    # tells whether it is up to date

The evidence is in the runs that ``make paper`` leaves in ``results/``, and in those kept in
``results/reference/``.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pandas as pd

from equisection.errors import EquisectionError
from equisection.generated import write_outdated
from equisection.paper.claims_page.claims import CLAIMS, Claim
from equisection.paper.claims_page.evidence import Evidence, read_evidence
from equisection.paper.claims_page.findings import Finding
from equisection.paper.claims_page.kept_runs import base_of, cost_ladder
from equisection.paper.mesh_convergence.__main__ import TABLE
from equisection.paper.mesh_convergence.convergence_page import CONVERGED
from equisection.paper.printed_values import ABOUT
from equisection.verdict.zigzag import LARGEST_ZIGZAG

PAGE = Path("docs/side-by-side.md")
#: Table of the runs that are kept, next to the page.
RUNS = Path("kept-runs.csv")
COMMAND = "python -m equisection.paper.claims_page"
#: Columns of that table, with their format.
_OF_RUN = {
    "folder": "",
    "model": "",
    "k_star": "g",
    "resolution": "",
    "cells": ".0f",
    "time_step": "g",
    "regime": "",
    "growth_rate": "+.4f",
    "twist_amplitude_deg": ".2g",
    "loads_zigzag": ".2g",
    "end_time": ".0f",
    "cpu_seconds": ".0f",
}
_HEAD = f"""# The paper, claim by claim

```
make paper
```

writes this page from `results/reference/`, with no flow solver: do not edit it.

| verdict | means |
| --- | --- |
| **agrees** | the value here is converged, its interval meets the paper's |
| **differs** | it is converged, its interval does not |
| **not converged** | its interval is too wide for either, or not known |
| **partly** | a part of the claim agrees |

A value here is the limit over the meshes with its interval ([how](mesh-convergence.md)),
converged at ± {100 * CONVERGED:g} % or less; against a bound, where all of it lies on one side.
The paper's interval is that of its three meshes by the same rule (Table 1), ± {100 * ABOUT:g} % of
a value that it calls approximate, and half a digit of any other. ± {100 * ABOUT:g} % counts as
fair agreement.
"""


def page(evidence: Evidence) -> str:
    """Return the page."""
    findings = [(claim, claim.judge(evidence)) for claim in CLAIMS]
    findings = list(_once(findings))
    parts = [_HEAD, _overview(findings)]
    parts += [_section(number, *pair) for number, pair in enumerate(findings, start=1)]
    parts += [_cost(evidence), _kept(evidence.kept), _missing(evidence.missing)]
    return "\n".join(parts)


def _once(findings: Iterable[tuple[Claim, Finding]]) -> Iterator[tuple[Claim, Finding]]:
    """Yield the findings; resolution and cost that an earlier one has too refer to that one."""
    first: dict[str, int] = {}
    for number, (claim, finding) in enumerate(findings, start=1):
        before = first.setdefault(finding.how, number)
        how = f"as in {before}" if finding.how and before < number else finding.how
        yield claim, replace(finding, how=how)


def _overview(findings: Iterable[tuple[Claim, Finding]]) -> str:
    rows = (
        (f"[{claim.title}](#{_anchor(number, claim)})", f"**{finding.verdict}**")
        for number, (claim, finding) in enumerate(findings, start=1)
    )
    return _table(("claim", "here"), rows)


def _anchor(number: int, claim: Claim) -> str:
    """Return the anchor that renderers make of a claim's heading."""
    heading = f"{number}. {claim.title}".lower()
    return "".join(c for c in heading if c.isalnum() or c in " -").replace(" ", "-")


def _section(number: int, claim: Claim, finding: Finding) -> str:
    lines = [
        f"## {number}. {claim.title}\n",
        f'> "{_plain(claim.words)}" ({claim.source})\n',
        f"**{str(finding.verdict).capitalize()}:** {_plain(finding.here)}.\n",
    ]
    if finding.how:
        lines.append(f"*By:* {_plain(finding.how)}.\n")
    if finding.why:
        lines.append(f"{_plain(finding.why)}.\n")
    return "\n".join(lines)


def _cost(evidence: Evidence) -> str:
    ladder = cost_ladder(evidence.kept, evidence.embedded)
    base = base_of(ladder)
    base = ladder.iloc[-1] if base is None else base
    rows = [
        (
            row.what.replace(" OpenFOAM, ", " ").replace(" outer correctors", ""),
            _number(row.cells, ".0f"),
            _number(row.time_step, "g"),
            f"{row.seconds:.2g}",
            f"{row.seconds / base['seconds']:.2g}",
        )
        for row in ladder.itertuples()
    ]
    columns = ("mesh, outer correctors", "cells", "step, c/V", "s for each c/V", "ratio")
    return (
        "## Cost ladder\n\n"
        "Processor time (s) for each c/V simulated, by OpenFOAM or embedded, at the k\\* of "
        "the embedded solver's runs (`make cost`). Ratio: to the section of the sweep.\n\n"
    ) + _table(columns, rows)


def _kept(kept: pd.DataFrame) -> str:
    zigzag = int((kept["loads_zigzag"] > LARGEST_ZIGZAG).sum())
    return (
        "## Runs that are kept\n\n"
        f"[`{RUNS.name}`]({RUNS.name}) has the {len(kept)} releases of plate and sections (V/c, "
        f"c/V). Of {zigzag} the zigzag of the loads is above {LARGEST_ZIGZAG:g}: [not converged in "
        "their time step](openfoam-sweep.md#loads-that-zigzag).\n"
    )


def runs_table(kept: pd.DataFrame) -> str:
    """Return the runs that are kept as CSV."""
    columns = {
        name: [_number(value, form) if form else value for value in kept[name]]
        for name, form in _OF_RUN.items()
    }
    return str(pd.DataFrame(columns).to_csv(index=False))


def _missing(missing: pd.DataFrame) -> str:
    if missing.empty:
        return "## What is missing\n\nNothing that `make paper` asks for.\n"
    rows = [(row.kind, row.model, row.case, _plain(row.reason)) for row in missing.itertuples()]
    return (
        "## What is missing\n\nNothing kept answers these cases of `make paper`; "
        "`make paper FROM=scratch` computes them.\n\n"
    ) + _table(("kind", "model", "case", "reason"), rows)


def _table(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else ""


def _plain(text: str) -> str:
    """Keep the asterisk of k* from being read as a mark, and end without a full stop twice."""
    return text.replace("k*", "k\\*").rstrip(".")


def main(arguments: Sequence[str] | None = None) -> int:
    """Write or check the page; return the exit status."""
    parser = argparse.ArgumentParser(prog=COMMAND, description="The paper's claims, judged here.")
    parser.add_argument("--figures", type=Path, default=Path("results/paper-figures"))
    parser.add_argument("--plate", type=Path, default=Path("results/paper-plate-figures"))
    parser.add_argument("--reductions", type=Path, default=Path("results/paper-reductions"))
    parser.add_argument("--reference", type=Path, default=Path("results/reference"))
    parser.add_argument("--convergence", type=Path, default=TABLE)
    parser.add_argument("--page", type=Path, default=PAGE)
    parser.add_argument("--check", action="store_true", help="only tell whether it is up to date")
    options = parser.parse_args(arguments)
    try:
        runs = (options.figures, options.plate, options.reductions)
        evidence = read_evidence(*runs, options.reference, options.convergence)
    except EquisectionError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    wanted = {
        options.page: page(evidence),
        options.page.with_name(RUNS.name): runs_table(evidence.kept),
    }
    return write_outdated(wanted, Path(), "make paper", check=options.check)


if __name__ == "__main__":
    sys.exit(main())
