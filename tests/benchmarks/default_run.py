"""The paper's plate from nothing, as `make run` makes it with the environment installed."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured
from tests.workflow.project import Project


def rows() -> Iterator[Row]:
    """Run the default configuration on two cores in a fresh copy of the project."""
    with TemporaryDirectory() as folder:
        project = Project.fresh(Path(folder) / "project")
        cost = measured(project.command(), project.folder, project.environment())
        yield limit("default configuration from nothing, 2 cores", cost.seconds, 60, "s")
        yield Row("processor time of it", f"{cost.processor_seconds:.3g} s")
        yield limit("peak memory of it", cost.peak_gigabytes, 2, "GB")
        cost = measured(project.command(), project.folder, project.environment())
        yield Row("the same with nothing to do", f"{cost.seconds:.3g} s")
