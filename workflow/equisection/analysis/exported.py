"""Results of a run as files for other programs: plain CSV and JSON, and input of OpenFAST.

Each kind is one function, which writes what the run has of it; what the run has not is left out.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.generalised_forces import GeneralisedForces
from equisection.aerodynamics.polar import Polar
from equisection.analysis.exported_run import ExportedFile, ExportedRun
from equisection.analysis.learnt_file import export, is_of_strips, require_model
from equisection.beam.section import QUANTITIES, Section
from equisection.errors import DerivativesFileError, ResultFileError
from equisection.io.aerodyn_polar import aerodyn_text
from equisection.io.derivative_table import read_derivative_rows
from equisection.io.ua_driver import DriverSection, ua_driver_text
from equisection.motion.static_branch import section_in_equilibrium
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.netcdf import read_dataset
from equisection.results.polar_dataset import polar_at
from equisection.results.section_dataset import no_section, section_from_dataset
from equisection.store.made_from import recorded, require_as_made


def exported(run: Path, to: Path, kinds: Sequence[str] = ()) -> list[ExportedFile]:
    """Write what a run has for other programs; return the files.

    Parameters
    ----------
    run
        Folder of the run.
    to
        Folder to write to; files of these names are written over.
    kinds
        Some of :data:`KINDS`; all of them where none is named.

    Raises
    ------
    ResultFileError
        The folder is no run, a file in it is broken, the folder ``to`` cannot be written to, or
        the run has nothing of these kinds yet.
    """
    opened = ExportedRun(run, to)
    _ = opened.configuration
    try:
        files = [file for kind in dict.fromkeys(kinds or KINDS) for file in KINDS[kind](opened)]
    except OSError as error:
        raise ResultFileError(f"{to}: cannot be written to ({error})") from None
    if not files:
        wanted = ", ".join(kinds or KINDS)
        raise ResultFileError(
            f"{run}: nothing to export yet of {wanted}; 'equisection status {run}' says how far "
            "the run is"
        )
    return files


#: Variables and attributes that the files of a run have.
_OF_POLAR = ("resolution", "incidence_deg", "cl", "cm", "cd")
_OF_MODES = (
    *("frequency", "kind", "span", "shape", "mode", "frequency_constant", "method", "elements"),
)
_OF_EQUIVALENT = ("reduction", *QUANTITIES)


def _polars(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write each steady polar as an airfoil table of AeroDyn."""
    for dimension, whose in (("2d", "section"), ("3d", "beam")):
        data = run.read(f"steady/polar_{dimension}.nc", _OF_POLAR)
        holds = f"polar of the {whose}, airfoil table of AeroDyn"
        _ = data is None or run.reynolds_number  # a broken configuration leaves nothing out
        for resolution in [] if data is None else map(str, data["resolution"].values):
            name = f"polar_{dimension}_{resolution}.dat"
            try:
                yield run.wrote("polars", name, _table(run, data, resolution), holds)
            except ResultFileError as error:
                yield run.left_out("polars", name, holds, error)


def _table(
    run: ExportedRun, data: xr.Dataset | None, resolution: str, *, unsteady: bool = False
) -> str:
    """Return an airfoil table; the half polar of a symmetric section gets its other half.

    Raises
    ------
    ResultFileError
        Too few incidences have a result.
    """
    if data is None:
        raise ResultFileError("the run has no steady polar of the section yet")
    given = polar_at(data, resolution)
    whole = given.continued
    comments = [
        f"{given.label}.",
        f"Written by 'equisection export' from the run {run.configuration['run']}; the Reynolds "
        "number is that of its flow.",
    ]
    if whole is not given:
        comments.append("Negative angles by symmetry.")
    points = np.stack([np.degrees(whole.incidence), whole.lift, whole.moment, whole.drag], axis=1)
    return aerodyn_text(points.tolist(), run.reynolds_number, comments, unsteady=unsteady)


