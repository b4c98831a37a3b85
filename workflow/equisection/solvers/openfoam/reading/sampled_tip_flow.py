"""The flow near the tip of the plate, sampled by OpenFOAM on a regular grid in planes."""

from __future__ import annotations

import logging
import math
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.files import write_text
from equisection.results.tip_flow import TipFlow
from equisection.solvers.openfoam.dictionaries import dictionary
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.beam_mesh import PlateMesh
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OutlineBeamMesh
from equisection.solvers.openfoam.process import run_program
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.reading.contour_places import cut_at

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]

#: Velocity and turbulent kinetic energy in OpenFOAM.
SAMPLED_FIELDS = ("U", "k")

#: Planes from the leading edge along the stream: on the plate, just behind it, in its wake; reach
#: to either side of the tip along the span, and above and below it; distance of points (chords).
PLANES, INWARD, BEYOND, ASIDE, STEP = (0.5, 1.05, 1.5), 0.7, 0.5, 0.5, 0.02
#: Name of the function object, and of its one set of points.
_NAME, _SET = "tipFlow", "near"


@dataclass(frozen=True)
class Pose:
    """Pose of the plate: twist (rad) and deflection (chords) at places z/c, shape (n,)."""

    z: Floats
    twist: Floats
    deflection: Floats


AT_REST = Pose(np.zeros(1), np.zeros(1), np.zeros(1))


def sample_tip_flow(
    installation: Installation,
    folder: Path,
    mesh: PlateMesh | OutlineBeamMesh,
    *,
    state: str,
    pose: Pose = AT_REST,
    mean: bool = False,
) -> TipFlow | None:
    """Return the flow near the tip in the last state of a run.

    None for a plate without a tip, and where the program failed or sampled nothing: a missing
    picture is no reason to lose a result.

    Parameters
    ----------
    installation
        OpenFOAM.
    folder
        The case, divided or not.
    mesh
        Its mesh.
    state
        The last state in words.
    pose
        Pose of the plate in it.
    mean
        True samples the means over time.
    """
    if not mesh.gap:
        return None
    x, y, z = _grid(mesh, pose)
    points = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1)
    fields = [f"{name}Mean" if mean else name for name in SAMPLED_FIELDS]
    sampling = _sampling(points.reshape(-1, 3), fields)
    write_text(folder / "system" / _NAME, dictionary(_NAME, sampling))
    output = folder / "postProcessing" / _NAME
    shutil.rmtree(output, ignore_errors=True)
    arguments = ("-latestTime", "-func", _NAME)
    try:
        ranks = len(parts(folder))
        run_program(installation, "postProcess", folder, arguments=arguments, ranks=ranks)
    except SolverError as error:
        logger.warning("%s: the flow near the tip is not known: %s", folder, error)
        return None
    files = [next(output.glob(f"*/{_SET}_{field}.xy"), None) for field in fields]
    if None in files:
        logger.warning("%s: nothing was sampled near the tip; see log.postProcess", folder)
        return None
    chord_line, thickness = _body(x, z, mesh, pose)
    velocity, turbulence = (_on_grid(path, points) for path in files if path)
    return TipFlow(
        x=x,
        y=y,
        z=z,
        velocity=velocity,
        turbulence=turbulence[..., 0],
        chord_line=chord_line,
        span=mesh.span,
        thickness=thickness,
        state=state,
    )


def _grid(mesh: PlateMesh | OutlineBeamMesh, pose: Pose) -> tuple[Floats, Floats, Floats]:
    """Return x of the planes, and y and z of the points, about where the tip is."""
    inward, beyond = min(INWARD, mesh.span), min(BEYOND, mesh.gap)
    tip = float(np.interp(mesh.span, pose.z, pose.deflection))
    return (
        np.array(PLANES) - 0.5,
        _middles(tip - ASIDE, tip + ASIDE),
        _middles(mesh.span - inward, mesh.span + beyond),
    )


def _middles(low: float, high: float) -> Floats:
    ends = np.linspace(low, high, round((high - low) / STEP) + 1)
    return 0.5 * (ends[1:] + ends[:-1])


def _body(
    x: Floats, z: Floats, mesh: PlateMesh | OutlineBeamMesh, pose: Pose
) -> tuple[Floats, float]:
    """Return y of the middle of the body in each plane along z, shape (p, n), and its thickness.

    The middle of a rectangle is its chord line; the thickness of an outline is the largest in the
    planes.
    """
    if isinstance(mesh, PlateMesh):
        return _chord_line(x, z, mesh, pose), mesh.section.channel.thickness
    angle = mesh.section.incidence + np.interp(z, pose.z, pose.twist)
    cuts = np.stack([cut_at(np.array(mesh.section.outline), float(at), angle) for at in x])
    middle = cuts.mean(axis=-1) + np.interp(z, pose.z, pose.deflection)
    thickness = float(np.nan_to_num(np.ptp(cuts, axis=-1)).max())
    return np.where(z <= mesh.span, middle, math.nan), thickness


def _chord_line(x: Floats, z: Floats, mesh: PlateMesh, pose: Pose) -> Floats:
    """Return y of the chord line in each plane along z, shape (p, n)."""
    angle = mesh.section.incidence + np.interp(z, pose.z, pose.twist)
    line = np.interp(z, pose.z, pose.deflection) - x[:, None] * np.tan(angle)
    there = (np.abs(x)[:, None] <= 0.5 * np.cos(angle)) & (z <= mesh.span)
    return np.where(there, line, math.nan)


def _sampling(points: Floats, fields: Sequence[str]) -> dict[str, object]:
    """Return the function object that writes fields at points, a row for each in the flow."""
    rows = " ".join(f"({x:.10g} {y:.10g} {z:.10g})" for x, y, z in points)
    return {
        "type": "sets",
        "libs": ['"libsampling.so"'],
        "interpolationScheme": "cellPoint",
        "setFormat": "raw",
        "fields": list(fields),
        "sets": f"( {_SET} {{ type cloud; axis xyz; points ({rows}); }} )",
    }


def _on_grid(path: Path, points: Floats) -> Floats:
    """Return a field that was sampled, shape (p, m, n, components); NaN where there is no flow.

    Points that are not in the flow have no row, and ranks write theirs one after the other, so a
    row is known by its place.
    """
    rows = np.loadtxt(path, ndmin=2)
    flat = points.reshape(-1, 3)
    distance, nearest = scipy.spatial.cKDTree(flat).query(rows[:, :3])
    values = np.full((len(flat), rows.shape[1] - 3), math.nan)
    here = distance < 0.1 * STEP
    values[nearest[here]] = rows[here, 3:]
    return values.reshape(*points.shape[:-1], -1)
