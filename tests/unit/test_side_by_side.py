"""The paper's claims judged on evidence: complete, partial, and none."""

from __future__ import annotations

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
from equisection.paper.claims_page.__main__ import main, page
from equisection.paper.claims_page.claims import CLAIMS
from equisection.paper.claims_page.evidence import Evidence, read_evidence
from equisection.paper.claims_page.findings import ClaimVerdict, graded
from equisection.paper.claims_page.kept_runs import base_of, cost_ladder
from equisection.paper.printed_values import PUBLISHED, TABLE_1
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
        growth_by_60=-0.01,
        growth_by_100=-0.01,
        twist_amplitude_deg=0.1,
        folder="a-run",
    )


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
            "resolution": "fine",
            "incidence_deg": [1.0, 2.0, 2.5, 4.0, 5.0],
            "bubble": [0.49, 0.6, 0.7, 0.9, 1.0],
            "y_plus_largest": 0.9,
            "y_plus_below_1": 1.0,
            "solver": "a solver",
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
                "resolution": "fine",
                "incidence_deg": [2.0, 4.0],
                "root": [0.26, 0.79],
                "tip": 0.1,
                "solver": "a solver",
            }
        ),
        reductions=reductions(),
        kept=kept(("2d", 1e4, 0.02, 8.0, 400.0), ("3d", 1e6, 0.02, 8.0, 80000.0)),
        embedded=summary(m2d=SECTION, m3d=BEAM).assign(cpu_seconds=0.02),
    )