def _models(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write each learnt model as JSON, and its prediction as CSV."""
    found = sorted((run.folder / "rom").glob("*/model*.nc"))
    polars = run.read("steady/polar_2d.nc", _OF_POLAR) if found else None
    for path in found:
        data = read_dataset(path)
        if "rate" not in data and not data.attrs.get("refusal"):
            raise ResultFileError(f"{path}: no learnt model; delete it and run again")
        stem = path.stem.replace("model", f"model_{path.parent.name}", 1)
        for suffix, holds in (
            (".json", "learnt model: coefficients, polar, equations"),
            (".csv", "growth and frequency that the learnt model predicts"),
        ):
            output = run.to / f"{stem}{suffix}"
            try:
                require_model(data)
                polar = None
                if polars is not None and suffix == ".json" and not is_of_strips(data):
                    polar = polar_at(polars, run.resolution)
                export(data, polar, output)
            except ResultFileError as error:
                yield run.left_out("models", output.name, holds, error)
            else:
                yield ExportedFile("models", output, holds)


def _derivatives(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write tables of derivatives as they are, and as JSON with their convention."""
    for dimension, holds in (
        ("2d", "flutter derivatives of the section"),
        ("3d", "forces on the modes of the beam"),
    ):
        path = run.folder / "derivatives" / f"{dimension}.csv"
        if not path.is_file():
            continue
        require_as_made(run.folder, path, recorded(run.folder))
        read = {"2d": read_derivative_rows, "3d": GeneralisedForces.read}[dimension]
        try:
            read(path)
        except DerivativesFileError as error:
            raise ResultFileError(f"{error}; delete it and run again") from None
        text = path.read_text(encoding="utf-8")
        columns = pd.read_csv(io.StringIO(text), comment="#").to_dict("list")
        said = [line.lstrip("# ") for line in text.splitlines() if line.startswith("#")]
        name = f"derivatives_{dimension}"
        yield run.wrote("derivatives", f"{name}.csv", text, holds)
        content = {"convention": said, "columns": columns}
        yield run.as_json("derivatives", f"{name}.json", content, holds)


def _modes(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write the modes of the beam: frequencies and shapes."""
    data = run.read("structure/modes.nc", _OF_MODES)
    if data is None:
        return
    modes = modes_from_dataset(data)
    numbers = [int(number) for number in data["mode"].values]
    table = pd.DataFrame(
        {
            "mode": numbers,
            "kind": modes.kind,
            "frequency_hz": modes.frequency,
            "frequency_constant": data["frequency_constant"].values,
        }
    )
    shapes = pd.DataFrame(modes.shape.T, columns=[f"mode_{number}" for number in numbers])
    shapes.insert(0, "span", modes.span)
    yield run.wrote("modes", "modes.csv", _csv(table), "natural frequencies (Hz)")
    yield run.wrote("modes", "mode_shapes.csv", _csv(shapes), "mode shapes over z/L, largest 1")
    content = {
        "method": modes.method,
        "elements": modes.elements,
        "span": modes.span.tolist(),
        "modes": [
            {**row, "shape": shape.tolist()}
            for row, shape in zip(table.to_dict("records"), modes.shape, strict=True)
        ],
    }
    yield run.as_json("modes", "modes.json", content, "frequencies (Hz) and shapes over z/L")


def _sections(run: ExportedRun) -> dict[str, Section]:
    """Return the equivalent section of each reduction that has one."""
    data = run.read("structure/equivalent.nc", _OF_EQUIVALENT)
    if data is None:
        return {}
    reductions = map(str, data["reduction"].values)
    return {
        name: section_from_dataset(data, name) for name in reductions if not no_section(data, name)
    }


def _section(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write the equivalent section of each reduction, SI per metre of span."""
    sections = _sections(run)
    if not sections:
        return
    table = pd.DataFrame(
        [
            {
                "quantity": name,
                "unit": quantity.units,
                **{reduction: getattr(one, name) for reduction, one in sections.items()},
                "meaning": quantity.meaning,
            }
            for name, quantity in QUANTITIES.items()
        ]
    )
    holds = "equivalent section, SI units per metre of span"
    yield run.wrote("section", "section.csv", _csv(table), holds)
    content = {
        "units": {name: quantity.units for name, quantity in QUANTITIES.items()},
        "reductions": {
            name: {member: getattr(one, member) for member in QUANTITIES}
            for name, one in sections.items()
        },
    }
    yield run.as_json("section", "section.json", content, holds)


#: Airfoil table that the input of the driver names.
_AIRFOIL = "ua_airfoil.dat"


def _openfast(run: ExportedRun) -> Iterator[ExportedFile]:
    """Write the section as input of OpenFAST's unsteady-aerodynamics driver, with its airfoil."""
    sections = _sections(run)
    if not sections:
        return
    kind, holds = "openfast", "airfoil table of the driver"
    _ = run.reynolds_number, run.resolution
    try:
        data = run.read("steady/polar_2d.nc", _OF_POLAR)
        table = _table(run, data, run.resolution, unsteady=True)
    except ResultFileError as error:
        yield run.left_out(kind, _AIRFOIL, holds, error)
        return
    yield run.wrote(kind, _AIRFOIL, table, holds)
    assert data is not None, "without it there is no table"
    polar = polar_at(data, run.resolution).continued
    for reduction, section in sections.items():
        title = f"{run.configuration['run']}: equivalent section, {reduction} reduction"
        text = ua_driver_text(_driver_section(run, section, polar), title)
        holds = f"section of the {reduction} reduction, UnsteadyAero_Driver"
        yield run.wrote(kind, f"ua_{reduction}.dvr", text, holds)


def _driver_section(run: ExportedRun, section: Section, polar: Polar) -> DriverSection:
    """Return the section with the start of the run; undeformed where it has no equilibrium."""
    incidence_deg = run.number("flow", "incidence_deg")
    twist, deflection = 0.0, 0.0
    if run.value("unsteady", "start", "state") == "equilibrium":
        flowing = section.in_flow(run.density, run.speed)
        found = section_in_equilibrium(flowing, polar, math.radians(incidence_deg))
        twist, deflection = found or (twist, deflection)
    convective = section.chord / run.speed
    pushed = math.radians(run.number("unsteady", "start", "twist_deg"))
    rate = run.number("unsteady", "start", "heave_rate") * run.speed
    return DriverSection(
        airfoil=_AIRFOIL,
        chord=section.chord,
        elastic_axis=section.elastic_axis,
        mass=section.mass_matrix.tolist(),
        damping=section.damping_matrix.tolist(),
        stiffness=section.stiffness_matrix.tolist(),
        incidence_deg=incidence_deg,
        twist=twist + pushed * section.twist_recovery,
        deflection=deflection * section.chord,
        heave_rate=rate * section.deflection_recovery,
        density=run.density,
        kinematic_viscosity=run.kinematic_viscosity,
        sound_speed=run.positive("flow", "sound_speed"),
        speed=run.speed,
        duration=run.positive("unsteady", "duration") * convective,
        time_step=run.positive("unsteady", "time_step") * convective,
    )


def _csv(table: pd.DataFrame) -> str:
    return str(table.to_csv(index=False, float_format="%.10g"))


#: Kinds of exports, in the order in which they are written.
KINDS: dict[str, Callable[[ExportedRun], Iterator[ExportedFile]]] = {
    "polars": _polars,
    "models": _models,
    "derivatives": _derivatives,
    "modes": _modes,
    "section": _section,
    "openfast": _openfast,
}
