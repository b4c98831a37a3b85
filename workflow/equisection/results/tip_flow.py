"""The flow in planes across the stream near the tip, as data: velocity and turbulence.

Lengths are chords and velocities over that of the stream, in the frame of the channel: x along the
stream from mid-chord, y up from the plate at rest, z from the root along the span.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class TipFlow:
    """Velocity and turbulence on a regular grid in each of some planes of constant x.

    Attributes
    ----------
    x : (p,) array
        Planes, x/c from mid-chord.
    y, z : (m,), (n,) array
        Evenly spaced y/c and z/c.
    velocity : (p, m, n, 3) array
        (u, v, w)/V; NaN inside the plate and outside the channel.
    turbulence : (p, m, n) array
        Turbulent kinetic energy k/V^2; NaN as the velocity is.
    chord_line : (p, n) array
        y/c of the plate's chord line, or the middle of another body; NaN where there is none.
    span, thickness
        L/c, and the thickness of the body in the planes over the chord.
    state
        State of the plate that the flow is of, in words.
    """

    x: Floats
    y: Floats
    z: Floats
    velocity: Floats
    turbulence: Floats
    chord_line: Floats
    span: float
    thickness: float
    state: str

    def with_dataset(self, dataset: xr.Dataset) -> xr.Dataset:
        """Return a data set with these variables added, in single precision."""
        over = ("flow_x", "flow_y", "flow_z")
        data = {
            **{
                f"flow_{name}": (over, self.velocity[..., number], f"velocity {name}/V {where}")
                for number, (name, where) in enumerate(_COMPONENTS.items())
            },
            "flow_k": (over, self.turbulence, "turbulent kinetic energy k/V^2"),
            "flow_chord_line": (
                ("flow_x", "flow_z"),
                self.chord_line,
                "y/c of the chord line, missing where there is no plate",
            ),
        }
        variables = {
            name: (
                dims,
                values.astype(np.float32),
                {"units": "1", "long_name": text, "missing_allowed": "1"},
            )
            for name, (dims, values, text) in data.items()
        }
        coordinates = {
            f"flow_{name}": (f"flow_{name}", getattr(self, name), {"units": "1", "long_name": text})
            for name, text in _PLACES.items()
        }
        return (
            dataset.assign(variables)
            .assign_coords(coordinates)
            .assign_attrs(flow_span=self.span, flow_thickness=self.thickness, flow_state=self.state)
        )


_COMPONENTS = {"u": "along the stream", "v": "upwards", "w": "towards the tip"}
_PLACES = {
    "x": "x/c from mid-chord along the stream",
    "y": "y/c from the plate at rest, up",
    "z": "z/c from the root along the span",
}


def tip_flow_from_dataset(dataset: xr.Dataset) -> TipFlow | None:
    """Return the flow near the tip of a steady or unsteady result; None if it has none."""
    if "flow_k" not in dataset:
        return None
    arrays = {
        name: dataset[f"flow_{name}"].values.astype(float) for name in (*_PLACES, *"uvw", "k")
    }
    return TipFlow(
        x=arrays["x"],
        y=arrays["y"],
        z=arrays["z"],
        velocity=np.stack([arrays[name] for name in _COMPONENTS], axis=-1),
        turbulence=arrays["k"],
        chord_line=dataset["flow_chord_line"].values.astype(float),
        span=float(dataset.attrs["flow_span"]),
        thickness=float(dataset.attrs["flow_thickness"]),
        state=str(dataset.attrs["flow_state"]),
    )
