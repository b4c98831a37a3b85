"""Onset of the corrected section by this project's own ratios of section to plate, and by Table 1.

    python -m tests.benchmarks.own_ratios

The factors of Eq. 20 at the equilibrium of each k* with either polar of the rigid plate, and the
onset that models learnt from kept releases of the section give with each (no solver is run).
"""

import math
from collections.abc import Iterator
from pathlib import Path

import pandas as pd

from equisection.aerodynamics.polar import Polar
from equisection.analysis.reduced_model import learnt_model, predicted, predicted_onset
from equisection.beam.section import Section
from equisection.paper.mesh_convergence.kept_releases import rigid_loads
from equisection.paper.mesh_convergence.onset_by_mesh import own_factors
from equisection.reduction.carried_beam import beam_carried_over
from equisection.reduction.corrected_section import corrected_section
from equisection.reduction.correction import CorrectionFactors
from tests.benchmarks.learnt import REFERENCE, polar_of, sweep_of
from tests.workflow.project import ROOT

POLARS = ROOT / "config" / "polars"
INCIDENCE = math.radians(2.5)
#: k* of the releases that a model is learnt from, and at which it predicts.
LEARNT_FROM = (5.5, 6.44, 7.5)
K_STAR = (5.0, 5.5, 6.0, 6.44, 7.0, 7.5, 8.0, 8.5, 9.0, 10.0)
#: Place of k* 7 among them.
_AT = 4
#: The moment factor with a change of its own: what the ratio is known to.
KNOWN_TO = 0.06


def _read(path: Path) -> Polar:
    return Polar.read(path, symmetric=False)


def corrections(section: Polar) -> dict[str, CorrectionFactors]:
    """Return the factors by Table 1 of the paper, and by the ratio on equal cells of two meshes."""
    pair = CorrectionFactors(
        _read(POLARS / "plate_2d_3132.csv"), _read(POLARS / "plate_3d_85284.csv")
    )
    finer, mesh = own_factors(*(rigid_loads(REFERENCE, one) for one in ("2d", "3d")))
    assert finer is not None, "section and plate are kept on equal cells"
    return {
        "Table 1": CorrectionFactors(section, _read(POLARS / "paper_plate_3d.csv")),
        "own ratios": CorrectionFactors(section, beam_carried_over(section, pair)),
        f"own ratios, {mesh}": CorrectionFactors(section, beam_carried_over(section, finer)),
    }


def _with_moment(section: Section, times: float) -> Section:
    """Return a corrected section with another factor of the moment."""
    return section.model_copy(
        update={
            "torsional_stiffness": times * section.torsional_stiffness,
            "inertia": times * section.inertia,
        }
    )


def rows() -> Iterator[dict[str, object]]:
    """Yield the factors and the learnt onset of each correction."""
    polar, kept = polar_of("paper-plate-openfoam", "coarse"), sweep_of("paper-plate-openfoam", "2d")
    of_6 = kept[6.44].section
    sections = [of_6.scaled(k / 6.44) for k in K_STAR]
    models = [learnt_model(kept[k], polar) for k in LEARNT_FROM]
    for name, factors in corrections(polar).items():
        with_factors = [corrected_section(section, factors, INCIDENCE)[0] for section in sections]
        lift = with_factors[_AT].mass / sections[_AT].mass
        moment = with_factors[_AT].inertia / sections[_AT].inertia
        for changed in (1.0, 1.0 - KNOWN_TO, 1.0 + KNOWN_TO):
            chosen = [_with_moment(section, changed) for section in with_factors]
            onsets = [predicted_onset(predicted(model, K_STAR, chosen)) for model in models]
            yield {
                "": name,
                "moment factor times": changed,
                "lift factor at 7": lift,
                "moment factor at 7": changed * moment,
                **{
                    f"from {k:g}": found.k_star
                    for k, found in zip(LEARNT_FROM, onsets, strict=True)
                },
                "low": min(found.low for found in onsets),
                "high": max(found.high for found in onsets),
            }


if __name__ == "__main__":
    print(pd.DataFrame(rows()).to_string(index=False, float_format="%.3g"))
