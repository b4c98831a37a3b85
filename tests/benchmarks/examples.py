"""Report of every example on the embedded solver, over a shortened sweep."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator

from tests.benchmarks.measure import Row, processor_seconds
from tests.conftest import ROOT
from tests.workflow.test_examples import ALL

TESTS = "tests/workflow/test_examples.py"


def rows() -> Iterator[Row]:
    """Make the reports and test them; a row for those that are whole."""
    before = processor_seconds()
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", TESTS],
        cwd=ROOT,
        env={**os.environ, ALL: "all"},
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    last = ran.stdout.strip().splitlines()[-1]
    passed, failed = (
        sum(int(number) for number in re.findall(rf"(\d+) {word}", last))
        for word in ("passed", "(?:failed|error)")
    )
    what = "reports of the examples that are whole"
    yield Row(what, f"{passed} of {passed + failed}", "all", ran.returncode == 0)
    yield Row("processor time of all of them", f"{processor_seconds() - before:.0f} s")
