"""The paper's claims judged on evidence: complete, partial, and none."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from equisection.errors import ResultFileError
from equisection.paper.claims_page import findings_loads as loads
from equisection.paper.claims_page import findings_response as response
from equisection.paper.claims_page.__main__ import main, page, runs_table
from equisection.paper.claims_page.claims import CLAIMS
from equisection.paper.claims_page.evidence import Evidence, read_evidence
from equisection.paper.claims_page.findings import ClaimVerdict, Known, together
from equisection.paper.claims_page.kept_runs import base_of, cost_ladder
from equisection.paper.mesh_convergence.mesh_series import COLUMNS, LIMIT
from equisection.paper.printed_values import PUBLISHED, TABLE_1, TABLE_2, TABLE_2_KINDS
from equisection.results.section_mesh import no_mesh

#: k*, regime, amplitude (deg), growth (V/c), mean twist (deg), mean deflection (chords).
Run = tuple[float, str, float, float, float, float]
SECTION: list[Run] = [
    (5.5, "growing", 3.0, 0.01, 1.0, 0.6),
    (8.0, "limit-cycle", 0.4, -0.0004, 0.66, 0.36),
    (21.0, "settled", 0.05, -0.02, 0.24, 0.12),
]
CORRECTED: list[Run] = [
    (5.5, "growing", 2.0, 0.008, 0.8, 0.4),
    (8.0, "limit-cycle", 0.4, -0.0003, 0.6, 0.27),
    (21.0, "settled", 0.04, -0.02, 0.22, 0.09),
]
BEAM: list[Run] = [
    (5.5, "growing", 2.0, 0.002, 0.8, 0.4),
    (8.0, "settled", 0.04, -0.01, 0.62, 0.28),
    (21.0, "settled", 0.04, -0.03, 0.23, 0.095),
]


def summary(**models: list[Run]) -> pd.DataFrame:
    columns = ["k_star", "regime", "twist_amplitude_deg", "growth_rate", "mean_twist_deg"]
    frames = [
        pd.DataFrame(runs, columns=[*columns, "mean_deflection_chords"]).assign(
            model=model.replace("_", "-").removeprefix("m"),
            cpu_seconds=360.0,
            end_time=100.0,
            solver="openfoam",
            resolution="coarse",
            growth_low=[run[3] - 0.0005 for run in runs],
            growth_high=[run[3] + 0.0005 for run in runs],
        )
        for model, runs in models.items()
    ]
    return pd.concat(frames, ignore_index=True)


def reductions(corrected: list[Run] = CORRECTED, beam: list[Run] = BEAM) -> pd.DataFrame:
    """Return runs of the paper's section, as it is with the plate's twist, and of the plate."""
    section = [(*run[:4], there[4], run[5]) for run, there in zip(SECTION, BEAM, strict=True)]
    return summary(m2d_paper=section, m2d_corrected_paper=corrected, m3d=beam)


def kept(*rows: tuple[str, float, float, float, float]) -> pd.DataFrame:
    """Return kept runs from model, cells, time step, k* and processor seconds over 100 c/V."""
    columns = ["model", "cells", "time_step", "k_star", "cpu_seconds"]
    return pd.DataFrame(rows, columns=columns).assign(
        resolution="coarse",
        solver="openfoam",
        settings=json.dumps({"mesh": "coarse", "outer_correctors": 3}),
        end_time=100.0,
        regime="settled",
        growth_rate=-0.01,
        growth_behind=-0.01,
        growth_behind_low=-0.012,
        growth_behind_high=-0.008,
        twist_amplitude_deg=0.1,
        loads_zigzag=0.001,
        folder="a-run",
    )


def limits(**values: tuple[float, float]) -> pd.DataFrame:
    """Return values over the cell size: two meshes that agree, and the limit with its interval."""
    known = {
        "onset k*|2d-corrected||learnt model": (5.5, 0.3),
        "onset k*|2d-corrected, own ratios||learnt model": (5.6, 0.3),
        "onset k*|3d||releases": (5.4, 0.3),
        "onset k*|3d|zeta = 1 %|learnt model": (5.1, 0.3),
        "growth, V/c|2d|k* = 14|releases": (-0.02, 0.001),
        "growth over the first 30 c/V|3d|k* = 6.44|releases": (0.01, 0.001),
        "first bending mode over the next|3d|k* = 6.44|releases": (300.0, 20.0),
        "first torsion mode over the next|3d|k* = 6.44|releases": (200.0, 20.0),
        "c_l/C_L|section over plate|2.5 deg|steady runs": (1.2, 0.01),
        "c_m/C_M|section over plate|2.5 deg|steady runs": (1.1, 0.01),
        "mean twist|two iterations over four|k* = 6.44|releases": (0.995, 0.01),
        "mean deflection|two iterations over four|k* = 6.44|releases": (0.999, 0.01),
        **values,
    }
    for angle, at in ((2.5, 1.2), (10.0, 0.9)):
        for number, name in enumerate(("C_L", "C_M"), start=1):
            plate = TABLE_1["15e6 cells"][angle][number]
            known[f"{name.lower()}|rigid section|{angle:g} deg|steady runs"] = (at * plate, 0.0005)
    for angle, printed in TABLE_1["15e6 cells"].items():
        for name, value in zip(("C_D", "C_L", "C_M"), printed, strict=True):
            if value:
                known[f"{name}|rigid plate|{angle:g} deg|steady runs"] = (value, 0.0005)
    rows = []
    for key, (value, half) in known.items():
        head = key.split("|")
        rows += [(*head, mesh, 1, value, np.nan, np.nan, np.nan, "") for mesh in ("coarse", "b")]
        rows.append((*head, LIMIT, 0, value, value - half, value + half, 2.0, "three meshes"))
    return pd.DataFrame(rows, columns=list(COLUMNS))


#: Meshes of the study of the frequency constants.
STUDY = ("mesh 4 x 15 x 1", "mesh 8 x 30 x 1", "mesh 12 x 45 x 1")


def constants(*parts: float) -> pd.DataFrame:
    """Return a table of frequency constants: those of the paper times a part on each mesh."""
    rows = [
        {"constant": f"C_{n + 1}", "kind": kind}
        | {mesh: part * values[0] for mesh, part in zip(STUDY, parts, strict=True)}
        | {f"paper {mesh}": of_mesh[n] for mesh, of_mesh in TABLE_2.items()}
        for n, (kind, values) in enumerate(
            zip(TABLE_2_KINDS, zip(*TABLE_2.values(), strict=True), strict=True)
        )
    ]
    return pd.DataFrame(rows)


def complete() -> Evidence:
    """Return evidence in which all that can be run was run, near what the paper says."""
    quantities = {
        "first torsion mode over the others": 400.0,
        "first bending mode over the others": 120.0,
    }
    paper = pd.DataFrame(
        [
            *((name, value, 0.0, "Fig. 15", "") for name, value in quantities.items()),
            *(
                (entry.name, entry.value, 0.001, entry.source, "solid")
                for entry in PUBLISHED
                if entry.source == "Table 2" or entry.quantity.startswith("c^2")
            ),
        ],
        columns=["quantity", "here", "relative_difference", "source", "note"],
    )
    angles = [0.0, 2.5, 5.0, 7.5, 10.0]
    correction = xr.Dataset(
        {
            "lift_factor": ("incidence_deg", [1.4, 1.4, 1.2, 1.0, 0.9]),
            "moment_factor": ("incidence_deg", [1.2, 1.2, 1.1, 0.95, 0.9]),
        },
        {"incidence_deg": angles},
        {"section_label": "a section", "beam_label": "a beam"},
    )
    table_1 = pd.DataFrame(
        [(angle, *values, "a solver") for angle, values in TABLE_1["15e6 cells"].items()],
        columns=["incidence_deg", "C_D coarse", "C_L coarse", "C_M coarse", "made_by"],
    )
    bubble = pd.DataFrame(
        {
            "resolution": np.repeat(["coarse", "fine"], 5),
            "incidence_deg": [1.0, 2.0, 2.5, 4.0, 5.0] * 2,
            "bubble": [0.49, 0.6, 0.7, 0.9, 1.0] * 2,
            "y_plus_largest": 0.9,
            "y_plus_below_1": 1.0,
            "solver": np.repeat(["100 cells", "400 cells"], 5),
        }
    )
    return Evidence(
        paper=paper,
        summary=summary(m2d=SECTION, m2d_corrected=CORRECTED, m3d=BEAM),
        onset=pd.DataFrame(
            {
                "model": ["2d", "2d-corrected", "3d"],
                "k_star_unstable": 5.5,
                "k_star_stable": 8.0,
                "linear_flutter": 1.7,
                "linear_divergence": 1.5,
                "divergence_by_polar": 0.9,
            }
        ),
        linear=pd.DataFrame(
            {"motion": ["heave", "pitch"], "k_star": 5.5, "growth_rate": [-0.05, -0.03]}
        ),
        missing=pd.DataFrame(columns=["kind", "model", "case", "reason"]),
        bubble=bubble,
        grid_study=pd.DataFrame(
            {
                "incidence_deg": [2.5, 5.0],
                "coefficient": "cl",
                "cells": "1/2/3",
                "coarse": [0.37, 0.6],
                "fine": [0.36, 0.59],
            }
        ),
        correction=correction,
        section_mesh=no_mesh(2.5, 0.02).to_dataset(),
        table_1=table_1,
        plate_bubble=pd.DataFrame(
            {
                "resolution": ["coarse", "coarse", "fine", "fine"],
                "incidence_deg": [2.0, 4.0] * 2,
                "root": [0.26, 0.79] * 2,
                "tip": 0.1,
                "solver": ["100 cells"] * 2 + ["800 cells"] * 2,
            }
        ),
        reductions=reductions(),
        table_2=constants(1.09, 1.045, 1.03),  # with an error of first order, and the limit 1
        convergence=limits(),
        kept=pd.concat([kept(*COSTS), inside(0.02, 0.01)], ignore_index=True),
        embedded=summary(m2d=SECTION, m3d=BEAM).assign(cpu_seconds=0.02),
    )


#: Runs of section and plate on their own meshes, for their cost.
COSTS = (("2d", 1e4, 0.02, 8.0, 400.0), ("3d", 1e6, 0.02, 8.0, 80000.0))


def inside(*growth: float, k_star: float = 5.5) -> pd.DataFrame:
    """Return the paper's corrected section and the plate on equal cells, by their growth (V/c)."""
    section, plate = growth
    both = kept(("2d-corrected-paper", 3e3, 0.04, k_star, 20.0), ("3d", 8e4, 0.04, k_star, 900.0))
    rates = np.array([section, plate])
    return both.assign(
        regime="growing",
        folder=["paper-reductions", "paper-plate-openfoam-3d"],
        growth_behind=rates,
        growth_behind_low=rates - 0.001,
        growth_behind_high=rates + 0.001,
    )


