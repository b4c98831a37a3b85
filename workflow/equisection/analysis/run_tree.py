"""Everything that a run leaves behind, as one tree of data sets."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
import yaml

from equisection.errors import ConfigError, ResultFileError
from equisection.keys.config_file import read_config_file
from equisection.keys.shown import shown
from equisection.keys.values import NAME_PATTERN
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import VERDICT_ATTRIBUTES, VERDICT_UNITS
from equisection.store.index import read_index, result_file
from equisection.store.made_from import recorded, require_as_made
from equisection.study.axes import SPEED, onset_axis_among

CONFIGURATION = "config.resolved.yaml"
SUMMARY = Path("comparison") / "summary.csv"
#: Files of a run by their places in the tree; a run need not have all of them.
DATASETS = {
    "structure/modes": "structure/modes.nc",
    "structure/mesh_study": "structure/mesh_study.nc",
    "structure/equivalent": "structure/equivalent.nc",
    "steady/polar_2d": "steady/polar_2d.nc",
    "steady/polar_3d": "steady/polar_3d.nc",
    "steady/correction": "steady/correction.nc",
    "steady/section_mesh": "steady/section_mesh.nc",
    "steady/plate_mesh": "steady/plate_mesh.nc",
}
#: Folders whose CSV files become data sets over their rows.
TABLES = ("comparison", "tables", "identification")
#: Digits of convective time (c/V) that tell two samples apart.
TIME_DIGITS = 6
#: Relative difference of two k* that are the same: their names have six digits.
_SAME = 1e-5

_AXES = {
    "model": ("1", "model of the sweep"),
    "k_star": ("1", "k* = k_theta/(q c^2)"),
    "incidence_deg": ("deg", "rigid incidence theta_0, nose up"),
    "time": ("c/V", "convective time t V/c"),
}
#: Units of columns, by how their names end; the first that fits.
_UNITS_OF_COLUMNS = (
    ("_deg", "deg"),
    ("_hz", "Hz"),
    ("_seconds", "s"),
    ("_chords", "c"),
    ("growth_rate", "V/c"),
    ("growth", "V/c"),
    ("end_time", "c/V"),
    ("speed", "m s-1"),
    ("speed_stable", "m s-1"),
    ("speed_unstable", "m s-1"),
    ("speed_low", "m s-1"),
    ("speed_high", "m s-1"),
)


def open_run(folder: Path | str) -> xr.DataTree:
    """Read a run's results into memory, as one tree.

    Nodes are ``histories`` over ``model``, ``k_star``, ``incidence_deg`` and ``time``, with the
    verdict of each case over the first three; of a sweep over the speed they are found by ``speed``
    (m/s) as well. Others are ``structure``, ``steady``, and a data set for each
    table of ``comparison`` and ``tables``. A part that the run does not have is absent. Histories
    are NaN where a case has no sample: after its end, and between samples where another case has
    more of them. Fields of single cases (surfaces, the flow at the tip) stay in their files.

    Parameters
    ----------
    folder
        ``results/<run>``.

    Raises
    ------
    ResultFileError
        The folder is no run, a file in it is broken, or a table or an index was edited.
    """
    folder = Path(folder)
    configuration = configuration_of(folder)
    nodes = {
        f"/{node}": read_dataset(folder / file)
        for node, file in DATASETS.items()
        if (folder / file).exists()
    }
    made = recorded(folder)
    indices = sorted((folder / "unsteady").glob("*/*.json"))
    for index in indices:
        require_as_made(folder, index, made)
    histories = _histories(folder, indices, float(configuration["flow"]["incidence_deg"]))
    if histories is not None:
        nodes["/histories"] = histories
    for kind in TABLES:
        for path in sorted((folder / kind).glob("*.csv")):
            require_as_made(folder, path, made)
            nodes[f"/{kind}/{path.stem}"] = _table(path)
    root = xr.Dataset(
        attrs={"run": str(configuration["run"]), "configuration": yaml.safe_dump(configuration)}
    )
    return xr.DataTree.from_dict({"/": root, **nodes}, name=str(configuration["run"]))


def configuration_of(folder: Path) -> dict[str, Any]:
    """Return the configuration of a run, by which a folder is known as one.

    Raises
    ------
    ResultFileError
        The folder has none, or one that cannot be read.
    """
    path = folder / CONFIGURATION
    if not path.exists():
        raise ResultFileError(
            f"{folder}: no folder of a run, which has a {CONFIGURATION} (looked from "
            f"{Path.cwd()}); give results/<run>"
        )
    try:
        read = read_config_file(path)
        name, incidence = read["run"], read["flow"]["incidence_deg"]
        if not isinstance(name, str) or not re.fullmatch(NAME_PATTERN, name):
            raise ConfigError(f"{path}: run: {shown(name)}: no name of a run")
        if isinstance(incidence, bool) or not isinstance(incidence, int | float):
            raise ConfigError(f"{path}: flow.incidence_deg: {shown(incidence)}: no number")
    except (ConfigError, KeyError, TypeError) as error:
        lines = [line.removeprefix("config: ") for line in str(error).split("\n")]
        reason = lines[0].removeprefix(f"{path}: ")
        if not isinstance(error, ConfigError):
            reason = "it lacks 'run' or 'flow.incidence_deg'"
        raise ResultFileError(
            f"{path}: cannot be read as the configuration of a run ({reason}); delete it and run "
            "again"
        ) from None
    return dict(read)


@dataclass(frozen=True)
class _Case:
    """One result: where it is, at which place of the axes, and what its index says of it."""

    path: Path
    place: tuple[str, float, float]
    attributes: Mapping[str, Any]


def _cases(indices: Iterable[Path], incidence_deg: float) -> Iterator[_Case]:
    for index in indices:
        for name, attributes in read_index(index).items():
            try:
                place = (index.parent.name, float(attributes["k_star"]), _incidence(attributes))
            except (KeyError, TypeError, ValueError) as error:
                raise ResultFileError(
                    f"{index}: case {name} has no k_star or no incidence ({error!r}); delete it "
                    "and run again"
                ) from None
            if math.isnan(place[2]):  # an index from before it was said there
                place = (*place[:2], incidence_deg)
            yield _Case(result_file(index, name), place, attributes)


def _incidence(attributes: Mapping[str, Any]) -> float:
    """Return the rigid incidence (deg) of a case; NaN where its result does not hold it."""
    if "incidence_deg" in attributes:
        return float(attributes["incidence_deg"])
    case = attributes.get("case")
    return float(json.loads(case)["incidence_deg"]) if case else math.nan


def _histories(folder: Path, indices: Iterable[Path], incidence_deg: float) -> xr.Dataset | None:
    """Return the histories of all cases on common axes; None of a run without any."""
    cases = list(_cases(indices, incidence_deg))
    if not cases:
        return None
    read = [_of_time(read_dataset(case.path)) for case in cases]
    axes = [np.unique(np.array([case.place[axis] for case in cases])) for axis in range(3)]
    axes.append(np.unique(np.concatenate([data["time"].values for data in read])))
    dataset = xr.Dataset(
        coords={name: (name, values) for name, values in zip(_AXES, axes, strict=True)}
    )
    for name, like in _variables(read).items():
        others = [dimension for dimension in like.dims if dimension != "time"]
        sizes = [max(data.sizes.get(str(dimension), 0) for data in read) for dimension in others]
        values = np.full([*map(len, axes), *sizes], np.nan)
        for case, data in zip(cases, read, strict=True):
            if name in data:
                place = _place(axes, case.place)
                found = data[name].transpose("time", *others)
                at = np.searchsorted(axes[3], data["time"].values)
                part = values[place]
                part[(at, *(slice(size) for size in found.shape[1:]))] = found.values
        dataset[name] = ((*_AXES, *others), values, {**like.attrs, "missing_allowed": "1"})
    _add_verdicts(dataset, cases, axes)
    for name, (units, long_name) in _AXES.items():
        dataset[name].attrs = {"units": units, "long_name": long_name}
    speeds = _speeds(folder, axes[1])
    if speeds is None:
        return dataset
    about = {"units": "m s-1", "long_name": "speed V"}
    return dataset.assign_coords(speed=("k_star", speeds, about)).set_xindex("speed")


def _speeds(folder: Path, k_star: Any) -> Any:
    """Return the speed (m/s) at each k*; None unless the sweep is one over the speed."""
    if not (folder / SUMMARY).is_file():
        return None
    summary = _table(folder / SUMMARY)
    names = [str(name) for name in summary.data_vars]
    if not {"speed", "k_star"} <= set(names) or onset_axis_among(names) is not SPEED:
        return None  # speeds of a sweep over k* are those of the beam as given, and of no run
    given, known = summary["speed"].values, summary["k_star"].values
    found = [np.unique(given[np.isclose(known, value, rtol=_SAME)]) for value in k_star]
    if any(one.size != 1 for one in found):
        return None
    speeds = np.concatenate(found)
    return speeds if np.unique(speeds).size == speeds.size else None


def _of_time(data: xr.Dataset) -> xr.Dataset:
    """Return what a result has over time, at times that compare."""
    names = [name for name, variable in data.data_vars.items() if "time" in variable.dims]
    return data[names].assign_coords(time=np.round(data["time"].values, TIME_DIGITS))


def _variables(read: list[xr.Dataset]) -> dict[str, xr.DataArray]:
    return {str(name): variable for data in read for name, variable in data.data_vars.items()}


def _place(axes: list[Any], place: tuple[str, float, float]) -> tuple[int, ...]:
    return tuple(
        int(np.flatnonzero(axis == value)[0]) for axis, value in zip(axes[:3], place, strict=True)
    )


def _add_verdicts(dataset: xr.Dataset, cases: list[_Case], axes: list[Any]) -> None:
    """Add the verdicts over model, k* and incidence; empty or NaN where there is no case."""
    shape = tuple(map(len, axes[:3]))
    for name, meaning in VERDICT_ATTRIBUTES.items():
        is_text = VERDICT_UNITS[name] == ""
        values = np.full(shape, "" if is_text else math.nan, dtype=object)
        for case in cases:
            values[_place(axes, case.place)] = case.attributes.get(
                name, "" if is_text else math.nan
            )
        attributes = {"units": VERDICT_UNITS[name] or "1", "long_name": meaning}
        if not is_text:
            attributes["missing_allowed"] = "1"
        dataset[name] = (tuple(_AXES)[:3], values.astype(str if is_text else float), attributes)


def _table(path: Path) -> xr.Dataset:
    """Return a table as a data set over its rows."""
    try:
        table = pd.read_csv(path, keep_default_na=False, na_values=[""])
    except (OSError, ValueError) as error:  # what pandas cannot parse is a ValueError
        reason = " ".join(str(error).split())
        raise ResultFileError(
            f"{path}: cannot be read as a table ({reason}); delete it and run again"
        ) from None
    columns = {}
    for name in table.columns:
        values = table[name]
        is_number = pd.api.types.is_numeric_dtype(values)
        column = values.to_numpy() if is_number else values.fillna("").to_numpy().astype(str)
        attributes = {"units": _units(str(name)), "long_name": str(name).replace("_", " ")}
        if is_number:
            attributes["missing_allowed"] = "1"
        columns[str(name)] = ("row", column, attributes)
    return xr.Dataset(columns)


def _units(column: str) -> str:
    return next((units for end, units in _UNITS_OF_COLUMNS if column.endswith(end)), "1")
