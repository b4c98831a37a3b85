"""Report of every example on the embedded solver, over a shortened sweep."""

import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, measured
from tests.conftest import ROOT
from tests.workflow.test_examples import ALL

TESTS = "tests/workflow/test_examples.py"


def rows() -> Iterator[Row]:
    """Make the reports and test them; a row for those that are whole."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"{ROOT / TESTS}"]
    with TemporaryDirectory() as folder:
        script = Path(folder) / "run.sh"
        script.write_text(f'cd "{ROOT}" && "$@" || true\n', encoding="utf-8")
        environment = {**os.environ, ALL: "all"}
        cost = measured(["sh", str(script), *command], Path(folder), environment)
    said = cost.output.strip().splitlines()[-1]
    passed, failed = (
        int(found[1]) if (found := re.search(rf"(\d+) {word}", said)) else 0
        for word in ("passed", "(?:failed|error)")
    )
    yield Row(
        "reports of the examples that are whole",
        f"{passed} of {passed + failed}",
        "all",
        not failed,
    )
    yield Row("processor time of all of them", f"{cost.processor_seconds:.0f} s")
