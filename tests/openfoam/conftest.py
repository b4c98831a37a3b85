import os
from pathlib import Path

import pytest

from equisection.errors import SolverError
from equisection.solvers.openfoam.installation import Installation, find


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Every test of this folder needs OpenFOAM."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents:
            item.add_marker(pytest.mark.openfoam)


@pytest.fixture(scope="session")
def installation() -> Installation:
    """OpenFOAM of this machine; where there is none a test is skipped, but not in CI."""
    try:
        return find()
    except SolverError as error:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip(str(error))