def without_plate() -> Evidence:
    whole = complete()
    return replace(
        whole,
        summary=whole.summary[whole.summary["model"] != "3d"],
        onset=whole.onset[whole.onset["model"] != "3d"],
        reductions=whole.reductions[whole.reductions["model"] != "3d"],
        kept=whole.kept[whole.kept["model"] != "3d"],
        convergence=whole.convergence[~whole.convergence["model"].isin(["3d", "rigid plate"])],
        paper=whole.paper[~whole.paper["quantity"].str.startswith("first")],
        table_1=whole.table_1[["incidence_deg"]].assign(made_by=np.nan),
        plate_bubble=whole.plate_bubble.iloc[:0],
    )


def test_claims_that_hold_agree() -> None:
    judged = {claim.title: claim.judge(complete()).verdict for claim in CLAIMS}
    open_ones = {title for title, verdict in judged.items() if verdict is ClaimVerdict.OPEN}
    assert open_ones == {"Courant number"}
    assert {judged[title] for title in judged.keys() - open_ones} == {ClaimVerdict.AGREES}


@pytest.mark.parametrize(
    "judge",
    [
        loads.rigid_plate,
        response.first_modes,
        response.mean_twist_uncorrected,
        response.mean_bending_uncorrected,
        response.means_corrected,
        response.growing_inside,
        response.cost,
    ],
)
def test_what_needs_the_plate_is_open_without_it(judge: object) -> None:
    assert judge(without_plate()).verdict is ClaimVerdict.OPEN  # type: ignore[operator]


