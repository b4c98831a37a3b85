"""Section ``openfoam``: the solver that resolves the flow."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from equisection.config.groups.forced_keys import ForcedKeys
from equisection.config.groups.solver_keys import SolverKeys
from equisection.keys.checks import Problem, check
from equisection.keys.values import NUMBER, WHOLE, Name

MeshName = Literal[
    "coarse",
    "medium",
    "fine",
    "extra-fine",
    "finest",
    "five-layers",
    "coarse-medium-span",
    "coarse-fine-span",
    "coarse-sparse-span",
    "medium-coarse-span",
    "fine-coarse-span",
    "plate-coarse",
    "plate-medium",
    "plate-fine",
    "plate-extra-fine",
    "plate-finest",
    "plate-five-layers",
]
#: Before the name of a mesh: the section has the cells that its plate has in the plane.
ON_CELLS_OF_PLATE = "plate-"
#: Meshes that have one around the section, for overset.
OVERSET_MESHES = ("coarse", "medium", "fine")

#: A mesh that morphs around the section, and one above another that moves with it.
MeshMotion = Literal["morph", "overset"]
MORPH: MeshMotion = "morph"
OVERSET: MeshMotion = "overset"
#: Mesh of the section: of blocks, or of layers at its outline with cells between.
Mesher = Literal["blocks", "outline"]
BLOCKS: Mesher = "blocks"
OUTLINE: Mesher = "outline"
#: Model of the turbulence.
Turbulence = Literal["k-omega-sst", "laminar"]
SST: Turbulence = "k-omega-sst"
LAMINAR: Turbulence = "laminar"
#: Turbulence of the stream at the inlet by default: rms velocity over V, eddy viscosity over
#: viscosity.
TURBULENCE_INTENSITY, VISCOSITY_RATIO = 0.01, 10.0
#: Meshes that there are around an outline, and beams of one.
OUTLINE_MESHES = ("coarse", "medium", "fine", "medium-coarse-span")
#: Environment variable of the command before each program.
PREFIX_VARIABLE = "EQUISECTION_OPENFOAM"
#: The largest time step (c/V) that follows the flow over the plate.
LARGEST_TIME_STEP = 0.04
#: Characters that OpenFOAM drops from a path, whose file it then does not find (v1912).
_DROPPED = re.compile(r"""[\s'"]""")


class OpenFoam(SolverKeys):
    """OpenFOAM: walls resolved; the section on one core, the plate on several."""

    meshes: Annotated[dict[Name, MeshName], Field(min_length=1)] = Field(
        {"coarse": "coarse", "medium": "medium", "fine": "fine"},
        description="Mesh of each resolution: `coarse` (about 1e4 cells; 8e4 of the plate), "
        "`medium` (2e4; 3e5), `fine` (6e4; 1e6), `extra-fine` (1e5; 3e6), which are similar, or "
        "`finest` (8e4; 5e6), which has cells of 0.004 c along the section's wall, 0.02 c near it "
        "and 0.04 c in the wake; `five-layers` (5e4; 5e6) has the same sizes and five layers of "
        "0.075 c in all on it. "
        "With `plate-` before the name the section has the cells of that plate in its plane. "
        "`coarse-medium-span`, `coarse-fine-span`, `coarse-sparse-span`, `medium-coarse-span` and "
        "`fine-coarse-span` are the first mesh in the plane, and the second one along the plate's "
        "span; sparse is half of coarse's layers there.",
    )
    outer_correctors: Annotated[int, Field(ge=1, le=50), WHOLE] = Field(
        8,
        description="Iterations of flow, loads and motion in each time step, at most (-): they end "
        "when flow and loads are one.",
    )
    velocity_relaxation: Annotated[float, Field(gt=0, le=1, allow_inf_nan=False), NUMBER] = Field(
        0.95,
        description="Under-relaxation of the velocity in these iterations (-); 1 is none, with "
        "which they move apart where the flow separates wholly.",
    )
    mesh_motion: MeshMotion = Field(
        MORPH,
        description="How the mesh follows the free section: `morph` deforms it, `overset` moves a "
        "mesh around the section above one of channel or free air, for large deflection and twist.",
    )
    mesher: Mesher = Field(
        BLOCKS,
        description="Mesh of the rectangular section and its beam: `blocks`, or `outline`, that of "
        "any outline (layers at the wall, quadrilaterals between), which `beam.outline` always "
        "has.",
    )
    far_field_chords: Annotated[float, Field(ge=10, le=1000, allow_inf_nan=False), NUMBER] = Field(
        30.0,
        description="Distance of the far field (chords), to every side, of section and beam in "
        "free air (`flow.channel: null`), which needs the mesh of outlines.",
    )
    turbulence: Turbulence = Field(
        SST,
        description="Model of the turbulence: `k-omega-sst`, whose boundary layer is turbulent "
        "from the leading edge on, or `laminar`, none, for a section at a Reynolds number of some "
        "hundreds to thousands.",
    )
    turbulence_intensity: Annotated[float, Field(gt=0, le=1, allow_inf_nan=False), NUMBER] = Field(
        TURBULENCE_INTENSITY,
        description="Turbulence of the stream at the inlet, rms velocity over speed (-). It decays "
        "up to the section, the faster the smaller `viscosity_ratio` is. No part of a laminar "
        "case.",
    )
    viscosity_ratio: Annotated[float, Field(gt=0, le=1e5, allow_inf_nan=False), NUMBER] = Field(
        VISCOSITY_RATIO,
        description="Eddy viscosity over viscosity at the inlet (-), which sets the length scale "
        "of the turbulence there. No part of a laminar case.",
    )
    prefix: str = Field(
        "",
        description="Command before each program, for instance `openfoam2312` or that of a "
        "container; empty to use what is on the machine. It is the machine's and no part of a "
        f"case; the environment variable {PREFIX_VARIABLE} goes before it.",
    )

    ranks: Annotated[int, Field(ge=1, le=4096), WHOLE] = Field(
        1,
        description="Ranks of MPI that a case of the plate runs on, each a thread of its job (-); "
        "a case of the section runs on one. No part of a case.",
    )

    def threads(self, dimension: str) -> int:
        """Return the threads of a job that runs a case of a dimension."""
        return self.ranks if dimension == "3d" else 1

    def environment(self) -> dict[str, str]:
        """Return variables by which jobs find the solver on a machine."""
        return {PREFIX_VARIABLE: self.prefix} if self.prefix else {}

    def runs_rigid_beam(self, outline: object, models: tuple[str, ...]) -> bool:
        """Tell whether the rigid beam is run too: of an outline only where a model needs it."""
        return _runs_rigid_beam(outline, models)

    def refuses_folder(self, folder: Path) -> str:
        """Return why the solver cannot work in a folder; empty if it can."""
        return refused_path(folder)


def _runs_rigid_beam(outline: object, models: tuple[str, ...]) -> bool:
    return outline is None or any(name == "3d" or "corrected" in name for name in models)


def _has_beam_in_flow(models: tuple[str, ...], beam_polar: str, outline: object) -> bool:
    """Tell whether a beam is run in the flow, free or rigid."""
    return "3d" in models or (not beam_polar and _runs_rigid_beam(outline, models))


def refused_path(folder: Path) -> str:
    """Return why OpenFOAM cannot work in a folder, links followed; empty if it can."""
    place = str(folder.resolve())
    if not _DROPPED.search(place):
        return ""
    return (
        f"OpenFOAM takes no blank and no quote in a path, and its cases would be in {place!r}: run "
        "in a folder without them (snakemake --directory FOLDER), or make results/.store a link to "
        "one"
    )


@check("solver", "unsteady.time_step")
def _follows_the_flow(solver: str, step: float) -> Iterator[Problem]:
    if solver == "openfoam" and step > LARGEST_TIME_STEP:
        yield Problem(
            "unsteady.time_step",
            step,
            f"allowed is up to {LARGEST_TIME_STEP:g} c/V with solver 'openfoam'",
        )


@check("solver", "flow.root_on_wall", "steady.beam_polar", "sweep.models", "beam.outline")
def _root_is_on_a_wall(
    solver: str, root_on_wall: bool, beam_polar: str, models: tuple[str, ...], outline: object
) -> Iterator[Problem]:
    if solver != "openfoam" or root_on_wall:
        return
    if _has_beam_in_flow(models, beam_polar, outline):
        yield Problem(
            "flow.root_on_wall",
            root_on_wall,
            "allowed is true with solver 'openfoam', whose mesh of the beam has its root on a "
            "wall; or give steady.beam_polar and leave out the model 3d",
        )


@check("solver", "flow.channel", "beam.outline", "openfoam.mesher")
def _needs_a_channel(
    solver: str, channel: object, outline: object, mesher: str
) -> Iterator[Problem]:
    if solver == "openfoam" and channel is None and outline is None and mesher == BLOCKS:
        yield Problem(
            "flow.channel",
            channel,
            "allowed is a channel with solver 'openfoam', which meshes it; in free air give "
            "openfoam.mesher: outline, or a wide channel, for instance flow.channel: "
            "{height_chords: 20, tip_gap_chords: 10}",
        )


@check("solver", "openfoam.turbulence", "sweep.models", "steady.beam_polar", "beam.outline")
def _laminar_section(
    solver: str, turbulence: str, models: tuple[str, ...], beam_polar: str, outline: object
) -> Iterator[Problem]:
    """Refuse a laminar beam: its flow is set up turbulent alone."""
    if solver != "openfoam" or turbulence != LAMINAR:
        return
    if _has_beam_in_flow(models, beam_polar, outline):
        yield Problem(
            "openfoam.turbulence",
            turbulence,
            f"allowed is {SST} with a beam in the flow: leave out the model 3d, and give "
            "steady.beam_polar",
        )


@check("solver", "forced", "openfoam.turbulence", "flow.root_on_wall")
def _moved_beam_in_the_flow(
    solver: str, forced: ForcedKeys, turbulence: str, root_on_wall: bool
) -> Iterator[Problem]:
    """Refuse a beam that is moved in its modes where there is no flow around a beam."""
    if solver != "openfoam" or not (forced.run and forced.beam_modes):
        return
    without = "or forced.beam_modes: 0, the section alone"
    if turbulence == LAMINAR:
        yield Problem(
            "openfoam.turbulence", turbulence, f"allowed is {SST} with forced.beam_modes; {without}"
        )
    if not root_on_wall:
        yield Problem(
            "flow.root_on_wall",
            root_on_wall,
            f"allowed is true with forced.beam_modes and solver 'openfoam'; {without}",
        )


@check("openfoam.turbulence", "openfoam.mesh_motion")
def _laminar_morphs(turbulence: str, motion: str) -> Iterator[Problem]:
    if turbulence == LAMINAR and motion == OVERSET:
        yield Problem(
            "openfoam.turbulence",
            turbulence,
            f"allowed is {SST} with openfoam.mesh_motion: overset",
        )


@check("solver", "beam.outline", "openfoam.mesher", "openfoam.meshes")
def _has_a_mesh_of_outlines(
    solver: str, outline: object, mesher: str, meshes: Mapping[str, str]
) -> Iterator[Problem]:
    """Refuse what the mesh of outlines does not have."""
    if solver != "openfoam" or (outline is None and mesher == BLOCKS):
        return
    why = "with beam.outline" if outline is not None else "with openfoam.mesher: outline"
    for name, mesh in meshes.items():
        if mesh not in OUTLINE_MESHES:
            yield Problem(
                f"openfoam.meshes.{name}", mesh, f"allowed are {', '.join(OUTLINE_MESHES)} {why}"
            )


@check("openfoam.mesh_motion", "openfoam.meshes")
def _has_an_overset_mesh(motion: str, meshes: Mapping[str, str]) -> Iterator[Problem]:
    for name, mesh in meshes.items():
        if motion == OVERSET and mesh not in OVERSET_MESHES:
            yield Problem(
                f"openfoam.meshes.{name}",
                mesh,
                f"allowed are {', '.join(OVERSET_MESHES)} with openfoam.mesh_motion: overset",
            )
