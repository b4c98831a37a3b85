"""The names of the package itself: all there, typed, and without cost until they are used."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import equisection

HEAVY = {"numpy", "scipy", "xarray", "pandas", "pydantic", "yaml", "netCDF4", "skfem"}


def modules_after(code: str) -> set[str]:
    """Return the top-level modules that a fresh interpreter has loaded after some code."""
    said = subprocess.run(
        [sys.executable, "-c", f"import sys; {code}; print(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return {name.partition(".")[0] for name in said.split()}


def test_importing_the_package_loads_no_numerics() -> None:
    assert not modules_after("import equisection; dir(equisection)") & HEAVY


def test_a_name_loads_what_it_needs_and_no_more() -> None:
    loaded = modules_after("import equisection; equisection.Polar")
    assert {"numpy", "scipy"} <= loaded
    assert not loaded & {"xarray", "pandas", "skfem", "netCDF4"}


def test_every_public_name_is_there_once_it_is_asked_for() -> None:
    assert set(equisection.__all__) <= set(dir(equisection))
    for name in set(equisection.__all__) - {"__version__"}:
        value = getattr(equisection, name)
        assert value.__name__ == name
        assert value.__doc__


def test_type_checkers_see_the_names_that_python_does() -> None:
    tree = ast.parse(Path(equisection.__file__).read_text(encoding="utf-8"))
    (guarded,) = [node for node in tree.body if isinstance(node, ast.If)]
    typed = {
        (alias.name, node.module)
        for node in guarded.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    found = {(name, f"equisection.{place}") for name, place in equisection._PLACES.items()}
    assert typed == found
    assert {name for name, _ in found} | {"__version__"} == set(equisection.__all__)


def test_a_name_that_is_not_public_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'Plate'"):
        _ = equisection.Plate
    with pytest.raises(ImportError):
        from equisection import nothing  # noqa: F401, PLC0415
