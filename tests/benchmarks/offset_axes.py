"""Damped section with offset axes in small attached motion, by OpenFOAM and the embedded solver.

    python -m tests.benchmarks.offset_axes

The section is released at a small incidence by either, and the poles of both motions are fitted in
the same way: frequency, and growth rate, of heave and pitch as the air has them. In vacuum they are
those of the mass, damping and stiffness matrices. OpenFOAM's mesh is coarser than any preset.
"""

import math
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.sections import release_sections
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from tests.free_vibration import Complexes, Floats, exact_poles, fitted_poles
from tests.sample_cases import UNSTEADY
from tests.watching import nothing

INCIDENCE_DEG, DURATION, STEP = 0.5, 16.0, 0.02
#: Time (c/V) after the release that is left out, in which the wake forms.
BEFORE = 3.0
REFINEMENT = 0.6
ROOT = Path(__file__).parents[2]


def section(imbalance: float, elastic_axis: float) -> Section:
    """Return a section with 1 % of critical damping and S as a part of sqrt(m I)."""
    return Section(
        torsional_stiffness=30.0,
        flexural_stiffness=80.0,
        inertia=8.8,
        mass=80.0,
        static_imbalance=imbalance * math.sqrt(80.0 * 8.8),
        flexural_damping=2 * 0.01 * math.sqrt(80.0 * 80.0),
        torsional_damping=2 * 0.01 * math.sqrt(30.0 * 8.8),
        elastic_axis=elastic_axis,
    )


def poles(time: Floats, motion: Floats, near: Complexes) -> Complexes:
    """Return the poles of a motion that rings about a mean."""
    late = time > BEFORE
    time, motion = time[late], motion[late]
    impulse = np.zeros(time.size)
    impulse[0] = 1.0
    return fitted_poles(time, motion, np.stack([np.ones(time.size), impulse], axis=1), near)


def by_openfoam(chosen: Section, near: Complexes) -> Complexes:
    """Return the poles of the release in OpenFOAM's flow."""
    case = UNSTEADY.model_copy(
        update={
            "section": chosen,
            "incidence_deg": INCIDENCE_DEG,
            "duration": DURATION,
            "time_step": STEP,
            "output_interval": STEP,
        }
    )
    with tempfile.TemporaryDirectory() as work:
        run = SectionRun(find(), case, mesh_of(case, REFINEMENT), Coupling(), Path(work))
        run.run(nothing)
        history = run.history()
    return poles(history.time, np.stack([history.deflection, history.twist], axis=1), near)


def by_embedded(chosen: Section, near: Complexes) -> Complexes:
    """Return the poles of the release with the embedded solver's loads of the plate."""
    polar = Polar.read(ROOT / "config/polars/plate_2d_11136.csv")
    found = release_sections(
        [chosen],
        UnsteadyLoads.from_polar(polar, IDENTIFIED_LAGS),
        math.radians(INCIDENCE_DEG),
        DURATION,
        time_step=STEP,
        output_interval=STEP,
    )
    motion = np.stack([found.deflection[:, 0], found.twist[:, 0]], axis=1)
    return poles(found.time, motion, near)


def main() -> None:
    """Print frequency and growth rate of both motions, by both solvers and in vacuum."""
    rows = []
    for imbalance, axis in ((0.0, 0.5), (0.2, 0.35)):
        chosen = section(imbalance, axis)
        vacuum = exact_poles(chosen.mass_matrix, chosen.damping_matrix, chosen.stiffness_matrix)
        flow, embedded = by_openfoam(chosen, vacuum), by_embedded(chosen, vacuum)
        for name, place in (("heave", 0), ("pitch", 1)):
            rows.append(
                {"S/sqrt(m I)": imbalance, "axis, x/c": axis, "motion": name}
                | {
                    f"{what}, {solver}": part(found[place])
                    for solver, found in (
                        ("vacuum", vacuum),
                        ("OpenFOAM", flow),
                        ("embedded", embedded),
                    )
                    for what, part in (("omega", np.imag), ("growth", np.real))
                }
            )
    print(pd.DataFrame(rows).to_string(index=False, float_format="%.4f"))


if __name__ == "__main__":
    main()
