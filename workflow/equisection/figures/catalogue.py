"""Catalogue of the figures: contents, files and keys of each, and the runs that have it.

A figure is an entry here, a module of the same name in this package, whose ``from_files`` draws it,
and a caption in ``workflow/report/figures``. The rules are made from the entries, so this module
loads no figure before it is drawn.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from equisection.figures.models_shown import beam_model, section_model
from equisection.solvers.protocol import Capability
from equisection.solvers.registry import SOLVERS
from equisection.study import plan
from equisection.study.result_files import index_of_beam, indices_of_model, indices_of_sweep

if TYPE_CHECKING:  # jobs need not build the models, nor the graph load what draws
    from matplotlib.figure import Figure

    from equisection.config import Config


class FurtherName(NamedTuple):
    """Another name that a figure goes by, with its number and caption (a path seen from a rule)."""

    name: str
    number: str
    caption: str


@dataclass(frozen=True)
class RunFiles:
    """Configuration and folder of a run, with tables of values to draw next to its own."""

    config: Config
    folder: str
    references: Sequence[str] = ()


#: A file of the run, as seen from its folder, or a function that returns any number of files.
Source = str | Callable[[RunFiles], list[str]]


def _always(config: Config) -> bool:
    del config
    return True


@dataclass(frozen=True)
class Entry:
    """One figure.

    Attributes
    ----------
    name
        Name of its files, ``figures/<name>.png``; with underscores that of its module.
    shows
        Its contents in a few words.
    inputs
        Files that it is drawn from. Entries of one job give a file the same name.
    keys
        Keys of the configuration that it needs, by the names that ``from_files`` has for them.
    exists
        Condition under which a run has it.
    drawn_with
        Name of the job that draws it, if that draws others too.
    family
        Name of that job where the solver takes many cases at once. All that it draws from is made
        in seconds there, and starting a job takes longer than drawing.
    """

    name: str
    shows: str
    inputs: Mapping[str, Source]
    keys: Mapping[str, str] = field(default_factory=dict)
    exists: Callable[[Config], bool] = _always
    drawn_with: str = ""
    family: str = ""

    @property
    def caption(self) -> str:
        """Path of its caption, as a rule sees it."""
        return f"../report/figures/{self.name}.rst"

    @property
    def module(self) -> str:
        """Name of its module in this package."""
        return self.name.replace("-", "_")

    def job(self, together: bool = False) -> str:
        """Return the name of the rule that draws it, alone or with its family."""
        return (together and self.family) or self.drawn_with or self.module

    def files(self, run: RunFiles) -> dict[str, str | list[str]]:
        """Return its input files, by name."""
        return {
            name: f"{run.folder}/{source}" if isinstance(source, str) else source(run)
            for name, source in self.inputs.items()
        }

    def values(self, resolved: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of its keys in a resolved configuration, in builtin types."""
        return {
            name: reduce(lambda group, part: group[part], key.split("."), resolved)
            for name, key in self.keys.items()
        }


def references(run: RunFiles) -> list[str]:
    """Return the tables of values to draw next to those of the run (:mod:`.references`)."""
    return list(run.references)


def indices_of_beam(run: RunFiles) -> list[str]:
    """Return the index of the beam's results, if there is one."""
    return index_of_beam(run.config, run.folder)


def indices_of_histories(run: RunFiles) -> list[str]:
    """Return the indices of the runs of which histories are shown: of one section and the beam."""
    config = run.config
    records = Capability.RECORDS in SOLVERS[config.solver].provides
    if (
        records or not config.compute
    ):  # a model of which nothing is kept is not the one that is shown
        return indices_of_sweep(config, run.folder)
    models = (section_model(config.sweep.shown), beam_model(config.sweep.shown))
    return [
        index
        for model in models
        if model is not None
        for index in indices_of_model(config, run.folder, model)
    ]


def learnt_models(run: RunFiles) -> list[str]:
    """Return the models that were learnt from releases, if the onset is found by them."""
    if not plan.learns(run.config):
        return []
    return [
        f"{run.folder}/rom/{model}/{name}.nc"
        for model in run.config.sweep.models
        for name in plan.learnt_names(run.config)
    ]


def grid_study(run: RunFiles) -> list[str]:
    """Return the grid study of the section's polar, if there is one."""
    return [f"{run.folder}/tables/grid_study.csv"] if plan.has_grid_study(run.config) else []