def test_onset_of_the_sections_alone_is_judged_without_the_plate() -> None:
    finding = response.onset(without_plate())
    assert finding.verdict is ClaimVerdict.AGREES
    assert "3d:" not in finding.here


@pytest.mark.parametrize(
    ("plate", "verdict"),
    [
        ((8.5, 0.5), ClaimVerdict.PARTLY),  # both sections agree, the plate differs
        ((8.5, 2.5), ClaimVerdict.PARTLY),  # it is not converged, so it says nothing
        ((5.5, 2.5), ClaimVerdict.PARTLY),  # nor does it agree
    ],
)
def test_onset_that_is_not_converged_neither_agrees_nor_differs(
    plate: tuple[float, float], verdict: ClaimVerdict
) -> None:
    changed = limits(**{"onset k*|3d||releases": plate})
    finding = response.onset(replace(complete(), convergence=changed))
    assert finding.verdict is verdict
    assert ("not converged" in finding.here) == (plate[1] > 1.0)


@pytest.mark.parametrize(("from_equilibrium", "is_used"), [((8.0, 0.5), True), ((8.0, 5.0), False)])
def test_onset_of_the_plate_is_that_of_its_narrowest_limit(
    from_equilibrium: tuple[float, float], is_used: bool
) -> None:
    new = {"onset k*|3d||releases from equilibrium": from_equilibrium}
    changed = limits(**new, **{"onset k*|3d||releases": (5.5, 2.5)})
    finding = response.onset(replace(complete(), convergence=changed))
    assert finding.verdict is ClaimVerdict.PARTLY  # both sections agree
    words = "3d (releases from equilibrium): k* = 8.00" if is_used else "3d (releases): k* = 5.50"
    assert words in finding.here
    assert ("not converged" in finding.here) != is_used


