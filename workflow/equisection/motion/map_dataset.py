"""Stability over incidence and speed as a data set, and the critical speed at each incidence."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.critical import Critical, critical_of
from equisection.motion.equilibrium_path import SectionPath, systems_of_sections
from equisection.motion.mechanism import least_stable_instabilities
from equisection.motion.stability_map import MapLine, map_lines
from equisection.motion.static_branch import BranchEnd

Floats = NDArray[np.float64]


def map_of_body(
    body: BodyInFlow,
    incidences_deg: Sequence[float],
    speeds: Sequence[float],
    highest: float | None = None,
) -> xr.Dataset:
    """Return stability over incidence and speed of a body, with its critical speeds.

    Parameters
    ----------
    body
        A section or a beam in its air.
    incidences_deg
        Rigid incidences theta_0 (deg), rising.
    speeds
        Speeds (m/s), rising.
    highest
        Speed (m/s) up to which an onset is looked for; by default the last one.

    Returns
    -------
    xarray.Dataset
        Over ``incidence_deg`` and ``speed`` (:data:`MEANING` has all variables with their units);
        ``mode_*`` are over ``mode`` too.
    """
    asked = np.asarray(speeds, dtype=np.float64)
    looked = asked
    if highest is not None and highest > asked[-1]:
        looked = np.append(asked, highest)
    lines = map_lines(body, [math.radians(angle) for angle in incidences_deg], looked)
    return (
        map_of_lines(lines, asked).assign_coords(incidence_deg=list(incidences_deg)).pipe(described)
    )


def map_of_lines(lines: Sequence[MapLine], asked: Floats) -> xr.Dataset:
    """Return the data set of a body at some incidences, at speeds (m/s) that were looked at."""
    body, highest = lines[0].body, lines[0].highest
    names = next((line.modes.names for line in lines if line.exists), ())
    shape = (len(lines), asked.size)
    values = {name: np.full(shape, np.nan) for name in _OVER_BOTH}
    of_modes = {name: np.full((*shape, len(names)), np.nan) for name in _OVER_MODES}
    for row, line in enumerate(lines):
        _fill(line, asked, {name: each[row] for name, each in values.items()})
        _fill_modes(line, asked, {name: each[row] for name, each in of_modes.items()})
    mechanism = _mechanisms(lines, asked, values["growth_rate"])
    critical = [critical_of(line) for line in lines]
    dataset = xr.Dataset(
        {
            **{name: (("incidence_deg", "speed"), each) for name, each in values.items()},
            "mechanism": (("incidence_deg", "speed"), mechanism),
            **{name: (("incidence_deg", "speed", "mode"), each) for name, each in of_modes.items()},
            **{
                field.name: (
                    "incidence_deg",
                    np.array([getattr(one, field.name) for one in critical]),
                )
                for field in fields(Critical)
            },
            **_motions(lines),
            "k_star": ("speed", body.k_star_at(asked)),
        },
        {
            "incidence_deg": [round(math.degrees(line.incidence_rad), 9) for line in lines],
            "speed": asked,
            "mode": list(names),
            "strip": np.arange(1, body.structure.strips + 1),
        },
        attrs={
            "equilibrium": "on the branch that comes from rest",
            "polar": body.loads.branches.polar.label,
            "lags": body.loads.lags.provenance,
            "basis": "eigenvalue",
            "highest_speed": highest,
        },
    )
    return described(dataset)


def _motions(lines: Sequence[MapLine]) -> dict[str, Any]:
    """Motion at the onset along the span, over the amplitude of the tip's twist, strip by strip."""
    structure = lines[0].body.structure
    shape = (len(lines), structure.strips)
    twist, deflection = np.full((2, *shape), np.nan, dtype=np.complex128)
    for row, line in enumerate(lines):
        if line.onset is None:
            continue
        _, vector = line.mode_at(line.place(line.onset.speed))
        tip, _ = line.body.tip(vector)
        torsion = line.body.twist_of_tip.size
        bending = line.body.deflection_of_tip.size
        on_modes = vector[2 * torsion : 2 * torsion + bending]
        # a section moves as its tip does
        scale = line.body.deflection_of_tip[0] if line.body.is_section else 1.0
        turn = line.body.twist_of_tip[0] if line.body.is_section else 1.0
        twist[row] = turn * (structure.torsion_shapes @ vector[:torsion]) / tip
        deflection[row] = scale * (structure.bending_shapes @ on_modes) / tip
    over = ("incidence_deg", "strip")
    parts = {
        f"onset_{name}_{part}": (over, getattr(values, part))
        for name, values in (("twist", twist), ("deflection", deflection))
        for part in ("real", "imag")
    }
    return {**parts, "strip_place": ("strip", structure.middles)}