def _at_one_incidence(config: Config) -> bool:
    """Tell whether the sweep is at one incidence, so that a line over k* or speed is one beam."""
    return len(config.sweep.incidence_deg) <= 1


def _has_section_at_one_incidence(config: Config) -> bool:
    return _has_section_model(config) and _at_one_incidence(config)


def _has_both_at_one_incidence(config: Config) -> bool:
    return plan.has_both(config) and _at_one_incidence(config)


def _moves_section(config: Config) -> bool:
    return config.forced.run


def _moves_beam(config: Config) -> bool:
    return "3d" in plan.forced_dimensions(config)


def _has_section_model(config: Config) -> bool:
    return "2d" in plan.dimensions(config)


def _has_beam_model(config: Config) -> bool:
    return "3d" in plan.dimensions(config)


def _runs_rigid_beam(config: Config) -> bool:
    return "3d" in plan.steady_dimensions(config)


def _rigid_beam_has(capability: Capability) -> Callable[[Config], bool]:
    """Return when the solver runs the rigid beam and has something of it."""

    def exists(config: Config) -> bool:
        return _runs_rigid_beam(config) and capability in SOLVERS[config.solver].provides

    return exists


_SUMMARY = {"summary": "comparison/summary.csv"}
_HISTORIES: Mapping[str, Source] = {
    **_SUMMARY,
    "onset": "comparison/onset.csv",
    "indices": indices_of_histories,
    "equivalent": "structure/equivalent.nc",
}
_MODES = {"modes": "structure/modes.nc"}
_POLAR_2D = {"polar_2d": "steady/polar_2d.nc"}
_POLAR_3D = {"polar_3d": "steady/polar_3d.nc"}
_CORRECTION = {**_POLAR_2D, **_POLAR_3D, "correction": "steady/correction.nc"}
_RESOLUTION = {"resolution": "steady.resolution"}
_INCIDENCE = {"incidence_deg": "flow.incidence_deg"}
_OF_MODES, _OF_LOADS = "figures_of_modes", "figures_of_loads"

_MAP = {"stability_map": "comparison/stability_map.nc"}
_DESIGN = {"design_speed": "flow.design_speed"}
_OF_MAP = "figures_of_map"

