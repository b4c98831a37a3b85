"""Run that is exported: what of its configuration every kind needs, and where its files go."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import xarray as xr

from equisection.analysis.run_tree import CONFIGURATION, configuration_of
from equisection.errors import ResultFileError
from equisection.files import write_text
from equisection.keys.shown import shown
from equisection.results.netcdf import read_dataset


@dataclass(frozen=True)
class ExportedFile:
    """File that was written, or the reason why one was not.

    Attributes
    ----------
    kind
        One of :data:`equisection.analysis.exported.KINDS`.
    path
        The file.
    holds
        Contents in words.
    left_out
        Why there is no such file; empty where there is one.
    """

    kind: str
    path: Path
    holds: str
    left_out: str = ""


@dataclass(frozen=True)
class ExportedRun:
    """Folder of a run, with its configuration and the files that every kind needs."""

    folder: Path
    to: Path

    @cached_property
    def configuration(self) -> dict[str, Any]:
        """Keys of the run, with defaults."""
        return configuration_of(self.folder)

    def value(self, *names: str) -> Any:
        """Return the value of a key, by its names from the outermost in.

        Raises
        ------
        ResultFileError
            The configuration has no such key.
        """
        value: Any = self.configuration
        for name in names:
            if not isinstance(value, dict) or name not in value:
                raise ResultFileError(
                    f"{self.folder / CONFIGURATION}: no key {'.'.join(names)}, as one of another "
                    "version or one that was edited; run again"
                )
            value = value[name]
        return value

    def number(self, *names: str) -> float:
        """Return the number of a key, by its names from the outermost in.

        Raises
        ------
        ResultFileError
            The configuration has no such key, or what it has is no finite number.
        """
        value = self.value(*names)
        if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
            raise self._edited(names, "no number")
        return float(value)

    def positive(self, *names: str) -> float:
        """Return the number of a key that nothing has at or below 0, with its errors."""
        value = self.number(*names)
        if value <= 0.0:
            raise self._edited(names, "not above 0")
        return value

    def _edited(self, names: Iterable[str], what: str) -> ResultFileError:
        return ResultFileError(
            f"{self.folder / CONFIGURATION}: {'.'.join(names)}: {shown(self.value(*names))} is "
            f"{what}, as one that was edited; run again"
        )

    @property
    def resolution(self) -> str:
        """Name of the resolution whose polar the run's sections have."""
        found = self.value("steady", "resolution")
        if not isinstance(found, str):
            raise self._edited(("steady", "resolution"), "no name")
        return found

    @property
    def speed(self) -> float:
        """V (m/s)."""
        return self.positive("flow", "speed")

    @property
    def density(self) -> float:
        """Density rho (kg/m^3)."""
        return self.positive("flow", "density")

    @property
    def reynolds_number(self) -> float:
        """Reynolds number V c/nu of the run's flow."""
        return self.speed * self.positive("beam", "chord") / self.kinematic_viscosity

    @property
    def kinematic_viscosity(self) -> float:
        """Kinematic viscosity nu = mu/rho (m^2/s)."""
        return self.positive("flow", "dynamic_viscosity") / self.density

    def read(self, file: str, needs: Iterable[str]) -> xr.Dataset | None:
        """Return a data set of the run; None where the run does not have it.

        Raises
        ------
        ResultFileError
            It is broken, or lacks a variable or an attribute of ``needs``.
        """
        path = self.folder / file
        if not path.is_file():
            return None
        data = read_dataset(path)
        lacks = [name for name in needs if name not in data and name not in data.attrs]
        if lacks:
            raise ResultFileError(
                f"{path}: has no '{lacks[0]}', as a file of another place or another version has; "
                "delete it and run again"
            )
        return data

    def wrote(self, kind: str, name: str, text: str, holds: str) -> ExportedFile:
        """Write a text file to the folder of the export."""
        path = self.to / name
        write_text(path, text)
        return ExportedFile(kind, path, holds)

    def left_out(self, kind: str, name: str, holds: str, error: ResultFileError) -> ExportedFile:
        """Return why a file is not written, and that one of an earlier export is there."""
        path = self.to / name
        earlier = "; the file that is there is of an earlier export" if path.is_file() else ""
        return ExportedFile(kind, path, holds, f"{error}{earlier}")

    def as_json(self, kind: str, name: str, content: Any, holds: str) -> ExportedFile:
        """Write a JSON file; numbers that are not finite become null."""
        text = json.dumps(_finite(content), indent=1, allow_nan=False) + "\n"
        return self.wrote(kind, name, text, holds)


def _is_finite(value: float) -> bool:
    return isinstance(value, int) or math.isfinite(value)


def _finite(content: Any) -> Any:
    """Return plain numbers, lists and dicts; None in the place of what is not finite."""
    if isinstance(content, dict):
        return {name: _finite(value) for name, value in content.items()}
    if isinstance(content, list | tuple):
        return [_finite(value) for value in content]
    if isinstance(content, float) and not math.isfinite(content):
        return None
    return content