def test_growth_of_the_plate_has_the_error_of_two_meshes_from_equilibrium_where_it_is_known() -> (
    None
):
    early = {"growth over the first 30 c/V|3d|k* = 6.44|releases": (0.01, 0.02)}
    new = {"growth, V/c|3d|k* = 6.44|releases from equilibrium": (0.01, 0.001)}
    for more, verdict in (({}, ClaimVerdict.NOT_CONVERGED), (new, ClaimVerdict.AGREES)):
        changed = replace(complete(), kept=inside(0.03, 0.02), convergence=limits(**early, **more))
        assert response.growing_inside(changed).verdict is verdict


def test_onset_says_what_damping_makes_of_it() -> None:
    assert "3d (b) 5.10 at 1 %" in response.onset(complete()).why


def test_section_that_bends_less_than_the_plate_contradicts_the_paper() -> None:
    bending = [(*run[:5], 2 * run[5]) for run in BEAM]
    changed = replace(complete(), reductions=reductions(beam=bending))
    finding = response.mean_bending_uncorrected(changed)
    assert finding.verdict is ClaimVerdict.DIFFERS


@pytest.mark.parametrize(
    ("section", "plate", "error_of_mesh", "verdict"),
    [
        (0.03, 0.02, 0.001, ClaimVerdict.AGREES),
        (0.02, 0.03, 0.001, ClaimVerdict.DIFFERS),
        (0.03, 0.02, 0.02, ClaimVerdict.NOT_CONVERGED),
        (0.0305, 0.0300, 0.0, ClaimVerdict.NOT_CONVERGED),
    ],
)
def test_growth_of_section_and_plate_is_compared_with_its_errors(
    section: float, plate: float, error_of_mesh: float, verdict: ClaimVerdict
) -> None:
    mesh = limits(**{"growth over the first 30 c/V|3d|k* = 6.44|releases": (0.01, error_of_mesh)})
    changed = replace(complete(), kept=inside(section, plate), convergence=mesh)
    assert response.growing_inside(changed).verdict is verdict


