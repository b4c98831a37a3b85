"""A flexible beam in a flow, its equivalent two-dimensional section, and where they go unstable.

The names of this module are the public ones; the workflow's scripts use the rooms behind them.
Each is loaded when it is first used, so that ``import equisection`` loads no numerics::

    import equisection as eq

    beam = eq.Beam.from_yaml("my-beam.yaml")
    section = eq.reduce(beam)
    polar = eq.Polar.read("my_section.csv", moment_axis=0.25)
    eq.critical_speed(section, polar, incidence_deg=2.5, speed=(5.0, 60.0))

Signs, symbols and non-dimensional numbers are stated once, in :mod:`equisection.conventions`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from equisection.needs import require

require()

__version__ = "0.2.0"

__all__ = [
    "Beam",
    "Derivatives",
    "EquisectionError",
    "Polar",
    "Section",
    "SeparationLags",
    "__version__",
    "critical_speed",
    "open_run",
    "read_history",
    "reduce",
    "release",
    "stability",
    "stability_map",
]

if TYPE_CHECKING:
    from equisection.aerodynamics.derivatives import Derivatives
    from equisection.aerodynamics.polar import Polar
    from equisection.aerodynamics.separation import SeparationLags
    from equisection.analysis.run_tree import open_run
    from equisection.beam.beam import Beam
    from equisection.beam.section import Section
    from equisection.errors import EquisectionError
    from equisection.motion.stability import critical_speed, stability
    from equisection.reduction.beam_section import reduce
    from equisection.solvers.embedded.map_of_any_body import stability_map
    from equisection.solvers.embedded.section_release import release
    from equisection.solvers.given.recorded_release import read_history
else:
    _PLACES = {
        "Beam": "beam.beam",
        "Derivatives": "aerodynamics.derivatives",
        "EquisectionError": "errors",
        "Polar": "aerodynamics.polar",
        "Section": "beam.section",
        "SeparationLags": "aerodynamics.separation",
        "critical_speed": "motion.stability",
        "open_run": "analysis.run_tree",
        "read_history": "solvers.given.recorded_release",
        "reduce": "reduction.beam_section",
        "release": "solvers.embedded.section_release",
        "stability": "motion.stability",
        "stability_map": "solvers.embedded.map_of_any_body",
    }

    def __getattr__(name: str) -> object:
        """Load a public name when it is first used (PEP 562)."""
        if name not in _PLACES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
        globals()[name] = value
        return value

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
