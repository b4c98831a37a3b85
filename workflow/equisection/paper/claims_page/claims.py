"""The paper's claims, in its words, each with the function that judges it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from equisection.paper.claims_page import findings_loads as loads
from equisection.paper.claims_page import findings_response as response
from equisection.paper.claims_page.evidence import Evidence
from equisection.paper.claims_page.findings import Finding


@dataclass(frozen=True)
class Claim:
    """A claim of the paper.

    Attributes
    ----------
    title
        Subject of the claim.
    words
        The paper's words or numbers.
    source
        Their place in the paper.
    judge
        Function that gives the finding.
    """

    title: str
    words: str
    source: str
    judge: Callable[[Evidence], Finding]


CLAIMS = (
    Claim(
        "Natural frequencies",
        "not noticeably affected by the number of elements: C_1 to C_5 on 8.5e3 and 5.0e4 elements",
        "Table 2",
        loads.natural_frequencies,
    ),
    Claim(
        "Ratios of the section's properties",
        "c^2 k_w/k_theta of about 0.183 and c^2 m_2D/I_2D of about 9.12",
        "Section 3, after Eq. 18",
        loads.property_ratios,
    ),
    Claim(
        "Loads of the rigid plate",
        "C_D, C_L and C_M at 0, 2.5, 5 and 10 deg; discrepancies between the meshes are minimal",
        "Table 1",
        loads.rigid_plate,
    ),
    Claim(
        "The section's loads do not depend on the mesh",
        "a fair agreement between all meshes [...], even at angles near to stall",
        "Section 4.1, Fig. 6",
        loads.independence_of_the_mesh,
    ),
    Claim(
        "Wall distance",
        "Note how y+ < 1 for the whole plate",
        "Section 4.1, Fig. 7",
        loads.wall_distance,
    ),
    Claim(
        "Recirculation bubble of the section",
        "even for the low angle of 1 deg a recirculation bubble appears [...] for almost the 50 % "
        "of the length. For 5 deg, [...] for the whole length",
        "Section 4.1, Fig. 7",
        loads.bubble_of_the_section,
    ),
    Claim(
        "Recirculation bubble of the plate",
        "at the root [...] approximately the 25 % of the chord at 2 deg, and almost 80 % at 4 deg",
        "Section 5.1, Fig. 11",
        loads.bubble_of_the_plate,
    ),
    Claim(
        "Courant number",
        "the major part of the cells present a CFL lower than 2 and 90 % of the volume [...] lower "
        "than 1.5",
        "Section 4.1, Fig. 8",
        loads.courant_number,
    ),
    Claim(
        "Two dimensions against three, rigid",
        "for low incidence the lift and moment in the 2D problem are higher than in the 3D [...]. "
        "For moderate to high values [...], two-dimensional plate stalls while [...] C_M continues "
        "increasing",
        "Section 5.1, Figs. 13 and 14",
        loads.section_against_plate,
    ),
    Claim(
        "The first modes dominate",
        "the first mode is dominant in both bending and torsion, [...] at least two orders of "
        "magnitude greater than [...] higher order modes",
        "Section 5.2, Fig. 15",
        response.first_modes,
    ),
    Claim(
        "Mean twist without a correction",
        "the same results than the 3D for average torsion, even when not considering any kind of "
        "three dimensional effects",
        "Section 5.2, Fig. 16a",
        response.mean_twist_uncorrected,
    ),
    Claim(
        "Mean bending without a correction",
        "this non-corrected model tends to overestimate the value of the average bending",
        "Section 5.2, Fig. 16b",
        response.mean_bending_uncorrected,
    ),
    Claim(
        "Means with the correction",
        "both prediction of torsion and bending [...] show a fair agreement",
        "Section 5.2, Fig. 16",
        response.means_corrected,
    ),
    Claim(
        "Onset of the instability",
        "approximately for the same value of k* of about 5.5",
        "Section 5.2, Fig. 16",
        response.onset,
    ),
    Claim(
        "Limit cycle at the limit of the instability",
        "when reaching the limit of instability, [...] Case B for the 2D section, a stable Limit "
        "Cycle Oscillation is observed",
        "Section 5.2, Fig. 16d",
        response.limit_cycle,
    ),
    Claim(
        "Growing oscillation inside",
        "predicting the 2D calculation a much more abrupt response than the 3D case",
        "Section 5.2, Figs. 16c and 16f",
        response.growing_inside,
    ),
    Claim(
        "Decay at high stiffness",
        "at a sufficiently long time, [...] a steady response is reached",
        "Section 5.2, Figs. 16e and 16h",
        response.decay_at_high_stiffness,
    ),
    Claim(
        "Stall flutter, not classical flutter",
        "[...] center of gravity of the section and its elastic axis are coincident [...] "
        "linear flutter is expected not to occur",
        "Section 5.2",
        response.not_classical_flutter,
    ),
    Claim(
        "Cost",
        "a computational cost which is reduced by orders of magnitude",
        "Abstract; the cells and time steps of Sections 4.1 and 4.2 make it 245",
        response.cost,
    ),
)
