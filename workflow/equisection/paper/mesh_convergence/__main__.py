"""Write the page of onset, growth, means and loads over the cell size, with its figure and table.

    python -m equisection.paper.mesh_convergence            # docs/mesh-convergence.md, .png
    python -m equisection.paper.mesh_convergence --check    # tells whether the page is up to date
    python -m equisection.paper.mesh_convergence --targets  # how sure each onset is, and has to be

The data are the results kept in ``results/reference``; what is kept on another mesh later is taken
in. The claims (:mod:`equisection.paper.claims_page`) are judged by the table that this writes.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from equisection.clone import CLONE
from equisection.errors import EquisectionError
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.files import write_text
from equisection.generated import write_outdated
from equisection.paper.mesh_convergence import convergence_figure
from equisection.paper.mesh_convergence.convergence_page import page
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    MESHES,
    mesh_releases,
    rigid_loads,
)
from equisection.paper.mesh_convergence.loads_by_mesh import (
    iteration_series,
    load_series,
    mean_series,
    modal_series,
    ratio_series,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, as_table
from equisection.paper.mesh_convergence.onset_by_difference import onsets_by_difference
from equisection.paper.mesh_convergence.onset_by_direction import (
    MESHES_BY_DIRECTION,
    ReleasesByDirection,
    onset_by_direction,
)
from equisection.paper.mesh_convergence.onset_by_mesh import (
    early_growth_of_plate,
    growth_series,
    onsets_by_releases,
    own_factors,
    plate_of_table_1,
    plates_by_model,
    sections_by_model,
)
from equisection.paper.mesh_convergence.onset_by_mesher import (
    onsets_of_both_meshers,
    plate_around_outline,
    section_around_outline,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    AROUND_OUTLINE,
    change_of_shift,
    curve_from_equilibrium,
    growth_from_equilibrium,
    learnt_from_equilibrium,
    onsets_from_equilibrium,
    sections_from_equilibrium,
)
from equisection.paper.mesh_convergence.onset_targets import targets
from equisection.paper.printed_values import PAPER_ONSET

COMMAND = "python -m equisection.paper.mesh_convergence"
PAGE = Path("docs/mesh-convergence.md")
FIGURE = Path("docs/onset-over-cell-size.png")
TABLE = Path("results/paper-convergence/mesh_convergence.csv")
STYLE = CLONE / "envs" / "equisection.mplstyle"


def all_series(reference: Path) -> tuple[list[MeshSeries], str]:
    """Return every series of what is kept, and the mesh that the own ratios are of."""
    releases = mesh_releases(reference)
    at_equilibrium = mesh_releases(
        reference, FROM_EQUILIBRIUM, MESHES_BY_DIRECTION, with_outlines=True
    )
    around_outline = [one for one in at_equilibrium if one.is_around_outline]
    on_blocks = [one for one in at_equilibrium if not one.is_around_outline]
    from_equilibrium = [one for one in on_blocks if one.mesh in MESHES]
    section, plate = (rigid_loads(reference, dimension) for dimension in ("2d", "3d"))
    own, own_mesh = own_factors(section, plate)
    change = change_of_shift(releases)
    of_sections = [
        *onsets_by_releases(releases),
        *sections_from_equilibrium(from_equilibrium, releases),
        *section_around_outline(around_outline, change),
        *sections_by_model(releases, section, plate_of_table_1(CLONE), own),
    ]
    of_sections += onsets_of_both_meshers(of_sections)
    directions, around = map(ReleasesByDirection.of, (on_blocks, around_outline))
    curve = curve_from_equilibrium(from_equilibrium, releases)
    of_plate = [*plates_by_model(releases, plate)]
    of_plate += onsets_from_equilibrium(from_equilibrium, releases)
    of_plate += onset_by_direction(directions.growths(), of_plate, curve, change)
    of_plate += plate_around_outline(around, directions, curve, change)
    of_plate += onsets_of_both_meshers(of_plate)
    series = [
        *of_sections,
        *onsets_by_difference(of_sections),
        *of_plate,
        *learnt_from_equilibrium(from_equilibrium, plate),
        *growth_series(releases),
        *growth_from_equilibrium(from_equilibrium, "2d"),
        *growth_from_equilibrium(around_outline, "2d"),
        *growth_from_equilibrium(from_equilibrium),
        *directions.series(),
        *(replace(one, basis=one.basis + AROUND_OUTLINE) for one in around.series()),
        early_growth_of_plate(releases),
        *mean_series(releases),
        *load_series(section, "2d", reference),
        *load_series(plate, "3d", reference),
        *ratio_series(section, plate),
        *modal_series(releases),
        *iteration_series(releases),
    ]
    return series, own_mesh


def main(arguments: Sequence[str] | None = None) -> int:
    """Write or check the page; return the exit status."""
    parser = argparse.ArgumentParser(prog=COMMAND, description="Onset over the cell size.")
    parser.add_argument("--reference", type=Path, default=Path("results/reference"))
    parser.add_argument("--page", type=Path, default=PAGE)
    parser.add_argument("--figure", type=Path, default=FIGURE)
    parser.add_argument("--table", type=Path, default=TABLE)
    parser.add_argument("--check", action="store_true", help="only tell whether it is up to date")
    parser.add_argument("--targets", action="store_true", help="print how sure each onset is, only")
    options = parser.parse_args(arguments)
    try:
        series, own_mesh = all_series(options.reference)
    except EquisectionError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    table = as_table(series)
    if options.targets:
        print(targets(table).to_csv(index=False, float_format="%.3g"), end="")
        return 0
    write_text(options.table, table.to_csv(index=False, float_format="%.6g"))
    if not options.check:
        with drawing_style(STYLE):
            save_figure(convergence_figure.draw(series, PAPER_ONSET), [options.figure])
    text = page(series, own_mesh)
    return write_outdated({options.page: text}, Path(), "make paper", check=options.check)


if __name__ == "__main__":
    sys.exit(main())