def test_decay_without_an_error_of_the_mesh_is_not_judged() -> None:
    whole = complete()
    none = whole.convergence[~whole.convergence["quantity"].str.startswith("growth")]
    found = response.decay_at_high_stiffness(replace(whole, convergence=none))
    assert found.verdict is ClaimVerdict.NOT_CONVERGED
    assert "± an unknown error by the mesh" in found.here
    assert "nan" not in found.here


def test_decay_is_not_judged_on_runs_at_low_stiffness() -> None:
    slow = [run for run in BEAM if run[0] < 10.0]
    some = replace(complete(), summary=summary(m2d=SECTION, m2d_corrected=CORRECTED, m3d=slow))
    found = response.decay_at_high_stiffness(some)
    assert found.verdict == ClaimVerdict.PARTLY
    assert "3d: not run from k* = 10 on" in found.here


@pytest.mark.parametrize(
    ("regimes", "growth", "verdict"),
    [
        (("growing", "settled"), 0.0, ClaimVerdict.NOT_CONVERGED),
        (("growing", "limit-cycle"), 0.0, ClaimVerdict.AGREES),
        (("limit-cycle", "settled"), 0.0, ClaimVerdict.AGREES),
        (("growing", "limit-cycle"), -0.002, ClaimVerdict.NOT_CONVERGED),  # it may decay slowly
    ],
)
def test_limit_cycle_next_to_the_onset_neither_grows_nor_decays(
    regimes: tuple[str, str], growth: float, verdict: ClaimVerdict
) -> None:
    unstable, stable = regimes
    runs: list[Run] = [
        (5.5, unstable, 0.6, growth, 0.8, 0.4),
        (8.0, stable, 0.4, growth, 0.6, 0.27),
    ]
    finding = response.limit_cycle(replace(complete(), summary=summary(m2d_corrected=runs)))
    assert finding.verdict is verdict


def test_limit_cycle_inside_is_a_part_of_the_claim() -> None:
    whole = complete()
    cycle = kept(("2d", 1e4, 0.02, 6.44, 400.0)).assign(regime="limit-cycle", end_time=370.0)
    runs: list[Run] = [(5.5, "growing", 0.6, 0.0, 0.8, 0.4), (8.0, "settled", 0.4, 0.0, 0.6, 0.3)]
    finding = response.limit_cycle(replace(whole, summary=summary(m2d_corrected=runs), kept=cycle))
    assert "inside, 2d at k* = 6.44 after 370 c/V" in finding.here
    assert finding.verdict is ClaimVerdict.PARTLY


def test_other_reduction_stands_beside_the_papers_and_is_not_judged() -> None:
    far = [(*run[:4], 3 * run[4], run[5]) for run in SECTION]
    both = pd.concat([reductions(), summary(m2d_consistent=far)])
    finding = response.mean_twist_uncorrected(replace(complete(), reductions=both))
    assert finding.verdict is ClaimVerdict.AGREES
    assert "With the consistent reduction mean twist +213 % to +219 %, on" in finding.why