#: Every figure, in the order of Fig. 1: structure, steady loads, response.
CATALOGUE = (
    Entry("mode-shapes", "modes", _MODES, {"beam": "beam"}, family=_OF_MODES),
    Entry(
        "mesh-of-section",
        "mesh of the section",
        {"section_mesh": "steady/section_mesh.nc"},
        exists=plan.has_mesh,
    ),
    Entry(
        "section-polar",
        "section polars",
        {**_POLAR_2D, "grid_study": grid_study},
        family=_OF_LOADS,
    ),
    Entry(
        "surface-loads",
        "wall distance and pressure",
        {
            "index": "steady/2d/polar.json",
            "bubble": "tables/bubble.csv",
            "references": references,
        },
        {**_RESOLUTION, **_INCIDENCE},
        exists=plan.has_surface,
    ),
    Entry(
        "courant-number",
        "Courant number",
        {"section_mesh": "steady/section_mesh.nc", "references": references},
        exists=plan.has_mesh,
    ),
    Entry(
        "mesh-of-beam",
        "meshes of the beam",
        {"plate_mesh": "steady/plate_mesh.nc"},
        {"method": "structure.method", "elements": "structure.elements"},
        exists=_rigid_beam_has(Capability.MESH),
    ),
    Entry(
        "spanwise-loads",
        "spanwise loads",
        _POLAR_3D,
        _RESOLUTION,
        exists=_runs_rigid_beam,
        family=_OF_LOADS,
    ),
    Entry(
        "surface-of-beam",
        "pressure and shear stress over the beam",
        {"index_of_rigid": "steady/3d/polar.json"},
        _RESOLUTION,
        exists=_rigid_beam_has(Capability.SURFACE),
    ),
    Entry(
        "flow-at-tip",
        "flow near the tip",
        {
            "index_of_rigid": "steady/3d/polar.json",
            "index_of_beam": indices_of_beam,
            "references": references,
        },
        {**_RESOLUTION, **_INCIDENCE},
        exists=_rigid_beam_has(Capability.FIELDS),
    ),
    Entry(
        "lift-correction",
        "correction of the lift",
        _CORRECTION,
        _RESOLUTION,
        exists=plan.has_beam_polar,
        drawn_with="load_corrections",
        family=_OF_LOADS,
    ),
    Entry(
        "moment-correction",
        "correction of the moment",
        _CORRECTION,
        _RESOLUTION,
        exists=plan.has_beam_polar,
        drawn_with="load_corrections",
        family=_OF_LOADS,
    ),
    Entry(
        "modal-contributions",
        "modal contributions",
        {**_MODES, "index_of_beam": indices_of_beam},
        exists=_has_beam_model,
        family=_OF_MODES,
    ),
    Entry(
        "flutter-derivatives",
        "flutter derivatives",
        {"table": "derivatives/2d.csv"},
        exists=_moves_section,
    ),
    Entry(
        "forces-on-modes",
        "forces on the modes of the beam",
        {
            "forces": "derivatives/3d.csv",
            "table": "derivatives/2d.csv",
            "modes": "structure/modes.nc",
        },
        exists=_moves_beam,
    ),
    Entry(
        "response",
        "response",
        _HISTORIES,
        {"reduction": "reduction"},
        exists=_at_one_incidence,
    ),
    Entry(
        "hysteresis",
        "hysteresis",
        _HISTORIES,
        {"reduction": "reduction"},
        exists=_has_section_at_one_incidence,
        drawn_with="response",
    ),
    Entry(
        "growth-rate",
        "growth rate, linear theory",
        {
            **_SUMMARY,
            "linear_theory": "comparison/linear_theory.csv",
            "references": references,
            "learnt": learnt_models,
        },
        exists=_at_one_incidence,
    ),
    Entry(
        "section-and-beam",
        "section against beam",
        {**_SUMMARY, "deviations": "comparison/section_and_beam.csv"},
        exists=_has_both_at_one_incidence,
        drawn_with="growth_rate",
    ),
    Entry(
        "critical-speed",
        "critical speed over incidence, with its interval",
        {**_MAP, "stability": "comparison/stability.csv"},
        _DESIGN,
        exists=plan.has_stability_map,
        drawn_with=_OF_MAP,
    ),
    Entry(
        "modes-over-speed",
        "damping and frequency over speed",
        _MAP,
        {**_INCIDENCE, **_DESIGN},
        exists=plan.has_stability_map,
        drawn_with=_OF_MAP,
    ),
    Entry(
        "static-twist",
        "static twist and share of the divergence speed",
        _MAP,
        _DESIGN,
        exists=plan.has_stability_map,
        drawn_with=_OF_MAP,
    ),
    Entry(
        "damping-below-design",
        "least damping over speed",
        _MAP,
        _DESIGN,
        exists=plan.has_stability_map,
        drawn_with=_OF_MAP,
    ),
    Entry(
        "motion-at-onset",
        "motion at the onset",
        _MAP,
        _INCIDENCE,
        exists=plan.has_stability_map,
        drawn_with=_OF_MAP,
    ),
)


def figures(config: Config) -> list[Entry]:
    """Return the figures of a run."""
    return [entry for entry in CATALOGUE if entry.exists(config)]


def figures_by_job(config: Config) -> dict[str, list[Entry]]:
    """Return the figures of a run by the job that draws them."""
    together = Capability.BATCH in SOLVERS[config.solver].provides
    jobs: dict[str, list[Entry]] = {}
    for entry in figures(config):
        jobs.setdefault(entry.job(together), []).append(entry)
    return jobs


def entry_of(name: str) -> Entry:
    """Return the figure of a name."""
    return next(entry for entry in CATALOGUE if entry.name == name)


def draw(
    entry: Entry, files: Mapping[str, Path | Sequence[Path]], values: Mapping[str, Any]
) -> Figure:
    """Draw a figure.

    Parameters
    ----------
    entry
        The figure.
    files
        Files by name, those of ``entry.inputs`` among them.
    values
        Values by name, those of ``entry.keys`` among them.
    """
    module = importlib.import_module(f"equisection.figures.{entry.module}")
    wanted = {name: files[name] for name in entry.inputs} | {
        name: values[name] for name in entry.keys
    }
    drawn: Figure = module.from_files(**wanted)
    return drawn
