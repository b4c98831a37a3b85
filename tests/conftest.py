import importlib.util
import os
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import settings

from equisection.errors import SolverError
from equisection.solvers.openfoam.installation import Installation, find

ROOT = Path(__file__).parents[1]

# One thread each: the small matrices here do not gain from more, and tests run side by side.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.load_profile("repeatable")


@pytest.fixture(scope="session")
def load_script() -> Callable[[str], ModuleType]:
    """Import a script of the workflow by its path, as a library; Snakemake has no part in it."""

    def load(name: str) -> ModuleType:
        spec = importlib.util.spec_from_file_location(
            f"script_{name}", ROOT / "scripts" / f"{name}.py"
        )
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture(scope="session")
def installation() -> Installation:
    """OpenFOAM of this machine; where there is none a test is skipped, but not in CI."""
    try:
        return find()
    except SolverError as error:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip(str(error))
