"""What Snakemake costs with a thousand k* beside ten: nothing to compute, only a plan."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured
from tests.workflow.project import Project, has_nothing_to_do, small

TIMES = 3  # a thousand k* may cost as much as three times ten
ALL_MODELS = ["2d", "2d-corrected", "3d", "2d-paper", "2d-corrected-paper"]


def rows() -> Iterator[Row]:
    """Dry runs of fresh projects with all models, then reruns of finished ones with `2d`."""
    with TemporaryDirectory() as folder:
        few, many = (
            _project(Path(folder) / f"fresh{number}", number, ALL_MODELS) for number in (10, 1000)
        )
        yield from _compared("dry run", _seconds(few, "--dry-run"), _seconds(many, "--dry-run"))
        few, many = (
            _project(Path(folder) / f"done{number}", number, ["2d"]) for number in (10, 1000)
        )
        first = [_seconds(each, _summary(each)) for each in (few, many)]
        yield Row("summary of 10 and 1,000 k* of 2d", f"{first[0]:.3g} s, {first[1]:.3g} s")
        again = [_seconds(each, _summary(each), nothing_to_do=True) for each in (few, many)]
        yield from _compared("rerun with nothing to do", *again)


def _project(folder: Path, number: int, models: list[str]) -> Project:
    sweep = {"k_star": {"start": 4.0, "stop": 21.0, "number": number}, "models": models}
    return Project.fresh(folder, small(sweep=sweep, unsteady={"duration": 60.0}))


def _summary(project: Project) -> str:
    return project.target("comparison/summary.csv")


def _seconds(project: Project, *arguments: str, nothing_to_do: bool = False) -> float:
    cost = measured(project.command(*arguments), project.folder, project.environment())
    if nothing_to_do and not has_nothing_to_do(cost.output):
        raise RuntimeError(f"there was something to do:\n{cost.output}")
    return cost.seconds


def _compared(what: str, few: float, many: float) -> Iterator[Row]:
    yield Row(f"{what}, 10 and 1,000 k*", f"{few:.3g} s, {many:.3g} s")
    yield limit(f"{what}, 1,000 k* over 10", many / few, TIMES, "times")
