"""Fig. 12: the flow near the tip of the rigid and of the flexible plate."""

from collections.abc import Sequence
from pathlib import Path

from equisection.figures.flow_at_tip import K_STAR, Column, column_of, draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(
    rigid: Path,
    resolution: str,
    incidence_deg: float,
    flexible: Path | None,
    *,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the rigid plate at the incidence nearest the run's, and the flexible one.

    ``rigid`` and ``flexible`` are the indices of the polar and of the sweep; there is none of the
    sweep where the beam is not run. Of the sweep the k* nearest the paper's is shown.
    """
    columns = [_of_rigid(rigid, resolution, incidence_deg), _of_flexible(flexible)]
    with drawing_style(style):
        save_figure(draw(columns), outputs)


def _of_rigid(index: Path, resolution: str, incidence_deg: float) -> Column:
    names = [name for name in read_index(index) if plan.rigid_point(name)[0] == resolution]
    if not names:
        return Column("rigid", f"The rigid plate has no result at resolution '{resolution}'.")
    name = min(names, key=lambda name: abs(plan.rigid_point(name)[1] - incidence_deg))
    return column_of("rigid", read_dataset(result_file(index, name)))


def _of_flexible(index: Path | None) -> Column:
    if index is None:
        return Column("flexible", "The flexible plate is not among the models of the sweep.")
    runs = {name: run for name, run in read_index(index).items() if not failure_of(run)}
    if not runs:
        return Column("flexible", "Every run of the flexible plate failed.")
    k_star = {name: float(run["k_star"]) for name, run in runs.items()}
    name = min(runs, key=lambda name: abs(k_star[name] - K_STAR))
    title = f"k* = {k_star[name]:g}"
    return column_of(title, read_dataset(result_file(index, name)))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.rigid),
            snakemake.params.resolution,
            snakemake.params.incidence_deg,
            Path(snakemake.input.flexible[0]) if snakemake.input.flexible else None,
            style=Path(snakemake.input.style),
            outputs=[Path(path) for path in snakemake.output],
        )