@pytest.mark.parametrize("error", ["mesh", "iterations"])
def test_means_are_not_judged_within_the_error_of_mesh_and_iterations(error: str) -> None:
    wide = {
        "mesh": {"c_m/C_M|section over plate|2.5 deg|steady runs": (1.1, 0.2)},
        "iterations": {"mean twist|two iterations over four|k* = 6.44|releases": (0.8, 0.01)},
    }[error]
    finding = response.mean_twist_uncorrected(replace(complete(), convergence=limits(**wide)))
    assert finding.verdict is ClaimVerdict.NOT_CONVERGED


def test_means_of_a_large_motion_are_not_compared() -> None:
    large = [(5.5, "growing", 6.0, 0.01, 3.0, 2.0), *CORRECTED[1:]]
    some = replace(complete(), reductions=reductions(corrected=large))
    assert "5.5" not in response.means_corrected(some).here
    assert "5.5" in response.means_corrected(complete()).here


def test_constants_that_go_to_and_fro_with_the_mesh_are_not_extrapolated() -> None:
    wavering = replace(complete(), table_2=constants(1.0, 1.05, 1.02))
    finding = loads.natural_frequencies(wavering)
    assert finding.verdict is ClaimVerdict.NOT_CONVERGED
    assert "8.5e3 elements: 0 of 5 meet the limit here, +2 % to +2 %" in finding.here


def test_constants_on_one_mesh_are_not_judged() -> None:
    one = complete().table_2.drop(columns=list(STUDY[:2]))
    finding = loads.natural_frequencies(replace(complete(), table_2=one))
    assert finding.verdict is ClaimVerdict.OPEN


def test_linear_theory_that_grows_at_the_onset_would_contradict_the_paper() -> None:
    linear = complete().linear.assign(growth_rate=[-0.05, 0.01])
    finding = response.not_classical_flutter(replace(complete(), linear=linear))
    assert finding.verdict is ClaimVerdict.DIFFERS


def test_nothing_that_is_absent_breaks_the_page() -> None:
    whole = complete()
    empty = replace(
        whole,
        **{
            name: table.iloc[:0]
            for name, table in vars(whole).items()
            if isinstance(table, pd.DataFrame) and name not in ("embedded", "table_1", "missing")
        },
        correction=whole.correction.isel(incidence_deg=slice(0, 1)),
        table_1=without_plate().table_1,
    )
    assert page(empty).count("Not run yet") >= 10


def test_factors_of_the_paper_are_shown_without_a_gap_and_not_judged() -> None:
    whole = complete()
    crossing = whole.correction.copy(deep=True)
    crossing["moment_factor"][2] = np.nan
    found = loads.section_against_plate(replace(whole, correction=crossing))
    assert "c_m/C_M 1.20 at 2.5 deg, 0.90 at 10 deg" in found.why
    assert found.verdict is ClaimVerdict.AGREES


