"""Modes, and the mesh study of their frequencies, as data sets."""

from __future__ import annotations

import xarray as xr

from equisection.structure.mode_set import MeshStudy, ModeSet


def modes_to_dataset(modes: ModeSet, constants: list[float]) -> xr.Dataset:
    """Return ``structure/modes.nc``; ``constants`` are C_i of Eq. 23."""
    number = list(range(1, len(modes.kind) + 1))
    return xr.Dataset(
        {
            "frequency": ("mode", modes.frequency, _says("Hz", "natural frequency")),
            "kind": ("mode", list(modes.kind), _says("1", "kind of motion")),
            "shape": (
                ("mode", "span"),
                modes.shape,
                _says("1", "shape over the span, largest absolute value 1"),
            ),
            "frequency_constant": (
                "mode",
                constants,
                {**_says("1", "constant C_i of Eq. 23"), "missing_allowed": "1"},
            ),
        },
        {
            "mode": ("mode", number, _says("1", "mode number by frequency")),
            "span": ("span", modes.span, _says("1", "position along the span z/L")),
        },
        attrs={"method": modes.method, "elements": modes.elements},
    )


def modes_from_dataset(dataset: xr.Dataset) -> ModeSet:
    """Return the modes of ``structure/modes.nc``."""
    return ModeSet(
        frequency=dataset["frequency"].values,
        kind=tuple(str(kind) for kind in dataset["kind"].values),
        span=dataset["span"].values,
        shape=dataset["shape"].values,
        method=str(dataset.attrs["method"]),
        elements=str(dataset.attrs["elements"]),
    )


def mesh_study_to_dataset(study: MeshStudy, analytic: ModeSet | None) -> xr.Dataset:
    """Return ``structure/mesh_study.nc``, which has the frequencies of the analytic beam too.

    A beam with supports or lumped masses along its span has no closed form: there they are NaN.
    """
    closed_form = []
    left: dict[str, list[float]] = {}
    if analytic is not None:
        for kind, frequency in zip(analytic.kind, analytic.frequency, strict=True):
            left.setdefault(kind, []).append(float(frequency))
    for kind in study.kind:
        closed_form.append(left[kind].pop(0) if left.get(kind) else float("nan"))
    count = [chord * span * thickness for chord, span, thickness in study.elements]
    return xr.Dataset(
        {
            "frequency": (
                ("elements", "mode"),
                study.frequency,
                {**_says("Hz", "natural frequency on each mesh"), "missing_allowed": "1"},
            ),
            "kind": ("mode", list(study.kind), _says("1", "kind of motion")),
            "mesh": (
                "elements",
                [" x ".join(map(str, level)) for level in study.elements],
                _says("1", "elements along chord, span and thickness"),
            ),
            "analytic_frequency": (
                "mode",
                closed_form,
                {**_says("Hz", "natural frequency of the analytic beam"), "missing_allowed": "1"},
            ),
        },
        {
            "elements": ("elements", count, _says("1", "number of elements")),
            "mode": (
                "mode",
                list(range(1, len(study.kind) + 1)),
                _says("1", "mode number by frequency"),
            ),
        },
    )


def _says(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}