def maps_of_models(maps: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """Return the maps of some models, by their names, as one over ``model``, not yet described.

    Modes that not all of them have are NaN in the others. A join sorts names, 10 before 2: the
    modes stay in the order of the model that has most of them.
    """
    modes = [data["mode"].values for data in maps.values()]
    order = dict.fromkeys(itertools.chain(*sorted(modes, key=len, reverse=True)))
    return xr.concat(
        list(maps.values()),
        pd.Index(list(maps), name="model"),
        data_vars="all",
        coords="minimal",
        join="outer",
        compat="override",
        combine_attrs="override",
    ).sel(mode=list(order))


def described(dataset: xr.Dataset) -> xr.Dataset:
    """Put units and meaning on the variables of a map, whose texts become plain ones."""
    texts = {
        name: (variable.dims, _plain(variable.values))
        for name, variable in dataset.variables.items()
        if variable.dtype.kind not in "fiu"
    }
    dataset = dataset.assign({name: text for name, text in texts.items() if name in dataset})
    for name, variable in dataset.variables.items():
        units, long_name = MEANING[str(name)]
        variable.attrs = {"units": units, "long_name": long_name}
        if variable.dtype.kind == "f" and name not in dataset.coords:
            variable.attrs["missing_allowed"] = "1"
    return dataset


def _plain(values: NDArray[Any]) -> NDArray[np.object_]:
    """Return texts of any type as those of the language, which NetCDF takes."""
    return np.array([str(one) for one in values.ravel()], dtype=object).reshape(values.shape)


_OVER_BOTH = ("growth_rate", "frequency", "equilibrium_twist", "equilibrium_deflection")
_OVER_MODES = ("mode_growth_rate", "mode_frequency", "mode_damping")


def _fill(line: MapLine, speeds: Floats, values: dict[str, Floats]) -> None:
    """Fill in the least stable motion and the equilibrium at each speed that has one."""
    spectrum = line.modes.spectrum
    there = np.isin(speeds, spectrum.speed)
    places = np.searchsorted(spectrum.speed, speeds[there])
    rate = speeds[there] / line.body.chord
    least = line.least_stable[places]
    twist, deflection = line.body.tip(spectrum.states[places])
    values["growth_rate"][there] = least.real * rate
    values["frequency"][there] = least.imag * rate / math.tau
    values["equilibrium_twist"][there] = twist
    values["equilibrium_deflection"][there] = deflection * line.body.chord


def _fill_modes(line: MapLine, speeds: Floats, values: dict[str, Floats]) -> None:
    if not line.exists:
        return
    spectrum = line.modes.spectrum
    there = np.isin(speeds, spectrum.speed)
    found = line.modes.values[np.searchsorted(spectrum.speed, speeds[there])]
    rate = (speeds[there] / line.body.chord)[:, None]
    values["mode_growth_rate"][there] = found.real * rate
    values["mode_frequency"][there] = found.imag * rate / math.tau
    values["mode_damping"][there] = -found.real / np.abs(found)


def _mechanisms(lines: Sequence[MapLine], speeds: Floats, growth: Floats) -> NDArray[np.str_]:
    """Mechanism at each incidence and speed; that of the end of its branch beyond it."""
    found = np.full(growth.shape, "none", dtype=object)
    for row, line in enumerate(lines):
        lost = np.isnan(growth[row])
        found[row, lost] = "divergence" if line.path.end is BranchEnd.FOLD else "unknown"
    grows = growth > 0.0
    rows = np.flatnonzero(grows.any(axis=1))
    exact = [lines[int(row)].path for row in rows]
    if rows.size and all(isinstance(path, SectionPath) for path in exact):
        sections = [path for path in exact if isinstance(path, SectionPath)]
        system = systems_of_sections(sections, [speeds[grows[row]] for row in rows])
        found[grows] = least_stable_instabilities(*system)[1].mechanism
        return found.astype(np.str_)
    for row in map(int, rows):
        system = lines[row].path.system(speeds[grows[row]])
        found[row, grows[row]] = least_stable_instabilities(*system)[1].mechanism
    return found.astype(np.str_)


#: Units and meaning of coordinates and variables.
MEANING: dict[str, tuple[str, str]] = {
    "model": ("1", "model of the sweep"),
    "incidence_deg": ("deg", "rigid incidence theta_0, nose up"),
    "speed": ("m s-1", "speed V of the flow"),
    "mode": ("1", "mode, by its name in still air"),
    "growth_rate": ("s-1", "growth rate of the least stable motion"),
    "frequency": ("Hz", "frequency of the least stable motion"),
    "mechanism": (
        "1",
        "none, divergence, flutter, stall-flutter, galloping, or unknown without an equilibrium",
    ),
    "equilibrium_twist": ("rad", "twist of the tip in static equilibrium, nose up"),
    "equilibrium_deflection": ("m", "deflection of the tip in static equilibrium, up"),
    "mode_growth_rate": ("s-1", "growth rate of a mode"),
    "mode_frequency": ("Hz", "frequency of a mode"),
    "mode_damping": ("1", "damping ratio of a mode"),
    "k_star": ("1", "k* = k_theta/(q c^2)"),
    "strip": ("1", "number of a strip of the span; a section is one"),
    "strip_place": ("1", "middle of a strip z/L"),
    "onset_twist_real": ("1", "twist in the motion at the onset over that of the tip, real part"),
    "onset_twist_imag": ("1", "twist in the motion at the onset over that of the tip, imaginary"),
    "onset_deflection_real": ("1", "deflection in chords over the tip's twist, real part"),
    "onset_deflection_imag": ("1", "deflection in chords over the tip's twist, imaginary"),
    "critical_speed": ("m s-1", "lowest speed at which a motion ceases to decay"),
    "speed_low": ("m s-1", "highest speed up to which it is known to be stable"),
    "speed_high": ("m s-1", "lowest speed at which it is known to be unstable"),
    "critical_mechanism": ("1", "mechanism of the instability"),
    "critical_mode": ("1", "mode that loses its stability"),
    "critical_frequency": ("Hz", "frequency at the onset"),
    "critical_k_star": ("1", "k* at the onset"),
    "critical_twist": ("rad", "twist of the tip in static equilibrium at the onset"),
    "critical_deflection": ("m", "deflection of the tip in static equilibrium at the onset"),
    "divergence_speed": ("m s-1", "speed of the fold or of the first positive real eigenvalue"),
    "growth_slope": ("m-1", "rise of the growth rate with the speed at the onset"),
    "tip_ratio": ("1", "deflection in chords over twist of the tip in the motion at the onset"),
    "tip_phase": ("deg", "phase by which the deflection leads the twist at the onset"),
    "heave_share": ("1", "share of heave alone in the power of the air at the onset"),
    "twist_share": ("1", "share of twist alone in the power of the air at the onset"),
    "coupling_share": ("1", "share of their coupling in the power of the air at the onset"),
    "unstable_to": ("m s-1", "speed above which it is stable again"),
    "note": ("1", "reservations in words"),
}