def test_links_of_the_page_lead_to_its_headings() -> None:
    text = page(complete())
    headings = re.findall(r"^## (.*)$", text, flags=re.MULTILINE)
    slugs = {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
    links = re.findall(r"\]\(#([^)]*)\)", text)
    assert len(links) == len(CLAIMS)
    assert set(links) <= slugs


@pytest.mark.parametrize(
    ("here", "paper", "verdict"),
    [
        ((5.0, 0.3), (5.5, 0.3), ClaimVerdict.AGREES),
        ((7.0, 0.3), (5.5, 0.5), ClaimVerdict.DIFFERS),
        ((7.0, 1.5), (5.5, 0.5), ClaimVerdict.NOT_CONVERGED),  # it would meet nearly everything
        ((70.0, 8.0), (5.5, 0.5), ClaimVerdict.NOT_CONVERGED),
        ((7.0, np.nan), (5.5, 0.5), ClaimVerdict.NOT_CONVERGED),
    ],
)
def test_interval_decides(
    here: tuple[float, float], paper: tuple[float, float], verdict: ClaimVerdict
) -> None:
    one, other = (Known(value, value - half, value + half) for value, half in (here, paper))
    assert one.meets(other) is verdict


@pytest.mark.parametrize("half", [0.05, 0.2, np.nan])
def test_bound_is_told_by_the_whole_interval(half: float) -> None:
    here = Known(1.1, 1.1 - half, 1.1 + half)
    told = half < 0.1
    assert here.is_above(1.0) is (ClaimVerdict.AGREES if told else ClaimVerdict.NOT_CONVERGED)
    assert here.is_below(1.0) is (ClaimVerdict.DIFFERS if told else ClaimVerdict.NOT_CONVERGED)


def test_quotient_has_the_errors_of_both() -> None:
    quotient = Known(1.2, 1.14, 1.26).over(Known(0.8, 0.768, 0.832))
    assert quotient.value == pytest.approx(1.5)
    assert quotient.half_width / quotient.value == pytest.approx(np.hypot(0.05, 0.04))


def test_claim_of_several_parts_agrees_in_part_only_where_one_agrees() -> None:
    agrees, differs, open_ = ClaimVerdict.AGREES, ClaimVerdict.DIFFERS, ClaimVerdict.NOT_CONVERGED
    assert together([agrees, agrees]) is agrees
    assert together([agrees, differs, open_]) is ClaimVerdict.PARTLY
    assert together([differs, open_]) is open_
    assert together([differs]) is differs


def test_runs_whose_loads_zigzag_are_named() -> None:
    whole = complete()
    zigzag = whole.reductions.assign(
        loads_zigzag=np.where(whole.reductions["model"] == "3d", 0.06, 0)
    )
    how = response.mean_twist_uncorrected(replace(whole, reductions=zigzag)).how
    assert "3 [not converged in time step](openfoam-sweep.md#loads-that-zigzag)" in how
    assert "zigzag" not in response.mean_twist_uncorrected(whole).how
    some = whole.kept.assign(loads_zigzag=[0.06, np.nan, 0.001, 0.001])
    assert "(kept-runs.csv) has the 4 releases" in page(replace(whole, kept=some))
    assert "Of 1 the zigzag of the loads is above 0.02" in page(replace(whole, kept=some))
    table = pd.read_csv(io.StringIO(runs_table(some)))
    np.testing.assert_allclose(table["loads_zigzag"], some["loads_zigzag"])
    assert table["folder"].tolist() == some["folder"].tolist()


class TestCostLadder:
    def test_seconds_are_those_of_a_time_simulated(self) -> None:
        ladder = cost_ladder(kept(*COSTS), complete().embedded).set_index("what")
        assert ladder.loc["3D OpenFOAM, coarse, 3 outer correctors", "seconds"] == 800.0
        assert ladder.loc["2D embedded", "seconds"] == pytest.approx(0.02 / 100)
        ratio = ladder["cell_steps"].iloc[0] / ladder["cell_steps"].iloc[1]
        assert ratio == pytest.approx(100.0)

    def test_only_k_star_that_both_have_count(self) -> None:
        runs = kept(("2d", 1e4, 0.02, 8.0, 400.0), ("2d", 1e4, 0.02, 9.0, 4e6))
        ladder = cost_ladder(runs, complete().embedded)
        assert ladder["seconds"].max() == 4.0

    def test_base_is_the_section_with_most_k_star(self) -> None:
        sweep = [("2d", 1e4, 0.02, k_star, 400.0) for k_star in (5.5, 8.0, 21.0)]
        ladder = cost_ladder(kept(*sweep, ("2d", 1e4, 0.01, 8.0, 9e2)), complete().embedded)
        base = base_of(ladder)
        assert base is not None
        assert base["time_step"] == 0.02


def test_missing_evidence_is_an_error_that_says_what_makes_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(ResultFileError, match="make paper"):
        read_evidence(*[tmp_path] * 5)
    assert main(["--figures", str(tmp_path), "--plate", str(tmp_path)]) == 1
    assert "paper.csv: missing" in capsys.readouterr().err
