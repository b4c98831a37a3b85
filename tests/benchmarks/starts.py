"""Section at zero incidence after a start, by OpenFOAM and the embedded solver.

    python -m tests.benchmarks.starts

It is held at a twist until the flow is steady, or gets a heave rate at the release. OpenFOAM's mesh
is coarser than any preset; the embedded solver has the polar of the coarse one.
"""

import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.cases import Start, UnsteadyCase
from equisection.motion.sections import release_sections
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import mesh_of
from tests.sample_cases import UNSTEADY
from tests.watching import nothing

DURATION, STEP = 6.0, 0.02
REFINEMENT = 0.6
POLAR = Path(__file__).parents[2] / "config/polars/plate_2d_11136.csv"
#: The paper's ratios at k* = 10.
SECTION = Section(
    torsional_stiffness=10.0,
    flexural_stiffness=1.83,
    inertia=8.8,
    mass=80.0,
    twist_recovery=1.0,
    deflection_recovery=1.0,
)


def by_openfoam(case: UnsteadyCase) -> np.ndarray:
    """Return time, twist (deg) and deflection (chords) of each step, shape (3, n)."""
    with tempfile.TemporaryDirectory() as work:
        mesh = mesh_of(case, REFINEMENT)
        result = SectionRun(find(), case, mesh, Coupling(), Path(work)).run(nothing)
    return np.stack([result.time, np.degrees(result.twist), result.deflection])


def by_embedded(case: UnsteadyCase, time: np.ndarray) -> np.ndarray:
    """Return the same of the embedded solver at given times, shape (3, n)."""
    found = release_sections(
        [SECTION],
        UnsteadyLoads.from_polar(Polar.read(POLAR)),
        0.0,
        case.duration,
        time_step=STEP,
        output_interval=STEP,
        twist=case.section_start_twist,
        heave_rate=case.section_heave_rate,
    )
    motions = (np.degrees(found.twist[:, 0]), found.deflection[:, 0])
    return np.stack([time, *(np.interp(time, found.time, motion) for motion in motions)])


def row(start: Start) -> dict[str, float]:
    """Return ranges of twist and deflection after a start, and how far the solvers are apart."""
    case = UNSTEADY.model_copy(
        update={
            "section": SECTION,
            "incidence_deg": 0.0,
            "start": start,
            "duration": DURATION,
            "time_step": STEP,
            "output_interval": STEP,
        }
    )
    flow = by_openfoam(case)
    embedded = by_embedded(case, flow[0])
    found = {"twist_deg": start.twist_deg, "heave_rate": start.heave_rate}
    for name, one, other in zip(
        ("twist, deg", "deflection, c"), flow[1:], embedded[1:], strict=True
    ):
        found |= {
            f"{name}": float(np.ptp(one)),
            f"{name}, embedded": float(np.ptp(other)),
            f"{name}, apart": float(np.abs(one - other).max()),
        }
    return found


def main() -> None:
    """Print a row for each start."""
    rows = [row(Start(twist_deg=1.0)), row(Start(heave_rate=0.01))]
    print(pd.DataFrame(rows).to_string(index=False, float_format="%.4f"))


if __name__ == "__main__":
    main()