def without_plate() -> Evidence:
    whole = complete()
    return replace(
        whole,
        summary=whole.summary[whole.summary["model"] != "3d"],
        onset=whole.onset[whole.onset["model"] != "3d"],
        reductions=whole.reductions[whole.reductions["model"] != "3d"],
        kept=whole.kept[whole.kept["model"] != "3d"],
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


def test_onset_of_the_section_alone_does_not_make_the_claim() -> None:
    finding = response.onset(without_plate())
    assert finding.verdict is ClaimVerdict.PARTLY
    assert "3d: not run yet" in finding.here


def test_onset_far_from_the_papers_is_not_borne_out() -> None:
    far = complete().onset.assign(k_star_unstable=8.5, k_star_stable=10.0)
    assert response.onset(replace(complete(), onset=far)).verdict is ClaimVerdict.DIFFERS


def test_section_that_bends_less_than_the_plate_contradicts_the_paper() -> None:
    bending = [(*run[:5], 2 * run[5]) for run in BEAM]
    changed = replace(complete(), reductions=reductions(beam=bending))
    finding = response.mean_bending_uncorrected(changed)
    assert finding.verdict is ClaimVerdict.DIFFERS


@pytest.mark.parametrize(
    ("growth_of_the_plate", "verdict"),
    [
        ((0.03, 0.002), ClaimVerdict.PARTLY),
        ((0.03, 0.02), ClaimVerdict.DIFFERS),
        ((0.0, 0.0), ClaimVerdict.AGREES),
    ],
)
def test_growth_is_compared_at_the_same_k_star(
    growth_of_the_plate: tuple[float, float], verdict: ClaimVerdict
) -> None:
    """Not at the stiffest that grows, where growth is next to nothing for either."""
    section: list[Run] = [
        (k_star, "growing", 1.0, growth, 0.8, 0.4)
        for k_star, growth in [(5.0, 0.02), (5.5, 0.01), (8.0, 0.0001)]
    ]
    plate: list[Run] = [
        (k_star, "growing", 1.0, growth, 0.8, 0.4)
        for k_star, growth in zip((5.0, 5.5), growth_of_the_plate, strict=True)
    ]
    both = summary(m2d_corrected_paper=section, m3d=plate)
    assert response.growing_inside(replace(complete(), reductions=both)).verdict is verdict


def test_decay_is_not_judged_on_runs_at_low_stiffness() -> None:
    slow = [run for run in BEAM if run[0] < 10.0]
    some = replace(complete(), summary=summary(m2d=SECTION, m2d_corrected=CORRECTED, m3d=slow))
    found = response.decay_at_high_stiffness(some)
    assert found.verdict == ClaimVerdict.PARTLY
    assert "3d: not run from k* = 10 on" in found.here


@pytest.mark.parametrize(
    ("unstable", "stable", "verdict"),
    [
        ("growing", "settled", ClaimVerdict.DIFFERS),
        ("growing", "limit-cycle", ClaimVerdict.AGREES),
        ("limit-cycle", "settled", ClaimVerdict.AGREES),
    ],
)
def test_limit_cycle_may_be_on_either_side_of_the_onset(
    unstable: str, stable: str, verdict: ClaimVerdict
) -> None:
    runs: list[Run] = [(5.5, unstable, 0.6, 0.0, 0.8, 0.4), (8.0, stable, 0.4, 0.0, 0.6, 0.27)]
    finding = response.limit_cycle(replace(complete(), summary=summary(m2d_corrected=runs)))
    assert finding.verdict is verdict


def test_other_reduction_stands_beside_the_papers_and_is_not_judged() -> None:
    far = [(*run[:4], 3 * run[4], run[5]) for run in SECTION]
    both = pd.concat([reductions(), summary(m2d_consistent=far)])
    finding = response.mean_twist_uncorrected(replace(complete(), reductions=both))
    assert finding.verdict is ClaimVerdict.AGREES
    assert "With the consistent reduction mean twist: +219 % at 8" in finding.why


def test_means_of_a_large_motion_are_not_compared() -> None:
    large = [(5.5, "growing", 6.0, 0.01, 3.0, 2.0), *CORRECTED[1:]]
    some = replace(complete(), reductions=reductions(corrected=large))
    assert "5.5" not in response.means_corrected(some).here
    assert "5.5" in response.means_corrected(complete()).here


def test_linear_theory_that_grows_at_the_onset_would_contradict_the_paper() -> None:
    linear = complete().linear.assign(growth_rate=[-0.05, 0.01])
    finding = response.not_classical_flutter(replace(complete(), linear=linear))
    assert finding.verdict is ClaimVerdict.DIFFERS


def test_section_on_the_sweeps_mesh_is_set_against_the_plate_over_the_same_time() -> None:
    """Not by growth rates of 200 and of 60 c/V: the rate falls with the amplitude."""
    both = kept(("2d-corrected", 1e4, 0.02, 5.5, 300.0), ("3d", 8e4, 0.04, 5.5, 900.0))
    both["growth_by_60"] = [0.018, 0.002]
    why = response.growing_inside(replace(complete(), kept=both)).why
    assert "over the plate's 60 c/V: growth of section and plate (V/c): +0.0180 and +0.0020" in why


def test_growth_by_mesh_stands_with_the_onset() -> None:
    two = kept(("2d", 1e4, 0.02, 8.0, 400.0), ("2d", 2e4, 0.02, 8.0, 800.0))
    two["resolution"] = ["coarse", "medium"]
    two["settings"] = [f'{{"mesh": "{mesh}", "outer_correctors": 3}}' for mesh in two["resolution"]]
    two["growth_by_100"] = [0.004, -0.001]
    assert (
        "k* = 8: +0.0040 (coarse), -0.0010 (medium)"
        in response.onset(replace(complete(), kept=two)).here
    )


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


def test_factors_are_not_judged_across_a_gap() -> None:
    whole = complete()
    crossing = whole.correction.copy(deep=True)
    crossing["moment_factor"][3] = np.nan
    found = loads.section_against_plate(replace(whole, correction=crossing))
    assert "c_m/C_M: 1.20 at 2.5 deg, 1.10 at 5 deg, 0.90 at 10 deg" in found.here
    crossing["moment_factor"][1] = np.nan
    found = loads.section_against_plate(replace(whole, correction=crossing))
    assert found.verdict is ClaimVerdict.OPEN


def test_links_of_the_page_lead_to_its_headings() -> None:
    text = page(complete())
    headings = re.findall(r"^## (.*)$", text, flags=re.MULTILINE)
    slugs = {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
    links = re.findall(r"\]\(#([^)]*)\)", text)
    assert len(links) == len(CLAIMS)
    assert set(links) <= slugs


@pytest.mark.parametrize(
    ("differences", "verdict"),
    [
        ([0.01, -0.04], ClaimVerdict.AGREES),
        ([0.01, -0.1], ClaimVerdict.PARTLY),
        ([0.2], ClaimVerdict.DIFFERS),
    ],
)
def test_largest_difference_decides(differences: list[float], verdict: ClaimVerdict) -> None:
    assert graded(differences, 0.05, 0.15) is verdict


class TestCostLadder:
    def test_seconds_are_those_of_a_time_simulated(self) -> None:
        ladder = cost_ladder(complete().kept, complete().embedded).set_index("what")
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
        read_evidence(tmp_path, tmp_path, tmp_path, tmp_path)
    assert main(["--figures", str(tmp_path), "--plate", str(tmp_path)]) == 1
    assert "paper.csv: missing" in capsys.readouterr().err
